/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpServoControlSide.h"

#include "vpApproachSpeed.h"
#include "vpRigidMotion.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpTwistAxes.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
using Status = vpVisualServoStatus;

constexpr double timeTolerance = 1e-9; // s
// A law's twist of which the bounds leave less counts as interrupted, for the laws with an integral.
constexpr double toleratedShare = 0.1;
constexpr double slowest = 1e-4; // m/s and rad/s

vpVisualServoSpec checked(const vpVisualServoSpec &spec, const vpArmModel *arm)
{
  spec.validate();
  vpVisualServoSpec result = spec;
  result.redundancy.period = spec.period;
  if (arm) {
    result.redundancy.validate(*arm);
  }
  return result;
}

// Factor for plans: motions from rest with its square as factor on the accelerations stay below speeds that rise in this time, s.
double startFactor(const vpServoMotionLimits &motion, double time)
{
  const double rise =
      std::min(motion.linearVelocity / motion.linearAcceleration, motion.angularVelocity / motion.angularAcceleration);
  return time > rise ? std::sqrt(rise / time) : 1.;
}

bool isZero(const vpTwist &twist) { return twist.linearNorm() == 0. && twist.angularNorm() == 0.; }
} // namespace

vpServoControlSide::vpServoControlSide(vpServoController controller, const vpVisualServoSpec &spec,
                                       const vpArmModel *arm)
  : m_spec(checked(spec, arm)), m_controller(std::move(controller)), m_arm(arm),
    m_odometry(spec.imageTimeout, 1. / spec.period), m_shaper(m_controller.spec().motion.shaperLimits())
{
  if (arm) {
    m_motion.emplace(*arm, m_spec.redundancy, vpClosedLoopSpec());
    m_q = arm->home();
    m_output.velocity.setZero(arm->size());
    m_jointRate = m_lastVelocity = m_output.velocity;
  }
  // Memory for all later measurements and goals.
  vpServoMeasurement largest;
  largest.points.resize(m_spec.maxPoints);
  largest.outline.resize(m_spec.maxPoints);
  m_measurement = largest;
  m_measurement.valid = false;
  static_cast<void>(m_odometry.correct(largest));
  m_goal.points.resize(m_spec.maxPoints);
  setController(std::move(m_controller));
}

void vpServoControlSide::supervise(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec)
{
  if (!m_arm) {
    throw vpException(vpException::badValue, "a supervisor needs an arm's model, and the visual servo has none");
  }
  vpStopSupervisorSpec stop = spec;
  stop.period = m_spec.period;
  m_supervisor.emplace(scene, stop);
}

void vpServoControlSide::setController(vpServoController controller)
{
  m_controller = std::move(controller);
  m_shaper.setLimits(m_controller.spec().motion.shaperLimits());
  vpServoGoal largest; // for its memory; without m_hasGoal the law is not stepped
  largest.cdMo[2][3] = 1.;
  largest.points.resize(m_spec.maxPoints);
  m_controller.setGoal(largest);
  m_plans = m_controller.law().plansMotion();
  m_tool.reset();
  if (m_plans && !isInHand()) {
    m_tool.emplace();
    m_controller.setGoal(m_tool->goal());
  }
  else if (m_hasGoal) {
    m_controller.setGoal(m_goal);
  }
  m_startFactor = startFactor(m_controller.spec().motion, m_spec.startTime);
  if (m_plans && m_arm) {
    m_check.emplace(*m_arm, m_spec.redundancy, m_spec.indices, m_spec.free, vpJointVector(),
                    isInHand() ? vpArmFrame::Camera : vpArmFrame::EndEffector);
    m_controller.setMotionCheck(&*m_check);
  }
}

void vpServoControlSide::follow(Request request, vpServoExchange &exchange) noexcept
{
  if (request == Start && !(m_isRunning && m_fault == Status::Servoing)) {
    m_isRunning = true;
    m_watchdog.reset();
    m_object.isKnown = false;
    m_fault = Status::Servoing;
    m_within = 0.;
    m_hasImage = m_isFrozen = m_isFuture = false;
    m_notBefore = -std::numeric_limits<double>::infinity();
    m_poseTime = m_time;
    m_badStamps = exchange.badStamps.load(std::memory_order_relaxed);
  }
  else if (request == Stop) {
    m_isRunning = false;
  }
}

