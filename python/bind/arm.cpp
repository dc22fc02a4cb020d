/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "arm.h"

#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpArmUrdf.h>
#include <visp3/manipulator/vpTwistAxes.h>

#include <algorithm>

namespace visp_python
{
ArmKinematics::ArmKinematics(const vpArmModel &arm, const vpJointVector &q) : model(&arm)
{
  checkJoints("q", q.size(), arm.size());
  if (!vpArmKinematics::update(arm, q, data)) {
    throw py::value_error("q has a number that is not finite or beyond 1e+09");
  }
}

namespace
{
void bindArmSpec(py::module_ &m)
{
  bindEnum<vpJointType>(m);
  bindEnum<vpArmShapeKind>(m);
  bindStruct<vpArmJointSpec>(m)
      .def_static("standardDH", &vpArmJointSpec::standardDH, py::arg("a"), py::arg("alpha"), py::arg("d"),
                  py::arg("offset"), doc("vpArmJointSpec::standardDH"))
      .def_static("modifiedDH", &vpArmJointSpec::modifiedDH, py::arg("a"), py::arg("alpha"), py::arg("d"),
                  py::arg("offset"), doc("vpArmJointSpec::modifiedDH"));
  bindStruct<vpArmFollower>(m);
  bindStruct<vpArmChainJoint>(m);
  bindStruct<vpArmLinkSpec>(m);
  bindStruct<vpArmBody>(m);
  bindStruct<vpArmShape>(m);
  bindStruct<vpArmCapsule>(m);
  bindStruct<vpArmSpec>(m);
  bindStruct<vpArmUrdfSpec>(m);
}

void bindModel(py::module_ &m)
{
  using Model = vpArmModel;
  constexpr auto copy = py::return_value_policy::copy;
  bindClass<Model>(m)
      .def(py::init<const vpArmSpec &>(), py::arg("spec"), doc("vpArmModel::vpArmModel"))
      .def("size", &Model::size, doc("vpArmModel::size"))
      .def("links", &Model::links, doc("vpArmModel::links"))
      .def(
          "chain",
          [](const Model &self, int k) { return self.chain(checkedIndex(k, self.links(), "joint of the chain")); },
          py::arg("k"), doc("vpArmModel::chain"))
      .def("toolLink", &Model::toolLink, doc("vpArmModel::toolLink"))
      .def("cameraLink", &Model::cameraLink, doc("vpArmModel::cameraLink"))
      .def("spec", &Model::spec, copy, doc("vpArmModel::spec"))
      .def("label", &Model::label, doc("vpArmModel::label"))
      .def("lower", &Model::lower, copy, doc("vpArmModel::lower"))
      .def("upper", &Model::upper, copy, doc("vpArmModel::upper"))
      .def("velocity", &Model::velocity, copy, doc("vpArmModel::velocity"))
      .def("acceleration", &Model::acceleration, copy, doc("vpArmModel::acceleration"))
      .def("torque", &Model::torque, copy, doc("vpArmModel::torque"))
      .def("home", &Model::home, copy, doc("vpArmModel::home"))
      .def(
          "isPrismatic",
          [](const Model &self, int i) { return self.isPrismatic(checkedIndex(i, self.size(), "joint")); },
          py::arg("i"), doc("vpArmModel::isPrismatic"))
      .def(
          "isContinuous",
          [](const Model &self, int i) { return self.isContinuous(checkedIndex(i, self.size(), "joint")); },
          py::arg("i"), doc("vpArmModel::isContinuous"))
      .def("hasMasses", &Model::hasMasses, doc("vpArmModel::hasMasses"))
      .def(
          "outsideLimits",
          [](const Model &self, const vpJointVector &q) {
            checkJoints("q", q.size(), self.size());
            return self.outsideLimits(q);
          },
          py::arg("q"), doc("vpArmModel::outsideLimits"))
      .def(
          "requireMotionLimits",
          [](const Model &self, const std::string &user) { self.requireMotionLimits(user.c_str()); }, py::arg("user"),
          doc("vpArmModel::requireMotionLimits"));
  m.def("loadArmJson", &vpLoadArmJson, py::arg("file"), Unlocked(), doc("vpLoadArmJson"));
  m.def("loadArmUrdf", &vpLoadArmUrdf, py::arg("file"), py::arg("spec") = vpArmUrdfSpec(), Unlocked(),
        doc("vpLoadArmUrdf"));
}

void bindKinematics(py::module_ &m)
{
  using K = ArmKinematics;
  namespace kinematics = vpArmKinematics;
  const std::string in = "vpArmKinematics::";
  bindEnum<vpArmFrame>(m);
  Bound<K>(m, "ArmKinematics",
           "Kinematics of an arm in one configuration. Joints are numbered from 0, links from 1; link 0 is the base.")
      .def(py::init<const vpArmModel &, const vpJointVector &>(), py::arg("model"), py::arg("q"),
           py::keep_alive<1, 2>(), "model: the arm. q: configuration, n finite numbers, rad or m.")
      .def_property_readonly(
          "q", [](const K &self) { return self.data.q; }, "Configuration, rad or m.")
      .def_property_readonly(
          "tool", [](const K &self) { return self.data.tool; }, "fMe: end effector in the base.")
      .def_property_readonly(
          "camera", [](const K &self) { return kinematics::camera(*self.model, self.data); }, doc(in + "camera"))
      .def(
          "joint",
          [](const K &self, int i) {
            return self.data.joint[static_cast<std::size_t>(checkedIndex(i, self.model->links(), "joint"))];
          },
          py::arg("i"),
          "Frame of joint or follower i of the chain in the base; z is its axis, the frame moves with its link.")
      .def(
          "link",
          [](const K &self, int i) {
            return kinematics::link(*self.model, self.data, checkedIndex(i, self.model->links() + 1, "link"));
          },
          py::arg("i"), doc(in + "link"))
      .def(
          "geometric",
          [](const K &self, vpArmFrame frame) { return kinematics::geometric(*self.model, self.data, frame); },
          py::arg("frame") = vpArmFrame::Base, doc(in + "geometric"))
      .def(
          "analytic", [](const K &self) { return kinematics::analytic(*self.model, self.data); }, doc(in + "analytic"))
      .def(
          "pointJacobian",
          [](const K &self, int k) {
            return kinematics::pointJacobian(*self.model, self.data, checkedIndex(k, self.model->links() + 1, "joint"));
          },
          py::arg("k"), doc(in + "pointJacobian"))
      .def(
          "derivative",
          [](const K &self, int k, vpArmFrame frame) {
            return kinematics::derivative(*self.model, self.data, checkedIndex(k, self.model->size(), "joint"), frame);
          },
          py::arg("k"), py::arg("frame") = vpArmFrame::Base, doc(in + "derivative"))
      .def(
          "timeDerivative",
          [](const K &self, const vpJointVector &velocity, vpArmFrame frame) {
            checkJoints("velocity", velocity.size(), self.model->size());
            return kinematics::timeDerivative(*self.model, self.data, velocity, frame);
          },
          py::arg("velocity"), py::arg("frame") = vpArmFrame::Base, doc(in + "timeDerivative"))
      .def(
          "evaluate",
          [](const K &self, const vpSelfMotionIndex &index) {
            index.validate(*self.model);
            vpIndexValue value;
            return vpEvaluateIndex(*self.model, self.data, index, value) ? std::optional<vpIndexValue>(value)
                                                                         : std::nullopt;
          },
          py::arg("index"),
          "Value and exact gradient of an index; None where it has no gradient (singular pose, joint at the point).");
}

void bindIndex(py::module_ &m)
{
  using Index = vpSelfMotionIndex;
  const std::string in = "vpSelfMotionIndex::";
  bindEnum<vpIndexSense>(m);
  bindEnum<vpIndexKind>(m);
  bindStruct<vpIndexValue>(m);
  bindStruct<Index>(m)
      .def_static("manipulability", &Index::manipulability, py::arg("gain") = 1., doc(in + "manipulability"))
      .def_static("weightedManipulability", &Index::weightedManipulability, py::arg("weights"), py::arg("taskLength"),
                  py::arg("gain") = 1., doc(in + "weightedManipulability"))
      .def_static("pointDistance", &Index::pointDistance, py::arg("joint"), py::arg("point"), py::arg("sense"),
                  py::arg("gain") = 1., py::arg("range") = 0.2, doc(in + "pointDistance"))
      .def_static("lineDistance", &Index::lineDistance, py::arg("joint"), py::arg("sense"), py::arg("gain") = 1.,
                  py::arg("range") = 0.2, doc(in + "lineDistance"))
      .def_static("planeDistance", &Index::planeDistance, py::arg("joint"), py::arg("point"), py::arg("normal"),
                  py::arg("sense"), py::arg("gain") = 1., py::arg("range") = 0.2, doc(in + "planeDistance"))
      .def_static("jointLimits", &Index::jointLimits, py::arg("gain") = 1., doc(in + "jointLimits"))
      .def_static("posture", &Index::posture, py::arg("reference"), py::arg("gain") = 1., doc(in + "posture"))
      .def("validate", &Index::validate, py::arg("model"), doc(in + "validate"));
}

// A fixed array with a count, as a list.
template <class Input, class T, std::size_t N>
void bindList(Bound<Input> &bound, const char *name, std::array<T, N> Input::*values, const char *countName,
              int Input::*count, const char *text)
{
  bound.def_property_readonly(
      countName, [count](const Input &self) { return self.*count; }, "Set by the list.");
  bound.def_property(
      name,
      [=](const Input &self) {
        const auto first = (self.*values).begin();
        return py::tuple(py::cast(std::vector<T>(first, first + std::clamp(self.*count, 0, static_cast<int>(N)))));
      },
      [=](Input &self, const std::vector<T> &given) {
        if (given.size() > N) {
          throw py::value_error(std::to_string(given.size()) + " " + name + " were given, must be at most " +
                                std::to_string(N));
        }
        std::copy(given.begin(), given.end(), (self.*values).begin());
        self.*count = static_cast<int>(given.size());
      },
      text);
}

void bindRedundancy(py::module_ &m)
{
  using Solver = vpRedundancySolver;
  bindEnum<vpLimitPolicy>(m);
  bindEnum<vpRedundancyStatus>(m);
  bindSpec<vpRedundancySpec>(m, py::arg("model"));
  bindStruct<vpArmTask>(m).def_static(
      "pointVelocity",
      [](const ArmKinematics &kinematics, int joint, const Eigen::Vector3d &velocity) {
        checkedIndex(joint, kinematics.model->size(), "joint");
        return vpArmTask::pointVelocity(*kinematics.model, kinematics.data, joint, velocity);
      },
      py::arg("kinematics"), py::arg("joint"), py::arg("velocity"), doc("vpArmTask::pointVelocity"));
  auto input = bindStruct<vpRedundancyInput>(m);
  bindList(input, "tasks", &vpRedundancyInput::tasks, "taskCount", &vpRedundancyInput::taskCount,
           "Tasks below the main one, in order of priority, at most 3.");
  bindList(input, "indices", &vpRedundancyInput::indices, "indexCount", &vpRedundancyInput::indexCount,
           "The remaining redundancy maximizes the sum of gain times index; at most 8.");
  bindStruct<vpRedundancyOutput>(m).def("message", &vpRedundancyOutput::message, doc("vpRedundancyOutput::message"));
  bindClass<Solver>(m)
      .def(py::init<const vpArmModel &, const vpRedundancySpec &>(), py::arg("model"),
           py::arg("spec") = vpRedundancySpec(), py::keep_alive<1, 2>(), doc("vpRedundancySolver::vpRedundancySolver"))
      .def(
          "step",
          [](const Solver &self, const ArmKinematics &kinematics, const vpRedundancyInput &given) {
            vpRedundancyOutput output;
            self.step(kinematics.data, given, output);
            return output;
          },
          py::arg("kinematics"), py::arg("input"),
          "One control period: joint velocities in this configuration, and how they differ from the request.")
      .def("spec", &Solver::spec, py::return_value_policy::copy, doc("vpRedundancySolver::spec"));
}

void bindArmMotion(py::module_ &m)
{
  using Motion = vpArmMotion;
  bindEnum<vpClosedLoopStatus>(m);
  bindSpec<vpClosedLoopSpec>(m, py::arg("period"));
  bindEnum<vpArmTaskKind>(m);
  bindEnum<vpArmTwistFrame>(m);
  const std::string in = "vpArmMotion::";
  Bound<ArmMotion>(m, "ArmMotion", doc("vpArmMotion"))
      .def(py::init<const vpArmModel &, const vpRedundancySpec &, const vpClosedLoopSpec &>(), py::arg("model"),
           py::arg("redundancy") = vpRedundancySpec(), py::arg("closedLoop") = vpClosedLoopSpec(),
           py::keep_alive<1, 2>(), doc(in + "vpArmMotion"))
      .def("hold", &Motion::hold, doc(in + "hold"))
      .def(
          "jointVelocity",
          [](ArmMotion &self, const vpJointVector &velocity) {
            self.jointVelocity(self.fitting("velocity", velocity));
          },
          py::arg("velocity"), doc(in + "jointVelocity"))
      .def("twist", &Motion::twist, py::arg("twist"), py::arg("frame"), doc(in + "twist"))
      .def(
          "jointPath",
          [](ArmMotion &self, const vpJointVector &goal, const vpJointVector &q, const vpJointVector &velocity,
             double share) {
            self.jointPath(self.fitting("goal", goal), self.fitting("q", q), self.fitting("velocity", velocity), share);
          },
          py::arg("goal"), py::arg("q"), py::arg("velocity"), py::arg("share") = 1., doc(in + "jointPath"))
      .def(
          "posePath",
          [](ArmMotion &self, const vpRigidTransform &goal, const vpJointVector &q, const vpJointVector &velocity) {
            self.posePath(goal, self.fitting("q", q), self.fitting("velocity", velocity));
          },
          py::arg("goal"), py::arg("q"), py::arg("velocity"), doc(in + "posePath"))
      .def("setSelfMotion", &Motion::setSelfMotion, py::arg("indices"), py::arg("free"), doc(in + "setSelfMotion"))
      .def(
          "step",
          [](ArmMotion &self, const vpJointVector &q, const vpJointVector &velocity) {
            return self.step(self.fitting("q", q), self.fitting("velocity", velocity));
          },
          py::arg("q"), py::arg("velocity"), doc(in + "step"))
      .def("kind", &Motion::kind, doc(in + "kind"))
      .def("finished", &Motion::finished, doc(in + "finished"))
      .def("failed", &Motion::failed, doc(in + "failed"))
      .def("pathSentence", &Motion::pathSentence, doc(in + "pathSentence"))
      .def("poseStatus", &Motion::poseStatus, doc(in + "poseStatus"))
      .def("solver", &Motion::solver, py::return_value_policy::copy, doc(in + "solver"))
      .def("period", &Motion::period, doc(in + "period"));
}

// A result that is valid.
template <class Result> Result answered(bool valid, const Result &result)
{
  if (!valid) {
    throw py::value_error(
        "the dynamics have no result: a vector has not one finite number below 1e+09 for each joint, or the result is "
        "not finite");
  }
  return result;
}

void bindDynamics(py::module_ &m)
{
  using Dynamics = vpArmDynamics;
  const std::string in = "vpArmDynamics::";
  bindClass<Dynamics>(m)
      .def(py::init<const vpArmModel &, const Eigen::Vector3d &>(), py::arg("model"),
           py::arg("gravity") = Eigen::Vector3d(0., 0., -9.81), doc(in + "vpArmDynamics"))
      .def(
          "inertia",
          [](Dynamics &self, const vpJointVector &q) {
            vpJointMatrix M;
            return answered(self.inertia(q, M), M);
          },
          py::arg("q"), doc(in + "inertia"))
      .def(
          "coriolis",
          [](Dynamics &self, const vpJointVector &q, const vpJointVector &velocity) {
            vpJointVector torque;
            return answered(self.coriolis(q, velocity, torque), torque);
          },
          py::arg("q"), py::arg("velocity"), doc(in + "coriolis"))
      .def(
          "gravity",
          [](Dynamics &self, const vpJointVector &q) {
            vpJointVector torque;
            return answered(self.gravity(q, torque), torque);
          },
          py::arg("q"), doc(in + "gravity"))
      .def(
          "acceleration",
          [](Dynamics &self, const vpJointVector &q, const vpJointVector &velocity, const vpJointVector &torque) {
            vpJointVector acceleration;
            return answered(self.acceleration(q, velocity, torque, acceleration), acceleration);
          },
          py::arg("q"), py::arg("velocity"), py::arg("torque"),
          "Joint accelerations q'' = M^-1 (torque - C q' - g), rad/s^2 or m/s^2. Include friction in torque.");
}
} // namespace

void bindArm(py::module_ &m)
{
  bindArmSpec(m);
  bindModel(m);
  bindIndex(m);
  bindKinematics(m);
  bindRedundancy(m);
  bindArmMotion(m);
  bindDynamics(m);
  m.def("freeAxes", &vpFreeAxes, py::arg("names"), doc("vpFreeAxes"));
  m.def(
      "axesInWords", [](unsigned int axes) { return vpAxesInWords(axes); }, py::arg("axes"), doc("vpAxesInWords"));
}
} // namespace visp_python
