/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file exploration.h
 * \brief All designs of a setup, on all cores and ranks.
 */
#ifndef printExplore_exploration_h
#define printExplore_exploration_h

#include "outcome.h"
#include "sweep.h"

#include <cstddef>
#include <vector>

namespace printExplore
{
//! \brief Result of an exploration.
struct Exploration {
  std::vector<Outcome> outcomes;  //!< In the order of the setup's designs.
  std::vector<std::size_t> front; //!< Indices of the Pareto front, ascending, among designs that meet the requirements.
  std::ptrdiff_t best = -1;       //!< Best compromise on the front; -1: none.
  std::size_t feasible = 0;       //!< Number of feasible designs.
  std::size_t required = 0;       //!< Number of feasible designs that meet the requirements.
};

//! The designs as cases; refers to \e setup.
[[nodiscard]] vpApp::Sweep sweepOf(const Setup &setup);

/*!
 * Evaluate all designs, with progress on stderr. The result does not depend on the number of ranks or threads.
 * \param jobs : Threads of this rank; 0: its share of the cores.
 * \return The result on rank 0; empty elsewhere.
 * \throw vpApp::Interrupted after Ctrl-C.
 */
[[nodiscard]] Exploration explore(const Setup &setup, const vpApp::Ranks &ranks, unsigned int jobs);

//! Front, requirements and compromise of outcomes.
[[nodiscard]] Exploration judge(const Setup &setup, std::vector<Outcome> outcomes);
} // namespace printExplore

#endif
