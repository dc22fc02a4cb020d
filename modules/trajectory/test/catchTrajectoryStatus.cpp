/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTrajectoryTestKit.h"

#include <visp3/core/vpException.h>

#include <functional>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

// Problems that once had wrong results, and the status of exceeded limits.

namespace
{
vpTrajectoryInput<1> wall(double q0)
{
  vpTrajectoryInput<1> input;
  input.start.q[0] = q0;
  input.start.v[0] = 1.;
  input.goal.q[0] = 0.5;
  input.minPosition[0] = -1.;
  input.maxPosition[0] = 1.;
  return input;
}
} // namespace

TEST_CASE("a limit that cannot be kept is named with its excess", "[status]")
{
  vpTrajectoryInput<1> input;
  input.start.q[0] = 0.783;
  input.start.v[0] = 1.566;
  input.start.a[0] = -2.193;
  input.goal.q[0] = 0.4636;
  input.maxVelocity[0] = 1.83;
  input.maxAcceleration[0] = 2.975;
  input.maxJerk[0] = 1.325;
  input.minPosition[0] = 0.1417;
  input.maxPosition[0] = 0.8265;
  vpTrajectoryPlan plan(1);
  const vpTrajectoryStatus status = vpDirectTrajectory<1>::calculate(input, plan);
  CHECK(status.result == vpTrajectoryResult::NoFeasibleDuration);
  CHECK(status.fault == vpTrajectoryFault::LimitExceeded);
  CHECK(status.excess.index == 0);
  CHECK(status.excess.amount() > 0.);
  CHECK_THAT(status.message(), Catch::Contains("position of axis 0 is") && Catch::Contains("exceeded by"));
  const vpTrajectoryPeaks peaks = plan.peaks(0);
  CHECK(status.excess.value ==
        (status.excess.limit == vpTrajectoryLimit::MaxPosition ? peaks.maxPosition : peaks.minPosition));
}

TEST_CASE("a position limit is exceeded by no more than the hardest stop needs", "[status]")
{
  // From q0 with v = a = 1 the minimum is q0 + 1/2; with a jerk limit v a/(2 j) more.
  for (const double jerk : {none, 1000.}) {
    for (int k = 0; k <= 100; ++k) {
      vpTrajectoryInput<1> input = wall(0.4 + 0.005 * k);
      input.maxJerk[0] = jerk;
      vpTrajectoryPlan plan(1);
      const vpTrajectoryStatus status = vpDirectTrajectory<1>::calculate(input, plan);
      const double least = input.start.q[0] + 0.5 + 0.5 / jerk, highest = plan.peaks(0).maxPosition;
      CAPTURE(jerk, input.start.q[0], highest, status.message());
      CHECK(highest <= std::max(least, 1.) + 1e-4);
      CHECK((status.result == vpTrajectoryResult::NoFeasibleDuration) == (highest > 1. + 1e-9));
      if (!status.isGood()) {
        CHECK(status.excess.limit == vpTrajectoryLimit::MaxPosition);
        CHECK(status.excess.value == highest);
        CHECK(status.excess.bound == 1.);
      }
    }
  }
}

TEST_CASE("a start outside its position limits comes back, and says so", "[status]")
{
  vpTrajectoryInput<2> input;
  input.start.q << -147.964, 0.;
  input.goal.q << -147.7, 300.; // the second axis takes its time
  input.minPosition[0] = -147.823;
  input.spec.cruise = false;
  vpDirectTrajectory<2> trajectory;
  vpTrajectoryOutput<2> output;
  CHECK(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Braking);
  CHECK_THAT(output.status.message(),
             Catch::Contains("the start is outside the limits, coming back inside: the lowest position of axis 0"));
  const double end = trajectory.plan().brakingEnd();
  CHECK(trajectory.plan().at(0, end)[0] == Approx(-147.823).margin(1e-9));
  CHECK(end < 1.2); // 0.141 from rest to rest take 0.9 s
  int cycles = 1;
  while (trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Braking) {
    REQUIRE(output.state.q[0] < -147.823 + 1e-6);
    ++cycles;
  }
  CHECK(output.status.result == vpTrajectoryResult::Working);
  CHECK(cycles == Approx(end / 1e-3).margin(1.));
  CHECK(output.state.q[0] >= -147.823);
}

