/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// An ideal robot that a vpVisualServo moves, and a camera with rate, latency and jitter. One thread; simulated time.
#ifndef vpServoBench_h
#define vpServoBench_h

#include "vpCatch.h"

#include "../src/vpRigidMotion.h"

#include <visp3/servoing/vpVisualServo.h>

#include <cmath>
#include <deque>
#include <functional>
#include <string>

VISP_DIRECT_USING_NAMESPACE

struct vpServoBench {
  vpServoTarget plate = vpServoTarget::rectangle(0.16, 0.11);
  vpHomogeneousMatrix cdMo = vpHomogeneousMatrix(0., 0., 0.35, 0., 0., 0.);
  vpVisualServo servo;
  vpServoRobotState state;   // pose of the camera, or of the end effector before a fixed camera
  vpRigidTransform objectAt; // in the base, or in the end effector
  vpTwist objectVelocity;    // in the base
  std::mt19937_64 rng;
  double now = 0., rate = 10., latency = 0.1, jitter = 0.; // s; jitter: share of the camera's period
  double nextFrame = 0.;
  std::deque<vpServoSight> pending;
  std::function<void(vpServoSight &)> spoil; // changes a measurement before it is handed over

  vpServoBench(const std::string &law, const vpServoControllerSpec &controller, const vpVisualServoSpec &spec,
               unsigned int index = 0)
    : servo(vpServoController::create(law, controller), spec), rng(vpTestSupport::generator(index))
  {
    servo.setGoal(plate.goal(cdMo));
  }
  [[nodiscard]] double uniform(double low, double high) { return vpTestSupport::uniform(rng, low, high); }
  [[nodiscard]] Eigen::Vector3d vector(double most)
  {
    return {uniform(-most, most), uniform(-most, most), uniform(-most, most)};
  }
  [[nodiscard]] vpRigidTransform camera() const // in the frame in which the object is at rest
  {
    return servo.spec().place == vpServoCameraPlace::EyeInHand ? state.pose : state.pose.inverse() * servo.spec().fMc;
  }
  [[nodiscard]] vpRigidTransform cMo() const { return camera().inverse() * objectAt; }
  //! Puts the object where the camera sees it at \e cMo.
  void place(const vpRigidTransform &cMo) { objectAt = camera() * cMo; }
  //! Puts the object at a random place in view: up to \e angle off the goal's orientation.
  void placeAtRandom(double angle)
  {
    const double Z = uniform(0.3, 0.8);
    const Eigen::Vector3d u = vector(1.).normalized();
    place({vpSO3::exp(uniform(0., angle) * u), Eigen::Vector3d(uniform(-0.2, 0.2) * Z, uniform(-0.15, 0.15) * Z, Z)});
  }
  void look()
  {
    if (now + 1e-9 >= nextFrame) {
      pending.emplace_back();
      plate.measure(cMo().toHomogeneous(), now, pending.back().measurement);
      nextFrame = now + (1. + uniform(-jitter, jitter)) / rate;
    }
    while (!pending.empty() && pending.front().measurement.time + latency <= now + 1e-9) {
      if (spoil) {
        spoil(pending.front());
      }
      servo.see(pending.front());
      pending.pop_front();
    }
  }
  const vpVisualServoOutput &step()
  {
    look();
    const vpVisualServoOutput &out = servo.step(state, now);
    const double dt = servo.spec().period;
    state.pose = state.pose * vpRigidMotion::exp(out.twist.scaled(dt));
    objectAt.p += dt * vpRigidMotion::linear(objectVelocity);
    objectAt.R = vpSO3::exp(dt * vpRigidMotion::angular(objectVelocity)) * objectAt.R;
    now += dt;
    return out;
  }
  void run(double time)
  {
    for (const double end = now + time; now < end;) {
      step();
    }
  }
  [[nodiscard]] vpRigidTransform error() const { return vpRigidTransform::fromHomogeneous(cdMo) * cMo().inverse(); }
  [[nodiscard]] double positionError() const { return error().p.norm(); }
  [[nodiscard]] double rotationError() const { return vpSO3::log(error().R).norm(); }
};

#endif
