/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Every law behind bridge and bounds: latency and slow, jittering cameras make nothing swing.
#include "vpServoBench.h"

namespace
{
vpServoBench randomBench(const std::string &law, unsigned int index)
{
  std::mt19937_64 rng = vpTestSupport::generator(index);
  vpServoControllerSpec controller;
  controller.gains.lambda = vpTestSupport::uniform(rng, 0.5, 4.);
  vpVisualServoSpec spec;
  spec.period = vpTestSupport::uniform(rng, 0.001, 0.01);
  spec.imageTimeout = 1.;
  vpServoBench bench(law, controller, spec, index + 1000);
  bench.rate = std::exp(bench.uniform(std::log(5.), std::log(200.)));
  bench.latency = bench.uniform(0., 0.2);
  bench.jitter = 0.3;
  bench.placeAtRandom(0.6);
  bench.servo.start();
  return bench;
}

//! The largest error, as a share of the first one, after it has been below half a percent for the first time.
struct Overshoot {
  double first, after = 0.;
  bool isReached = false;

  explicit Overshoot(double error) : first(error) {}
  void add(double error)
  {
    isReached = isReached || error < 0.005 * first;
    after = isReached ? std::max(after, error / first) : 0.;
  }
};
} // namespace

TEST_CASE("No law overshoots by 2 %, with latencies to 200 ms, cameras from 5 to 200 Hz with jitter, and gains to 4/s",
          "[servoing]")
{
  for (const std::string &law : vpServoLaw::ids()) {
    for (unsigned int i = 0; i < static_cast<unsigned int>(vpTestSupport::longer(4)); ++i) {
      vpServoBench bench = randomBench(law, i);
      CAPTURE(law, i, bench.servo.spec().period, bench.rate, bench.latency, bench.servo.controller().gains().lambda);
      Overshoot position(bench.positionError()), rotation(bench.rotationError());
      while (bench.now < 25.) {
        bench.step();
        position.add(bench.positionError());
        rotation.add(bench.rotationError());
      }
      CAPTURE(bench.positionError(), bench.rotationError(), bench.servo.output().message);
      CHECK(position.isReached);
      CHECK(rotation.isReached);
      CHECK(position.after < 0.02);
      CHECK(rotation.after < 0.02);
      CHECK(bench.servo.isConverged());
    }
  }
}

TEST_CASE("A rotation that the bounds make slow winds up no integral", "[servoing]")
{
  vpServoControllerSpec controller;
  controller.motion.angularVelocity = 0.1;
  controller.gains.integral = 4.;
  vpVisualServoSpec spec;
  spec.period = 0.01;
  vpServoBench bench("ff-lookat-pi", controller, spec);
  bench.place({vpSO3::exp({0., 0., 0.8}), Eigen::Vector3d(0., 0., 0.35)});
  bench.servo.start();
  const Eigen::Vector3d first = vpSO3::log(bench.error().R).normalized();
  double past = 0.; // rad beyond the goal
  while (bench.now < 20.) {
    bench.step();
    past = std::max(past, -first.dot(vpSO3::log(bench.error().R)));
  }
  CHECK(past < 0.005);
  CHECK(bench.servo.isConverged());
}

TEST_CASE("A rotation about a far object before a fixed camera brings the end effector to its goal without overshoot",
          "[servoing]")
{
  for (unsigned int i = 0; i < static_cast<unsigned int>(vpTestSupport::longer(200)); ++i) {
    vpServoControllerSpec controller;
    controller.gains.lambda = 3.;
    vpVisualServoSpec spec;
    spec.period = 0.005;
    spec.place = vpServoCameraPlace::EyeToHand;
    vpServoBench bench("ff-lookat", controller, spec, i);
    const vpRigidTransform eMo{Eigen::Matrix3d::Identity(), 0.6 * bench.vector(1.).normalized()};
    bench.objectAt = eMo;
    bench.state.pose = vpRigidTransform::fromHomogeneous(bench.cdMo) *
                       vpRigidTransform{vpSO3::exp(0.7 * bench.vector(1.).normalized()), Eigen::Vector3d::Zero()} *
                       eMo.inverse();
    bench.servo.start();
    Overshoot position(bench.positionError()), rotation(bench.rotationError());
    while (bench.now < 15.) {
      bench.step();
      position.add(bench.positionError());
      rotation.add(bench.rotationError());
    }
    CAPTURE(i, bench.servo.output().message);
    CHECK(rotation.isReached);
    CHECK(rotation.after < 0.02);
    CHECK(bench.servo.isConverged());
  }
}

TEST_CASE("The commanded twist keeps its bounds of velocity, acceleration and jerk, and reaches them", "[servoing]")
{
  double most[3] = {0., 0., 0.};
  for (unsigned int i = 0; i < static_cast<unsigned int>(vpTestSupport::longer(10)); ++i) {
    vpServoBench bench = randomBench(i % 2 == 0 ? "ff-lookat-pi" : "pbvs1", i);
    const vpServoMotionLimits limits;
    const double dt = bench.servo.spec().period;
    vpTwist before, change;
    while (bench.now < 6.) {
      if (bench.uniform(0., 1.) < dt) { // a goal or an object moves about once a second
        bench.placeAtRandom(0.6);
      }
      const vpTwist twist = bench.step().twist;
      vpTwist next, jerk;
      for (std::size_t k = 0; k < 6; ++k) {
        next[k] = (twist[k] - before[k]) / dt;
        jerk[k] = (next[k] - change[k]) / dt;
      }
      REQUIRE(twist.linearNorm() <= limits.linearVelocity * (1. + 1e-9));
      REQUIRE(twist.angularNorm() <= limits.angularVelocity * (1. + 1e-9));
      REQUIRE(next.linearNorm() <= limits.linearAcceleration * (1. + 1e-6));
      REQUIRE(next.angularNorm() <= limits.angularAcceleration * (1. + 1e-6));
      REQUIRE(jerk.linearNorm() <= limits.linearJerk * (1. + 1e-6));
      REQUIRE(jerk.angularNorm() <= limits.angularJerk * (1. + 1e-6));
      most[0] = std::max(most[0], twist.linearNorm() / limits.linearVelocity);
      most[1] = std::max(most[1], next.linearNorm() / limits.linearAcceleration);
      most[2] = std::max(most[2], jerk.linearNorm() / limits.linearJerk);
      before = twist;
      change = next;
    }
  }
  CHECK(most[0] > 0.99);
  CHECK(most[1] > 0.99);
  CHECK(most[2] > 0.99);
}
