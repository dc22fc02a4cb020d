/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Every step of this module under NaN, infinities, numbers whose squares overflow and denormals: the output is finite
// and within the limits, the status reports it, and a rejected input makes the arm brake.
#include "vpArmTestKit.h"
#include "vpCatch.h"
#include "vpWildNumbers.h"

#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpJointBounds.h>
#include <visp3/manipulator/vpJointPositionControl.h>
#include <visp3/manipulator/vpJointVelocityControl.h>
#include <visp3/manipulator/vpJointVelocityEstimator.h>

using namespace vpArmTestKit;

namespace
{
constexpr int sequences = 60, steps = 60;
constexpr double share = 0.03; // of wild numbers: about half of the steps have one

double wild(std::mt19937_64 &rng, double ordinary) { return vpWildNumbers::mixed(rng, ordinary, share); }
vpJointVector wild(std::mt19937_64 &rng, vpJointVector numbers)
{
  vpWildNumbers::mix(rng, numbers, share);
  return numbers;
}
bool isGood(const vpJointVector &numbers)
{
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::fabs(x) <= vpArmLargest; });
}
const vpArmModel &anyArm(std::mt19937_64 &rng)
{
  const int k = std::uniform_int_distribution<int>(0, 2)(rng);
  return k == 0 ? amor() : k == 1 ? sixAxes() : mixed();
}

// Independent check of the limits: the next velocity is within the velocity limit, and within the acceleration limit
// unless the last one was invalid or beyond the velocity limit.
void requireWithin(const vpArmModel &model, const vpJointVector &before, const vpJointVector &velocity, double period)
{
  REQUIRE(velocity.size() == model.size());
  for (int i = 0; i < model.size(); ++i) {
    REQUIRE(vpWildNumbers::atMost(velocity(i), model.velocity()(i)));
    if (i < before.size() && std::fabs(before(i)) <= model.velocity()(i)) {
      REQUIRE(std::fabs(velocity(i) - before(i)) <= model.acceleration()(i) * period * (1. + 1e-9) + 1e-12);
    }
  }
}

void kinematics(std::mt19937_64 &rng)
{
  const vpArmModel &model = anyArm(rng);
  vpArmData data;
  for (int k = 0; k < steps; ++k) {
    const vpJointVector q = wild(rng, configuration(model, rng));
    const bool good = vpArmKinematics::update(model, q, data);
    REQUIRE(good == isGood(q));
    // All or nothing: NaN everywhere if invalid, so that every comparison fails.
    REQUIRE(data.J.cols() == model.size());
    REQUIRE(data.tool.p.allFinite() == good);
    REQUIRE(data.tool.R.allFinite() == good);
    REQUIRE(vpArmKinematics::camera(model, data).p.allFinite() == good);
    REQUIRE(data.J.allFinite() == good);
    REQUIRE(vpArmKinematics::analytic(model, data).allFinite() == good);
    const vpJointVector v = wild(rng, randomVector(model.size(), rng));
    const vpArmJacobian rate = vpArmKinematics::timeDerivative(model, data, v, vpArmFrame::Camera);
    REQUIRE(rate.allFinite() == (good && isGood(v)));
    vpIndexValue index;
    for (vpSelfMotionIndex wish :
         {vpSelfMotionIndex::manipulability(), vpSelfMotionIndex::jointLimits(),
          vpSelfMotionIndex::posture(wild(rng, configuration(model, rng))),
          vpSelfMotionIndex::pointDistance(1, Eigen::Vector3d(wild(rng, 0.1), 0.2, 0.3), vpIndexSense::Repel),
          vpSelfMotionIndex::lineDistance(2, vpIndexSense::Attract),
          vpSelfMotionIndex::planeDistance(1, Eigen::Vector3d(0., wild(rng, 0.1), 0.), Eigen::Vector3d::UnitX(),
                                           vpIndexSense::Repel)}) {
      wish.range = wild(rng, wish.range);
      wish.taskLength = wild(rng, wish.taskLength);
      const bool climbs = vpEvaluateIndex(model, data, wish, index);
      REQUIRE(std::isfinite(index.value));
      REQUIRE(std::isfinite(index.distance));
      REQUIRE(index.gradient.allFinite());
      REQUIRE((good || !climbs));
    }
  }
  REQUIRE_FALSE(vpArmKinematics::update(model, vpJointVector::Zero(model.size() - 1), data));
  REQUIRE_FALSE(data.tool.p.allFinite());
}

