/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchServoPlanPace.cpp
 * \brief Laws that plan: factors on their speeds, and planning at a fixed rate.
 */
#include "vpCatch.h"
#include "vpPlanTestKit.h"

#include <limits>

using namespace vpPlanTestKit;

TEST_CASE("a speed factor gives the same motion, slower", "[plan][factor]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(10)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    const vpServoMotionLimits limits = randomLimits(rng);
    const double factor = uniform(rng, 0.2, 0.9), dt = 0.004;
    const vpHomogeneousMatrix start = randomPose(rng, 0.4, 1., 0.3, 1.);
    const vpServoGoal wanted = goal(randomPose(rng, 0.4, 0.8, 0.2, 0.6), square);
    double arrival[2];
    for (const bool isSlow : {false, true}) {
      vpServoController servo = makeServo(law, limits);
      servo.setGoal(wanted);
      servo.setSpeedFactor(isSlow ? factor : 1.);
      Judge judge(isSlow ? limits.slowed(factor) : limits, dt);
      vpHomogeneousMatrix cMo = start;
      vpServoMeasurement seen;
      double t = 0.;
      for (; t < 200. && servo.law().timeToArrival() != 0.; t += dt) {
        measure(cMo, square, seen);
        judge.see(servo.step(seen, dt).v);
        cMo = move(cMo, judge.v(), dt);
      }
      arrival[isSlow] = t;
      CHECK(judge.worst <= 1. + 1e-6);
      CHECK(translationError(wanted.cdMo, cMo) < 1e-3);
    }
    CHECK(arrival[1] * factor == Approx(arrival[0]).epsilon(0.03).margin(0.2));
  }
}

TEST_CASE("a speed factor that changes on the way brakes a plan that is too fast, and quickens one that is too slow",
          "[plan][factor]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(10)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    const vpServoMotionLimits limits; // 0.5 s to their speeds
    const double low = uniform(rng, 0.3, 0.5), dt = 0.01;
    vpServoController servo = makeServo(law, limits);
    Judge judge(limits, dt);
    vpHomogeneousMatrix cMo = pose(turn(0.2, direction(rng)), {0.1, 0., 2.});
    const vpHomogeneousMatrix cdMo = pose(Eigen::Matrix3d::Identity(), {0., 0., 0.4});
    servo.setGoal(goal(cdMo, square));
    vpServoMeasurement seen;
    double fastest = 0.;
    const auto run = [&](double from, double to, double factor) {
      servo.setSpeedFactor(factor);
      fastest = 0.;
      for (double t = from; t < to; t += dt) {
        measure(cMo, square, seen);
        seen.time = t + dt;
        judge.see(servo.step(seen, dt).v);
        cMo = move(cMo, judge.v(), dt);
        fastest = std::max(fastest, judge.v().linearNorm());
      }
      return fastest / limits.linearVelocity;
    };
    CHECK(run(0., 2., 1.) > 0.8);
    run(2., 3.5, low); // brakes
    CHECK(run(3.5, 6., low) <= low * (1. + 1e-6));
    CHECK(fastest > 0.6 * low * limits.linearVelocity);
    CHECK(run(6., 9., 1.) > 0.8);
    run(9., 16., std::numeric_limits<double>::quiet_NaN());
    CHECK(judge.v().linearNorm() <= 0.01 * limits.linearVelocity * (1. + 1e-6)); // NaN is slow
    run(16., 30., 1.);
    CHECK(translationError(cdMo, cMo) < 0.0021);
    CHECK(judge.worst <= 1. + 1e-6);
  }
}

TEST_CASE("rate mode plans again and again and still arrives within the limits", "[plan][rate]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  vpServoControllerSpec spec;
  spec.gains.replanPeriod = 0.05;
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(10)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    vpServoController servo = vpServoController::create(law, spec);
    Judge judge(spec.motion, 0.01);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
    const vpHomogeneousMatrix cdMo = randomPose(rng, 0.4, 0.8, 0.2, 0.6);
    servo.setGoal(goal(cdMo, square));
    vpServoMeasurement seen;
    for (int i = 0; i < 1200; ++i) {
      measure(cMo, square, seen);
      const vpServoCommand command = servo.step(seen, 0.01);
      judge.see(command.v);
      cMo = move(cMo, command.v, 0.01);
    }
    CHECK(servo.law().plans() > 1); // where a new plan cannot be verified the old one stays
    CHECK(judge.worst <= 1. + 1e-6);
    CHECK(translationError(cdMo, cMo) < 0.0021); // within the zone of noise
    CHECK(rotationError(cdMo, cMo) < 0.0061);
  }
}

