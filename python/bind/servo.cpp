/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "binding.h"

#include <visp3/feedforward/vpOdometryBridge.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/servoing/vpServoTarget.h>

#include <exception>
#include <utility>

namespace visp_python
{
namespace
{
// A law written in Python: compute(measurement, dt) returns a twist or a ServoCommand. The step of a law does not throw, so
// an exception of compute() is kept, the twist is zero, and the binding of step() raises it.
class PythonLaw : public vpServoLaw
{
public:
  PythonLaw(const std::string &id, const vpServoGains &gains) : vpServoLaw(id, gains) {}

  void raise()
  {
    if (m_error) {
      std::rethrow_exception(std::exchange(m_error, nullptr));
    }
  }

protected:
  vpServoCommand compute(const vpServoMeasurement &measurement, double dt) noexcept override
  {
    const py::gil_scoped_acquire locked;
    try {
      const py::function written = py::get_override(static_cast<const vpServoLaw *>(this), "compute");
      if (!written) {
        throw py::type_error("the law " + m_id + " has no method compute(measurement, dt)");
      }
      return command(written(py::cast(measurement, py::return_value_policy::copy), dt));
    }
    catch (...) {
      m_error = std::current_exception();
      return {vpTwist(), vpServoStatus::Degenerate};
    }
  }
  void goalChanged() override { call("goalChanged"); }
  void stateReset() override { call("stateReset"); }

private:
  void call(const char *name)
  {
    const py::gil_scoped_acquire locked;
    try {
      if (const py::function written = py::get_override(static_cast<const vpServoLaw *>(this), name)) {
        written();
      }
    }
    catch (...) { // vpVisualServo sets goals in its step, too
      m_error = std::current_exception();
    }
  }
  vpServoCommand command(const py::object &result) const
  {
    const vpServoCommand command = py::isinstance<vpServoCommand>(result)
                                       ? result.cast<vpServoCommand>()
                                       : vpServoCommand{result.cast<vpTwist>(), vpServoStatus::Servoing};
    if (!command.v.isFinite()) {
      throw py::value_error("the law " + m_id + " returned a twist that is not finite");
    }
    return command;
  }

