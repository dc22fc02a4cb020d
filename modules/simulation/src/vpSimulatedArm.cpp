/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpSimulatedArm.h>

#include <visp3/core/vpException.h>
#include <visp3/core/vpPoseVector.h>
#include <visp3/core/vpRxyzVector.h>
#include <visp3/robot/vpRobotException.h>

#include "vpSimulatedArmCore.h"

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

BEGIN_VISP_NAMESPACE

namespace
{
using Clock = std::chrono::steady_clock;
constexpr double longestLag = 0.1;  // s: delay that the clock catches up; beyond it the arm's time lags
constexpr double resting = 1e-4;    // rad/s or m/s
constexpr double longestRest = 1.;  // s
constexpr double longestWait = 1e6; // s
constexpr double longestStop = 10.; // s: stops within the limits of acceleration end much earlier

vpJointVector jointsOf(const vpColVector &v, int n)
{
  if (static_cast<int>(v.size()) != n) {
    throw vpException(vpException::dimensionError, "a vector of %u joints was given, the arm has %d", v.size(), n);
  }
  vpJointVector joints(n);
  for (int i = 0; i < n; ++i) {
    joints(i) = v[static_cast<unsigned int>(i)];
    if (!std::isfinite(joints(i))) {
      throw vpException(vpException::badValue, "component %d of the vector is %g, must be finite", i, joints(i));
    }
  }
  return joints;
}

vpColVector columnOf(const vpJointVector &joints)
{
  vpColVector v(static_cast<unsigned int>(joints.size()));
  for (unsigned int i = 0; i < v.size(); ++i) {
    v[i] = joints(static_cast<Eigen::Index>(i));
  }
  return v;
}

vpTwist twistOf(const vpColVector &v)
{
  const vpTwist twist = vpTwist::fromColVector(v);
  for (unsigned int i = 0; i < 6; ++i) {
    if (!std::isfinite(twist[i])) {
      throw vpException(vpException::badValue, "component %u of the velocity is %g, must be finite", i, twist[i]);
    }
  }
  return twist;
}

vpColVector columnOf(const vpHomogeneousMatrix &M)
{
  const vpPoseVector pose(M);
  vpColVector v(6);
  for (unsigned int i = 0; i < 6; ++i) {
    v[i] = pose[i];
  }
  return v;
}

vpMatrix matrixOf(const vpArmJacobian &J)
{
  vpMatrix M(6, static_cast<unsigned int>(J.cols()));
  for (unsigned int r = 0; r < 6; ++r) {
    for (unsigned int c = 0; c < M.getCols(); ++c) {
      M[r][c] = J(r, c);
    }
  }
  return M;
}

vpHomogeneousMatrix poseOf(const vpColVector &v, bool euler)
{
  const vpTwist p = twistOf(v); // six finite numbers
  const vpTranslationVector t(p[0], p[1], p[2]);
  return euler ? vpHomogeneousMatrix(t, vpRotationMatrix(vpRxyzVector(p[3], p[4], p[5])))
               : vpHomogeneousMatrix(t, vpThetaUVector(p[3], p[4], p[5]));
}

[[noreturn]] void throwNoFrame(int frame)
{
  throw vpRobotException(vpRobotException::wrongStateError, "the simulated arm does not do this in frame %d", frame);
}

// With the camera on an earlier link its pose in the end effector's frame is not constant.
void requireCameraOnTool(const vpArmModel &model, const char *instead)
{
  if (model.spec().cameraLink >= 0) {
    throw vpRobotException(vpRobotException::wrongStateError,
                           "the camera of %s is on link %d, not on the end effector: the simulated arm %s only",
                           model.label().c_str(), model.spec().cameraLink, instead);
  }
}

const char *sentenceOf(vpClosedLoopStatus status)
{
  vpClosedLoopOutput output;
  output.status = status;
  return output.message();
}
} // namespace

