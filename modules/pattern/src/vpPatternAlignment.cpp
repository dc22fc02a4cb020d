/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A frame of a pattern that is known: align the template with every cell, drop what does not fit, follow the lattice.
#include "vpPatternTrackerImpl.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double dirty = 1.4;       // residual variance over the usual one: masking is tried above it
constexpr double hopeless = 1.7;    // the same after masking: no such cell
constexpr double knownGate = 0.5;   // px: how far a known cell may move against the others in one frame
constexpr double nearHalf = 0.4;    // of a pitch
constexpr double maskedSigma = 0.1; // px: what dirt does to a centre although its pixels are left out (rendered dirt)
constexpr double latticeGain = 0.02;
constexpr double slopeMemory = 400.; // cells
constexpr std::size_t slopesEvery = 3; // cells, once they are known: they change slowly
} // namespace

bool vpPatternTracker::Impl::alignAll(const vpImage<unsigned char> &image)
{
  listCells(m_bank.halfWidth() + 0.5, m_bank.halfHeight() + 0.5);
  const std::size_t n = m_frame.cells.size();
  m_fits.resize(n);
  m_startX.resize(n);
  m_startY.resize(n);
  m_ownStart.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const vpPatternCell &cell = m_frame.cells[i];
    if (i + 1 < n) {
      m_aligner.prefetch(image, m_bank, m_frame.cells[i + 1].x, m_frame.cells[i + 1].y);
    }
    double x = 0., y = 0.;
    // What left the view and comes back is remembered, but the lattice has moved on since.
    const vpCellMemory::Slot *slot = m_memory.find(cell.row, cell.column);
    m_ownStart[i] = m_memory.deviation(cell.row, cell.column, x, y) && wasInLast(*slot) ? 1 : 0;
    m_startX[i] = cell.x + x;
    m_startY[i] = cell.y + y;
    m_fits[i] = m_aligner.align(image, m_bank, m_startX[i], m_startY[i], m_slopeWeight < slopeMemory || (i + m_frame.index) % slopesEvery == 0);
  }
  validate(image);
  return m_frame.validCells >= 1 && 5 * m_frame.validCells >= static_cast<int>(n);
}

void vpPatternTracker::Impl::validate(const vpImage<unsigned char> &image)
{
  const std::size_t n = m_frame.cells.size();
  const auto median = [&](auto value) {
    m_scratch.clear();
    for (std::size_t i = 0; i < n; ++i) {
      if (m_fits[i].ok) {
        m_scratch.push_back(value(i));
      }
    }
    return vpRobustMean::median(m_scratch);
  };
  // The usual residuals, whether the light changes or most cells are dirty.
  const double now = median([&](std::size_t i) { return m_fits[i].variance; });
  const double usual = m_noise > 0. ? std::clamp(now, 0.5 * m_noise, 2. * m_noise) : std::max(now, 0.05);
  // The template is not perfect: a hundredth of its range is nothing to look into.
  const double allowance = std::pow(0.01 * m_bank.range(), 2);
  const double contrast = median([&](std::size_t i) { return m_fits[i].contrast; });
  const double shiftX = median([&](std::size_t i) { return m_fits[i].x - m_startX[i]; });
  const double shiftY = median([&](std::size_t i) { return m_fits[i].y - m_startY[i]; });
  const double pitch = std::min(std::hypot(m_lattice.ax, m_lattice.ay), std::hypot(m_lattice.bx, m_lattice.by));
  const double newGate = std::clamp(0.12 * pitch, 0.5, 4.);
  for (std::size_t i = 0; i < n; ++i) {
    vpCellFit &fit = m_fits[i];
    const double gate = m_ownStart[i] != 0 ? std::min(knownGate, newGate) : newGate;
    const auto near = [&](const vpCellFit &f) {
      const double dx = f.x - m_startX[i] - shiftX, dy = f.y - m_startY[i] - shiftY;
      return dx * dx + dy * dy < gate * gate;
    };
    if (!fit.ok || fit.variance > dirty * usual + allowance || !near(fit)) {
      fit = m_aligner.alignMasked(image, m_bank, m_startX[i] + shiftX, m_startY[i] + shiftY, std::sqrt(usual));
    }
    vpPatternCell &cell = m_frame.cells[i];
    const double hidden = fit.masked ? maskedSigma * maskedSigma : 0.;
    const double sx = std::sqrt(fit.variance * fit.xx + hidden), sy = std::sqrt(fit.variance * fit.yy + hidden);
    cell.valid = fit.ok && fit.variance < hopeless * usual + allowance && fit.contrast > 0.5 * contrast &&
                 fit.contrast < 2. * contrast && near(fit) && sx < m_options.maxCellSigma &&
                 sy < m_options.maxCellSigma;
    if (cell.valid) {
      cell.x = fit.x;
      cell.y = fit.y;
      cell.sigmaX = sx;
      cell.sigmaY = sy;
      ++m_frame.validCells;
    }
  }
  vpSlopes sum{};
  int clean = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (m_frame.cells[i].valid && m_fits[i].hasSlopes) {
      ++clean;
      for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] += m_fits[i].slopes[k];
      }
    }
  }
  if (clean > 0) {
    // Few cells say little. From the first image on the mean of all that was seen, later the recent past.
    m_slopeWeight = std::min(m_slopeWeight + clean, slopeMemory);
    for (std::size_t k = 0; k < sum.size(); ++k) {
      m_slopes[k] += (sum[k] - clean * m_slopes[k]) / m_slopeWeight;
    }
    m_aligner.setSlopes(m_slopes);
  }
  if (2 * m_frame.validCells >= static_cast<int>(n) && m_frame.validCells > 0) {
    m_noise += (m_noise > 0. ? 0.1 : 1.) * (usual - m_noise);
  }
}

