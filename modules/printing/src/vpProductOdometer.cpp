/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpProductOdometer.h>
#include <visp3/printing/vpCellVelocity.h>

#include "vpPrintingCheck.h"

#include <algorithm>
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

vpProductOdometer::vpProductOdometer(int capacity)
{
  vpPrintingCheck::require(capacity >= 1 && capacity <= 65536, "capacity", "product odometer", capacity,
                           "in [1, 65536]");
  m_last.resize(static_cast<std::size_t>(capacity));
}

void vpProductOdometer::reset() noexcept
{
  m_count = 0;
  m_started = false;
  m_output = Output();
}

const vpProductOdometer::Output &vpProductOdometer::step(const vpPatternCell *cells, std::size_t count,
                                                         unsigned int epoch, double predictedX,
                                                         double predictedY) noexcept
{
  const std::size_t used = cells == nullptr ? 0 : std::min(count, m_last.size());
  const vpCellVelocity moved =
      m_started && epoch == m_epoch ? vpFindCellVelocity(m_last.data(), m_count, cells, used) : vpCellVelocity();
  m_output.measured = moved.cells > 0;
  m_output.cells = moved.cells;
  const bool predicted = vpIsPlausible(predictedX) && vpIsPlausible(predictedY);
  m_output.lost = m_output.lost || (m_started && !m_output.measured && !predicted);
  m_output.dx = m_output.measured ? moved.vx : predicted ? predictedX : 0.;
  m_output.dy = m_output.measured ? moved.vy : predicted ? predictedY : 0.;
  m_output.sigmaX = moved.sigmaX;
  m_output.sigmaY = moved.sigmaY;
  if (m_started) {
    m_output.x += m_output.dx;
    m_output.y += m_output.dy;
  }
  std::copy_n(cells, used, m_last.begin());
  m_count = used;
  m_epoch = epoch;
  m_started = true;
  return m_output;
}

END_VISP_NAMESPACE
