/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file run.h
 * \brief All parts, and the run of those that are asked for: parts in, items out.
 */
#ifndef thesisReport_run_h
#define thesisReport_run_h

#include "part.h"
#include "ranks.h"

#include <string>
#include <vector>

namespace thesisReport
{
//! All parts, in the order of the thesis.
[[nodiscard]] const std::vector<Part> &catalogue();
//! Name of a chapter on the command line: "chapter4", "appendixA".
[[nodiscard]] std::string chapterName(const Part &part);
//! All ids, in the order of the thesis.
[[nodiscard]] std::vector<std::string> allIds();

//! \brief User options.
struct Options {
  std::vector<std::string> only; //!< Requested ids; all of them by default.
  std::string out = "out/thesis-report";
  unsigned int jobs = 0;   //!< Parts at a time; 0: one for each core.
  unsigned int seed = 1;   //!< The first one.
  unsigned int seeds = 10; //!< Number of seeds for the spread of each value.
  bool list = false;
};

//! \brief A finished part.
struct Played {
  const Part *part = nullptr; //!< In the catalogue.
  std::vector<Item> items;    //!< Requested items, in the order of the part's entries; each row with its judgement.
  double seconds = 0.;        //!< Computing time of all seeds.
};

/*!
 * The rows that Judgement::support names by `row of ID "NAME"` or `rows of ID "NAME" and "NAME"`.
 * \return Id and name of each; a star in a name stands for any text.
 */
[[nodiscard]] std::vector<std::pair<std::string, std::string>> rowsNamedIn(const std::string &support);

/*!
 * Run the required parts with all seeds, the long ones first, with a progress bar.
 * \return Finished parts in the order of the catalogue, the seeds of each merged, on rank 0.
 * \throw std::runtime_error naming the id when a part fails, omits an item or has a row without judgement, or when a support
 * names a row that is not there;
 * vpApp::Interrupted.
 */
[[nodiscard]] std::vector<Played> playAll(const Options &options, const vpApp::Ranks &ranks);
} // namespace thesisReport

#endif
