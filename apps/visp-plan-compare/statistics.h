/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file statistics.h
 * \brief Statistical inference from success counts.
 */
#ifndef planCompare_statistics_h
#define planCompare_statistics_h

#include <vector>

namespace planCompare
{
//! \brief Interval of a proportion, 0..1.
struct Interval {
  double low = 0.;
  double high = 1.;
};

/*!
 * Wilson's score interval without continuity correction, 95 %. \cite Wilson 1927, J. Am. Stat. Assoc. 22, 209-212
 * \param successes : 0..total. \param total : >= 0; for 0 trials the interval is [0, 1].
 */
[[nodiscard]] Interval wilson(int successes, int total);

/*!
 * McNemar's exact test, two-sided: probability of a split at least this uneven if both perform equally well.
 * \param onlyFirst, onlySecond : Pairs in which only one of the two succeeded; >= 0. \return p, 1 when there are none.
 */
[[nodiscard]] double mcNemar(int onlyFirst, int onlySecond);
} // namespace planCompare

#endif
