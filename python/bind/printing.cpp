/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "records.h"

#include <visp3/printing/vpPrintMachine.h>
#include <visp3/printing/vpPrintReference.h>
#include <visp3/printing/vpPrintTrigger.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace visp_python
{
namespace
{
// The input keeps the cells that it points at.
struct TriggerInput : vpPrintTriggerInput {
  std::vector<vpPatternCell> kept;
};

// The output keeps the shots that it points at.
struct MachineOutput : vpPrintMachineOutput {
  explicit MachineOutput(const vpPrintMachineOutput &output) : vpPrintMachineOutput(output), fired(*output.trigger)
  {
    trigger = nullptr;
  }
  vpPrintTriggerOutput fired;
};

// A count may have been changed.
std::size_t countOf(int count)
{
  return static_cast<std::size_t>(std::clamp(count, 0, vpPrintTriggerOutput::capacity));
}

void bindForecast(py::module_ &m)
{
  bindStruct<vpMotionForecast>(m)
      .def_property(
          "plan",
          [](const vpMotionForecast &self) {
            return py::tuple(py::cast(std::vector<vpTrajectorySegment>(
                self.plan.begin(), self.plan.begin() + std::clamp(self.pieces, 0, vpMotionForecast::maxPieces))));
          },
          [](vpMotionForecast &self, const std::vector<vpTrajectorySegment> &plan) {
            if (plan.size() > self.plan.size()) {
              throw py::value_error(std::to_string(plan.size()) + " pieces were given, must be at most 4");
            }
            std::copy(plan.begin(), plan.end(), self.plan.begin());
            self.pieces = static_cast<int>(plan.size());
          },
          "Pieces of the plan in sequence, at most 4, on the clock of time; sets pieces, too.")
      .def("isPlausible", &vpMotionForecast::isPlausible, doc("vpMotionForecast::isPlausible"))
      .def_property_readonly(
          "pieces", [](const vpMotionForecast &self) { return self.pieces; }, doc("vpMotionForecast::pieces"))
      .def(
          "at",
          [](const vpMotionForecast &self, double t) {
            if (!self.isPlausible()) {
              throw py::value_error(
                  "the forecast is not plausible: a number is not finite, too large or out of its range");
            }
            return self.at(t);
          },
          py::arg("t"), doc("vpMotionForecast::at"));
}

void bindReference(py::module_ &m)
{
  using Reference = vpPrintReference;
  bindEnum<vpPrintReferenceMode>(m);
  bindSpec<vpPrintReferenceSpec>(m);
  bindStruct<vpPrintTarget>(m);
  bindStruct<vpPrintReference::Output>(m);
  bindClass<Reference>(m)
      .def(py::init<const vpPrintReferenceSpec &>(), py::arg("spec") = vpPrintReferenceSpec(),
           doc("vpPrintReference::vpPrintReference"))
      .def(
          "step",
          [](Reference &self, double now, const std::vector<vpPrintTarget> &targets) {
            return self.step(now, targets.data(), targets.size());
          },
          py::arg("now"), py::arg("targets"), doc("vpPrintReference::step"))
      .def("at", &Reference::at, py::arg("time"), doc("vpPrintReference::at"))
      .def("output", &Reference::output, py::return_value_policy::copy, doc("vpPrintReference::output"))
      .def(
          "pieces",
          [](const Reference &self) {
            return std::vector<vpTrajectorySegment>(self.pieces().begin(), self.pieces().begin() + self.pieceCount());
          },
          doc("vpPrintReference::pieces"))
      .def("reset", &Reference::reset, py::arg("now"), py::arg("position"), py::arg("passed"),
           doc("vpPrintReference::reset"))
      .def("spec", &Reference::spec, py::return_value_policy::copy, doc("vpPrintReference::spec"));
}

void bindTrigger(py::module_ &m)
{
  using Trigger = vpPrintTrigger;
  using Output = vpPrintTriggerOutput;
  bindRecord<vpPrintShot>(m);
  bindEnum<vpPrintTriggerMethod>(m);
  bindEnum<vpPrintAxis>(m);
  bindEnum<vpPrintTriggerStatus>(m);
  bindSpec<vpPrintTriggerSpec>(m);
  Bound<TriggerInput> input(m, "PrintTriggerInput", Reflect<vpPrintTriggerInput>::doc);
  input.attr("_fields") = py::list();
  Reflect<vpPrintTriggerInput>::each([&input](const char *name, auto member, const char *text) {
    if (std::string(name) != "cellCount") {
      bindField(input, name, member, text);
    }
  });
  input
      .def(py::init([](const py::kwargs &values) {
             auto made = std::make_unique<TriggerInput>();
             setFields(py::cast(made.get(), py::return_value_policy::reference), values);
             return made;
           }),
           "Fields by keyword; those left out have their defaults.")
      .def("__repr__", &represented)
      .def_property(
          "cells", [](const TriggerInput &self) { return records(self.kept.data(), self.kept.size()); },
          [](TriggerInput &self, const py::object &cells) {
            self.kept = fromRecords<vpPatternCell>(cells);
            self.cells = self.kept.data();
            self.cellCount = self.kept.size();
          },
          "Cells of the newest frame, an array of dtype PatternCell; empty: no frame, only the motion continues.");
  bindStruct<Output>(m, false)
      .def_property_readonly(
          "shots", [](const Output &self) { return records(self.shots.data(), countOf(self.shotCount)); },
          "Shots to fire, an array of dtype PrintShot; each cell once.")
      .def_property_readonly(
          "missed", [](const Output &self) { return records(self.missed.data(), countOf(self.missedCount)); },
          "Cells that can no longer be hit; each once.")
      .def_property_readonly(
          "planned", [](const Output &self) { return records(self.planned.data(), countOf(self.plannedCount)); },
          "Future shots within the horizon, unordered; they may still change.")
      .def("message", &Output::message, doc("vpPrintTriggerOutput::message"));
  bindClass<Trigger>(m)
      .def(py::init<const vpPrintTriggerSpec &>(), py::arg("spec") = vpPrintTriggerSpec(),
           doc("vpPrintTrigger::vpPrintTrigger"))
      .def(
          "step", [](Trigger &self, const TriggerInput &given) { return self.step(given); }, py::arg("input"),
          doc("vpPrintTrigger::step"))
      .def("reset", &Trigger::reset, doc("vpPrintTrigger::reset"))
      .def("spec", &Trigger::spec, py::return_value_policy::copy, doc("vpPrintTrigger::spec"))
      .def("remembered", &Trigger::remembered, doc("vpPrintTrigger::remembered"))
      .def(
          "find",
          [](const Trigger &self, int row, int column, unsigned int epoch) -> std::optional<std::pair<double, double>> {
            std::pair<double, double> place;
            if (!self.find(row, column, epoch, place.first, place.second)) {
              return std::nullopt;
            }
            return place;
          },
          py::arg("row"), py::arg("column"), py::arg("epoch"),
          "(along, across) of a cell on the product: it passes the nozzle when the displacement is nozzle minus this. "
          "None when\n"
          "the cell is not known.");
}

void bindMachine(py::module_ &m)
{
  using Machine = vpPrintMachine;
  using Gains = vpAlphaBetaGains;
  using Pid = vpPrintVelocityControlSpec;
  bindEnum<vpPrintController>(m);
  bindEnum<vpMotionModel>(m);
  bindStruct<vpFrictionModel>(m)
      .def("friction", &vpFrictionModel::friction, py::arg("velocity"), doc("vpFrictionModel::friction"))
      .def("force", &vpFrictionModel::force, py::arg("velocity"), py::arg("acceleration"),
           doc("vpFrictionModel::force"));
  bindSpec<Gains>(m)
      .def_static("criticallyDamped", &Gains::criticallyDamped, py::arg("alpha"),
                  doc("vpAlphaBetaGains::criticallyDamped"))
      .def_static("steadyKalman", &Gains::steadyKalman, py::arg("alpha"), doc("vpAlphaBetaGains::steadyKalman"))
      .def("valueVariance", &Gains::valueVariance, doc("vpAlphaBetaGains::valueVariance"))
      .def("rateVariance", &Gains::rateVariance, doc("vpAlphaBetaGains::rateVariance"));
  bindSpec<Pid>(m)
      .def_static("thesisPid", &Pid::thesisPid, doc("vpPrintVelocityControlSpec::thesisPid"))
      .def_static("thesisFeedforward", &Pid::thesisFeedforward, doc("vpPrintVelocityControlSpec::thesisFeedforward"));
  bindSpec<vpMotionKalmanSpec>(m);
  bindSpec<vpMotionObserverSpec>(m);
  bindSpec<vpPreviewControlSpec>(m);
  bindSpec<vpPrintMachineSpec>(m).def_static("defaultForecast", &vpPrintMachineSpec::defaultForecast,
                                             doc("vpPrintMachineSpec::defaultForecast"));

  Bound<MachineOutput> output(m, "PrintMachineOutput", Reflect<vpPrintMachineOutput>::doc);
  output.attr("_fields") = py::list();
  Reflect<vpPrintMachineOutput>::each(
      [&output](const char *name, auto member, const char *text) { bindField(output, name, member, text); });
  output.def("__repr__", &represented)
      .def_property_readonly(
          "trigger", [](const MachineOutput &self) { return self.fired; }, doc("vpPrintMachineOutput::trigger"));
  bindClass<Machine>(m)
      .def(py::init<const vpPrintMachineSpec &>(), py::arg("spec") = vpPrintMachineSpec(),
           doc("vpPrintMachine::vpPrintMachine"))
      .def("reset", &Machine::reset, py::arg("firstRow") = 0, py::arg("firstColumn") = -1, doc("vpPrintMachine::reset"))
      .def(
          "step",
          [](Machine &self, double time, const py::object &cells, unsigned int epoch) {
            const std::vector<vpPatternCell> seen = fromRecords<vpPatternCell>(cells);
            return MachineOutput(self.step({time, seen.data(), seen.size(), epoch}));
          },
          py::arg("time"), py::arg("cells"), py::arg("epoch") = 0,
          "Processes one image. time: of this step, frame; one more than that of the previous step. cells: of the "
          "newest "
          "image,\n"
          "an array of dtype PatternCell; empty: no image arrived, the expected motion continues. epoch: of the cells, "
          "see PatternFrame.")
      .def("spec", &Machine::spec, py::return_value_policy::copy, doc("vpPrintMachine::spec"))
      .def("columnOf", &Machine::columnOf, py::arg("row"), py::arg("k"), doc("vpPrintMachine::columnOf"));
}
} // namespace

void bindPrinting(py::module_ &m)
{
  bindForecast(m);
  bindReference(m);
  bindTrigger(m);
  bindMachine(m);
}
} // namespace visp_python
