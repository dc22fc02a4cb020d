/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpCellVelocity.h>

#include "vpUsableCell.h"

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
//! Weighted mean of one axis.
struct Mean {
  double sum = 0., weight = 0.;
  void add(double value, double variance)
  {
    sum += value / variance;
    weight += 1. / variance;
  }
};
} // namespace

vpCellVelocity vpFindCellVelocity(const vpPatternCell *before, std::size_t beforeCount, const vpPatternCell *now,
                                  std::size_t nowCount, double frames) noexcept
{
  vpCellVelocity result;
  if (!vpIsPlausibleDeviation(frames)) { // same range as a deviation
    return result;
  }
  Mean x, y;
  std::size_t hint = 0; // index where the search begins: after the last match
  for (std::size_t i = 0; i < nowCount; ++i) {
    const vpPatternCell &b = now[i];
    if (!vpIsUsableCell(b)) {
      continue;
    }
    for (std::size_t k = 0; k < beforeCount; ++k) {
      const std::size_t index = (hint + k) % beforeCount;
      const vpPatternCell &a = before[index];
      if (a.row == b.row && a.column == b.column) {
        hint = index + 1;
        if (vpIsUsableCell(a)) {
          x.add(b.x - a.x, a.sigmaX * a.sigmaX + b.sigmaX * b.sigmaX);
          y.add(b.y - a.y, a.sigmaY * a.sigmaY + b.sigmaY * b.sigmaY);
          ++result.cells;
        }
        break;
      }
    }
  }
  if (result.cells > 0) {
    result.vx = x.sum / x.weight / frames;
    result.vy = y.sum / y.weight / frames;
    result.sigmaX = 1. / std::sqrt(x.weight) / frames;
    result.sigmaY = 1. / std::sqrt(y.weight) / frames;
  }
  return result;
}

END_VISP_NAMESPACE
