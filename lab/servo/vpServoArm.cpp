/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoArm.h"

#include "lab/servo/vpServoExperiment.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/manipulator/vpTwistAxes.h>
#include <visp3/simulation/vpFrictionCamera.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double longestPeriod = 0.005;    // s, longest control period of the arm
constexpr double deadbandOfFriction = 0.1; // rad/s: deadband of the plant equivalent to the friction of the arm model
constexpr double noteworthy = 0.5;         // s of slowed motion, or of drives at their limits, that the status reports

const vpArmSample *firstWith(const std::vector<vpArmSample> &samples, vpSimulatedArmStatus status)
{
  const auto found =
      std::find_if(samples.begin(), samples.end(), [status](const vpArmSample &s) { return s.status == status; });
  return found == samples.end() ? nullptr : &*found;
}

std::string namesOf(const vpArmModel &model, unsigned int joints)
{
  std::string names;
  for (int k = 0; k < model.size(); ++k) {
    if (joints >> k & 1U) {
      names += (names.empty() ? "" : ", ") + model.spec().joints[static_cast<std::size_t>(k)].name;
    }
  }
  return names;
}

std::string reasonOf(const vpArmModel &model, const vpArmSample &s)
{
  switch (s.solver) {
  case vpRedundancyStatus::BlockedBySingularity:
    return "the arm cannot move that way in this pose";
  case vpRedundancyStatus::AxisUnreachable:
    return vpAxesInWords(s.unreachableAxes) + " of the camera cannot be commanded, the arm has too few joints";
  case vpRedundancyStatus::Damped:
  case vpRedundancyStatus::Escaping:
    return "near a singularity";
  case vpRedundancyStatus::Scaled:
    return "velocity limits";
  default:
    return "position limits" + (s.stoppedJoints != 0U ? " of " + namesOf(model, s.stoppedJoints) : "");
  }
}

std::string nameOf(const vpArmModel &model, const vpJointShortfall &of)
{
  return of.joint < 0 ? "" : model.spec().joints[static_cast<std::size_t>(of.joint)].name;
}

// Of the saturated drives the one that misses most; relative to the limits, which may be of two units.
void updateShortfall(const vpArmModel &model, const vpArmSample &s, vpJointShortfall &worst)
{
  for (int i = 0; i < model.size(); ++i) {
    const double limit = model.torque()(i);
    const vpJointShortfall here{i, s.needed(i), std::copysign(limit, s.needed(i))};
    const double before = worst.joint < 0 ? 0. : worst.missing() / model.torque()(worst.joint);
    if ((s.saturated >> i & 1U) && here.missing() / limit > before) {
      worst = here;
    }
  }
}

// The most severe limitation of the arm.
std::string describe(const vpArmModel &model, const std::vector<vpArmSample> &samples, const vpArmMetrics &m,
                     double cycle)
{
  char text[256];
  const auto timeOf = [&](const vpArmSample *s) { return static_cast<double>(s - samples.data()) * cycle; };
  if (const vpArmSample *s = firstWith(samples, vpSimulatedArmStatus::NotFollowing)) {
    std::snprintf(text, sizeof(text), "joint %s did not follow its command at %.2f s, the arm held from then on: ",
                  nameOf(model, m.shortfall).c_str(), timeOf(s));
    return text + m.shortfall.message(model);
  }
  const vpArmSample *s = firstWith(samples, vpSimulatedArmStatus::Blocked);
  const bool blocked = s != nullptr;
  if (!blocked && m.saturated_s >= noteworthy && m.shortfall.missing() > 0.) {
    std::snprintf(text, sizeof(text), "drives at their torque limits for %.2f s, joint %s most: ", m.saturated_s,
                  nameOf(model, m.shortfall).c_str());
    return text + m.shortfall.message(model);
  }
  if (!blocked && m.limited_s >= noteworthy) {
    s = firstWith(samples, vpSimulatedArmStatus::Limited);
  }
  if (s == nullptr) {
    return "ok";
  }
  std::snprintf(text, sizeof(text), "%s for %.2f s, first at %.2f s: %s", blocked ? "blocked" : "slowed down",
                blocked ? m.blocked_s : m.limited_s, timeOf(s), reasonOf(model, *s).c_str());
  return text;
}
} // namespace

vpSimulatedArmSpec vpServoArm::forPlant(const vpServoPlant &plant) const
{
  vpSimulatedArmSpec arm = spec;
  const double cycle = 1. / plant.loopRate;
  arm.redundancy.period = cycle / std::max(1., std::ceil(cycle / longestPeriod - 1e-9));
  arm.drives.ideal = plant.lag == 0. && plant.deadband == 0.;
  arm.drives.frictionScale = plant.deadband / deadbandOfFriction;
  arm.clock = vpArmClock::Stepped;
  return arm;
}

