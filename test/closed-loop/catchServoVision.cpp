/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Vision of the servo loop on rendered images: photograph, tag, a frozen camera, and two threads.
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpThetaUVector.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/servoing/vpVisualServo.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <string>
#include <thread>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const vpHomogeneousMatrix cdMo(0., 0., 0.35, 0., 0., 0.);
const vpCameraParameters camera(400., 400., 159.5, 119.5); // 320 x 240 px

vpImage<unsigned char> klimt()
{
  vpImage<unsigned char> photo;
  vpImageIo::read(photo, std::string(VISP_DIRECT_DATA_DIR) + "/target/klimt.jpg");
  return photo;
}

//! Tag 0 of the family 36h11 with its white border, 10 x 10 cells of 20 px; its 36 bits row by row.
vpImage<unsigned char> tag36h11()
{
  constexpr unsigned long code = 0xd5d628584UL;
  constexpr unsigned int cell = 20;
  vpImage<unsigned char> picture(10 * cell, 10 * cell, 255);
  for (unsigned int r = 0; r < 8; ++r) {
    for (unsigned int c = 0; c < 8; ++c) {
      const bool isInside = r > 0 && r < 7 && c > 0 && c < 7;
      const bool isWhite = isInside && ((code >> (35 - (6 * (r - 1) + c - 1))) & 1UL) == 1;
      for (unsigned int i = 0; !isWhite && i < cell * cell; ++i) {
        picture[cell * (r + 1) + i / cell][cell * (c + 1) + i % cell] = 0;
      }
    }
  }
  return picture;
}

vpHomogeneousMatrix randomPose(std::mt19937_64 &rng)
{
  const auto random = [&rng](double most) { return vpTestSupport::uniform(rng, -most, most); };
  const double Z = vpTestSupport::uniform(rng, 0.25, 0.5);
  return vpHomogeneousMatrix(0.15 * Z * random(1.), 0.1 * Z * random(1.), Z, random(0.5), random(0.5), random(1.5));
}
} // namespace

TEST_CASE("A tag is found at its pose, as uncertain as told, and no other number is", "[servoing]")
{
#ifndef VISP_HAVE_APRILTAG
  CHECK_THROWS_WITH(vpServoVision::tag("36h11", 0, 0.1, camera),
                    "tags need a ViSP with AprilTag, and this one was built without");
#else
  constexpr double size = 0.08; // m, of the black square: 8 of 10 cells
  vpPlaneRenderer view(tag36h11(), 1.25 * size, 1.25 * size, camera, 320, 240);
  const auto vision = vpServoVision::tag("36h11", 0, size, camera, 0.07); // px, from the errors of the pose here
  const auto other = vpServoVision::tag("36h11", 1, size, camera);
  vpCameraFaults faults;
  faults.noise = 2.;
  vpImage<unsigned char> image;
  vpServoSight sight;
  unsigned int found = 0, within = 0, axes = 0;
  double squares = 0.; // of errors over deviations
  const unsigned int count = static_cast<unsigned int>(vpTestSupport::longer(60));
  for (unsigned int i = 0; i < count; ++i) {
    std::mt19937_64 rng = vpTestSupport::generator(i);
    const vpHomogeneousMatrix cMo = randomPose(rng);
    view.render(cMo, faults, i, image);
    vision->see(image, i, nullptr, sight);
    found += sight.measurement.valid;
    if (sight.measurement.valid) {
      const vpHomogeneousMatrix off = cMo * sight.measurement.cMo.inverse();
      const vpThetaUVector turn(off.getRotationMatrix());
      const vpPoseCovariance &C = sight.measurement.covariance;
      REQUIRE(C.known);
      const bool isOther = turn.getTheta() > 0.3; // the second pose of the square, told by its speed
      CHECK((!isOther || sight.speedFactor < 1.));
      for (unsigned int k = 0; k < 3 && !isOther; ++k) {
        for (const double ratio :
             {(cMo[k][3] - sight.measurement.cMo[k][3]) / std::sqrt(C(k, k)), turn[k] / std::sqrt(C(k + 3, k + 3))}) {
          within += std::abs(ratio) <= 2.;
          squares += ratio * ratio;
          ++axes;
        }
      }
      CHECK(std::abs(cMo[2][3] - sight.measurement.cMo[2][3]) < 0.02 * cMo[2][3]);
    }
    other->see(image, i, nullptr, sight);
    CHECK(!sight.measurement.valid);
  }
  CHECK(other->message() == "Tag 1 was not found.");
  INFO(found << " of " << count << " found, " << within << " of " << axes
             << " numbers within two deviations, mean square of errors over deviations " << squares / axes);
  CHECK(found >= 0.95 * count);
  CHECK(within > 0.9 * axes);
  CHECK(squares > 0.25 * axes); // told as less than twice of what it is
  CHECK_THROWS_WITH(vpServoVision::tag("36h12", 0, size, camera),
                    "the family of tags \"36h12\" is unknown, known are: 16h5, 25h9, 36h11, Circle21h7, Standard41h12");
  CHECK_THROWS_WITH(vpServoVision::tag("36h11", -1, size, camera), "id of the tag is -1, must be >= 0");
  CHECK_THROWS_WITH(vpServoVision::tag("36h11", 0, 0., camera), "width of the servo target is 0 m, must be > 0");
  CHECK_THROWS_WITH(vpServoVision::tag("36h11", 0, size, camera, 0.), "cornerSigma of the tag is 0 px, must be > 0");
#endif
}

