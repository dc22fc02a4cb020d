/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/feedforward/vpServoLaw.h>

#include "vpRegistry.h"
#include "vpServoCheck.h"
#include "vpServoLaws.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
vpServoLaw::Maker ours(const char *id, vpServoLaws::Maker make, double rotationFactor)
{
  return [=](const vpServoGains &gains, const vpServoMotionLimits &) { return make(id, gains, rotationFactor); };
}

struct Laws : vpRegistry<vpServoLaw::Maker> {
  Laws() : vpRegistry("servo law")
  {
    using namespace vpServoLaws;
    const auto addOurs = [this](const char *id, vpServoLaws::Maker make, double rotationFactor, const char *sentence) {
      add(id, sentence, ours(id, make, rotationFactor));
    };
    addOurs("pbvs1", makePbvs1, 1.,
            "Position-based on the camera's pose: a straight camera path; the object may leave the view.");
    addOurs("pbvs1-rot2", makePbvs1, 2., "pbvs1 with twice the rotation gain.");
    addOurs("pbvs2", makePbvs2, 1.,
            "Position-based on the object's pose: the object's origin moves on a straight line in the camera frame.");
    addOurs("ibvs", makeIbvs, 1.,
            "Image-based on the feature points: nearly straight lines in the image; the camera's path may be long.");
    addOurs("hybrid25d", makeHybrid25d, 1.,
            "Hybrid of Malis: translation by an image point and depth, rotation by pose.");
    addOurs("kyrki", makeKyrki, 1.,
            "Kyrki's law as published: a straight camera path; the rotation holds the object in the image and "
            "compensates the translation.");
    addOurs("kyrki-rot2", makeKyrki, 2., "kyrki with twice the rotation gain.");
    addOurs("kyrki-decoupled", makeKyrkiDecoupled, 1.,
            "kyrki without compensation of the translation: the rotation follows the image error alone, as section "
            "5.4.4 of the thesis may be read.");
    addOurs("ff-sum", makeFeedforwardSum, 1.,
            "The thesis' law, corrected: pbvs1 plus the bearing of the object as a feedforward of the rotation.");
    addOurs("ff-lookat", makeLookAt, lookAtFactor,
            "Feedforward that keeps the camera turned to the object on a straight path; twice the rotation gain.");
    addOurs("ff-lookat-pi", makeLookAtPi, lookAtFactor,
            "ff-lookat with an integral of the rotation error against friction; the default of visp-direct.");
    add("dtg",
        "Direct trajectory generation: a motion of minimum jerk to the goal within limits, the gaze on the object; "
        "planned again when the goal or the measured object has moved.",
        makeDtg);
    add("ff-dtg", "The motion of dtg as a feedforward, and a feedback that keeps the camera on it.",
        makeFeedforwardDtg);
  }
};

Laws &laws()
{
  static Laws all; // at first use: static objects elsewhere may add laws
  return all;
}

// Maximum integration step, s: after a pause, or with a wrong clock, an integral would jump to its limit.
constexpr double longestStep = 0.5;
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
      {"replanPeriod", &Gains::replanPeriod, notNegative, "s",
       "Replanning period of `dtg` and `ff-dtg` (0: at events only)"},
  };
  return all;
}

void vpServoGains::validate() const { vpCheckFields(*this, fields(), "the servo gains"); }

vpServoLaw::vpServoLaw(std::string id, const vpServoGains &gains, double rotationFactor)
  : m_id(std::move(id)), m_gains(gains), m_rotationFactor(rotationFactor)
{}

std::unique_ptr<vpServoLaw> vpServoLaw::create(const std::string &id, const vpServoGains &gains,
                                               const vpServoMotionLimits &motion)
{
  gains.validate();
  motion.validate();
  std::unique_ptr<vpServoLaw> law = laws().find(id)(gains, motion);
  if (!law) {
    throw vpException(vpException::badValue, "the maker of servo law \"%s\" returned none", id.c_str());
  }
  law->m_id = id;
  return law;
}

std::vector<std::string> vpServoLaw::ids() { return laws().ids(); }

std::string vpServoLaw::sentence(const std::string &id) { return laws().sentence(id); }

void vpServoLaw::add(const std::string &id, const std::string &sentence, Maker maker)
{
  laws().add(id, sentence, std::move(maker));
}

void vpServoLaw::setGoal(const vpServoGoal &goal)
{
  vpServoCheck::requireGoal(goal);
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
  if (timeUsable) {
    elapsed(std::min(dt, longestStep));
  }
  if (!m_hasGoal) {
    command.status = vpServoStatus::NoGoal;
  }
  else if (timeUsable && !measurement.valid) {
    command.status = vpServoStatus::Holding;
  }
  else if (!timeUsable || !vpServoCheck::isUsable(measurement, m_goal)) {
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
  notifyExecuted(command.v, command.v);
  return command;
}

END_VISP_NAMESPACE
