/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// vpVisualServo on rendered images and in two threads.
#include "vpCatch.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include <visp3/servoing/vpVisualServo.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

VISP_DIRECT_USING_NAMESPACE

namespace
{
const vpHomogeneousMatrix cdMo(0., 0., 0.35, 0., 0., 0.);
}

TEST_CASE("Images of a photograph in one thread move a camera that only takes twists to the goal in another",
          "[servoing]")
{
  vpImage<unsigned char> photo;
  vpImageIo::read(photo, std::string(VISP_DIRECT_DATA_DIR) + "/target/klimt.jpg");
  const vpCameraParameters camera(400., 400., 159.5, 119.5);
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
