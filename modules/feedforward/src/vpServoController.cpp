/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpServoController.h>

#include "vpServoPose.h"

#include <visp3/direct_core/vpSO3.h>

#include <string_view>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// No std::string: a static object elsewhere may create a controller before its initialisation.
constexpr std::string_view filterSuffix = "+cbf";
} // namespace

void vpServoControllerSpec::validate() const
{
  gains.validate();
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
}

vpServoController vpServoController::create(const std::string &id, const vpServoControllerSpec &spec)
{
  spec.validate();
  const bool withFilter = id.size() > filterSuffix.size() &&
                          id.compare(id.size() - filterSuffix.size(), filterSuffix.size(), filterSuffix) == 0;
  const std::string lawId = withFilter ? id.substr(0, id.size() - filterSuffix.size()) : id;
  return vpServoController(id, vpServoLaw::create(lawId, spec.gains), withFilter, spec);
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
  return command;
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

END_VISP_NAMESPACE