// Sets m_step. False: the clock is of no use in this step.
bool vpServoControlSide::checkClock(double now, vpServoExchange &exchange) noexcept
{
  const double step = now - m_time;
  const bool isFirst = !m_hasClock, isRight = std::isfinite(now) && (isFirst || step > 0.);
  m_step = m_spec.period;
  if (!isRight) {
    fail(Status::ClockFault);
  }
  else if (!isFirst && step > m_spec.longestStep) {
    m_notBefore = now;
  }
  else if (!isFirst) {
    m_step = step;
  }
  if (!isRight || m_notBefore == now) {
    exchange.history.clear();
  }
  if (!isRight) {
    m_odometry.move(vpTwist(), std::numeric_limits<double>::quiet_NaN()); // forgets its path
  }
  if (isRight && !isFirst) {
    exchange.timing.period.add(step);
    exchange.timing.jitter.add(std::abs(step - m_spec.period));
  }
  if (std::isfinite(now)) {
    m_time = now;
    m_poseTime = isFirst || !isRight ? now : m_poseTime;
    m_hasClock = true;
  }
  return isRight;
}

bool vpServoControlSide::readPose(const vpServoRobotState &state, vpRigidTransform &camera) noexcept
{
  const bool isStale = m_time - state.time > m_spec.stateTimeout; // NaN: not
  if (m_spec.assumeExecuted && !m_arm) {
    camera = m_camera * vpRigidMotion::exp(m_output.twist.scaled(m_step));
    return true;
  }
  if (!state.valid || isStale) {
    return false;
  }
  if (m_arm) {
    if (!vpArmKinematics::update(*m_arm, state.q, m_data)) {
      return false;
    }
    m_q = state.q;
    camera = isInHand() ? vpArmKinematics::camera(*m_arm, m_data) : m_data.tool.inverse() * m_spec.fMc;
    return true;
  }
  camera = isInHand() ? state.pose : state.pose.inverse() * m_spec.fMc;
  return vpRigidMotion::isRigid(state.pose);
}

// Motion of the camera expected from the last command, in its frame: a twist times the time.
vpTwist vpServoControlSide::expectedMotion() const noexcept
{
  if (!m_arm) {
    const vpTwist motion = m_output.twist.scaled(m_step);
    return isInHand() ? motion : vpRigidMotion::changed(m_camera.inverse(), motion).scaled(-1.);
  }
  vpArmData data;
  if (!vpArmKinematics::forward(*m_arm, m_q + m_step * m_output.velocity, data)) {
    return {};
  }
  const vpRigidTransform camera = isInHand() ? vpArmKinematics::camera(*m_arm, data) : data.tool.inverse() * m_spec.fMc;
  return vpRigidMotion::log(m_camera.inverse() * camera);
}

// Velocity of a camera that would move with the object, in the camera frame.
vpTwist vpServoControlSide::objectInCamera() const noexcept
{
  if (!m_object.isKnown) {
    return {};
  }
  const vpTwist &V = m_output.objectVelocity;
  const Eigen::Vector3d w = vpRigidMotion::angular(V);
  const vpHomogeneousMatrix &cMo = m_measurement.cMo;
  const Eigen::Vector3d fromObject = -(m_camera.R * Eigen::Vector3d(cMo[0][3], cMo[1][3], cMo[2][3]));
  const Eigen::Matrix3d cRf = m_camera.R.transpose();
  return vpRigidMotion::twist(cRf * (vpRigidMotion::linear(V) + w.cross(fromObject)), cRf * w);
}

// The first fault stays.
void vpServoControlSide::fail(Status fault) noexcept { m_fault = m_fault == Status::Servoing ? fault : m_fault; }

