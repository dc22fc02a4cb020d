/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpFeedforwardTask.h>

#include "vpServoCheck.h"

#include <visp3/core/vpException.h>
#include <visp3/feedforward/vpServoCommand.h>

#include <algorithm>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
// Before the base class exists: ViSP warns about a task that was set up and not used.
vpServo::vpServoType checked(const std::string &law, const vpServoGains &gains, vpServo::vpServoType type)
{
  const std::vector<std::string> &known = vpFeedforwardTask::laws();
  if (std::find(known.begin(), known.end(), law) == known.end()) {
    throw vpException(vpException::badValue,
                      "servo law \"%s\" has no features for vpServo, those that have are: %s, %s", law.c_str(),
                      known[0].c_str(), known[1].c_str());
  }
  gains.validate();
  if (type == vpServo::NONE) {
    throw vpException(vpException::badValue, "the type of the feedforward task is vpServo::NONE, must be another");
  }
  return type;
}
} // namespace

vpFeedforwardTask::vpFeedforwardTask(const std::string &law, const vpServoGains &gains, vpServoType type)
  : vpServo(checked(law, gains, type)), m_isLookAt(law == laws()[1]), m_position(vpFeatureTranslation::cdMc),
    m_sum(gains), m_gaze(gains)
{
  setServo(type);
  setPseudoInverseThreshold(1e-6); // the documented default; this constructor of ViSP 3.5 leaves it uninitialised
  setInteractionMatrixType(CURRENT, PSEUDO_INVERSE);
  setLambda(gains.lambda);
  addFeature(m_position);
  addFeature(m_isLookAt ? static_cast<vpBasicFeature &>(m_gaze) : m_sum);
}

vpFeedforwardTask::~vpFeedforwardTask() { kill(); }

const std::vector<std::string> &vpFeedforwardTask::laws()
{
  static const std::vector<std::string> all{"ff-sum", "ff-lookat"};
  return all;
}

void vpFeedforwardTask::setGoal(const vpServoGoal &goal)
{
  vpServoCheck::requireGoal(goal);
  m_goal = goal;
}

void vpFeedforwardTask::see(const vpServoMeasurement &measurement)
{
  if (m_goal.points.empty()) {
    throw vpException(vpException::notInitialized, vpMessage(vpServoStatus::NoGoal));
  }
  if (!measurement.valid) {
    throw vpException(vpException::badValue, "the target was not found");
  }
  if (!vpServoCheck::isUsable(measurement, m_goal)) {
    throw vpException(vpException::badValue, vpMessage(vpServoStatus::InvalidInput));
  }
  const vpHomogeneousMatrix cdMc = m_goal.cdMo * measurement.cMo.inverse();
  if (m_isLookAt) {
    m_gaze.buildFrom(cdMc, m_goal.cdMo);
  }
  else {
    m_sum.buildFrom(cdMc, measurement.points, m_goal.points);
  }
  m_position.buildFrom(cdMc);
}

vpColVector vpFeedforwardTask::computeControlLaw(const vpServoMeasurement &measurement)
{
  see(measurement);
  return vpServo::computeControlLaw();
}

END_VISP_NAMESPACE
