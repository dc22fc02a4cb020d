/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pareto.h
 * \brief Pareto-optimal designs, and the best compromise among them.
 */
#ifndef printExplore_pareto_h
#define printExplore_pareto_h

#include <cstddef>
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
} // namespace printExplore

#endif