void vpServoControlSide::watchMotion(const vpTwist &observed, bool isComplete) noexcept
{
  if (!m_isRunning || m_spec.assumeExecuted || !isComplete) {
    m_watchdog.reset();
    return;
  }
  m_watchdog.observe(observed);
  if (!m_watchdog.isFollowing(m_spec.followLength, m_spec.followAngle)) {
    fail(Status::NotFollowing);
  }
}

// The camera's pose, and its motion since the last one.
bool vpServoControlSide::updatePose(const vpServoRobotState &state, bool isClockRight,
                                    vpServoExchange &exchange) noexcept
{
  m_watchdog.pass(m_step);
  if (m_hasPose) {
    m_watchdog.command(expectedMotion());
  }
  vpRigidTransform camera;
  if (!readPose(state, camera)) {
    if (m_arm) {
      m_q += m_step * m_output.velocity;
    }
    if (m_time - m_poseTime > m_spec.stateTimeout) {
      fail(Status::StateFault);
    }
    return false;
  }
  const double gap = m_time - m_poseTime;
  const vpTwist moved = m_hasPose ? vpRigidMotion::log(m_camera.inverse() * camera) : vpTwist();
  watchMotion(moved, gap <= 1.5 * m_step);
  if (isClockRight) {
    const vpTwist executed = gap > 0. ? moved.scaled(1. / gap) : vpTwist();
    m_executed = vpRigidMotion::sum(executed, objectInCamera().scaled(-1.));
    m_odometry.move(m_executed, m_time);
    exchange.history.add(m_time, camera);
  }
  m_camera = camera;
  m_poseTime = m_time;
  m_hasPose = true;
  return true;
}

// The goal was validated by the vision thread, and there is memory for it.
void vpServoControlSide::setGoal(const vpServoGoal &goal) noexcept
{
  m_goal = goal;
  m_hasGoal = true;
  if (!m_tool) {
    m_controller.setGoal(m_goal);
  }
}

void vpServoControlSide::takeSight(vpServoExchange &exchange) noexcept
{
  if (!exchange.sights.fetch()) {
    return;
  }
  const vpServoParcel &parcel = exchange.sights.front();
  const double time = parcel.sight.measurement.time;
  m_isFuture = time > m_time + timeTolerance;
  m_isFrozen = parcel.isFrozen;
  if (m_isFuture || m_isFrozen || !m_odometry.correct(parcel.sight.measurement)) {
    return;
  }
  if (parcel.sight.hasGoal) {
    setGoal(parcel.sight.goal);
  }
  m_hasImage = true;
  m_imageTime = time;
  m_badStamps = exchange.badStamps.load(std::memory_order_relaxed);
  m_sightFactor = parcel.sight.speedFactor;
  followObject(parcel.object);
  m_output.distance = parcel.sight.distance;
  m_output.distanceSigma = parcel.sight.distanceSigma;
  exchange.timing.latency.add(m_time - time);
}

// None of an estimated velocity within two standard deviations, so that the noise of an object at rest moves nothing, all of
// it from four on.
void vpServoControlSide::followObject(const vpObjectMotion &object) noexcept
{
  const auto share = [](double speed, double sigma) { return std::clamp(0.5 * speed / sigma - 1., 0., 1.); };
  m_object = object;
  m_output.objectVelocity = vpRigidMotion::twist(share(object.v.norm(), object.vSigma) * object.v,
                                                 share(object.w.norm(), object.wSigma) * object.w);
  m_output.objectSigma = object.vSigma;
  m_output.objectTurnSigma = object.wSigma;
}

// Whether the images allow to move.
vpVisualServoStatus vpServoControlSide::judgeImages(const vpServoExchange &exchange) const noexcept
{
  if (m_isFrozen) {
    return Status::FrozenImages;
  }
  if (m_hasImage && m_imageTime < m_notBefore && m_time - m_notBefore <= m_spec.imageTimeout) {
    return Status::LateStep;
  }
  if (m_hasImage && m_imageTime >= m_notBefore && m_time - m_imageTime <= m_spec.imageTimeout) {
    return Status::Servoing;
  }
  const bool isClock = m_isFuture || m_badStamps != exchange.badStamps.load(std::memory_order_relaxed);
  return isClock ? Status::ImageClock : Status::NoImages;
}

