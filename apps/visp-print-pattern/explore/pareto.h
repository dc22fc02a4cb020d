/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pareto.h
 * \brief Designs that no other one beats in every respect, and the best compromise among them.
 */
#ifndef printExplore_pareto_h
#define printExplore_pareto_h

#include <cstddef>
#include <vector>

namespace printExplore
{
//! A point with a cost per objective: less is better.
using Costs = std::vector<double>;

//! True if \e a is nowhere worse than \e b and better in at least one objective.
[[nodiscard]] bool dominates(const Costs &a, const Costs &b);

/*!
 * Indices of the points that no other one dominates, ascending. Equal points stay or go together.
 * \param points : All of the same size, finite.
 */
[[nodiscard]] std::vector<std::size_t> paretoFront(const std::vector<Costs> &points);

/*!
 * The best compromise: with each objective scaled to 0..1 over the points, the one nearest to the ideal point, which has the
 * least cost in every objective. The first of equal ones.
 * \param points : At least one.
 */
[[nodiscard]] std::size_t compromise(const std::vector<Costs> &points);
} // namespace printExplore

#endif