vpArmMetrics evaluateArmRun(const vpArmModel &model, const std::vector<vpArmSample> &samples, double cycle)
{
  vpArmMetrics m;
  m.joint_rms.setZero(model.size());
  m.least_limit_margin = std::numeric_limits<double>::infinity();
  if (samples.empty()) {
    m.status = "no cycle was run";
    return m;
  }
  m.least_manipulability = samples.front().manipulability;
  vpJointVector before = vpJointVector::Zero(model.size());
  for (const vpArmSample &s : samples) {
    m.joint_rms += (s.wanted - s.q).cwiseAbs2();
    for (int i = 0; i < model.size(); ++i) {
      const double margin = std::min(s.q(i) - model.lower()(i), model.upper()(i) - s.q(i));
      if (margin < m.least_limit_margin) {
        m.least_limit_margin = margin;
        m.least_margin_joint = i;
      }
    }
    m.peak_velocity_share =
        std::max(m.peak_velocity_share, s.command.cwiseQuotient(model.velocity()).cwiseAbs().maxCoeff());
    m.peak_acceleration_share =
        std::max(m.peak_acceleration_share,
                 (s.command - before).cwiseQuotient(model.acceleration()).cwiseAbs().maxCoeff() / cycle);
    before = s.command;
    m.least_manipulability = std::min(m.least_manipulability, s.manipulability);
    m.self_motion_rad += s.selfMotion * cycle;
    m.limited_s += s.status == vpSimulatedArmStatus::Limited ? cycle : 0.;
    m.blocked_s += s.status == vpSimulatedArmStatus::Blocked ? cycle : 0.;
    m.saturated_s += s.saturated != 0U ? cycle : 0.;
    updateShortfall(model, s, m.shortfall);
  }
  if (const vpArmSample *s = firstWith(samples, vpSimulatedArmStatus::NotFollowing)) {
    m.shortfall = s->lost;
  }
  m.joint_rms = (m.joint_rms / static_cast<double>(samples.size())).cwiseSqrt();
  m.status = describe(model, samples, m, cycle);
  return m;
}

namespace
{
class FreeCamera : public vpServoRobot
{
public:
  explicit FreeCamera(const vpServoPlant &plant) : m_robot(plant), m_velocity(6)
  {
    m_robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  }
  void move(const vpTwist &twist) VP_OVERRIDE
  {
    twist.copyTo(m_velocity);
    m_robot.setVelocity(vpRobot::CAMERA_FRAME, m_velocity);
  }
  vpHomogeneousMatrix wMc() VP_OVERRIDE { return m_robot.getPosition(); }
  vpTwist actual() const VP_OVERRIDE { return m_robot.actualTwist(); }

private:
  vpFrictionCamera m_robot;
  vpColVector m_velocity;
};

class ArmWithCamera : public vpServoRobot
{
public:
  ArmWithCamera(const vpServoArm &arm, const vpServoPlant &plant)
    : m_robot(arm.model, arm.forPlant(plant)), m_cycle(1. / plant.loopRate), m_velocity(6),
      m_start(m_robot.get_fMc().inverse()), m_measured(measuredPose())
  {
    m_robot.setSamplingTime(m_cycle);
    m_robot.setMaxTranslationVelocity(plant.maxLinear);
    m_robot.setMaxRotationVelocity(plant.maxAngular);
    m_robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  }
  void move(const vpTwist &twist) VP_OVERRIDE
  {
    twist.copyTo(m_velocity);
    m_robot.setVelocity(vpRobot::CAMERA_FRAME, m_velocity);
    const vpHomogeneousMatrix now = measuredPose();
    m_actual = vpTwist::fromColVector(vpExponentialMap::inverse(m_measured.inverse() * now, m_cycle));
    m_measured = now;
  }
  vpHomogeneousMatrix wMc() VP_OVERRIDE { return m_start * m_robot.get_fMc(); }
  vpTwist actual() const VP_OVERRIDE { return m_actual; }
  bool sample(vpArmSample &s) const VP_OVERRIDE
  {
    const vpSimulatedArmState state = m_robot.getState();
    const vpArmModel &model = m_robot.getModel();
    s.q = state.q;
    s.velocity = state.velocity;
    s.wanted = state.wanted;
    s.command = state.command;
    s.torque = state.torque;
    s.needed = state.needed;
    s.saturated = state.saturated;
    s.lost = state.lost;
    s.limitMargin = std::min((state.q - model.lower()).minCoeff(), (model.upper() - state.q).minCoeff());
    vpArmData data;
    vpIndexValue index;
    vpArmKinematics::update(model, state.q, data);
    static_cast<void>(vpEvaluateIndex(model, data, vpSelfMotionIndex::manipulability(), index));
    s.manipulability = index.value;
    s.selfMotion = state.solver.selfMotion.norm();
    s.stoppedJoints = state.solver.stoppedJoints;
    s.unreachableAxes = state.solver.unreachableAxes;
    s.status = state.status;
    s.solver = state.solver.status;
    return true;
  }

private:
  vpHomogeneousMatrix measuredPose()
  {
    vpColVector pose;
    m_robot.getPosition(vpRobot::CAMERA_FRAME, pose);
    return vpHomogeneousMatrix(pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]);
  }

  vpSimulatedArm m_robot;
  double m_cycle;
  vpColVector m_velocity;
  vpHomogeneousMatrix m_start, m_measured;
  vpTwist m_actual;
};
} // namespace

std::unique_ptr<vpServoRobot> vpServoRobot::create(const vpServoRunSpec &spec)
{
  if (spec.arm) {
    return std::make_unique<ArmWithCamera>(*spec.arm, spec.plant);
  }
  return std::make_unique<FreeCamera>(spec.plant);
}

END_VISP_NAMESPACE
