/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What stops a vpVisualServo, what it says, and what lets it go on.
#include "vpServoBench.h"
#include "vpTestArms.h"

#include <visp3/core/vpException.h>

namespace
{
using Status = vpVisualServoStatus;

vpVisualServoSpec quick()
{
  vpVisualServoSpec spec;
  spec.period = 0.01;
  spec.startTime = 0.3;
  return spec;
}

//! A bench in the middle of its motion.
vpServoBench moving(unsigned int index = 0, const vpVisualServoSpec &spec = quick())
{
  vpServoBench bench("ff-lookat", {}, spec, index);
  bench.place({vpSO3::exp({0.1, -0.2, 0.3}), Eigen::Vector3d(0.15, 0.1, 0.9)});
  bench.servo.start();
  bench.run(1.2);
  REQUIRE(bench.servo.output().status == Status::Servoing);
  REQUIRE(bench.servo.output().twist.linearNorm() > 0.1);
  return bench;
}

//! The twist goes to zero within the bounds of acceleration and jerk.
template <class Step> void requireBraking(const vpVisualServo &servo, Step step)
{
  const vpServoMotionLimits limits;
  vpTwist before = servo.output().twist;
  for (int i = 0; i < 100; ++i) {
    step();
    const vpTwist twist = servo.output().twist;
    const vpTwist change = vpRigidMotion::sum(twist, before.scaled(-1.));
    REQUIRE(change.linearNorm() <= limits.linearAcceleration * servo.spec().period * (1. + 1e-6));
    before = twist;
  }
  REQUIRE(before.linearNorm() == 0.);
  REQUIRE(before.angularNorm() == 0.);
}

std::string messageOf(const vpServoBench &bench) { return bench.servo.output().message; }
} // namespace

TEST_CASE("Nothing moves before start(), speeds rise slowly after it, and stop() brakes within the limits",
          "[servoing]")
{
  vpVisualServoSpec slow = quick();
  slow.startTime = 1.; // slower than the limit of acceleration
  const std::string law = GENERATE("ff-lookat", "dtg", "ff-dtg");
  CAPTURE(law);
  vpServoBench bench(law, {}, slow);
  bench.place({Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.15, 0.1, 0.9)});
  for (int i = 0; i < 100; ++i) {
    REQUIRE(bench.step().twist.linearNorm() == 0.);
    REQUIRE(bench.servo.output().status == Status::Idle);
  }
  CHECK(bench.servo.output().positionError == Approx(bench.positionError())); // a dry run sees everything
  bench.servo.start();
  const double begin = bench.now;
  while (bench.now < begin + 2.) {
    const double share = std::min(1., (bench.now - begin + 0.01) / slow.startTime);
    REQUIRE(bench.step().twist.linearNorm() <= 0.25 * share + 1e-9);
  }
  CHECK(bench.servo.output().status == Status::Servoing);
  bench.servo.stop();
  requireBraking(bench.servo, [&bench]() { bench.step(); });
  CHECK(bench.servo.output().status == Status::Idle);
  bench.servo.start();
  bench.run(15.);
  CHECK(bench.servo.isConverged());
  CHECK(bench.positionError() < 1e-3);
}

TEST_CASE("A sight's factor on the limits of speed slows laws and plans, from the start and in mid-motion",
          "[servoing]")
{
  const std::string law = GENERATE("ff-lookat", "dtg", "ff-dtg");
  for (unsigned int i = 0; i < static_cast<unsigned int>(vpTestSupport::longer(3)); ++i) {
    vpServoBench bench(law, {}, quick(), i);
    double factor = bench.uniform(0.3, 0.6), fastest = 0.;
    bench.spoil = [&factor](vpServoSight &sight) { sight.speedFactor = factor; };
    CAPTURE(law, i, factor);
    bench.place({Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.15, 0.1, 1.5)});
    bench.servo.start();
    const auto runWith = [&](double time) {
      fastest = 0.;
      for (const double end = bench.now + time; bench.now < end;) {
        fastest = std::max(fastest, bench.step().twist.linearNorm());
      }
      return fastest;
    };
    const double slow = 0.25 * factor * (1. + 1e-9);
    CHECK(runWith(2.5) <= slow);
    CHECK(fastest > 0.8 * slow);
    factor = 1.;
    CHECK(runWith(2.) > 1.3 * slow);
    factor = 0.3;
    static_cast<void>(runWith(1.)); // brakes
    CHECK(runWith(1.5) <= 0.3 * 0.25 * (1. + 1e-9));
    CHECK(fastest > 0.01); // it accelerates by 0.0225 m/s^2 at most
    factor = 1.;
    bench.run(12.);
    CHECK(bench.servo.isConverged());
  }
}

