/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The step functions never allocate.
#include "vpTrajectoryTestKit.h"

#include <visp3/trajectory/vpPoseTrajectory.h>
#include <visp3/trajectory/vpTwistShaper.h>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

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
