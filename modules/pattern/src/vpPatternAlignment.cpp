/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A frame of a known pattern: align the template with every cell, drop misfits, track the lattice.
#include "vpPatternTrackerImpl.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double dirty = 1.4;       // residual variance over the usual one: masking is tried above it
constexpr double hopeless = 1.7;    // residual variance after masking: no such cell
constexpr double knownGate = 0.5;   // px: maximum motion of a known cell relative to the others in one frame
constexpr double nearHalf = 0.4;    // of a pitch
constexpr double maskedSigma = 0.1; // px: error of a centre due to masked dirt (rendered dirt)
constexpr double leastDoubt = 1.;   // px: of a cell whose visible edge may belong to another object
constexpr double latticeGain = 0.02;
constexpr unsigned int forgetAfter =
    20;                            // images: a deviation with which a cell is not found, perhaps that of something else
constexpr int hurryAfterTurn = 30; // images
constexpr int restlessAfterTurn = 10;  // images
constexpr double slopeMemory = 400.;   // cells
constexpr std::size_t slopesEvery = 3; // cells, once they are known: they change slowly

// Index into m_columns from startAll() to validate().
enum Column : std::size_t { offsetX, offsetY, variance, contrast, sigma };
} // namespace

bool vpPatternTracker::Impl::alignAll(const vpImage<unsigned char> &image)
{
  startAll(image);
  if (!deviateAsBefore()) {
    renumber(vpPatternReason::IdentitySlip); // forgets the deviations, so that all cells are new
    startAll(image);
    static_cast<void>(deviateAsBefore());
  }
  validate(image);
  if (mostKnownAreGone()) {
    // Perhaps other cells have taken their positions: check whether they fit without expected deviations.
    const int before = m_frame.validCells;
    startAll(image, false);
    static_cast<void>(deviateAsBefore());
    validate(image);
    if (m_frame.validCells > before + 1 && 3 * m_frame.validCells > 4 * before) {
      renumber(vpPatternReason::IdentitySlip);
    }
    else { // dirt, or an occlusion
      startAll(image);
      static_cast<void>(deviateAsBefore());
      validate(image);
    }
  }
  return m_frame.validCells >= 1 && m_frame.validCells >= 0.2 * usualCells();
}

// True if at least four and more than half of the last image's measured cells still in view are now missing.
bool vpPatternTracker::Impl::mostKnownAreGone() const
{
  int known = 0, gone = 0;
  for (std::size_t i = 0; i < m_frame.cells.size(); ++i) {
    known += m_ownStart[i] != 0 ? 1 : 0;
    gone += m_ownStart[i] != 0 && !m_frame.cells[i].valid ? 1 : 0;
  }
  return known >= 4 && 2 * gone > known;
}

// Align every cell from its lattice position and, when \e expected, its own deviation.
void vpPatternTracker::Impl::startAll(const vpImage<unsigned char> &image, bool expected)
{
  listCells(m_bank.halfWidth() + 0.5, m_bank.halfHeight() + 0.5);
  expectCells(expected);
  const std::size_t n = m_frame.cells.size();
  m_fits.resize(n);
  forCells([&](std::size_t i, int thread) {
    if (i + 1 < n) {
      vpCellAligner::prefetch(image, m_bank, m_startX[i + 1], m_startY[i + 1]);
    }
    const bool withSlopes = m_slopeWeight < slopeMemory || (i + m_frame.index) % slopesEvery == 0;
    m_fits[i] =
        m_aligners[static_cast<std::size_t>(thread)]->align(image, m_bank, m_startX[i], m_startY[i], withSlopes);
    const vpCellFit &fit = m_fits[i];
    m_use[i] = useOf(fit.ok, i);
    m_columns[offsetX][i] = fit.x - m_startX[i];
    m_columns[offsetY][i] = fit.y - m_startY[i];
    m_columns[variance][i] = fit.variance;
    m_columns[contrast][i] = fit.contrast;
    m_columns[sigma][i] = std::sqrt(fit.variance * (fit.xx + fit.yy));
  });
}

void vpPatternTracker::Impl::setSlopes()
{
  for (const auto &aligner : m_aligners) {
    aligner->setSlopes(m_slopes);
  }
}

