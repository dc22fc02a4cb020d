/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchServoPlanLaws.cpp
 * \brief Laws that plan: arrival when told, the object in view, no chatter, goals that move, friction, slow robots.
 */
#include "vpCatch.h"
#include "vpPlanTestKit.h"

#include <limits>

namespace
{
using namespace vpPlanTestKit;

// A robot that is slower than the law's limits, or cannot move at all.
class Slow : public vpServoMotionCheck
{
public:
  explicit Slow(double speed) : m_speed(speed) {}
  void begin() noexcept override { ++begun; }
  double add(const vpTwist &twist, double dt) noexcept override
  {
    CHECK(dt > 0.);
    return m_speed > 0. ? twist.linearNorm() / m_speed : std::numeric_limits<double>::infinity();
  }
  int begun = 0;

private:
  double m_speed;
};
} // namespace

TEST_CASE("the camera arrives when the law says", "[plan]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(30)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    const double dt = problem % 2 ? 0.001 : 0.01;
    vpServoController servo = makeServo(law, randomLimits(rng));
    CHECK(std::isnan(servo.law().timeToArrival()));
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
    const vpHomogeneousMatrix cdMo = randomPose(rng, 0.4, 0.8, 0.2, 0.6);
    servo.setGoal(goal(cdMo, square));
    vpServoMeasurement seen;
    double arrival = std::numeric_limits<double>::quiet_NaN();
    double t = 0.;
    for (; t < 60. && !(t > arrival + 0.1); t += dt) {
      measure(cMo, square, seen);
      seen.time = t;
      const vpServoCommand command = servo.step(seen, dt);
      REQUIRE(command.status == vpServoStatus::Servoing);
      const double told = t + dt + servo.law().timeToArrival();
      if (std::isnan(arrival)) {
        arrival = told;
      }
      CHECK(!(t + dt <= arrival && std::abs(told - arrival) > 1e-6)); // it does not change on the way
      cMo = move(cMo, command.v, dt);
    }
    REQUIRE(t < 60.);
    CHECK(servo.law().timeToArrival() == 0.);
    CHECK(servo.law().plans() == 1);
    CHECK(translationError(cdMo, cMo) < 2e-4);
    CHECK(rotationError(cdMo, cMo) < 2e-4);
  }
}

TEST_CASE("on the planned way the object's image goes to its goal, without a detour", "[plan][view]")
{
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(100)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), problem);
    vpServoController servo = makeServo("dtg");
    // Both look at the object: the gaze error is small, so the object stays near its place while the camera moves.
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.02, 1.);
    const vpHomogeneousMatrix cdMo = randomPose(rng, 0.4, 0.8, 0.02, 0.6);
    servo.setGoal(goal(cdMo, square));
    vpServoMeasurement seen;
    double farthest = 0.;
    for (double t = 0.; t < 8.; t += 0.01) {
      measure(cMo, square, seen);
      cMo = move(cMo, servo.step(seen, 0.01).v, 0.01);
      const Eigen::Vector3d o = translation(cMo), wanted = translation(cdMo);
      farthest = std::max(farthest, std::acos(std::min(1., o.normalized().dot(wanted.normalized()))));
    }
    CHECK(farthest < 0.045); // the start is at most 0.04 away
  }
}

TEST_CASE("noise makes neither plans nor jerk", "[plan][noise]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(10)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    vpServoController servo = makeServo(law);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.2, 0.8);
    const vpHomogeneousMatrix cdMo = randomPose(rng, 0.4, 0.6, 0.1, 0.4);
    servo.setGoal(goal(cdMo, square));
    Judge judge({}, 0.01);
    vpServoMeasurement seen;
    double early = 0.;
    int plansEarly = 0;
    for (int i = 0; i < 2000; ++i) {
      // 10 images per second, each with an error of its own of 0.5 deg and 2 mm.
      if (i % 10 == 0) {
        measure(noisy(rng, cMo, 0.002, 0.009), square, seen);
        seen.time = 0.01 * (i + 1);
      }
      const vpServoCommand command = servo.step(seen, 0.01);
      judge.see(command.v);
      cMo = move(cMo, command.v, 0.01);
      seen.cMo = move(seen.cMo, command.v, 0.01);
      if (i == 999) {
        early = judge.squares;
        plansEarly = servo.law().plans();
      }
    }
    CHECK(plansEarly <= 20);                       // of 100 images
    CHECK(servo.law().plans() - plansEarly <= 12); // of 100 more, at the goal
    CHECK(judge.squares - early <= 0.35 * early);  // 0.22 in 480 runs
    CHECK(translationError(cdMo, cMo) < 0.006);
    CHECK(rotationError(cdMo, cMo) < 0.012);
  }
}

