/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpVisualServo.h>

#include "vpRigidMotion.h"
#include "vpServoControlSide.h"
#include "vpServoExchange.h"
#include "vpServoVisionSide.h"

#include <visp3/core/vpException.h>

#include <utility>

BEGIN_VISP_NAMESPACE

class vpVisualServo::Impl
{
public:
  Impl(vpServoController controller, const vpVisualServoSpec &spec, const vpArmModel *arm)
    : control(std::move(controller), spec, arm),
      exchange(static_cast<std::size_t>(spec.imageTimeout / spec.period) + 4, spec.maxPoints), vision(spec)
  {}

  vpServoControlSide control;
  vpServoExchange exchange;
  vpServoVisionSide vision;
};

const vpFields<vpVisualServoSpec> &vpVisualServoSpec::fields()
{
  using Spec = vpVisualServoSpec;
  const vpFieldRange positive = vpFieldRange::positive(), notNegative = vpFieldRange::notNegative();
  const vpFieldRange orInfinite{0., std::numeric_limits<double>::infinity(), true, true};
  static const vpFields<Spec> all = {
      {"period", &Spec::period, vpFieldRange::positive(1.), "s", "Period of step()"},
      {"startTime", &Spec::startTime, notNegative, "s", "Time in which the limits of speed rise from 0 at each start"},
      {"imageTimeout", &Spec::imageTimeout, positive, "s", "Oldest image that may be acted on"},
      {"stateTimeout", &Spec::stateTimeout, positive, "s", "Longest time without a robot state"},
      {"longestStep", &Spec::longestStep, positive, "s", "Longest time between two steps"},
      {"positionTolerance", &Spec::positionTolerance, positive, "m", "Position error that counts as converged"},
      {"rotationTolerance", &Spec::rotationTolerance, positive, "rad", "Rotation error that counts as converged"},
      {"convergedTime", &Spec::convergedTime, notNegative, "s",
       "Time within both tolerances after which the task is converged"},
      {"followLength", &Spec::followLength, orInfinite, "m", "Missing motion that counts as not following"},
      {"followAngle", &Spec::followAngle, orInfinite, "rad", "Missing rotation that counts as not following"},
      {"objectChange", &Spec::objectChange, positive, "m/s", "Change of a moving object's velocity in one second"},
      {"objectTurnChange", &Spec::objectTurnChange, positive, "rad/s", "Change of its angular velocity in one second"},
      {"maxPoints", &Spec::maxPoints, {1., 100000.}, "", "Largest number of points of a measurement"},
  };
  return all;
}

void vpVisualServoSpec::validate() const
{
  const char *const owner = "the visual servo";
  vpCheckFields(*this, fields(), owner);
  vpCheckField("number of indices", owner, static_cast<double>(indices.size()), "", {0., vpMaxArmIndices});
  vpCheckField("number of poses to keep", owner, imageTimeout / period, "", {0., vpOdometryBridge::longestPath});
  if (place == vpServoCameraPlace::EyeToHand && (assumeExecuted || objectMoves)) {
    throw vpException(vpException::badValue, "%s of the visual servo is true, must be false for a fixed camera",
                      assumeExecuted ? "assumeExecuted" : "objectMoves");
  }
  if (!vpRigidMotion::isRigid(fMc)) {
    throw vpException(vpException::badValue, "fMc of the visual servo is not a rotation and a finite translation");
  }
}

vpVisualServo::vpVisualServo(vpServoController controller, const vpVisualServoSpec &spec, const vpArmModel *arm)
  : m_impl(std::make_unique<Impl>(std::move(controller), spec, arm))
{}
vpVisualServo::~vpVisualServo() = default;
vpVisualServo::vpVisualServo(vpVisualServo &&) noexcept = default;
vpVisualServo &vpVisualServo::operator=(vpVisualServo &&) noexcept = default;

void vpVisualServo::setVision(std::unique_ptr<vpServoVision> vision) { m_impl->vision.set(std::move(vision)); }

void vpVisualServo::supervise(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec)
{
  m_impl->control.supervise(scene, spec);
}

void vpVisualServo::setController(vpServoController controller)
{
  m_impl->control.setController(std::move(controller));
}

void vpVisualServo::setGoal(const vpServoGoal &goal) { m_impl->vision.setGoal(goal, m_impl->exchange); }

const vpServoSight &vpVisualServo::see(const vpImage<unsigned char> &image, double captureTime)
{
  return m_impl->vision.see(image, captureTime, m_impl->exchange);
}

void vpVisualServo::see(const vpServoSight &sight) { m_impl->vision.see(sight, m_impl->exchange); }

vpServoVision &vpVisualServo::vision() const { return m_impl->vision.vision(); }

bool vpVisualServo::cameraAt(double time, vpRigidTransform &pose) const noexcept
{
  return m_impl->exchange.history.at(time, pose);
}

void vpVisualServo::start() noexcept
{
  m_impl->exchange.epoch.fetch_add(1, std::memory_order_relaxed);
  m_impl->exchange.request.store(vpServoControlSide::Start);
}

void vpVisualServo::stop() noexcept { m_impl->exchange.request.store(vpServoControlSide::Stop); }

const vpVisualServoOutput &vpVisualServo::step(const vpServoRobotState &state, double now) noexcept
{
  return m_impl->control.step(state, now, m_impl->exchange);
}

const vpVisualServoOutput &vpVisualServo::step(const vpJointVector &q, double now) noexcept
{
  vpServoRobotState state;
  state.q = q;
  return step(state, now);
}

const vpVisualServoOutput &vpVisualServo::output() const noexcept { return m_impl->control.output(); }
bool vpVisualServo::isConverged() const noexcept { return output().status == vpVisualServoStatus::Converged; }
const vpServoMeasurement &vpVisualServo::measurement() const noexcept { return m_impl->control.measurement(); }
const vpServoController &vpVisualServo::controller() const noexcept { return m_impl->control.controller(); }
const vpServoTiming &vpVisualServo::timing() const noexcept { return m_impl->exchange.timing; }
const vpVisualServoSpec &vpVisualServo::spec() const noexcept { return m_impl->control.spec(); }

const char *vpToString(vpVisualServoStatus status)
{
  static const char *const words[] = {"Servoing",   "Converged",  "Idle",         "LawStopped",
                                      "Obstructed", "NoImages",   "FrozenImages", "ImageClock",
                                      "LateStep",   "ClockFault", "StateFault",   "NotFollowing"};
  const auto index = static_cast<std::size_t>(status);
  return index < std::size(words) ? words[index] : "Unknown";
}

END_VISP_NAMESPACE
