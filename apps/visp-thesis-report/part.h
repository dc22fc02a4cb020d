/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file part.h
 * \brief Parts of the report, each for one or several figures and tables of the thesis.
 */
#ifndef thesisReport_part_h
#define thesisReport_part_h

#include "item.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace thesisReport
{
//! \brief Input of every part.
struct Setting {
  unsigned int seed = 1;                //!< Seed of all random numbers; the next 999 are free as well.
  std::set<std::string> wanted;         //!< Requested ids.
  std::function<void(double)> progress; //!< Call with the fraction done, 0..1; throws on interruption by the user.
  [[nodiscard]] bool wants(const std::string &id) const { return wanted.count(id) != 0; }
};

//! \brief A figure or table that can be requested.
struct Entry {
  std::string id;    //!< "table4.3".
  std::string title; //!< Content, in terms of the thesis.
};

//! \brief Figures and tables from the same runs.
struct Part {
  std::string chapter;        //!< Heading in the report: "Chapter 4: keypoints".
  std::vector<Entry> entries; //!< In the order of the thesis.
  double cost = 1.;           //!< Expected time on one core, s; long parts start first.
  /*!
   * Runs on one thread. Returns at least the items of Setting::wanted that are among the entries.
   */
  std::function<std::vector<Item>(const Setting &)> play;
  bool random = true; //!< Depends on Setting::seed or on clocks; else one seed stands for all.
};

//! Colour of a law's curves, the same in every figure.
[[nodiscard]] const std::string &colourOf(const std::string &law);

// The parts, by chapter.
[[nodiscard]] std::vector<Part> keypointParts();     //!< Tables 4.2 and 4.3.
[[nodiscard]] std::vector<Part> referenceParts();    //!< Section 4.6 in a loop.
[[nodiscard]] std::vector<Part> stabilityParts();    //!< (5.31).
[[nodiscard]] std::vector<Part> servoParts();        //!< Figures 5.6 to 5.11.
[[nodiscard]] std::vector<Part> plannedServoParts(); //!< Figure 6.1.
[[nodiscard]] std::vector<Part> trajectoryParts();   //!< Figures 6.3 to 6.6.
[[nodiscard]] std::vector<Part>
patternParts(); //!< Figures 7.1, 7.3, (7.1), (7.2), tables 7.1 to 7.4, figures 7.10, 7.11.
[[nodiscard]] std::vector<Part> printingParts();       //!< Figures 7.12 to 7.15.
[[nodiscard]] std::vector<Part> avoidanceParts();      //!< Figures 8.6 to 8.10 and 8.13.
[[nodiscard]] std::vector<Part> armParts();            //!< Table 8.1, figures 8.14 to 8.17.
[[nodiscard]] std::vector<Part> recommendationParts(); //!< Section 9.2.
[[nodiscard]] std::vector<Part> minimumJerkParts();    //!< Table A.1.
} // namespace thesisReport

#endif
