/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file comparison.h
 * \brief Results compared with the ground truth.
 */
#ifndef trackPattern_comparison_h
#define trackPattern_comparison_h

#include "results.h"
#include "truth.h"

#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace trackPattern
{
/*!
 * \brief Compares frame by frame; stores which true cell each name belongs to.
 */
class Comparison
{
public:
  //! \param left, top : Corner of the tracked region, px. Sets the true displacement in \e record.
  void add(const vpPatternFrame &frame, const FrameTruth &truth, double left, double top, FrameRecord &record,
           RunResults &results);
  //! A frame without truth interrupts the displacements.
  void skip() { m_before.reset(); }

private:
  std::optional<FrameTruth> m_before;
  std::map<std::tuple<unsigned int, int, int>, std::pair<int, int>> m_names;
};
} // namespace trackPattern

#endif
