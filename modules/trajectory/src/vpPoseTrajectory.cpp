/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/trajectory/vpPoseTrajectory.h>

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using P = vpTrajectoryProblem;

constexpr double longestStep = 1e9; // s; a longer step is a clock error

// J_r'(e, e') e': what the change of the right Jacobian adds to the angular acceleration.
Eigen::Vector3d jacobianRateTerm(const Eigen::Vector3d &e, const Eigen::Vector3d &rate)
{
  // J_r = I - B [e]x + C [e]x^2; b and c are B'/theta and C'/theta.
  const double x = e.squaredNorm();
  double C, b, c;
  if (x < 0.1) {
    C = 1. / 6. - x / 120. * (1. - x / 42. * (1. - x / 72. * (1. - x / 110.)));
    b = -1. / 12. + x / 180. * (1. - 3. * x / 112. * (1. - 2. * x / 135.));
    c = -1. / 60. + x / 1260. * (1. - x / 48. * (1. - 2. * x / 165.));
  }
  else {
    const double theta = std::sqrt(x), s = std::sin(theta), half = std::sin(0.5 * theta), versine = 2. * half * half;
    C = (theta - s) / (theta * x);
    b = (theta * s - 2. * versine) / (x * x);
    c = (theta * versine - 3. * (theta - s)) / (x * x * theta);
  }
  const double along = e.dot(rate);
  const Eigen::Vector3d turn = e.cross(rate);
  return -b * along * turn + c * along * e.cross(turn) + C * rate.cross(turn);
}

Eigen::Vector3d linear(const vpTwist &v) { return {v[0], v[1], v[2]}; }
Eigen::Vector3d angular(const vpTwist &v) { return {v[3], v[4], v[5]}; }

vpTwist twist(const Eigen::Vector3d &v, const Eigen::Vector3d &w) { return {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()}; }

// As in vpTrajectoryProblem: larger numbers cannot be computed reliably.
constexpr double largest = 1e12;

vpTrajectoryFault faultOf(double x, bool start)
{
  if (!std::isfinite(x)) {
    return start ? vpTrajectoryFault::StartNotFinite : vpTrajectoryFault::GoalNotFinite;
  }
  return std::abs(x) <= largest ? vpTrajectoryFault::None : vpTrajectoryFault::OutOfRange;
}

bool isFinite(const vpCameraState &x)
{
  return x.fRc.allFinite() && x.ftc.allFinite() && x.v.isFinite() && x.a.isFinite();
}

// Read a pose and orthonormalise its rotation.
vpTrajectoryStatus read(const vpHomogeneousMatrix &M, bool start, Eigen::Matrix3d &R, Eigen::Vector3d &t)
{
  Eigen::Matrix3d raw;
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 4; ++c) {
      const vpTrajectoryFault fault = faultOf(M[r][c], start);
      if (fault != vpTrajectoryFault::None) {
        return {vpTrajectoryResult::InvalidInput, fault, static_cast<int>(r), M[r][c]};
      }
      (c < 3 ? raw(r, c) : t(r)) = M[r][c];
    }
  }
  const double error = (raw.transpose() * raw - Eigen::Matrix3d::Identity()).norm();
  if (!(error <= 1e-6) || raw.determinant() < 0.) {
    return {vpTrajectoryResult::InvalidInput, vpTrajectoryFault::NotARotation, -1, raw.determinant() < 0. ? 2. : error};
  }
  R = Eigen::Quaterniond(raw).normalized().toRotationMatrix();
  return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
}

void requirePositive(const char *name, double value, const char *unit)
{
  if (!(value >= 1. / largest && (value <= largest || std::isinf(value)))) {
    throw vpException(vpException::badValue,
                      "%s of the pose trajectory is %g %s, must be > 0 (1e-12 to 1e12, or infinity)", name, value,
                      unit);
  }
}
} // namespace