//! Core, clock and their lock.
class vpSimulatedArm::Impl
{
public:
  Impl(const vpArmModel &model, const vpSimulatedArmSpec &spec) : core(model, spec), before(core.measuredKinematics())
  {
    if (spec.clock == vpArmClock::RealTime) {
      m_thread = std::thread([this] { run(); });
    }
  }
  ~Impl()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      m_end = true;
    }
    m_wake.notify_all();
    if (m_thread.joinable()) {
      m_thread.join();
    }
  }
  Impl(const Impl &) = delete;
  Impl &operator=(const Impl &) = delete;

  [[nodiscard]] bool stepped() const { return core.spec.clock == vpArmClock::Stepped; }

  //! Stepped: lets time pass. The remainder below a control period is carried over; ViSP's own sampling time is
  //! a float.
  void pass(double duration)
  {
    for (m_due += duration; m_due >= core.period() * (1. - 1e-5); m_due -= core.period()) {
      core.tick();
    }
  }
  //! Waits for a condition with either clock.
  template <class Condition> void waitUntil(std::unique_lock<std::mutex> &lock, const Condition &holds)
  {
    while (!holds()) {
      if (stepped()) {
        core.tick();
      }
      else {
        m_ticked.wait(lock);
      }
    }
  }

  //! A new command cancels the previous one, in whichever thread it is awaited.
  long order() { return ++m_orders; }
  [[nodiscard]] bool ended(long order) const { return order != m_orders; }

  mutable std::mutex mutex;
  vpSimulatedArmCore core;
  double positioning = 0.15; // fraction of the velocity limits
  vpArmData before;          // at the last getDisplacement()

private:
  void run()
  {
    const auto period = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(core.period()));
    const auto most = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(longestLag));
    Clock::time_point next = Clock::now() + period;
    std::unique_lock<std::mutex> lock(mutex);
    while (!m_end) {
      m_wake.wait_until(lock, next, [this] { return m_end; });
      if (m_end) {
        break;
      }
      core.tick();
      m_ticked.notify_all();
      next = std::max(next + period, Clock::now() - most);
    }
  }

  double m_due = 0.;
  long m_orders = 0;
  bool m_end = false;
  std::condition_variable m_wake, m_ticked;
  std::thread m_thread;
};

vpSimulatedArm::vpSimulatedArm(const vpArmModel &model, const vpSimulatedArmSpec &spec)
  : m_impl(std::make_unique<Impl>(model, spec))
{
  nDof = model.size();
}

vpSimulatedArm::~vpSimulatedArm() = default;

vpRobot::vpRobotStateType vpSimulatedArm::setRobotState(const vpRobot::vpRobotStateType newState)
{
  if (newState != vpRobot::STATE_STOP && newState != vpRobot::STATE_VELOCITY_CONTROL &&
      newState != vpRobot::STATE_POSITION_CONTROL) {
    throw vpRobotException(vpRobotException::wrongStateError, "the simulated arm has no control state %d", newState);
  }
  std::unique_lock<std::mutex> lock(m_impl->mutex);
  if (newState == vpRobot::STATE_STOP) {
    m_impl->order();
    m_impl->core.stop();
    if (m_impl->stepped()) {
      const double until = m_impl->core.time() + longestStop;
      m_impl->waitUntil(lock, [this, until] { return m_impl->core.atRest() || m_impl->core.time() > until; });
      m_impl->core.tick();
    }
  }
  else if (vpRobot::getRobotState() != newState) {
    m_impl->order();
    m_impl->core.motion().hold();
  }
  return vpRobot::setRobotState(newState);
}

vpRobot::vpRobotStateType vpSimulatedArm::getRobotState() const
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  return vpRobot::getRobotState();
}

void vpSimulatedArm::setSamplingTime(const double &delta_t)
{
  if (!(delta_t > 0. && delta_t <= longestWait)) {
    throw vpException(vpException::badValue, "sampling time of the simulated arm is %g s, must be > 0 and at most %g",
                      delta_t, longestWait);
  }
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  vpRobotSimulator::setSamplingTime(delta_t);
}

void vpSimulatedArm::setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &v)
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  if (vpRobot::getRobotState() != vpRobot::STATE_VELOCITY_CONTROL) {
    throw vpRobotException(vpRobotException::wrongStateError,
                           "the arm is not in velocity control: call setRobotState(vpRobot::STATE_VELOCITY_CONTROL) "
                           "before setVelocity()");
  }
  vpSimulatedArmCore &core = m_impl->core;
  const bool lost = core.status() == vpSimulatedArmStatus::NotFollowing;
  const double valid = core.spec.watchdog + (m_impl->stepped() ? getSamplingTime() : 0.);
  if (frame == vpRobot::JOINT_STATE) {
    const vpJointVector joints = jointsOf(v, core.model.size());
    if (!lost) {
      core.motion().jointVelocity(joints);
    }
  }
  else {
    const vpTwist twist = vpLimitTwist(twistOf(v), getMaxTranslationVelocity(), getMaxRotationVelocity());
    const vpArmTwistFrame in = frame == vpRobot::CAMERA_FRAME         ? vpArmTwistFrame::Camera
                               : frame == vpRobot::END_EFFECTOR_FRAME ? vpArmTwistFrame::EndEffector
                               : frame == vpRobot::REFERENCE_FRAME    ? vpArmTwistFrame::Base
                                                                      : vpArmTwistFrame::Mixt;
    if (!lost) {
      core.motion().twist(twist, in);
    }
  }
  setRobotFrame(frame);
  core.commandUntil(core.time() + valid);
  if (m_impl->stepped()) {
    m_impl->pass(getSamplingTime());
  }
}

