/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchServoPlanLimits.cpp
 * \brief Laws that plan: limits in every cycle whatever happens, no allocation.
 */
#include "vpCatch.h"
#include "vpPlanTestKit.h"

#include <limits>

namespace
{
using namespace vpPlanTestKit;

// A run in which everything happens: noise, friction, new goals, lost targets, commands that were not executed as given.
double worstOfWildRun(const std::string &law, unsigned int problem)
{
  auto rng = generator(problem);
  const vpServoMotionLimits limits = randomLimits(rng);
  const double dt = std::vector<double>{0.001, 0.004, 0.01, 0.03}[problem % 4];
  vpServoController servo = makeServo(law, limits);
  Judge judge(limits, dt);
  vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
  servo.setGoal(goal(randomPose(rng, 0.4, 0.8, 0.2, 0.6), square));
  const double friction = uniform(rng, 0., 0.2), noise = uniform(rng, 0., 0.01);
  vpServoMeasurement seen;
  double lostUntil = -1., slowUntil = -1.;
  bool wasSlowed = false;
  vpTwistShaper brake(limits.shaperLimits());
  for (double t = 0.; t < 4.; t += dt) {
    const double event = uniform(rng, 0., 1.) / dt; // rates, 1/s
    if (event < 0.7) {
      servo.setGoal(goal(randomPose(rng, 0.4, 0.8, 0.2, 0.6), square));
    }
    else if (event < 1.) {
      lostUntil = t + uniform(rng, 0., 1.);
    }
    measure(noisy(rng, cMo, noise, noise), square, seen);
    seen.time = std::floor(t * 30.) / 30.;
    seen.valid = t >= lostUntil;
    const vpServoCommand command = servo.step(seen, dt);
    vpTwist sent = command.v;
    slowUntil = event > 1. && event < 1.3 ? t + uniform(rng, 0., 0.2) : slowUntil;
    const bool isSlowed = t < slowUntil;
    if (isSlowed) { // something else brakes the robot, within its limits
      if (!wasSlowed) { // in each cycle it would forget half of its jerk, and leave speeds from which no motion keeps the limits
        brake.reset(judge.v(), judge.a());
      }
      sent = brake.step(command.v.scaled(0.5), dt);
    }
    wasSlowed = isSlowed;
    judge.see(sent);
    const vpTwist moved = withFriction(sent, friction);
    servo.notifyExecuted(sent, moved);
    cMo = move(cMo, moved, dt);
  }
  return judge.worst;
}
} // namespace

TEST_CASE("planned commands keep every limit in every cycle, whatever happens", "[plan]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  double worst = 0.;
  for (int problem = 0; problem < longer(40); ++problem) {
    CAPTURE(seed(), law, problem);
    const double here = worstOfWildRun(law, static_cast<unsigned int>(problem));
    CHECK(here <= 1. + 1e-6);
    worst = std::max(worst, here);
  }
  CHECK(worst > 0.8); // the limits are used
}

TEST_CASE("a target that is lost just when a motion begins, and is found again, makes no jump", "[plan]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  double worst = 0.;
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(80)); ++problem) {
    auto rng = generator(problem);
    const double dt = uniform(rng, 0.002, 0.012), gap = uniform(rng, 2., 10.) * dt;
    const int cycles = problem % 4 == 0 ? static_cast<int>(uniform(rng, 2., 8.)) : 1; // of the motion before the loss
    CAPTURE(seed(), law, problem, dt, cycles, gap);
    vpServoController servo = makeServo(law);
    Judge judge({}, dt);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 0.8, 0.2, 0.6);
    servo.setGoal(goal(randomPose(rng, 0.4, 0.8, 0.2, 0.6), square));
    vpServoMeasurement seen;
    int moving = 0;
    double lostUntil = 0.;
    for (double t = 0.; t < 1.; t += dt) {
      measure(cMo, square, seen);
      seen.time = t + dt;
      moving = moving > 0 || judge.v().linearNorm() > 0. ? moving + 1 : 0;
      lostUntil = moving == cycles ? t + gap : lostUntil;
      seen.valid = t >= lostUntil;
      judge.see(servo.step(seen, dt).v);
      cMo = move(cMo, judge.v(), dt);
    }
    CHECK(judge.worst <= 1. + 1e-6);
    worst = std::max(worst, judge.worst);
  }
  CHECK(worst > 0.8); // the limits are used
}

