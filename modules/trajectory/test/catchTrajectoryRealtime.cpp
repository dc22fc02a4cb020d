/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTrajectoryTestKit.h"
#include "vpWildNumbers.h"

#include <visp3/trajectory/vpPoseTrajectory.h>
#include <visp3/trajectory/vpTwistShaper.h>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

// The step functions never allocate.

namespace
{
template <int N>
unsigned long allocationsOf(vpDirectTrajectory<N> &trajectory, std::vector<vpTrajectoryInput<N>> &inputs, int axes)
{
  vpTrajectoryOutput<N> output(axes);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int i = 0; i < 20000; ++i) {
    static_cast<void>(trajectory.step(inputs[static_cast<std::size_t>(i / 37) % inputs.size()], output, 1e-2));
  }
  return vpTestSupport::allocationCount() - before;
}
} // namespace

TEST_CASE("no step allocates", "[realtime]")
{
  if (!vpTestSupport::canCountAllocations()) {
    WARN("allocations cannot be counted in this build");
    return;
  }
  auto rng = vpTestSupport::generator(120);
  CAPTURE(vpTestSupport::seed());
  std::vector<vpTrajectoryInput<7>> inputs;
  std::vector<vpTrajectoryInput<Eigen::Dynamic>> dynamic;
  for (int k = 0; k < 40; ++k) {
    auto input = randomInput<7>(rng, Class::AnyToAny, k % 2 == 0);
    input.spec.cruise = k % 3 == 0;
    input.spec.policy = static_cast<vpReplanPolicy>(k % 3);
    input.spec.arrivalTime = 5.;
    input.spec.method = k % 11 == 0 ? vpDurationMethod::ThesisIteration : vpDurationMethod::Exact;
    input.spec.thesisStepsPerCycle = 20;
    input.spec.synchronisation = static_cast<vpSynchronisation>(k % 3);
    if (k % 4 == 0) {
      input.spec.groups[0] = vpAxisGroup({0, 1, 2}, 30.);
    }
    if (k % 5 == 0) {
      vpTrajectoryVia<7> via;
      input.vias.assign(3, via);
      for (int v = 0; v < 3; ++v) {
        input.vias[static_cast<std::size_t>(v)].tau = 0.25 * (v + 1);
      }
    }
    if (k % 7 == 0) {
      input.maxVelocity[3] = NAN; // invalid input
    }
    inputs.push_back(input);
  }
  vpDirectTrajectory<7> trajectory(7, 3);
  CHECK(allocationsOf(trajectory, inputs, 7) == 0);

  for (int k = 0; k < 10; ++k) {
    dynamic.push_back(randomInput<Eigen::Dynamic>(rng, Class::AnyToRest, false, 4));
  }
  vpDirectTrajectory<Eigen::Dynamic> runtime(4);
  CHECK(allocationsOf(runtime, dynamic, 4) == 0);

  vpPoseTrajectory poses;
  vpTwistShaper shaper;
  vpHomogeneousMatrix goals[2] = {vpHomogeneousMatrix(0.1, 0.2, 0.3, 0.4, 0.5, 0.6),
                                  vpHomogeneousMatrix(0., 0.1, 0.3, 2., 0., 1.)};
  double sink = 0.;
  const unsigned long before = vpTestSupport::allocationCount();
  for (int i = 0; i < 5000; ++i) {
    static_cast<void>(poses.setGoal(goals[i / 300 % 2]));
    static_cast<void>(poses.step(1e-3));
    sink += shaper.step(poses.state().v, 1e-3)[0];
  }
  CHECK(vpTestSupport::allocationCount() == before);
  CHECK(std::isfinite(sink));
}

// The loop of the documentation, while (vpIsWorking(update(...))), ends: at the goal, and at every error.

namespace
{
constexpr int most = 20000; // cycles of a millisecond

// Cycles until the loop ends; the invalid value is set before cycle number \e when.
template <class Bad> int cyclesOf(int when, vpTrajectoryOutput<2> &output, Bad bad)
{
  vpTrajectoryInput<2> input;
  input.goal.q << 0.5, -0.2;
  input.minPosition.setConstant(-1.);
  input.maxPosition.setConstant(1.);
  vpDirectTrajectory<2> trajectory;
  int cycles = 0;
  double dt = 1e-3;
  do {
    if (cycles == when) {
      bad(input, dt);
    }
    ++cycles;
  } while (cycles < most && vpIsWorking(trajectory.step(input, output, dt)));
  return cycles;
}
} // namespace

TEST_CASE("a loop ends at the goal and at every error, at its start and on the way", "[loop]")
{
  using Input = vpTrajectoryInput<2>;
  const struct {
    const char *name;
    void (*bad)(Input &, double &);
  } errors[] = {
      {"NaN goal", [](Input &input, double &) { input.goal.q[1] = NAN; }},
      {"infinite goal velocity", [](Input &input, double &) { input.goal.v[0] = none; }},
      {"zero limit", [](Input &input, double &) { input.maxVelocity[0] = 0.; }},
      {"NaN limit", [](Input &input, double &) { input.maxAcceleration[1] = NAN; }},
      {"goal outside its position limits", [](Input &input, double &) { input.goal.q[0] = 1.5; }},
      {"goal velocity above its limit", [](Input &input, double &) { input.goal.v[0] = 1.1; }},
      {"no arrival time", [](Input &input, double &) { input.spec.policy = vpReplanPolicy::FixedArrival; }},
      {"too many vias", [](Input &input, double &) { input.vias.resize(3); }},
      {"no time", [](Input &, double &dt) { dt = 0.; }},
      {"NaN time", [](Input &, double &dt) { dt = NAN; }},
  };
  for (const auto &error : errors) {
    for (const int when : {0, 300}) {
      CAPTURE(error.name, when);
      vpTrajectoryOutput<2> output;
      CHECK(cyclesOf(when, output, error.bad) == when + 1);
      CHECK(output.status.result == vpTrajectoryResult::InvalidInput);
      CHECK_FALSE(output.status.message().empty());
      CHECK(vpWildNumbers::allFinite(output.state.q));
    }
  }
  vpTrajectoryOutput<2> output;
  CHECK(cyclesOf(most, output, [](Input &, double &) {}) < 3000);
  CHECK(output.status.result == vpTrajectoryResult::Finished);
  CHECK(output.state.q[0] == 0.5);
}

TEST_CASE("the loop of a pose trajectory ends likewise", "[loop]")
{
  for (const bool isBad : {false, true}) {
    vpPoseTrajectory trajectory;
    static_cast<void>(trajectory.reset(vpHomogeneousMatrix()));
    static_cast<void>(trajectory.setGoal(vpHomogeneousMatrix(0.1, 0., 0.2, 0., 0.3, 0.)));
    int cycles = 1;
    vpTrajectoryStatus status = trajectory.step(1e-3);
    for (; cycles < most && vpIsWorking(status.result); ++cycles) {
      status = trajectory.step(isBad && cycles > 300 ? NAN : 1e-3);
    }
    CHECK(cycles < (isBad ? 310 : 5000));
    CHECK(status.result == (isBad ? vpTrajectoryResult::InvalidInput : vpTrajectoryResult::Finished));
  }
}
