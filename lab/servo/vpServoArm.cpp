/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoArm.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double longestPeriod = 0.005;    // s, longest control period of the arm
constexpr double deadbandOfFriction = 0.1; // rad/s: deadband of the plant equivalent to the friction of the arm model
constexpr double noteworthy = 0.5;         // s of slowed motion that the status reports

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
  case vpRedundancyStatus::Damped:
  case vpRedundancyStatus::Escaping:
    return "near a singularity";
  case vpRedundancyStatus::Scaled:
    return "velocity limits";
  default:
    return "position limits" + (s.stoppedJoints != 0U ? " of " + namesOf(model, s.stoppedJoints) : "");
  }
}

// The most severe limitation of the arm.
std::string describe(const vpArmModel &model, const std::vector<vpArmSample> &samples, const vpArmMetrics &m,
                     double cycle)
{
  char text[256];
  const auto timeOf = [&](const vpArmSample *s) { return static_cast<double>(s - samples.data()) * cycle; };
  if (const vpArmSample *s = firstWith(samples, vpSimulatedArmStatus::NotFollowing)) {
    std::snprintf(text, sizeof(text), "a joint did not follow its command at %.2f s, the arm held from then on",
                  timeOf(s));
    return text;
  }
  const vpArmSample *s = firstWith(samples, vpSimulatedArmStatus::Blocked);
  const bool blocked = s != nullptr;
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
  }
  m.joint_rms = (m.joint_rms / static_cast<double>(samples.size())).cwiseSqrt();
  m.status = describe(model, samples, m, cycle);
  return m;
}

END_VISP_NAMESPACE
