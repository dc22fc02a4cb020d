/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpWarningList.h
 * \brief Sentences on what a reader took as unknown, each once. Not installed.
 */
#ifndef vpWarningList_h
#define vpWarningList_h

#include "vpPrintable.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

/*!
 * \brief Warnings in the order of their first element; elements with the same sentence share it.
 */
class vpWarningList
{
public:
  //! Adds the sentence "before name1, name2 after". \param name : Element that is warned of.
  void add(const std::string &before, const std::string &name, const std::string &after)
  {
    for (Warning &warning : m_warnings) {
      if (warning.before == before && warning.after == after) {
        if (warning.known.insert(name).second) {
          warning.names.push_back(name);
        }
        return;
      }
    }
    m_warnings.push_back({before, {name}, {name}, after});
  }
  //! The sentences, printable.
  [[nodiscard]] std::vector<std::string> sentences() const
  {
    std::vector<std::string> all;
    for (const Warning &warning : m_warnings) {
      std::string names;
      for (std::size_t i = 0; i < std::min(warning.names.size(), mostNames); ++i) {
        names += (names.empty() ? "" : ", ") + warning.names[i];
      }
      if (warning.names.size() > mostNames) {
        names += " and " + std::to_string(warning.names.size() - mostNames) + " more";
      }
      all.push_back(vpPrintable(warning.before + names + warning.after));
    }
    return all;
  }

private:
  static constexpr std::size_t mostNames = 16; // in a sentence; an arm has as many joints
  struct Warning {
    std::string before;
    std::vector<std::string> names;
    std::set<std::string> known; // the same
    std::string after;
  };
  std::vector<Warning> m_warnings;
};

#endif
