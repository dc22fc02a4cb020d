/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpMethodsOfTests.h"

#include <cmath>

using namespace vpMethodsOfTests;

TEST_CASE("The velocity of an obstacle is the derivative of its place, to and fro", "[moving-obstacle]")
{
  auto rng = vpTestSupport::generator(31);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 50; ++problem) {
    vpMovingObstacle o = movingBall({0.1, 0.2, 0.3}, Vector3d(uniform(rng, -1., 1.), uniform(rng, -1., 1.), 0.3));
    const Vector3d v(o.object.velocity[0], o.object.velocity[1], o.object.velocity[2]);
    o.turnTime = uniform(rng, 0.05, 0.3);
    o.turnAfter = problem % 5 == 0 ? 0. : o.turnTime + uniform(rng, 0.01, 1.);
    CAPTURE(problem, o.turnTime, o.turnAfter);
    vpRigidTransform pose, next;
    vpTwist velocity;
    double farthest = 0.;
    for (double t = 0.; t < 4.; t += 0.0137) {
      constexpr double h = 1e-6;
      o.stateAt(t + 0.5 * h, pose, velocity);
      const Vector3d told(velocity[0], velocity[1], velocity[2]);
      o.stateAt(t, pose, velocity);
      o.stateAt(t + h, next, velocity);
      REQUIRE(((next.p - pose.p) / h - told).norm() < 1e-4);
      REQUIRE(told.norm() <= v.norm() * (1. + 1e-12)); // what bounds on its motion rely on
      farthest = std::max(farthest, (pose.p - o.object.pose.p).norm());
    }
    o.stateAt(0., pose, velocity);
    CHECK((pose.p - o.object.pose.p).norm() < 1e-12);
    CHECK(velocity[0] == Approx(v.x()));
    if (o.turnAfter > 0.) {
      o.stateAt(2. * o.turnAfter, pose, velocity);
      CHECK((pose.p - o.object.pose.p).norm() < 1e-12);
      CHECK(farthest <= v.norm() * (o.turnAfter - 0.5 * o.turnTime) + 1e-12);
    }
    else {
      CHECK(farthest == Approx(v.norm() * 4.).epsilon(0.01));
    }
  }
}