void vpServoControlSide::judgeError() noexcept
{
  m_output.positionError = m_output.rotationError = std::numeric_limits<double>::quiet_NaN();
  m_output.age = m_odometry.age();
  if (m_hasGoal && m_measurement.valid) {
    const vpRigidTransform cdMc =
        vpRigidTransform::fromHomogeneous(m_goal.cdMo) * vpRigidTransform::fromHomogeneous(m_measurement.cMo).inverse();
    m_output.positionError = cdMc.p.norm();
    m_output.rotationError = vpSO3::log(cdMc.R).norm();
  }
  const bool isWithin =
      m_output.positionError <= m_spec.positionTolerance && m_output.rotationError <= m_spec.rotationTolerance;
  m_within = isWithin ? m_within + m_step : 0.;
}

double vpServoControlSide::approachShare(const vpTwist &wish) const noexcept
{
  const auto along = [this, &wish](Eigen::Vector3d (*part)(const vpTwist &)) {
    const Eigen::Vector3d direction = part(wish).normalized();
    return vpCommandedAlong{direction.dot(part(m_shaper.twist())), direction.dot(part(m_shaper.acceleration()))};
  };
  const vpServoMotionLimits &limits = m_controller.spec().motion;
  const double turnGain = m_controller.law().rotationGain();
  // Before a fixed camera the rotation moves the end effector with its own gain, too, and about a far object also across the wish,
  // which takes a part of the acceleration: without a margin a few motions of a hundred end in a circle about the goal.
  constexpr double margin = 1.5;
  const double gain =
      isInHand() ? m_controller.gains().lambda : margin * std::max(m_controller.gains().lambda, turnGain);
  return std::min(vpApproachShare(wish.linearNorm(), gain, limits.linearAcceleration, limits.linearJerk,
                                  along(vpRigidMotion::linear)),
                  vpApproachShare(wish.angularNorm(), turnGain, limits.angularAcceleration, limits.angularJerk,
                                  along(vpRigidMotion::angular)));
}

// The law's twist as one of what moves, within the limits of speed, acceleration and jerk.
vpTwist vpServoControlSide::lawTwist() noexcept
{
  if (m_check) {
    m_check->setState(m_q, m_output.velocity);
  }
  m_controller.setSpeedFactor(m_sightFactor * (m_rising < m_spec.startTime ? m_startFactor : 1.));
  const vpServoCommand command =
      m_controller.step(m_tool ? m_tool->of(m_measurement, m_camera, m_goal.cdMo) : m_measurement, m_step);
  m_output.servo = command.status;
  m_ofLaw = command.v;
  vpTwist wish = command.v;
  if (!isInHand() && !m_tool) {
    wish = vpRigidMotion::changed(m_camera, command.v).scaled(-1.);
  }
  wish = vpWithoutFreeAxes(wish, m_spec.free);
  if (m_plans && !m_object.isKnown) {
    return planned(wish);
  }
  const bool isSeen = command.status == vpServoStatus::Servoing || command.status == vpServoStatus::ViewLimited;
  return bounded(wish, isSeen ? vpWithoutFreeAxes(objectInCamera(), m_spec.free) : vpTwist());
}

// Within the limits already. The shaper goes along, to brake from here.
vpTwist vpServoControlSide::planned(const vpTwist &wish) noexcept
{
  m_shaper.reset(wish, vpRigidMotion::sum(wish, m_output.twist.scaled(-1.)).scaled(1. / m_step));
  return wish;
}

// \param along : Motion of the object, which the camera goes along with.
vpTwist vpServoControlSide::bounded(const vpTwist &wish, const vpTwist &along) noexcept
{
  const vpServoMotionLimits &limits = m_controller.spec().motion;
  const vpTwist within =
      vpLimitTwist(vpRigidMotion::sum(wish.scaled(approachShare(wish)), along),
                   m_output.speedFactor * limits.linearVelocity, m_output.speedFactor * limits.angularVelocity);
  const vpTwist twist = m_shaper.step(within, m_step);
  const vpTwist missing = vpRigidMotion::sum(vpRigidMotion::sum(wish, along), twist.scaled(-1.));
  if (missing.linearNorm() > toleratedShare * wish.linearNorm() + slowest ||
      missing.angularNorm() > toleratedShare * wish.angularNorm() + slowest) {
    m_controller.notifyInterrupted();
  }
  return twist;
}

