/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Everything except plain quintics: braking, position and norm limits, cruise, straight lines, C1 and C3,
// contradictions.
#include "vpTrajectoryTestKit.h"

#include <Eigen/Geometry>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

TEST_CASE("a start outside the limits comes back inside and says so", "[forms]")
{
  auto rng = vpTestSupport::generator(90);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < vpTestSupport::longer(3000); ++k) {
    auto input = randomInput<2>(rng, Class::AnyToRest, k % 2 == 0);
    const int i = k % 2;
    input.start.v[i] *= k % 3 != 0 ? 3. : 1.;
    input.start.a[i] *= k % 3 != 1 ? 3. : 1.;
    const bool outside =
        std::abs(input.start.v[i]) > input.maxVelocity[i] || std::abs(input.start.a[i]) > input.maxAcceleration[i];
    vpTrajectoryPlan plan(2);
    const vpTrajectoryStatus status = vpDirectTrajectory<2>::calculate(input, plan);
    CAPTURE(k, status.message(), plan.brakingEnd(), plan.duration());
    REQUIRE((status.result == vpTrajectoryResult::Braking) >= outside);
    REQUIRE(worstMismatch(input, plan) <= 1e-11);
    for (int s = 0; s <= 200;
         ++s) { // inside for good after braking, and never further out than at the start on the way
      const double t = plan.brakingEnd() + (plan.duration() - plan.brakingEnd()) * s / 200.;
      REQUIRE(std::abs(plan.at(i, t)[1]) <= input.maxVelocity[i] * (1. + 1e-9));
      REQUIRE(std::abs(plan.at(i, t)[2]) <= input.maxAcceleration[i] * (1. + 1e-9));
      const double early = plan.brakingEnd() * s / 200.;
      REQUIRE(std::abs(plan.at(i, early)[2]) <=
              std::max(input.maxAcceleration[i], std::abs(input.start.a[i])) * (1. + 1e-9));
    }
  }
  // Limits lowered on the fly.
  vpTrajectoryInput<1> input;
  input.goal.q[0] = 5.;
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryOutput<1> output;
  while (output.state.v[0] < 0.9) {
    static_cast<void>(trajectory.step(input, output, 1e-3));
  }
  input.maxVelocity[0] = 0.3;
  CHECK(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Braking);
  CHECK_THAT(output.status.message(),
             Catch::Contains("the start is outside the limits, coming back inside: the velocity"));
  double before = output.state.v[0];
  while (trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Braking) {
    REQUIRE(output.state.v[0] <= before + 2e-3);
    before = output.state.v[0];
  }
  CHECK(output.state.v[0] <= 0.3 + 1e-9);
  CHECK(output.status.result == vpTrajectoryResult::Working);
}

namespace
{
// Infimum of the braking distance from v > 0 when the jerk is free.
double stoppingDistance(double v, double maxAcceleration) { return v * v / (2. * maxAcceleration); }
} // namespace