TEST_CASE("the last piece of a plan is no rounding error", "[status]")
{
  vpTrajectoryInput<3> input;
  input.start.q << -5.507461831940547, 0.090188069891913, 0.04617373710735508;
  input.start.v << -0.11716267431184355, 4.391641615583794, -0.4552961730027809;
  input.start.a << 0.39762488987877354, 2.2693835681552064, -1.9885187967354512;
  input.goal.q << -1.6252744946047553, 0.24631570216332152, 1.380833462741939;
  input.goal.v << -2.2108827611642003, -1.0081805395451326, -1.473084206897115;
  input.goal.a << -0.35303730473362666, 3.398336127920785, -0.6691570210756009;
  input.maxVelocity << 8.833994781931795, 5.861418263405559, 4.690316756528659;
  input.maxAcceleration << 0.42797309356708135, 8.242317315003744, 8.87720286867762;
  vpTrajectoryPlan plan(3);
  REQUIRE(vpDirectTrajectory<3>::calculate(input, plan).isGood());
  const auto pieces = plan.pieces();
  for (const vpTrajectoryPiece &piece : pieces) {
    CHECK(piece.end - piece.begin > 1e-9 * plan.duration());
  }
  const vpTrajectoryPiece &last = pieces.back();
  const double t = last.duration;
  CHECK(last.end == plan.duration());
  for (std::size_t i = 0; i < 3; ++i) {
    double a = 0., power = 1.;
    for (std::size_t k = 2; k < last.coefficients[i].size(); ++k, power *= t) {
      a += static_cast<double>(k * (k - 1)) * last.coefficients[i][k] * power;
    }
    const int axis = static_cast<int>(i);
    CHECK(std::abs(a - input.goal.a[axis]) < 1e-9);
    CHECK(plan.at(axis, plan.duration())[2] == input.goal.a[axis]);
  }
}

TEST_CASE("an axis that waits for another makes no detour", "[status]")
{
  for (const bool cruise : {false, true}) {
    vpTrajectoryInput<2> input;
    input.start.v << 0.5, 0.;
    input.goal.q << 0.1, 10.;
    input.spec.cruise = cruise;
    vpTrajectoryPlan plan(2);
    const vpTrajectoryStatus status = vpDirectTrajectory<2>::calculate(input, plan);
    CHECK(status.result == vpTrajectoryResult::Working);
    CHECK(plan.peaks(0).maxPosition <= 0.1 + 0.5 * 0.5 / 2. + 0.5 * 0.1 / 2. + 1e-9); // v^2/(2 a) + v a/(2 j)
    CHECK(plan.peaks(0).minPosition >= 0.);
  }
}

TEST_CASE("Straight that cannot be straight says so", "[status]")
{
  vpTrajectoryInput<2> input;
  input.goal.q << 1., 1.;
  input.spec.synchronisation = vpSynchronisation::Straight;
  vpTrajectoryPlan plan(2);
  CHECK(vpDirectTrajectory<2>::calculate(input, plan).fault == vpTrajectoryFault::None);
  input.start.v << 0.1, -0.1;
  const vpTrajectoryStatus status = vpDirectTrajectory<2>::calculate(input, plan);
  CHECK(status.result == vpTrajectoryResult::Working);
  CHECK(status.fault == vpTrajectoryFault::NotStraight);
  CHECK_THAT(status.message(), Catch::Contains("not on the straight line") && Catch::Contains("axis 0"));
}

TEST_CASE("a goal one step of a float beyond its limit is on it", "[status]")
{
  const double pi = 3.14159265358979312;
  for (const double goal : {std::nextafter(pi, 4.), static_cast<double>(std::nextafter(static_cast<float>(pi), 4.f))}) {
    vpTrajectoryInput<1> input;
    input.goal.q[0] = goal;
    input.maxPosition[0] = pi;
    vpTrajectoryPlan plan(1);
    CHECK(vpDirectTrajectory<1>::calculate(input, plan).result == vpTrajectoryResult::Working);
    CHECK(plan.at(0, plan.duration())[0] == goal);
  }
  vpTrajectoryInput<1> input;
  input.goal.q[0] = pi + 1e-5;
  input.maxPosition[0] = pi;
  vpTrajectoryPlan plan(1);
  CHECK(vpDirectTrajectory<1>::calculate(input, plan).message() ==
        "goal position of axis 0 is 3.141602653589793, outside its position limits: the highest position of axis 0 is "
        "3.141602653589793, its limit 3.141592653589793, exceeded by 1e-05");
}

TEST_CASE("a goal velocity does not lead out of the position limits after the arrival", "[status]")
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = 0.5;
  input.goal.v[0] = 0.5;
  input.maxPosition[0] = 1.;
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryOutput<1> output;
  double highest = 0.;
  for (int k = 0; k < 10000; ++k) {
    static_cast<void>(trajectory.step(input, output, 1e-3));
    highest = std::max(highest, output.state.q[0]);
  }
  CHECK(highest <= 1. + 1e-12);
  CHECK(highest > 1. - 1e-9);
  CHECK(output.state.v[0] == 0.);
  CHECK(output.status.result == vpTrajectoryResult::Holding);
  input.maxPosition[0] = 0.55; // not enough distance to stop: reported
  vpTrajectoryPlan plan(1);
  const vpTrajectoryStatus status = vpDirectTrajectory<1>::calculate(input, plan);
  CHECK(status.fault == vpTrajectoryFault::LimitExceeded);
  CHECK(status.excess.limit == vpTrajectoryLimit::MaxPosition);
}