// Common motion of all cells, from the known ones: new ones also show their deviations. False when the relative
// positions of known, clean cells have changed: these are other cells.
bool vpPatternTracker::Impl::deviateAsBefore()
{
  const unsigned char least = leastUse();
  m_workers.run(2, [&](int axis, int) {
    std::vector<double> &room = axis == 0 ? m_scratch : m_scratch2;
    vpRobustMean::choose(m_columns[axis == 0 ? offsetX : offsetY], m_use, least, room);
    (axis == 0 ? m_shiftX : m_shiftY) = vpRobustMean::median(room);
  });
  m_scratch.clear();
  double deviations = 0.;
  const double clean = dirty * m_noise + allowance();
  for (std::size_t i = 0; i < m_use.size(); ++i) {
    if (m_use[i] == static_cast<unsigned char>(Use::Known) && m_columns[variance][i] < clean) {
      const double ex = m_columns[offsetX][i] - m_shiftX, ey = m_columns[offsetY][i] - m_shiftY;
      m_scratch.push_back(std::sqrt(ex * ex + ey * ey));
      deviations += m_columns[sigma][i];
    }
  }
  const double count = static_cast<double>(m_scratch.size()), calm = std::max(0.1, 6. * deviations / count);
  const double limit = m_restless > 0 ? 3. * calm : calm; // in perspective the deviations turn, too
  const double usual = vpRobustMean::median(m_scratch);
  if (count < 3. || usual < 2. * deviations / count) {
    return true;
  }
  return turnLattice(limit) || count < 4. || usual < limit;
}

// A pattern that turns or tilts is the same pattern, and its lattice follows at once; the turn is expected to continue.
// Least squares from the known and clean cells; false when it is not a turn: the residuals would be above \e limit per
// degree of freedom, or it would be large for one image, or may be noise.
bool vpPatternTracker::Impl::turnLattice(double limit)
{
  constexpr double significant = 80.; // sum of squares explained, in variances, with six degrees of freedom
  constexpr double most = 0.05;       // of the pitch
  constexpr double gain = 0.4;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  double squares = 0., variances = 0.;
  int count = 0;
  for (std::size_t i = 0; i < m_frame.cells.size(); ++i) {
    const vpCellFit &fit = m_fits[i];
    if (m_ownStart[i] != 0 && fit.ok && fit.variance < dirty * m_noise + allowance()) {
      const Eigen::Vector3d a(1., m_frame.cells[i].column - m_column, m_frame.cells[i].row - m_row);
      const Eigen::RowVector2d e(fit.x - m_startX[i] - m_shiftX, fit.y - m_startY[i] - m_shiftY);
      normal += a * a.transpose();
      right += a * e;
      squares += e.squaredNorm();
      variances += fit.variance * (fit.xx + fit.yy);
      ++count;
    }
  }
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(normal);
  if (count < 3 || ldlt.vectorD().minCoeff() < 0.1) {
    return false;
  }
  const Eigen::Matrix<double, 3, 2> s = ldlt.solve(right);
  const double explained = (s.transpose() * right).trace();
  const double rest = std::sqrt(std::max(0., squares - explained) / std::max(1, count - 3));
  // Other cells would deviate randomly, not linearly over the view.
  if ((rest > limit && explained < 0.95 * squares) || explained < significant * 0.5 * variances / count ||
      s.row(1).norm() > most * std::hypot(m_lattice.ax, m_lattice.ay) ||
      s.row(2).norm() > most * std::hypot(m_lattice.bx, m_lattice.by)) {
    return false;
  }
  m_lattice.ox += s(0, 0);
  m_lattice.oy += s(0, 1);
  m_lattice.ax += s(1, 0);
  m_lattice.ay += s(1, 1);
  m_lattice.bx += s(2, 0);
  m_lattice.by += s(2, 1);
  m_turn.ax += gain * s(1, 0);
  m_turn.ay += gain * s(1, 1);
  m_turn.bx += gain * s(2, 0);
  m_turn.by += gain * s(2, 1);
  for (std::size_t i = 0; i < m_frame.cells.size(); ++i) {
    const int c = m_frame.cells[i].column - m_column, r = m_frame.cells[i].row - m_row;
    const double dx = s(0, 0) + c * s(1, 0) + r * s(2, 0), dy = s(0, 1) + c * s(1, 1) + r * s(2, 1);
    m_frame.cells[i].x += dx;
    m_frame.cells[i].y += dy;
    m_startX[i] += dx;
    m_startY[i] += dy;
  }
  m_turned = true;
  m_restless = restlessAfterTurn;
  m_hurry = std::max(m_hurry, hurryAfterTurn);
  return true;
}

// The template is not perfect: a hundredth of its range is ignored.
double vpPatternTracker::Impl::allowance() const { return 1e-4 * m_bank.range() * m_bank.range(); }

