/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Derived gains of the drives, their two references, and the torque that a joint lacks.
#include "vpArmsOfTests.h"
#include "vpCatch.h"

#include <visp3/core/vpColVector.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <cmath>

using namespace vpArmsOfTests;

namespace
{
constexpr double period = 0.005; // s, of the commands

//! AMOR without gains of its own and with other friction and rotors.
vpArmModel withoutGains(std::mt19937_64 &rng, double mostViscous, double leastRotor)
{
  vpArmSpec spec = amor().spec();
  for (vpArmJointSpec &joint : spec.joints) {
    joint.kp = joint.kd = 0.;
    joint.torque = std::numeric_limits<double>::infinity();
    joint.viscous = mostViscous * std::pow(10., uniform(rng, -3., 0.));
    joint.coulomb = std::pow(10., uniform(rng, -2., 1.));
    joint.rotorInertia *= std::pow(leastRotor, uniform(rng, 0., 1.));
  }
  return vpArmModel(spec);
}

//! Commands a swing of each joint, there and back, then a rest of 4 s.
void swing(vpArmDrives &drives, std::mt19937_64 &rng)
{
  const int n = static_cast<int>(drives.q().size());
  const vpJointVector share = randomVector(n, rng);
  for (int k = 0; k < 1000; ++k) {
    drives.move((k < 200 ? 0.3 * std::sin(k * pi / 100.) : 0.) * share, period);
  }
}

//! One joint that turns a mass about the vertical, with gains and a torque limit.
vpArmModel table(double torque)
{
  vpArmSpec spec = turntable().spec();
  spec.joints[0].torque = torque;
  spec.joints[0].kp = 100.;
  spec.joints[0].kd = 12.;
  return vpArmModel(spec);
}
vpJointVector one(double value) { return vpJointVector::Constant(1, value); }
} // namespace

TEST_CASE("Derived gains are stable whatever friction the file has and the plant lacks", "[gains]")
{
  auto rng = vpTestSupport::generator(751);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 40; ++problem) {
    const vpArmModel model = withoutGains(rng, 1000., 1e-4);
    vpArmDriveSpec spec;
    spec.frictionScale = problem % 2;
    spec.encoderNoise = problem % 4 < 2 ? 0. : 1e-7;
    spec.period = problem % 3 == 0 ? 0.001 : uniform(rng, 0.0002, 0.002);
    vpArmDrives drives(model, spec);
    drives.reset(configuration(model, rng, 0.2));
    swing(drives, rng);
    CAPTURE(problem, spec.frictionScale, spec.encoderNoise, spec.period, drives.velocity().transpose());
    CAPTURE((drives.wanted() - drives.q()).transpose());
    // Without friction the joints end at rest where they are wanted; with it somewhere at rest.
    REQUIRE(drives.velocity().cwiseAbs().maxCoeff() < 0.02);
    REQUIRE((drives.wanted() - drives.q()).cwiseAbs().maxCoeff() < (problem % 2 == 0 ? 0.005 : 1.));
  }
}

TEST_CASE("Joints lag by friction no more than said", "[gains]")
{
  auto rng = vpTestSupport::generator(752);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 40; ++problem) {
    const vpArmModel model = withoutGains(rng, 2., 1.);
    vpArmDrives drives(model);
    drives.reset(configuration(model, rng, 0.3));
    vpJointVector velocity = 0.2 * randomVector(7, rng);
    for (int k = 0; k < 200; ++k) { // slowly up to speed, then constant
      drives.move(std::min(1., k / 100.) * velocity, period);
    }
    const vpJointVector lag = (drives.wanted() - drives.q()).cwiseAbs();
    for (int i = 0; i < 7; ++i) {
      const vpArmJointSpec &joint = model.spec().joints[static_cast<std::size_t>(i)];
      CAPTURE(problem, i, lag(i), velocity(i), joint.coulomb, joint.viscous);
      // Coriolis torques, which nobody compensates, give the rest.
      REQUIRE(lag(i) <= 1. / 300. + std::fabs(velocity(i)) / 200. + 5e-4);
    }
  }
}

TEST_CASE("What a joint lacks is the torque of the motion minus that of the drive", "[shortfall]")
{
  const double inertia = 0.5, viscous = 0.8, coulomb = 0.6;
  const vpArmModel model = table(1.);
  vpArmDrives drives(model);
  drives.reset(one(-1.));
  drives.move(one(0.02), period);
  CHECK(drives.needed()(0) == Approx(inertia * 0.02 / period + viscous * 0.02 + coulomb * std::tanh(2.)));
  for (int k = 0; k < 60; ++k) {
    drives.move(one(1.), period);
  }
  CHECK(drives.needed()(0) == Approx(viscous + coulomb)); // constant velocity
  CHECK(drives.saturated() == 1U);
  const vpJointShortfall lack{0, drives.needed()(0), drives.torque()(0)};
  CHECK(lack.missing() == Approx(0.4));
  CHECK(lack.message(model) == "the motion takes 1.4 Nm, the drive gives 1 Nm of at most 1 Nm, 0.4 Nm are missing");
  CHECK(vpJointShortfall{0, -1.4, -1.}.missing() == Approx(0.4));
  CHECK(vpJointShortfall{0, -1.4, 1.}.missing() == Approx(2.4));
  CHECK(vpJointShortfall{0, 1.4, 2.}.missing() == 0.);
  CHECK(vpJointShortfall().message(model).empty());
  drives.reset(one(0.));
  CHECK(drives.needed().norm() == 0.);
}