TEST_CASE("limits that change within the freeze of a fixed arrival are not passed over in silence", "[status]")
{
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryInput<1> input;
  vpTrajectoryOutput<1> output;
  input.goal.q[0] = 1.;
  input.maxVelocity[0] = 5.;
  input.maxAcceleration[0] = 20.;
  input.spec.policy = vpReplanPolicy::FixedArrival;
  input.spec.arrivalTime = 2.;
  input.spec.freeze = 1.5;
  for (int k = 0; k < 100; ++k) {
    REQUIRE(trajectory.step(input, output, 0.01) == vpTrajectoryResult::Working);
  }
  REQUIRE(output.state.v[0] > 0.5);
  input.maxVelocity[0] = 0.1;
  CHECK(trajectory.step(input, output, 0.01) != vpTrajectoryResult::Working);
  CHECK(output.status.excess.limit == vpTrajectoryLimit::Velocity);
}

// Invalid input is named, and never stops the motion.

namespace
{
using Input = vpTrajectoryInput<Eigen::Dynamic>;

Input good()
{
  Input input(3);
  input.goal.q << 0.5, -0.2, 0.1;
  vpTrajectoryVia<Eigen::Dynamic> via(3);
  input.vias.assign(2, via);
  input.vias[0].tau = 0.3;
  input.vias[1].tau = 0.6;
  return input;
}

struct Case {
  std::function<void(Input &)> spoil;
  std::string sentence;
};

const std::vector<Case> cases = {
    {[](Input &i) { i.goal.q[1] = NAN; }, "goal state of axis 1 has the value nan"},
    {[](Input &i) { i.goal.v[2] = none; }, "goal state of axis 2 has the value inf"},
    {[](Input &i) { i.maxVelocity[2] = -1.; }, "velocity limit of axis 2 is -1, must be > 0"},
    {[](Input &i) { i.maxVelocity[0] = 0.; }, "velocity limit of axis 0 is 0, must be > 0"},
    {[](Input &i) { i.maxVelocity[0] = NAN; }, "velocity limit of axis 0 is nan, must be > 0"},
    {[](Input &i) { i.maxAcceleration[1] = -2.5; }, "acceleration limit of axis 1 is -2.5, must be > 0"},
    {[](Input &i) { i.maxJerk[1] = 0.; }, "jerk limit of axis 1 is 0, must be > 0"},
    {[](Input &i) { i.goal.q[2] = -2e12; }, "axis 2 has the value -2e+12, numbers must be at most 1e12"},
    {[](Input &i) { i.maxJerk[2] = 1e13; }, "axis 2 has the value 1e+13, numbers must be at most 1e12"},
    {[](Input &i) { i.maxVelocity[1] = 1e-13; },
     "axis 1 has the value 1e-13, numbers must be at most 1e12 and limits at"},
    {[](Input &i) { i.maxVelocity[1] = i.maxAcceleration[1] = none; },
     "axis 1 has neither a velocity nor an acceleration limit"},
    {[](Input &i) { i.minPosition[0] = 2., i.maxPosition[0] = 1.; },
     "position limits of axis 0 are in the wrong order"},
    {[](Input &i) { i.maxPosition[0] = 0.4; }, "goal position of axis 0 is 0.5, outside its position limits"},
    {[](Input &i) { i.goal.v[1] = 1.5; }, "goal velocity of axis 1 is 1.5, above its velocity limit"},
    {[](Input &i) { i.goal.a[1] = -1.5; }, "goal acceleration of axis 1 is -1.5, above its acceleration limit"},
    {[](Input &i) { i.vias[1].tau = 1.; }, "tau of via 1 is 1, must be in (0, 1)"},
    {[](Input &i) { i.vias[0].tau = vpAutomaticTau; }, "tau of via 1 is 0.6, must be in (0, 1), or automatic in all"},
    {[](Input &i) { i.vias[1].tau = vpAutomaticTau; }, "tau of via 1 is -1, must be in (0, 1), or automatic in all"},
    {[](Input &i) { i.vias[0].tau = NAN; }, "tau of via 0 is nan, must be in (0, 1)"},
    {[](Input &i) { i.vias[1].tau = 0.3; }, "tau of via 1 is 0.3, must be above that of the via before"},
    {[](Input &i) { i.vias[0].q[1] = NAN; }, "via 0 has the value nan, must be finite"},
    {[](Input &i) { i.vias[0].v[1] = 9., i.vias[0].hasVelocity = true; }, "via 0 has the value 9, outside the limits"},
    {[](Input &i) { i.vias.push_back(i.vias[0]); }, "room was made for 2 vias, got 3"},
    {[](Input &i) { i.spec.continuity = vpTrajectoryContinuity::C3; }, "vias need continuity C2"},
    {[](Input &i) { i.goal.q.resize(4); }, "a vector must have 3 numbers, one per axis, got 4"},
    {[](Input &i) { i.vias[0].q.resize(1); }, "a vector must have 3 numbers, one per axis, got 1"},
    {[](Input &i) {
       i.spec.groups[1] = vpAxisGroup({0, 1}, -1.);
     },
     "limit of axis group 1 is -1, must be > 0"},
    {[](Input &i) {
       i.spec.groups[0] = vpAxisGroup({0, 5}, 1.);
     },
     "axis group 0 names axis 5"},
    {[](Input &i) { i.spec.groups[0] = i.spec.groups[1] = vpAxisGroup({0}, 1.); }, "axis group 1 names axis 0"},
    {[](Input &i) {
       i.goal.v.setConstant(0.9);
       i.spec.groups[0] = vpAxisGroup({0, 1, 2}, 1.);
     },
     "axis group 0 has the norm 1.5588457268119895, above the limit"},
    {[](Input &i) { i.spec.policy = vpReplanPolicy::FixedArrival; }, "arrival time is 0 s, must be > 0"},
    {[](Input &i) { i.spec.freeze = -1.; }, "is -1 s, must be >= 0"},
    {[](Input &i) { i.spec.minimumDuration = NAN; }, "is nan s, must be >= 0"},
    {[](Input &i) { i.spec.thesisVelocityGain = 0.; }, "gain of the thesis's iteration is 0"},
    {[](Input &i) { i.spec.thesisStepsPerCycle = 0; }, "steps per cycle of the thesis's iteration are 0"},
};
} // namespace

