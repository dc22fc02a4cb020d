/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file catchServoPlanLaws.cpp
 * \brief Laws that plan: limits in every cycle whatever happens, arrival when told, no chatter, no allocation.
 */
#include "vpCatch.h"
#include "vpServoScene.h"

#include <visp3/feedforward/vpObjectAverage.h>
#include <visp3/feedforward/vpServoController.h>

#include <limits>

namespace
{
using namespace vpServoScene;
using vpTestSupport::generator;
using vpTestSupport::longer;
using vpTestSupport::seed;

vpTwist minus(const vpTwist &a, const vpTwist &b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]};
}

// Judges commands by their differences; independent of how they were planned.
class Judge
{
public:
  Judge(const vpServoMotionLimits &limits, double dt) : m_limits(limits), m_dt(dt) {}

  void see(const vpTwist &v)
  {
    const vpTwist a = minus(v, m_v).scaled(1. / m_dt), j = minus(a, m_a).scaled(1. / m_dt);
    const double here =
        std::max({v.linearNorm() / m_limits.linearVelocity, v.angularNorm() / m_limits.angularVelocity,
                  a.linearNorm() / m_limits.linearAcceleration, a.angularNorm() / m_limits.angularAcceleration,
                  j.linearNorm() / m_limits.linearJerk, j.angularNorm() / m_limits.angularJerk});
    worst = std::max(worst, here);
    squares += j.linearNorm() * j.linearNorm();
    m_v = v;
    m_a = a;
  }
  const vpTwist &v() const { return m_v; }
  const vpTwist &a() const { return m_a; }

  double worst = 0., squares = 0.;

private:
  vpServoMotionLimits m_limits;
  double m_dt;
  vpTwist m_v, m_a;
};

vpServoMotionLimits randomLimits(std::mt19937_64 &rng)
{
  vpServoMotionLimits limits;
  for (double *field : {&limits.linearVelocity, &limits.linearAcceleration, &limits.linearJerk, &limits.angularVelocity,
                        &limits.angularAcceleration, &limits.angularJerk}) {
    *field *= std::exp(uniform(rng, -1., 1.));
  }
  return limits;
}

vpServoController makeServo(const std::string &law, const vpServoMotionLimits &motion = {})
{
  vpServoControllerSpec spec;
  spec.motion = motion;
  return vpServoController::create(law, spec);
}

vpHomogeneousMatrix noisy(std::mt19937_64 &rng, const vpHomogeneousMatrix &cMo, double shift, double angle)
{
  std::normal_distribution<double> gauss;
  return pose(turn(angle * gauss(rng), direction(rng)), shift * gauss(rng) * direction(rng)) * cMo;
}

// Camera twist executed with friction on the rotation.
vpTwist withFriction(const vpTwist &v, double deadband)
{
  vpTwist moved = v;
  for (std::size_t k = 3; k < 6; ++k) {
    moved[k] = std::copysign(std::max(std::abs(v[k]) - deadband, 0.), v[k]);
  }
  return moved;
}

const std::vector<Eigen::Vector3d> square = {{-.08, -.08, 0.}, {.08, -.08, 0.}, {.08, .08, 0.}, {-.08, .08, 0.}};

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
    if (t < slowUntil) { // something else brakes the robot, within its limits
      brake.reset(judge.v(), judge.a());
      sent = brake.step(command.v.scaled(0.5), dt);
    }
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

namespace
{
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
  CHECK(plans > 2);
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

TEST_CASE("the average of an object is the mean of its images, and follows an object that was moved", "[average]")
{
  for (unsigned int problem = 0; problem < static_cast<unsigned int>(longer(50)); ++problem) {
    auto rng = generator(problem);
    CAPTURE(seed(), problem);
    vpObjectAverage average(20);
    vpHomogeneousMatrix cMo = randomPose(rng, 0.4, 1., 0.3, 1.);
    vpServoMeasurement seen;
    double squares = 0.;
    int count = 0;
    for (int i = 0; i < 400; ++i) {
      measure(noisy(rng, cMo, 0.002, 0.005), square, seen);
      seen.time = 0.1 * (i + 1);
      CHECK(average.see(seen));
      CHECK_FALSE(average.see(seen)); // the same image
      average.predict(seen);
      if (i >= 100) {
        squares += std::pow(translationError(cMo, seen.cMo), 2);
        ++count;
      }
      const vpTwist v = randomTwist(rng, 0.1, 0.3);
      average.move(v, 0.1);
      cMo = move(cMo, v, 0.1);
    }
    // One image: 2 mm and 5 mrad at about 0.7 m; the mean of the last 20, weighted: its deviation over sqrt(39).
    CHECK(std::sqrt(squares / count) < 0.4 * std::hypot(0.002, 0.005));
    cMo = pose(turn(0.3, direction(rng)), 0.1 * direction(rng)) * cMo;
    for (int i = 0; i < 4; ++i) {
      measure(cMo, square, seen);
      seen.time = 100. + i;
      CHECK(average.see(seen));
    }
    average.predict(seen);
    CHECK(translationError(cMo, seen.cMo) < 1e-9);
  }
  CHECK_THROWS_WITH(vpObjectAverage(0), "the window of the object average is 0 images, must be >= 1");
}
