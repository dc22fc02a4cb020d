/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpMethodsOfTests.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>

using namespace vpMethodsOfTests;

namespace
{
vpCollisionSceneSpec twoObjects()
{
  vpCollisionSceneSpec spec;
  spec.objects = {movingBall({0.5, 0.3, 0.4}, {0., 0., 0.}).object, movingBall({-0.4, 0.2, 0.3}, {0., 0., 0.}).object};
  spec.objects[1].name = "other";
  spec.objects[1].shape = vpCollisionShape::box({0.1, 0.2, 0.3});
  spec.objects[1].pose.R = vpSO3::exp({0.3, -0.8, 1.1});
  return spec;
}
} // namespace

TEST_CASE("The noise of a pose sensor is what it tells", "[pose-sensor]")
{
  CAPTURE(vpTestSupport::seed());
  const vpCollisionScene scene(amor(), twoObjects());
  vpPoseSensorSpec spec;
  spec.positionNoise = 0.003;
  spec.angleNoise = 0.02;
  vpPoseSensor sensor({"ball", "other"}, spec, vpTestSupport::seed());
  vpCollisionData data;
  scene.place(amor().home(), data);
  std::vector<vpObjectSighting> seen;
  Vector3d shift = Vector3d::Zero(), shiftSquares = shift, turnSquares = shift;
  constexpr int frames = 4000;
  for (int i = 0; i < frames; ++i) {
    sensor.look(scene, data, 0.1 * i, seen);
    REQUIRE(seen.size() == 2);
    CHECK(seen[1].name == "other");
    CHECK(seen[1].time == 0.1 * i);
    CHECK(seen[1].shape.type() == vpShapeType::Box);
    const Vector3d off = seen[1].pose.p - scene.object(1).pose.p;
    const Vector3d turn = vpSO3::log(scene.object(1).pose.R.transpose() * seen[1].pose.R);
    shift += off / frames;
    shiftSquares += off.cwiseAbs2() / frames;
    turnSquares += turn.cwiseAbs2() / frames;
  }
  for (int k = 0; k < 3; ++k) {
    CHECK(std::fabs(shift(k)) < 5. * 0.003 / std::sqrt(frames));
    CHECK(std::sqrt(shiftSquares(k)) == Approx(0.003).epsilon(0.06));
    CHECK(std::sqrt(turnSquares(k)) == Approx(0.02).epsilon(0.06));
  }
  CHECK(seen[1].positionSigma == 0.003);
  CHECK(seen[1].angleSigma == 0.02);
}

TEST_CASE("A pose sensor sees what is in range, and misses some of it", "[pose-sensor]")
{
  const vpCollisionScene scene(amor(), twoObjects());
  vpCollisionData data;
  scene.place(amor().home(), data);
  std::vector<vpObjectSighting> seen;
  vpPoseSensorSpec spec;
  spec.eye = Vector3d(0.5, 0.3, 0.9);
  spec.range = 0.6; // the other is 1.09 m away
  vpPoseSensor near({"ball", "other", "nothing"}, spec, 1);
  near.look(scene, data, 0., seen);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].name == "ball");
  const Vector3d first = seen[0].pose.p;

  spec.range = 2.;
  vpPoseSensor far({"ball", "other"}, spec, 1);
  far.look(scene, data, 0., seen);
  REQUIRE(seen.size() == 2);
  CHECK(seen[0].pose.p == first); // the noise of objects is independent

  // From the hand the distance is that of the camera.
  spec.eye.reset();
  const Vector3d camera = vpArmKinematics::camera(amor(), data.arm).p;
  for (const double more : {-1e-6, 1e-6}) {
    spec.range = (camera - scene.object(0).pose.p).norm() + more;
    vpPoseSensor inHand({"ball"}, spec, 1);
    inHand.look(scene, data, 0., seen);
    CHECK(seen.size() == (more > 0. ? 1U : 0U));
  }

  spec.range = 2.;
  spec.missed = 0.3;
  vpPoseSensor poor({"ball"}, spec, 5);
  int count = 0;
  for (int i = 0; i < 2000; ++i) {
    poor.look(scene, data, 0., seen);
    count += static_cast<int>(seen.size());
  }
  CHECK(count == Approx(1400).margin(5. * std::sqrt(2000 * 0.3 * 0.7)));
  spec.missed = 1.2;
  CHECK_THROWS_WITH(vpPoseSensor({"ball"}, spec, 1),
                    Catch::Contains("missed of the pose sensor is 1.2, must be 0 to 1 and finite"));
}