void vpPoseTrajectorySpec::validate() const
{
  requirePositive("linear velocity limit", linearVelocity, "m/s");
  requirePositive("linear acceleration limit", linearAcceleration, "m/s^2");
  requirePositive("linear jerk limit", linearJerk, "m/s^3");
  requirePositive("angular velocity limit", angularVelocity, "rad/s");
  requirePositive("angular acceleration limit", angularAcceleration, "rad/s^2");
  requirePositive("angular jerk limit", angularJerk, "rad/s^3");
  if (policy == vpReplanPolicy::FixedArrival) {
    requirePositive("arrival time", std::isfinite(arrivalTime) ? arrivalTime : -1., "s");
  }
  if (!(minimumDuration >= 0. && minimumDuration <= largest)) {
    throw vpException(vpException::badValue, "minimum duration of the pose trajectory is %g s, must be >= 0",
                      minimumDuration);
  }
}

void vpCameraState::copyTo(vpHomogeneousMatrix &pose) const
{
  for (unsigned int r = 0; r < 3; ++r) {
    for (unsigned int c = 0; c < 3; ++c) {
      pose[r][c] = fRc(r, c);
    }
    pose[r][3] = ftc(r);
  }
}

vpPoseTrajectory::vpPoseTrajectory(const vpPoseTrajectorySpec &spec)
  : m_problem(6), m_planner(6), m_plan(6), m_jitter(6)
{
  setSpec(spec);
  static_cast<void>(reset(vpHomogeneousMatrix()));
}

void vpPoseTrajectory::setSpec(const vpPoseTrajectorySpec &spec)
{
  spec.validate();
  if (spec.policy == vpReplanPolicy::FixedArrival &&
      (m_spec.policy != spec.policy || m_spec.arrivalTime != spec.arrivalTime)) {
    m_arrival = -1.; // starts now
  }
  m_spec = spec;
  m_event = true;
  fillLimits();
}

void vpPoseTrajectory::fillLimits() noexcept
{
  const bool norm = m_spec.rotation == vpRotationPath::Geodesic;
  vpTrajectorySpec &o = m_problem.spec;
  o = vpTrajectorySpec();
  o.policy = m_spec.policy;
  o.cruise = m_spec.cruise;
  o.synchronisation = norm ? vpSynchronisation::Straight : vpSynchronisation::Time;
  o.groups[0] = vpAxisGroup({0, 1, 2}, m_spec.linearVelocity, m_spec.linearAcceleration);
  if (norm) {
    o.groups[1] = vpAxisGroup({3, 4, 5}, m_spec.angularVelocity, m_spec.angularAcceleration);
  }
  for (int i = 0; i < 6; ++i) {
    const bool position = i < 3;
    m_problem.field(P::MaxVelocity)[i] = position ? m_spec.linearVelocity : m_spec.angularVelocity;
    m_problem.field(P::MaxAcceleration)[i] = position ? m_spec.linearAcceleration : m_spec.angularAcceleration;
    m_problem.field(P::MaxJerk)[i] = position ? m_spec.linearJerk : m_spec.angularJerk;
  }
}

vpTrajectoryStatus vpPoseTrajectory::reset(const vpHomogeneousMatrix &fMc, const vpTwist &v, const vpTwist &a) noexcept
{
  vpCameraState x;
  const vpTrajectoryStatus status = read(fMc, true, x.fRc, x.ftc);
  if (!status.isGood()) {
    return status;
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (const double rate : {v[i], a[i]}) {
      if (faultOf(rate, true) != vpTrajectoryFault::None) {
        return {vpTrajectoryResult::InvalidInput, faultOf(rate, true), static_cast<int>(i), rate};
      }
    }
  }
  x.v = v;
  x.a = a;
  m_state = x;
  m_fRd = x.fRc;
  m_ftd = x.ftc;
  m_goalTwist = vpTwist();
  m_goals = 0;
  m_goalAge = m_goalInterval = 0.;
  m_jitter.reset();
  m_plan.clear();
  m_clock = 0.;
  m_arrival = -1.;
  m_event = true;
  return status;
}