TEST_CASE("A rotation begins as slowly", "[servoing]")
{
  vpVisualServoSpec slow = quick();
  slow.startTime = 2.;
  vpServoBench bench("pbvs1", {}, slow);
  bench.place({vpSO3::exp({0., 0., 2.5}), Eigen::Vector3d(0., 0., 0.35)}); // nothing but a rotation
  bench.servo.start();
  const double limit = vpServoMotionLimits().angularVelocity;
  double fastest = 0.;
  while (bench.now < 2.5) {
    const double share = std::min(1., (bench.now + 0.01) / slow.startTime), speed = bench.step().twist.angularNorm();
    REQUIRE(speed <= limit * share + 1e-9);
    fastest = std::max(fastest, speed);
  }
  CHECK(fastest > 0.5 * limit);
}

TEST_CASE("Without new images the robot stops and says so, and goes on with the next one", "[servoing]")
{
  vpServoBench bench = moving();
  const double lastSeen = bench.nextFrame - 1. / bench.rate;
  bench.nextFrame = 1e9; // the cable is pulled
  while (bench.servo.output().status == Status::Servoing) {
    bench.step();
  }
  CHECK(bench.now - lastSeen == Approx(bench.servo.spec().imageTimeout).margin(0.03));
  requireBraking(bench.servo, [&bench]() { bench.step(); });
  CHECK(bench.servo.output().status == Status::NoImages);
  CHECK(messageOf(bench) == "No new image within the timeout: the robot stops until one comes.");
  bench.nextFrame = bench.now;
  bench.run(20.);
  CHECK(bench.servo.isConverged());
}

TEST_CASE("Time stamps that do not increase, or are ahead of the clock, stop the robot with the reason", "[servoing]")
{
  vpServoBench bench = moving();
  const double frozen = bench.now - 0.05;
  bench.spoil = [frozen](vpServoSight &sight) { sight.measurement.time = frozen; };
  bench.run(2.);
  CHECK(bench.servo.output().status == Status::ImageClock);
  CHECK(messageOf(bench) == "Images have times of capture that do not increase: the robot stops until they do.");
  CHECK(bench.servo.output().twist.linearNorm() == 0.);
  bench.spoil = [&bench](vpServoSight &sight) { sight.measurement.time = bench.now + 0.2; };
  bench.run(2.);
  CHECK(bench.servo.output().status == Status::ImageClock);
  CHECK(messageOf(bench) == "Images have times of capture in the future: the clocks of camera and control differ.");
  CHECK(bench.servo.output().twist.linearNorm() == 0.);
  bench.spoil = [](vpServoSight &sight) { sight.measurement.time = NAN; };
  bench.run(1.);
  CHECK(bench.servo.output().status == Status::ImageClock);
  bench.spoil = nullptr;
  bench.run(20.);
  CHECK(bench.servo.isConverged());
}

TEST_CASE("A jump of the clock stops the robot: forward until a new image, backward until it is started again",
          "[servoing]")
{
  for (const double jump : {0.15, 1., 100.}) {
    vpServoBench bench = moving();
    bench.pending.clear();
    bench.now += jump;
    bench.nextFrame = bench.now + 0.3;
    bench.step();
    CAPTURE(jump);
    CHECK(bench.servo.output().status == Status::LateStep);
    bench.run(0.2);
    CHECK(bench.servo.output().status == Status::LateStep);
    bench.run(20.);
    CHECK(bench.servo.isConverged());
  }
  for (const double jump : {-100., -0.02, 0. - 0.01, double(NAN)}) {
    vpServoBench bench = moving();
    const double before = bench.now;
    bench.pending.clear();
    bench.now += jump;
    bench.step();
    CAPTURE(jump);
    CHECK(bench.servo.output().status == Status::ClockFault);
    bench.now = std::isfinite(bench.now) ? bench.now : before + 0.01;
    bench.nextFrame = bench.now;
    requireBraking(bench.servo, [&bench]() { bench.step(); });
    CHECK(bench.servo.output().status == Status::ClockFault);
    CHECK(messageOf(bench) == "The clock of the control thread stood, went back or is not finite: the robot stops "
                              "until it is started again.");
    bench.servo.start();
    bench.run(20.);
    INFO(messageOf(bench));
    CHECK(bench.servo.isConverged());
  }
}

