/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Control loops in which everything changes on the fly, and implausible numbers: every output state is finite,
// continuous, and within the limits unless the status says otherwise.
#include "vpTrajectoryTestKit.h"

#include <visp3/direct_core/vpLimit.h>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
bool chance(std::mt19937_64 &rng, double p) { return uniform(rng, 0., 1.) < p; }

template <int N> void randomEvent(std::mt19937_64 &rng, vpTrajectoryInput<N> &input, double metre, double second)
{
  const int i = static_cast<int>(rng() % static_cast<unsigned int>(N));
  vpTrajectorySpec &o = input.spec;
  switch (rng() % 8) {
  case 0:
  case 1:
    input.goal.q[i] += metre * uniform(rng, -1., 1.) * logUniform(rng, 1e-4, 1.);
    input.goal.v[i] = chance(rng, 0.5) ? 0. : 0.9 * input.maxVelocity[i] * uniform(rng, -1., 1.);
    input.goal.a[i] = chance(rng, 0.5) ? 0. : 0.9 * input.maxAcceleration[i] * uniform(rng, -1., 1.);
    break;
  case 2:
    input.maxVelocity[i] = metre / second * logUniform(rng, 0.1, 10.);
    break;
  case 3:
    input.maxAcceleration[i] = metre / second / second * logUniform(rng, 0.1, 10.);
    break;
  case 4:
    input.maxJerk[i] = chance(rng, 0.5) ? none : input.maxAcceleration[i] / second * logUniform(rng, 0.3, 300.);
    break;
  case 5:
    input.minPosition[i] = chance(rng, 0.5) ? -none : input.goal.q[i] - metre * logUniform(rng, 1e-3, 10.);
    input.maxPosition[i] = chance(rng, 0.5) ? none : input.goal.q[i] + metre * logUniform(rng, 1e-3, 10.);
    break;
  case 6:
    o.policy = static_cast<vpReplanPolicy>(rng() % 3);
    o.arrivalTime = second * logUniform(rng, 0.03, 10.);
    o.minimumDuration = chance(rng, 0.5) ? 0. : second * logUniform(rng, 0.03, 3.);
    o.replanPeriod = chance(rng, 0.7) ? 0. : second * logUniform(rng, 0.01, 1.);
    o.freeze = chance(rng, 0.5) ? 0. : 0.05 * second;
    break;
  default:
    o.cruise = chance(rng, 0.5);
    o.synchronisation = static_cast<vpSynchronisation>(rng() % 3);
    o.method = chance(rng, 0.1) ? vpDurationMethod::ThesisIteration : vpDurationMethod::Exact;
    o.lateArrival = chance(rng, 0.2) ? vpLateArrival::ExceedLimits : vpLateArrival::Extend;
  }
}

bool saysSo(const vpTrajectoryStatus &status)
{
  return status.result == vpTrajectoryResult::Braking || !status.isGood() ||
         status.excess.limit != vpTrajectoryLimit::None;
}

template <int N> void stream(std::mt19937_64 &rng, double &worst)
{
  const double second = logUniform(rng, 1e-6, 1e6), metre = logUniform(rng, 1e-6, 1e6), dt = 0.02 * second;
  vpTrajectoryInput<N> input, accepted;
  for (int i = 0; i < N; ++i) {
    input.maxVelocity[i] = metre / second * logUniform(rng, 0.3, 3.);
    input.maxAcceleration[i] = metre / second / second * logUniform(rng, 0.3, 3.);
    input.goal.q[i] = metre * uniform(rng, -1., 1.);
  }
  vpDirectTrajectory<N> trajectory;
  vpTrajectoryOutput<N> output;
  vpTrajectoryState<N> before;
  vpTrajectoryPeaks planned[N];
  for (int k = 0; k < 100; ++k) {
    if (chance(rng, 0.2)) {
      randomEvent(rng, input, metre, second);
    }
    const vpTrajectoryResult result = trajectory.step(input, output, dt);
    const vpTrajectoryState<N> &x = output.state;
    CAPTURE(k, output.status.message(), vpToString(trajectory.plan().form()), output.time, output.duration);
    REQUIRE((x.q.allFinite() && x.v.allFinite() && x.a.allFinite() && x.j.allFinite()));
    REQUIRE((std::isfinite(output.remaining) && std::isfinite(output.duration)));
    if (result != vpTrajectoryResult::InvalidInput) {
      accepted = input; // otherwise the motion continues within the previous limits
      for (int i = 0; i < N; ++i) {
        const double place = std::max({metre, std::abs(x.q[i]), std::abs(input.goal.q[i])});
        const double excess =
            std::max({std::abs(x.v[i]) / input.maxVelocity[i] - 1., std::abs(x.a[i]) / input.maxAcceleration[i] - 1.,
                      (x.q[i] - input.maxPosition[i]) / place, (input.minPosition[i] - x.q[i]) / place});
        CAPTURE(i, x.q[i], x.v[i], x.a[i], excess, input.maxVelocity[i], input.maxAcceleration[i], input.minPosition[i],
                input.maxPosition[i], input.spec.freeze, static_cast<int>(input.spec.policy),
                static_cast<int>(input.spec.method), output.newPlan, trajectory.plan().brakingEnd(), output.remaining);
        // A start beyond a limit by at most vpLimit::tolerance counts as on it.
        REQUIRE((excess <= vpLimit::tolerance || saysSo(output.status)));
        worst = saysSo(output.status) ? worst : std::max(worst, excess);
      }
    }
    // Continuous: changes per cycle are within the derivatives of the plan.
    for (int i = 0; i < N; ++i) {
      vpTrajectoryPeaks &peaks = planned[i];
      if (output.newPlan) {
        peaks = trajectory.plan().peaks(i); // until the arrival
        for (int s = 0; s < trajectory.plan().coasting(i); ++s) {
          const vpTrajectorySegment &after = trajectory.plan().segment(i, trajectory.plan().segments(i) + s);
          const vpPolynomial rate = after.p.derivative();
          const double r = 1. / after.duration;
          peaks.velocity = std::max(peaks.velocity, r * rate.range().peak());
          peaks.acceleration = std::max(peaks.acceleration, r * r * rate.derivative().range().peak());
        }
      }
      const double v = std::max({peaks.velocity, std::abs(before.v[i]), std::abs(x.v[i])});
      const double a = std::max({peaks.acceleration, std::abs(before.a[i]), std::abs(x.a[i])});
      CAPTURE(i, x.q[i], before.q[i], x.v[i], before.v[i], v, a);
      REQUIRE(std::abs(x.q[i] - before.q[i]) <= 1.01 * v * dt + 1e-9 * (std::abs(x.q[i]) + metre));
      REQUIRE(std::abs(x.v[i] - before.v[i]) <= 1.01 * a * dt + 1e-9 * (v + metre / second));
    }
    before = x;
  }
}
} // namespace

