/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Capsules whose axis points nearly along -z, where the rotation from z to the axis is hard to compute.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpFclChecker.h>

using namespace vpAvoidanceTestKit;

TEST_CASE("capsules along -z stand where they are, to the last digits", "[fcl]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 400; ++k) {
    const double tilt = k == 0 ? 0. : std::pow(10., uniform(rng, -9., -2.));
    const double azimuth = uniform(rng, -pi, pi);
    vpArmSpec spec;
    spec.name = "post";
    spec.joints.push_back(vpArmJointSpec::standardDH(0., 0., 0., 0.));
    spec.joints[0].name = "j";
    spec.joints[0].lower = -1.;
    spec.joints[0].upper = 1.;
    const Vector3d from(0., 0., 1.), to(tilt * std::cos(azimuth), tilt * std::sin(azimuth), 0.);
    spec.capsules = {{1, from, to, 0.05}};
    const vpArmModel arm(spec);

    vpCollisionObject ball;
    ball.name = "ball";
    ball.shape = vpCollisionShape::sphere(0.03);
    ball.pose.p = from + uniform(rng, 0., 1.) * (to - from) + Vector3d(0.2, uniform(rng, -0.1, 0.1), 0.);
    vpCollisionSceneSpec around;
    around.objects = {ball};
    const vpCollisionScene scene(arm, around);

    // Distance of a point from a segment.
    const Vector3d axis = to - from;
    const double share = std::clamp((ball.pose.p - from).dot(axis) / axis.squaredNorm(), 0., 1.);
    const double truth = (ball.pose.p - from - share * axis).norm() - 0.08;
    vpJointVector q(1);
    q(0) = 0.;
    CAPTURE(k, tilt, azimuth, truth);
    REQUIRE(std::abs(vpFclChecker(scene).clearance(q, 10.).distance - truth) < 1e-12);
  }
}
