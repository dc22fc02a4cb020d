/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The simulated arm through ViSP's interface, as a program for a real robot uses it.
#include "vpArmsOfTests.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpExponentialMap.h>
#include <visp3/core/vpRxyzVector.h>
#include <visp3/robot/vpRobotException.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <chrono>
#include <cmath>
#include <thread>

using namespace vpArmsOfTests;

namespace
{
vpSimulatedArmSpec ideal()
{
  vpSimulatedArmSpec spec;
  spec.drives.ideal = true;
  return spec;
}

vpColVector column(std::initializer_list<double> values)
{
  vpColVector v(static_cast<unsigned int>(values.size()));
  unsigned int i = 0;
  for (const double value : values) {
    v[i++] = value;
  }
  return v;
}

vpColVector columnOf(const vpJointVector &q)
{
  vpColVector v(static_cast<unsigned int>(q.size()));
  for (unsigned int i = 0; i < v.size(); ++i) {
    v[i] = q(static_cast<Eigen::Index>(i));
  }
  return v;
}

vpHomogeneousMatrix poseOf(const vpColVector &p) { return vpHomogeneousMatrix(p[0], p[1], p[2], p[3], p[4], p[5]); }

double difference(const vpHomogeneousMatrix &a, const vpHomogeneousMatrix &b)
{
  double most = 0.;
  for (unsigned int i = 0; i < 16; ++i) {
    most = std::max(most, std::fabs(a.data[i] - b.data[i]));
  }
  return most;
}

//! Twist from pose to pose in a time, axes and origin of the first frame.
vpColVector rate(const vpHomogeneousMatrix &before, const vpHomogeneousMatrix &now, double time)
{
  return vpExponentialMap::inverse(before.inverse() * now, time);
}

const vpRobot::vpControlFrameType spaceFrames[] = {vpRobot::CAMERA_FRAME, vpRobot::END_EFFECTOR_FRAME,
                                                   vpRobot::REFERENCE_FRAME, vpRobot::MIXT_FRAME};
} // namespace

TEST_CASE("A velocity moves the frame that it is meant for, in all frames and both arms", "[arm]")
{
  auto rng = vpTestSupport::generator(721);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel *model : {&amor(), &sixAxes()}) {
    for (int problem = 0; problem < 40; ++problem) {
      const auto frame = spaceFrames[problem % 4];
      CAPTURE(problem, frame);
      vpSimulatedArmSpec spec = ideal();
      spec.redundancy.period = 0.001;
      spec.start = model == &amor() ? amor().home() : vpJointVector(6);
      if (model != &amor()) {
        spec.start << -2.8, -0.6, -1.15, -1.3, 1.15, 0.25; // away from singularities
      }
      vpSimulatedArm robot(*model, spec);
      robot.setSamplingTime(0.001);
      robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
      vpColVector v(6);
      for (unsigned int i = 0; i < 6; ++i) {
        v[i] = uniform(rng, -0.03, 0.03);
      }
      for (int k = 0; k < 100; ++k) {
        robot.setVelocity(frame, v);
      }
      const vpHomogeneousMatrix fMc = robot.get_fMc(), fMe = robot.get_fMe();
      robot.setVelocity(frame, v);
      const vpHomogeneousMatrix fMc2 = robot.get_fMc(), fMe2 = robot.get_fMe();
      vpColVector done(6);
      switch (frame) {
      case vpRobot::CAMERA_FRAME:
        done = rate(fMc, fMc2, 0.001);
        break;
      case vpRobot::END_EFFECTOR_FRAME:
        done = rate(fMe, fMe2, 0.001);
        break;
      case vpRobot::REFERENCE_FRAME: {
        // Finite differences along the axes of the base.
        const vpHomogeneousMatrix turn = fMe2 * fMe.inverse();
        const vpThetaUVector w(turn.getRotationMatrix());
        for (unsigned int i = 0; i < 3; ++i) {
          done[i] = (fMe2[i][3] - fMe[i][3]) / 0.001;
          done[3 + i] = w[i] / 0.001;
        }
        break;
      }
      default: {
        const vpColVector inCamera = rate(fMc, fMc2, 0.001);
        for (unsigned int i = 0; i < 3; ++i) {
          done[i] = (fMc2[i][3] - fMc[i][3]) / 0.001;
          done[3 + i] = inCamera[3 + i];
        }
      }
      }
      CAPTURE(v.t(), done.t(), model->label(), robot.getSentence(), robot.getState().solver.smallestSingular);
      REQUIRE((done - v).infinityNorm() < 2e-4);
      vpColVector told;
      robot.getVelocity(frame, told);
      REQUIRE((told - v).infinityNorm() < 2e-4);
    }
  }
}

