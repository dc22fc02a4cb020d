/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Joint control and drives, and robots, stage and vision in simulation.
#include "binding.h"

#include <visp3/manipulator/vpJointPositionControl.h>
#include <visp3/manipulator/vpJointVelocityControl.h>
#include <visp3/manipulator/vpJointVelocityEstimator.h>
#include <visp3/simulation/vpArmDrives.h>
#include <visp3/simulation/vpFrictionCamera.h>
#include <visp3/simulation/vpSimulatedArm.h>
#include <visp3/simulation/vpVisionChannel.h>
#include <visp3/simulation/vpXYStage.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace visp_python
{
namespace
{
constexpr auto copy = py::return_value_policy::copy;
using Frame = vpRobot::vpControlFrameType;

template <class Control, class Spec> Bound<Control> bindJointControl(py::module_ &m)
{
  const std::string name = std::string("vp") + Reflect<Control>::name;
  bindSpec<Spec>(m);
  bindStruct<typename Control::Input>(m);
  bindStruct<typename Control::Output>(m);
  return bindClass<Control>(m)
      .def(py::init<const Spec &>(), py::arg("spec"), doc(name + "::" + name))
      .def(
          "step",
          [](Control &self, const typename Control::Input &input) {
            typename Control::Output output;
            self.step(input, output);
            return output;
          },
          py::arg("input"), doc(name + "::step"));
}

void bindJoints(py::module_ &m)
{
  using Friction = vpJointFriction;
  using Estimator = vpJointVelocityEstimator;
  bindSpec<Friction>(m, py::arg("size"))
      .def_static("of", &Friction::of, py::arg("model"), doc("vpJointFriction::of"))
      .def(
          "torque",
          [](const Friction &self, const vpJointVector &velocity) {
            self.validate(static_cast<int>(velocity.size()));
            vpJointVector torque;
            if (!self.torque(velocity, torque)) {
              throw py::value_error("velocity has a number that is not finite or beyond 1e+09");
            }
            return torque;
          },
          py::arg("velocity"), "Friction at these velocities, Nm or N.");
  bindJointControl<vpJointPositionControl, vpJointPositionControlSpec>(m);
  bindJointControl<vpJointVelocityControl, vpJointVelocityControlSpec>(m)
      .def("reset", &vpJointVelocityControl::reset, doc("vpJointVelocityControl::reset"))
      .def("integral", &vpJointVelocityControl::integral, copy, doc("vpJointVelocityControl::integral"));
  const std::string in = "vpJointVelocityEstimator::";
  bindClass<Estimator>(m)
      .def(py::init<int, double, double>(), py::arg("size"), py::arg("period"), py::arg("bandwidth"),
           doc(in + "vpJointVelocityEstimator"))
      .def("reset", &Estimator::reset, doc(in + "reset"))
      .def("step", &Estimator::step, py::arg("q"), py::arg("acceleration") = vpJointVector(), copy, doc(in + "step"))
      .def("velocity", &Estimator::velocity, copy, doc(in + "velocity"))
      .def("measured", &Estimator::measured, doc(in + "measured"))
      .def("position", &Estimator::position, copy, doc(in + "position"));
}

void bindDrives(py::module_ &m)
{
  using Plant = vpArmPlant;
  using Drives = vpArmDrives;
  std::string in = "vpArmPlant::";
  bindClass<Plant>(m)
      .def(py::init<const vpArmModel &, double>(), py::arg("model"), py::arg("frictionScale") = 1.,
           py::keep_alive<1, 2>(), doc(in + "vpArmPlant"))
      .def("reset", &Plant::reset, py::arg("q"), doc(in + "reset"))
      .def("step", &Plant::step, py::arg("torque"), py::arg("dt"), doc(in + "step"))
      .def("q", &Plant::q, copy, doc(in + "q"))
      .def("velocity", &Plant::velocity, copy, doc(in + "velocity"))
      .def("friction", &Plant::friction, copy, doc(in + "friction"));
  in = "vpArmDrives::";
  bindEnum<vpDriveReference>(m);
  bindSpec<vpArmDriveSpec>(m, py::arg("model"));
  bindStruct<vpJointShortfall>(m)
      .def("missing", &vpJointShortfall::missing, doc("vpJointShortfall::missing"))
      .def("message", &vpJointShortfall::message, py::arg("model"), doc("vpJointShortfall::message"));
  auto drives = bindClass<Drives>(m);
  drives
      .def(py::init<const vpArmModel &, const vpArmDriveSpec &>(), py::arg("model"), py::arg("spec") = vpArmDriveSpec(),
           py::keep_alive<1, 2>(), Unlocked(), doc(in + "vpArmDrives"))
      .def("reset", &Drives::reset, py::arg("q"), doc(in + "reset"))
      .def("move", &Drives::move, py::arg("velocity"), py::arg("duration"), Unlocked(), doc(in + "move"))
      .def("holdHere", &Drives::holdHere, doc(in + "holdHere"))
      .def("setReference", &Drives::setReference, py::arg("reference"), doc(in + "setReference"))
      .def("saturated", &Drives::saturated, doc(in + "saturated"))
      .def("spec", &Drives::spec, copy, doc(in + "spec"));
  using Joints = const vpJointVector &(Drives::*)() const;
  for (const auto &[name, joints] :
       std::initializer_list<std::pair<const char *, Joints>>{{"measured", &Drives::measured},
                                                              {"q", &Drives::q},
                                                              {"velocity", &Drives::velocity},
                                                              {"wanted", &Drives::wanted},
                                                              {"command", &Drives::command},
                                                              {"torque", &Drives::torque},
                                                              {"needed", &Drives::needed}}) {
    drives.def(name, joints, copy, doc(in + name));
  }
}

vpColVector column(const Eigen::VectorXd &given)
{
  vpColVector v(static_cast<unsigned int>(given.size()));
  std::copy_n(given.data(), given.size(), v.data);
  return v;
}

py::array arrayOf(const vpColVector &v) { return newArray(v.size(), v.data); }
py::array arrayOf(const vpArray2D<double> &M) { return newArray(M.getRows(), M.getCols(), M.data); }

double positive(const char *name, double value)
{
  if (!(value > 0.) || !std::isfinite(value)) {
    throw py::value_error(std::string(name) + " is " + std::to_string(value) + ", must be > 0 and finite");
  }
  return value;
}

// ViSP's names, also as Robot.CAMERA_FRAME.
template <class E>
void bindNames(py::module_ &m, py::object robot, const char *name, const char *text,
               std::initializer_list<std::pair<const char *, E>> values)
{
  py::enum_<E> bound(m, name, text);
  for (const auto &[key, value] : values) {
    bound.value(key, value);
    robot.attr(key) = value;
  }
  closeEnum(bound);
}

void bindRobot(py::module_ &m)
{
  using Robot = vpRobotSimulator;
  Bound<Robot> robot(m, "Robot", "What simulated robots have in common with ViSP's robots.");
  bindNames<Frame>(m, robot, "ControlFrameType", "Frames of velocities and positions.",
                   {{"JOINT_STATE", vpRobot::JOINT_STATE},
                    {"END_EFFECTOR_FRAME", vpRobot::END_EFFECTOR_FRAME},
                    {"CAMERA_FRAME", vpRobot::CAMERA_FRAME},
                    {"REFERENCE_FRAME", vpRobot::REFERENCE_FRAME},
                    {"MIXT_FRAME", vpRobot::MIXT_FRAME}});
  bindNames<vpRobot::vpRobotStateType>(m, robot, "RobotStateType", "States of the control of a robot.",
                                       {{"STATE_STOP", vpRobot::STATE_STOP},
                                        {"STATE_VELOCITY_CONTROL", vpRobot::STATE_VELOCITY_CONTROL},
                                        {"STATE_POSITION_CONTROL", vpRobot::STATE_POSITION_CONTROL}});
  robot.def("setRobotState", &Robot::setRobotState, py::arg("state"), Unlocked(), doc("vpSimulatedArm::setRobotState"))
      .def("getRobotState", &Robot::getRobotState, doc("vpSimulatedArm::getRobotState"))
      .def(
          "setVelocity", [](Robot &self, Frame frame, const Eigen::VectorXd &v) { self.setVelocity(frame, column(v)); },
          py::arg("frame"), py::arg("v"), Unlocked(),
          "Moves for the sampling time. frame: of FrictionCamera the camera's. v: 6 numbers (one a joint for "
          "JOINT_STATE), m/s\nand rad/s.")
      .def(
          "setSamplingTime", [](Robot &self, double seconds) { self.setSamplingTime(positive("seconds", seconds)); },
          py::arg("seconds"), "Sets how long a velocity command acts, s, > 0.")
      .def("getSamplingTime", &Robot::getSamplingTime, "Time for which a velocity command acts, s.")
      .def(
          "setMaxTranslationVelocity",
          [](Robot &self, double speed) { self.setMaxTranslationVelocity(positive("speed", speed)); }, py::arg("speed"),
          "Sets the largest linear velocity, m/s, > 0.")
      .def(
          "setMaxRotationVelocity",
          [](Robot &self, double speed) { self.setMaxRotationVelocity(positive("speed", speed)); }, py::arg("speed"),
          "Sets the largest angular velocity, rad/s, > 0.")
      .def("getMaxTranslationVelocity", &Robot::getMaxTranslationVelocity, "The largest linear velocity, m/s.")
      .def("getMaxRotationVelocity", &Robot::getMaxRotationVelocity, "The largest angular velocity, rad/s.");

  using Camera = vpFrictionCamera;
  bindSpec<vpServoPlant>(m).def_static("byName", &vpServoPlant::byName, py::arg("name"), doc("vpServoPlant::byName"));
  Bound<Camera, Robot>(m, "FrictionCamera", doc("vpFrictionCamera"))
      .def(py::init<const vpServoPlant &>(), py::arg("plant") = vpServoPlant(),
           doc("vpFrictionCamera::vpFrictionCamera"))
      .def(
          "getPosition", [](const Camera &self) { return self.getPosition(); }, "wMc: the camera in the world.")
      .def(
          "setPosition", [](Camera &self, const vpHomogeneousMatrix &wMc) { self.setPosition(wMc); }, py::arg("wMc"),
          "Puts the camera there. wMc: the camera in the world.")
      .def("actualTwist", &Camera::actualTwist, copy, doc("vpFrictionCamera::actualTwist"));
}

template <void (vpSimulatedArm::*Get)(Frame, vpColVector &)> py::array vectorOf(vpSimulatedArm &self, Frame frame)
{
  vpColVector v;
  {
    const py::gil_scoped_release unlocked;
    (self.*Get)(frame, v);
  }
  return arrayOf(v);
}

template <void (vpSimulatedArm::*Get)(vpMatrix &)> py::array matrixOf(vpSimulatedArm &self)
{
  vpMatrix M;
  (self.*Get)(M);
  return arrayOf(M);
}

void bindSimulatedArm(py::module_ &m)
{
  using Arm = vpSimulatedArm;
  const std::string in = "vpSimulatedArm::";
  bindEnum<vpArmClock>(m);
  bindEnum<vpSimulatedArmStatus>(m);
  bindSpec<vpSimulatedArmSpec>(m, py::arg("model"));
  bindStruct<vpSimulatedArmState>(m);
  Bound<Arm, vpRobotSimulator>(m, "SimulatedArm", doc("vpSimulatedArm"))
      .def(py::init<const vpArmModel &, const vpSimulatedArmSpec &>(), py::arg("model"),
           py::arg("spec") = vpSimulatedArmSpec(), Unlocked(), doc(in + "vpSimulatedArm"))
      .def(
          "setPosition", [](Arm &self, Frame frame, const Eigen::VectorXd &q) { self.setPosition(frame, column(q)); },
          py::arg("frame"), py::arg("q"), Unlocked(), doc(in + "setPosition"))
      .def("getPosition", &vectorOf<&Arm::getPosition>, py::arg("frame"), doc(in + "getPosition"))
      .def("getVelocity", &vectorOf<&Arm::getVelocity>, py::arg("frame"), doc(in + "getVelocity"))
      .def("getDisplacement", &vectorOf<&Arm::getDisplacement>, py::arg("frame"), doc(in + "getDisplacement"))
      .def("get_eJe", &matrixOf<&Arm::get_eJe>, doc(in + "get_eJe"))
      .def("get_fJe", &matrixOf<&Arm::get_fJe>, doc(in + "get_fJe"))
      .def("get_cMe", &Arm::get_cMe, doc(in + "get_cMe"))
      .def(
          "get_cVe", [](const Arm &self) { return arrayOf(self.get_cVe()); }, doc(in + "get_cVe"))
      .def("get_fMc", &Arm::get_fMc, doc(in + "get_fMc"))
      .def("get_fMe", &Arm::get_fMe, doc(in + "get_fMe"))
      .def("setSelfMotion", &Arm::setSelfMotion, py::arg("indices"), py::arg("free") = std::array<bool, 6>{},
           doc(in + "setSelfMotion"))
      .def("setPositioningVelocity", &Arm::setPositioningVelocity, py::arg("percent"),
           doc(in + "setPositioningVelocity"))
      .def("wait", &Arm::wait, py::arg("duration"), Unlocked(), doc(in + "wait"))
      .def("getState", &Arm::getState, Unlocked(), doc(in + "getState"))
      .def("getSentence", &Arm::getSentence, doc(in + "getSentence"))
      .def("getModel", &Arm::getModel, py::return_value_policy::reference_internal, doc(in + "getModel"));
}

void bindStage(py::module_ &m)
{
  using Stage = vpXYStage;
  bindStruct<vpXYStageAxis>(m).def("friction", &vpXYStageAxis::friction, py::arg("velocity"), py::arg("position"),
                                   doc("vpXYStageAxis::friction"));
  bindSpec<vpXYStageSpec>(m).def_static("thesis", &vpXYStageSpec::thesis, doc("vpXYStageSpec::thesis"));
  bindStruct<Stage::State>(m);
  bindClass<Stage>(m)
      .def(py::init<const vpXYStageSpec &>(), py::arg("spec"), doc("vpXYStage::vpXYStage"))
      .def("step", &Stage::step, py::arg("dt"), py::arg("command"), copy, Unlocked(), doc("vpXYStage::step"))
      .def("state", &Stage::state, copy, doc("vpXYStage::state"))
      .def("spec", &Stage::spec, copy, doc("vpXYStage::spec"))
      .def("reset", &Stage::reset, py::arg("position") = Stage::Pair{{0., 0.}}, doc("vpXYStage::reset"));

  using Channel = vpVisionChannel;
  bindClass<Channel>(m)
      .def(py::init<double, double>(), py::arg("frameRate"), py::arg("latency"),
           doc("vpVisionChannel::vpVisionChannel"))
      .def("due", &Channel::due, py::arg("now"), doc("vpVisionChannel::due"))
      .def(
          "push",
          [](Channel &self, const vpServoMeasurement &measurement) {
            if (!std::isfinite(measurement.time)) {
              throw py::value_error("the time of the measurement is not finite");
            }
            self.push(measurement);
          },
          py::arg("measurement"), doc("vpVisionChannel::push"))
      .def(
          "pop",
          [](Channel &self, double now) -> std::optional<vpServoMeasurement> {
            vpServoMeasurement result;
            return self.pop(now, result) ? std::optional<vpServoMeasurement>(result) : std::nullopt;
          },
          py::arg("now"), "Takes the oldest result that has arrived by time now, s; None if there is none.");
}
} // namespace

void bindSimulation(py::module_ &m)
{
  bindJoints(m);
  bindDrives(m);
  bindRobot(m);
  bindSimulatedArm(m);
  bindStage(m);
}
} // namespace visp_python
