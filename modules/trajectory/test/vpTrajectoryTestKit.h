/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryTestKit.h
 * \brief Random problems and independent checks of plans, shared by the tests of this module.
 */
#ifndef vpTrajectoryTestKit_h
#define vpTrajectoryTestKit_h

#include "vpCatch.h"

#include <visp3/trajectory/vpDirectTrajectory.h>

#include <cmath>
#include <cstdlib>

namespace vpTrajectoryTest
{
VISP_DIRECT_USING_NAMESPACE

//! Failures print all digits.
inline const bool allDigits = (Catch::StringMaker<double>::precision = 17) > 0;

constexpr double none = std::numeric_limits<double>::infinity();

using vpTestSupport::uniform;

//! Between low and high, equally often in each decade.
inline double logUniform(std::mt19937_64 &rng, double low, double high)
{
  return std::exp(uniform(rng, std::log(low), std::log(high)));
}

//! Types of start and goal.
enum class Class { RestToRest, Retarget, AnyToRest, AnyToAny };

//! A random state strictly inside the limits of an axis, with jerk limits also one that can be left and reached.
template <int N> void randomMotion(std::mt19937_64 &rng, const vpTrajectoryInput<N> &input, int i, double &v, double &a)
{
  v = uniform(rng, -0.999, 0.999) * input.maxVelocity[i];
  a = uniform(rng, -0.999, 0.999) * input.maxAcceleration[i];
  if (std::isfinite(input.maxJerk[i])) {
    // Taking a to zero at full jerk changes v by a^2/(2 j): stay inside both before and after.
    const double room = 0.999 * (input.maxVelocity[i] - std::abs(v));
    a = std::copysign(std::min(std::abs(a), std::sqrt(2. * input.maxJerk[i] * room)), a);
  }
}

//! A random problem; the limits span two decades, so that axes with very different needs meet.
template <int N> vpTrajectoryInput<N> randomInput(std::mt19937_64 &rng, Class kind, bool jerk, int axes = N)
{
  vpTrajectoryInput<N> input(axes);
  for (int i = 0; i < axes; ++i) {
    input.maxVelocity[i] = logUniform(rng, 0.1, 10.);
    input.maxAcceleration[i] = logUniform(rng, 0.1, 10.);
    input.maxJerk[i] = jerk ? logUniform(rng, 1., 100.) * input.maxAcceleration[i] : none;
    input.start.q[i] = uniform(rng, -2., 2.);
    input.goal.q[i] = uniform(rng, -2., 2.);
    if (kind == Class::AnyToRest || kind == Class::AnyToAny) {
      randomMotion(rng, input, i, input.start.v[i], input.start.a[i]);
    }
    if (kind == Class::AnyToAny) {
      randomMotion(rng, input, i, input.goal.v[i], input.goal.a[i]);
    }
  }
  if (kind == Class::Retarget) {
    // Somewhere on the way to another goal.
    vpTrajectoryPlan plan(axes);
    REQUIRE(vpDirectTrajectory<N>::calculate(input, plan).isGood());
    const double t = uniform(rng, 0.01, 0.99) * plan.duration();
    for (int i = 0; i < axes; ++i) {
      const vpAxisState x = plan.at(i, t);
      input.start.q[i] = x[0];
      input.start.v[i] = x[1];
      input.start.a[i] = x[2];
      input.goal.q[i] = uniform(rng, -2., 2.);
    }
  }
  return input;
}

//! Largest relative excess of a plan over the limits, at the exact extrema.
template <int N> double worstViolation(const vpTrajectoryInput<N> &input, const vpTrajectoryPlan &plan)
{
  double worst = -1.;
  for (int i = 0; i < plan.axes(); ++i) {
    const vpTrajectoryPeaks peaks = plan.peaks(i);
    worst = std::max({worst, peaks.velocity / input.maxVelocity[i] - 1., peaks.jerk / input.maxJerk[i] - 1.});
    if (input.spec.continuity != vpTrajectoryContinuity::C1 || std::isfinite(input.maxAcceleration[i])) {
      worst = std::max(worst, peaks.acceleration / input.maxAcceleration[i] - 1.);
    }
    const double size = std::max(std::abs(peaks.maxPosition), std::abs(peaks.minPosition)) + 1e-300;
    worst = std::max(
        {worst, (peaks.maxPosition - input.maxPosition[i]) / size, (input.minPosition[i] - peaks.minPosition) / size});
  }
  for (const vpAxisGroup &group : input.spec.groups) {
    if (group.axes != 0) {
      worst = std::max({worst, plan.peakNorm(group.axes, 1) / group.maxSpeed - 1.,
                        plan.peakNorm(group.axes, 2) / group.maxAcceleration - 1.});
    }
  }
  return worst;
}

//! State of a segment at its own s, by the definition.
inline vpAxisState onSegment(const vpTrajectorySegment &segment, double s)
{
  const auto x = segment.p.jet(s);
  return {x[0], x[1] / segment.duration, x[2] / std::pow(segment.duration, 2), x[3] / std::pow(segment.duration, 3)};
}

//! Largest mismatch at start, joints and end, each derivative relative to the scale of the axis.
template <int N> double worstMismatch(const vpTrajectoryInput<N> &input, const vpTrajectoryPlan &plan)
{
  double worst = 0.;
  const int given = 2 + static_cast<int>(input.spec.continuity);
  const auto compare = [&](int i, const vpAxisState &x, const vpAxisState &y) {
    // Relative to the rounding scale: positions to the distance covered, accelerations to v/T when that is larger.
    const vpTrajectoryPeaks peaks = plan.peaks(i);
    const double scale[4] = {
        std::max(1., peaks.maxPosition - peaks.minPosition), std::min(input.maxVelocity[i], 1e6),
        std::max(std::min(input.maxAcceleration[i], 1e6), std::min(input.maxVelocity[i], 1e6) / plan.duration()),
        std::min(input.maxJerk[i], 10. * std::min(input.maxAcceleration[i], 1e6))};
    for (int k = 0; k < given; ++k) {
      worst = std::max(worst, std::abs(x[static_cast<std::size_t>(k)] - y[static_cast<std::size_t>(k)]) / scale[k]);
    }
  };
  for (int i = 0; i < plan.axes(); ++i) {
    const vpAxisState start{input.start.q[i], input.start.v[i], input.start.a[i], input.start.j[i]};
    const vpAxisState goal{input.goal.q[i], input.goal.v[i], input.goal.a[i], input.goal.j[i]};
    if (plan.segments(i) == 0) {
      compare(i, start, goal);
      continue;
    }
    compare(i, onSegment(plan.segment(i, 0), 0.), start);
    compare(i, onSegment(plan.segment(i, plan.segments(i) - 1), 1.), goal);
    for (int k = 1; k < plan.segments(i); ++k) {
      compare(i, onSegment(plan.segment(i, k - 1), 1.), onSegment(plan.segment(i, k), 0.));
    }
  }
  return worst;
}
} // namespace vpTrajectoryTest

#endif
