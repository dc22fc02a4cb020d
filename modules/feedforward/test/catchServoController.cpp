/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpServoController.h>

#include <set>
#include <string>

namespace
{
using namespace vpServoScene;
using namespace vpServoPlantOfTests;

struct Segment {
  double endDegrees, pastDegrees, imageError; // deg, deg, normalised
};

// One segment of 8 s. past: overshoot of the rotation beyond the goal, along its first error.
Segment runSegment(vpServoController &servo, Plant &plant, const vpHomogeneousMatrix &cdMo,
                   const std::vector<Eigen::Vector3d> &points, bool streamed)
{
  const auto error = [&]() {
    const Eigen::AngleAxisd a(rotation(cdMo) * rotation(plant.cMo()).transpose());
    return Eigen::Vector3d(a.angle() * a.axis() / degree);
  };
  servo.setGoal(goal(cdMo, points));
  vpServoMeasurement measurement;
  const Eigen::Vector3d first = error().normalized();
  Segment result{0., 0., 0.};
  for (int i = 0; i < 800; ++i) {
    if (streamed) {
      servo.setGoal(goal(cdMo, points));
    }
    plant.measure(points, measurement);
    plant.run(servo.step(measurement, 0.01).v);
    result.pastDegrees = std::max(result.pastDegrees, -error().dot(first));
    const Eigen::Vector3d o = translation(plant.cMo()), wanted = translation(cdMo);
    result.imageError = std::max(result.imageError, (o.head<2>() / o.z() - wanted.head<2>() / wanted.z()).norm());
  }
  result.endDegrees = error().norm();
  return result;
}
} // namespace

TEST_CASE("the integral of ff-lookat-pi removes friction without overshoot", "[controller][integral]")
{
  auto rng = vpTestSupport::generator(51);
  const auto points = object(rng, 0.16, 10);
  for (double deadband : {0., 0.1, 0.2}) {
    for (bool streamed : {false, true}) {
      CAPTURE(vpTestSupport::seed(), deadband, streamed);
      auto servo = vpServoController::create("ff-lookat-pi");
      Plant plant(facing(0., 0.), deadband, vpTestSupport::seed());
      // Pose 1 -> 2 -> 1 -> 3: 28.4 deg each; friction reverses in the second and continues in the third.
      for (const vpHomogeneousMatrix &cdMo : {facing(0.2, 0.1), facing(0., 0.), facing(-0.2, 0.1)}) {
        const Segment segment = runSegment(servo, plant, cdMo, points, streamed);
        CHECK(segment.endDegrees < 0.2);
        CHECK(segment.pastDegrees < 0.3);
        CHECK(segment.imageError < 0.01 + 0.38 * deadband);
      }
    }
  }
}

TEST_CASE("a turn on the spot with friction ends at the goal, without the integral winding up",
          "[controller][integral]")
{
  auto rng = vpTestSupport::generator(52);
  const auto points = object(rng, 0.16, 10);
  const vpHomogeneousMatrix start = facing(0., 0.);
  const vpHomogeneousMatrix cdMo =
      pose(turn(28. * degree, Eigen::Vector3d(1., 2., 2.).normalized()), Eigen::Vector3d::Zero()) * start;
  for (double deadband : {0., 0.1, 0.2}) {
    CAPTURE(vpTestSupport::seed(), deadband);
    auto servo = vpServoController::create("ff-lookat-pi");
    Plant plant(start, deadband, vpTestSupport::seed());
    for (const vpHomogeneousMatrix &next : {cdMo, start}) { // there and back: the goal jumps by 28 deg
      const Segment segment = runSegment(servo, plant, next, points, false);
      CHECK(segment.endDegrees < 0.2);
      CHECK(segment.pastDegrees < 0.4);
    }
  }
}

TEST_CASE("without the integral the same friction leaves degrees", "[controller][integral]")
{
  auto rng = vpTestSupport::generator(53);
  const auto points = object(rng, 0.16, 10);
  auto servo = vpServoController::create("ff-lookat");
  Plant plant(facing(0., 0.), 0.2, vpTestSupport::seed());
  const Segment segment = runSegment(servo, plant, facing(0.2, 0.1), points, false);
  CHECK(segment.endDegrees == Approx(0.2 / 2. / degree).epsilon(0.05)); // deadband / rotation gain
}

TEST_CASE("the integral is bounded and does not grow while its output is not executed", "[controller][integral]")
{
  vpServoGains gains;
  gains.integralLimit = 0.1;
  gains.integral = 2.;
  auto rng = vpTestSupport::generator(54);
  const auto points = object(rng, 0.16, 4);
  auto law = vpServoLaw::create("ff-lookat-pi", gains), plain = vpServoLaw::create("ff-lookat", gains);
  vpServoMeasurement measurement;
  const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 0.5});
  measure(pose(turn(0.3, Eigen::Vector3d::UnitX()), Eigen::Vector3d::Zero()) * cdMo, points, measurement);
  for (auto *l : {law.get(), plain.get()}) {
    l->setGoal(goal(cdMo, points));
  }
  const auto added = [&]() {
    const vpTwist a = law->step(measurement, 0.01).v, b = plain->step(measurement, 0.01).v;
    return Eigen::Vector3d(a[3] - b[3], a[4] - b[4], a[5] - b[5]).norm();
  };
  for (int i = 0; i < 1000; ++i) { // a camera that does not move: each step is reported as not executed
    REQUIRE(added() < 1e-12);
    law->notifyInterrupted();
  }
  double value = 0.;
  for (int i = 0; i < 1000; ++i) { // the same, unreported: up to the limit
    value = added();
    REQUIRE(value <= 0.1 + 1e-12);
  }
  CHECK(value == Approx(0.1));
  law->reset();
  law->setGoal(plain->goal());
  CHECK(added() < 1e-12);
}

