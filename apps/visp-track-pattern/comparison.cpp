/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "comparison.h"

#include <cmath>

namespace trackPattern
{
namespace
{
constexpr double FAR = 2.; // px; larger errors are not caused by noise or bias

const vpPatternTruthCell *nearest(const FrameTruth &truth, double x, double y, double within)
{
  const vpPatternTruthCell *best = nullptr;
  for (const vpPatternTruthCell &cell : truth.cells) {
    const double distance = std::hypot(cell.x - x, cell.y - y);
    if (distance < within) {
      within = distance;
      best = &cell;
    }
  }
  return best;
}
} // namespace

void Comparison::add(const vpPatternFrame &frame, const FrameTruth &truth, double left, double top, FrameRecord &record,
                     RunResults &results)
{
  results.hasTruth = true;
  TruthErrors &errors = frame.status == vpPatternStatus::Acquiring ? results.acquiring : results.tracking;
  const double within = 0.5 * std::min(frame.lattice.columnPitch(), frame.lattice.rowPitch());
  for (const vpPatternCell &cell : frame.cells) {
    if (!cell.valid) {
      continue;
    }
    const vpPatternTruthCell *match = nearest(truth, cell.x + left, cell.y + top, within);
    if (match == nullptr) {
      ++errors.noCell;
      continue;
    }
    const double ex = cell.x + left - match->x, ey = cell.y + top - match->y;
    const auto name =
        m_names.emplace(std::make_tuple(frame.epoch, cell.row, cell.column), std::make_pair(match->row, match->column));
    errors.slips += name.first->second != std::make_pair(match->row, match->column) ? 1 : 0;
    if (std::hypot(ex, ey) > FAR) {
      ++errors.far; // would dominate the statistics
      continue;
    }
    errors.x.add(ex, cell.sigmaX);
    errors.y.add(ey, cell.sigmaY);
  }
  if (m_before) {
    record.trueDx = truth.x - m_before->x;
    record.trueDy = truth.y - m_before->y;
    if (frame.hasMotion) {
      errors.dx.add(frame.dx - record.trueDx, frame.sigmaDx);
      errors.dy.add(frame.dy - record.trueDy, frame.sigmaDy);
    }
  }
  m_before = truth;
}
} // namespace trackPattern