TEST_CASE("Jacobians are those that ViSP's task control expects", "[arm]")
{
  auto rng = vpTestSupport::generator(722);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel *model : {&amor(), &sixAxes()}) {
    for (int problem = 0; problem < 50; ++problem) {
      vpSimulatedArmSpec spec = ideal();
      spec.start = configuration(*model, rng, 0.2);
      vpSimulatedArm robot(*model, spec);
      robot.setSamplingTime(0.005);
      robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
      vpMatrix eJe, fJe;
      robot.get_eJe(eJe);
      robot.get_fJe(fJe);
      REQUIRE(eJe.getCols() == static_cast<unsigned int>(model->size()));
      const vpHomogeneousMatrix fMe = robot.get_fMe(), fMc = robot.get_fMc();
      const vpColVector qdot = columnOf(0.02 * randomVector(model->size(), rng)); // reached in one period
      robot.setVelocity(vpRobot::JOINT_STATE, qdot);
      const vpColVector twist = rate(fMe, robot.get_fMe(), 0.005);
      REQUIRE((eJe * qdot - twist).infinityNorm() < 1e-4);
      REQUIRE((robot.get_cVe() * eJe * qdot - rate(fMc, robot.get_fMc(), 0.005)).infinityNorm() < 1e-4);
      const vpColVector inBase = fJe * qdot, inTool = eJe * qdot;
      for (unsigned int i = 0; i < 3; ++i) {
        double linear = 0., angular = 0.;
        for (unsigned int k = 0; k < 3; ++k) {
          linear += fMe[i][k] * inTool[k];
          angular += fMe[i][k] * inTool[3 + k];
        }
        REQUIRE(inBase[i] == Approx(linear).margin(1e-12));
        REQUIRE(inBase[3 + i] == Approx(angular).margin(1e-12));
      }
    }
  }
}

TEST_CASE("Positions are reached, in joints and in space", "[arm]")
{
  auto rng = vpTestSupport::generator(723);
  CAPTURE(vpTestSupport::seed());
  for (const bool perfect : {true, false}) {
    vpSimulatedArmSpec spec;
    spec.drives.ideal = perfect;
    vpSimulatedArm robot(amor(), spec);
    robot.setPositioningVelocity(60.);
    for (int problem = 0; problem < 5; ++problem) {
      const vpJointVector goal = configuration(amor(), rng, 0.1);
      robot.setPosition(vpRobot::JOINT_STATE, columnOf(goal));
      const double off = (robot.getState().q - goal).cwiseAbs().maxCoeff();
      REQUIRE((robot.getState().wanted - goal).cwiseAbs().maxCoeff() < 1e-9);
      REQUIRE(off < (perfect ? 1e-9 : 0.006)); // friction holds back up to Fc / kp
    }
    robot.setPosition(vpRobot::JOINT_STATE, columnOf(amor().home()));
    const vpHomogeneousMatrix fMc = robot.get_fMc(), fMe = robot.get_fMe();
    const vpHomogeneousMatrix way(0.05, -0.03, -0.04, 0.1, -0.1, 0.2);
    vpColVector pose(6), read;
    const vpHomogeneousMatrix goalOfCamera = fMc * way;
    vpRxyzVector rxyz(goalOfCamera.getRotationMatrix());
    for (unsigned int i = 0; i < 3; ++i) {
      pose[i] = goalOfCamera[i][3];
      pose[3 + i] = rxyz[i];
    }
    robot.setPosition(vpRobot::REFERENCE_FRAME, pose);
    const double tolerance = perfect ? 5e-5 : 0.01;
    CHECK(difference(robot.get_fMc(), goalOfCamera) < tolerance);
    robot.getPosition(vpRobot::REFERENCE_FRAME, read);
    CHECK((read - pose).infinityNorm() < tolerance);
    robot.getPosition(vpRobot::CAMERA_FRAME, read);
    CHECK(difference(poseOf(read), robot.get_fMc()) < 1e-9);
    const vpPoseVector back(fMe);
    robot.setPosition(vpRobot::END_EFFECTOR_FRAME, column({back[0], back[1], back[2], back[3], back[4], back[5]}));
    CHECK(difference(robot.get_fMe(), fMe) < tolerance);
    CHECK(robot.getState().status == vpSimulatedArmStatus::Stopped);
  }
}