// Move the lattice onto the cells. False when the cells that are known do not deviate from it as before.
bool vpPatternTracker::Impl::updateLattice()
{
  const std::size_t n = m_frame.cells.size();
  bool anyKnown = false;
  for (std::size_t i = 0; i < n; ++i) {
    anyKnown = anyKnown || (m_frame.cells[i].valid && m_ownStart[i] != 0);
  }
  m_meanX.clear();
  m_meanY.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const vpPatternCell &cell = m_frame.cells[i];
    if (cell.valid && (!anyKnown || m_ownStart[i] != 0)) {
      m_meanX.add(cell.x - m_startX[i], cell.sigmaX * cell.sigmaX);
      m_meanY.add(cell.y - m_startY[i], cell.sigmaY * cell.sigmaY);
    }
  }
  const double dx = m_meanX.mean().value, dy = m_meanY.mean().value;
  m_lattice.ox += dx;
  m_lattice.oy += dy;
  m_scratch.clear();
  double sigma = 0.;
  for (std::size_t i = 0; i < n; ++i) {
    const vpPatternCell &cell = m_frame.cells[i];
    if (cell.valid && m_ownStart[i] != 0) {
      const double ex = cell.x - m_startX[i] - dx, ey = cell.y - m_startY[i] - dy;
      m_scratch.push_back(std::sqrt(ex * ex + ey * ey));
      sigma += std::sqrt(cell.sigmaX * cell.sigmaX + cell.sigmaY * cell.sigmaY);
    }
  }
  const std::size_t known = m_scratch.size();
  return known < 4 || vpRobustMean::median(m_scratch) < std::max(0.1, 6. * sigma / static_cast<double>(known));
}