TEST_CASE("a goal that moves is followed, one that jumps is reached", "[plan][goal]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(20)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    vpServoController servo = makeServo(law);
    Judge judge({}, 0.01);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.5, 0.9, 0.2, 0.6), cdMo = randomPose(rng, 0.5, 0.7, 0.1, 0.3);
    const Eigen::Vector3d drift = 0.02 * direction(rng);
    vpServoMeasurement seen;
    double lag = 0.;
    for (int i = 0; i < 1400; ++i) {
      if (i == 80 || i == 120) { // in mid-motion
        cdMo = randomPose(rng, 0.5, 0.7, 0.1, 0.3);
      }
      if (i >= 600 && i < 900) { // 20 mm/s
        cdMo = pose(Eigen::Matrix3d::Identity(), 0.01 * drift) * cdMo;
        lag = i >= 700 ? std::max(lag, translationError(cdMo, cMo)) : lag;
      }
      servo.setGoal(goal(cdMo, square)); // also every cycle
      measure(cMo, square, seen);
      seen.time = 0.01 * (i + 1);
      const vpServoCommand command = servo.step(seen, 0.01);
      judge.see(command.v);
      cMo = move(cMo, command.v, 0.01);
      if (i == 599) {
        CHECK(translationError(cdMo, cMo) < 0.0021);
        CHECK(rotationError(cdMo, cMo) < 0.0061);
      }
    }
    CHECK(lag < 0.02);
    CHECK(translationError(cdMo, cMo) < 0.0021);
    CHECK(judge.worst <= 1. + 1e-6);
    CHECK(servo.law().plans() < 60);
  }
}

TEST_CASE("the feedback of ff-dtg overcomes the friction that stops dtg", "[plan][friction]")
{
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(10)); ++problem) {
    double error[2];
    for (const int feedback : {0, 1}) {
      auto rng = generator(problem);
      vpServoController servo = makeServo(feedback ? "ff-dtg" : "dtg");
      vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.2, 0.3);
      const vpHomogeneousMatrix cdMo = pose(turn(0.6, direction(rng)), {0., 0., 0.5});
      servo.setGoal(goal(cdMo, square));
      vpServoMeasurement seen;
      for (int i = 0; i < 800; ++i) {
        measure(cMo, square, seen);
        seen.time = 0.01 * (i + 1);
        const vpServoCommand command = servo.step(seen, 0.01);
        const vpTwist moved = withFriction(command.v, 0.2);
        servo.notifyExecuted(command.v, moved);
        cMo = move(cMo, moved, 0.01);
      }
      error[feedback] = rotationError(cdMo, cMo);
    }
    CAPTURE(seed(), problem, error[0]);
    CHECK(error[1] < 0.01);
    CHECK(error[1] < error[0]);
  }
}

TEST_CASE("a plan is as slow as the robot needs it, and none is followed that it cannot execute", "[plan][robot]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  const double speed = GENERATE(0.05, 0.);
  auto rng = generator(3);
  CAPTURE(seed(), law, speed);
  Slow robot(speed);
  vpServoController servo = makeServo(law);
  servo.setMotionCheck(&robot);
  vpHomogeneousMatrix cMo = randomPose(rng, 0.8, 1., 0.2, 0.3);
  const vpHomogeneousMatrix cdMo = randomPose(rng, 0.4, 0.5, 0.1, 0.2);
  servo.setGoal(goal(cdMo, square));
  vpServoMeasurement seen;
  double fastest = 0.;
  vpServoStatus status = vpServoStatus::Servoing;
  for (int i = 0; i < 2500; ++i) {
    measure(cMo, square, seen);
    seen.time = 0.01 * (i + 1);
    const vpServoCommand command = servo.step(seen, 0.01);
    fastest = std::max(fastest, command.v.linearNorm());
    status = command.status;
    cMo = move(cMo, command.v, 0.01);
  }
  CHECK(robot.begun > 0);
  CHECK(fastest <= 1.05 * speed);
  if (speed > 0.) {
    CHECK(fastest > 0.8 * speed);
    CHECK(translationError(cdMo, cMo) < 0.0021);
  }
  else {
    CHECK(fastest == 0.);
    CHECK(status == vpServoStatus::Degenerate);
  }
}
