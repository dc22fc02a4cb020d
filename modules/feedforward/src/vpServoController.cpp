/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpServoController.h>

#include "vpServoCheck.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/feedforward/vpServoCommand.h>
#include <visp3/feedforward/vpServoMeasurement.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// No std::string: a static object elsewhere may create a controller before its initialisation.
constexpr std::string_view filterSuffix = "+cbf";
constexpr double rounding = 1e-6;

bool isSame(const vpTwist &a, const vpTwist &b) { return std::equal(a.data(), a.data() + 6, b.data()); }

// Speed of what is not the law's own twist: with room for the law to end an acceleration, of which it knows the mean over a
// cycle, before the limit.
double belowLimit(double speed, double acceleration, double dt)
{
  constexpr double knot = 0.01; // s, of the laws' commands
  return std::max(0.99 * speed - 0.5 * acceleration * (dt + knot), 0.5 * speed);
}
} // namespace

void vpServoControllerSpec::validate() const
{
  gains.validate();
  motion.validate();
  view.validate();
  recovery.validate();
}

vpServoController::vpServoController(const std::string &id, std::unique_ptr<vpServoLaw> law, bool withFilter,
                                     const vpServoControllerSpec &spec)
  : m_id(id), m_spec(spec), m_law(std::move(law)), m_recovery(spec.recovery)
{
  if (withFilter) {
    m_filter.emplace(spec.view);
  }
  if (m_law->plansMotion()) {
    m_shaper.emplace(spec.motion.shaperLimits());
  }
}

vpServoController vpServoController::create(const std::string &id, const vpServoControllerSpec &spec)
{
  spec.validate();
  const bool withFilter = id.size() > filterSuffix.size() &&
                          id.compare(id.size() - filterSuffix.size(), filterSuffix.size(), filterSuffix) == 0;
  const std::string lawId = withFilter ? id.substr(0, id.size() - filterSuffix.size()) : id;
  auto law = vpServoLaw::create(lawId, spec.gains, spec.motion);
  if (withFilter && law->plansMotion()) {
    throw vpException(
        vpException::badValue,
        "\"%s\": the view filter cannot follow a law that plans; its twists would exceed the limits of the plan, "
        "and bounded ones would not keep the view. Use \"%s\", or the filter behind another law",
        id.c_str(), lawId.c_str());
  }
  return vpServoController(id, std::move(law), withFilter, spec);
}

void vpServoController::reset()
{
  m_law->reset();
  m_recovery.reset();
}

vpServoCommand vpServoController::step(const vpServoMeasurement &measurement, double dt) noexcept
{
  vpServoCommand command = m_law->step(measurement, dt);
  if (m_filter) {
    command = m_filter->filter(command, measurement.outline, dt);
  }
  command = m_recovery.step(command, dt);
  if (command.status != vpServoStatus::Servoing) {
    m_law->notifyInterrupted();
  }
  if (m_shaper) {
    command = bounded(command, dt);
  }
  notifyExecuted(command.v, command.v);
  return command;
}

// Without a measurement the law learns what was executed, and no more.
void vpServoController::pass(double dt) noexcept
{
  if (std::isfinite(dt) && dt > 0.) {
    static_cast<void>(m_law->step(m_unseen, dt));
    remember(dt);
  }
}

void vpServoController::remember(double dt) noexcept
{
  m_before = m_sent;
  m_period = dt;
}

