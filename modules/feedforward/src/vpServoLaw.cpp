/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpServoLaw.h>

#include "vpServoLaws.h"
#include "vpServoCheck.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
struct Entry {
  const char *id;
  vpServoLaws::Maker make;
  double rotationFactor;
};

const Entry entries[] = {
    {"pbvs1", vpServoLaws::makePbvs1, 1.},           {"pbvs1-rot2", vpServoLaws::makePbvs1, 2.},
    {"pbvs2", vpServoLaws::makePbvs2, 1.},           {"ibvs", vpServoLaws::makeIbvs, 1.},
    {"hybrid25d", vpServoLaws::makeHybrid25d, 1.},   {"kyrki", vpServoLaws::makeKyrki, 1.},
    {"kyrki-rot2", vpServoLaws::makeKyrki, 2.},      {"kyrki-decoupled", vpServoLaws::makeKyrkiDecoupled, 1.},
    {"ff-sum", vpServoLaws::makeFeedforwardSum, 1.}, {"ff-lookat", vpServoLaws::makeLookAt, 2.},
    {"ff-lookat-pi", vpServoLaws::makeLookAtPi, 2.},
};

// Maximum integration step, s: after a pause, or with a wrong clock, an integral would jump to its limit.
constexpr double longestStep = 0.5;

bool isUsable(const vpServoMeasurement &measurement, const vpServoGoal &goal)
{
  if (measurement.points.size() != goal.points.size() || !vpServoCheck::isPose(measurement.cMo)) {
    return false;
  }
  for (const vpServoPoint &point : measurement.points) {
    if (point.visible && !vpServoCheck::isPoint(point)) {
      return false;
    }
  }
  return true;
}
} // namespace

const vpFields<vpServoGains> &vpServoGains::fields()
{
  using Gains = vpServoGains;
  const vpFieldRange positive = vpFieldRange::positive(1e6), notNegative = vpFieldRange::notNegative(1e6);
  static const vpFields<Gains> all = {
      {"lambda", &Gains::lambda, positive, "1/s", "Gain on the translation and on image errors"},
      {"rotation", &Gains::rotation, positive, "", "Factor on the gain of the rotation, beside the law's own"},
      {"kappa", &Gains::kappa, notNegative, "", "Weight of the image term of `ff-sum`"},
      {"saturation", &Gains::saturation, positive, "rad", "Bound c of c tanh(D/c) in `ff-sum`"},
      {"integral", &Gains::integral, notNegative, "1/s^2",
       "Gain on the integral of the rotation error in `ff-lookat-pi`"},
      {"integralLimit", &Gains::integralLimit, positive, "rad/s",
       "Largest angular velocity contributed by the integral"},
  };
  return all;
}

void vpServoGains::validate() const { vpCheckFields(*this, fields(), "the servo gains"); }

vpServoLaw::vpServoLaw(std::string id, const vpServoGains &gains, double rotationFactor)
  : m_id(std::move(id)), m_gains(gains), m_rotationFactor(rotationFactor)
{}

std::unique_ptr<vpServoLaw> vpServoLaw::create(const std::string &id, const vpServoGains &gains)
{
  gains.validate();
  for (const Entry &entry : entries) {
    if (id == entry.id) {
      return entry.make(id, gains, entry.rotationFactor);
    }
  }
  std::string known;
  for (const std::string &name : ids()) {
    known += (known.empty() ? "" : ", ") + name;
  }
  throw vpException(vpException::badValue, "servo law \"%s\" is unknown, known laws are: %s", id.c_str(),
                    known.c_str());
}

const std::vector<std::string> &vpServoLaw::ids()
{
  static const std::vector<std::string> all = []() {
    std::vector<std::string> names;
    for (const Entry &entry : entries) {
      names.emplace_back(entry.id);
    }
    return names;
  }();
  return all;
}

void vpServoLaw::setGoal(const vpServoGoal &goal)
{
  if (goal.points.empty()) {
    throw vpException(vpException::badValue, "the servo goal has 0 points, needs at least 1");
  }
  if (!vpServoCheck::isPose(goal.cdMo)) {
    throw vpException(vpException::badValue,
                      "the servo goal's cdMo is not a finite rigid motion, its translation is (%g, %g, %g) m",
                      goal.cdMo[0][3], goal.cdMo[1][3], goal.cdMo[2][3]);
  }
  const Eigen::Vector3d origin = vpServoPose::translation(goal.cdMo);
  if (origin.z() <= 0.) {
    throw vpException(vpException::badValue, "the object's origin in the servo goal has depth %g m, must be > 0",
                      origin.z());
  }
  for (std::size_t i = 0; i < goal.points.size(); ++i) {
    const vpServoPoint &point = goal.points[i];
    if (!vpServoCheck::isPoint(point)) {
      throw vpException(
          vpException::badValue,
          "point %u of the servo goal is x = %g, y = %g, Z = %g m, must be finite with Z > 0, and at most 1e6",
          static_cast<unsigned int>(i), point.x, point.y, point.Z);
    }
  }
  m_goal = goal;
  m_hasGoal = true;
  goalChanged();
}

void vpServoLaw::reset()
{
  m_goal = vpServoGoal();
  m_hasGoal = false;
  stateReset();
}

double vpServoLaw::rotationGain() const noexcept { return m_gains.lambda * m_rotationFactor * m_gains.rotation; }

vpServoCommand vpServoLaw::step(const vpServoMeasurement &measurement, double dt) noexcept
{
  vpServoCommand command;
  const bool timeUsable = std::isfinite(dt) && dt > 0.;
  if (!m_hasGoal) {
    command.status = vpServoStatus::NoGoal;
  }
  else if (timeUsable && !measurement.valid) {
    command.status = vpServoStatus::Holding;
  }
  else if (!timeUsable || !isUsable(measurement, m_goal)) {
    command.status = vpServoStatus::InvalidInput;
  }
  else {
    command = compute(measurement, std::min(dt, longestStep));
    if (!command.v.isFinite()) {
      command = {vpTwist(), vpServoStatus::Degenerate};
    }
  }
  if (command.status != vpServoStatus::Servoing) {
    notifyInterrupted();
  }
  return command;
}

END_VISP_NAMESPACE