void jointBounds(std::mt19937_64 &rng)
{
  const vpArmModel &model = anyArm(rng);
  vpJointBounds bounds;
  for (int k = 0; k < steps; ++k) {
    const vpJointVector q = wild(rng, configuration(model, rng));
    const vpJointVector previous = wild(rng, vpJointVector(0.5 * randomVector(model.size(), rng)));
    const double period = wild(rng, 0.005), margin = wild(rng, 0.01);
    CAPTURE(q, previous, period, margin);
    const bool good = bounds.update(model, q, previous, period, margin);
    const bool timed = period > 0. && period <= vpArmLargest && margin >= 0. && margin <= vpArmLargest;
    REQUIRE(good == (timed && isGood(q) && isGood(previous)));
    vpJointVector velocity(model.size());
    for (int i = 0; i < model.size(); ++i) {
      velocity(i) = bounds.clamp(i, vpWildNumbers::any(rng));
      if (!timed) {
        REQUIRE(velocity(i) == 0.);
      }
      else if (!(std::fabs(q(i)) <= vpArmLargest)) { // brakes
        REQUIRE(std::fabs(velocity(i)) <= std::fabs(isGood(previous) ? previous(i) : model.velocity()(i)));
      }
      REQUIRE(std::fabs(bounds.clamp(i, NAN)) <= model.velocity()(i));
    }
    if (timed) {
      requireWithin(model, previous, velocity, period);
    }
    const double factor = bounds.together(model, wild(rng, randomVector(model.size(), rng)), timed ? period : 0.005);
    REQUIRE(factor >= 0.);
    REQUIRE(factor <= 1.);
  }
}

void redundancySolver(std::mt19937_64 &rng)
{
  const vpArmModel &model = anyArm(rng);
  const int n = model.size();
  vpRedundancySpec spec;
  spec.policy =
      std::uniform_int_distribution<int>(0, 1)(rng) == 0 ? vpLimitPolicy::StopJoints : vpLimitPolicy::ScaleMotion;
  const vpRedundancySolver solver(model, spec);
  vpArmData data;
  vpRedundancyOutput out;
  for (int k = 0; k < steps; ++k) {
    const vpJointVector q = wild(rng, configuration(model, rng));
    vpArmKinematics::update(model, q, data);
    vpRedundancyInput in;
    Eigen::Matrix<double, 6, 1> twist = 0.3 * Eigen::Matrix<double, 6, 1>::Random();
    vpWildNumbers::mix(rng, twist, share);
    in.twist = vpTwist(twist(0), twist(1), twist(2), twist(3), twist(4), twist(5));
    in.previous = wild(rng, vpJointVector(0.3 * randomVector(n, rng)));
    in.selfMotionShare = wild(rng, 1.);
    in.tasks[0].rows = 3;
    in.tasks[0].J.setRandom(6, n);
    in.tasks[0].velocity.setRandom();
    vpWildNumbers::mix(rng, in.tasks[0].velocity, share);
    in.taskCount = std::uniform_int_distribution<int>(0, 1)(rng);
    in.indices[0] = vpSelfMotionIndex::manipulability(wild(rng, 1.));
    in.indices[1] = vpSelfMotionIndex::posture(wild(rng, configuration(model, rng)));
    in.indexCount = 2;
    CAPTURE(k, model.label(), q, twist, in.previous, in.selfMotionShare, in.taskCount, in.tasks[0].velocity);
    solver.step(data, in, out);
    requireWithin(model, in.previous, out.velocity, spec.period);
    REQUIRE(out.selfMotion.allFinite());
    for (const double x : {out.taskShare, out.scale, out.smallestSingular}) {
      REQUIRE(std::isfinite(x));
    }
    bool good = isGood(q) && isGood(in.previous) && in.selfMotionShare >= 0. && in.selfMotionShare <= 1.;
    good =
        good && vpIsPlausibleForArm(twist) && (in.taskCount == 0 || vpIsPlausibleForArm(in.tasks[0].velocity.head(3)));
    REQUIRE((out.status == vpRedundancyStatus::InvalidInput) == !good);
    if (!good && isGood(in.previous)) {
      REQUIRE((out.velocity.array().abs() <= in.previous.array().abs()).all());
    }
  }
}

