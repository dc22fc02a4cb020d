/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The arm in real time, called from several threads. Under the thread sanitizer these tests also show that there are no
// races.
#include "vpArmsOfTests.h"
#include "vpCatch.h"

#include <visp3/robot/vpRobotException.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <atomic>
#include <chrono>
#include <thread>

using namespace vpArmsOfTests;

namespace
{
vpSimulatedArmSpec realTime()
{
  vpSimulatedArmSpec spec;
  spec.drives.ideal = true;
  spec.clock = vpArmClock::RealTime;
  return spec;
}

vpColVector along(double v)
{
  vpColVector twist(6);
  twist[0] = v;
  return twist;
}

vpColVector columnOf(const vpJointVector &joints)
{
  vpColVector q(static_cast<unsigned int>(joints.size()));
  for (unsigned int i = 0; i < q.size(); ++i) {
    q[i] = joints(i);
  }
  return q;
}
} // namespace

TEST_CASE("A velocity that loses the race against a stop does not move the arm any more", "[threads]")
{
  vpSimulatedArm robot(amor(), realTime());
  std::atomic<bool> end{false};
  std::atomic<long> taken{0};
  std::thread commander([&] {
    for (double v = 0.05; !end; v = -v) {
      try {
        robot.setVelocity(vpRobot::CAMERA_FRAME, along(v));
        ++taken;
      }
      catch (const vpRobotException &) { // stopped
      }
    }
  });
  for (int k = 0; k < 20; ++k) {
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    const long before = taken;
    while (taken < before + 3) {
      std::this_thread::yield();
    }
    robot.setRobotState(vpRobot::STATE_STOP);
    const long moved = taken;
    robot.wait(0.05); // brakes: the commander continues to command
    CHECK(robot.getState().command.norm() == 0.);
    CHECK(taken <= moved + 1); // the one that was taken just before the stop
  }
  end = true;
  commander.join();
}

TEST_CASE("A stop, a state or a goal of another thread ends a motion that is waited for", "[threads]")
{
  vpSimulatedArm robot(amor(), realTime());
  robot.setPositioningVelocity(5.);
  vpJointVector far = amor().home();
  far(0) += 2.;
  for (int other = 0; other < 3; ++other) {
    std::string answer;
    std::thread waiting([&] {
      try {
        robot.setPosition(vpRobot::JOINT_STATE, columnOf(far));
        answer = "arrived";
      }
      catch (const vpRobotException &e) {
        answer = e.getMessage();
      }
    });
    while (robot.getState().command.norm() == 0.) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (other == 0) {
      robot.setRobotState(vpRobot::STATE_STOP);
    }
    else if (other == 1) {
      robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
    }
    else {
      robot.setPosition(vpRobot::JOINT_STATE, columnOf(robot.getState().wanted));
    }
    waiting.join();
    CHECK(answer == "another call ended the motion before its goal");
    robot.setRobotState(vpRobot::STATE_STOP);
    robot.wait(0.5);
    CHECK(robot.getState().command.norm() == 0.);
  }
}

TEST_CASE("All functions may be called at once", "[threads]")
{
  vpSimulatedArm robot(amor(), realTime());
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  std::atomic<bool> end{false};
  std::atomic<long> calls{0};
  const auto loop = [&](const std::function<void()> &call) {
    return std::thread([&end, &calls, call] {
      while (!end) {
        try {
          call();
        }
        catch (const vpException &) { // not in this state
        }
        ++calls;
      }
    });
  };
  std::vector<std::thread> threads;
  threads.push_back(loop([&] { robot.setVelocity(vpRobot::CAMERA_FRAME, along(0.02)); }));
  threads.push_back(loop([&] { robot.setVelocity(vpRobot::JOINT_STATE, columnOf(vpJointVector::Constant(7, 0.01))); }));
  threads.push_back(loop([&] {
    vpColVector q;
    vpMatrix J;
    robot.getPosition(vpRobot::CAMERA_FRAME, q);
    robot.getDisplacement(vpRobot::JOINT_STATE, q);
    robot.getVelocity(vpRobot::REFERENCE_FRAME, q);
    robot.get_eJe(J);
    robot.get_fJe(J);
    static_cast<void>(robot.get_fMc());
    static_cast<void>(robot.get_cMe());
    static_cast<void>(robot.getState());
    static_cast<void>(robot.getSentence());
    static_cast<void>(robot.getRobotState());
  }));
  threads.push_back(loop([&] {
    robot.setSelfMotion({vpSelfMotionIndex::jointLimits()});
    robot.setSamplingTime(0.03);
    robot.setPositioningVelocity(20.);
  }));
  threads.push_back(loop([&] {
    robot.setPosition(vpRobot::JOINT_STATE, columnOf(amor().home()));
    robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  }));
  robot.wait(0.5);
  robot.setRobotState(vpRobot::STATE_STOP);
  end = true;
  for (std::thread &thread : threads) {
    thread.join();
  }
  CHECK(calls > 50);
  CHECK(robot.getState().q.allFinite());
}
