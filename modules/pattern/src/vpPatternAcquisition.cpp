/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Lattice from an image without prior knowledge, and learning of the template.
// Search of known cells that are not at their expected positions among the spots of the image: the missed ones, and all
// of them after a jump.
#include "vpPatternTrackerImpl.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double leastSeparability = 0.7; // noise alone has 0.64
constexpr int windowsPerFrame = 4;
constexpr double nearHalf = 0.4; // of a pitch: beyond it the neighbour may have been matched

// Every second row and column of large images, which suffices for the threshold. Two at a time: neighbours often have
// the same value, and a count that was just written cannot be read at once.
vpPatternHistogram subsampledHistogram(const vpImage<unsigned char> &image)
{
  vpPatternHistogram h{}, other{};
  const unsigned int step = image.getSize() > 4096 ? 2 : 1, width = image.getWidth();
  for (unsigned int y = 0; y < image.getHeight(); y += step) {
    const unsigned char *row = image[y];
    unsigned int x = y / step % step;
    for (; x + step < width; x += 2 * step) {
      ++h[row[x]];
      ++other[row[x + step]];
    }
    if (x < width) {
      ++h[row[x]];
    }
  }
  for (std::size_t g = 0; g < h.size(); ++g) {
    h[g] += other[g];
  }
  return h;
}

double middleX(const vpPatternSpot &spot) { return 0.5 * (spot.left + spot.right); }
double middleY(const vpPatternSpot &spot) { return 0.5 * (spot.top + spot.bottom); }
} // namespace

vpPatternReason vpPatternTracker::Impl::detectPolarity(const vpImage<unsigned char> &image,
                                                       const vpPatternThresholdResult &level, bool bright,
                                                       vpLattice &lattice)
{
  if (!m_labels.find(image, level.threshold, bright, vpRunLabels::leastArea)) {
    return vpPatternReason::TooMuchNoise;
  }
  std::vector<vpPatternSpot> &spots = m_labels.spots();
  // While learning in a view of hardly two periods, many images show fewer than four cells.
  const bool few = spots.size() < 4 && m_stage != Stage::Searching;
  if (few ? !m_fitter.keepKnown(spots) : !m_fitter.keepAlike(spots)) {
    return vpPatternReason::NoCells;
  }
  const double half = 0.5 * (level.darkMean + level.brightMean);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    vpPatternSpot spot = spots[i];
    bool good = false;
    switch (m_spec.method) {
    case vpPatternMethod::ThesisAlgorithm:
      good = vpThesisCentre(image, m_spec.derivative, spot);
      break;
    case vpPatternMethod::ThesisAlgorithmFixed:
      good = vpThesisCentreFixed(image, m_spec.derivative, spot);
      break;
    case vpPatternMethod::GaussNewton:
    case vpPatternMethod::HalfMaximumEdges:
      good = vpHalfMaximumCentre(image, m_light.level(half), spot);
      break;
    }
    // A centre outside its box is a diverged parabola of Algorithm 7.4.
    if (good && spot.x > spot.left && spot.x < spot.right && spot.y > spot.top && spot.y < spot.bottom) {
      spots[kept++] = spot;
    }
  }
  spots.resize(kept);
  if (few && kept > 0) {
    lattice = m_lattice;
    return m_fitter.shift(spots, lattice) ? vpPatternReason::None : vpPatternReason::NoLattice;
  }
  if (kept < 4) {
    return vpPatternReason::NoLattice;
  }
  if (!m_fitter.fit(spots, m_spec.minPitch, lattice)) {
    return m_fitter.trouble(spots);
  }
  const bool usesLevel =
      m_spec.method == vpPatternMethod::GaussNewton || m_spec.method == vpPatternMethod::HalfMaximumEdges;
  const bool first = !m_light.isKnown();
  if (usesLevel && m_light.see(image, spots, lattice) && first) { // the centres of this image do not know it yet
    for (vpPatternSpot &spot : spots) {
      vpPatternSpot again = spot;
      spot = vpHalfMaximumCentre(image, m_light.level(half), again) ? again : spot;
    }
  }
  vpLatticeFit::removeDirty(spots);
  return vpPatternReason::None;
}

vpPatternReason vpPatternTracker::Impl::detect(const vpImage<unsigned char> &image, vpLattice &lattice)
{
  const vpPatternThresholdResult level = vpFindThreshold(subsampledHistogram(image), m_spec.threshold);
  if (level.threshold < 0 || level.brightMean - level.darkMean < m_spec.minContrast ||
      level.separability < leastSeparability) {
    return vpPatternReason::NoContrast;
  }
  if (m_spec.polarity != vpPatternPolarity::Automatic) {
    return detectPolarity(image, level, m_spec.polarity == vpPatternPolarity::Bright, lattice);
  }
  vpPatternReason reason = detectPolarity(image, level, m_bright, lattice);
  if (reason != vpPatternReason::None && !m_known) {
    const vpPatternReason other = detectPolarity(image, level, !m_bright, lattice);
    m_bright = other == vpPatternReason::None ? !m_bright : m_bright;
    // Which of two failures is reported: the one that got further.
    reason = other == vpPatternReason::None || reason == vpPatternReason::NoCells ? other : reason;
  }
  return reason;
}