TEST_CASE("A robot state that is missing, old or not finite for too long stops the robot until it is started again",
          "[servoing]")
{
  const std::vector<std::function<void(vpServoRobotState &, double)>> faults = {
      [](vpServoRobotState &state, double) { state.valid = false; },
      [](vpServoRobotState &state, double) { state.pose.p.y() = NAN; },
      [](vpServoRobotState &state, double) { state.pose.R *= 1.1; },
      [](vpServoRobotState &state, double now) { state.time = now - 0.2; },
  };
  for (const auto &fault : faults) {
    vpServoBench bench = moving();
    const vpServoRobotState good = bench.state;
    const auto blindStep = [&](double time) {
      for (const double end = bench.now + time; bench.now < end; bench.now += 0.01) {
        vpServoRobotState bad = bench.state;
        fault(bad, bench.now);
        const vpTwist twist = bench.servo.step(bad, bench.now).twist;
        bench.state.pose = bench.state.pose * vpRigidMotion::exp(twist.scaled(0.01));
      }
    };
    blindStep(0.05); // a short gap is bridged
    CHECK(bench.servo.output().status == Status::Servoing);
    bench.run(0.5);
    CHECK(bench.servo.output().status == Status::Servoing);
    blindStep(0.15);
    CHECK(bench.servo.output().status == Status::StateFault);
    requireBraking(bench.servo, [&blindStep]() { blindStep(0.005); });
    CHECK(messageOf(bench) ==
          "The robot's state is missing, too old or not finite: the robot stops until it is started again.");
    bench.run(1.);
    CHECK(bench.servo.output().status == Status::StateFault);
    bench.servo.start();
    bench.run(20.);
    CHECK(bench.servo.isConverged());
    static_cast<void>(good);
  }
}

TEST_CASE("After a gap in the robot's states the prediction has all of the motion in it", "[servoing]")
{
  vpServoBench bench = moving();
  bench.nextFrame = 1e9;
  bench.pending.clear();
  for (int i = 0; i < 5; ++i, bench.now += 0.01) {
    vpServoRobotState none;
    none.valid = false;
    const vpTwist twist = bench.servo.step(none, bench.now).twist;
    bench.state.pose = bench.state.pose * vpRigidMotion::exp(twist.scaled(0.01));
  }
  const vpRigidTransform truth = bench.cMo();
  bench.step();
  const vpHomogeneousMatrix &cMo = bench.servo.measurement().cMo;
  REQUIRE(bench.servo.measurement().valid);
  CHECK((vpRigidTransform::fromHomogeneous(cMo).p - truth.p).norm() < 1e-6);
  CHECK(vpSO3::log(vpRigidTransform::fromHomogeneous(cMo).R.transpose() * truth.R).norm() < 1e-6);
}

TEST_CASE("While the clock stands motion is not measured: nothing is predicted before the next image", "[servoing]")
{
  vpServoBench bench = moving();
  bench.nextFrame = 1e9;
  REQUIRE(bench.servo.measurement().valid);
  bench.now -= 0.01; // the time of the last step
  bench.step();
  REQUIRE(bench.servo.output().status == Status::ClockFault);
  bench.servo.start();
  bench.step();
  CHECK(!bench.servo.measurement().valid);
  CHECK(bench.servo.output().status == Status::NoImages);
  bench.pending.clear(); // from before the fault
  bench.nextFrame = bench.now;
  bench.run(20.);
  CHECK(bench.servo.isConverged());
}