TEST_CASE("Displacements add up to the way", "[arm]")
{
  vpSimulatedArm robot(amor(), ideal());
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  vpColVector d;
  for (const auto frame : {vpRobot::CAMERA_FRAME, vpRobot::END_EFFECTOR_FRAME}) {
    robot.getDisplacement(frame, d); // begins here
    const vpHomogeneousMatrix start = frame == vpRobot::CAMERA_FRAME ? robot.get_fMc() : robot.get_fMe();
    vpHomogeneousMatrix sum;
    for (int k = 0; k < 10; ++k) {
      robot.setVelocity(vpRobot::CAMERA_FRAME, column({0.05, 0., 0.02, 0., 0.1, 0.05}));
      robot.getDisplacement(frame, d);
      sum = sum * poseOf(d);
    }
    CHECK(difference(start * sum, frame == vpRobot::CAMERA_FRAME ? robot.get_fMc() : robot.get_fMe()) < 1e-9);
    CHECK(difference(sum, vpHomogeneousMatrix()) > 0.01);
  }
  const vpJointVector q = robot.getState().q;
  robot.getDisplacement(vpRobot::JOINT_STATE, d);
  robot.setVelocity(vpRobot::JOINT_STATE, columnOf(vpJointVector::Constant(7, 0.1)));
  robot.getDisplacement(vpRobot::JOINT_STATE, d);
  CHECK((columnOf(robot.getState().q - q) - d).infinityNorm() < 1e-12);
  CHECK_THROWS_AS(robot.getDisplacement(vpRobot::MIXT_FRAME, d), vpRobotException);
}

TEST_CASE("Whatever is asked, no joint leaves its limits of position, velocity and acceleration", "[arm]")
{
  auto rng = vpTestSupport::generator(724);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel *model : {&amor(), &sixAxes()}) {
    for (const bool perfect : {true, false}) {
      vpSimulatedArmSpec spec;
      spec.drives.ideal = perfect;
      spec.indices = {vpSelfMotionIndex::manipulability(), vpSelfMotionIndex::jointLimits()};
      vpSimulatedArm robot(*model, spec);
      robot.setSamplingTime(0.005);
      robot.setMaxTranslationVelocity(3.);
      robot.setMaxRotationVelocity(6.);
      robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
      vpJointVector before = vpJointVector::Zero(model->size());
      vpColVector v(6);
      int frame = 0, blocked = 0;
      for (int k = 0; k < 6000; ++k) {
        if (k % 60 == 0) {
          frame = std::uniform_int_distribution<int>(0, 4)(rng);
          v = frame == 4 ? columnOf(3. * randomVector(model->size(), rng)) : column({0., 0., 0., 0., 0., 0.});
          for (unsigned int i = 0; frame < 4 && i < 6; ++i) {
            v[i] = uniform(rng, -1., 1.) * (i < 3 ? 1. : 3.);
          }
        }
        robot.setVelocity(frame == 4 ? vpRobot::JOINT_STATE : spaceFrames[frame], v);
        const vpSimulatedArmState s = robot.getState();
        CAPTURE(k, frame, perfect, s.command.transpose(), s.q.transpose());
        REQUIRE(s.status != vpSimulatedArmStatus::NotFollowing);
        blocked += s.solver.stoppedJoints != 0U ? 1 : 0;
        for (int i = 0; i < model->size(); ++i) {
          REQUIRE(std::fabs(s.command(i)) <= model->velocity()(i) + 1e-9);
          REQUIRE(std::fabs(s.command(i) - before(i)) <= 0.005 * model->acceleration()(i) + 1e-9);
          REQUIRE(s.wanted(i) <= model->upper()(i) + 1e-9);
          REQUIRE(s.wanted(i) >= model->lower()(i) - 1e-9);
          REQUIRE(s.q(i) <= model->upper()(i) + 1e-9);
          REQUIRE(s.q(i) >= model->lower()(i) - 1e-9);
        }
        before = s.command;
      }
      CHECK(blocked > 20); // limits were met
    }
  }
}

TEST_CASE("A stale velocity is braked, a fresh one goes on", "[arm]")
{
  vpSimulatedArmSpec spec = ideal();
  spec.watchdog = 0.1;
  vpSimulatedArm robot(amor(), spec);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  const vpColVector v = column({0.05, 0., 0., 0., 0., 0.});
  for (int k = 0; k < 10; ++k) {
    robot.setVelocity(vpRobot::CAMERA_FRAME, v);
    REQUIRE(robot.getState().status != vpSimulatedArmStatus::Stale);
  }
  robot.wait(0.09);
  CHECK(robot.getState().command.norm() > 0.01);
  robot.wait(0.3);
  CHECK(robot.getState().status == vpSimulatedArmStatus::Stale);
  CHECK(robot.getState().command.norm() == 0.);
  CHECK(robot.getSentence() == "the last velocity is too old, the arm has braked and holds");
  const vpHomogeneousMatrix there = robot.get_fMc();
  robot.wait(1.);
  CHECK(difference(there, robot.get_fMc()) == 0.);
  robot.setVelocity(vpRobot::CAMERA_FRAME, v);
  CHECK(robot.getState().status == vpSimulatedArmStatus::Moving);
  CHECK(robot.getState().command.norm() > 0.01);
  CHECK(robot.getState().time == Approx(11 * 0.04 + 1.39));
}

