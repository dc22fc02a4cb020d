/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRegistry.h
 * \brief Makers by id, each with a sentence: our own and those that a user adds. Not installed.
 */
#ifndef vpRegistry_h
#define vpRegistry_h

#include "vpPrintable.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <algorithm>
#include <cctype>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Entries in the order of their registration, never removed. Threads may add and find at the same time.
 *
 * \e Maker is a std::function, copied by find(), so that a maker runs without the lock.
 */
template <class Maker> class vpRegistry
{
public:
  //! \param kind : As in "the servo law", for messages; static text.
  explicit vpRegistry(const char *kind) : m_kind(kind) {}

  //! \throw vpException (badValue) for a bad or used id, an unusable sentence or an empty maker; nothing is added then.
  void add(const std::string &id, const std::string &sentence, Maker maker)
  {
    const auto require = [&](bool condition, const char *message) {
      if (!condition) {
        throw vpException(vpException::badValue, nameOf(id) + message);
      }
    };
    require(isId(id), " must have an id of a letter and up to 63 more letters, digits, - or _");
    require(!sentence.empty() && sentence == vpPrintable(sentence), " must have a sentence, one printable line");
    require(static_cast<bool>(maker), " has no maker");
    const std::lock_guard<std::mutex> lock(m_mutex);
    require(search(id) == m_entries.end(), " is registered already");
    m_entries.push_back({id, sentence, std::move(maker)});
  }

  //! \throw vpException (badValue) naming the unknown id and listing the known ones.
  [[nodiscard]] Maker find(const std::string &id) const { return entry(id).maker; }
  //! As find().
  [[nodiscard]] std::string sentence(const std::string &id) const { return entry(id).sentence; }

  [[nodiscard]] std::vector<std::string> ids() const
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    std::vector<std::string> all;
    for (const Entry &entry : m_entries) {
      all.push_back(entry.id);
    }
    return all;
  }

private:
  struct Entry {
    std::string id, sentence;
    Maker maker;
  };
  static constexpr std::size_t longestId = 64;

  // No + (the suffix +cbf) and no comma: options take lists of ids.
  static bool isId(const std::string &id)
  {
    const auto isLetter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_'; };
    return !id.empty() && id.size() <= longestId && isLetter(id[0]) && std::all_of(id.begin(), id.end(), fits);
  }

  std::string nameOf(const std::string &id) const { return m_kind + (" \"" + vpPrintable(id, longestId) + "\""); }

  typename std::vector<Entry>::const_iterator search(const std::string &id) const
  {
    return std::find_if(m_entries.begin(), m_entries.end(), [&id](const Entry &entry) { return entry.id == id; });
  }

  Entry entry(const std::string &id) const
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto found = search(id);
    if (found != m_entries.end()) {
      return *found;
    }
    std::string known;
    for (const Entry &entry : m_entries) {
      known += (known.empty() ? "" : ", ") + entry.id;
    }
    throw vpException(vpException::badValue,
                      nameOf(id) + " is unknown, " + (known.empty() ? "there is none" : "known are: " + known));
  }

  const char *m_kind;
  mutable std::mutex m_mutex;
  std::vector<Entry> m_entries;
};

END_VISP_NAMESPACE

#endif