TEST_CASE("every bad number is named with its axis and value", "[input]")
{
  for (const Case &c : cases) {
    Input input = good();
    c.spoil(input);
    CAPTURE(c.sentence);
    vpDirectTrajectory<Eigen::Dynamic> trajectory(3, 2);
    vpTrajectoryOutput<Eigen::Dynamic> output(3);
    CHECK(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::InvalidInput);
    CHECK_THAT(output.status.message(), Catch::Contains(c.sentence));
    CHECK(output.state.q.allFinite());
  }
  // The start state is read only once.
  Input input = good();
  input.start.a[2] = NAN;
  vpTrajectoryPlan plan(3, 2);
  CHECK_THAT(vpDirectTrajectory<Eigen::Dynamic>::calculate(input, plan).message(),
             Catch::Contains("start state of axis 2 has the value nan"));
}

TEST_CASE("bad input in mid-motion: the motion goes on as planned", "[input]")
{
  for (const Case &c : cases) {
    Input input = good(), bad = good();
    c.spoil(bad);
    CAPTURE(c.sentence);
    vpDirectTrajectory<Eigen::Dynamic> trajectory(3, 2), reference(3, 2);
    vpTrajectoryOutput<Eigen::Dynamic> output(3), expected(3);
    for (int i = 0; i < 600; ++i) {
      const bool spoiled = i >= 200 && i < 300;
      const vpTrajectoryResult result = trajectory.step(spoiled ? bad : input, output, 1e-2);
      static_cast<void>(reference.step(input, expected, 1e-2));
      REQUIRE((result == vpTrajectoryResult::InvalidInput) == spoiled);
      REQUIRE((output.state.q - expected.state.q).norm() == 0.);
    }
  }
}

TEST_CASE("dt and sizes are checked", "[input]")
{
  vpDirectTrajectory<2> trajectory;
  vpTrajectoryInput<2> input;
  vpTrajectoryOutput<2> output;
  input.goal.q.setOnes();
  for (const double dt : {0., -1e-3, std::nan(""), none}) {
    CHECK(trajectory.step(input, output, dt) == vpTrajectoryResult::InvalidInput);
    CHECK_THAT(output.status.message(), Catch::Contains("must be > 0 and finite"));
  }
  CHECK(trajectory.step(input, output, 1e-3) == vpTrajectoryResult::Working);
  CHECK_THROWS_WITH(vpDirectTrajectory<Eigen::Dynamic>(0),
                    Catch::Contains("a trajectory has 0 axes") || Catch::Contains("axes, must be >= 1"));
  CHECK_THROWS_WITH(vpDirectTrajectory<2>(2, -1), Catch::Contains("room for -1 vias"));
  CHECK_THROWS_AS(vpDirectTrajectory<2>(3), vpException);
  CHECK(std::string(vpToString(vpTrajectoryResult::ArrivalInfeasible)) == "ArrivalInfeasible");
  CHECK(std::string(vpToString(vpTrajectoryForm::StopAndGo)) == "StopAndGo");
}