TEST_CASE("A stop ends, also with joints at their limits", "[arm]")
{
  auto rng = vpTestSupport::generator(724);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  std::uniform_int_distribution<int> cycles(20, 200);
  for (const vpArmModel *model : {&amor(), &sixAxes()}) {
    for (int problem = 0; problem < vpTestSupport::longer(20); ++problem) {
      vpSimulatedArmSpec spec;
      spec.drives.ideal = problem % 2 == 0;
      vpSimulatedArm robot(*model, spec);
      robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
      const bool byTwist = problem % 4 < 2;
      vpColVector v(byTwist ? 6 : static_cast<unsigned int>(model->size()));
      for (unsigned int i = 0; i < v.size(); ++i) {
        v[i] = (byTwist ? 0.3 : 1.5) * unit(rng);
      }
      for (int k = cycles(rng); k > 0; --k) {
        robot.setVelocity(byTwist ? vpRobot::CAMERA_FRAME : vpRobot::JOINT_STATE, v);
      }
      const double before = robot.getState().time;
      robot.setRobotState(vpRobot::STATE_STOP);
      CAPTURE(problem, byTwist, spec.drives.ideal);
      CHECK(robot.getState().time - before < 5.);
      CHECK(robot.getState().status == vpSimulatedArmStatus::Stopped);
      CHECK(robot.getState().command.cwiseAbs().maxCoeff() < 1e-6);
    }
  }
}

TEST_CASE("A joint that does not follow stops the arm until it is stopped", "[arm]")
{
  vpSimulatedArmSpec spec;
  spec.drives.kp = vpJointVector::Constant(7, 2.);
  spec.drives.kd = vpJointVector::Constant(7, 0.2);
  spec.followingError = 0.1;
  vpSimulatedArm robot(amor(), spec);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  const vpColVector v = column({0., 0., 0.5, 0., 0., 0., 0.});
  for (int k = 0; k < 50; ++k) {
    robot.setVelocity(vpRobot::JOINT_STATE, v);
  }
  CHECK(robot.getState().status == vpSimulatedArmStatus::NotFollowing);
  CHECK_THAT(robot.getSentence(), Catch::StartsWith("joint q3 did not follow its command (") &&
                                      Catch::EndsWith(" Nm are missing), the arm holds until it is stopped"));
  CHECK(robot.getState().command.norm() == 0.);
  CHECK_THROWS_WITH(robot.setPosition(vpRobot::JOINT_STATE, columnOf(amor().home())), Catch::Contains("joint q3"));
  robot.setRobotState(vpRobot::STATE_STOP);
  CHECK(robot.getState().status == vpSimulatedArmStatus::Stopped);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  robot.setVelocity(vpRobot::JOINT_STATE, v);
  CHECK(robot.getState().status == vpSimulatedArmStatus::Moving);
}

TEST_CASE("A blocked arm says what is in the way", "[arm]")
{
  vpSimulatedArm robot(amor(), ideal());
  robot.setMaxTranslationVelocity(0.5);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  for (int k = 0; k < 300; ++k) { // out of the workspace
    robot.setVelocity(vpRobot::REFERENCE_FRAME, column({0., 0.3, 0., 0., 0., 0.}));
  }
  CHECK(robot.getState().status == vpSimulatedArmStatus::Blocked);
  CAPTURE(robot.getSentence());
  CHECK(robot.getSentence() == robot.getState().solver.message());
  CHECK(robot.get_fMe()[1][3] < 1.11);
  for (int k = 0; k < 20; ++k) {
    robot.setVelocity(vpRobot::REFERENCE_FRAME, column({0., -0.1, 0., 0., 0., 0.}));
  }
  CHECK(robot.getState().status != vpSimulatedArmStatus::Blocked); // the way back is free
  vpColVector far(6);
  far[0] = 3.;
  CHECK_THROWS_AS(robot.setPosition(vpRobot::END_EFFECTOR_FRAME, far), vpRobotException);
}