void closedLoop(std::mt19937_64 &rng)
{
  const vpArmModel &model = anyArm(rng);
  vpClosedLoopKinematics loop(model);
  vpClosedLoopState state;
  vpClosedLoopOutput out;
  state.q = configuration(model, rng, 0.2);
  for (int k = 0; k < steps; ++k) {
    vpClosedLoopInput in;
    vpArmData data;
    vpArmKinematics::forward(model, configuration(model, rng), data);
    in.goal = data.tool;
    vpWildNumbers::mix(rng, in.goal.p, share);
    in.goal.R(0, 0) = wild(rng, in.goal.R(0, 0));
    in.twist = vpTwist(0., wild(rng, 0.1), 0., 0., wild(rng, 0.), 0.);
    const vpJointVector before = state.velocity.size() == 0 ? vpJointVector::Zero(model.size()) : state.velocity;
    loop.step(in, state, out);
    requireWithin(model, before, state.velocity, loop.solver().spec().period);
    REQUIRE(state.q.allFinite());
    REQUIRE(out.error.allFinite());
    const bool rotation =
        (in.goal.R * in.goal.R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6;
    bool good = rotation && vpIsPlausibleForArm(in.goal.p);
    good = good && std::fabs(in.twist[1]) <= vpArmLargest && std::fabs(in.twist[4]) <= vpArmLargest;
    REQUIRE((out.status == vpClosedLoopStatus::InvalidInput) == !good);
  }
  // An invalid state ends in a status that is not Moving, so that no loop runs forever.
  vpArmData data;
  vpArmKinematics::forward(model, configuration(model, rng), data);
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    vpClosedLoopState broken;
    broken.q = configuration(model, rng);
    (std::isnan(x) && std::uniform_int_distribution<int>(0, 1)(rng) == 0 ? broken.waiting : broken.q(0)) = x;
    vpClosedLoopInput in;
    in.goal = data.tool;
    loop.step(in, broken, out);
    REQUIRE(out.status == vpClosedLoopStatus::InvalidInput);
    REQUIRE(broken.velocity.allFinite());
  }
}

void positionControl(std::mt19937_64 &rng)
{
  vpJointPositionControlSpec spec;
  spec.kp = spec.kd = vpJointVector::Constant(3, 100.);
  spec.maxTorque = vector({10., std::numeric_limits<double>::infinity(), 1e-3});
  spec.compensateFriction = true;
  spec.friction.viscous = spec.friction.coulomb = vpJointVector::Constant(3, 0.5);
  const vpJointPositionControl control(spec);
  vpJointPositionControl::Output out;
  for (int k = 0; k < steps; ++k) {
    const vpJointPositionControl::Input in{wild(rng, randomVector(3, rng)), wild(rng, randomVector(3, rng)),
                                           wild(rng, randomVector(3, rng)), wild(rng, randomVector(3, rng)),
                                           wild(rng, randomVector(3, rng))};
    control.step(in, out);
    const bool good = isGood(in.q) && isGood(in.velocity) && isGood(in.wantedQ) && isGood(in.wantedVelocity) &&
                      isGood(in.feedforward);
    REQUIRE(out.valid == good);
    REQUIRE(out.torque.allFinite());
    REQUIRE((out.torque.array().abs() <= spec.maxTorque.array()).all());
    REQUIRE((good || out.torque.isZero(0.)));
  }
}

void velocityControl(std::mt19937_64 &rng)
{
  vpJointVelocityControlSpec spec;
  spec.kp = spec.ki = vpJointVector::Constant(3, 100.);
  spec.maxTorque = vector({10., std::numeric_limits<double>::infinity(), 1e-3});
  vpJointVelocityControl control(spec);
  vpJointVelocityControl::Output out;
  for (int k = 0; k < steps; ++k) {
    const vpJointVelocityControl::Input in{wild(rng, randomVector(3, rng)), wild(rng, randomVector(3, rng)),
                                           wild(rng, randomVector(3, rng))};
    const vpJointVector integral = control.integral();
    control.step(in, out);
    const bool good = isGood(in.velocity) && isGood(in.wantedVelocity) && isGood(in.feedforward);
    REQUIRE(out.valid == good);
    REQUIRE(out.torque.allFinite());
    REQUIRE((out.torque.array().abs() <= spec.maxTorque.array()).all());
    REQUIRE(control.integral().allFinite());
    REQUIRE((good || control.integral() == integral));
  }
}

void velocityEstimator(std::mt19937_64 &rng)
{
  vpJointVelocityEstimator estimator(3, 0.001, 300.);
  for (int k = 0; k < steps; ++k) {
    const vpJointVector q = wild(rng, randomVector(3, rng)), a = wild(rng, randomVector(3, rng));
    REQUIRE(estimator.step(q, a).allFinite());
    REQUIRE(estimator.position().allFinite());
    REQUIRE(estimator.measured() == isGood(q));
  }
  // Not lost: two poles at exp(-0.3) forget 1e9 rad in some hundred readings.
  for (int k = 0; k < 400; ++k) {
    estimator.step(vpJointVector::Constant(3, 1.));
  }
  CHECK(estimator.velocity().cwiseAbs().maxCoeff() < 1e-9);
}

void friction(std::mt19937_64 &rng)
{
  const vpJointFriction friction{vpJointVector::Constant(3, 0.5), vpJointVector::Constant(3, 0.2), 0.01};
  vpJointVector torque;
  for (int k = 0; k < steps; ++k) {
    const vpJointVector v = wild(rng, randomVector(3, rng));
    REQUIRE(friction.torque(v, torque) == isGood(v));
    REQUIRE(torque.allFinite());
  }
  REQUIRE_FALSE(friction.torque(vpJointVector::Zero(2), torque));
}

