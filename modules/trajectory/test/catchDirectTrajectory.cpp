/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Independently derived reference values, and cycle-by-cycle use.
#include "vpTrajectoryTestKit.h"

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
vpTrajectoryInput<1> figureInput(double goal, double v, double a)
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = goal;
  input.maxVelocity[0] = v;
  input.maxAcceleration[0] = a;
  return input;
}

// Follows 0.5, changes `input` by `event` at t = 1.2 s; returns the time of arrival that the new plan promises.
template <typename Event> double arrivalAfter(vpTrajectoryInput<1> input, Event event)
{
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryOutput<1> output;
  for (int i = 0; i < 1200; ++i) {
    REQUIRE(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Working);
  }
  event(input);
  static_cast<void>(trajectory.step(input, output, 1e-3));
  REQUIRE(output.newPlan);
  return 1.2 + output.duration;
}
} // namespace

TEST_CASE("rest to rest: durations, jerk and the state on the way", "[reference]")
{
  vpTrajectoryPlan plan(1);
  REQUIRE(vpDirectTrajectory<1>::calculate(figureInput(0.5, none, 1.), plan).isGood());
  CHECK(std::abs(plan.duration() - 1.699044244847) < 1e-9);
  REQUIRE(
      vpDirectTrajectory<1>::calculate(figureInput(-0.5, 0.5, 1.), plan).isGood()); // |h|, and the larger of the two
  CHECK(std::abs(plan.duration() - 1.875) < 1e-12);
  REQUIRE(vpDirectTrajectory<1>::calculate(figureInput(0.5, 0.5, 1.), plan).isGood());
  CHECK(std::abs(plan.duration() - 1.875) < 1e-12);
  const vpTrajectoryPeaks peaks = plan.peaks(0);
  CHECK(std::abs(peaks.velocity - 0.5) < 1e-12);
  CHECK(std::abs(peaks.jerk - 4.551111111111) < 1e-9);
  CHECK(std::abs(peaks.squaredJerk - 7.767229630) < 1e-9);
  CHECK(std::abs(peaks.squaredJerk - 720. * 0.25 / std::pow(1.875, 5)) < 1e-12);
  const vpAxisState x = plan.at(0, 1.2);
  CHECK(std::abs(x[0] - 0.3745513472) < 1e-12);
  CHECK(std::abs(x[1] - 0.42467328) < 1e-12);
  CHECK(std::abs(x[2] + 0.5505024) < 1e-12);
}

TEST_CASE("figures 6.3 to 6.5: the goal moves to 0.8 at 1.2 s", "[reference]")
{
  const double fig63 =
      arrivalAfter(figureInput(0.5, 0.5, none), [](vpTrajectoryInput<1> &input) { input.goal.q[0] = 0.8; });
  CHECK(std::abs(fig63 - 2.442439077777) < 1e-9);
  const double fig64 = arrivalAfter(figureInput(0.5, 0.5, none), [](vpTrajectoryInput<1> &input) {
    input.goal.q[0] = 0.8;
    input.maxVelocity[0] = none;
    input.maxAcceleration[0] = 1.;
  });
  CHECK(std::abs(fig64 - 2.474039801872) < 1e-9);

  // Figure 6.5: the time is kept, so the limits are exceeded, and this is reported.
  auto input = figureInput(0.5, 0.5, 1.);
  input.spec.policy = vpReplanPolicy::FixedArrival;
  input.spec.arrivalTime = 1.875;
  input.spec.lateArrival = vpLateArrival::ExceedLimits;
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryOutput<1> output;
  for (int i = 0; i < 1200; ++i) {
    REQUIRE(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Working);
  }
  input.goal.q[0] = 0.8;
  CHECK(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::ArrivalInfeasible);
  CHECK(output.duration == Approx(0.675).margin(1e-12));
  CHECK(std::abs(trajectory.plan().peaks(0).velocity - 1.018928653) < 1e-9);
  CHECK(std::abs(trajectory.plan().peaks(0).acceleration - 4.321256684) < 1e-8);
  CHECK(output.status.value > 0.675); // the earliest feasible arrival
  CHECK_THAT(output.status.message(), Catch::Contains("earliest feasible arrival is in"));
  // With the limits kept, it arrives then.
  const double earliest = output.status.value;
  vpTrajectoryInput<1> kept = input;
  kept.start = output.state;
  const double fig65 = arrivalAfter(figureInput(0.5, 0.5, 1.), [](vpTrajectoryInput<1> &i) {
    i.goal.q[0] = 0.8;
    i.spec.policy = vpReplanPolicy::FixedArrival;
    i.spec.arrivalTime = 0.675;
  });
  CHECK(fig65 - 1.2 == Approx(earliest).margin(1e-9));
}

