/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Relearning of the template while it is in use: residuals of cells that fit well are collected, a share of their mean
// is added, the bases are prepared beside those in use, and replaced when they fit no worse. All in small units of
// work.
//
// No drift: the centre of point symmetry is determined for each template, not carried over from the last; its shift at
// a replacement is subtracted from the motion.
#include "vpPatternTrackerImpl.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int piecesInHurry = 24; // per image
constexpr int examples = 32;      // residuals for a new template
constexpr int examplesInHurry = 12;
constexpr double share = 0.25;        // of their mean that is added: like the mean of about 7 times as many
constexpr double shareOfMisfit = 0.8; // when they show that the template does not fit
constexpr double misfit = 2.;         // variance of the mean residual over that of noise alone
constexpr double fits = 1.4;          // residual variance over the usual one, of a cell used for learning
constexpr int hurryFor = 40;          // images
constexpr int settling = 50;          // images until m_noise is that of the template
constexpr double noWorse = 1.02;      // residual variance of new bases over that of the old ones
constexpr std::size_t compared = 64;  // cells, at most
} // namespace

// True when bases just prepared from the learner are in use.
void vpPatternTracker::Impl::beginRefresh()
{
  m_refresh = Refresh::Collecting;
  m_hurry = m_sinceFit = 0;
  m_fitNoise = 0.;
  ++m_frame.templates;
}

void vpPatternTracker::Impl::refresh(const vpImage<unsigned char> &image)
{
  if (m_spec.refreshEvery == 0) {
    return;
  }
  if (++m_sinceFit == settling && m_fitNoise == 0.) {
    m_fitNoise = m_noise;
  }
  if (m_fitNoise > 0. && m_noise > 1.3 * m_fitNoise + 0.25 * allowance()) {
    m_hurry = hurryFor;
  }
  m_hurry = std::max(0, m_hurry - 1);
  const bool now = m_hurry > 0 || m_frame.index % static_cast<unsigned int>(m_spec.refreshEvery) == 0;
  int taken = 0;
  for (int pieces = !now ? 0 : m_hurry > 0 ? piecesInHurry : 1; pieces > 0; --pieces) {
    switch (m_refresh) {
    case Refresh::Collecting:
      if (!collect(image, taken)) {
        return; // no more examples in this image
      }
      break;
    case Refresh::Refining:
      if (m_learner.refinePiece()) {
        if (m_learner.isGood()) {
          m_nextBank.begin(m_learner);
          m_refresh = Refresh::Preparing;
        }
        else {
          m_learner.beginRestore();
          m_refresh = Refresh::Restoring;
        }
      }
      break;
    case Refresh::Restoring:
      m_refresh = m_learner.refinePiece() ? Refresh::Collecting : m_refresh;
      break;
    case Refresh::Preparing:
      if (m_nextBank.isReady()) {
        if (exchange(image)) {
          m_refresh = Refresh::Collecting;
          return; // residuals of this image belong to the old template
        }
        m_learner.beginRestore();
        m_refresh = Refresh::Restoring;
      }
      else {
        static_cast<void>(m_nextBank.preparePiece(m_learner));
      }
      break;
    }
  }
}

// Measured with all its pixels, and with at most the usual residuals: no dirt, no damage.
bool vpPatternTracker::Impl::isGoodExample(std::size_t cell) const
{
  const vpCellFit &fit = m_fits[cell];
  return m_frame.cells[cell].valid && fit.ok && !fit.masked && fit.variance < fits * m_noise + allowance();
}

// Residuals of one cell; false when no cell of this image is left.
bool vpPatternTracker::Impl::collect(const vpImage<unsigned char> &image, int &taken)
{
  const int n = static_cast<int>(m_frame.cells.size());
  bool found = false;
  m_learner.setLimit((m_hurry > 0 ? 6. : 3.) * std::sqrt(m_noise));
  for (; taken < n && !found; ++taken) {
    const std::size_t i = static_cast<std::size_t>(m_rotate++ % n);
    found = isGoodExample(i) && m_learner.addResidual(image, m_frame.cells[i].x, m_frame.cells[i].y);
  }
  if (m_learner.residuals() >= (m_hurry > 0 ? examplesInHurry : examples)) {
    const bool doesNotFit = m_learner.misfit() > misfit * m_noise;
    m_hurry = doesNotFit ? hurryFor : m_hurry;
    m_learner.beginRefine(doesNotFit ? shareOfMisfit : share);
    m_refresh = Refresh::Refining;
    return true;
  }
  return found;
}

// Use the new bases from the next image on, unless they fit this one worse. The shift of their centre is measured on
// the cells of this image: it is no motion.
bool vpPatternTracker::Impl::exchange(const vpImage<unsigned char> &image)
{
  const std::size_t n = m_frame.cells.size(), step = 1 + n / compared;
  double before = 0., after = 0., dx = 0., dy = 0.;
  int count = 0;
  std::swap(m_bank, m_nextBank);
  for (std::size_t i = 0; i < n; i += step) {
    const vpPatternCell &cell = m_frame.cells[i];
    if (isGoodExample(i)) {
      const vpCellFit fit = m_aligners[0]->align(image, m_bank, cell.x, cell.y, false);
      before += m_fits[i].variance;
      after += fit.ok ? fit.variance : HUGE_VAL;
      dx += fit.x - cell.x;
      dy += fit.y - cell.y;
      ++count;
    }
  }
  if (count == 0 || !(after <= noWorse * before)) {
    std::swap(m_bank, m_nextBank);
    return false;
  }
  dx /= count;
  dy /= count;
  m_lattice.ox += dx;
  m_lattice.oy += dy;
  for (const vpPatternCell &cell : m_frame.cells) {
    vpCellMemory::Slot *slot = cell.valid ? m_memory.find(cell.row, cell.column) : nullptr;
    if (slot != nullptr) {
      slot->x += dx;
      slot->y += dy;
    }
  }
  m_fitNoise = std::min(m_noise, after / count);
  ++m_frame.templates;
  return true;
}

END_VISP_NAMESPACE