void dynamics(std::mt19937_64 &rng)
{
  const vpArmModel &model = anyArm(rng);
  vpArmDynamics arm(model);
  for (int k = 0; k < steps; ++k) {
    const vpJointVector q = wild(rng, configuration(model, rng)), v = wild(rng, randomVector(model.size(), rng));
    const vpJointVector torque = wild(rng, randomVector(model.size(), rng));
    vpJointVector result;
    vpJointMatrix M;
    REQUIRE(arm.inertia(q, M) == isGood(q));
    REQUIRE(M.allFinite());
    REQUIRE(arm.gravity(q, result) == isGood(q));
    REQUIRE(result.allFinite());
    REQUIRE(arm.coriolis(q, v, result) == (isGood(q) && isGood(v)));
    REQUIRE(result.allFinite());
    REQUIRE(arm.acceleration(q, v, torque, result) == (isGood(q) && isGood(v) && isGood(torque)));
    REQUIRE(result.allFinite());
  }
}

struct Step {
  const char *name;
  void (*run)(std::mt19937_64 &);
};
// Add new classes with a step to this list.
const Step everyStep[] = {{"vpArmKinematics, vpEvaluateIndex", kinematics},
                          {"vpJointBounds", jointBounds},
                          {"vpRedundancySolver", redundancySolver},
                          {"vpClosedLoopKinematics", closedLoop},
                          {"vpJointPositionControl", positionControl},
                          {"vpJointVelocityControl", velocityControl},
                          {"vpJointVelocityEstimator", velocityEstimator},
                          {"vpJointFriction", friction},
                          {"vpArmDynamics", dynamics}};
} // namespace

TEST_CASE("Under wild numbers every step of an arm answers finitely, within the limits, and says so", "[wild]")
{
  CAPTURE(vpTestSupport::seed());
  for (const Step &step : everyStep) {
    DYNAMIC_SECTION(step.name)
    {
      for (unsigned int sequence = 0; sequence < static_cast<unsigned int>(sequences); ++sequence) {
        CAPTURE(sequence);
        auto rng = vpTestSupport::generator(900 + sequence);
        step.run(rng);
      }
    }
  }
}

TEST_CASE("A joint on its limit by rounding is within it, and messages tell a number from its limit", "[limits]")
{
  vpArmSpec spec = mixed().spec();
  spec.joints[0].lower = -pi;
  spec.joints[0].upper = pi;
  vpJointVector q = vpJointVector::Zero(4);
  for (const double place : {pi, std::nextafter(pi, 4.), static_cast<double>(static_cast<float>(pi)),
                             -static_cast<double>(static_cast<float>(pi))}) {
    q(0) = place;
    CHECK(vpArmModel(spec).outsideLimits(q).empty());
    spec.home = q;
    CHECK_NOTHROW(vpArmModel(spec));
  }
  spec.home.resize(0);
  const vpArmModel model(spec);
  q(0) = pi * (1. + 1.1e-6);
  CHECK(model.outsideLimits(q) == "joint m0 at 3.1416, outside its limits -3.14159 and 3.14159");
  spec.joints[0].upper = 3.1416;
  CHECK(vpArmModel(spec).outsideLimits(vector({3.141604, 0., 0., 0.})) ==
        "joint m0 at 3.141604, outside its limits -3.141593 and 3.1416");
  q(0) = NAN;
  CHECK(model.outsideLimits(q) == "joint m0 at nan, outside its limits -3.14159 and 3.14159");
  CHECK(model.outsideLimits(vpJointVector::Zero(3)) == "3 joints, the arm has 4");
}

TEST_CASE("An arm with numbers beyond reason is refused", "[limits]")
{
  const auto error = [](const vpArmSpec &spec) {
    try {
      const vpArmModel model(spec);
    }
    catch (const vpException &e) {
      return std::string(e.getMessage());
    }
    return std::string("taken");
  };
  vpArmSpec spec = mixed().spec();
  spec.joints[1].after.p(0) = 2147483648.;
  CHECK(error(spec) ==
        "arm mixed: translation of the frame after of joint m1 is 2.14748e+09 m, must be within 10000 m");
  spec = mixed().spec();
  spec.joints[1].velocity = 1e300;
  CHECK(error(spec) == "arm mixed: velocity limit of joint m1 is 1e+300, must be from 1e-12 to 1e9");
  spec = mixed().spec();
  spec.capsules.push_back({1, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 1e19});
  CHECK(error(spec) == "arm mixed: capsule radius of link 1 is 1e+19, must be from 1e-12 to 1e9");
}