void vpPatternTracker::Impl::validate(const vpImage<unsigned char> &image)
{
  const std::size_t n = m_frame.cells.size();
  double now = 0., usualContrast = 0.;
  m_workers.run(2, [&](int k, int) {
    std::vector<double> &room = k == 0 ? m_scratch : m_scratch2;
    vpRobustMean::choose(m_columns[k == 0 ? variance : contrast], m_use, static_cast<unsigned char>(Use::New), room);
    (k == 0 ? now : usualContrast) = vpRobustMean::median(room);
  });
  // Usual residuals, also when the light changes or most cells are dirty.
  const double usual = m_noise > 0. ? std::clamp(now, 0.5 * m_noise, 2. * m_noise) : std::max(now, 0.05);
  const double pitch = std::min(std::hypot(m_lattice.ax, m_lattice.ay), std::hypot(m_lattice.bx, m_lattice.by));
  const double newGate = std::clamp(0.12 * pitch, 0.5, 4.);
  forCells([&](std::size_t i, int thread) {
    vpCellFit &fit = m_fits[i];
    const double gate = m_ownStart[i] == 0 ? newGate : std::min(m_restless > 0 ? 3. * knownGate : knownGate, newGate);
    const auto near = [&](const vpCellFit &f) {
      const double dx = f.x - m_startX[i] - m_shiftX, dy = f.y - m_startY[i] - m_shiftY;
      return dx * dx + dy * dy < gate * gate;
    };
    if (!fit.ok || fit.variance > dirty * usual + allowance() || !near(fit)) {
      fit = m_aligners[static_cast<std::size_t>(thread)]->alignMasked(image, m_bank, m_startX[i] + m_shiftX,
                                                                      m_startY[i] + m_shiftY, std::sqrt(usual));
    }
    vpPatternCell &cell = m_frame.cells[i];
    const double hidden = fit.masked ? maskedSigma * maskedSigma : 0.;
    const double sx = std::sqrt(fit.variance * fit.xx + hidden), sy = std::sqrt(fit.variance * fit.yy + hidden);
    cell.valid = fit.ok && fit.variance < hopeless * usual + allowance() && fit.contrast > 0.5 * usualContrast &&
                 fit.contrast < 2. * usualContrast && near(fit) && sx < m_spec.maxCellSigma && sy < m_spec.maxCellSigma;
    if (cell.valid) {
      cell.x = fit.x;
      cell.y = fit.y;
      const double doubt = std::max(leastDoubt, 0.5 * newGate); // the centre is anywhere within the gate
      cell.sigmaX = fit.doubtX ? std::hypot(sx, doubt) : sx;
      cell.sigmaY = fit.doubtY ? std::hypot(sy, doubt) : sy;
    }
  });
  vpSlopes sum{};
  int clean = 0;
  for (std::size_t i = 0; i < n; ++i) {
    m_frame.validCells += m_frame.cells[i].valid ? 1 : 0;
    if (m_frame.cells[i].valid && m_fits[i].hasSlopes) {
      ++clean;
      for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] += m_fits[i].slopes[k];
      }
    }
  }
  if (clean > 0) {
    // Few cells carry little information. At first the mean of all measurements, later the recent past.
    m_slopeWeight = std::min(m_slopeWeight + clean, slopeMemory);
    const double gain = std::min(1., clean / m_slopeWeight); // more cells than the memory: no more information
    for (std::size_t k = 0; k < sum.size(); ++k) {
      m_slopes[k] += gain * (sum[k] / clean - m_slopes[k]);
    }
    setSlopes();
  }
  if (2 * m_frame.validCells >= static_cast<int>(n) && m_frame.validCells > 0) {
    m_noise += (m_noise > 0. ? 0.1 : 1.) * (usual - m_noise);
  }
}

// The lattice continues to turn; the rate decays without new evidence.
void vpPatternTracker::Impl::turnOn()
{
  constexpr double fade = 0.8;
  m_turned = false;
  m_restless = std::max(0, m_restless - 1);
  m_lattice.ax += m_turn.ax;
  m_lattice.ay += m_turn.ay;
  m_lattice.bx += m_turn.bx;
  m_lattice.by += m_turn.by;
  m_turn.ax *= fade;
  m_turn.ay *= fade;
  m_turn.bx *= fade;
  m_turn.by *= fade;
}