TEST_CASE("position limits are kept, by stopping and going when nothing else does", "[forms]")
{
  auto rng = vpTestSupport::generator(91);
  CAPTURE(vpTestSupport::seed());
  int stops = 0, unreachable = 0;
  for (int k = 0; k < vpTestSupport::longer(4000); ++k) {
    auto input = randomInput<2>(rng, Class::AnyToRest, false);
    input.maxAcceleration *= 10.;
    for (int i = 0; i < 2; ++i) {
      // Enough distance to stop, sometimes barely.
      const double stop = std::pow(input.start.v[i], 2) / input.maxAcceleration[i];
      const double low = std::min(input.start.q[i], input.goal.q[i]),
                   high = std::max(input.start.q[i], input.goal.q[i]);
      input.minPosition[i] = low - uniform(rng, 0.3, 2.) * stop - 0.01;
      input.maxPosition[i] = high + uniform(rng, 0.3, 2.) * stop + 0.01;
    }
    vpTrajectoryPlan plan(2);
    const vpTrajectoryStatus status = vpDirectTrajectory<2>::calculate(input, plan);
    CAPTURE(k, status.message(), vpToString(plan.form()));
    REQUIRE(worstMismatch(input, plan) <= 1e-11);
    if (status.result == vpTrajectoryResult::NoFeasibleDuration) {
      ++unreachable;
      REQUIRE(status.fault == vpTrajectoryFault::LimitExceeded);
      // Correct: even the hardest stop leaves the limits (all but a hundredth of it).
      const int i = status.excess.index;
      const double v = input.start.v[i],
                   room = v > 0. ? input.maxPosition[i] - input.start.q[i] : input.start.q[i] - input.minPosition[i];
      REQUIRE(1.01 * stoppingDistance(std::abs(v), input.maxAcceleration[i]) > room);
      auto free = input; // the other limits are still kept
      free.minPosition.setConstant(-none);
      free.maxPosition.setConstant(none);
      REQUIRE(worstViolation(free, plan) <= 1e-12);
      continue;
    }
    REQUIRE(status.result == vpTrajectoryResult::Working);
    REQUIRE(worstViolation(input, plan) <= 1e-12);
    stops += plan.form() == vpTrajectoryForm::StopAndGo;
  }
  WARN("position limits: " << stops << " stop and go, " << unreachable << " too fast to stay inside");
  CHECK(stops > 20);

  vpTrajectoryInput<1> wall;
  wall.start.v[0] = 0.9;
  wall.maxPosition[0] = 0.1; // 0.4 are needed to stop
  vpTrajectoryPlan plan(1);
  const vpTrajectoryStatus status = vpDirectTrajectory<1>::calculate(wall, plan);
  CHECK(status.result == vpTrajectoryResult::NoFeasibleDuration);
  CHECK_THAT(status.message(),
             Catch::Contains("the highest position of axis 0 is 0.405") && Catch::Contains("its limit 0.1"));
}

TEST_CASE("the norm over a group of axes stays below its limits", "[forms]")
{
  auto rng = vpTestSupport::generator(92);
  CAPTURE(vpTestSupport::seed());
  int fallback = 0;
  for (int k = 0; k < vpTestSupport::longer(4000); ++k) {
    auto input = randomInput<5>(rng, static_cast<Class>(k % 4), false);
    vpAxisGroup group({0, 2, 3}, uniform(rng, 0.2, 2.));
    if (k % 3 == 0) {
      group.maxAcceleration = uniform(rng, 0.5, 4.);
    }
    double v = 0., a = 0., w = 0., b = 0.;
    for (int i : {0, 2, 3}) {
      v = std::hypot(v, input.start.v[i]);
      w = std::hypot(w, input.goal.v[i]);
      a = std::hypot(a, input.start.a[i]);
      b = std::hypot(b, input.goal.a[i]);
    }
    group.maxSpeed = std::max(group.maxSpeed, 1.001 * std::max(v, w));
    group.maxAcceleration = std::max(group.maxAcceleration, 1.001 * std::max(a, b));
    input.spec.groups[0] = group;
    vpTrajectoryPlan plan(5);
    const vpTrajectoryStatus status = vpDirectTrajectory<5>::calculate(input, plan);
    CAPTURE(k, status.message(), vpToString(plan.form(0)), group.maxSpeed);
    REQUIRE(status.result == vpTrajectoryResult::Working);
    REQUIRE(worstViolation(input, plan) <= 1e-12);
    REQUIRE(worstMismatch(input, plan) <= 1e-11);
    fallback += plan.form(0) != vpTrajectoryForm::Direct;
    if (plan.form() == vpTrajectoryForm::Direct && k % 4 == 0) {
      // For rest to rest it is the smallest: some limit is reached.
      REQUIRE(worstViolation(input, plan) >= -1e-9);
    }
  }
  CHECK(fallback > 100);
}