TEST_CASE("a law that is passed over follows the motion of the camera, and goes on from it within the limits", "[plan]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(20)); ++problem) {
    auto rng = generator(problem);
    const vpServoMotionLimits limits = randomLimits(rng);
    const double dt = std::vector<double>{0.001, 0.004, 0.01, 0.03}[problem % 4];
    CAPTURE(seed(), law, problem);
    vpServoController servo = makeServo(law, limits);
    Judge judge(limits, dt);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
    const vpHomogeneousMatrix cdMo = randomPose(rng, 0.4, 0.8, 0.2, 0.6);
    servo.setGoal(goal(cdMo, square));
    vpServoMeasurement seen;
    vpTwistShaper brake(limits.shaperLimits());
    double until = -1., next = uniform(rng, 0.1, 0.5);
    int pauses = 0;
    for (double t = 0.; t < 60.; t += dt) {
      if (t >= next && pauses < 6) {
        until = t + (pauses % 2 == 0 ? uniform(rng, 0., 0.1) : uniform(rng, 0., 2.));
        next = until + uniform(rng, 0.05, 0.8);
        brake.reset(judge.v(), judge.a());
        ++pauses;
      }
      measure(cMo, square, seen);
      seen.time = 1.; // one image: afterwards there is the odometry alone
      if (t < until) {
        servo.pass(dt);
        judge.see(brake.step(vpTwist(), dt));
      }
      else {
        judge.see(servo.step(seen, dt).v);
      }
      servo.notifyExecuted(judge.v(), judge.v());
      cMo = move(cMo, judge.v(), dt);
    }
    CHECK(judge.worst <= 1. + 1e-6);
    CHECK(pauses == 6);
    CHECK(servo.law().timeToArrival() == 0.);
    // A constant twist for 30 ms is not quite the planned motion, and no image corrects it.
    CHECK(translationError(cdMo, cMo) < (dt < 0.02 ? 0.0025 : 0.006));
    CHECK(rotationError(cdMo, cMo) < 0.0065);
  }
}

TEST_CASE("something else that brakes nearly as the law would leaves no step behind", "[plan]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  const vpServoMotionLimits limits;
  const double dt = 0.001;
  int hard = 0; // problems that brake with full acceleration
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(10)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    vpServoController servo = makeServo(law);
    Judge judge(limits, dt);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.8, 1., 0.3, 1.);
    servo.setGoal(goal(randomPose(rng, 0.4, 0.5, 0.2, 0.6), square));
    vpServoMeasurement seen;
    vpTwistShaper brake(limits.shaperLimits());
    vpTwist off = randomTwist(rng, 1., 1.); // grows so slowly that no limit notices it
    off = off.scaled(2e-7 * limits.linearVelocity / std::max(off.linearNorm(), off.angularNorm()));
    const double begin = uniform(rng, 0.6, 1.), end = begin + uniform(rng, 0.12, 0.3);
    bool isBraking = false, isHard = false;
    for (double t = 0.; t < 2.; t += dt) {
      measure(cMo, square, seen);
      seen.time = std::floor(t * 30.) / 30.;
      vpTwist sent = servo.step(seen, dt).v;
      if (t >= begin && t < end) {
        if (!isBraking) {
          brake.reset(judge.v(), judge.a());
        }
        isBraking = true;
        const double grown = std::min((t - begin) / 0.3, 1.);
        sent = minus(brake.step(vpTwist(), dt), off.scaled(grown * grown * (3. - 2. * grown)));
        isHard = isHard || judge.a().linearNorm() > 0.999 * limits.linearAcceleration;
      }
      judge.see(sent);
      servo.notifyExecuted(sent, sent);
      cMo = move(cMo, sent, dt);
    }
    CHECK(judge.worst <= 1. + 5e-6); // the jerk of off itself is up to 4e-6
    hard += isHard ? 1 : 0;
  }
  CHECK(2 * hard > longer(10));
}

