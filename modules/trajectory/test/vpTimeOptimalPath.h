/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTimeOptimalPath.h
 * \brief A peer for motions through vias: the time-optimal motion along a spline, by reachability analysis (TOPP-RA).
 */
#ifndef vpTimeOptimalPath_h
#define vpTimeOptimalPath_h

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace vpTimeOptimalPath
{
//! Cubic spline through points (rows) at 0, 1, 2, ..., with zero derivative at both ends.
class Spline
{
public:
  explicit Spline(const Eigen::MatrixXd &points) : m_points(points), m_second(points.rows(), points.cols())
  {
    const Eigen::Index n = points.rows();
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n), b(n, points.cols());
    for (Eigen::Index i = 0; i < n; ++i) {
      a(i, i) = i == 0 || i == n - 1 ? 2. : 4.;
      b.row(i).setZero();
      if (i > 0) {
        a(i, i - 1) = 1.;
        b.row(i) -= 6. * (points.row(i) - points.row(i - 1));
      }
      if (i + 1 < n) {
        a(i, i + 1) = 1.;
        b.row(i) += 6. * (points.row(i + 1) - points.row(i));
      }
    }
    m_second = a.partialPivLu().solve(b);
  }
  [[nodiscard]] double length() const { return static_cast<double>(m_points.rows() - 1); } //!< Last parameter.
  //! First and second derivative at the parameter \e s.
  void derivatives(double s, Eigen::VectorXd &first, Eigen::VectorXd &second) const
  {
    const auto i = std::min(static_cast<Eigen::Index>(s), m_points.rows() - 2);
    const double b = s - static_cast<double>(i), a = 1. - b;
    first = (m_points.row(i + 1) - m_points.row(i) - (3. * a * a - 1.) / 6. * m_second.row(i) +
             (3. * b * b - 1.) / 6. * m_second.row(i + 1))
                .transpose();
    second = (a * m_second.row(i) + b * m_second.row(i + 1)).transpose();
  }

private:
  Eigen::MatrixXd m_points, m_second;
};

/*!
 * Duration of the fastest motion from rest to rest along \e path within limits on velocity and acceleration, in s.
 * With u the second and x the squared first time derivative of the parameter, limits at each of \e intervals + 1 places
 * are linear: |q' u + q'' x| <= a_max, q'^2 x <= v_max^2. The largest x from which the end can be reached, backwards; then
 * forwards the largest x each time (Pham and Pham, 2018). Towards many intervals it converges from above or below.
 */
inline double duration(const Spline &path, const Eigen::VectorXd &maxVelocity, const Eigen::VectorXd &maxAcceleration,
                       int intervals)
{
  struct Line { // a u + b x <= c
    double a, b, c;
  };
  const auto count = static_cast<std::size_t>(intervals);
  const double step = path.length() / intervals;
  std::vector<Eigen::VectorXd> first(count + 1), second(count + 1);
  for (std::size_t k = 0; k <= count; ++k) {
    path.derivatives(static_cast<double>(k) * step, first[k], second[k]);
  }
  std::vector<Line> lines;
  const auto setLines = [&](std::size_t k, double next) {
    lines.clear();
    for (Eigen::Index i = 0; i < maxVelocity.size(); ++i) {
      lines.push_back({first[k][i], second[k][i], maxAcceleration[i]});
      lines.push_back({-first[k][i], -second[k][i], maxAcceleration[i]});
    }
    lines.push_back({2. * step, 1., next}); // 0 <= x + 2 step u <= next
    lines.push_back({-2. * step, -1., 0.});
  };
  constexpr double none = std::numeric_limits<double>::infinity(), tiny = 1e-14;
  std::vector<double> largest(count + 1, 0.);
  for (std::size_t k = count; k-- > 0;) {
    double x = none;
    for (Eigen::Index i = 0; i < maxVelocity.size(); ++i) {
      x = first[k][i] != 0. ? std::min(x, std::pow(maxVelocity[i] / first[k][i], 2)) : x;
    }
    setLines(k, largest[k + 1]);
    for (const Line &upper : lines) {
      if (std::abs(upper.a) <= tiny) {
        x = upper.b > 0. ? std::min(x, upper.c / upper.b) : x;
        continue;
      }
      for (const Line &lower : lines) { // the lower bound of u is below the upper one
        const double slope = upper.b / upper.a - lower.b / lower.a;
        if (upper.a > tiny && lower.a < -tiny && slope > 0.) {
          x = std::min(x, (upper.c / upper.a - lower.c / lower.a) / slope);
        }
      }
    }
    largest[k] = std::max(x, 0.);
  }
  double time = 0., x = 0.;
  for (std::size_t k = 0; k < count; ++k) {
    setLines(k, largest[k + 1]);
    double u = none;
    for (const Line &line : lines) {
      u = line.a > tiny ? std::min(u, (line.c - line.b * x) / line.a) : u;
    }
    const double next = std::max(x + 2. * step * u, 0.);
    time += 2. * step / (std::sqrt(x) + std::sqrt(next));
    x = next;
  }
  return time;
}
} // namespace vpTimeOptimalPath

#endif
