/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCalibrationInput.h"

#include <visp3/core/vpException.h>

#include <Eigen/Dense>

#include <cmath>
#include <initializer_list>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
vpCalibrationSpread spreadOf(const Eigen::Matrix<double, 3, Eigen::Dynamic> &all)
{
  vpCalibrationSpread spread;
  spread.centre = all.rowwise().mean();
  const Eigen::Matrix<double, 3, Eigen::Dynamic> centred = all.colwise() - spread.centre;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeFullU);
  spread.axes = svd.matrixU();
  if (spread.axes.determinant() < 0.) {
    spread.axes.col(2) *= -1.;
  }
  spread.sigma.setZero();
  spread.sigma.head(svd.singularValues().size()) = svd.singularValues() / std::sqrt(static_cast<double>(all.cols()));
  return spread;
}
} // namespace

void vpCheckCalibrationRange(const char *field, double value, double least, double most, const char *unit)
{
  if (!(value >= least && value <= most)) {
    throw vpException(vpException::badValue, "%s is %g%s, must be in [%g, %g]", field, value, unit, least, most);
  }
}

void vpCheckCalibrationImage(unsigned int width, unsigned int height)
{
  vpCheckCalibrationRange("width", width, 8., 65536., " px");
  vpCheckCalibrationRange("height", height, 8., 65536., " px");
}

void vpCheckPrincipalPoint(const char *field, double value)
{
  if (std::isinf(value) || std::abs(value) > 1e6) {
    throw vpException(vpException::badValue, "%s is %g px, must be within 1e6 px or NaN for the centre of the image",
                      field, value);
  }
}

void vpCheckCalibrationView(std::size_t view, const std::vector<vpCalibrationPoint> &points, std::size_t least)
{
  if (points.size() < least) {
    throw vpException(vpException::badValue, "view %zu has %zu points, must have at least %zu", view, points.size(),
                      least);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vpCalibrationPoint &p = points[i];
    const std::initializer_list<std::pair<const char *, double>> places = {
        {"u", p.u}, {"v", p.v}, {"x", p.x}, {"y", p.y}, {"z", p.z}};
    for (const auto &[name, value] : places) {
      if (!std::isfinite(value)) {
        throw vpException(vpException::badValue, "point %zu of view %zu: %s is %g, must be finite", i, view, name,
                          value);
      }
    }
    const std::initializer_list<std::pair<const char *, double>> deviations = {{"sigmaU", p.sigmaU},
                                                                               {"sigmaV", p.sigmaV}};
    for (const auto &[name, value] : deviations) {
      if (!(value > 0. && std::isfinite(value))) {
        throw vpException(vpException::badValue, "point %zu of view %zu: %s is %g px, must be > 0", i, view, name,
                          value);
      }
    }
    if (!(p.sigmaPlane >= 0. && std::isfinite(p.sigmaPlane))) {
      throw vpException(vpException::badValue, "point %zu of view %zu: sigmaPlane is %g m, must be >= 0", i, view,
                        p.sigmaPlane);
    }
  }
}

vpCalibrationSpread vpSpreadOf(const std::vector<vpCalibrationPoint> &points)
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) << points[i].x, points[i].y, points[i].z;
  }
  return spreadOf(all);
}

vpCalibrationSpread vpImageSpreadOf(const std::vector<vpCalibrationPoint> &points)
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> all(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.col(static_cast<Eigen::Index>(i)) << points[i].u, points[i].v, 0.;
  }
  return spreadOf(all);
}

END_VISP_NAMESPACE
