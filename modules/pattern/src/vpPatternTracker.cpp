/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The state machine of vpPatternTracker, and the common part of acquisition and tracking.
#include "vpPatternTrackerImpl.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpField.h>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t enoughForThreads = 128; // cells: waking a thread takes as long as some of them
constexpr double unknownVariance = 0.01;      // px^2, of centres with unknown variance: any equal value works

std::size_t roomForCells(unsigned int width, unsigned int height, double minPitch)
{
  return static_cast<std::size_t>((width / minPitch + 2.) * (height / minPitch + 2.));
}

// Two periods must be in view, so a cell with its surroundings covers at most a quarter of the image, plus a margin.
std::size_t roomForPixels(unsigned int width, unsigned int height)
{
  return std::min<std::size_t>((width / 2 + 24) * static_cast<std::size_t>(height / 2 + 28), 1u << 20);
}

unsigned int checkedSize(const char *name, unsigned int value)
{
  vpCheckField(name, "the pattern tracker's image", value, "px", {16., 16384.});
  return value;
}

const vpPatternTrackerSpec &checkedOptions(const vpPatternTrackerSpec &spec)
{
  spec.check();
  return spec;
}

// Smallest number of bits that count to n.
int bitsFor(int n)
{
  int bits = 0;
  while ((1 << bits) < n && bits < 20) {
    ++bits;
  }
  return bits;
}
} // namespace

void vpCellMemory::shape(int rows, int columns)
{
  m_rowBits = bitsFor(rows);
  m_columnBits = bitsFor(columns);
  while ((std::size_t(1) << (m_rowBits + m_columnBits)) > m_slots.size()) {
    --(m_rowBits > m_columnBits ? m_rowBits : m_columnBits);
  }
  clear();
}

vpCellMemory::Slot &vpCellMemory::at(int row, int column)
{
  const unsigned int r = static_cast<unsigned int>(row) & ((1u << m_rowBits) - 1);
  const unsigned int c = static_cast<unsigned int>(column) & ((1u << m_columnBits) - 1);
  return m_slots[(static_cast<std::size_t>(r) << m_columnBits) + c];
}

vpCellMemory::Slot *vpCellMemory::find(int row, int column)
{
  Slot &slot = at(row, column);
  const bool same = slot.generation == m_generation && slot.row == row && slot.column == column;
  return same && slot.count > 0 ? &slot : nullptr;
}

vpCellMemory::Slot &vpCellMemory::claim(int row, int column)
{
  Slot &slot = at(row, column);
  if (slot.generation != m_generation || slot.row != row || slot.column != column) {
    slot = Slot();
    slot.generation = m_generation;
    slot.row = row;
    slot.column = column;
  }
  return slot;
}

bool vpCellMemory::deviation(int row, int column, double &x, double &y)
{
  if (const Slot *own = find(row, column)) {
    x = own->offsetX;
    y = own->offsetY;
    return true;
  }
  int n = 0;
  x = y = 0.;
  for (const Slot *other :
       {find(row, column + 1), find(row, column - 1), find(row + 1, column), find(row - 1, column)}) {
    if (other != nullptr) {
      x += other->offsetX;
      y += other->offsetY;
      ++n;
    }
  }
  x /= std::max(1, n);
  y /= std::max(1, n);
  return false;
}

vpPatternTracker::Impl::Impl(unsigned int width, unsigned int height, const vpPatternTrackerSpec &spec)
  : m_spec(checkedOptions(spec)), m_width(checkedSize("width", width)), m_height(checkedSize("height", height)),
    m_maxCells(roomForCells(width, height, spec.minPitch)), m_labels(width, height, m_maxCells), m_fitter(m_maxCells),
    m_light(width, height, m_maxCells), m_learner(roomForPixels(width, height)), m_bank(roomForPixels(width, height)),
    m_nextBank(spec.refreshEvery > 0 ? roomForPixels(width, height) : 0), m_workers(spec.threads),
    m_memory(4 * m_maxCells + 64), m_meanX(m_maxCells), m_meanY(m_maxCells)
{
  m_frame.cells.reserve(m_maxCells);
  m_fits.reserve(m_maxCells);
  m_startX.reserve(m_maxCells);
  m_startY.reserve(m_maxCells);
  m_scratch.reserve(m_maxCells);
  m_scratch2.reserve(m_maxCells);
  m_use.reserve(m_maxCells);
  for (std::vector<double> &column : m_columns) {
    column.reserve(m_maxCells);
  }
  m_stripSums.reserve(m_maxCells / cellsOfStrip + 1);
  for (int k = 0; k < spec.threads; ++k) {
    m_aligners.push_back(std::make_unique<vpCellAligner>(roomForPixels(width, height)));
  }
  m_ownStart.reserve(m_maxCells);
  reset();
}

