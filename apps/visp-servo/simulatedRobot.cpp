/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "liveRobot.h"

#include "appMain.h"
#include "robot.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/servoing/vpServoCalibration.h>
#include <visp3/simulation/vpFrictionCamera.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <algorithm>
#include <mutex>
#include <stdexcept>

namespace visualServo
{
namespace
{
//! The camera stands, or somebody carries it.
class NoRobot : public Robot
{
public:
  [[nodiscard]] vpServoRobotState read() override { return {}; }
  void command(const vpVisualServoOutput &, double) override {}
  [[nodiscard]] std::string description() const override { return "no robot"; }
};

//! A camera, or a target before a fixed one, that flies freely.
class FlyingCamera : public Robot
{
public:
  explicit FlyingCamera(bool isFixed) : m_isFixed(isFixed) { m_camera.setRobotState(vpRobot::STATE_VELOCITY_CONTROL); }
  [[nodiscard]] vpServoRobotState read() override
  {
    vpServoRobotState state;
    state.pose = pose();
    return state;
  }
  void command(const vpVisualServoOutput &motion, double period) override
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_camera.setSamplingTime(period);
    m_camera.setVelocity(vpRobot::CAMERA_FRAME, motion.twist.toColVector());
  }
  [[nodiscard]] vpRigidTransform pose() const override
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return vpRigidTransform::fromHomogeneous(m_camera.getPosition());
  }
  [[nodiscard]] std::string description() const override
  {
    return std::string("a simulated ") + (m_isFixed ? "target" : "camera") + " that flies freely";
  }

private:
  bool m_isFixed;
  mutable std::mutex m_mutex;
  vpFrictionCamera m_camera; // without lag and friction
};

class SimulatedArm : public Robot
{
public:
  SimulatedArm(const vpArmModel &model, const Options &options)
    : m_arm(model, specOf(options)), m_isFixed(options.camera.isFixed)
  {}
  void begin() override { m_arm.setRobotState(vpRobot::STATE_VELOCITY_CONTROL); }
  void end() override { m_arm.setRobotState(vpRobot::STATE_STOP); }
  [[nodiscard]] vpServoRobotState read() override
  {
    vpServoRobotState state;
    state.q = m_arm.getState().q;
    return state;
  }
  void command(const vpVisualServoOutput &motion, double period) override
  {
    m_velocity.resize(static_cast<unsigned int>(motion.velocity.size()), false);
    std::copy_n(motion.velocity.data(), motion.velocity.size(), m_velocity.data);
    m_arm.setSamplingTime(period);
    m_arm.setVelocity(vpRobot::JOINT_STATE, m_velocity);
  }
  [[nodiscard]] const vpArmModel *arm() const override { return &m_arm.getModel(); }
  [[nodiscard]] vpRigidTransform pose() const override
  {
    return vpRigidTransform::fromHomogeneous(m_isFixed ? m_arm.get_fMe() : m_arm.get_fMc());
  }
  [[nodiscard]] std::string description() const override
  {
    return "the simulated arm " + m_arm.getModel().spec().name + " of " + std::to_string(m_arm.getModel().size()) +
           " joints";
  }

private:
  static vpSimulatedArmSpec specOf(const Options &options)
  {
    vpSimulatedArmSpec spec;
    spec.redundancy.period = std::min(spec.redundancy.period, options.servo.period);
    spec.clock = options.realTime ? vpArmClock::RealTime : vpArmClock::Stepped;
    return spec;
  }
  vpSimulatedArm m_arm;
  bool m_isFixed;
  vpColVector m_velocity;
};

//! The arm, with covers among obstacles, and what was assumed of it.
std::pair<vpArmModel, std::vector<std::string>> loadFor(const MotionOptions &options)
{
  if (!options.scene.empty()) {
    const vpApp::Robot robot = vpApp::loadUsableRobot(options.robot);
    return {*robot.arm, robot.warnings};
  }
  const vpArmModel model = vpApp::loadArm(options.robot);
  return {model, model.spec().warnings};
}
} // namespace

std::unique_ptr<Robot> noRobot() { return std::make_unique<NoRobot>(); }

std::unique_ptr<Robot> simulatedRobot(const Options &options)
{
  if (options.motion.robot.robot == "camera") {
    if (!options.motion.eMc.empty()) {
      throw vpApp::UsageError("--eMc is for a camera on an arm, the robot is a camera that flies freely");
    }
    return std::make_unique<FlyingCamera>(options.camera.isFixed);
  }
  return std::make_unique<SimulatedArm>(loadModel(options), options);
}

std::unique_ptr<const vpCollisionScene> loadObstacles(const MotionOptions &options, const Robot &robot)
{
  if (options.scene.empty()) {
    return nullptr;
  }
  vpCollisionSceneFile file = vpLoadCollisionScene(options.scene);
  vpApp::printWarnings("visp-servo", file.warnings);
  const std::vector<std::string> &ignored = options.robot.ignored;
  file.spec.ignoredBodies.insert(file.spec.ignoredBodies.end(), ignored.begin(), ignored.end());
  return std::make_unique<vpCollisionScene>(*robot.arm(), file.spec);
}

vpArmModel loadModel(const Options &options)
{
  auto [model, warnings] = loadFor(options.motion);
  const std::string missing = vpApp::missingLimitSentence(model);
  if (!missing.empty()) {
    throw std::runtime_error(missing);
  }
  if (!options.motion.eMc.empty()) {
    vpArmSpec spec = model.spec();
    spec.camera = vpLoadPose(options.motion.eMc);
    spec.cameraLink = -1; // the file is of the camera in the end effector
    model = vpArmModel(spec);
  }
  const bool isTool = options.camera.isFixed;
  vpApp::warnOfJointsBehind(model, isTool ? "end effector" : "camera", isTool ? model.toolLink() : model.cameraLink(),
                            warnings);
  vpApp::printWarnings("visp-servo", warnings);
  return model;
}
} // namespace visualServo