void vpPatternTracker::Impl::follow(const vpImage<unsigned char> &image)
{
  const vpLattice last = m_lattice;
  m_lattice.ox += m_vx * (m_lostFrames + 1);
  m_lattice.oy += m_vy * (m_lostFrames + 1);
  vpPatternReason note = vpPatternReason::None;
  const bool late = m_lostFrames > m_options.maxLostFrames;
  if (late || !alignAll(image)) {
    // Not where it should be: look at the whole image.
    m_lattice = last;
    vpLattice found;
    vpPatternReason reason = detect(image, found);
    if (reason == vpPatternReason::None) {
      note = adopt(found);
      if (m_stage != Stage::Locked) { // another pattern: learn it
        acquire(image);
        return;
      }
      reason = alignAll(image) ? vpPatternReason::None : vpPatternReason::NoMatch;
    }
    if (reason != vpPatternReason::None) {
      m_lattice = last;
      lose(reason, vpPatternStatus::Lost);
      return;
    }
  }
  const bool consistent = updateLattice();
  vpLattice unit = m_lattice;
  unit.ox = unit.oy = 0.;
  double row = 0., column = 0.;
  unit.invert(m_lattice.ox - last.ox, m_lattice.oy - last.oy, row, column);
  const double frames = m_lostFrames + 1;
  if (std::abs(row) > nearHalf * frames || std::abs(column) > nearHalf * frames) {
    note = vpPatternReason::AmbiguousMotion;
  }
  else if (!consistent && note == vpPatternReason::None) {
    note = vpPatternReason::IdentitySlip;
  }
  if (note == vpPatternReason::AmbiguousMotion || note == vpPatternReason::IdentitySlip) {
    renumber(note);
  }
  m_vx = (m_lattice.ox - last.ox) / frames;
  m_vy = (m_lattice.oy - last.oy) / frames;
  measureMotion();
  updateDeviations();
  remember();
  anchor();
  m_lostFrames = 0;
  const bool few = 2 * m_frame.validCells < static_cast<int>(m_frame.cells.size());
  m_frame.reason = note != vpPatternReason::None ? note : few ? vpPatternReason::CellsMissing : vpPatternReason::None;
  m_frame.status = m_frame.reason == vpPatternReason::None ? vpPatternStatus::Tracking : vpPatternStatus::Degraded;
}

// What is common to the deviations belongs to the lattice; the rest stays with the cells.
void vpPatternTracker::Impl::updateDeviations()
{
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (const vpPatternCell &cell : m_frame.cells) {
    if (cell.valid) {
      const int r = cell.row - m_row, c = cell.column - m_column;
      const Eigen::Vector3d a(1., c, r);
      normal += a * a.transpose();
      right += a * Eigen::RowVector2d(cell.x - m_lattice.x(r, c), cell.y - m_lattice.y(r, c));
    }
  }
  normal(1, 1) += 1e-3; // one row or one column alone says nothing about the other vector
  normal(2, 2) += 1e-3;
  Eigen::Matrix<double, 3, 2> s = Eigen::Matrix<double, 3, 2>::Zero();
  if (normal(0, 0) > 0.5) {
    s = latticeGain * normal.inverse() * right;
    m_lattice.ox += s(0, 0);
    m_lattice.oy += s(0, 1);
    m_lattice.ax += s(1, 0);
    m_lattice.ay += s(1, 1);
    m_lattice.bx += s(2, 0);
    m_lattice.by += s(2, 1);
  }
  for (vpPatternCell &cell : m_frame.cells) {
    const int r = cell.row - m_row, c = cell.column - m_column;
    vpCellMemory::Slot *slot = m_memory.find(cell.row, cell.column);
    if (slot != nullptr) { // the same place as before, seen from the lattice that has moved
      slot->offsetX -= s(0, 0) + c * s(1, 0) + r * s(2, 0);
      slot->offsetY -= s(0, 1) + c * s(1, 1) + r * s(2, 1);
    }
    if (cell.valid) {
      vpCellMemory::Slot &own = m_memory.claim(cell.row, cell.column);
      own.count = wasInLast(own) ? own.count : 0;
      own.count = std::min(own.count + 1, 20);
      own.offsetX += (cell.x - m_lattice.x(r, c) - own.offsetX) / own.count;
      own.offsetY += (cell.y - m_lattice.y(r, c) - own.offsetY) / own.count;
      slot = &own;
    }
    cell.deviationX = slot != nullptr ? slot->offsetX : 0.;
    cell.deviationY = slot != nullptr ? slot->offsetY : 0.;
  }
}

END_VISP_NAMESPACE