// What is not the law's own twist continues the last one within its limits.
vpServoCommand vpServoController::bounded(vpServoCommand command, double dt) noexcept
{
  const bool timeUsable = std::isfinite(dt) && dt > 0.;
  if (timeUsable && command.status != vpServoStatus::Servoing) {
    const vpServoMotionLimits &limits = m_spec.motion;
    if (!isSame(m_sent, m_shaper->twist())) {
      vpTwist rate;
      for (std::size_t i = 0; i < 6 && m_period > 0.; ++i) {
        rate[i] = (m_sent[i] - m_before[i]) / m_period;
      }
      const bool isJump = !(rate.linearNorm() <= (1. + rounding) * limits.linearAcceleration &&
                            rate.angularNorm() <= (1. + rounding) * limits.angularAcceleration);
      m_shaper->reset(m_sent,
                      isJump ? vpTwist() : rate); // after an emergency stop there is no acceleration to go on with
    }
    command.v = m_shaper->step(vpLimitTwist(command.v, belowLimit(limits.linearVelocity, limits.linearAcceleration, dt),
                                            belowLimit(limits.angularVelocity, limits.angularAcceleration, dt)),
                               dt);
  }
  remember(timeUsable ? dt : 0.);
  return command;
}

void vpServoController::notifyExecuted(const vpTwist &commanded, const vpTwist &moved) noexcept
{
  m_sent = commanded.isFinite() ? commanded : vpTwist();
  m_law->notifyExecuted(commanded, moved);
}

Eigen::Matrix3d vpServoController::referenceRotation(const vpServoMeasurement &measurement,
                                                     const vpServoCommand &command) const noexcept
{
  if (m_law->goal().points.empty()) {
    return Eigen::Matrix3d::Identity();
  }
  const vpServoPose::Error error = vpServoPose::error(m_law->goal().cdMo, measurement.cMo);
  const Eigen::Vector3d w(command.v[3], command.v[4], command.v[5]);
  const Eigen::Matrix3d reference = error.R * vpSO3::exp(w / m_law->rotationGain());
  return reference.allFinite() ? reference : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
}

const char *vpMessage(vpServoStatus status)
{
  switch (status) {
  case vpServoStatus::Servoing:
    return "The law moves the camera.";
  case vpServoStatus::ViewLimited:
    return "The motion was changed to keep the target in the view or within the velocity limits.";
  case vpServoStatus::Deadlock:
    return "Stuck: every motion towards the goal would take the target out of the view.";
  case vpServoStatus::Holding:
    return "The target is lost; standing still and waiting for it.";
  case vpServoStatus::Retreating:
    return "The target is lost; going back along the last good motion.";
  case vpServoStatus::Lost:
    return "The target is lost and was not found on the way back; standing still.";
  case vpServoStatus::NoGoal:
    return "No goal was set.";
  case vpServoStatus::InvalidInput:
    return "The measurement is not usable: not finite, a depth that is not positive, or not the goal's points.";
  case vpServoStatus::Degenerate:
    return "The law has no answer here: too few points, a singular interaction matrix, or no motion within the limits.";
  case vpServoStatus::Diverging:
    return "The law runs away from the target: this way does not lead to the goal.";
  }
  return "Unknown status.";
}

const char *vpToString(vpServoStatus status)
{
  switch (status) {
  case vpServoStatus::Servoing:
    return "Servoing";
  case vpServoStatus::ViewLimited:
    return "ViewLimited";
  case vpServoStatus::Deadlock:
    return "Deadlock";
  case vpServoStatus::Holding:
    return "Holding";
  case vpServoStatus::Retreating:
    return "Retreating";
  case vpServoStatus::Lost:
    return "Lost";
  case vpServoStatus::NoGoal:
    return "NoGoal";
  case vpServoStatus::InvalidInput:
    return "InvalidInput";
  case vpServoStatus::Degenerate:
    return "Degenerate";
  case vpServoStatus::Diverging:
    return "Diverging";
  }
  return "Unknown";
}

vpServoPoint vpServoGoal::mean() const
{
  vpServoPoint sum{0., 0., 0., false};
  unsigned int count = 0;
  for (const vpServoPoint &point : points) {
    if (point.visible) {
      sum.x += point.x;
      sum.y += point.y;
      sum.Z += point.Z;
      ++count;
    }
  }
  if (count == 0) {
    return {0., 0., 1., false};
  }
  return {sum.x / count, sum.y / count, sum.Z / count, true};
}

END_VISP_NAMESPACE