TEST_CASE("cruise brings long moves close to the trapezoid", "[forms]")
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = 10.;
  const double trapezoid = 10. + 1.; // h/v + v/a
  input.spec.cruise = false;
  vpTrajectoryPlan plan(1);
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  const double direct = plan.duration();
  input.spec.cruise = true;
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.form() == vpTrajectoryForm::Cruise);
  CHECK(plan.duration() == Approx(10. + 1.5));
  CHECK(direct / trapezoid > 1.7);
  CHECK(worstViolation(input, plan) <= 1e-12);
  input.goal.q[0] = 0.5; // too short to cruise: the single polynomial is faster
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.form() == vpTrajectoryForm::Direct);
}

TEST_CASE("the ramps of a cruise are the shortest that a search finds", "[forms]")
{
  auto rng = vpTestSupport::generator(98);
  CAPTURE(vpTestSupport::seed());
  int cruises = 0;
  const int count = vpTestSupport::longer(5000);
  for (int k = 0; k < count; ++k) {
    vpTrajectoryInput<1> input;
    const double v = uniform(rng, 0.1, 3.), a = uniform(rng, 0.1, 9.), unit = a * a / v;
    input.maxVelocity[0] = v;
    input.maxAcceleration[0] = a;
    input.maxJerk[0] = k % 2 == 0 ? std::numeric_limits<double>::infinity() : uniform(rng, 1., 20.) * unit;
    input.start.v[0] = v * uniform(rng, -0.95, 0.95);
    input.start.a[0] = k % 5 == 0 ? 0. : a * uniform(rng, -1., 1.);
    input.goal.q[0] = (k % 3 == 0 ? -60. : 60.) * v * v / a;
    input.goal.v[0] = k % 7 == 0 ? v * uniform(rng, -0.95, 0.95) : 0.;
    vpTrajectoryPlan plan(1);
    if (vpDirectTrajectory<1>::calculate(input, plan).result != vpTrajectoryResult::Working) {
      continue; // outside
    }
    vpAxisLimits limits;
    limits.velocity = v;
    limits.acceleration = a;
    limits.jerk = input.maxJerk[0];
    const double full = std::copysign(v, input.goal.q[0]);
    const auto search = [&](const vpAxisState &from, const vpAxisState &to) {
      return vpMinimumDuration::solve(
          vpMotionFamily::velocityStep(from, to, 2), limits,
          vpMinimumDuration::lowerBound({0., from[1], from[2], 0.}, {0., to[1], to[2], 0.}, limits));
    };
    const auto up = search({0., input.start.v[0], input.start.a[0], 0.}, {0., full, 0., 0.});
    const auto down = search({0., full, 0., 0.}, {0., input.goal.v[0], 0., 0.});
    CAPTURE(k, input.start.v[0] / v, input.start.a[0] / a, input.maxJerk[0] / unit, up.T, down.T);
    const bool exist = up.kind == vpDurationAnswer::Kind::Found && down.kind == vpDurationAnswer::Kind::Found;
    if (exist) { // taken where it saves a fifth
      const double rest = input.goal.q[0] - up.T * (input.start.v[0] / 2. + up.T * input.start.a[0] / 12.) -
                          down.T * input.goal.v[0] / 2.;
      REQUIRE(0.8 * plan.duration() <= (rest / full + 0.5 * (up.T + down.T)) * (1. + 1e-9));
    }
    if (plan.form() == vpTrajectoryForm::Cruise) {
      ++cruises;
      REQUIRE(exist);
      REQUIRE(plan.segment(0, 0).duration == Approx(up.T).epsilon(1e-9));
      REQUIRE(plan.segment(0, 2).duration == Approx(down.T).epsilon(1e-9));
    }
  }
  CHECK(cruises > count / 2);
}

