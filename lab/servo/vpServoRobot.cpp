/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoRobot.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/simulation/vpFrictionCamera.h>

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
class FreeCamera : public vpServoRobot
{
public:
  explicit FreeCamera(const vpServoPlant &plant) : m_robot(plant), m_velocity(6)
  {
    m_robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  }
  void move(const vpTwist &twist) VP_OVERRIDE
  {
    twist.copyTo(m_velocity);
    m_robot.setVelocity(vpRobot::CAMERA_FRAME, m_velocity);
  }
  vpHomogeneousMatrix wMc() VP_OVERRIDE { return m_robot.getPosition(); }
  vpTwist actual() const VP_OVERRIDE { return m_robot.actualTwist(); }

private:
  vpFrictionCamera m_robot;
  vpColVector m_velocity;
};

class ArmWithCamera : public vpServoRobot
{
public:
  ArmWithCamera(const vpServoArm &arm, const vpServoPlant &plant)
    : m_robot(arm.model, arm.forPlant(plant)), m_cycle(1. / plant.loopRate), m_velocity(6),
      m_start(m_robot.get_fMc().inverse()), m_measured(measuredPose())
  {
    m_robot.setSamplingTime(m_cycle);
    m_robot.setMaxTranslationVelocity(plant.maxLinear);
    m_robot.setMaxRotationVelocity(plant.maxAngular);
    m_robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  }
  void move(const vpTwist &twist) VP_OVERRIDE
  {
    twist.copyTo(m_velocity);
    m_robot.setVelocity(vpRobot::CAMERA_FRAME, m_velocity);
    const vpHomogeneousMatrix now = measuredPose();
    m_actual = vpTwist::fromColVector(vpExponentialMap::inverse(m_measured.inverse() * now, m_cycle));
    m_measured = now;
  }
  vpHomogeneousMatrix wMc() VP_OVERRIDE { return m_start * m_robot.get_fMc(); }
  vpTwist actual() const VP_OVERRIDE { return m_actual; }
  bool sample(vpArmSample &s) const VP_OVERRIDE
  {
    const vpSimulatedArmState state = m_robot.getState();
    const vpArmModel &model = m_robot.getModel();
    s.q = state.q;
    s.velocity = state.velocity;
    s.wanted = state.wanted;
    s.command = state.command;
    s.torque = state.torque;
    s.limitMargin = std::min((state.q - model.lower()).minCoeff(), (model.upper() - state.q).minCoeff());
    vpArmData data;
    vpIndexValue index;
    vpArmKinematics::update(model, state.q, data);
    static_cast<void>(vpEvaluateIndex(model, data, vpSelfMotionIndex::manipulability(), index));
    s.manipulability = index.value;
    s.selfMotion = state.solver.selfMotion.norm();
    s.stoppedJoints = state.solver.stoppedJoints;
    s.status = state.status;
    s.solver = state.solver.status;
    return true;
  }

private:
  vpHomogeneousMatrix measuredPose()
  {
    vpColVector pose;
    m_robot.getPosition(vpRobot::CAMERA_FRAME, pose);
    return vpHomogeneousMatrix(pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]);
  }

  vpSimulatedArm m_robot;
  double m_cycle;
  vpColVector m_velocity;
  vpHomogeneousMatrix m_start, m_measured;
  vpTwist m_actual;
};
} // namespace

std::unique_ptr<vpServoRobot> vpServoRobot::create(const vpServoRunSpec &spec)
{
  if (spec.arm) {
    return std::make_unique<ArmWithCamera>(*spec.arm, spec.plant);
  }
  return std::make_unique<FreeCamera>(spec.plant);
}

END_VISP_NAMESPACE
