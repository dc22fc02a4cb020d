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
#include "ranks.h"

#include <cstddef>
#include <vector>

namespace printExplore
{
//! \brief What an exploration found.
struct Exploration {
  std::vector<Outcome> outcomes;  //!< By the order of the setup's designs.
  std::vector<std::size_t> front; //!< Indices of the Pareto front, ascending; of designs that keep what is required.
  std::ptrdiff_t best = -1;       //!< The compromise among these; -1: none.
  std::size_t feasible = 0;       //!< Designs that work.
  std::size_t required = 0;       //!< Of these, those that keep what is required.
};

/*!
 * Which designs each rank evaluates: the longest ones first, each to the rank with the least to do. The same on every rank.
 * \return For each rank the indices of its designs.
 */
[[nodiscard]] std::vector<std::vector<std::size_t>> shareOut(const Setup &setup, int ranks);

/*!
 * Evaluate all designs, with progress on stderr. The result does not depend on the number of ranks or threads.
 * \param jobs : Threads of this rank; 0: its share of the cores.
 * \return On rank 0 everything; elsewhere nothing.
 * \throw vpApp::Interrupted after Ctrl-C.
 */
[[nodiscard]] Exploration explore(const Setup &setup, const Ranks &ranks, unsigned int jobs);

//! Front, requirements and compromise of outcomes.
[[nodiscard]] Exploration judge(const Setup &setup, std::vector<Outcome> outcomes);
} // namespace printExplore

#endif
