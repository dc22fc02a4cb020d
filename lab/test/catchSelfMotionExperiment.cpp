/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// S5: the self-motion follows the index without moving the tool.
#include "vpCatch.h"
#include "vpMethodsOfTests.h"

#include <visp3/core/vpException.h>
#include "lab/arm/vpSelfMotionExperiment.h"

using namespace vpMethodsOfTests;

namespace
{
vpSelfMotionRunSpec task()
{
  static const auto model = std::make_shared<const vpArmModel>(amor());
  vpSelfMotionRunSpec spec;
  spec.arm = model;
  spec.start = model->home();
  spec.places = {{0.1, 0.7, 0.35}, {0., 0.75, 0.35}, {0.05, 0.8, 0.35}};
  return spec;
}

vpSelfMotionRun run(const vpSelfMotionIndex &index, double share)
{
  vpSelfMotionRunSpec spec = task();
  spec.index = index;
  spec.share = share;
  return runSelfMotionExperiment(spec);
}
} // namespace

TEST_CASE("Joint 4 goes where the index wants it, the tool stays on its way", "[self-motion-experiment]")
{
  constexpr int q4 = 3;
  const Vector3d beside(0.45, 0.1, 0.4);
  const auto three = [&](vpIndexSense sense) {
    return std::vector<vpSelfMotionIndex>{vpSelfMotionIndex::pointDistance(q4, beside, sense),
                                          vpSelfMotionIndex::lineDistance(q4, sense),
                                          vpSelfMotionIndex::planeDistance(q4, Vector3d::Zero(), {1., -1., 0.}, sense)};
  };
  const std::vector<vpSelfMotionIndex> attract = three(vpIndexSense::Attract), repel = three(vpIndexSense::Repel);
  for (std::size_t i = 0; i < 3; ++i) {
    const vpSelfMotionRun none = run(repel[i], 0.), near = run(attract[i], 0.6), far = run(repel[i], 0.6);
    CAPTURE(i, none.mean_distance_m, near.mean_distance_m, far.mean_distance_m);
    CHECK(near.mean_distance_m < none.mean_distance_m - 0.001);
    CHECK(far.mean_distance_m > none.mean_distance_m + 0.001);
    for (const vpSelfMotionRun *r : {&none, &near, &far}) {
      CHECK(r->tcp_drift_m < 1e-4);
      CHECK(r->tcp_drift_rad < 1e-3);
      CHECK(r->samples.size() == 1401);
      CHECK(r->start_distance_m == r->samples.front().distance);
    }
    CHECK(far.joint_travel_rad > none.joint_travel_rad);
  }
  // The reported distance is that of joint 4's origin from the point.
  const vpSelfMotionRun r = run(repel[0], 0.6);
  vpArmData data;
  vpArmKinematics::forward(amor(), r.samples[700].q, data);
  CHECK(r.samples[700].distance == Approx((data.joint[3].p - beside).norm()).epsilon(1e-9));
  CHECK((data.tool.p - Vector3d(0.05, 0.7, 0.35)).norm() < 0.1);
}

TEST_CASE("Errors of the self-motion experiment name the field", "[self-motion-experiment]")
{
  vpSelfMotionRunSpec spec = task();
  spec.share = 1.5;
  CHECK_THROWS_WITH(runSelfMotionExperiment(spec),
                    Catch::Contains("share of the self-motion experiment is 1.5, must be 0..1"));
  spec = task();
  spec.start = at(1.);
  CHECK_THROWS_WITH(runSelfMotionExperiment(spec), Catch::Contains("has 1 numbers, must have 7 finite ones"));
  spec.arm = nullptr;
  CHECK_THROWS_WITH(runSelfMotionExperiment(spec), Catch::Contains("has no arm"));
}