TEST_CASE("The same image again while the camera moves stops the robot, while it stands it does not", "[servoing]")
{
  vpServoBench bench("pbvs1", {}, quick());
  bench.latency = 0.;
  bench.place({vpSO3::exp({0.1, -0.2, 0.3}), Eigen::Vector3d(0.15, 0.1, 0.9)});
  bench.servo.setVision(vpServoVision::poses(
      [&bench](const vpImage<unsigned char> &, vpHomogeneousMatrix &cMo, vpPoseCovariance &) {
        cMo = bench.cMo().toHomogeneous();
        return true;
      },
      bench.plate));
  unsigned char number = 0;
  bool isFrozen = false;
  const auto run = [&](double time) {
    for (const double end = bench.now + time; bench.now < end;) {
      if (bench.now + 1e-9 >= bench.nextFrame) {
        number = static_cast<unsigned char>(number + (isFrozen ? 0 : 1));
        bench.servo.see(vpImage<unsigned char>(48, 64, number), bench.now - 1e-6); // before the step of this time
        bench.nextFrame = bench.now + 0.1;
      }
      const double next = bench.nextFrame;
      bench.nextFrame = 1e9;
      bench.step();
      bench.nextFrame = next;
    }
  };
  isFrozen = true;
  run(1.); // before start() the camera stands
  CHECK(bench.servo.output().status == Status::Idle);
  isFrozen = false;
  bench.servo.start();
  run(1.2);
  REQUIRE(bench.servo.output().status == Status::Servoing);
  REQUIRE(bench.servo.output().twist.linearNorm() > 0.1);
  isFrozen = true;
  run(0.4); // shorter than the timeout
  CHECK(bench.servo.output().status == Status::FrozenImages);
  CHECK(messageOf(bench) == "The image does not change although the camera moves: the robot stops until it does.");
  run(1.);
  CHECK(bench.servo.output().twist.linearNorm() == 0.);
  isFrozen = false;
  run(20.);
  CHECK(bench.servo.isConverged());
  isFrozen = true;
  run(2.); // at rest the image may stay the same
  CHECK(bench.servo.isConverged());
}

TEST_CASE("A robot that does not move as commanded is stopped, one that lags is not", "[servoing]")
{
  const auto statusAfter = [](const std::function<vpTwist(const vpTwist &)> &robot, double time) {
    vpServoBench bench = moving();
    for (const double end = bench.now + time; bench.now < end; bench.now += 0.01) {
      bench.look();
      const vpTwist done = robot(bench.servo.step(bench.state, bench.now).twist);
      bench.state.pose = bench.state.pose * vpRigidMotion::exp(done.scaled(0.01));
    }
    return bench.servo.output().status;
  };
  CHECK(statusAfter([](const vpTwist &) { return vpTwist(); }, 1.) == Status::NotFollowing);
  CHECK(statusAfter([](const vpTwist &v) { return v.scaled(-1.); }, 1.) == Status::NotFollowing);
  CHECK(statusAfter([](const vpTwist &v) { return vpTwist(v[1], -v[0], v[2], v[3], v[4], v[5]); }, 1.) ==
        Status::NotFollowing);
  vpTwist lagging;
  const auto lag = [&lagging](const vpTwist &v) {
    lagging = vpRigidMotion::sum(lagging.scaled(0.9), v.scaled(0.1)); // 0.1 s
    return lagging;
  };
  CHECK(statusAfter(lag, 20.) == Status::Converged);
  std::deque<vpTwist> line(10); // a pure delay of 0.1 s
  const auto late = [&line](const vpTwist &v) {
    line.push_back(v);
    const vpTwist first = line.front();
    line.pop_front();
    return first;
  };
  CHECK(statusAfter(late, 20.) == Status::Converged);
  CHECK(statusAfter([](const vpTwist &v) { return v.scaled(0.8); }, 20.) == Status::Converged);
}