TEST_CASE("a group at rest cruises along its line", "[forms]")
{
  const auto duration = [](bool group, bool cruise) {
    vpTrajectoryInput<3> input;
    const double way[] = {0.5, 0.3, 0.4};
    for (int i = 0; i < 3; ++i) {
      input.goal.q[i] = way[i];
      input.maxVelocity[i] = 0.25;
      input.maxAcceleration[i] = 0.5;
    }
    if (group) {
      input.spec.groups[0] = vpAxisGroup({0, 1, 2}, 0.25, 0.5);
    }
    input.spec.cruise = cruise;
    vpTrajectoryPlan plan(3);
    REQUIRE(vpDirectTrajectory<3>::calculate(input, plan).result == vpTrajectoryResult::Working);
    REQUIRE(plan.form(0) == (cruise ? vpTrajectoryForm::Cruise : vpTrajectoryForm::Direct));
    REQUIRE(worstViolation(input, plan) < 1e-9);
    return plan.duration();
  };
  // Ramps of 1.5 v/a each cover half of their time at full speed: h/v + 1.5 v/a, or 15/8 h/v; h: length of the line.
  const double h = std::sqrt(0.5);
  CHECK(duration(false, true) == Approx(0.5 / 0.25 + 0.75));
  CHECK(duration(true, true) == Approx(h / 0.25 + 0.75));
  CHECK(duration(true, false) == Approx(1.875 * h / 0.25));

  auto rng = vpTestSupport::generator(44);
  CAPTURE(vpTestSupport::seed());
  int cruises = 0;
  for (int k = 0; k < vpTestSupport::longer(10000);
       ++k) { // two groups and a separate axis; every third group moves at the start
    auto input = randomInput<6>(rng, Class::RestToRest, k % 2 == 1);
    const double length = logUniform(rng, 0.1, 100.);
    for (int i = 0; i < 6; ++i) {
      input.goal.q[i] = input.start.q[i] + length * uniform(rng, -1., 1.);
    }
    input.spec.groups[0] = vpAxisGroup({0, 2, 4}, logUniform(rng, 0.1, 10.), logUniform(rng, 0.1, 10.));
    input.spec.groups[1] = vpAxisGroup({1, 5}, logUniform(rng, 0.1, 10.), logUniform(rng, 0.1, 10.));
    if (k % 3 == 0) {
      input.start.v[5] = 0.5 * std::min(input.maxVelocity[5], input.spec.groups[1].maxSpeed);
    }
    vpTrajectoryPlan plan(6);
    const vpTrajectoryStatus status = vpDirectTrajectory<6>::calculate(input, plan);
    CAPTURE(k, status.message());
    REQUIRE(status.result == vpTrajectoryResult::Working);
    REQUIRE(worstViolation(input, plan) < 1e-9);
    REQUIRE(worstMismatch(input, plan) < 1e-12);
    cruises += plan.form(0) == vpTrajectoryForm::Cruise;
    const double t = uniform(rng, 0., plan.duration()), share = (plan.at(0, t)[0] - input.start.q[0]) / length;
    for (const int i : {2, 4}) { // on the line
      const double ratio = (input.goal.q[i] - input.start.q[i]) / (input.goal.q[0] - input.start.q[0]);
      REQUIRE(std::abs((plan.at(i, t)[0] - input.start.q[i]) / length - ratio * share) < 1e-9 * (1. + std::abs(ratio)));
    }
  }
  CHECK(cruises > vpTestSupport::longer(10000) / 10);
}

