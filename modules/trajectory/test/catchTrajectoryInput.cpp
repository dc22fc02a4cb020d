/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Invalid input is named, and never stops the motion.
#include "vpTrajectoryTestKit.h"

#include <visp3/core/vpException.h>

#include <functional>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

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
