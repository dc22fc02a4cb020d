/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlaneOutline.h"

#include <visp3/core/vpMeterPixelConversion.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double nearPlane = 1e-3; // m
} // namespace

vpPlaneOutline::vpPlaneOutline(const vpHomogeneousMatrix &cMo, double width, double height,
                               const vpCameraParameters &camera)
{
  const Eigen::Vector3d centre(cMo[0][3], cMo[1][3], cMo[2][3]), normal(cMo[0][2], cMo[1][2], cMo[2][2]);
  if (!(centre.dot(normal) > 0.)) {
    return; // seen from behind or from the side
  }
  Eigen::Vector3d corners[4];
  const double signs[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  for (int i = 0; i < 4; ++i) {
    const double x = signs[i][0] * width, y = signs[i][1] * height;
    for (int r = 0; r < 3; ++r) {
      corners[i](r) = cMo[r][0] * x + cMo[r][1] * y + cMo[r][3];
    }
  }
  const auto add = [&](const Eigen::Vector3d &P) {
    double u = 0., v = 0.;
    vpMeterPixelConversion::convertPoint(camera, P.x() / P.z(), P.y() / P.z(), u, v);
    m_u.push_back(u);
    m_v.push_back(v);
  };
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % 4];
    if (a.z() >= nearPlane) {
      add(a);
    }
    if ((a.z() >= nearPlane) != (b.z() >= nearPlane)) {
      add(a + (b - a) * ((nearPlane - a.z()) / (b.z() - a.z())));
    }
  }
}

double vpPlaneOutline::area() const
{
  double twice = 0.;
  for (std::size_t i = 0; i < m_u.size(); ++i) {
    const std::size_t k = (i + 1) % m_u.size();
    twice += m_u[i] * m_v[k] - m_u[k] * m_v[i];
  }
  return 0.5 * std::fabs(twice);
}

void vpPlaneOutline::box(double &left, double &top, double &right, double &bottom) const
{
  left = *std::min_element(m_u.begin(), m_u.end());
  right = *std::max_element(m_u.begin(), m_u.end());
  top = *std::min_element(m_v.begin(), m_v.end());
  bottom = *std::max_element(m_v.begin(), m_v.end());
}

bool vpPlaneOutline::span(double v, double &left, double &right) const
{
  left = std::numeric_limits<double>::max();
  right = -left;
  for (std::size_t i = 0; i < m_u.size(); ++i) {
    const std::size_t k = (i + 1) % m_u.size();
    // Half open, so that a vertex on the line counts for only one of its two edges.
    if ((m_v[i] <= v) != (m_v[k] <= v)) {
      const double u = m_u[i] + (m_u[k] - m_u[i]) * (v - m_v[i]) / (m_v[k] - m_v[i]);
      left = std::min(left, u);
      right = std::max(right, u);
    }
  }
  return left < right;
}

END_VISP_NAMESPACE
