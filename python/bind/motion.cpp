/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "binding.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpGoalConfiguration.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpTimedPath.h>

#include <utility>

namespace visp_python
{
namespace
{
using Scene = vpCollisionScene;

void bindCertificates(py::module_ &m)
{
  bindEnum<vpMotionStatus>(m);
  bindStruct<vpMotionResult>(m)
      .def("isFree", &vpMotionResult::isFree, doc("vpMotionResult::isFree"))
      .def("message", &vpMotionResult::message, doc("vpMotionResult::message"));
  bindStruct<vpTrajectoryClearance>(m).def("isFree", &vpTrajectoryClearance::isFree,
                                           doc("vpTrajectoryClearance::isFree"));
  bindStruct<vpCertifiedMotionSpec>(m);
  bindClass<vpCertifiedMotion>(m)
      .def(py::init<const Scene &, const vpCertifiedMotionSpec &>(), py::arg("scene"),
           py::arg("spec") = vpCertifiedMotionSpec(), py::keep_alive<1, 2>(),
           doc("vpCertifiedMotion::vpCertifiedMotion"))
      .def(
          "check",
          [](const vpCertifiedMotion &self, const vpJointVector &from, const vpJointVector &to) {
            thread_local vpMotionScratch scratch;
            return self.check(from, to, scratch);
          },
          py::arg("start"), py::arg("end"), Unlocked(), doc("vpCertifiedMotion::check"))
      .def("spec", &vpCertifiedMotion::spec, py::return_value_policy::copy, doc("vpCertifiedMotion::spec"));
  using Certificate = vpCertifiedTrajectory;
  bindClass<Certificate>(m)
      .def(py::init<const Scene &, const vpCertifiedMotionSpec &>(), py::arg("scene"),
           py::arg("spec") = vpCertifiedMotionSpec(), py::keep_alive<1, 2>(),
           doc("vpCertifiedTrajectory::vpCertifiedTrajectory"))
      .def(
          "check", [](Certificate &self, const vpTrajectoryPlan &plan) { return self.check(plan); }, py::arg("plan"),
          Unlocked(), "Checks the whole plan, with the scene's object poses at its start.")
      .def("check", py::overload_cast<const vpTrajectoryPlan &, double, double, double>(&Certificate::check),
           py::arg("plan"), py::arg("start"), py::arg("end"), py::arg("age") = 0., Unlocked(),
           doc("vpCertifiedTrajectory::check"))
      .def("setMargin", &Certificate::setMargin, py::arg("margin"), doc("vpCertifiedTrajectory::setMargin"));
}

void bindPlanners(py::module_ &m)
{
  using Planner = vpPathPlanner;
  constexpr auto copy = py::return_value_policy::copy;
  bindStruct<vpJointPath>(m)
      .def("length", &vpJointPath::length, doc("vpJointPath::length"))
      .def(
          "at",
          [](const vpJointPath &self, double s) {
            if (self.points.empty()) {
              throw py::value_error("the path is empty");
            }
            return self.at(s);
          },
          py::arg("s"), doc("vpJointPath::at"));
  bindEnum<vpMotionValidation>(m);
  bindSpec<vpPathPlannerSpec>(m);
  bindEnum<vpPathStatus>(m);
  bindStruct<vpPathResult>(m);
  bindClass<Planner>(m)
      .def(py::init<const Scene &, const vpPathPlannerSpec &>(), py::arg("scene"),
           py::arg("spec") = vpPathPlannerSpec(), py::keep_alive<1, 2>(), doc("vpPathPlanner::vpPathPlanner"))
      .def_static("names", &Planner::names, doc("vpPathPlanner::names"))
      .def("plan", &Planner::plan, py::arg("start"), py::arg("goal"), Unlocked(), doc("vpPathPlanner::plan"))
      .def("setTimeLimit", &Planner::setTimeLimit, py::arg("seconds"), doc("vpPathPlanner::setTimeLimit"))
      .def("setSeed", &Planner::setSeed, py::arg("seed"), doc("vpPathPlanner::setSeed"))
      .def("spec", &Planner::spec, copy, doc("vpPathPlanner::spec"));
  bindStruct<vpTimedPathSpec>(m);
  bindClass<vpTimedPath>(m)
      .def(py::init<const Scene &, const vpJointPath &, const vpTimedPathSpec &>(), py::arg("scene"), py::arg("path"),
           py::arg("spec") = vpTimedPathSpec(), Unlocked(), doc("vpTimedPath::vpTimedPath"))
      .def("isFree", &vpTimedPath::isFree, doc("vpTimedPath::isFree"))
      .def("clearance", &vpTimedPath::clearance, copy, doc("vpTimedPath::clearance"))
      .def(
          "parts",
          [](const vpTimedPath &self) {
            std::vector<std::pair<double, vpTrajectoryPlan>> parts;
            for (const vpTimedPath::Part &part : self.parts()) {
              parts.emplace_back(part.begin, part.plan);
            }
            return parts;
          },
          "The trajectories in their order: (start time, plan) each, s.")
      .def("duration", &vpTimedPath::duration, doc("vpTimedPath::duration"))
      .def(
          "at",
          [](const vpTimedPath &self, int joint, double t) {
            const int joints = self.parts().empty() ? 0 : self.parts().front().plan.axes();
            return self.at(checkedIndex(joint, joints, "joint"), t);
          },
          py::arg("joint"), py::arg("t"), doc("vpTimedPath::at"))
      .def("message", &vpTimedPath::message, py::arg("scene"), doc("vpTimedPath::message"));
  bindEnum<vpGoalConfigurationStatus>(m);
  bindStruct<vpGoalConfiguration>(m)
      .def("isFree", &vpGoalConfiguration::isFree, doc("vpGoalConfiguration::isFree"))
      .def("message", &vpGoalConfiguration::message, doc("vpGoalConfiguration::message"));
  m.def("findGoalConfiguration", &vpFindGoalConfiguration, py::arg("scene"), py::arg("start"), py::arg("position"),
        py::arg("margin") = 0., py::arg("attempts") = 20, py::arg("seed") = 1U, Unlocked(),
        doc("vpFindGoalConfiguration"));
}

void bindAvoidance(py::module_ &m)
{
  using Method = vpAvoidanceMethod;
  bindStruct<vpAvoidanceGoal>(m)
      .def_static(
          "at",
          [](const vpArmModel &model, const vpJointVector &q) {
            checkJoints("q", q.size(), model.size());
            return vpAvoidanceGoal::at(model, q);
          },
          py::arg("model"), py::arg("q"), doc("vpAvoidanceGoal::at"))
      .def("fits", &vpAvoidanceGoal::fits, py::arg("model"), doc("vpAvoidanceGoal::fits"));
  bindEnum<vpAvoidanceStatus>(m);
  bindStruct<vpAvoidanceOutput>(m).def(
      "message", [](const vpAvoidanceOutput &self) { return vpMessage(self.status); },
      "Status as a readable sentence.");
  bindSpec<vpAvoidanceMethodSpec>(m);
  bindClass<Method>(m)
      .def("start", &Method::start, py::arg("q"), py::arg("goal"), Unlocked(), doc("vpAvoidanceMethod::start"))
      .def("setGoal", &Method::setGoal, py::arg("goal"), doc("vpAvoidanceMethod::setGoal"))
      .def("look", &Method::look, Unlocked(), doc("vpAvoidanceMethod::look"))
      .def(
          "step",
          [](Method &self, const vpJointVector &q) {
            vpAvoidanceOutput output;
            self.step(q, output);
            return output;
          },
          py::arg("q"), doc("vpAvoidanceMethod::step"));
  m.def("makeAvoidanceMethod", &vpMakeAvoidanceMethod, py::arg("name"), py::arg("scene"),
        py::arg("spec") = vpAvoidanceMethodSpec(), py::keep_alive<0, 2>(), doc("vpMakeAvoidanceMethod"));
  m.def("avoidanceMethodNames", &vpAvoidanceMethodNames, doc("vpAvoidanceMethodNames"));
  m.def(
      "isWorking", [](const vpAvoidanceOutput &output) { return vpIsWorking(output); }, py::arg("output"),
      doc("vpIsWorking"));
}

void bindSupervisor(py::module_ &m)
{
  using Supervisor = vpStopSupervisor;
  bindEnum<vpSupervision>(m);
  bindStruct<vpSupervisedVelocity>(m).def("message", &vpSupervisedVelocity::message,
                                          doc("vpSupervisedVelocity::message"));
  bindSpec<vpStopSupervisorSpec>(m);
  bindClass<Supervisor>(m)
      .def(py::init<const Scene &, const vpStopSupervisorSpec &>(), py::arg("scene"),
           py::arg("spec") = vpStopSupervisorSpec(), py::keep_alive<1, 2>(), doc("vpStopSupervisor::vpStopSupervisor"))
      .def(
          "step",
          [](Supervisor &self, const vpJointVector &q, const vpJointVector &wish) {
            vpSupervisedVelocity output;
            self.step(q, wish, output);
            return output;
          },
          py::arg("q"), py::arg("wish"), doc("vpStopSupervisor::step"))
      .def("reset", &Supervisor::reset, doc("vpStopSupervisor::reset"));
}
} // namespace

void bindMotion(py::module_ &m)
{
  bindCertificates(m);
  bindPlanners(m);
  bindAvoidance(m);
  bindSupervisor(m);
}
} // namespace visp_python