vpTwist vpServoControlSide::braked() noexcept
{
  m_controller.pass(m_step);
  return m_shaper.step(vpTwist(), m_step);
}

// Tells the law what was sent, as a twist of the camera relative to the object, and what the camera did; a law that plans
// before a fixed camera moves the end effector.
void vpServoControlSide::report() noexcept
{
  vpTwist sent = m_output.twist, moved = m_executed;
  if (m_tool) {
    moved = vpRigidMotion::changed(m_camera, m_executed).scaled(-1.);
  }
  else {
    sent = isInHand() ? vpRigidMotion::sum(sent, objectInCamera().scaled(-1.))
                      : vpRigidMotion::changed(m_camera.inverse(), sent).scaled(-1.);
  }
  for (std::size_t k = 0; k < 6; ++k) {
    sent[k] = m_spec.free[k] ? m_ofLaw[k] : sent[k]; // or it would count as disturbed
  }
  m_controller.notifyExecuted(sent, moved);
}

void vpServoControlSide::moveArm(bool isAllowed) noexcept
{
  if (isAllowed || !isZero(m_output.twist)) {
    m_motion->setSelfMotion(isAllowed ? m_spec.indices : m_noIndices, m_spec.free);
    m_motion->twist(m_output.twist, isInHand() ? vpArmTwistFrame::Camera : vpArmTwistFrame::EndEffector);
  }
  else {
    m_motion->hold();
  }
  const vpJointVector &wish = m_motion->step(m_q, m_output.velocity);
  m_output.arm = m_motion->solver().status;
  if (m_supervisor) {
    m_supervisor->step(m_q, wish, m_supervised);
    m_output.supervision = m_supervised.status;
    m_output.obstacle = m_supervised.pair;
    m_output.velocity = m_supervised.velocity;
  }
  else {
    m_output.velocity = wish;
  }
  measureJointJerk();
}

void vpServoControlSide::measureJointJerk() noexcept
{
  m_output.jointJerk = 0.;
  for (int i = 0; i < m_jointRate.size(); ++i) {
    const double rate = (m_output.velocity(i) - m_lastVelocity(i)) / m_spec.period;
    m_output.jointJerk = std::max(m_output.jointJerk, std::abs(rate - m_jointRate(i)) / m_spec.period);
    m_jointRate(i) = rate;
    m_lastVelocity(i) = m_output.velocity(i);
  }
}

const vpVisualServoOutput &vpServoControlSide::step(const vpServoRobotState &state, double now,
                                                    vpServoExchange &exchange) noexcept
{
  const auto begin = std::chrono::steady_clock::now();
  follow(static_cast<Request>(exchange.request.exchange(None)), exchange);
  if (exchange.goals.fetch()) {
    setGoal(exchange.goals.front());
  }
  const bool isClockRight = checkClock(now, exchange);
  if (updatePose(state, isClockRight, exchange) && isClockRight) {
    takeSight(exchange);
  }
  m_odometry.predict(m_measurement);
  judgeError();
  const Status images = judgeImages(exchange);
  const bool isAllowed = m_isRunning && m_fault == Status::Servoing && images == Status::Servoing;
  m_rising = isAllowed ? m_rising + m_step : 0.;
  m_output.speedFactor = m_sightFactor * (m_rising < m_spec.startTime ? m_rising / m_spec.startTime : 1.);
  m_output.servo = m_hasGoal ? vpServoStatus::Holding : vpServoStatus::NoGoal;
  m_ofLaw = vpTwist();
  m_output.twist = isAllowed && m_hasGoal ? lawTwist() : braked();
  report();
  if (m_motion) {
    moveArm(isAllowed);
  }
  conclude(images);
  exchange.timing.step.add(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  return m_output;
}

END_VISP_NAMESPACE