TEST_CASE("a push that the feedback takes back, and another goal meanwhile, keep every limit", "[plan]")
{
  for (int problem = 0; problem < longer(10); ++problem) {
    auto rng = generator(static_cast<unsigned int>(problem));
    const vpServoMotionLimits limits = randomLimits(rng);
    const double dt = problem % 2 ? 0.004 : 0.01;
    vpServoController servo = makeServo("ff-dtg", limits);
    Judge judge(limits, dt);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 0.6, 0.1, 0.3);
    vpServoMeasurement seen;
    vpTwist push;
    double next = 0.;
    for (double t = 0.; t < 8.; t += dt) {
      if (t >= next) { // a goal nearby, then pushes
        servo.setGoal(goal(randomPose(rng, 0.45, 0.55, 0.05, 0.1), square));
        next = t + uniform(rng, 0.5, 3.);
      }
      if (uniform(rng, 0., 1.) < 5. * dt) {
        push = uniform(rng, 0., 1.) < 0.5 ? vpTwist() : randomTwist(rng, 0.1, 0.2);
      }
      measure(cMo, square, seen);
      seen.time = t + dt;
      judge.see(servo.step(seen, dt).v);
      vpTwist moved = judge.v();
      for (std::size_t k = 0; k < 6; ++k) {
        moved[k] += push[k];
      }
      servo.notifyExecuted(judge.v(), moved);
      cMo = move(cMo, moved, dt);
    }
    CAPTURE(seed(), problem);
    CHECK(judge.worst <= 1. + 1e-6);
  }
}

TEST_CASE("wild measurements and motions leave the planned twist finite and within the limits", "[plan][wild]")
{
  const std::string law = GENERATE("dtg", "ff-dtg");
  const double wild[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300,
                         -1e7};
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(20)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), law, problem);
    vpServoController servo = makeServo(law);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
    servo.setGoal(goal(randomPose(rng, 0.4, 0.8, 0.2, 0.6), square));
    vpServoMeasurement seen;
    for (int i = 0; i < 400; ++i) {
      measure(cMo, square, seen);
      seen.time = 0.01 * i;
      const double number = wild[static_cast<std::size_t>(uniform(rng, 0., 3.999))];
      const double what = uniform(rng, 0., 1.);
      if (what < 0.05) {
        seen.cMo[static_cast<unsigned int>(uniform(rng, 0., 2.99))][3] = number;
      }
      else if (what < 0.07) {
        seen.time = number;
      }
      const vpServoCommand command = servo.step(seen, what > 0.95 ? number : 0.01);
      CHECK(command.v.isFinite());
      CHECK(command.v.linearNorm() <= vpServoMotionLimits().linearVelocity * (1. + 1e-9));
      CHECK(command.v.angularNorm() <= vpServoMotionLimits().angularVelocity * (1. + 1e-9));
      if (what > 0.9 && what < 0.92) {
        servo.notifyExecuted(vpTwist(number, 0., 0., 0., 0., 0.), vpTwist(0., number, 0., 0., 0., 0.));
      }
      cMo = move(cMo, command.v, 0.01);
    }
  }
}

TEST_CASE("a step that plans allocates nothing", "[plan][realtime]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("this build cannot count allocations");
    return;
  }
  const std::string law = GENERATE("dtg", "ff-dtg");
  auto rng = generator(4);
  vpServoController servo = makeServo(law);
  const vpServoGoal goals[] = {goal(randomPose(rng, 0.4, 0.8, 0.2, 0.6), square),
                               goal(randomPose(rng, 0.4, 0.8, 0.2, 0.6), square)};
  vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
  vpServoMeasurement seen;
  servo.setGoal(goals[0]);
  int plans = 0;
  for (int i = 0; i < 3000; ++i) {
    if (i % 700 == 699) {
      servo.setGoal(goals[(i / 700) % 2]);
    }
    measure(noisy(rng, cMo, 0.001, 0.005), square, seen);
    seen.time = 0.01 * (i / 10 + 1);
    seen.valid = i % 500 > 20;
    const unsigned long before = vpTestSupport::allocationCount();
    const vpServoCommand command = servo.step(seen, 0.01);
    servo.notifyExecuted(command.v, command.v);
    REQUIRE(vpTestSupport::allocationCount() == before);
    plans = servo.law().plans();
    cMo = move(cMo, command.v, 0.01);
  }
  CHECK(plans > 0);
}