vpTrajectoryStatus vpPoseTrajectory::setGoal(const vpHomogeneousMatrix &fMcd, const vpTwist &goalTwist) noexcept
{
  Eigen::Matrix3d R;
  Eigen::Vector3d t;
  const vpTrajectoryStatus status = read(fMcd, false, R, t);
  if (!status.isGood()) {
    return status;
  }
  bool same = R == m_fRd && t == m_ftd;
  for (std::size_t i = 0; i < 6; ++i) {
    if (faultOf(goalTwist[i], false) != vpTrajectoryFault::None) {
      return {vpTrajectoryResult::InvalidInput, faultOf(goalTwist[i], false), static_cast<int>(i), goalTwist[i]};
    }
    same = same && goalTwist[i] == m_goalTwist[i];
  }
  if (!(goalTwist.linearNorm() <= m_spec.linearVelocity && goalTwist.angularNorm() <= m_spec.angularVelocity)) {
    const bool position = !(goalTwist.linearNorm() <= m_spec.linearVelocity);
    return {vpTrajectoryResult::InvalidInput, vpTrajectoryFault::GoalOutsideGroup, position ? 0 : 1,
            position ? goalTwist.linearNorm() : goalTwist.angularNorm()};
  }
  if (!same) {
    noteGoal(R, t);
  }
  m_event = m_event || !same;
  m_fRd = R;
  m_ftd = t;
  m_goalTwist = goalTwist;
  return status;
}

// Goal pose \e ahead seconds after it was given, moving with its twist.
void vpPoseTrajectory::goalAt(double ahead, Eigen::Matrix3d &R, Eigen::Vector3d &t) const noexcept
{
  const Eigen::Vector3d turn = ahead * angular(m_goalTwist);
  R = m_fRd * vpSO3::exp(turn);
  t = m_ftd + m_fRd * (vpSO3::rightJacobian(-turn) * (ahead * linear(m_goalTwist)));
}

// Estimate the goal's motion from its changes.
void vpPoseTrajectory::noteGoal(const Eigen::Matrix3d &R, const Eigen::Vector3d &t) noexcept
{
  m_goalInterval = 0.;
  if (m_goals > 0) {
    Eigen::Matrix3d expectedR;
    Eigen::Vector3d expected;
    goalAt(m_goalAge, expectedR, expected);
    const Eigen::Vector3d shift = t - expected, turn = vpSO3::log(expectedR.transpose() * R);
    for (int i = 0; i < 3; ++i) {
      m_jitter.see(i, shift[i]);
      m_jitter.see(i + 3, turn[i]);
    }
    m_goalInterval = m_goalAge;
  }
  m_goals = std::min(m_goals + 1, 2);
  m_goalAge = 0.;
}

// Minimum duration of KeepArrival, and the goal's predicted pose; see vpTrajectoryFollower.
double vpPoseTrajectory::meet(double floor, Eigen::Matrix3d &R, Eigen::Vector3d &t) noexcept
{
  floor = std::max(floor, m_jitter.floor(m_problem));
  double left = remaining();
  if (m_goals > 1 && (m_goalTwist.linearNorm() > 0. || m_goalTwist.angularNorm() > 0.)) {
    goalAt(m_goalAge + floor, R, t);
    left = std::max(left - vpGoalJitter::hurry * m_goalInterval, 0.);
  }
  m_goalInterval = 0.;
  return std::max(floor, left);
}

