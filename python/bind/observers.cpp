/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of a print machine by themselves: filters and observers of its motion, control and friction of one axis.
#include "records.h"

#include <visp3/printing/vpAlphaBetaFilter.h>
#include <visp3/printing/vpFrictionIdentification.h>
#include <visp3/printing/vpMotionKalmanFilter.h>
#include <visp3/printing/vpMotionObserver.h>
#include <visp3/printing/vpPreviewControl.h>
#include <visp3/printing/vpPrintVelocityControl.h>
#include <visp3/printing/vpProductOdometer.h>

namespace visp_python
{
namespace
{
constexpr auto copy = py::return_value_policy::copy;
using Cells = std::vector<vpPatternCell>;

void bindFilters(py::module_ &m)
{
  using AlphaBeta = vpAlphaBetaFilter;
  using Kalman = vpMotionKalmanFilter;
  std::string in = "vpAlphaBetaFilter::";
  bindStruct<AlphaBeta::State>(m);
  bindClass<AlphaBeta>(m)
      .def(py::init<const vpAlphaBetaGains &, double>(), py::arg("gains") = vpAlphaBetaGains(), py::arg("period") = 1.,
           doc(in + "vpAlphaBetaFilter"))
      .def("step", &AlphaBeta::step, py::arg("z"), py::arg("u") = 0., copy, doc(in + "step"))
      .def("skip", &AlphaBeta::skip, py::arg("u") = 0., copy, doc(in + "skip"))
      .def("predict", &AlphaBeta::predict, py::arg("dt"), doc(in + "predict"))
      .def("reset", py::overload_cast<double, double>(&AlphaBeta::reset), py::arg("value"), py::arg("rate"),
           doc(in + "reset"))
      .def("reset", py::overload_cast<>(&AlphaBeta::reset), "Restart from the next measurement.")
      .def("state", &AlphaBeta::state, copy, doc(in + "state"))
      .def("gains", &AlphaBeta::gains, copy, doc(in + "gains"));
  in = "vpMotionKalmanFilter::";
  bindEnum<vpMotionReadingKind>(m);
  bindEnum<vpMotionReadingResult>(m);
  bindStruct<vpMotionReading>(m);
  bindStruct<vpMotionEstimate>(m);
  bindClass<Kalman>(m)
      .def(py::init<const vpMotionKalmanSpec &>(), py::arg("spec") = vpMotionKalmanSpec(),
           doc(in + "vpMotionKalmanFilter"))
      .def("add", &Kalman::add, py::arg("reading"), doc(in + "add"))
      .def("at", &Kalman::at, py::arg("time"), doc(in + "at"))
      .def("reset", &Kalman::reset, py::arg("time"), py::arg("position") = 0., py::arg("velocity") = 0.,
           doc(in + "reset"))
      .def("outliers", &Kalman::outliers, doc(in + "outliers"))
      .def("spec", &Kalman::spec, copy, doc(in + "spec"));
}

void bindObserver(py::module_ &m)
{
  using Observer = vpMotionObserver;
  const std::string in = "vpMotionObserver::";
  bindStruct<vpObservedMotion>(m);
  bindClass<Observer>(m)
      .def(py::init<const vpMotionObserverSpec &>(), py::arg("spec") = vpMotionObserverSpec(),
           doc(in + "vpMotionObserver"))
      .def("command", &Observer::command, py::arg("time"), py::arg("force"), doc(in + "command"))
      .def("measure", &Observer::measure, py::arg("time"), py::arg("position"), py::arg("sigma"), doc(in + "measure"))
      .def("at", &Observer::at, py::arg("time"), doc(in + "at"))
      .def("reset", &Observer::reset, py::arg("time") = 0., py::arg("position") = 0., doc(in + "reset"))
      .def("spec", &Observer::spec, copy, doc(in + "spec"));
}

void bindOdometer(py::module_ &m)
{
  using Odometer = vpProductOdometer;
  const std::string in = "vpProductOdometer::";
  bindStruct<vpCellVelocity>(m);
  m.def(
      "findCellVelocity",
      [](const py::object &before, const py::object &now, double frames) {
        const Cells a = fromRecords<vpPatternCell>(before), b = fromRecords<vpPatternCell>(now);
        return vpFindCellVelocity(a.data(), a.size(), b.data(), b.size(), frames);
      },
      py::arg("before"), py::arg("now"), py::arg("frames") = 1., doc("vpFindCellVelocity"));
  bindStruct<Odometer::Output>(m);
  bindClass<Odometer>(m)
      .def(py::init<int>(), py::arg("capacity") = 1024, doc(in + "vpProductOdometer"))
      .def(
          "step",
          [](Odometer &self, const py::object &cells, unsigned int epoch, double predictedX, double predictedY) {
            const Cells seen = fromRecords<vpPatternCell>(cells);
            return self.step(seen.data(), seen.size(), epoch, predictedX, predictedY);
          },
          py::arg("cells"), py::arg("epoch") = 0, py::arg("predictedX") = 0., py::arg("predictedY") = 0.,
          doc(in + "step"))
      .def("output", &Odometer::output, copy, doc(in + "output"))
      .def("reset", &Odometer::reset, doc(in + "reset"));
}

void bindAxis(py::module_ &m)
{
  using Preview = vpPreviewControl;
  using Pid = vpPrintVelocityControl;
  std::string in = "vpPreviewControl::";
  bindStruct<Preview::Input>(m);
  bindStruct<Preview::Output>(m);
  bindClass<Preview>(m)
      .def(py::init<const vpPreviewControlSpec &>(), py::arg("spec") = vpPreviewControlSpec(),
           doc(in + "vpPreviewControl"))
      .def("actsAt", &Preview::actsAt, py::arg("now"), doc(in + "actsAt"))
      .def("feedbackAt", &Preview::feedbackAt, py::arg("now"), doc(in + "feedbackAt"))
      .def("command", &Preview::command, py::arg("input"), doc(in + "command"))
      .def("spec", &Preview::spec, copy, doc(in + "spec"));
  in = "vpPrintVelocityControl::";
  bindStruct<Pid::Input>(m);
  bindStruct<Pid::Output>(m);
  bindClass<Pid>(m)
      .def(py::init<const vpPrintVelocityControlSpec &>(), py::arg("spec") = vpPrintVelocityControlSpec(),
           doc(in + "vpPrintVelocityControl"))
      .def("step", &Pid::step, py::arg("input"), doc(in + "step"))
      .def("reset", &Pid::reset, doc(in + "reset"))
      .def("integral", &Pid::integral, doc(in + "integral"))
      .def("spec", &Pid::spec, copy, doc(in + "spec"));

  bindEnum<vpFrictionStatus>(m);
  bindSpec<vpFrictionIdentificationSpec>(m);
  bindStruct<vpFrictionIdentification>(m).def("message", &vpFrictionIdentification::message,
                                              doc("vpFrictionIdentification::message"));
  m.def(
      "identifyFriction",
      [](const std::vector<Eigen::Vector3d> &log, const vpFrictionIdentificationSpec &spec) {
        std::vector<vpFrictionSample> samples;
        for (const Eigen::Vector3d &row : log) {
          samples.push_back({row(0), row(1), row(2)});
        }
        return vpIdentifyFriction(samples, spec);
      },
      py::arg("log"), py::arg("spec") = vpFrictionIdentificationSpec(), Unlocked(),
      (std::string(doc("vpIdentifyFriction")) + "\nlog: one row a sample: force, velocity, acceleration.").c_str());
}
} // namespace

void bindObservers(py::module_ &m)
{
  bindFilters(m);
  bindObserver(m);
  bindOdometer(m);
  bindAxis(m);
}
} // namespace visp_python