TEST_CASE("The goal is reached when the error was within both tolerances for the time of the spec", "[servoing]")
{
  for (const bool turns : {false, true}) { // within the tolerance of position first, or of rotation
    vpVisualServoSpec spec = quick();
    spec.positionTolerance = turns ? 1. : 0.002;
    spec.rotationTolerance = turns ? 0.004 : 4.;
    spec.convergedTime = 0.7;
    vpServoBench bench("pbvs1", {}, spec);
    bench.place({vpSO3::exp({0.1, -0.2, 0.3}), Eigen::Vector3d(0.1, 0.05, 0.5)});
    bench.servo.start();
    double since = NAN;
    while (!bench.servo.isConverged() && bench.now < 20.) {
      const vpVisualServoOutput &out = bench.step();
      const bool isWithin = out.positionError <= spec.positionTolerance && out.rotationError <= spec.rotationTolerance;
      since = !isWithin ? NAN : std::isnan(since) ? bench.now : since;
    }
    CHECK(bench.now - since == Approx(0.7).margin(0.021));
  }
}

TEST_CASE("What vision tells of its certainty slows the robot and is passed on", "[servoing]")
{
  vpServoBench bench("ff-lookat", {}, quick());
  bench.place({Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.15, 0.1, 0.9)});
  bench.spoil = [](vpServoSight &sight) {
    sight.speedFactor = 0.2;
    sight.distance = 0.4;
    sight.distanceSigma = 0.03;
  };
  bench.servo.start();
  double fastest = 0.;
  while (bench.now < 3.) {
    fastest = std::max(fastest, bench.step().twist.linearNorm());
  }
  CHECK(fastest == Approx(0.2 * 0.25).epsilon(1e-3));
  CHECK(bench.servo.output().speedFactor == 0.2);
  CHECK(bench.servo.output().distance == 0.4);
  CHECK(bench.servo.output().distanceSigma == 0.03);
}

TEST_CASE("Failing laws and a missing goal are reported", "[servoing]")
{
  vpServoBench bench("pbvs1", {}, quick());
  vpVisualServo empty(vpServoController::create("pbvs1"), quick());
  empty.start();
  vpServoSight sight;
  bench.plate.measure(bench.cdMo, 0.01, sight.measurement);
  for (int i = 1; i < 4; ++i) {
    empty.step(bench.state, 0.01 * i);
    empty.see(sight);
  }
  CHECK(empty.output().status == Status::LawStopped);
  CHECK(std::string(empty.output().message) == "No goal was set.");
}

TEST_CASE("What cannot be handed over is refused with a sentence", "[servoing]")
{
  vpVisualServoSpec spec = quick();
  spec.maxPoints = 3;
  vpVisualServo servo(vpServoController::create("pbvs1"), spec);
  const vpServoTarget plate = vpServoTarget::rectangle(0.1, 0.1);
  const vpHomogeneousMatrix cMo(0., 0., 0.5, 0., 0., 0.);
  CHECK_THROWS_WITH(servo.setGoal(plate.goal(cMo)), "the goal has 4 points, maxPoints of the visual servo is 3");
  CHECK_THROWS_WITH(servo.setGoal(vpServoGoal()), "the servo goal has 0 points, needs at least 1");
  vpServoSight sight;
  plate.measure(cMo, 1., sight.measurement);
  CHECK_THROWS_WITH(servo.see(sight), "the measurement has 4 points, maxPoints of the visual servo is 3");
  sight.measurement.points.clear();
  sight.measurement.outline.clear();
  sight.measurement.time = 2.;
  sight.speedFactor = 0.;
  CHECK_THROWS_WITH(servo.see(sight), "speedFactor of the sight is 0, must be > 0, <= 1");
  CHECK_THROWS_WITH(servo.vision(), "the visual servo has no vision, setVision() was not called");
  CHECK_THROWS_WITH(servo.setVision(nullptr), "the vision of the visual servo is null, must be an object");
  const vpCollisionScene scene(vpTestArms::amor(), {});
  CHECK_THROWS_WITH(servo.supervise(scene), "a supervisor needs an arm's model, and the visual servo has none");
  spec.place = vpServoCameraPlace::EyeToHand;
  spec.assumeExecuted = true;
  CHECK_THROWS_WITH(vpVisualServo(vpServoController::create("pbvs1"), spec),
                    "assumeExecuted of the visual servo is true, must be false for a fixed camera");
  spec.assumeExecuted = false;
  spec.fMc.R *= 2.;
  CHECK_THROWS_WITH(vpVisualServo(vpServoController::create("pbvs1"), spec),
                    "fMc of the visual servo is not a rotation and a finite translation");
}