TEST_CASE("sixth order and printing", "[reference]")
{
  vpTrajectoryPlan plan(1);
  auto input = figureInput(1., 1., none);
  vpTrajectoryVia<1> via;
  via.tau = 0.5;
  via.q[0] = 0.8;
  input.vias.push_back(via);
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.peaks(0).velocity * plan.duration() == Approx(2.449).margin(5e-4)); // peak v T/h
  CHECK(std::abs(plan.at(0, 0.5 * plan.duration())[0] - 0.8) < 1e-12);
  CHECK(plan.segment(0, 0).p.degree() == 6);

  // (6.10), (6.11) corrected: via at h/2, T/2 with v and a fixed to zero.
  input.vias[0].q[0] = 0.5;
  input.vias[0].hasVelocity = input.vias[0].hasAcceleration = true;
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.segment(0, 0).p.degree() == 8);
  CHECK(plan.duration() == Approx(1.94444).margin(5e-6));
  input.maxVelocity[0] = none;
  input.maxAcceleration[0] = 1.;
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.duration() == Approx(3.80782).margin(5e-6));
  CHECK(plan.peaks(0).acceleration * std::pow(plan.duration(), 2) == Approx(14.49946).margin(5e-6));

  // Printing: a pitch of 48.8889 px, 4 px/frame at both ends, 5 on average.
  auto print = figureInput(48.8889, none, none);
  print.start.v[0] = print.goal.v[0] = 4.;
  print.spec.policy = vpReplanPolicy::FixedArrival;
  print.spec.arrivalTime = 48.8889 / 5.;
  REQUIRE(vpDirectTrajectory<1>::calculate(print, plan).isGood());
  CHECK(plan.duration() == Approx(9.777778).margin(1e-5));
  CHECK(plan.peaks(0).velocity == Approx(5.875).margin(1e-9));
}

TEST_CASE("replaying a plan cycle by cycle stays on it, with any dt", "[cycle]")
{
  auto rng = vpTestSupport::generator(60);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 300; ++k) {
    auto input = randomInput<3>(rng, static_cast<Class>(k % 4), k % 8 >= 4);
    input.spec.replanPeriod = k % 3 == 0 ? 0.01 : 0.; // rate-based: the same polynomial again and again
    vpTrajectoryPlan plan(3);
    REQUIRE(vpDirectTrajectory<3>::calculate(input, plan).isGood());
    if (input.spec.replanPeriod > 0. && plan.form() != vpTrajectoryForm::Direct) {
      continue; // other forms are not unique
    }
    vpDirectTrajectory<3> trajectory;
    vpTrajectoryOutput<3> output;
    double t = 0., worst = 0.;
    int plans = 0;
    while (t < plan.duration() + 0.1) {
      const double dt = uniform(rng, 1e-4, 0.02) * std::max(plan.duration() / 3., 0.1);
      static_cast<void>(trajectory.step(input, output, dt));
      t += dt;
      plans += output.newPlan;
      for (int i = 0; i < 3; ++i) {
        const vpAxisState x = plan.at(i, t);
        const double scale[3] = {1. + std::abs(x[0]), input.maxVelocity[i],
                                 std::max(input.maxAcceleration[i], input.maxVelocity[i])};
        worst =
            std::max({worst, std::abs(output.state.q[i] - x[0]) / scale[0],
                      std::abs(output.state.v[i] - x[1]) / scale[1], std::abs(output.state.a[i] - x[2]) / scale[2]});
      }
    }
    CAPTURE(k, plans, plan.duration(), vpToString(plan.form()), worst);
    CHECK((input.spec.replanPeriod > 0. || plans == 1));
    REQUIRE(worst < (plans == 1 ? 1e-12 : 1e-9)); // each new polynomial rounds a little
    CHECK(output.remaining == 0.);
  }
}