void vpPatternTracker::Impl::follow(const vpImage<unsigned char> &image)
{
  const vpLattice last = m_lattice;
  const double vx = m_vx, vy = m_vy;
  const unsigned int epoch = m_frame.epoch;
  m_lattice.ox += m_vx * (m_lostFrames + 1);
  m_lattice.oy += m_vy * (m_lostFrames + 1);
  turnOn();
  vpPatternReason note = vpPatternReason::None;
  const bool late = m_lostFrames > m_spec.maxLostFrames;
  if (late || !alignAll(image)) {
    // Not at the expected position: search the whole image.
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
    else if (!late && relocate(image)) {
      reason = alignAll(image) ? vpPatternReason::None : vpPatternReason::NoMatch;
    }
    if (reason != vpPatternReason::None) {
      m_lattice = last;
      lose(reason, vpPatternStatus::Lost);
      return;
    }
  }
  updateLattice();
  vpLattice unit = m_lattice;
  unit.ox = unit.oy = 0.;
  double row = 0., column = 0.;
  unit.invert(m_lattice.ox - last.ox, m_lattice.oy - last.oy, row, column);
  const double frames = m_lostFrames + 1;
  const bool restarted = late && note != vpPatternReason::None; // on a lattice of its own
  if (!restarted && (std::abs(row) > nearHalf * frames || std::abs(column) > nearHalf * frames)) {
    note = vpPatternReason::AmbiguousMotion;
  }
  if (m_frame.epoch != epoch && note == vpPatternReason::None) {
    note = vpPatternReason::IdentitySlip;
  }
  else if (note == vpPatternReason::AmbiguousMotion) {
    renumber(note);
  }
  m_vx = restarted ? vx : (m_lattice.ox - last.ox) / frames; // as before: the next image may confirm it
  m_vy = restarted ? vy : (m_lattice.oy - last.oy) / frames;
  measureMotion();
  updateDeviations();
  remember();
  anchor();
  m_lostFrames = 0;
  const bool few = 2. * m_frame.validCells < usualCells();
  updateShare();
  m_frame.reason = note != vpPatternReason::None ? note : few ? vpPatternReason::CellsMissing : vpPatternReason::None;
  m_frame.status = m_frame.reason == vpPatternReason::None ? vpPatternStatus::Tracking : vpPatternStatus::Degraded;
  if (m_hurry > 0 && m_frame.validCells < static_cast<int>(m_frame.cells.size())) {
    lookForMissing(image);
  }
  if (m_frame.status == vpPatternStatus::Tracking) {
    refresh(image);
  }
}

// The common part of the deviations belongs to the lattice; the rest stays with the cells.
void vpPatternTracker::Impl::updateDeviations()
{
  // A doubtful cell may be the edge of something else; its deviation is not learned, or it would be expected, and found, at that edge. While
  // the template is being relearned nothing fits well, and doubt is no reason.
  const auto teaches = [this](std::size_t i) {
    return m_frame.cells[i].valid && (m_hurry > 0 || (!m_fits[i].doubtX && !m_fits[i].doubtY));
  };
  m_stripSums.resize((m_frame.cells.size() + cellsOfStrip - 1) / cellsOfStrip);
  forStrips([&](std::size_t strip, std::size_t begin, std::size_t end, int) {
    StripSums s;
    for (std::size_t i = begin; i < end; ++i) {
      if (teaches(i)) {
        const vpPatternCell &cell = m_frame.cells[i];
        const int r = cell.row - m_row, c = cell.column - m_column;
        const Eigen::Vector3d a(1., c, r);
        s.normal += a * a.transpose();
        s.right += a * Eigen::RowVector2d(cell.x - m_lattice.x(r, c), cell.y - m_lattice.y(r, c));
      }
    }
    m_stripSums[strip] = s;
  });
  StripSums all;
  for (const StripSums &s : m_stripSums) {
    all.normal += s.normal;
    all.right += s.right;
  }
  Eigen::Matrix3d &normal = all.normal;
  const Eigen::Matrix<double, 3, 2> &right = all.right;
  normal(1, 1) += 1e-3; // one row or one column alone does not determine the other vector
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
  forSlots([&](std::size_t i) {
    vpPatternCell &cell = m_frame.cells[i];
    const int r = cell.row - m_row, c = cell.column - m_column;
    vpCellMemory::Slot *slot = m_memory.find(cell.row, cell.column);
    if (slot != nullptr) { // the same position as before, relative to the moved lattice
      slot->offsetX -= s(0, 0) + c * s(1, 0) + r * s(2, 0);
      slot->offsetY -= s(0, 1) + c * s(1, 1) + r * s(2, 1);
    }
    if (teaches(i)) {
      vpCellMemory::Slot &own = m_memory.claim(cell.row, cell.column);
      own.count = wasInLast(own) ? own.count : 0;
      own.count = std::min(own.count + 1, m_turned ? 3 : 20); // in perspective deviations turn, too
      own.offsetX += (cell.x - m_lattice.x(r, c) - own.offsetX) / own.count;
      own.offsetY += (cell.y - m_lattice.y(r, c) - own.offsetY) / own.count;
      slot = &own;
    }
    else if (slot != nullptr && !cell.valid && m_hurry == 0 && m_frame.index - slot->frame > forgetAfter) {
      slot->count = 0;
      slot = nullptr;
    }
    cell.deviationX = slot != nullptr ? slot->offsetX : 0.;
    cell.deviationY = slot != nullptr ? slot->offsetY : 0.;
  });
}

END_VISP_NAMESPACE
