/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Random views of a plane of cells for the tests of the planar calibration, and that of thesis section 7.2 as printed,
// for comparison.
#ifndef vpPlanarProblem_h
#define vpPlanarProblem_h

#include "vpCatch.h"

#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace vpPatternTest
{
VISP_DIRECT_USING_NAMESPACE

using Points = std::vector<vpCalibrationPoint>;

struct Problem {
  vpMicroscopeCalibration truth; // with the placement of view 0
  std::vector<vpMicroscopeCalibration> views;
  double pitchX = 220e-6, pitchY = 80e-6; // m
};

using vpTestSupport::uniform;

// mostTilt: rad; the rest of the problem does not depend on it.
inline Problem randomProblem(std::mt19937_64 &rng, int views, double kappa, unsigned int width = 640,
                             unsigned int height = 480, double mostTilt = 0.)
{
  Problem problem;
  vpMicroscopeCalibration &c = problem.truth;
  c.width = width;
  c.height = height;
  c.scaleX = c.scaleY = 1e6 / (width < 320 ? 4.5 : uniform(rng, 3., 6.));
  c.kappa1 = kappa;
  c.u0 = 0.5 * (width - 1.);
  c.v0 = 0.5 * (height - 1.);
  c.mirrored = uniform(rng, 0., 1.) < 0.5;
  const double tilt = uniform(rng, 0., mostTilt), way = uniform(rng, -M_PI, M_PI), distance = 40000.; // px
  c.tiltX = std::sin(tilt) / distance * std::cos(way);
  c.tiltY = std::sin(tilt) / distance * std::sin(way);
  c.stretch = -0.5 * (1. - std::cos(tilt)) * std::cos(2. * way); // shorter across the axis of the tilt
  c.shear = -0.5 * (1. - std::cos(tilt)) * std::sin(2. * way);
  for (int k = 0; k < views; ++k) {
    c.rotation = width < 320 ? uniform(rng, -0.1, 0.1) : uniform(rng, -M_PI, M_PI); // a window must show two columns
    c.tx = uniform(rng, -5e-3, 5e-3); // the lattice is infinite, its origin may be far outside
    c.ty = uniform(rng, -5e-3, 5e-3);
    problem.views.push_back(c);
  }
  c = problem.views[0];
  return problem;
}

// The cells visible in a view, with noise.
inline Points pointsOf(const Problem &problem, std::size_t view, double sigmaU, double sigmaV, std::mt19937_64 &rng)
{
  const vpMicroscopeCalibration &c = problem.views[view];
  std::normal_distribution<double> normal;
  double least[2] = {1e9, 1e9}, most[2] = {-1e9, -1e9};
  for (const double u : {0., c.width - 1.}) {
    for (const double v : {0., c.height - 1.}) {
      const Eigen::Vector2d p = c.toPlane(u, v);
      for (const int axis : {0, 1}) {
        const double pitch = axis == 0 ? problem.pitchX : problem.pitchY;
        least[axis] = std::min(least[axis], std::floor(p[axis] / pitch));
        most[axis] = std::max(most[axis], std::ceil(p[axis] / pitch));
      }
    }
  }
  Points points;
  for (double row = least[1]; row <= most[1]; ++row) {
    for (double column = least[0]; column <= most[0]; ++column) {
      vpCalibrationPoint point;
      point.x = column * problem.pitchX;
      point.y = row * problem.pitchY;
      const Eigen::Vector2d seen = c.toImage(point.x, point.y);
      if (seen.x() > 0. && seen.y() > 0. && seen.x() < c.width - 1. && seen.y() < c.height - 1.) {
        point.u = seen.x() + sigmaU * normal(rng);
        point.v = seen.y() + sigmaV * normal(rng);
        point.sigmaU = sigmaU > 0. ? sigmaU : 1.;
        point.sigmaV = sigmaV > 0. ? sigmaV : 1.;
        points.push_back(point);
      }
    }
  }
  return points;
}

struct Moments {
  double sum = 0., squares = 0.;
  int n = 0;
  void add(double x)
  {
    sum += x;
    squares += x * x;
    ++n;
  }
  [[nodiscard]] double mean() const { return sum / n; }
  [[nodiscard]] double rms() const { return std::sqrt(squares / n); }
  [[nodiscard]] double sigma() const { return std::sqrt(squares / n - mean() * mean()); }
};

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