TEST_CASE("the controller tells the law when the filter limits its twist", "[controller][integral]")
{
  auto rng = vpTestSupport::generator(56);
  const auto points = object(rng, 0.16, 4);
  vpServoControllerSpec spec;
  spec.view.maxAngular = 0.05;
  auto servo = vpServoController::create("ff-lookat-pi+cbf", spec),
       fresh = vpServoController::create("ff-lookat-pi+cbf", spec);
  const vpHomogeneousMatrix cdMo = facing(0., 0.);
  vpServoMeasurement far, near;
  measure(pose(turn(0.1, Eigen::Vector3d::UnitX()), Eigen::Vector3d::Zero()) * cdMo, points, far);
  measure(pose(turn(0.02, Eigen::Vector3d::UnitX()), Eigen::Vector3d::Zero()) * cdMo, points, near);
  servo.setGoal(goal(cdMo, points));
  fresh.setGoal(goal(cdMo, points));
  for (int i = 0; i < 500; ++i) { // slower than commanded for seconds: no reason to integrate
    REQUIRE(servo.step(far, 0.01).status == vpServoStatus::ViewLimited);
  }
  CHECK(servo.step(near, 0.01).v[3] == Approx(fresh.step(near, 0.01).v[3]).epsilon(1e-9));
}

TEST_CASE("the pipeline goes through its statuses", "[controller]")
{
  auto rng = vpTestSupport::generator(55);
  const auto points = object(rng, 0.26, 8);
  vpServoControllerSpec spec;
  spec.recovery.holdTime = 0.03;
  auto servo = vpServoController::create("pbvs1-rot2+cbf", spec);
  CHECK(servo.id() == "pbvs1-rot2+cbf");
  CHECK(servo.law().id() == "pbvs1-rot2");
  vpServoMeasurement measurement, nothing;
  std::set<vpServoStatus> met;
  const auto step = [&](const vpServoMeasurement &m) {
    const vpServoCommand command = servo.step(m, 0.01);
    met.insert(command.status);
    CHECK(std::string(vpMessage(command.status)).back() == '.');
    return command;
  };
  vpHomogeneousMatrix cMo = facing(0., 0.);
  measure(cMo, points, measurement);
  CHECK(step(measurement).status == vpServoStatus::NoGoal);
  servo.setGoal(goal(facing(0.3, 0.), points)); // rotates faster than it translates: the object reaches the border
  for (int i = 0; i < 100; ++i) {
    measure(cMo, points, measurement);
    cMo = move(cMo, step(measurement).v, 0.01);
    REQUIRE(inView(measurement.outline));
  }
  CHECK(met.count(vpServoStatus::ViewLimited) == 1);
  const vpHomogeneousMatrix before = cMo;
  for (int i = 0; i < 50; ++i) {
    cMo = move(cMo, step(nothing).v, 0.01);
  }
  CHECK(met.count(vpServoStatus::Retreating) == 1);
  CHECK(translation(before * cMo.inverse()).norm() > 0.01);
  measure(cMo, points, measurement);
  CHECK(step(measurement).status != vpServoStatus::Retreating);
  measurement.cMo[0][0] = 5.;
  CHECK(step(measurement).status == vpServoStatus::InvalidInput);
  servo.reset();
  CHECK(step(measurement).status == vpServoStatus::NoGoal);
}

TEST_CASE("controller set-up names what is wrong", "[controller][errors]")
{
  using Catch::Contains;
  CHECK(vpServoController::ids() == vpServoLaw::ids());
  for (const char *id : {"ff-lookat+cbff", "+cbf", "ff-lookat-pi+cbf+cbf", "", "FF-SUM"}) {
    CAPTURE(id);
    CHECK_THROWS_WITH(vpServoController::create(id), Contains("is unknown, known are: pbvs1, "));
  }
  for (const std::string id : {"dtg", "ff-dtg"}) {
    CHECK_THROWS_WITH(vpServoController::create(id + "+cbf"),
                      Contains("\"" + id + "+cbf\": the view filter cannot follow a law that plans"));
  }
  vpServoControllerSpec spec;
  spec.gains.rotation = -1.;
  CHECK_THROWS_WITH(vpServoController::create("pbvs1", spec), Contains("rotation of the servo gains is -1"));
  spec = {};
  spec.view.top = 1.;
  CHECK_THROWS_WITH(vpServoController::create("pbvs1", spec), Contains("top border of the view constraint is 1"));
  spec = {};
  spec.recovery.maxLinear = -2.;
  CHECK_THROWS_WITH(vpServoController::create("pbvs1", spec), Contains("maxLinear of the target-loss recovery is -2"));
}