TEST_CASE("The arm names the joint that does not follow and the torque that is missing", "[shortfall]")
{
  vpSimulatedArmSpec spec;
  spec.redundancy.policy = vpLimitPolicy::StopJoints;
  spec.start = one(-1.5);
  vpSimulatedArm robot(table(1.), spec);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  CHECK(robot.getState().lost.joint == -1);
  for (int k = 0; k < 100; ++k) {
    robot.setVelocity(vpRobot::JOINT_STATE, vpColVector(1, 2.));
  }
  const vpSimulatedArmState state = robot.getState();
  CHECK(state.status == vpSimulatedArmStatus::NotFollowing);
  CHECK(state.lost.joint == 0);
  CHECK(state.lost.missing() == Approx(0.8 * 2. + 0.6 - 1.).margin(0.3)); // about at speed
  CHECK_THAT(robot.getSentence(), Catch::StartsWith("joint table did not follow its command (the motion takes ") &&
                                      Catch::Contains("the drive gives 1 Nm of at most 1 Nm") &&
                                      Catch::Contains("Nm are missing), the arm holds until it is stopped"));
  robot.setRobotState(vpRobot::STATE_STOP);
  CHECK(robot.getState().lost.joint == -1);
}

TEST_CASE("From the measured position a velocity moves a resting joint only beyond the friction", "[reference]")
{
  auto rng = vpTestSupport::generator(753);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 50; ++problem) {
    vpArmDriveSpec spec;
    spec.kp = one(uniform(rng, 20., 500.));
    spec.kd = one(uniform(rng, 2., 50.));
    spec.reference = vpDriveReference::Measured;
    vpArmDrives measured(turntable(), spec);
    spec.reference = vpDriveReference::Integrated;
    vpArmDrives integrated(turntable(), spec);
    const double least = 0.6 / (spec.kp(0) * period + spec.kd(0)), sign = problem % 2 == 0 ? 1. : -1.;
    CAPTURE(problem, spec.kp(0), spec.kd(0), least);
    for (vpArmDrives *drives : {&measured, &integrated}) {
      drives->reset(one(0.));
      for (int k = 0; k < 200; ++k) {
        drives->move(one(0.99 * sign * least), period);
      }
    }
    REQUIRE(measured.q()(0) == 0.);
    REQUIRE(measured.velocity()(0) == 0.);
    REQUIRE(sign * integrated.q()(0) > 0.);
    for (int k = 0; k < 200; ++k) {
      measured.move(one(1.02 * sign * least), period);
    }
    REQUIRE(sign * measured.q()(0) > 0.);
    // A zero command holds: pushing does not accumulate, and neither does measuring.
    measured.move(one(0.), period);
    const vpJointVector held = measured.wanted();
    for (int k = 0; k < 100; ++k) {
      measured.move(one(0.), period);
    }
    REQUIRE(measured.wanted() == held);
  }
}

TEST_CASE("The reference changes nothing for ideal drives, and positions are reached with both", "[reference]")
{
  vpSimulatedArmSpec spec;
  spec.drives.reference = vpDriveReference::Measured;
  vpSimulatedArm robot(amor(), spec);
  spec.drives.ideal = true;
  vpSimulatedArm ideal(amor(), spec);
  spec.drives.reference = vpDriveReference::Integrated;
  vpSimulatedArm same(amor(), spec);
  vpColVector goal(7), q;
  for (unsigned int i = 0; i < 7; ++i) {
    goal[i] = amor().home()(i) + 0.1;
  }
  for (vpSimulatedArm *arm : {&robot, &ideal, &same}) {
    arm->setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    for (int k = 0; k < 20; ++k) {
      arm->setVelocity(vpRobot::JOINT_STATE, vpColVector(7, 0.1));
    }
    arm->setRobotState(vpRobot::STATE_STOP);
    arm->setPosition(vpRobot::JOINT_STATE, goal);
    arm->getPosition(vpRobot::JOINT_STATE, q);
    for (unsigned int i = 0; i < 7; ++i) {
      CHECK(q[i] == Approx(goal[i]).margin(0.008));
    }
  }
  CHECK(ideal.getState().q == same.getState().q);
}
