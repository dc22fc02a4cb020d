/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "calibration.h"

#include "results.h"

#include "jsonReader.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>
#include <visp3/pattern/vpDotLattice.h>

#include <algorithm>
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

namespace
{
vpMicroscopeCalibration readJson(const std::string &file)
{
  const nlohmann::json json = vpApp::readJsonFile(file);
  vpApp::JsonObject top(json, file);
  vpMicroscopeCalibration c;
  c.width = top.count("width", 0);
  c.height = top.count("height", 0);
  c.scaleX = top.number("scale_x_px_per_m");
  c.scaleY = top.number("scale_y_px_per_m", c.scaleX);
  c.rotation = vpMath::rad(top.number("rotation_deg", 0.));
  c.mirrored = top.flag("mirrored", false);
  c.tx = top.number("tx_m", 0.);
  c.ty = top.number("ty_m", 0.);
  c.kappa1 = top.number("kappa1_per_px2", 0.);
  c.u0 = top.number("u0_px", 0.5 * (c.width - 1.));
  c.v0 = top.number("v0_px", 0.5 * (c.height - 1.));
  c.tiltX = top.number("tilt_x_per_px", 0.);
  c.tiltY = top.number("tilt_y_per_px", 0.);
  c.stretch = top.number("stretch", 0.);
  c.shear = top.number("shear", 0.);
  static_cast<void>(top.text("comment", ""));
  static_cast<void>(top.has("quality"));
  top.finish();
  for (const auto &[name, value] : {std::pair<const char *, double>{"scale_x_px_per_m", c.scaleX},
                                    std::pair<const char *, double>{"scale_y_px_per_m", c.scaleY}}) {
    if (!(value > 0.)) {
      throw top.wrong(name, value, "a number > 0");
    }
  }
  return c;
}

//! Probability, null if not computed.
nlohmann::ordered_json jsonOf(const vpFitTest &fit)
{
  return {{"verdict", vpToString(fit.verdict)},
          {"level", fit.level},
          {"whole_probability", fit.wholeProbability},
          {"view_probability", fit.viewProbability},
          {"point_probability", fit.pointProbability},
          {"field_probability", fit.fieldProbability},
          {"worst_view", fit.worstView},
          {"worst_view_rms_px", fit.worstViewRms},
          {"worst_point_view", fit.worstPointView},
          {"worst_point", fit.worstPoint},
          {"worst_point_distance_px", fit.worstPointDistance}};
}
} // namespace

nlohmann::ordered_json jsonOf(const vpMicroscopeCalibrationResult &result, std::size_t views)
{
  const vpMicroscopeCalibration &c = result.calibration;
  nlohmann::ordered_json sigma = {{"scale_x_px_per_m", result.sigma(vpMicroscopeScaleX)},
                                  {"scale_y_px_per_m", result.sigma(vpMicroscopeScaleY)},
                                  {"rotation_deg", vpMath::deg(result.sigma(vpMicroscopeRotation))},
                                  {"tx_m", result.sigma(vpMicroscopeTx)},
                                  {"ty_m", result.sigma(vpMicroscopeTy)},
                                  {"kappa1_per_px2", result.kappa1Sigma},
                                  {"kappa1_at_corner_px", result.kappa1CornerSigma},
                                  {"tilt_x_per_px", result.sigma(vpMicroscopeTiltX)},
                                  {"tilt_y_per_px", result.sigma(vpMicroscopeTiltY)},
                                  {"stretch", result.sigma(vpMicroscopeStretch)},
                                  {"shear", result.sigma(vpMicroscopeShear)}};
  nlohmann::ordered_json covariance = nlohmann::ordered_json::array();
  for (Eigen::Index i = 0; i < result.covariance.rows(); ++i) {
    std::vector<double> row;
    for (Eigen::Index j = 0; j < result.covariance.cols(); ++j) {
      row.push_back(result.covariance(i, j));
    }
    covariance.push_back(row);
  }
  return {{"comment", result.message},
          {"width", c.width},
          {"height", c.height},
          {"scale_x_px_per_m", c.scaleX},
          {"scale_y_px_per_m", c.scaleY},
          {"rotation_deg", vpMath::deg(c.rotation)},
          {"mirrored", c.mirrored},
          {"tx_m", c.tx},
          {"ty_m", c.ty},
          {"kappa1_per_px2", c.kappa1},
          {"u0_px", c.u0},
          {"v0_px", c.v0},
          {"tilt_x_per_px", c.tiltX},
          {"tilt_y_per_px", c.tiltY},
          {"stretch", c.stretch},
          {"shear", c.shear},
          {"quality",
           {{"reliable", result.reliable},
            {"fit", jsonOf(result.fit)},
            {"kappa1_status", vpToString(result.kappa1Status)},
            {"kappa1_effect_px", result.kappa1Effect},
            {"standard_deviations", sigma},
            {"covariance_of",
             {"scale_x", "scale_y", "kappa1", "u0", "v0", "rotation_rad", "tx", "ty", "tilt_x", "tilt_y", "stretch",
              "shear"}},
            {"covariance", covariance},
            {"residual_rms_px", result.residualRms},
            {"variance_factor", result.varianceFactor},
            {"degrees_of_freedom", result.degreesOfFreedom},
            {"condition", result.condition},
            {"views", views},
            {"converged", result.converged}}}};
}

vpMicroscopeCalibration readCalibration(const std::string &file, const std::string &cameraName, unsigned int width,
                                        unsigned int height)
{
  const bool isXml = file.size() > 4 && file.compare(file.size() - 4, 4, ".xml") == 0;
  if (isXml) {
    try {
      return vpMicroscopeCalibration::loadXml(file, cameraName, width, height);
    }
    catch (const vpException &error) {
      throw std::runtime_error(error.getStringMessage());
    }
  }
  const vpMicroscopeCalibration calibration = readJson(file);
  if (calibration.width != width || calibration.height != height) {
    throw std::runtime_error(text("%s: is for images of %u x %u px, these have %u x %u px", file.c_str(),
                                  calibration.width, calibration.height, width, height));
  }
  return calibration;
}
} // namespace trackPattern