void vpPatternTracker::Impl::reset()
{
  m_stage = Stage::Searching;
  m_known = m_interrupted = false;
  m_bank.clear();
  m_memory.clear();
  m_light.clear();
  m_lostFrames = m_learned = m_rotate = m_row = m_column = 0;
  m_vx = m_vy = m_noise = m_edgeVarianceX = m_edgeVarianceY = m_share = 0.;
  m_turn = {0., 0., 0., 0., 0., 0.};
  m_frame.epoch += m_images > 0 ? 1 : 0;
  lose(vpPatternReason::None, vpPatternStatus::Acquiring);
  m_lostFrames = 0;
  m_frame.lattice = vpPatternLattice();
}

// As after too many images without a lock.
void vpPatternTracker::Impl::interrupt()
{
  m_interrupted = m_known;
  m_lostFrames = m_known ? std::max(m_lostFrames, m_spec.maxLostFrames + 1) : m_lostFrames;
}

const vpPatternFrame &vpPatternTracker::Impl::process(const vpImage<unsigned char> &image)
{
  m_frame.index = m_images++;
  m_frame.cells.clear();
  m_frame.validCells = 0;
  m_frame.hasMotion = false;
  m_gap = static_cast<unsigned int>(m_lostFrames);
  if (image.getWidth() != m_width || image.getHeight() != m_height) {
    lose(vpPatternReason::WrongSize, vpPatternStatus::Lost);
  }
  else if (m_stage == Stage::Locked) {
    if (m_fits.size() >= enoughForThreads) { // of the last image
      m_workers.begin();
    }
    follow(image);
    m_workers.end();
  }
  else {
    acquire(image);
  }
  publish();
  return m_frame;
}

// Rows and columns of the lattice, from its own (0, 0), that may have a cell in the view minus this border.
vpPatternTracker::Impl::Range vpPatternTracker::Impl::inView(double halfWidth, double halfHeight) const
{
  double rowLow = 1e9, rowHigh = -1e9, columnLow = 1e9, columnHigh = -1e9;
  for (int corner = 0; corner < 4; ++corner) {
    double r = 0., c = 0.;
    m_lattice.invert(corner % 2 == 0 ? halfWidth : m_width - 1. - halfWidth,
                     corner / 2 == 0 ? halfHeight : m_height - 1. - halfHeight, r, c);
    rowLow = std::min(rowLow, r);
    rowHigh = std::max(rowHigh, r);
    columnLow = std::min(columnLow, c);
    columnHigh = std::max(columnHigh, c);
  }
  return {static_cast<int>(std::ceil(rowLow)), static_cast<int>(std::floor(rowHigh)),
          static_cast<int>(std::ceil(columnLow)), static_cast<int>(std::floor(columnHigh))};
}

// Cells whose window of +-halfWidth by +-halfHeight is completely inside the image, at their lattice positions.
void vpPatternTracker::Impl::listCells(double halfWidth, double halfHeight)
{
  m_frame.cells.clear();
  m_frame.validCells = 0;
  const Range range = inView(halfWidth, halfHeight);
  for (int r = range.rowLow; r <= range.rowHigh; ++r) {
    for (int c = range.columnLow; c <= range.columnHigh; ++c) {
      vpPatternCell cell;
      cell.row = m_row + r;
      cell.column = m_column + c;
      cell.x = m_lattice.x(r, c);
      cell.y = m_lattice.y(r, c);
      if (cell.x >= halfWidth && cell.y >= halfHeight && cell.x <= m_width - 1. - halfWidth &&
          cell.y <= m_height - 1. - halfHeight && m_frame.cells.size() < m_maxCells) {
        m_frame.cells.push_back(cell);
      }
    }
  }
}

// Expected number of valid cells: not all, where the product ends in view or cells are missing.
double vpPatternTracker::Impl::usualCells() const { return m_share * static_cast<double>(m_frame.cells.size()); }

void vpPatternTracker::Impl::updateShare()
{
  if (!m_frame.cells.empty()) {
    const double share = m_frame.validCells / static_cast<double>(m_frame.cells.size());
    m_share += (m_share > 0. ? 0.05 : 1.) * (share - m_share);
  }
}

// Expected position of each cell: its lattice position plus its deviation, if that was measured in the last image.
void vpPatternTracker::Impl::expectCells(bool deviations)
{
  const std::size_t n = m_frame.cells.size();
  m_startX.resize(n);
  m_startY.resize(n);
  m_ownStart.resize(n);
  m_use.resize(n);
  for (std::vector<double> &column : m_columns) {
    column.resize(n);
  }
  forCells([&](std::size_t i, int) {
    const vpPatternCell &cell = m_frame.cells[i];
    double x = 0., y = 0.;
    // Cells that return are remembered, but the lattice has moved since.
    const bool own = deviations && m_memory.deviation(cell.row, cell.column, x, y);
    m_ownStart[i] = own && wasInLast(*m_memory.find(cell.row, cell.column)) ? 1 : 0;
    m_startX[i] = cell.x + x;
    m_startY[i] = cell.y + y;
  });
}

