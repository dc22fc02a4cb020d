/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTwistSpline.h
 * \brief A twist over time as a quadratic B-spline, whose bounds are those of its control points.
 */
#ifndef vpTwistSpline_h
#define vpTwistSpline_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/feedforward/vpServoMotionLimits.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

/*!
 * \brief One interval of the spline: three control points, #knot seconds apart; the middle one belongs to the middle of
 * the interval.
 *
 * Value, first and second derivative of a B-spline are in the convex hull of its control points, of their first
 * differences / knot and of their second differences / knot^2 (de Boor). So bounds on the norms of these, checked once per knot, hold at
 * every instant, and for differences between commands at any constant period.
 */
struct vpTwistSpline {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  static constexpr double knot = 0.01; //!< s

  Vector6 c0 = Vector6::Zero(), c1 = Vector6::Zero(), c2 = Vector6::Zero();

  static vpTwist toTwist(const Vector6 &x) { return {x[0], x[1], x[2], x[3], x[4], x[5]}; }
  static Vector6 fromTwist(const vpTwist &x) { return Eigen::Map<const Vector6>(x.data()); }

  //! Value at the fraction \e s of the interval.
  Vector6 at(double s) const { return 0.5 * (1. - s) * (1. - s) * c0 + (0.5 + s - s * s) * c1 + 0.5 * s * s * c2; }
  //! Mean from the fraction \e a to \e b > a.
  Vector6 mean(double a, double b) const
  {
    const auto sum = [this](double s) -> Vector6 {
      const double r = 1. - s;
      return (1. - r * r * r) / 6. * c0 + s * (0.5 + s * (0.5 - s / 3.)) * c1 + s * s * s / 6. * c2;
    };
    return (sum(b) - sum(a)) / (b - a);
  }
  //! On to the next interval.
  void push(const Vector6 &next)
  {
    c0 = c1;
    c1 = c2;
    c2 = next;
  }
  //! True when the camera stands still, and stays so when zeros follow.
  bool isAtRest() const { return c0.isZero(0.) && c1.isZero(0.) && c2.isZero(0.); }
};

//! Norms of velocity, acceleration and jerk of the linear part, then of the angular one.
using vpTwistNorms = Eigen::Array<double, 6, 1>;

/*!
 * \brief How far control points exceed the limits: the factor by which a motion would have to be slower.
 */
class vpTwistExcess
{
public:
  explicit vpTwistExcess(const vpServoMotionLimits &limits) : m_limits(normsOf(limits)) {}

  static vpTwistNorms normsOf(const vpServoMotionLimits &limits)
  {
    vpTwistNorms norms;
    norms << limits.linearVelocity, limits.linearAcceleration, limits.linearJerk, limits.angularVelocity,
        limits.angularAcceleration, limits.angularJerk;
    return norms;
  }
  //! Control points \e b, \e a (before it) and \e next, \e h seconds apart.
  static vpTwistNorms normsOf(const vpTwistSpline::Vector6 &a, const vpTwistSpline::Vector6 &b,
                              const vpTwistSpline::Vector6 &next, double h)
  {
    const vpTwistSpline::Vector6 rate = (next - b) / h, jerk = (next - 2. * b + a) / (h * h);
    vpTwistNorms norms;
    norms << next.head<3>().norm(), rate.head<3>().norm(), jerk.head<3>().norm(), next.tail<3>().norm(),
        rate.tail<3>().norm(), jerk.tail<3>().norm();
    return norms;
  }
  double of(const vpTwistNorms &norms) const
  {
    const vpTwistNorms share = norms / m_limits;
    if (!(share.sum() < std::numeric_limits<double>::infinity())) {
      return std::numeric_limits<double>::infinity(); // or a comparison might pass over a NaN
    }
    return std::max(
        {share[0], std::sqrt(share[1]), std::cbrt(share[2]), share[3], std::sqrt(share[4]), std::cbrt(share[5])});
  }

private:
  vpTwistNorms m_limits;
};

END_VISP_NAMESPACE
#endif