void vpSimulatedArm::setPosition(const vpRobot::vpControlFrameType frame, const vpColVector &q)
{
  if (frame == vpRobot::MIXT_FRAME) {
    throwNoFrame(frame);
  }
  std::unique_lock<std::mutex> lock(m_impl->mutex);
  vpSimulatedArmCore &core = m_impl->core;
  const long order = m_impl->order();
  core.motion().hold();
  vpRobot::setRobotState(vpRobot::STATE_POSITION_CONTROL);
  const vpJointVector here = core.drives().wanted(), moving = core.drives().command();
  const bool byJoints = frame == vpRobot::JOINT_STATE;
  if (core.status() == vpSimulatedArmStatus::NotFollowing) {
    throw vpRobotException(vpRobotException::lowLevelError, "%s", core.message().c_str());
  }
  if (byJoints) {
    const vpJointVector goal = jointsOf(q, core.model.size());
    vpRequireInside(core.model, goal);
    core.motion().jointPath(goal, here, moving, m_impl->positioning);
  }
  else {
    const vpRigidTransform pose = vpRigidTransform::fromHomogeneous(poseOf(q, frame == vpRobot::REFERENCE_FRAME));
    const bool ofTool = frame == vpRobot::END_EFFECTOR_FRAME;
    if (!ofTool) {
      requireCameraOnTool(core.model, "moves to poses of its end effector");
    }
    core.motion().posePath(ofTool ? pose : pose * core.model.spec().camera.inverse(), here, moving);
  }
  m_impl->waitUntil(lock, [this, &core, order] {
    return m_impl->ended(order) || (core.motion().finished() && core.atRest()) ||
           core.status() == vpSimulatedArmStatus::NotFollowing;
  });
  if (m_impl->ended(order)) {
    throw vpRobotException(vpRobotException::lowLevelError, "another call ended the motion before its goal");
  }
  if (core.status() == vpSimulatedArmStatus::NotFollowing) {
    throw vpRobotException(vpRobotException::lowLevelError, "%s", core.message().c_str());
  }
  if (!byJoints && core.motion().poseStatus() != vpClosedLoopStatus::Reached) {
    throw vpRobotException(vpRobotException::lowLevelError, "%s", sentenceOf(core.motion().poseStatus()));
  }
  if (byJoints && core.motion().failed()) {
    throw vpRobotException(vpRobotException::lowLevelError, "%s", core.motion().pathSentence().c_str());
  }
  // Drives with friction come to rest slightly later than their commands.
  const double end = core.time() + longestRest;
  m_impl->waitUntil(lock, [this, &core, order, end] {
    return m_impl->ended(order) || core.drives().velocity().cwiseAbs().maxCoeff() < resting || core.time() >= end;
  });
}

void vpSimulatedArm::getPosition(const vpRobot::vpControlFrameType frame, vpColVector &q)
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  const vpSimulatedArmCore &core = m_impl->core;
  const vpArmData data = core.measuredKinematics();
  switch (frame) {
  case vpRobot::JOINT_STATE:
    q = columnOf(core.drives().measured());
    return;
  case vpRobot::END_EFFECTOR_FRAME:
    q = columnOf(data.tool.toHomogeneous());
    return;
  case vpRobot::CAMERA_FRAME:
    q = columnOf(vpArmKinematics::camera(core.model, data).toHomogeneous());
    return;
  case vpRobot::REFERENCE_FRAME: {
    const vpHomogeneousMatrix fMc = vpArmKinematics::camera(core.model, data).toHomogeneous();
    const vpRxyzVector r(fMc.getRotationMatrix());
    q = columnOf(fMc);
    for (unsigned int i = 0; i < 3; ++i) {
      q[3 + i] = r[i];
    }
    return;
  }
  default:
    throwNoFrame(frame);
  }
}