// Take over a lattice found without prior knowledge: the cells keep their indices when possible.
vpPatternReason vpPatternTracker::Impl::adopt(const vpLattice &found)
{
  const double dax = found.ax - m_lattice.ax, day = found.ay - m_lattice.ay;
  const double dbx = found.bx - m_lattice.bx, dby = found.by - m_lattice.by;
  const bool same = m_known && std::hypot(dax, day) < 0.05 * std::hypot(found.ax, found.ay) &&
                    std::hypot(dbx, dby) < 0.08 * std::hypot(found.bx, found.by);
  if (!same || m_lostFrames > m_spec.maxLostFrames) {
    const bool again = m_known;
    m_known = true;
    m_lattice = found;
    m_row = m_column = 0;
    const Range range = inView(0., 0.);
    m_memory.shape(range.rowHigh - range.rowLow + 3, range.columnHigh - range.columnLow + 3);
    m_turn = {0., 0., 0., 0., 0., 0.};
    m_vx = m_vy = 0.;
    if (!same) {
      m_stage = Stage::Learning;
      m_learned = 0;
      m_bank.clear();
    }
    m_frame.epoch += again ? 1 : 0;
    const bool missing = m_interrupted;
    m_interrupted = false;
    return missing ? vpPatternReason::ImagesMissing : again ? vpPatternReason::Restarted : vpPatternReason::None;
  }
  // The known vectors are better than those of one image, and the deviations refer to them. Compare where both lattices
  // have a point near the middle of the view: there an error of the vectors matters least.
  double row = 0., column = 0.;
  found.invert(0.5 * (m_width - 1.), 0.5 * (m_height - 1.), row, column);
  const double px = found.x(std::round(row), std::round(column)), py = found.y(std::round(row), std::round(column));
  // From one image to the next the smallest motion is assumed; after a loss, a continued motion.
  const double frames = m_lostFrames;
  m_lattice.ox += frames * m_vx;
  m_lattice.oy += frames * m_vy;
  double dx = px - m_lattice.ox, dy = py - m_lattice.oy;
  m_lattice.reduce(dx, dy);
  m_lattice.ox += dx;
  m_lattice.oy += dy;
  vpLattice unit = m_lattice;
  unit.ox = unit.oy = 0.;
  unit.invert(dx, dy, row, column);
  if (std::abs(row) > nearHalf || std::abs(column) > nearHalf) {
    return vpPatternReason::AmbiguousMotion;
  }
  return vpPatternReason::None;
}

// A frame measured by its edges: while learning, and always with the baselines.
void vpPatternTracker::Impl::acquire(const vpImage<unsigned char> &image)
{
  vpLattice found;
  const vpPatternReason reason = detect(image, found);
  if (reason != vpPatternReason::None) {
    lose(reason, m_known ? vpPatternStatus::Lost : vpPatternStatus::Acquiring);
    return;
  }
  const vpPatternReason note = adopt(found);
  if (m_stage == Stage::Searching) {
    m_stage = Stage::Learning;
  }
  if (note == vpPatternReason::AmbiguousMotion) {
    renumber(note);
  }
  cellsFromSpots();
  m_fits.assign(m_frame.cells.size(), vpCellFit()); // none is in doubt
  updateLattice();
  measureMotion();
  updateDeviations();
  remember();
  anchor();
  m_lostFrames = 0;
  if (m_stage == Stage::Learning && m_learned == 0) {
    m_share = 0.;
  }
  const bool baseline = m_spec.method != vpPatternMethod::GaussNewton;
  if (note != vpPatternReason::None) {
    m_frame.status = vpPatternStatus::Degraded;
    m_frame.reason = note;
  }
  else if (baseline) {
    const bool few = 2. * m_frame.validCells < usualCells();
    m_frame.status = few ? vpPatternStatus::Degraded : vpPatternStatus::Tracking;
    m_frame.reason = few ? vpPatternReason::CellsMissing : vpPatternReason::None;
  }
  else {
    m_frame.status = vpPatternStatus::Acquiring;
    m_frame.reason = vpPatternReason::Learning;
  }
  updateShare();
  if (!baseline) {
    learn(image);
  }
}