// No two cells of m_frame share a slot of the memory: while the pattern turns, more rows or columns may be in view than when it was shaped.
bool vpPatternTracker::Impl::haveOwnSlots() const
{
  if (m_frame.cells.empty()) {
    return true;
  }
  const vpPatternCell &first = m_frame.cells.front();
  Range range{first.row, first.row, first.column, first.column};
  for (const vpPatternCell &cell : m_frame.cells) {
    range.rowLow = std::min(range.rowLow, cell.row);
    range.rowHigh = std::max(range.rowHigh, cell.row);
    range.columnLow = std::min(range.columnLow, cell.column);
    range.columnHigh = std::max(range.columnHigh, cell.column);
  }
  return m_memory.holds(range.rowHigh - range.rowLow + 1, range.columnHigh - range.columnLow + 1);
}

// Use of a cell's measurement.
unsigned char vpPatternTracker::Impl::useOf(bool measured, std::size_t cell) const
{
  return static_cast<unsigned char>(!measured ? Use::No : m_ownStart[cell] == 0 ? Use::New : Use::Known);
}

// Known cells show the common motion, new ones their deviations, too: these count where there are no others.
unsigned char vpPatternTracker::Impl::leastUse() const
{
  const auto known = static_cast<unsigned char>(Use::Known);
  return std::find(m_use.begin(), m_use.end(), known) != m_use.end() ? known : static_cast<unsigned char>(Use::New);
}

// Move the lattice onto the cells: the known ones determine its motion, the others their deviations.
void vpPatternTracker::Impl::updateLattice()
{
  const auto variance = [](double sigma) { return std::isfinite(sigma) ? sigma * sigma : unknownVariance; };
  forCells([&](std::size_t i, int) {
    const vpPatternCell &cell = m_frame.cells[i];
    m_use[i] = useOf(cell.valid, i);
    m_columns[0][i] = cell.x - m_startX[i];
    m_columns[1][i] = cell.y - m_startY[i];
    m_columns[2][i] = variance(cell.sigmaX);
    m_columns[3][i] = variance(cell.sigmaY);
  });
  const unsigned char least = leastUse();
  const bool aligned = m_stage == Stage::Locked; // then the shift is known, and is as good a centre as the median
  m_workers.run(2, [&](int axis, int) {
    const std::size_t k = static_cast<std::size_t>(axis);
    vpRobustMean &mean = axis == 0 ? m_meanX : m_meanY;
    mean.assign(m_columns[k], m_columns[k + 2], m_use, least);
    (axis == 0 ? m_lattice.ox : m_lattice.oy) +=
        (aligned ? mean.mean(axis == 0 ? m_shiftX : m_shiftY) : mean.mean()).value;
  });
}

void vpPatternTracker::Impl::measureMotion()
{
  // Centres from edges get their deviation from the spread of their motion; before that, any equal value works.
  const bool edges = m_stage != Stage::Locked || m_spec.method != vpPatternMethod::GaussNewton;
  forCells([&](std::size_t i, int) {
    const vpPatternCell &cell = m_frame.cells[i];
    const vpCellMemory::Slot *slot = cell.valid ? m_memory.find(cell.row, cell.column) : nullptr;
    m_use[i] = slot != nullptr && slot->frame + 1 == m_frame.index ? 1 : 0;
    if (m_use[i] != 0) {
      const bool unknown = !std::isfinite(cell.sigmaX) || !std::isfinite(slot->varianceX);
      m_columns[0][i] = cell.x - slot->x;
      m_columns[1][i] = cell.y - slot->y;
      m_columns[2][i] = unknown ? unknownVariance : cell.sigmaX * cell.sigmaX + slot->varianceX;
      m_columns[3][i] = unknown ? unknownVariance : cell.sigmaY * cell.sigmaY + slot->varianceY;
    }
  });
  vpRobustMean::Result x, y;
  m_workers.run(2, [&](int axis, int) {
    const std::size_t k = static_cast<std::size_t>(axis);
    vpRobustMean &mean = axis == 0 ? m_meanX : m_meanY;
    mean.assign(m_columns[k], m_columns[k + 2], m_use, 1);
    (axis == 0 ? x : y) = edges ? mean.mean() : mean.mean(axis == 0 ? m_vx : m_vy); // the lattice has moved by this
  });
  m_frame.hasMotion = x.count > 0 && y.count > 0;
  if (!m_frame.hasMotion) {
    return;
  }
  m_frame.dx = x.value;
  m_frame.dy = y.value;
  m_frame.sigmaDx = std::sqrt(x.variance);
  m_frame.sigmaDy = std::sqrt(y.variance);
  if (edges) {
    m_vx = x.value;
    m_vy = y.value;
    double squaresX = 0., squaresY = 0., sumX = 0., sumY = 0.;
    int n = 0;
    for (std::size_t i = 0; i < m_use.size(); ++i) {
      if (m_use[i] != 0) {
        const double dx = m_columns[0][i], dy = m_columns[1][i];
        sumX += dx;
        sumY += dy;
        squaresX += dx * dx;
        squaresY += dy * dy;
        ++n;
      }
    }
    if (n >= 3) {
      const double vx = std::max(1e-6, 0.5 * (squaresX - sumX * sumX / n) / (n - 1));
      const double vy = std::max(1e-6, 0.5 * (squaresY - sumY * sumY / n) / (n - 1));
      m_edgeVarianceX += (m_edgeVarianceX > 0. ? 0.05 : 1.) * (vx - m_edgeVarianceX);
      m_edgeVarianceY += (m_edgeVarianceY > 0. ? 0.05 : 1.) * (vy - m_edgeVarianceY);
    }
  }
}