void vpSimulatedArm::getVelocity(const vpRobot::vpControlFrameType frame, vpColVector &v)
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  const vpSimulatedArmCore &core = m_impl->core;
  if (frame == vpRobot::JOINT_STATE) {
    v = columnOf(core.drives().velocity());
    return;
  }
  const vpArmData data = core.kinematics();
  const vpArmFrame in = frame == vpRobot::REFERENCE_FRAME      ? vpArmFrame::Base
                        : frame == vpRobot::END_EFFECTOR_FRAME ? vpArmFrame::EndEffector
                                                               : vpArmFrame::Camera;
  const Eigen::Matrix<double, 6, 1> twist = vpArmKinematics::geometric(core.model, data, in) * core.drives().velocity();
  v.resize(6);
  for (unsigned int i = 0; i < 6; ++i) {
    v[i] = twist(i);
  }
  if (frame == vpRobot::MIXT_FRAME) {
    const Eigen::Vector3d inBase = vpArmKinematics::camera(core.model, data).R * twist.head<3>();
    for (unsigned int i = 0; i < 3; ++i) {
      v[i] = inBase(i);
    }
  }
}

void vpSimulatedArm::getDisplacement(const vpRobot::vpControlFrameType frame, vpColVector &q)
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  const vpSimulatedArmCore &core = m_impl->core;
  const vpArmData now = core.measuredKinematics();
  const vpRigidTransform c0 = vpArmKinematics::camera(core.model, m_impl->before);
  const vpRigidTransform c1 = vpArmKinematics::camera(core.model, now);
  switch (frame) {
  case vpRobot::JOINT_STATE:
    q = columnOf(vpJointVector(now.q - m_impl->before.q));
    break;
  case vpRobot::END_EFFECTOR_FRAME:
    q = columnOf((m_impl->before.tool.inverse() * now.tool).toHomogeneous());
    break;
  case vpRobot::CAMERA_FRAME:
    q = columnOf((c0.inverse() * c1).toHomogeneous());
    break;
  case vpRobot::REFERENCE_FRAME:
    q = columnOf(vpRigidTransform{c1.R * c0.R.transpose(), c1.p - c0.p}.toHomogeneous());
    break;
  default:
    throwNoFrame(frame);
  }
  m_impl->before = now;
}

void vpSimulatedArm::get_eJe(vpMatrix &J)
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  const vpSimulatedArmCore &core = m_impl->core;
  J = matrixOf(vpArmKinematics::geometric(core.model, core.measuredKinematics(), vpArmFrame::EndEffector));
}

void vpSimulatedArm::get_fJe(vpMatrix &J)
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  J = matrixOf(m_impl->core.measuredKinematics().J);
}

vpHomogeneousMatrix vpSimulatedArm::get_cMe() const
{
  requireCameraOnTool(m_impl->core.model, "gives cMe of a camera that is fixed to it");
  return m_impl->core.model.spec().camera.inverse().toHomogeneous();
}

vpVelocityTwistMatrix vpSimulatedArm::get_cVe() const { return vpVelocityTwistMatrix(get_cMe()); }

vpHomogeneousMatrix vpSimulatedArm::get_fMc() const
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  return vpArmKinematics::camera(m_impl->core.model, m_impl->core.kinematics()).toHomogeneous();
}

vpHomogeneousMatrix vpSimulatedArm::get_fMe() const
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  return m_impl->core.kinematics().tool.toHomogeneous();
}

void vpSimulatedArm::setSelfMotion(const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free)
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  vpSimulatedArmSpec spec = m_impl->core.spec;
  spec.indices = indices;
  spec.validate(m_impl->core.model);
  m_impl->core.motion().setSelfMotion(indices, free);
}

void vpSimulatedArm::setPositioningVelocity(double percent)
{
  if (!(percent > 0. && percent <= 100.)) {
    throw vpException(vpException::badValue,
                      "positioning velocity of the simulated arm is %g %%, must be > 0 and <= 100", percent);
  }
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  m_impl->positioning = percent / 100.;
}

void vpSimulatedArm::wait(double duration)
{
  if (!(duration >= 0. && duration <= longestWait)) {
    throw vpException(vpException::badValue, "the time to wait is %g s, must be >= 0 and at most %g", duration,
                      longestWait);
  }
  std::unique_lock<std::mutex> lock(m_impl->mutex);
  if (m_impl->stepped()) {
    m_impl->pass(duration);
    return;
  }
  const double end = m_impl->core.time() + duration;
  m_impl->waitUntil(lock, [&] { return m_impl->core.time() >= end; });
}

vpSimulatedArmState vpSimulatedArm::getState() const
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  return m_impl->core.state();
}

std::string vpSimulatedArm::getSentence() const
{
  const std::lock_guard<std::mutex> lock(m_impl->mutex);
  return m_impl->core.message();
}

const vpArmModel &vpSimulatedArm::getModel() const { return m_impl->core.model; }

END_VISP_NAMESPACE