TEST_CASE("finished once, then holding, then on to the next goal", "[cycle]")
{
  auto input = figureInput(0.5, 0.5, 1.);
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryOutput<1> output;
  int finished = 0, cycles = 0;
  while (trajectory.step(input, output, 1e-3) != vpTrajectoryResult::Holding) {
    finished += output.status.result == vpTrajectoryResult::Finished;
    ++cycles;
  }
  CHECK(finished == 1);
  CHECK(cycles == 1875);
  CHECK(output.state.q[0] == 0.5);
  CHECK(output.state.v[0] == 0.);
  CHECK(output.status.message() == "the goal was reached before, nothing changed");
  input.goal.q[0] = 0.;
  CHECK(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Working);
  CHECK(output.newPlan);
  CHECK(output.state.q[0] < 0.5);

  // A goal with a velocity: the velocity is kept; the acceleration is ramped down without a jump.
  vpTrajectoryInput<1> moving = figureInput(1., 1., 1.);
  moving.goal.v[0] = 0.3;
  moving.goal.a[0] = 0.5;
  trajectory.reset();
  vpAxisState before{};
  double jump = 0.;
  for (int i = 0; i < 8000; ++i) {
    static_cast<void>(trajectory.step(moving, output, 1e-3));
    jump = i > 0 ? std::max(jump, std::abs(output.state.a[0] - before[2])) : 0.;
    before = {output.state.q[0], output.state.v[0], output.state.a[0], 0.};
  }
  CHECK(jump < 0.02);
  CHECK(output.state.a[0] == 0.);
  CHECK(output.state.v[0] > 0.3);
  CHECK(output.state.v[0] <= 1.);
}

TEST_CASE("run-time and compile-time numbers of axes give the same motion", "[cycle]")
{
  auto rng = vpTestSupport::generator(61);
  const auto fixed = randomInput<3>(rng, Class::AnyToAny, false);
  vpTrajectoryInput<Eigen::Dynamic> dynamic(3);
  dynamic.start.q = fixed.start.q;
  dynamic.start.v = fixed.start.v;
  dynamic.start.a = fixed.start.a;
  dynamic.goal.q = fixed.goal.q;
  dynamic.goal.v = fixed.goal.v;
  dynamic.goal.a = fixed.goal.a;
  dynamic.maxVelocity = fixed.maxVelocity;
  dynamic.maxAcceleration = fixed.maxAcceleration;
  vpDirectTrajectory<3> a;
  vpDirectTrajectory<Eigen::Dynamic> b(3);
  vpTrajectoryOutput<3> x;
  vpTrajectoryOutput<Eigen::Dynamic> y(3);
  for (int i = 0; i < 500; ++i) {
    static_cast<void>(a.step(fixed, x, 1e-2));
    static_cast<void>(b.step(dynamic, y, 1e-2));
    REQUIRE((x.state.q - y.state.q).norm() == 0.);
  }
  // A copy carries the whole state of the motion.
  vpDirectTrajectory<3> copy = a;
  vpTrajectoryOutput<3> z;
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(a.step(fixed, x, 1e-2));
    static_cast<void>(copy.step(fixed, z, 1e-2));
    REQUIRE((x.state.q - z.state.q).norm() == 0.);
  }
}
