/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "liveRobot.h"

#include "appMain.h"
#include "robotPlugin.h"

#include <visp3/core/vpPoseVector.h>
#include <visp3/core/vpRxyzVector.h>
#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/robot/vpRobot.h>
#include <visp3/servoing/vpServoCalibration.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace visualServo
{
namespace
{
constexpr double OWN_LIMITS = 1.1; // the robot's own limits back up those of the servo

vpRigidTransform poseOf(const vpColVector &p, bool isEuler)
{
  if (p.size() != 6) {
    throw std::runtime_error("the robot gives a position of " + std::to_string(p.size()) + " numbers, must be 6");
  }
  const vpTranslationVector t(p[0], p[1], p[2]);
  return vpRigidTransform::fromHomogeneous(
      isEuler ? vpHomogeneousMatrix(t, vpRotationMatrix(vpRxyzVector(p[3], p[4], p[5])))
              : vpHomogeneousMatrix(t, vpThetaUVector(p[3], p[4], p[5])));
}

//! Any vpRobot: joint velocities with a model, else twists of the camera, or of the end effector with eMc.
class DrivenRobot : public Robot
{
public:
  DrivenRobot(OpenedRobot opened, const Options &options) : m_opened(std::move(opened))
  {
    if (options.hasModel()) {
      m_arm.emplace(loadModel(options));
    }
    else if (!m_opened.hasMount) {
      m_eMc = mountOf(options);
    }
    m_maxLinear = OWN_LIMITS * options.law.motion.linearVelocity;
    m_maxAngular = OWN_LIMITS * options.law.motion.angularVelocity;
  }
  ~DrivenRobot() override = default;

  void begin() override
  {
    m_opened.robot->setMaxTranslationVelocity(m_maxLinear);
    m_opened.robot->setMaxRotationVelocity(m_maxAngular);
    m_opened.robot->setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  }
  void end() override { m_opened.robot->setRobotState(vpRobot::STATE_STOP); }

  [[nodiscard]] vpServoRobotState read() override
  {
    vpServoRobotState state;
    if (m_arm) {
      m_opened.robot->getPosition(vpRobot::JOINT_STATE, m_position);
      if (static_cast<int>(m_position.size()) != m_arm->size()) {
        throw std::runtime_error("the robot has " + std::to_string(m_position.size()) + " joints, its model " +
                                 std::to_string(m_arm->size()));
      }
      state.q = Eigen::Map<const Eigen::VectorXd>(m_position.data, m_arm->size());
    }
    else if (tellsState()) {
      state.pose = pose();
    }
    return state;
  }
  void command(const vpVisualServoOutput &motion, double) override
  {
    if (m_arm) {
      m_velocity.resize(static_cast<unsigned int>(motion.velocity.size()), false);
      std::copy_n(motion.velocity.data(), motion.velocity.size(), m_velocity.data);
      m_opened.robot->setVelocity(vpRobot::JOINT_STATE, m_velocity);
      return;
    }
    motion.twist.copyTo(m_velocity);
    if (m_eMc) {
      m_opened.robot->setVelocity(vpRobot::END_EFFECTOR_FRAME, vpVelocityTwistMatrix(*m_eMc) * m_velocity);
      return;
    }
    m_opened.robot->setVelocity(vpRobot::CAMERA_FRAME, m_velocity);
  }
  [[nodiscard]] const vpArmModel *arm() const override { return m_arm ? &*m_arm : nullptr; }
  [[nodiscard]] bool tellsState() const override { return m_arm || m_opened.pose != PoseOf::Nothing; }
  // A rendered camera needs it of simulated robots in plug-ins, which must then allow two threads.
  [[nodiscard]] vpRigidTransform pose() const override
  {
    vpColVector p;
    if (m_eMc && m_opened.pose == PoseOf::Camera) {
      m_opened.robot->getPosition(vpRobot::END_EFFECTOR_FRAME, p);
      return poseOf(p, false) * vpRigidTransform::fromHomogeneous(*m_eMc);
    }
    const bool isReference = m_opened.pose == PoseOf::Reference;
    m_opened.robot->getPosition(isReference ? vpRobot::REFERENCE_FRAME : vpRobot::CAMERA_FRAME, p);
    return poseOf(p, isReference);
  }
  [[nodiscard]] std::string description() const override { return m_opened.name; }

private:
  OpenedRobot m_opened;
  std::optional<vpArmModel> m_arm;
  std::optional<vpHomogeneousMatrix> m_eMc;
  double m_maxLinear, m_maxAngular;
  vpColVector m_position, m_velocity;
};
} // namespace

std::optional<vpHomogeneousMatrix> mountOf(const Options &options)
{
  if (options.camera.isFixed) {
    return vpHomogeneousMatrix();
  }
  const std::string &file = options.motion.eMc;
  return file.empty() ? std::optional<vpHomogeneousMatrix>() : vpLoadPose(file).toHomogeneous();
}

std::unique_ptr<Robot> realRobot(const Options &options)
{
  const MotionOptions &motion = options.motion;
  const bool isAtFlange = options.camera.isFixed || !motion.eMc.empty();
  OpenedRobot opened = motion.plugin.empty()
                           ? openVispRobot(options)
                           : openPlugin(motion.plugin, motion.arguments,
                                        isAtFlange ? vpRobot::END_EFFECTOR_FRAME : vpRobot::CAMERA_FRAME);
  return std::make_unique<DrivenRobot>(std::move(opened), options);
}

std::unique_ptr<Robot> openRobot(const Options &options)
{
  if (options.isSimulated()) {
    return simulatedRobot(options);
  }
  const bool isNamed = !options.motion.plugin.empty() || options.motion.robot.robot != "none";
  return isNamed ? realRobot(options) : noRobot();
}
} // namespace visualServo
