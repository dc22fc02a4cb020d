/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Searches known cells that are not at their expected positions among the spots of the image: the missed ones, and all
// of them after a jump.
#include "vpPatternTrackerImpl.h"

#include "vpSubsampledHistogram.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double nearHalf = 0.4; // of a pitch: beyond it the neighbour may have been matched

double middleX(const vpPatternSpot &spot) { return 0.5 * (spot.left + spot.right); }
double middleY(const vpPatternSpot &spot) { return 0.5 * (spot.top + spot.bottom); }
} // namespace

// The spot with the nearest box centre, or null.
const vpPatternSpot *vpPatternTracker::Impl::spotAt(double x, double y, double reach) const
{
  const vpPatternSpot *best = nullptr;
  double least = reach * reach;
  for (const vpPatternSpot &spot : m_labels.spots()) {
    const double dx = middleX(spot) - x, dy = middleY(spot) - y, d = dx * dx + dy * dy;
    if (d < least) {
      least = d;
      best = &spot;
    }
  }
  return best;
}

bool vpPatternTracker::Impl::findSpots(const vpImage<unsigned char> &image)
{
  const vpPatternThresholdResult level = vpFindThreshold(vpSubsampledHistogram(image), m_spec.threshold);
  return level.threshold >= 0 && m_labels.find(image, level.threshold, m_bright, vpRunLabels::leastArea);
}

// A pattern that turns in perspective leaves its lattice: a cell missed at its expected position may appear as a spot
// beside it. That spot is then its deviation in the next image.
void vpPatternTracker::Impl::lookForMissing(const vpImage<unsigned char> &image)
{
  if (!findSpots(image)) {
    return;
  }
  const double pitch = std::min(std::hypot(m_lattice.ax, m_lattice.ay), std::hypot(m_lattice.bx, m_lattice.by));
  const double reach = std::clamp(0.12 * pitch, 2., 8.);
  for (const vpPatternCell &cell : m_frame.cells) {
    vpCellMemory::Slot *slot = m_memory.find(cell.row, cell.column);
    if (cell.valid || slot == nullptr) { // only former cells
      continue;
    }
    const double x = m_lattice.x(cell.row - m_row, cell.column - m_column);
    const double y = m_lattice.y(cell.row - m_row, cell.column - m_column);
    const vpPatternSpot *spot = spotAt(x + slot->offsetX, y + slot->offsetY, reach);
    if (spot != nullptr && spot->width() < 2 * m_bank.halfWidth() && spot->height() < 2 * m_bank.halfHeight()) {
      slot->offsetX = middleX(*spot) - x;
      slot->offsetY = middleY(*spot) - y;
      slot->count = 1;
    }
  }
}

// The lattice is known, but has jumped out of the template's reach, and the spots alone do not determine it, among
// outliers or in perspective: finds the shift that brings the known cells of the last lock onto spots, and the rotation
// of the lattice. False: less than three cells, or less than two thirds of them.
bool vpPatternTracker::Impl::relocate(const vpImage<unsigned char> &image)
{
  constexpr std::size_t tested = 12; // cells
  if (!findSpots(image)) {
    return false;
  }
  m_lattice.ox += m_vx * (m_lostFrames + 1);
  m_lattice.oy += m_vy * (m_lostFrames + 1);
  listCells(m_bank.halfWidth() + 0.5, m_bank.halfHeight() + 0.5);
  expectCells(true);
  std::array<std::size_t, tested> cells{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < m_frame.cells.size() && n < tested; ++i) {
    if (m_ownStart[i] != 0) {
      cells[n++] = i;
    }
  }
  vpLattice unit = m_lattice;
  unit.ox = unit.oy = 0.;
  const double pitch = std::min(std::hypot(unit.ax, unit.ay), std::hypot(unit.bx, unit.by));
  const double reach = std::clamp(0.08 * pitch, 2., 8.);
  std::size_t most = 0;
  double dx = 0., dy = 0., least = 0.; // sum of the residuals
  for (std::size_t k = 0; k < n; ++k) {
    for (const vpPatternSpot &spot : m_labels.spots()) {
      const double sx = middleX(spot) - m_startX[cells[k]], sy = middleY(spot) - m_startY[cells[k]];
      double row = 0., column = 0.;
      unit.invert(sx, sy, row, column);
      if (std::abs(row) > nearHalf || std::abs(column) > nearHalf) {
        continue;
      }
      std::size_t count = 0;
      double sum = 0.;
      for (std::size_t i = 0; i < n; ++i) {
        const double x = m_startX[cells[i]] + sx, y = m_startY[cells[i]] + sy;
        if (const vpPatternSpot *at = spotAt(x, y, reach)) {
          ++count;
          sum += std::hypot(middleX(*at) - x, middleY(*at) - y);
        }
      }
      if (count > most || (count == most && sum < least)) {
        most = count;
        least = sum;
        dx = sx;
        dy = sy;
      }
    }
  }
  if (most < 3 || 3 * most < 2 * n) {
    return false;
  }
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const double x = m_startX[cells[i]], y = m_startY[cells[i]];
    if (const vpPatternSpot *at = spotAt(x + dx, y + dy, reach)) {
      const vpPatternCell &cell = m_frame.cells[cells[i]];
      const Eigen::Vector3d a(1., cell.column - m_column, cell.row - m_row);
      normal += a * a.transpose();
      right += a * Eigen::RowVector2d(middleX(*at) - x, middleY(*at) - y);
    }
  }
  normal.diagonal().tail<2>().array() += 1e-3; // one row or one column alone does not determine the other vector
  const Eigen::Matrix<double, 3, 2> s = normal.ldlt().solve(right);
  m_lattice.ox += s(0, 0);
  m_lattice.oy += s(0, 1);
  m_lattice.ax += s(1, 0);
  m_lattice.ay += s(1, 1);
  m_lattice.bx += s(2, 0);
  m_lattice.by += s(2, 1);
  return true;
}

END_VISP_NAMESPACE
