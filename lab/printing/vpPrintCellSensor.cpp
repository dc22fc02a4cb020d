/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/printing/vpPrintCellSensor.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int learningFrames = 120;
constexpr double learningVelocity = 0.37; // px/frame, in both axes; passes through all sub-pixel phases
} // namespace

vpPrintCellSensor::vpPrintCellSensor(const vpPrintExperimentSpec &spec, const vpProductPattern &product)
  : m_model(spec.sensorModel), m_product(product), m_tracker(spec.product.width, spec.product.height),
    m_fromImages(spec.sensor == vpPrintSensor::Image)
{
  std::seed_seq sequence{spec.seed, 7u};
  m_random.seed(sequence);
  if (m_fromImages) {
    for (int k = learningFrames; k > 0; --k) {
      const double place = -learningVelocity * k;
      seeImage(place, place, learningVelocity, learningVelocity, 1000000u + static_cast<unsigned int>(k));
    }
  }
}

void vpPrintCellSensor::see(double x, double y, double vx, double vy, unsigned int frame)
{
  if (m_fromImages) {
    seeImage(x, y, vx, vy, frame);
  }
  else {
    seeModel(x, y);
  }
}

void vpPrintCellSensor::seeModel(double x, double y)
{
  m_cells.clear();
  for (const vpPatternTruthCell &truth : m_product.cells(x, y)) {
    if (truth.complete && !truth.defective) {
      vpPatternCell cell;
      cell.row = truth.row;
      cell.column = truth.column;
      cell.x = truth.x;
      cell.y = truth.y;
      cell.sigmaX = m_model.sigmaX;
      cell.sigmaY = m_model.sigmaY;
      cell.valid = true;
      m_cells.push_back(cell);
    }
  }
  const double n = static_cast<double>(m_cells.size());
  if (n == 0.) {
    return;
  }
  // The common error, so that the mean has the variance sigma^2 / effectiveCells.
  const double effective = std::min(m_model.effectiveCells, n);
  const double common2 = n > 1. ? (1. / effective - 1. / n) / (1. - 1. / n) : 0.;
  const double common = std::sqrt(std::max(0., common2)), own = std::sqrt(std::max(0., 1. - common2));
  const double commonX = common * m_normal(m_random), commonY = common * m_normal(m_random);
  for (vpPatternCell &cell : m_cells) {
    cell.x += m_model.sigmaX * (commonX + own * m_normal(m_random));
    cell.y += m_model.sigmaY * (commonY + own * m_normal(m_random));
  }
}

void vpPrintCellSensor::seeImage(double x, double y, double vx, double vy, unsigned int frame)
{
  m_product.render(x, y, vx, vy, frame, m_image);
  const vpPatternFrame &seen = m_tracker.process(m_image);
  m_cells.clear();
  const bool locked = seen.status == vpPatternStatus::Tracking || seen.status == vpPatternStatus::Degraded;
  if (!locked) {
    return;
  }
  if (!m_numbered || seen.epoch != m_epoch) {
    number(x, y, seen);
  }
  m_epoch = seen.epoch;
  for (vpPatternCell cell : seen.cells) {
    if (cell.valid && m_numbered) {
      cell.row += m_rowOffset;
      cell.column += m_columnOffset;
      m_cells.push_back(cell);
    }
  }
}

// Matches the tracker's rows and columns to the product's.
void vpPrintCellSensor::number(double x, double y, const vpPatternFrame &frame)
{
  m_numbered = false;
  double nearest = 8.;
  for (const vpPatternTruthCell &truth : m_product.cells(x, y)) {
    for (const vpPatternCell &cell : frame.cells) {
      const double distance = std::hypot(cell.x - truth.x, cell.y - truth.y);
      if (cell.valid && distance < nearest) {
        nearest = distance;
        m_rowOffset = truth.row - cell.row;
        m_columnOffset = truth.column - cell.column;
        m_numbered = true;
      }
    }
  }
}

END_VISP_NAMESPACE