TEST_CASE("another goal while the camera accelerates is planned for on the way, without a stop", "[plan]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  int stopped = 0;
  const int problems = longer(20);
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(problems); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    const double dt = problem % 2 ? 0.001 : 0.01;
    vpServoController servo = makeServo(law);
    Judge judge({}, dt);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.6, 1., 0.3, 1.);
    const vpServoGoal goals[] = {goal(randomPose(rng, 0.4, 0.6, 0.2, 0.6), square),
                                 goal(randomPose(rng, 0.4, 0.6, 0.2, 0.6), square)};
    servo.setGoal(goals[0]);
    const double change = uniform(rng, 0.15, 0.4);
    vpServoMeasurement seen;
    bool isChanged = false, hasStopped = false;
    for (double t = 0.; t < 12. && !(isChanged && servo.law().timeToArrival() == 0.); t += dt) {
      if (t >= change && !isChanged) {
        servo.setGoal(goals[1]);
        isChanged = true;
      }
      measure(cMo, square, seen);
      seen.time = t + dt;
      judge.see(servo.step(seen, dt).v);
      cMo = move(cMo, judge.v(), dt);
      const bool isOnItsWay = translationError(goals[1].cdMo, cMo) > 0.01;
      hasStopped = hasStopped || (isChanged && isOnItsWay && judge.v().linearNorm() == 0.);
    }
    CHECK(judge.worst <= 1. + 1e-6);
    CHECK(translationError(goals[1].cdMo, cMo) < 0.0021);
    stopped += hasStopped ? 1 : 0;
  }
  CAPTURE(seed(), law, stopped);
  CHECK(4 * stopped <= problems);
}

TEST_CASE("a goal that turns out to be a little elsewhere is corrected on the way, and the camera arrives as told",
          "[plan]")
{
  const int problems = longer(20);
  int corrected = 0, inTime = 0;
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(problems); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), problem);
    const double dt = problem % 2 ? 0.002 : 0.01, share = uniform(rng, 0.1, 0.7); // of the time, when the goal changes
    vpServoController servo = makeServo("ff-dtg");
    Judge judge({}, dt);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.6, 1., 0.3, 1.), cdMo = randomPose(rng, 0.4, 0.6, 0.2, 0.6);
    servo.setGoal(goal(cdMo, square));
    vpServoMeasurement seen;
    double told = 0., change = 12., t = 0.;
    bool isCorrected = false;
    for (; t < 12. && !(t > change && servo.law().timeToArrival() == 0.); t += dt) {
      if (told > 0. && t >= share * told && change == 12.) {
        cdMo = pose(Eigen::Matrix3d::Identity(), uniform(rng, 0.003, 0.008) * direction(rng)) * cdMo;
        servo.setGoal(goal(cdMo, square));
        change = t;
      }
      measure(cMo, square, seen);
      seen.time = t + dt;
      judge.see(servo.step(seen, dt).v);
      cMo = move(cMo, judge.v(), dt);
      told = told == 0. && servo.law().plans() > 0 ? t + servo.law().timeToArrival() : told;
      isCorrected = isCorrected || (t > change && t < change + 0.25 && servo.law().plans() > 1);
    }
    CHECK(judge.worst <= 1. + 1e-6);
    CHECK(translationError(cdMo, cMo) < 0.0021);
    corrected += isCorrected ? 1 : 0;
    inTime += t <= told + 0.1 ? 1 : 0;
  }
  CAPTURE(seed(), corrected, inTime);
  CHECK(10 * corrected >= 9 * problems);
  CHECK(2 * inTime >= problems); // nine of ten; a new plan each time: three of ten
}