TEST_CASE("A camera that gives the same image again and again stops the robot, one that stands still does not",
          "[servoing]")
{
  vpPlaneRenderer view(klimt(), 0.12, 0.12, camera, 320, 240);
  vpVisualServoSpec spec;
  spec.period = 0.02;
  vpVisualServo servo(vpServoController::create("pbvs1"), spec);
  servo.setVision(vpServoVision::photograph(klimt(), 0.12, 0.12, camera));
  servo.setGoal(servo.vision().goal(vpHomogeneousMatrix(0., 0., 0.18, 0., 0., 0.)));
  const vpHomogeneousMatrix fMo(0.02, 0.01, 0.36, 0.1, -0.3, 0.);
  vpServoRobotState state;
  vpImage<unsigned char> image;
  servo.start();
  const auto run = [&](double from, double to, bool isFrozen) {
    for (double now = from; now < to; now += spec.period) {
      const vpTwist v = servo.step(state, now).twist.scaled(spec.period);
      if (!isFrozen) {
        view.render(state.pose.inverse().toHomogeneous() * fMo, {}, 1, image);
      }
      servo.see(image, now);
      state.pose = state.pose * vpRigidTransform::fromHomogeneous(vpExponentialMap::direct(v.toColVector()));
    }
  };
  run(0., 1.2, false);
  INFO(servo.output().message << " " << servo.vision().message());
  REQUIRE(servo.output().status == vpVisualServoStatus::Servoing);
  const double before = state.pose.p.norm();
  run(1.2, 3., true);
  CHECK(servo.output().status == vpVisualServoStatus::FrozenImages);
  CHECK(servo.output().twist.linearNorm() == 0.);
  CHECK(state.pose.p.norm() - before < 0.1);
  run(3., 14., false); // at the goal nothing moves and the noise-free images are equal
  CHECK(servo.isConverged());
  CHECK_THROWS_WITH(vpServoVision::poses({}, vpServoTarget::rectangle(1., 1.)),
                    "the source of poses is empty, must be a function");
}

TEST_CASE("Images of a photograph in one thread move a camera that only takes twists to the goal in another",
          "[servoing]")
{
  const vpImage<unsigned char> photo = klimt();
  vpPlaneRenderer view(photo, 0.12, 0.12, camera, 320, 240);
  vpServoControllerSpec law;
  law.gains.lambda = 2.;
  vpVisualServoSpec twists;
  twists.period = 0.01;
  twists.startTime = 0.2;
  vpVisualServo servo(vpServoController::create("ff-lookat", law), twists);
  servo.setVision(vpServoVision::photograph(photo, 0.12, 0.12, camera));
  servo.setGoal(servo.vision().goal(cdMo));
  const vpHomogeneousMatrix fMo(0.05, 0.03, 0.45, 0.1, -0.2, 0.3);
  vpServoRobotState state;
  std::mutex mutex; // of the simulated world alone
  double now = 0.;
  std::atomic<bool> isRunning{true};
  std::thread vision([&]() {
    vpImage<unsigned char> image;
    while (isRunning) {
      std::unique_lock<std::mutex> lock(mutex);
      const double time = now;
      const vpHomogeneousMatrix cMo = state.pose.inverse().toHomogeneous() * fMo;
      lock.unlock();
      view.render(cMo, {}, 1, image);
      servo.see(image, time);
    }
  });
  servo.start();
  for (int i = 0; i < 4000 && !servo.isConverged(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2)); // five times real time
    const std::lock_guard<std::mutex> lock(mutex);
    now += twists.period;
    const vpTwist v = servo.step(state, now).twist.scaled(twists.period);
    const vpHomogeneousMatrix moved = vpExponentialMap::direct(v.toColVector());
    state.pose = state.pose * vpRigidTransform::fromHomogeneous(moved);
  }
  isRunning = false;
  vision.join();
  INFO(servo.output().message << ", " << servo.output().positionError << " m");
  CHECK(servo.isConverged());
  const vpHomogeneousMatrix cdMc = cdMo * fMo.inverse() * state.pose.toHomogeneous();
  CHECK(cdMc.getTranslationVector().frobeniusNorm() < 0.002);
}
