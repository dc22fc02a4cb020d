/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file part.h
 * \brief What the report is made of: pieces of work, each for one or several figures and tables of the thesis.
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
//! \brief What every part is told.
struct Setting {
  unsigned int seed = 1;                //!< Of everything random.
  std::set<std::string> wanted;         //!< Ids that were asked for.
  std::function<void(double)> progress; //!< Call with the share done, 0..1; throws when the user interrupts.
  [[nodiscard]] bool wants(const std::string &id) const { return wanted.count(id) != 0; }
};

//! \brief A figure or table that can be asked for.
struct Entry {
  std::string id;    //!< "table4.3".
  std::string title; //!< What it shows, in the thesis's sense.
};

//! \brief Figures and tables that come from the same runs.
struct Part {
  std::string chapter;        //!< Heading in the report: "Chapter 4: keypoints".
  std::vector<Entry> entries; //!< In the order of the thesis.
  double cost = 1.;           //!< Expected time on one core, s; long parts begin first.
  /*!
   * Does the work on one thread. Gives at least the items of Setting::wanted that are among the entries.
   */
  std::function<std::vector<Item>(const Setting &)> play;
};

//! All parts, in the order of the thesis.
[[nodiscard]] const std::vector<Part> &catalogue();
//! A chapter's name for the command line: "chapter4", "appendixA".
[[nodiscard]] std::string chapterName(const Part &part);
//! All ids, in the order of the thesis.
[[nodiscard]] std::vector<std::string> allIds();

// The parts, by chapter.
[[nodiscard]] std::vector<Part> keypointParts();   //!< Tables 4.2 and 4.3.
[[nodiscard]] std::vector<Part> servoParts();      //!< Figures 5.6 to 5.11.
[[nodiscard]] std::vector<Part> trajectoryParts(); //!< Figures 6.3 to 6.6.
[[nodiscard]] std::vector<Part> patternParts();    //!< Figure 7.1, (7.1), (7.2), tables 7.1 to 7.4, figures 7.10, 7.11.
[[nodiscard]] std::vector<Part> printingParts();   //!< Figures 7.12 to 7.15.
[[nodiscard]] std::vector<Part> avoidanceParts();  //!< Figures 8.6 to 8.10 and 8.13.
[[nodiscard]] std::vector<Part> armTrackingParts(); //!< Table 8.1.
[[nodiscard]] std::vector<Part> selfMotionParts();  //!< Figures 8.14 to 8.17.
[[nodiscard]] std::vector<Part> minimumJerkParts(); //!< Table A.1.
} // namespace thesisReport

#endif