TEST_CASE("In real time the arm moves while the program waits", "[arm]")
{
  vpSimulatedArmSpec spec = ideal();
  spec.clock = vpArmClock::RealTime;
  vpSimulatedArm robot(amor(), spec);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  const vpHomogeneousMatrix start = robot.get_fMc();
  robot.setVelocity(vpRobot::CAMERA_FRAME, column({0.05, 0., 0., 0., 0., 0.}));
  const double before = robot.getState().time;
  while (robot.getState().time < before + 0.1) { // as long as the machine takes
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK(difference(start, robot.get_fMc()) > 1e-3);
  robot.wait(1.);
  CHECK(robot.getState().status == vpSimulatedArmStatus::Stale);
  CHECK(robot.getState().command.norm() == 0.);
  robot.setPosition(vpRobot::JOINT_STATE, columnOf(amor().home()));
  CHECK((robot.getState().q - amor().home()).norm() < 1e-9);
  robot.setRobotState(vpRobot::STATE_STOP);
}

TEST_CASE("Wrong use is answered with a sentence and changes nothing", "[arm]")
{
  vpSimulatedArm robot(amor(), ideal());
  const vpJointVector q = robot.getState().q;
  const vpColVector v = column({0.1, 0., 0., 0., 0., 0.});
  CHECK_THROWS_WITH(robot.setVelocity(vpRobot::CAMERA_FRAME, v), Catch::Contains("the arm is not in velocity control"));
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  CHECK_THROWS_AS(robot.setVelocity(vpRobot::CAMERA_FRAME, column({1., 2.})), vpException);
  CHECK_THROWS_WITH(robot.setVelocity(vpRobot::CAMERA_FRAME, column({0., 0., NAN, 0., 0., 0.})),
                    Catch::Contains("component 2 of the velocity is nan"));
  CHECK_THROWS_WITH(robot.setVelocity(vpRobot::JOINT_STATE, v),
                    Catch::Contains("a vector of 6 joints was given, the arm has 7"));
  vpColVector far = columnOf(amor().home());
  far[1] = 3.;
  CHECK_THROWS_WITH(robot.setPosition(vpRobot::JOINT_STATE, far), Catch::Contains("joint q2 at 3, outside its limits"));
  CHECK_THROWS_AS(robot.setPosition(vpRobot::MIXT_FRAME, v), vpRobotException);
  CHECK_THROWS_AS(robot.setRobotState(vpRobot::STATE_FORCE_TORQUE_CONTROL), vpRobotException);
  CHECK_THROWS_WITH(robot.setPositioningVelocity(0.),
                    Catch::Contains("positioning velocity of the simulated arm is 0"));
  CHECK_THROWS_WITH(robot.wait(-1.), Catch::Contains("the time to wait is -1 s"));
  CHECK_THROWS_AS(
      robot.setSelfMotion({vpSelfMotionIndex::pointDistance(9, Eigen::Vector3d::Zero(), vpIndexSense::Repel)}),
      vpException);
  CHECK(robot.getState().q == q);

  vpSimulatedArmSpec spec = ideal();
  spec.watchdog = 0.;
  CHECK_THROWS_WITH(vpSimulatedArm(amor(), spec), Catch::Contains("watchdog of the simulated arm is 0, must be > 0"));
  spec = ideal();
  spec.start = vpJointVector::Constant(7, 2.9);
  CHECK_THROWS_WITH(vpSimulatedArm(amor(), spec), Catch::Contains("joint q2 at 2.9, outside its limits"));
  vpArmSpec unlimited = amor().spec();
  unlimited.joints[3].acceleration = std::numeric_limits<double>::infinity();
  CHECK_THROWS_WITH(vpSimulatedArm(vpArmModel(unlimited), ideal()), Catch::Contains("acceleration limit of joint q4"));
}

TEST_CASE("Position limits scale the whole motion where that was chosen, and free axes give room", "[arm]")
{
  for (const vpLimitPolicy policy : {vpLimitPolicy::StopJoints, vpLimitPolicy::ScaleMotion}) {
    vpSimulatedArmSpec spec = ideal();
    spec.redundancy.policy = policy;
    spec.free[5] = true;
    vpSimulatedArm robot(amor(), spec);
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    const vpHomogeneousMatrix start = robot.get_fMc();
    for (int k = 0; k < 25; ++k) {
      robot.setVelocity(vpRobot::CAMERA_FRAME, column({0.05, 0., 0., 0., 0., 0.}));
    }
    const vpHomogeneousMatrix done = start.inverse() * robot.get_fMc();
    // The optical axis stays parallel, whatever the turn about it.
    CHECK(done[2][2] == Approx(1.).margin(1e-4));
    CHECK(std::hypot(done[0][3], done[1][3]) == Approx(0.05).epsilon(0.1));
  }
}
