/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "binding.h"

#include <visp3/servoing/vpReferenceTeacher.h>
#include <visp3/servoing/vpReferenceVision.h>
#include <visp3/servoing/vpVisualServo.h>

#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace visp_python
{
namespace
{
using Servo = vpVisualServo;

// A source of poses written in Python: source(image) returns cMo, or (cMo, covariance), or None.
vpServoVision::PoseSource sourceOf(const py::function &source)
{
  // Released with the interpreter's lock, by whatever thread is last.
  const std::shared_ptr<py::function> kept(new py::function(source), [](py::function *function) {
    const py::gil_scoped_acquire locked;
    delete function;
  });
  return [kept](const vpImage<unsigned char> &image, vpHomogeneousMatrix &cMo, vpPoseCovariance &covariance) {
    const py::gil_scoped_acquire locked;
    const py::object pose = (*kept)(image);
    if (pose.is_none()) {
      return false;
    }
    if (py::isinstance<py::tuple>(pose)) {
      std::tie(cMo, covariance) = pose.cast<std::pair<vpHomogeneousMatrix, vpPoseCovariance>>();
    }
    else {
      cMo = pose.cast<vpHomogeneousMatrix>();
    }
    return true;
  };
}

template <class State> vpVisualServoOutput stepOf(Servo &self, const State &state, double now)
{
  const vpVisualServoOutput output = self.step(state, now);
  raiseErrorOf(self.controller().law());
  return output;
}

void bindTiming(py::module_ &m)
{
  using Statistics = vpTimingStatistics;
  Bound<Statistics>(m, "TimingStatistics", doc("vpTimingStatistics"))
      .def("count", &Statistics::count, doc("vpTimingStatistics::count"))
      .def("invalid", &Statistics::invalid, doc("vpTimingStatistics::invalid"))
      .def("max", &Statistics::max, doc("vpTimingStatistics::max"))
      .def("quantile", &Statistics::quantile, py::arg("share"), doc("vpTimingStatistics::quantile"));
  Bound<vpServoTiming> timing(m, "ServoTiming", doc("vpServoTiming"));
  Reflect<vpServoTiming>::each(
      [&timing](const char *name, auto member, const char *text) { timing.def_readonly(name, member, text); });
}

void bindSettings(py::module_ &m)
{
  bindEnum<vpServoCameraPlace>(m);
  bindEnum<vpVisualServoStatus>(m);
  bindSpec<vpReferencePoseSpec>(m);
  bindSpec<vpReferenceVisionSpec>(m);
  bindSpec<vpVisualServoSpec>(m);
  bindStruct<vpServoRobotState>(m);
  bindStruct<vpServoSight>(m);
  bindStruct<vpVisualServoOutput>(m).def_property_readonly(
      "message", [](const vpVisualServoOutput &self) { return self.message; }, doc("vpVisualServoOutput::message"));
}

void bindTeacher(py::module_ &m)
{
  using Teacher = vpReferenceTeacher;
  const std::string in = "vpReferenceTeacher::";
  bindClass<Teacher>(m)
      .def(py::init<unsigned int, double>(), py::arg("images") = 25, py::arg("motion") = 0.5,
           doc(in + "vpReferenceTeacher"))
      .def("add", &Teacher::add, py::arg("image"), Unlocked(), doc(in + "add"))
      .def("isComplete", &Teacher::isComplete, doc(in + "isComplete"))
      .def(
          "image", [](const Teacher &self) -> vpImage<unsigned char> { return self.image(); }, doc(in + "image"))
      .def("pointNoise", &Teacher::pointNoise, doc(in + "pointNoise"))
      .def("averageNoise", &Teacher::averageNoise, doc(in + "averageNoise"))
      .def("message", &Teacher::message, doc(in + "message"));
}

void bindVisualServo(py::module_ &m)
{
  const std::string in = "vpVisualServo::";
  constexpr auto copy = py::return_value_policy::copy;
  bindClass<Servo>(m)
      .def(py::init([](const std::string &controller, const vpServoControllerSpec &parameters,
                       const vpVisualServoSpec &spec, const vpArmModel *arm) {
             return std::make_unique<Servo>(vpServoController::create(controller, parameters), spec, arm);
           }),
           py::arg("controller"), py::arg("controllerSpec") = vpServoControllerSpec(),
           py::arg("spec") = vpVisualServoSpec(), py::arg("arm") = py::none(), py::keep_alive<1, 5>(),
           "controller: id for ServoController.create(), with controllerSpec as its parameters. spec: the other ones. "
           "arm: the\n"
           "ArmModel; None: the output is a twist.")
      .def(
          "setPhotograph",
          [](Servo &self, const vpImage<unsigned char> &photo, double width, double height,
             const vpCameraParameters &camera, const vpPlanarTargetSpec &spec) {
            self.setVision(vpServoVision::photograph(photo, width, height, camera, spec));
          },
          py::arg("photo"), py::arg("width"), py::arg("height"), py::arg("camera"),
          py::arg("spec") = vpPlanarTargetSpec(), doc("vpServoVision::photograph"))
      .def(
          "setReference",
          [](Servo &self, const vpImage<unsigned char> &reference, const vpCameraParameters &camera,
             const vpReferenceVisionSpec &spec) {
            self.setVision(std::make_unique<vpReferenceVision>(reference, camera, spec));
          },
          py::arg("reference"), py::arg("camera"), py::arg("spec") = vpReferenceVisionSpec(),
          doc("vpReferenceVision::vpReferenceVision"))
      .def(
          "setTag",
          [](Servo &self, const std::string &family, int id, double size, const vpCameraParameters &camera,
             double cornerSigma) { self.setVision(vpServoVision::tag(family, id, size, camera, cornerSigma)); },
          py::arg("family"), py::arg("id"), py::arg("size"), py::arg("camera"), py::arg("cornerSigma") = 0.3,
          doc("vpServoVision::tag"))
      .def(
          "setPoseSource",
          [](Servo &self, const py::function &source, const vpServoTarget &target) {
            self.setVision(vpServoVision::poses(sourceOf(source), target));
          },
          py::arg("source"), py::arg("target"),
          "Vision by any source of poses: source(image) returns the pose cMo of the object, or (cMo, PoseCovariance), "
          "or None\n"
          "when it was not found. target: points of the object, a ServoTarget.")
      .def(
          "visionMessage", [](const Servo &self) { return self.vision().message(); }, doc("vpServoVision::message"))
      .def("supervise", &Servo::supervise, py::arg("scene"), py::arg("spec") = vpStopSupervisorSpec(),
           py::keep_alive<1, 2>(), doc(in + "supervise"))
      .def(
          "goal", [](const Servo &self, const vpHomogeneousMatrix &cdMo) { return self.vision().goal(cdMo); },
          py::arg("cdMo"), doc("vpServoVision::goal"))
      .def("setGoal", &Servo::setGoal, py::arg("goal"), doc(in + "setGoal"))
      .def(
          "see",
          [](Servo &self, const vpImage<unsigned char> &image, double captureTime) {
            return self.see(image, captureTime);
          },
          py::arg("image"), py::arg("captureTime"), Unlocked(), doc(in + "see"))
      .def(
          "take", [](Servo &self, const vpServoSight &sight) { self.see(sight); }, py::arg("sight"),
          "The result of another vision system, instead of an image. Vision thread.")
      .def(
          "cameraAt",
          [](const Servo &self, double time) -> std::optional<vpRigidTransform> {
            vpRigidTransform pose;
            return self.cameraAt(time, pose) ? std::optional<vpRigidTransform>(pose) : std::nullopt;
          },
          py::arg("time"),
          "Pose of the camera at a time in the frame in which the object is at rest; None if it is not known.")
      .def("start", &Servo::start, doc(in + "start"))
      .def("stop", &Servo::stop, doc(in + "stop"))
      .def("step", &stepOf<vpServoRobotState>, py::arg("state"), py::arg("now"), doc(in + "step"))
      .def("step", &stepOf<vpJointVector>, py::arg("q"), py::arg("now"),
           "As step() with a state of these joint positions.")
      .def("output", &Servo::output, copy, doc(in + "output"))
      .def("isConverged", &Servo::isConverged, doc(in + "isConverged"))
      .def("measurement", &Servo::measurement, copy, doc(in + "measurement"))
      .def("timing", &Servo::timing, py::return_value_policy::reference_internal, doc(in + "timing"))
      .def("spec", &Servo::spec, copy, doc(in + "spec"));
}
} // namespace

void bindServoing(py::module_ &m)
{
  bindTiming(m);
  bindSettings(m);
  bindTeacher(m);
  bindVisualServo(m);
}
} // namespace visp_python