void vpPoseTrajectory::replan() noexcept
{
  Eigen::Matrix3d fRd = m_fRd;
  Eigen::Vector3d ftd = m_ftd;
  double floor = m_spec.minimumDuration;
  if (m_spec.policy == vpReplanPolicy::FixedArrival) {
    m_arrival = m_arrival >= 0. && remaining() > 0. ? std::max(m_arrival - m_clock, 0.) : m_spec.arrivalTime;
    floor = m_arrival;
  }
  else if (m_spec.policy == vpReplanPolicy::KeepArrival) {
    floor = meet(floor, fRd, ftd);
  }
  const vpCameraState &x = m_state;
  m_fR0 = Eigen::Quaterniond(x.fRc).normalized().toRotationMatrix();
  // At e = 0 the right Jacobian is the identity and its rate adds nothing: e' = w, e'' = w'.
  const Eigen::Vector3d p1 = x.fRc * linear(x.v), p2 = x.fRc * linear(x.a), e1 = angular(x.v), e2 = angular(x.a);
  const Eigen::Vector3d w = angular(m_goalTwist), goal = vpSO3::log(m_fR0.transpose() * fRd);
  const Eigen::Matrix3d inverse = vpSO3::rightJacobianInverse(goal);
  Eigen::Vector3d goal1 = inverse * w;
  // Near pi the rates of the rotation vector exceed those of the rotation; the limits are on the former.
  goal1 *= std::min(1., m_spec.angularVelocity / std::max(goal1.norm(), 1e-300));
  Eigen::Vector3d goal2 = -inverse * jacobianRateTerm(goal, goal1);
  goal2 *= std::min(1., m_spec.angularAcceleration / std::max(goal2.norm(), 1e-300));
  const Eigen::Vector3d goalP1 = fRd * linear(m_goalTwist);
  Eigen::Vector3d goalP2 = fRd * w.cross(linear(m_goalTwist));
  goalP2 *= std::min(1., m_spec.linearAcceleration / std::max(goalP2.norm(), 1e-300));
  for (int i = 0; i < 3; ++i) {
    m_problem.setStart(i, {x.ftc[i], p1[i], p2[i], 0.});
    m_problem.setStart(i + 3, {0., e1[i], e2[i], 0.});
    const double values[2][3] = {{ftd[i], goalP1[i], goalP2[i]}, {goal[i], goal1[i], goal2[i]}};
    for (int k = 0; k < 2; ++k) {
      m_problem.field(P::GoalQ)[i + 3 * k] = values[k][0];
      m_problem.field(P::GoalV)[i + 3 * k] = values[k][1];
      m_problem.field(P::GoalA)[i + 3 * k] = values[k][2];
    }
  }
  m_planStatus = m_planner.plan(m_problem, floor, m_plan);
  m_clock = 0.;
}

vpTrajectoryStatus vpPoseTrajectory::step(double dt) noexcept
{
  if (!(dt > 0. && dt <= longestStep)) {
    return {vpTrajectoryResult::InvalidInput, vpTrajectoryFault::TimeStep, -1, dt};
  }
  const bool event = m_event;
  if (event) {
    replan();
    m_event = false;
  }
  const bool arrivedBefore = !event && m_clock >= duration();
  m_clock += dt;
  m_goalAge += dt;
  m_jitter.pass(dt);
  if (std::abs(m_clock - duration()) < 1e-8 * dt) {
    m_clock = duration(); // sums of dt differ from the duration by rounding
  }
  const vpCameraState next = at(m_clock);
  if (!isFinite(next)) { // numbers whose combination is too large: stand still, safely
    m_plan.clear();
    m_clock = 0.;
    m_event = true; // the next cycle replans from here
    m_state.v = m_state.a = vpTwist();
    return {vpTrajectoryResult::InvalidInput, vpTrajectoryFault::OutOfRange, -1, dt};
  }
  m_state = next;
  if (m_clock >= duration()) {
    return {arrivedBefore ? vpTrajectoryResult::Holding : vpTrajectoryResult::Finished, vpTrajectoryFault::None, -1,
            0.};
  }
  if (m_planStatus.result == vpTrajectoryResult::Braking && m_clock >= m_plan.brakingEnd()) {
    return {vpTrajectoryResult::Working, vpTrajectoryFault::None, -1, 0.};
  }
  return m_planStatus;
}

vpCameraState vpPoseTrajectory::at(double t) const noexcept
{
  Eigen::Vector3d q[3], e[3];
  for (int i = 0; i < 3; ++i) {
    const vpAxisState place = m_plan.at(i, t), turn = m_plan.at(i + 3, t);
    for (int k = 0; k < 3; ++k) {
      q[k][i] = place[static_cast<std::size_t>(k)];
      e[k][i] = turn[static_cast<std::size_t>(k)];
    }
  }
  vpCameraState x;
  x.fRc = m_fR0 * vpSO3::exp(e[0]);
  x.ftc = q[0];
  const Eigen::Matrix3d J = vpSO3::rightJacobian(e[0]);
  x.v = twist(x.fRc.transpose() * q[1], J * e[1]);
  x.a = twist(x.fRc.transpose() * q[2], J * e[2] + jacobianRateTerm(e[0], e[1]));
  return x;
}

END_VISP_NAMESPACE