  std::exception_ptr m_error;
};

// A law in Python where C++ wants one of its own: it keeps the Python object and passes everything on.
class HeldLaw : public vpServoLaw
{
public:
  HeldLaw(py::object law, const std::string &id, const vpServoGains &gains)
    : vpServoLaw(id, gains), m_object(std::move(law)), m_law(m_object.cast<vpServoLaw *>())
  {}
  ~HeldLaw() override
  {
    const py::gil_scoped_acquire locked;
    m_object.release().dec_ref();
  }
  [[nodiscard]] double rotationGain() const noexcept override { return m_law->rotationGain(); }
  void notifyInterrupted() noexcept override { m_law->notifyInterrupted(); }
  [[nodiscard]] vpServoLaw &inner() const { return *m_law; }

protected:
  void goalChanged() override { m_law->setGoal(m_goal); }
  void stateReset() override { m_law->reset(); }
  vpServoCommand compute(const vpServoMeasurement &measurement, double dt) noexcept override
  {
    return m_law->step(measurement, dt);
  }

private:
  py::object m_object;
  vpServoLaw *m_law;
};

} // namespace

void raiseErrorOf(const vpServoLaw &law)
{
  if (const auto *held = dynamic_cast<const HeldLaw *>(&law)) {
    raiseErrorOf(held->inner());
  }
  else if (const auto *python = dynamic_cast<const PythonLaw *>(&law)) {
    const_cast<PythonLaw *>(python)->raise();
  }
}

namespace
{
const vpServoLaw &lawOf(const vpServoLaw &law) { return law; }
const vpServoLaw &lawOf(const vpServoController &controller) { return controller.law(); }

template <class T> void setGoalOf(T &self, const vpServoGoal &goal)
{
  self.setGoal(goal);
  raiseErrorOf(lawOf(self));
}

template <class T> void resetOf(T &self)
{
  self.reset();
  raiseErrorOf(lawOf(self));
}

vpServoCommand stepOf(vpServoLaw &law, const vpServoMeasurement &measurement, double dt)
{
  const vpServoCommand command = law.step(measurement, dt);
  raiseErrorOf(law);
  return command;
}

// The class stays for the rest of the process, as what add() adds does.
void addLaw(const std::string &id, const std::string &sentence, const py::object &law)
{
  const py::handle kept = law.inc_ref();
  vpServoLaw::add(id, sentence, [kept, id](const vpServoGains &gains, const vpServoMotionLimits &) {
    const py::gil_scoped_acquire locked;
    py::object made = kept(gains);
    if (!py::isinstance<vpServoLaw>(made)) {
      throw py::type_error("the law " + id + " is " + described(made) + ", must be a ServoLaw");
    }
    return std::unique_ptr<vpServoLaw>(new HeldLaw(std::move(made), id, gains));
  });
}

struct Gains : vpServoLaw { // gives a Python law its gains
  static const vpServoGains &of(const vpServoLaw &law) { return law.*(&Gains::m_gains); }
};

void bindLaw(py::module_ &m)
{
  using Law = vpServoLaw;
  bindSpec<vpServoMotionLimits>(m);
  bindSpec<vpServoGains>(m);
  Bound<Law, PythonLaw>(
      m, "ServoLaw",
      "A servo law: measurement and goal in, camera twist out. ServoLaw.create() makes one of ids(). A law of\n"
      "your own derives from it and has a method compute(measurement, dt) that returns a twist or a\n"
      "ServoCommand; the measurement is valid, finite and has the goal's number of points. It may have\n"
      "goalChanged() and stateReset(), called by setGoal() and reset().")
      .def(py::init<const std::string &, const vpServoGains &>(), py::arg("id"), py::arg("gains") = vpServoGains(),
           "For a law of your own. id: its name. gains: validated here.")
      .def_static("create", &Law::create, py::arg("id"), py::arg("gains") = vpServoGains(),
                  py::arg("motion") = vpServoMotionLimits(), doc("vpServoLaw::create"))
      .def_static("sentence", &Law::sentence, py::arg("id"), doc("vpServoLaw::sentence"))
      .def_static("add", &addLaw, py::arg("id"), py::arg("sentence"), py::arg("law"),
                  "Adds a law of your own for create(), ServoController and VisualServo: law(gains) makes a ServoLaw, "
                  "as its class does. The\n"
                  "controller calls it where the interpreter can be had, which is no real time.")
      .def_static("ids", &Law::ids, doc("vpServoLaw::ids"))
      .def("setGoal", &setGoalOf<Law>, py::arg("goal"), doc("vpServoLaw::setGoal"))
      .def("reset", &resetOf<Law>, doc("vpServoLaw::reset"))
      .def("id", &Law::id, doc("vpServoLaw::id"))
      .def("goal", &Law::goal, py::return_value_policy::copy, doc("vpServoLaw::goal"))
      .def("gains", &Gains::of, py::return_value_policy::copy, "The gains of the law.")
      .def("rotationGain", &Law::rotationGain, doc("vpServoLaw::rotationGain"))
      .def("notifyInterrupted", &Law::notifyInterrupted, doc("vpServoLaw::notifyInterrupted"))
      .def("step", &stepOf, py::arg("measurement"), py::arg("dt"), doc("vpServoLaw::step"));
}

void bindController(py::module_ &m)
{
  using Controller = vpServoController;
  bindStruct<vpViewConstraintSpec>(m)
      .def_static("fromCamera", &vpViewConstraintSpec::fromCamera, py::arg("camera"), py::arg("width"),
                  py::arg("height"), doc("vpViewConstraintSpec::fromCamera"))
      .def("validate", &vpViewConstraintSpec::validate, doc("vpViewConstraintSpec::validate"));
  bindSpec<vpTargetLossSpec>(m);
  bindSpec<vpServoControllerSpec>(m);
  bindClass<Controller>(m)
      .def_static("create", &Controller::create, py::arg("id"), py::arg("spec") = vpServoControllerSpec(),
                  doc("vpServoController::create"))
      .def_static("ids", &Controller::ids, doc("vpServoController::ids"))
      .def("setGoal", &setGoalOf<Controller>, py::arg("goal"), doc("vpServoController::setGoal"))
      .def("reset", &resetOf<Controller>, doc("vpServoController::reset"))
      .def("id", &Controller::id, doc("vpServoController::id"))
      .def("spec", &Controller::spec, py::return_value_policy::copy, doc("vpServoController::spec"))
      .def("notifyInterrupted", &Controller::notifyInterrupted, doc("vpServoController::notifyInterrupted"))
      .def(
          "step",
          [](Controller &self, const vpServoMeasurement &measurement, double dt) {
            const vpServoCommand command = self.step(measurement, dt);
            raiseErrorOf(self.law());
            return command;
          },
          py::arg("measurement"), py::arg("dt"), doc("vpServoController::step"))
      .def("pass_", &Controller::pass, py::arg("dt"), doc("vpServoController::pass"))
      .def("notifyExecuted", &Controller::notifyExecuted, py::arg("commanded"), py::arg("moved"),
           doc("vpServoController::notifyExecuted"))
      .def("referenceRotation", &Controller::referenceRotation, py::arg("measurement"), py::arg("command"),
           doc("vpServoController::referenceRotation"));
  bindClass<vpViewConstraintFilter>(m)
      .def(py::init<const vpViewConstraintSpec &>(), py::arg("spec") = vpViewConstraintSpec(),
           doc("vpViewConstraintFilter::vpViewConstraintFilter"))
      .def("filter", &vpViewConstraintFilter::filter, py::arg("wanted"), py::arg("outline"), py::arg("dt"),
           doc("vpViewConstraintFilter::filter"))
      .def("margin", &vpViewConstraintFilter::margin, py::arg("Z"), py::arg("linear"), py::arg("angular"),
           py::arg("period"), doc("vpViewConstraintFilter::margin"));
  bindClass<vpTargetLossRecovery>(m)
      .def(py::init<const vpTargetLossSpec &>(), py::arg("spec") = vpTargetLossSpec(),
           doc("vpTargetLossRecovery::vpTargetLossRecovery"))
      .def("reset", &vpTargetLossRecovery::reset, doc("vpTargetLossRecovery::reset"))
      .def("step", &vpTargetLossRecovery::step, py::arg("command"), py::arg("dt"), doc("vpTargetLossRecovery::step"));
}

void bindOdometry(py::module_ &m)
{
  bindClass<vpOdometryBridge>(m)
      .def(py::init<double, double>(), py::arg("maxAge") = 1., py::arg("rate") = 1000.,
           doc("vpOdometryBridge::vpOdometryBridge"))
      .def("move", &vpOdometryBridge::move, py::arg("twist"), py::arg("time"), doc("vpOdometryBridge::move"))
      .def("correct", &vpOdometryBridge::correct, py::arg("result"), doc("vpOdometryBridge::correct"))
      .def(
          "predict",
          [](const vpOdometryBridge &self) {
            vpServoMeasurement now;
            self.predict(now);
            return now;
          },
          doc("vpOdometryBridge::predict"))
      .def("age", &vpOdometryBridge::age, doc("vpOdometryBridge::age"));
}

void bindTarget(py::module_ &m)
{
  using Target = vpServoTarget;
  using Points = std::vector<Eigen::Vector3d>;
  const auto measured = [](const Target &self, const auto &seen, double time) {
    vpServoMeasurement result;
    self.measure(seen, time, result);
    return result;
  };
  bindClass<Target>(m)
      .def(py::init<Points, Points>(), py::arg("points"), py::arg("outline") = Points(),
           doc("vpServoTarget::vpServoTarget"))
      .def_static("rectangle", &Target::rectangle, py::arg("width"), py::arg("height"), doc("vpServoTarget::rectangle"))
      .def("goal", &Target::goal, py::arg("cdMo"), doc("vpServoTarget::goal"))
      .def(
          "measure",
          [measured](const Target &self, const vpPlanarTargetResult &seen, double time) {
            return measured(self, seen, time);
          },
          py::arg("seen"), py::arg("time") = 0., "Measurement from a target found in an image, with its covariance.")
      .def(
          "measure",
          [measured](const Target &self, const vpHomogeneousMatrix &cMo, double time) {
            return measured(self, cMo, time);
          },
          py::arg("cMo"), py::arg("time") = 0., doc("vpServoTarget::measure"))
      .def("points", &Target::points, py::return_value_policy::copy, doc("vpServoTarget::points"))
      .def("outline", &Target::outline, py::return_value_policy::copy, doc("vpServoTarget::outline"));
}
} // namespace

void bindServo(py::module_ &m)
{
  bindEnum<vpServoStatus>(m);
  bindStruct<vpServoPoint>(m);
  bindStruct<vpServoGoal>(m).def("mean", &vpServoGoal::mean, doc("vpServoGoal::mean"));
  bindStruct<vpServoMeasurement>(m);
  bindStruct<vpServoCommand>(m).def(
      "message", [](const vpServoCommand &command) { return vpMessage(command.status); }, doc("vpMessage"));
  m.def(
      "isWorking", [](vpServoStatus status) { return vpIsWorking(status); }, py::arg("status"), doc("vpIsWorking"));
  m.def(
      "isWorking", [](const vpServoCommand &command) { return vpIsWorking(command.status); }, py::arg("command"),
      "The same of its status.");
  bindLaw(m);
  bindController(m);
  bindOdometry(m);
  bindTarget(m);
}
} // namespace visp_python
