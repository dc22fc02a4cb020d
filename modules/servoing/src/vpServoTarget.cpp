/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpServoTarget.h>

#include <visp3/core/vpException.h>

#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
void requireFinite(const std::vector<Eigen::Vector3d> &points, const char *kind)
{
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw vpException(vpException::badValue, "%s %zu of the servo target is (%g, %g, %g), must be finite", kind, i,
                        points[i].x(), points[i].y(), points[i].z());
    }
  }
}

void requireSide(const char *side, double value)
{
  if (!(value > 0. && std::isfinite(value))) {
    throw vpException(vpException::badValue, "%s of the servo target is %g m, must be > 0", side, value);
  }
}
} // namespace

vpServoTarget::vpServoTarget(std::vector<Eigen::Vector3d> points, std::vector<Eigen::Vector3d> outline)
  : m_points(std::move(points)), m_outline(std::move(outline))
{
  if (m_points.empty()) {
    throw vpException(vpException::badValue, "the servo target has no points, must have one or more");
  }
  requireFinite(m_points, "point");
  requireFinite(m_outline, "outline point");
  if (m_outline.empty()) {
    m_outline = m_points;
  }
}

vpServoTarget vpServoTarget::rectangle(double width, double height)
{
  requireSide("width", width);
  requireSide("height", height);
  const double x = 0.5 * width, y = 0.5 * height;
  return vpServoTarget({{-x, -y, 0.}, {x, -y, 0.}, {x, y, 0.}, {-x, y, 0.}});
}

void vpServoTarget::project(const std::vector<Eigen::Vector3d> &points, const vpHomogeneousMatrix &cMo,
                            std::vector<vpServoPoint> &images)
{
  images.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    Eigen::Vector3d p;
    for (unsigned int r = 0; r < 3; ++r) {
      p(r) = cMo[r][0] * points[i].x() + cMo[r][1] * points[i].y() + cMo[r][2] * points[i].z() + cMo[r][3];
    }
    images[i].visible = p.z() > 0.;
    if (images[i].visible) {
      images[i].x = p.x() / p.z();
      images[i].y = p.y() / p.z();
      images[i].Z = p.z();
    }
  }
}
vpServoGoal vpServoTarget::goal(const vpHomogeneousMatrix &cdMo) const
{
  vpServoGoal goal;
  goal.cdMo = cdMo;
  project(m_points, cdMo, goal.points);
  return goal;
}

void vpServoTarget::measure(const vpHomogeneousMatrix &cMo, double time, vpServoMeasurement &result) const
{
  result.valid = true;
  result.time = time;
  result.cMo = cMo;
  result.covariance = vpPoseCovariance();
  project(m_points, cMo, result.points);
  project(m_outline, cMo, result.outline);
}

void vpServoTarget::measure(const vpPlanarTargetResult &seen, double time, vpServoMeasurement &result) const
{
  result.valid = seen.found();
  result.time = time;
  if (result.valid) {
    measure(seen.cMo, time, result);
    result.covariance = seen.covariance;
  }
}

END_VISP_NAMESPACE