void vpPatternTracker::Impl::cellsFromSpots()
{
  listCells(0.5 * m_fitter.medianWidth() + 1., 0.5 * m_fitter.medianHeight() + 1.);
  expectCells(true);
  for (std::size_t i = 0; i < m_frame.cells.size(); ++i) {
    vpCellMemory::Slot &slot = m_memory.claim(m_frame.cells[i].row, m_frame.cells[i].column);
    slot.cell = static_cast<int>(i);
  }
  const double unknown = std::numeric_limits<double>::infinity();
  for (const vpPatternSpot &spot : m_labels.spots()) {
    double row = 0., column = 0.;
    m_lattice.invert(spot.x, spot.y, row, column);
    const int r = m_row + static_cast<int>(std::lround(row)), c = m_column + static_cast<int>(std::lround(column));
    const vpCellMemory::Slot &slot = m_memory.claim(r, c);
    const std::size_t i = static_cast<std::size_t>(slot.cell);
    if (slot.cell < 0 || i >= m_frame.cells.size() || m_frame.cells[i].row != r || m_frame.cells[i].column != c) {
      continue;
    }
    vpPatternCell &cell = m_frame.cells[i];
    cell.x = spot.x;
    cell.y = spot.y;
    cell.sigmaX = m_edgeVarianceX > 0. ? std::sqrt(m_edgeVarianceX) : unknown;
    cell.sigmaY = m_edgeVarianceY > 0. ? std::sqrt(m_edgeVarianceY) : unknown;
    m_frame.validCells += cell.valid ? 0 : 1;
    cell.valid = true;
  }
}

void vpPatternTracker::Impl::learn(const vpImage<unsigned char> &image)
{
  if (m_stage == Stage::Learning) {
    if (m_learned == 0) {
      const double gapX = std::hypot(m_lattice.ax, m_lattice.ay) - m_fitter.medianWidth();
      const double gapY = std::hypot(m_lattice.bx, m_lattice.by) - m_fitter.medianHeight();
      const int hw = static_cast<int>(std::ceil(0.5 * m_fitter.medianWidth() + std::clamp(0.5 * gapX + 0.5, 1.5, 3.)));
      const int hh = static_cast<int>(std::ceil(0.5 * m_fitter.medianHeight() + std::clamp(0.5 * gapY + 0.5, 1.5, 3.)));
      if (!m_learner.begin(hw, hh)) {
        m_frame.reason = vpPatternReason::NoLattice;
        return;
      }
    }
    ++m_learned;
    const std::size_t n = m_frame.cells.size();
    int taken = 0;
    for (std::size_t i = 0; i < n && taken < windowsPerFrame; ++i) {
      const vpPatternCell &cell = m_frame.cells[(i + static_cast<std::size_t>(m_rotate)) % n];
      taken += cell.valid && m_learner.add(image, cell.x, cell.y) ? 1 : 0;
    }
    m_rotate += windowsPerFrame;
    if (m_learned >= m_spec.learningFrames && m_learner.count() >= std::min(16, m_spec.learningFrames * 2)) {
      m_stage = m_learner.finish() ? Stage::Refining : Stage::Learning;
      m_learned = m_refined = 0;
    }
  }
  else if (m_stage == Stage::Refining) {
    // Twice: the second correction is small.
    const std::size_t n = m_frame.cells.size();
    int taken = 0;
    for (std::size_t i = 0; i < n && taken < windowsPerFrame; ++i) {
      const vpPatternCell &cell = m_frame.cells[(i + static_cast<std::size_t>(m_rotate)) % n];
      taken += cell.valid && m_learner.addResidual(image, cell.x, cell.y) ? 1 : 0;
    }
    m_rotate += windowsPerFrame;
    if (m_learner.residuals() >= windowsPerFrame * m_spec.learningFrames) {
      m_stage = m_learner.refine() ? m_stage : Stage::Learning;
      if (m_stage == Stage::Refining && ++m_refined == 2) {
        m_bank.begin(m_learner);
        m_stage = Stage::Preparing;
      }
    }
  }
  else if (m_stage == Stage::Preparing && m_bank.prepare(m_learner, m_spec.phasesPerFrame)) {
    m_stage = Stage::Locked;
    m_slopes = {};
    m_slopeWeight = 0.;
    setSlopes();
    m_noise = 0.;
    beginRefresh();
    // Measure this image again, as the next one will be: under uneven light, edges and template have slightly different
    // centres, and the difference is no motion. Twice: the first time determines the illumination gradients.
    if (alignAll(image) && alignAll(image)) {
      updateLattice();
      updateDeviations();
      remember();
    }
    else {
      cellsFromSpots();
    }
  }
}

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
  const vpPatternThresholdResult level = vpFindThreshold(subsampledHistogram(image), m_spec.threshold);
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
