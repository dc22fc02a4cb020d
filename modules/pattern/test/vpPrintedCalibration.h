/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The calibration of thesis section 7.2 as printed, for comparison.
#ifndef vpPrintedCalibration_h
#define vpPrintedCalibration_h

#include "vpPlanarProblem.h"

namespace vpPatternTest
{
// Thesis (7.8) to (7.11) as printed: 5-vector divided by ty, rows of u and v added. NaN where it fails.
struct Literal {
  double scale = NAN, kappa = NAN;
};
// \param stacked : (7.11) with the rows of u and v stacked instead.
inline Literal literal(const Points &points, double u0, double v0, bool mirrored, bool stacked)
{
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd rows(n, 5);
  Eigen::VectorXd right(n);
  const auto at = [&](Eigen::Index i, double &u, double &v, double &x, double &y) {
    const vpCalibrationPoint &point = points[static_cast<std::size_t>(i)];
    u = point.u - u0;
    v = point.v - v0;
    x = 1e3 * point.x; // mm
    y = 1e3 * (mirrored ? -point.y : point.y);
  };
  double u = 0., v = 0., x = 0., y = 0.;
  for (Eigen::Index i = 0; i < n; ++i) {
    at(i, u, v, x, y);
    rows.row(i) << v * x, v * y, v, -u * x, -u * y;
    right[i] = u;
  }
  const Eigen::VectorXd h = rows.colPivHouseholderQr().solve(right);
  // r11 = r22 and r12 = -r21: ty from the length of the first columns, its sign from a point.
  double ty = 1. / std::sqrt(0.5 * (h[0] * h[0] + h[1] * h[1] + h[3] * h[3] + h[4] * h[4]));
  at(0, u, v, x, y);
  if ((ty * (h[0] * x + h[1] * y + h[2])) * u < 0.) {
    ty = -ty;
  }
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    at(i, u, v, x, y);
    const double p = ty * (h[0] * x + h[1] * y + h[2]), q = ty * (h[3] * x + h[4] * y + 1.), r2 = u * u + v * v;
    if (stacked) {
      const Eigen::Vector2d a(p, -u * r2), b(q, -v * r2);
      normal += a * a.transpose() + b * b.transpose();
      sum += a * u + b * v;
    }
    else {
      const Eigen::Vector2d a(p + q, -(u + v) * r2);
      normal += a * a.transpose();
      sum += a * (u + v);
    }
  }
  const Eigen::Vector2d unit = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Vector2d solution =
      unit.asDiagonal() * (unit.asDiagonal() * normal * unit.asDiagonal()).inverse() * (unit.asDiagonal() * sum);
  return {1e3 * solution[0], solution[1]};
}
} // namespace vpPatternTest

#endif