TEST_CASE("a group that moves at the start or the goal cruises too", "[forms]")
{
  vpTrajectoryInput<3> example;
  example.goal.q << 0.5, 0.3, 0.4;
  example.goal.q *= 10.;
  example.start.v << 0.1, -0.05, 0.;
  example.start.a << 0., 0.1, 0.;
  example.goal.v << 0., 0., 0.1;
  example.maxVelocity.setConstant(0.25);
  example.maxAcceleration.setConstant(0.5);
  example.spec.groups[0] = vpAxisGroup({0, 1, 2}, 0.25, 0.5);
  const double h = 10. * std::sqrt(0.5);
  vpTrajectoryPlan motion(3);
  REQUIRE(vpDirectTrajectory<3>::calculate(example, motion).result == vpTrajectoryResult::Working);
  CHECK(motion.form(0) == vpTrajectoryForm::Cruise);
  CHECK(worstViolation(example, motion) < 1e-9);
  CHECK(motion.duration() < h / 0.25 + 1.); // 28.3 s at full speed, and the ramps; 45 without a cruise
  example.spec.cruise = false;
  REQUIRE(vpDirectTrajectory<3>::calculate(example, motion).result == vpTrajectoryResult::Working);
  CHECK(motion.duration() > 1.5 * h / 0.25);

  auto rng = vpTestSupport::generator(45);
  CAPTURE(vpTestSupport::seed());
  int cruises = 0, longer = 0;
  for (int k = 0; k < vpTestSupport::longer(10000); ++k) {
    auto input = randomInput<5>(rng, static_cast<Class>(k % 4), k % 3 == 1);
    const double length = logUniform(rng, 0.1, 100.);
    double v[2][2] = {}, a[2][2] = {}; // norms at start and goal, of each group
    const vpAxisGroup members[] = {vpAxisGroup({0, 2, 4}, 1.), vpAxisGroup({1, 3}, 1.)};
    for (int i = 0; i < 5; ++i) {
      input.goal.q[i] = input.start.q[i] + length * uniform(rng, -1., 1.);
      const int g = members[0].contains(i) ? 0 : 1;
      v[g][0] = std::hypot(v[g][0], input.start.v[i]), v[g][1] = std::hypot(v[g][1], input.goal.v[i]);
      a[g][0] = std::hypot(a[g][0], input.start.a[i]), a[g][1] = std::hypot(a[g][1], input.goal.a[i]);
    }
    for (int g = 0; g < 2; ++g) { // well above: acceleration at the start may add to the velocity
      vpAxisGroup &group = input.spec.groups[static_cast<std::size_t>(g)];
      group = members[g];
      group.maxSpeed = 2. * std::max(v[g][0], v[g][1]) + logUniform(rng, 0.1, 1.);
      group.maxAcceleration = 1.1 * std::max(a[g][0], a[g][1]) + logUniform(rng, 0.1, 1.);
    }
    vpTrajectoryPlan plan(5), single(5);
    const vpTrajectoryStatus status = vpDirectTrajectory<5>::calculate(input, plan);
    CAPTURE(k, status.message(), vpToString(plan.form()));
    const bool cruise = plan.form(0) == vpTrajectoryForm::Cruise || plan.form(1) == vpTrajectoryForm::Cruise;
    if (cruise && status.result == vpTrajectoryResult::Working) {
      REQUIRE(worstViolation(input, plan) < 1e-9);
      REQUIRE(worstMismatch(input, plan) < 1e-12);
      input.spec.cruise = false;
      static_cast<void>(vpDirectTrajectory<5>::calculate(input, single));
      longer += plan.duration() > single.duration() * (1. + 1e-9);
    }
    cruises += cruise && status.isGood();
  }
  WARN(cruises << " cruises, " << longer << " of them longer than without");
  CHECK(cruises > vpTestSupport::longer(10000) / 5);
  CHECK(longer < cruises / 100 + 1); // units that wait for each other may change their forms
}

TEST_CASE("straight lines are straight, in every form", "[forms]")
{
  auto rng = vpTestSupport::generator(93);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 1000; ++k) {
    auto input = randomInput<3>(rng, Class::RestToRest, k % 2 == 0);
    input.spec.synchronisation = vpSynchronisation::Straight;
    input.spec.cruise = k % 4 < 2;
    input.spec.groups[0] = vpAxisGroup({0, 1, 2}, 1.);
    vpTrajectoryPlan plan(3);
    REQUIRE(vpDirectTrajectory<3>::calculate(input, plan).isGood());
    REQUIRE(worstViolation(input, plan) <= 1e-12);
    REQUIRE(worstMismatch(input, plan) <= 1e-12);
    // Continued from half way, along the same line.
    const double t = 0.4 * plan.duration();
    const Eigen::Vector3d line = input.goal.q - input.start.q;
    const Eigen::Vector3d origin = input.start.q;
    for (int i = 0; i < 3; ++i) {
      const vpAxisState x = plan.at(i, t);
      input.start.q[i] = x[0];
      input.start.v[i] = x[1];
      input.start.a[i] = x[2];
    }
    input.goal.q = origin + uniform(rng, 0.5, 2.) * line;
    REQUIRE(vpDirectTrajectory<3>::calculate(input, plan).isGood());
    REQUIRE(worstViolation(input, plan) <= 1e-12);
    for (int s = 0; s <= 50; ++s) {
      Eigen::Vector3d x;
      for (int i = 0; i < 3; ++i) {
        x[i] = plan.at(i, plan.duration() * s / 50.)[0];
      }
      REQUIRE((x - origin).cross(line).norm() < 1e-9 * line.squaredNorm() + 1e-11);
    }
  }
}

