/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file exploration.h
 * \brief All designs of a setup, on all cores and ranks; the Pareto front and its best compromise.
 */
#ifndef printExplore_exploration_h
#define printExplore_exploration_h

#include "outcome.h"
#include "sweep.h"

#include <cstddef>
#include <string>
#include <vector>

namespace printExplore
{
//! One cost per objective: less is better.
using Costs = std::vector<double>;

//! True if \e a is worse than \e b in no objective and better in at least one.
[[nodiscard]] bool dominates(const Costs &a, const Costs &b);

/*!
 * Indices of the non-dominated points, ascending. Equal points are kept or removed together.
 * \param points : Finite, all of the same size.
 */
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<Costs> &points);

/*!
 * The best compromise: with each objective scaled to 0..1 over the points, the one closest to the ideal point, which
 * has the least cost in every objective. The first of equal ones.
 * \param points : At least one.
 */
[[nodiscard]] std::size_t compromise(const std::vector<Costs> &points);

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

//! The objectives of an outcome as costs.
[[nodiscard]] Costs costsOf(const Outcome &outcome, const std::vector<std::string> &objectives);
} // namespace printExplore

#endif