void vpPatternTracker::Impl::remember()
{
  forSlots([&](std::size_t i) {
    const vpPatternCell &cell = m_frame.cells[i];
    if (cell.valid) {
      vpCellMemory::Slot &slot = m_memory.claim(cell.row, cell.column);
      slot.x = cell.x;
      slot.y = cell.y;
      slot.varianceX = cell.sigmaX * cell.sigmaX;
      slot.varianceY = cell.sigmaY * cell.sigmaY;
      slot.frame = m_frame.index;
    }
  });
}

// Keep the lattice's own (0, 0) near the middle of the view: far away an error of the pitch would shift the cells.
void vpPatternTracker::Impl::anchor()
{
  double row = 0., column = 0.;
  m_lattice.invert(0.5 * (m_width - 1.), 0.5 * (m_height - 1.), row, column);
  const double r = std::abs(row) > 0.75 ? std::round(row) : 0., c = std::abs(column) > 0.75 ? std::round(column) : 0.;
  const double x = m_lattice.x(r, c), y = m_lattice.y(r, c);
  m_lattice.ox = x;
  m_lattice.oy = y;
  m_row += static_cast<int>(r);
  m_column += static_cast<int>(c);
}

void vpPatternTracker::Impl::renumber(vpPatternReason reason)
{
  // The old deviations belong to other cells, and so does the motion.
  m_memory.clear();
  ++m_frame.epoch;
  m_frame.reason = reason;
}

void vpPatternTracker::Impl::lose(vpPatternReason reason, vpPatternStatus status)
{
  m_frame.status = status;
  m_frame.reason = reason;
  m_frame.cells.clear();
  m_frame.validCells = 0;
  m_frame.hasMotion = false;
  ++m_lostFrames;
}

void vpPatternTracker::Impl::publish()
{
  if (!m_frame.hasMotion) {
    m_frame.dx = m_frame.dy = 0.;
    m_frame.sigmaDx = m_frame.sigmaDy = std::numeric_limits<double>::infinity();
  }
  m_frame.noise = std::sqrt(m_noise);
  if (m_known) {
    m_frame.lattice = {m_lattice.x(-m_row, -m_column),
                       m_lattice.y(-m_row, -m_column),
                       m_lattice.ax,
                       m_lattice.ay,
                       m_lattice.bx,
                       m_lattice.by};
  }
}

vpPatternTracker::vpPatternTracker(unsigned int width, unsigned int height, const vpPatternTrackerSpec &spec)
  : m_impl(std::make_unique<Impl>(width, height, spec))
{}
vpPatternTracker::~vpPatternTracker() = default;
vpPatternTracker::vpPatternTracker(vpPatternTracker &&) noexcept = default;
vpPatternTracker &vpPatternTracker::operator=(vpPatternTracker &&) noexcept = default;

const vpPatternFrame &vpPatternTracker::process(const vpImage<unsigned char> &image) { return m_impl->process(image); }
const vpPatternFrame &vpPatternTracker::frame() const { return m_impl->m_frame; }
const vpPatternTrackerSpec &vpPatternTracker::spec() const { return m_impl->m_spec; }
void vpPatternTracker::interrupt() { m_impl->interrupt(); }
void vpPatternTracker::reset() { m_impl->reset(); }

END_VISP_NAMESPACE