TEST_CASE("independent axes arrive as early as each can", "[forms]")
{
  vpTrajectoryInput<2> input;
  input.goal.q << 1., 0.1;
  input.spec.synchronisation = vpSynchronisation::None;
  vpTrajectoryPlan plan(2), alone(1);
  REQUIRE(vpDirectTrajectory<2>::calculate(input, plan).isGood());
  vpTrajectoryInput<1> single;
  single.goal.q[0] = 0.1;
  REQUIRE(vpDirectTrajectory<1>::calculate(single, alone).isGood());
  CHECK(plan.duration(1) == alone.duration());
  CHECK(plan.duration() == plan.duration(0));
  CHECK(plan.at(1, plan.duration(1) + 0.1)[0] == 0.1);
  CHECK(plan.pieces().size() == 2);
}

TEST_CASE("C1 and C3 motions from any state keep the limits", "[forms]")
{
  auto rng = vpTestSupport::generator(94);
  CAPTURE(vpTestSupport::seed());
  for (const auto continuity : {vpTrajectoryContinuity::C1, vpTrajectoryContinuity::C3}) {
    int forms[6] = {};
    for (int k = 0; k < vpTestSupport::longer(3000); ++k) {
      auto input = randomInput<3>(rng, k % 2 == 0 ? Class::AnyToAny : Class::RestToRest, false);
      input.spec.continuity = continuity;
      for (int i = 0; i < 3 && continuity == vpTrajectoryContinuity::C3; ++i) {
        const double j = std::pow(input.maxAcceleration[i], 2) / input.maxVelocity[i];
        input.start.j[i] = k % 2 == 0 ? uniform(rng, -j, j) : 0.;
        input.goal.j[i] = k % 2 == 0 ? uniform(rng, -j, j) : 0.;
      }
      vpTrajectoryPlan plan(3);
      const vpTrajectoryStatus status = vpDirectTrajectory<3>::calculate(input, plan);
      CAPTURE(k, static_cast<int>(continuity), status.message(), vpToString(plan.form()), worstViolation(input, plan));
      REQUIRE(status.result == vpTrajectoryResult::Working);
      REQUIRE(worstViolation(input, plan) <= 1e-12);
      REQUIRE(worstMismatch(input, plan) <= 1e-10);
      ++forms[static_cast<int>(plan.form())];
    }
    WARN("C" << 1 + static_cast<int>(continuity) << ": direct " << forms[1] << ", ramped " << forms[3]
             << ", stop and go " << forms[4]);
  }
}

TEST_CASE("a goal that contradicts the limits is named", "[forms]")
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = 1.;
  input.goal.v[0] = 1.;   // at the limit ...
  input.goal.a[0] = -0.5; // ... and slower later: so it was above before
  vpTrajectoryPlan plan(1);
  const vpTrajectoryStatus status = vpDirectTrajectory<1>::calculate(input, plan);
  CHECK(status.result == vpTrajectoryResult::NoFeasibleDuration);
  CHECK_THAT(status.message(), Catch::Contains("goal acceleration of axis 0 (-0.5) cannot be reached"));
  CHECK(plan.peaks(0).velocity <= 1. + 1e-12);
  CHECK(plan.at(0, plan.duration())[0] == 1.);
}
