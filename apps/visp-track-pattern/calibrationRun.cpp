/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "calibrationRun.h"

#include <visp3/pattern/vpDotLattice.h>

#include <visp3/core/vpException.h>

#include <stdexcept>

namespace trackPattern
{
namespace
{
constexpr std::size_t MOST_VIEWS = 100;
constexpr std::size_t LEAST_POINTS = 6; // minimum per view of vpPlanarMicroscopeCalibration
// Residuals too large for centre noise: a calibration with them is worse than none.
constexpr double FAR_RATIO = 10.;   // relative to the points' standard deviations
constexpr double FAR_RESIDUAL = 1.; // px

bool isFarFromFitting(const vpMicroscopeCalibrationResult &result)
{
  const bool residuals = result.residualRms > FAR_RESIDUAL && result.varianceFactor > FAR_RATIO * FAR_RATIO;
  return residuals || result.looksTiltedTooFar;
}
} // namespace

CalibrationRun::CalibrationRun(const Options &options) : m_dotGrid(options.dotGrid), m_pitch(options.pitch) {}

void CalibrationRun::add(const vpImage<unsigned char> &image, const vpPatternFrame &frame, double left, double top)
{
  const bool wanted = m_seen++ % m_stride == 0;
  if (!wanted) {
    return;
  }
  std::vector<vpCalibrationPoint> points;
  if (m_dotGrid) {
    try {
      const vpDotLattice grid = vpFindDotLattice(image);
      points = vpCalibrationPoints(grid, m_pitch);
      m_grid = grid.message;
    }
    catch (const vpException &error) {
      m_complaint = error.getStringMessage();
      return;
    }
  }
  else if (frame.status == vpPatternStatus::Tracking) {
    points = vpCalibrationPoints(frame, m_pitch);
  }
  for (vpCalibrationPoint &point : points) {
    point.u += left;
    point.v += top;
  }
  if (points.size() >= LEAST_POINTS) {
    keep(std::move(points));
  }
}

void CalibrationRun::keep(std::vector<vpCalibrationPoint> points)
{
  m_views.push_back(std::move(points));
  if (m_views.size() == 2 * MOST_VIEWS) { // drop every second view, and from now on store only every second one
    for (std::size_t i = 1; i < MOST_VIEWS; ++i) {
      m_views[i] = std::move(m_views[2 * i]);
    }
    m_views.resize(MOST_VIEWS);
    m_stride *= 2;
  }
}

vpMicroscopeCalibrationResult CalibrationRun::compute(unsigned int width, unsigned int height) const
{
  if (m_views.empty()) {
    if (m_dotGrid) {
      throw std::runtime_error(
          "--calibrate: in no image a grid of dots was found" +
          (m_complaint.empty() ? std::string(", or it had less than 6 dots") : "; of the last one: " + m_complaint));
    }
    throw std::runtime_error("--calibrate: in no image the product was tracked with at least 6 cells; it takes some 60 "
                             "images of a product that moves (for still images of a grid add --dot-grid)");
  }
  vpMicroscopeCalibrationSpec options;
  options.sigmaFromResiduals = true; // a real product is not exactly regular
  vpPlanarMicroscopeCalibration calibration(width, height, options);
  try {
    for (const std::vector<vpCalibrationPoint> &points : m_views) {
      calibration.addView(points);
    }
    vpMicroscopeCalibrationResult result = calibration.compute();
    if (!m_grid.empty()) {
      result.message = "In the last image " + m_grid + " " + result.message;
    }
    if (isFarFromFitting(result)) {
      throw std::runtime_error("--calibrate: the points do not fit, no calibration is written. " + result.message);
    }
    return result;
  }
  catch (const vpException &error) {
    throw std::runtime_error("--calibrate: " + error.getStringMessage());
  }
}
} // namespace trackPattern
