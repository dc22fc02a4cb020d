/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "binding.h"

#include <visp3/trajectory/vpDirectTrajectory.h>
#include <visp3/trajectory/vpPoseTrajectory.h>
#include <visp3/trajectory/vpTwistShaper.h>

#include <algorithm>

namespace visp_python
{
namespace
{
using Input = vpTrajectoryInput<Eigen::Dynamic>;
using Output = vpTrajectoryOutput<Eigen::Dynamic>;
using State = vpTrajectoryState<Eigen::Dynamic>;
using Via = vpTrajectoryVia<Eigen::Dynamic>;
using Trajectory = vpDirectTrajectory<Eigen::Dynamic>;

// Their product is the memory of a plan.
int checkedAxes(int axes, int vias = 0)
{
  if (axes < 1 || axes > 10000) {
    throw py::value_error("the number of axes is " + std::to_string(axes) + ", must be 1..10000");
  }
  if (vias < 0 || vias > 1000) {
    throw py::value_error("the number of vias is " + std::to_string(vias) + ", must be 0..1000");
  }
  return axes;
}

// A struct of vectors with one number for each axis.
template <class T> void bindAxes(py::module_ &m)
{
  auto bound = bindStruct<T>(m, false);
  bound.def(py::init([](int axes, const py::kwargs &values) {
              auto made = std::make_unique<T>(checkedAxes(axes));
              setFields(py::cast(made.get(), py::return_value_policy::reference), values);
              return made;
            }),
            py::arg("axes"), "Number of axes, then fields by keyword.");
}

py::array_t<double> sampled(const vpTrajectoryPlan &plan, int axis, const Numbers &times)
{
  checkedIndex(axis, plan.axes(), "axis");
  if (times.ndim() != 1) {
    throw py::value_error(described(times) + " was given, must be n numbers");
  }
  auto result = newArray(times.shape(0), 4, nullptr);
  for (py::ssize_t i = 0; i < times.shape(0); ++i) {
    const vpAxisState x = plan.at(axis, times.at(i));
    std::copy(x.begin(), x.end(), result.mutable_data(i));
  }
  return result;
}

void bindPlan(py::module_ &m)
{
  using Plan = vpTrajectoryPlan;
  bindEnum<vpTrajectoryForm>(m);
  bindStruct<vpTrajectorySegment>(m);
  bindStruct<vpTrajectoryPeaks>(m);
  bindStruct<vpTrajectoryPiece>(m);
  const auto checked = [](auto method) {
    return [method](const Plan &plan, int axis) { return (plan.*method)(checkedIndex(axis, plan.axes(), "axis")); };
  };
  bindClass<Plan>(m)
      .def(py::init([](int axes, int vias) { return Plan(checkedAxes(axes, vias), vias); }), py::arg("axes"),
           py::arg("maxVias") = 0, doc("vpTrajectoryPlan::vpTrajectoryPlan"))
      .def("axes", &Plan::axes, doc("vpTrajectoryPlan::axes"))
      .def("duration", py::overload_cast<>(&Plan::duration, py::const_), doc("vpTrajectoryPlan::duration"))
      .def("arrival", checked(py::overload_cast<int>(&Plan::duration, py::const_)), py::arg("axis"),
           "Arrival of this axis, s: below duration() with Synchronisation.None_ only.")
      .def("brakingEnd", &Plan::brakingEnd, doc("vpTrajectoryPlan::brakingEnd"))
      .def("form", checked(py::overload_cast<int>(&Plan::form, py::const_)), py::arg("axis"),
           doc("vpTrajectoryPlan::form"))
      .def("iterations", &Plan::iterations, doc("vpTrajectoryPlan::iterations"))
      .def(
          "at",
          [](const Plan &plan, int axis, double t) { return plan.at(checkedIndex(axis, plan.axes(), "axis"), t); },
          py::arg("axis"), py::arg("t"), doc("vpTrajectoryPlan::at"))
      .def(
          "sample",
          [](const Plan &plan, int axis, const py::object &times) { return sampled(plan, axis, numbers(times)); },
          py::arg("axis"), py::arg("times"), "States of an axis at many times, one row (q, v, a, j) each; see at().")
      .def(
          "segments",
          [](const Plan &plan, int axis) {
            std::vector<vpTrajectorySegment> segments;
            for (int i = 0; i < plan.segments(checkedIndex(axis, plan.axes(), "axis")); ++i) {
              segments.push_back(plan.segment(axis, i));
            }
            return segments;
          },
          py::arg("axis"), "The polynomials of an axis until its arrival.")
      .def(
          "viaTimes",
          [](const Plan &plan) {
            std::vector<double> times;
            for (int k = 0; k < plan.vias(); ++k) {
              times.push_back(plan.viaTime(k));
            }
            return times;
          },
          "Times at which the vias are passed, s from the start of the plan.")
      .def("peaks", checked(&Plan::peaks), py::arg("axis"), doc("vpTrajectoryPlan::peaks"))
      .def("peakNorm", &Plan::peakNorm, py::arg("axes"), py::arg("order"), py::arg("start") = 0.,
           doc("vpTrajectoryPlan::peakNorm"))
      .def("pieces", py::overload_cast<>(&Plan::pieces, py::const_), doc("vpTrajectoryPlan::pieces"));
}

void bindDirect(py::module_ &m)
{
  bindClass<Trajectory>(m)
      .def(py::init([](int axes, int vias) { return Trajectory(checkedAxes(axes, vias), vias); }), py::arg("axes"),
           py::arg("maxVias") = 0, doc("vpDirectTrajectory::vpDirectTrajectory"))
      .def(
          "step",
          [](Trajectory &self, const Input &input, double dt) {
            Output output(self.plan().axes());
            self.step(input, output, dt);
            return output;
          },
          py::arg("input"), py::arg("dt"), doc("vpDirectTrajectory::step"))
      .def("reset", &Trajectory::reset, doc("vpDirectTrajectory::reset"))
      .def("plan", &Trajectory::plan, py::return_value_policy::copy, doc("vpDirectTrajectory::plan"))
      .def_static(
          "calculate",
          [](const Input &input) {
            vpTrajectoryPlan plan(checkedAxes(static_cast<int>(input.goal.q.size())));
            vpTrajectoryStatus status;
            {
              const py::gil_scoped_release unlocked;
              status = Trajectory::calculate(input, plan);
            }
            return py::make_tuple(status, plan);
          },
          py::arg("input"),
          "(status, plan): the whole motion at once, by the exact method. The plan is empty when the input is "
          "invalid.")
      .def_static(
          "optimiseVias",
          [](Input &input) {
            checkedAxes(static_cast<int>(input.goal.q.size()));
            const py::gil_scoped_release unlocked;
            return Trajectory::optimiseVias(input);
          },
          py::arg("input"), doc("vpDirectTrajectory::optimiseVias"));
}

void bindPose(py::module_ &m)
{
  using Pose = vpPoseTrajectory;
  bindEnum<vpRotationPath>(m);
  bindSpec<vpPoseTrajectorySpec>(m);
  bindStruct<vpCameraState>(m).def_property_readonly(
      "fMc",
      [](const vpCameraState &state) {
        return vpRigidTransform{state.fRc, state.ftc};
      },
      "Pose of the camera in the reference frame.");
  bindClass<Pose>(m)
      .def(py::init<const vpPoseTrajectorySpec &>(), py::arg("spec") = vpPoseTrajectorySpec(),
           doc("vpPoseTrajectory::vpPoseTrajectory"))
      .def("setSpec", &Pose::setSpec, py::arg("spec"), doc("vpPoseTrajectory::setSpec"))
      .def("reset", &Pose::reset, py::arg("fMc"), py::arg("v") = vpTwist(), py::arg("a") = vpTwist(),
           doc("vpPoseTrajectory::reset"))
      .def("setGoal", &Pose::setGoal, py::arg("fMcd"), py::arg("twist") = vpTwist(), doc("vpPoseTrajectory::setGoal"))
      .def("step", &Pose::step, py::arg("dt"), doc("vpPoseTrajectory::step"))
      .def("state", &Pose::state, py::return_value_policy::copy, doc("vpPoseTrajectory::state"))
      .def("at", &Pose::at, py::arg("t"), doc("vpPoseTrajectory::at"))
      .def("duration", &Pose::duration, doc("vpPoseTrajectory::duration"))
      .def("remaining", &Pose::remaining, doc("vpPoseTrajectory::remaining"))
      .def("plan", &Pose::plan, py::return_value_policy::copy, doc("vpPoseTrajectory::plan"));
}

void bindTwists(py::module_ &m)
{
  using Shaper = vpTwistShaper;
  bindSpec<vpTwistShaperLimits>(m);
  bindClass<Shaper>(m)
      .def(py::init<const vpTwistShaperLimits &>(), py::arg("limits") = vpTwistShaperLimits(),
           doc("vpTwistShaper::vpTwistShaper"))
      .def("reset", &Shaper::reset, py::arg("twist") = vpTwist(), py::arg("acceleration") = vpTwist(),
           doc("vpTwistShaper::reset"))
      .def("setLimits", &Shaper::setLimits, py::arg("limits"), doc("vpTwistShaper::setLimits"))
      .def("step", &Shaper::step, py::arg("raw"), py::arg("dt"), doc("vpTwistShaper::step"))
      .def("twist", &Shaper::twist, py::return_value_policy::copy, doc("vpTwistShaper::twist"))
      .def("acceleration", &Shaper::acceleration, py::return_value_policy::copy, doc("vpTwistShaper::acceleration"));
  m.def("limitTwist", &vpLimitTwist, py::arg("twist"), py::arg("maxLinear"), py::arg("maxAngular"),
        doc("vpLimitTwist"));
}
} // namespace

void bindTrajectory(py::module_ &m)
{
  bindEnum<vpTrajectoryContinuity>(m);
  bindEnum<vpReplanPolicy>(m);
  bindEnum<vpSynchronisation>(m);
  bindEnum<vpDurationMethod>(m);
  bindEnum<vpLateArrival>(m);
  bindEnum<vpTrajectoryResult>(m);
  bindEnum<vpTrajectoryFault>(m);
  bindEnum<vpTrajectoryLimit>(m);
  bindStruct<vpLimitExcess>(m).def("amount", &vpLimitExcess::amount, doc("vpLimitExcess::amount"));
  bindStruct<vpTrajectoryStatus>(m)
      .def("isGood", &vpTrajectoryStatus::isGood, doc("vpTrajectoryStatus::isGood"))
      .def("message", &vpTrajectoryStatus::message, doc("vpTrajectoryStatus::message"));
  bindStruct<vpAxisGroup>(m).def("contains", &vpAxisGroup::contains, py::arg("axis"), doc("vpAxisGroup::contains"));
  bindStruct<vpTrajectorySpec>(m).def_property(
      "groups",
      [](const vpTrajectorySpec &spec) {
        return py::make_tuple(spec.groups[0], spec.groups[1], spec.groups[2], spec.groups[3]);
      },
      [](vpTrajectorySpec &spec, const std::vector<vpAxisGroup> &groups) {
        if (groups.size() > spec.groups.size()) {
          throw py::value_error(std::to_string(groups.size()) + " groups were given, must be at most 4");
        }
        std::copy(groups.begin(), groups.end(), spec.groups.begin());
        std::fill(spec.groups.begin() + static_cast<std::ptrdiff_t>(groups.size()), spec.groups.end(), vpAxisGroup());
      },
      doc("vpTrajectorySpec::groups"));
  bindAxes<State>(m);
  bindAxes<Via>(m);
  bindAxes<Input>(m);
  bindAxes<Output>(m);
  bindPlan(m);
  bindDirect(m);
  bindPose(m);
  bindTwists(m);
  m.def(
      "isWorking", [](vpTrajectoryResult result) { return vpIsWorking(result); }, py::arg("result"),
      doc("vpIsWorking"));
  m.def(
      "isWorking", [](const vpTrajectoryStatus &status) { return vpIsWorking(status.result); }, py::arg("status"),
      "The same of its result.");
  m.def(
      "isWorking", [](const Output &output) { return vpIsWorking(output.status.result); }, py::arg("output"),
      "The same of its status.");
}
} // namespace visp_python