TEST_CASE("streams with events: finite, continuous, within the limits or told", "[streams]")
{
  auto rng = vpTestSupport::generator(210);
  CAPTURE(vpTestSupport::seed());
  const int count = vpTestSupport::longer(500);
  double worst = -1.;
  for (int k = 0; k < count; ++k) {
    CAPTURE(k);
    k % 2 == 0 ? stream<1>(rng, worst) : stream<3>(rng, worst);
  }
  WARN(count << " streams of 100 cycles: largest untold excess " << worst);
}

TEST_CASE("numbers that no robot has: refused, or a finite motion", "[streams]")
{
  auto rng = vpTestSupport::generator(211);
  CAPTURE(vpTestSupport::seed());
  const double strange[] = {std::nan(""), none,    -none, 1e154, -1e154, 1e300,  1e308, -1e308, 1.7976931348623157e308,
                            5e-324,       -5e-324, 0.,    -0.,   1e-308, 1e-154, 1e-13, 1e12,   -1e12,
                            1e13,         1e-12,   1e-9,  1e9,   1e6,    -1.,    1.,    1e-300};
  const auto pick = [&] { return strange[rng() % (sizeof(strange) / sizeof(strange[0]))]; };
  int refused = 0;
  const int count = vpTestSupport::longer(20000);
  for (int k = 0; k < count; ++k) {
    vpTrajectoryInput<2> input;
    input.goal.q << 0.5, -0.3;
    input.start.v << 0.2, 0.;
    vpTrajectorySpec &o = input.spec;
    double spec[] = {1., 0., 0.05, 0., 0.5, 0.1, none, none};
    vpAxisVector<2> *fields[] = {&input.start.q,     &input.start.v,         &input.start.a, &input.start.j,
                                 &input.goal.q,      &input.goal.v,          &input.goal.a,  &input.goal.j,
                                 &input.maxVelocity, &input.maxAcceleration, &input.maxJerk, &input.minPosition,
                                 &input.maxPosition};
    for (int s = 1 + static_cast<int>(rng() % 3); s > 0; --s) {
      const auto field = rng() % 21;
      (field < 13 ? (*fields[field])[static_cast<Eigen::Index>(rng() % 2)] : spec[field - 13]) = pick();
    }
    o.arrivalTime = spec[0], o.minimumDuration = spec[1], o.freeze = spec[2], o.replanPeriod = spec[3];
    o.thesisVelocityGain = spec[4], o.thesisAccelerationGain = spec[5];
    if (chance(rng, 0.2)) {
      o.groups[0] = vpAxisGroup({0, 1}, spec[6], spec[7]);
    }
    o.continuity = static_cast<vpTrajectoryContinuity>(rng() % 3);
    o.policy = static_cast<vpReplanPolicy>(rng() % 3);
    o.synchronisation = static_cast<vpSynchronisation>(rng() % 3);
    o.lateArrival = static_cast<vpLateArrival>(rng() % 2);
    o.method = static_cast<vpDurationMethod>(rng() % 4 == 0);
    o.cruise = rng() % 2 == 0;
    vpDirectTrajectory<2> trajectory;
    vpTrajectoryOutput<2> output;
    for (int cycle = 0; cycle < 6; ++cycle) {
      const double dt = cycle == 2 || cycle == 4 ? pick() : 0.01;
      const vpTrajectoryResult result = trajectory.step(input, output, dt);
      const vpTrajectoryState<2> &x = output.state;
      CAPTURE(k, cycle, dt, output.status.message(), x.q.transpose(), x.v.transpose(), x.a.transpose());
      REQUIRE((x.q.allFinite() && x.v.allFinite() && x.a.allFinite() && x.j.allFinite()));
      REQUIRE((std::isfinite(output.time) && std::isfinite(output.duration) && std::isfinite(output.remaining)));
      refused += result == vpTrajectoryResult::InvalidInput;
    }
  }
  WARN(count << " inputs with strange numbers, 6 cycles each: " << refused << " cycles refused");
  CHECK(refused > count);
}
