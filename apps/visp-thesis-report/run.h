/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file run.h
 * \brief Parts in, items out.
 */
#ifndef thesisReport_run_h
#define thesisReport_run_h

#include "options.h"
#include "ranks.h"
#include "part.h"

namespace thesisReport
{
//! \brief A finished part.
struct Played {
  const Part *part = nullptr; //!< In the catalogue.
  std::vector<Item> items;    //!< Requested items, in the order of the part's entries.
  double seconds = 0.;        //!< Computing time.
};

/*!
 * Run the required parts, the long ones first, with a progress bar.
 * \return Finished parts in the order of the catalogue, on rank 0.
 * \throw std::runtime_error naming the id when a part fails or omits an item; vpApp::Interrupted.
 */
[[nodiscard]] std::vector<Played> playAll(const Options &options, const vpApp::Ranks &ranks);
} // namespace thesisReport

#endif
