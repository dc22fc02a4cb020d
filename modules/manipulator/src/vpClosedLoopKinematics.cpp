/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
using Vector6 = Eigen::Matrix<double, 6, 1>;

void positive(const char *field, double value)
{
  if (!(value >= 1e-12 && value <= vpArmLargest)) {
    throw vpException(vpException::badValue,
                      "%s of the closed-loop kinematics is %g, must be > 0 and finite (1e-12 to 1e9)", field, value);
  }
}

// Pose error from a to b in the axes of a, m and rad.
Vector6 between(const vpRigidTransform &a, const vpRigidTransform &b)
{
  Vector6 e;
  e << a.R.transpose() * (b.p - a.p), vpSO3::log(a.R.transpose() * b.R);
  return e;
}

vpTwist twistOf(const Vector6 &v) { return {v(0), v(1), v(2), v(3), v(4), v(5)}; }

bool sameGoal(const vpRigidTransform &a, const vpRigidTransform &b)
{
  return (a.p - b.p).cwiseAbs().maxCoeff() < 1e-9 && (a.R - b.R).cwiseAbs().maxCoeff() < 1e-9;
}

bool givenUp(vpClosedLoopStatus status)
{
  return status == vpClosedLoopStatus::StoppedByLimits || status == vpClosedLoopStatus::StoppedBySingularity ||
         status == vpClosedLoopStatus::StoppedByAxis || status == vpClosedLoopStatus::Stalled;
}
} // namespace

void vpClosedLoopSpec::validate(double period) const
{
  positive("gain", gain);
  positive("maxLinear", maxLinear);
  positive("maxAngular", maxAngular);
  positive("linearTolerance", linearTolerance);
  positive("angularTolerance", angularTolerance);
  positive("driftTolerance", driftTolerance);
  positive("stallTime", stallTime);
  if (gain * period > 1.) {
    throw vpException(vpException::badValue,
                      "gain of the closed-loop kinematics is %g 1/s, must be at most 1/period = %g", gain, 1. / period);
  }
}

const char *vpClosedLoopOutput::message() const noexcept
{
  switch (status) {
  case vpClosedLoopStatus::Moving:
    return solver.message();
  case vpClosedLoopStatus::Reached:
    return "The end effector is at the goal.";
  case vpClosedLoopStatus::StoppedByLimits:
    return "The motion stopped before the goal: joints are at their limits.";
  case vpClosedLoopStatus::StoppedBySingularity:
    return "The motion stopped before the goal: it lies beyond a singularity or outside the workspace.";
  case vpClosedLoopStatus::StoppedByAxis:
    return "The motion stopped before the goal: the arm has too few joints for all axes of it, free one of them.";
  case vpClosedLoopStatus::Stalled:
    return "The motion stopped before the goal without progress.";
  case vpClosedLoopStatus::InvalidInput:
    return "An input is not finite, beyond 1e9, no rotation or of a wrong size; the arm brakes.";
  }
  return "";
}

vpClosedLoopKinematics::vpClosedLoopKinematics(const vpArmModel &model, const vpRedundancySpec &redundancy,
                                               const vpClosedLoopSpec &spec)
  : m_model(&model), m_spec(spec), m_solver(model, redundancy)
{
  spec.validate(redundancy.period);
  m_input.frame = vpArmFrame::EndEffector;
}

// Drift of the tool in a period at constant joint velocity beyond J q' dt, as the compensating twist.
void vpClosedLoopKinematics::drift(const vpJointVector &velocity, Vector6 &twist) noexcept
{
  const double dt = m_solver.spec().period;
  vpArmKinematics::forward(*m_model, m_data.q + dt * velocity, m_ahead);
  Vector6 linear = Vector6::Zero();
  for (int i = 0; i < m_data.size; ++i) {
    linear += dt * velocity(i) * m_data.J.col(i);
  }
  const vpRigidTransform expected{vpSO3::exp(linear.tail<3>()) * m_data.tool.R, m_data.tool.p + linear.head<3>()};
  Vector6 back;
  back << expected.p - m_ahead.tool.p, vpSO3::log(expected.R * m_ahead.tool.R.transpose());
  twist.head<3>() = m_data.tool.R.transpose() * back.head<3>() / dt;
  twist.tail<3>() = m_data.tool.R.transpose() * back.tail<3>() / dt;
  for (int k = 0; k < 6; ++k) {
    if (m_input.free[static_cast<std::size_t>(k)]) {
      twist(k) = 0.;
    }
  }
}

// Twist J q' in the axes of the end effector, without the free components.
Vector6 vpClosedLoopKinematics::rate(const vpJointVector &velocity) const noexcept
{
  Vector6 twist = Vector6::Zero();
  for (int i = 0; i < m_data.size; ++i) {
    twist += velocity(i) * m_data.J.col(i);
  }
  twist.head<3>() = (m_data.tool.R.transpose() * twist.head<3>()).eval();
  twist.tail<3>() = (m_data.tool.R.transpose() * twist.tail<3>()).eval();
  for (int k = 0; k < 6; ++k) {
    if (m_input.free[static_cast<std::size_t>(k)]) {
      twist(k) = 0.;
    }
  }
  return twist;
}

void vpClosedLoopKinematics::motion(const vpClosedLoopInput &input, vpClosedLoopState &state,
                                    vpClosedLoopOutput &output) noexcept
{
  const bool stopped = givenUp(state.status);
  Vector6 wanted;
  wanted << m_data.tool.R.transpose() * Eigen::Vector3d(input.twist[0], input.twist[1], input.twist[2]),
      m_data.tool.R.transpose() * Eigen::Vector3d(input.twist[3], input.twist[4], input.twist[5]);
  wanted += m_spec.gain * output.error;
  const vpTwist limited = vpLimitTwist(twistOf(wanted), m_spec.maxLinear, m_spec.maxAngular);
  for (int k = 0; k < 6; ++k) {
    wanted(k) = stopped ? 0. : limited[static_cast<std::size_t>(k)];
  }
  m_input.indexCount = stopped ? 0 : input.indexCount;
  // The self-motion is restored stepwise after it was slowed down.
  double share = std::min(1., 1.25 * state.selfMotionShare + 0.01);
  for (int attempt = 0;; ++attempt) {
    m_input.selfMotionShare = share;
    m_input.twist = twistOf(wanted);
    m_solver.step(m_data, m_input, output.solver);
    const Vector6 before = rate(output.solver.velocity);
    Vector6 back;
    drift(output.solver.velocity, back);
    const Vector6 corrected = wanted + back;
    m_input.twist = twistOf(corrected);
    m_solver.step(m_data, m_input, output.solver);
    // The motion drifts by -rest; the solver has already compensated it as far as possible.
    Vector6 rest;
    drift(output.solver.velocity, rest);
    const double left = (rest - (rate(output.solver.velocity) - before)).norm() * m_solver.spec().period;
    const bool moves = output.solver.selfMotion.squaredNorm() > 0.;
    if (!moves || left <= m_spec.driftTolerance || attempt == 5) {
      break;
    }
    share = attempt == 4 ? 0. : 0.4 * share;
  }
  state.selfMotionShare = share;
}

bool vpClosedLoopKinematics::usable(const vpClosedLoopInput &input, const vpClosedLoopState &state) const noexcept
{
  const int n = m_model->size();
  const auto plausible = [](double x) { return std::fabs(x) <= vpArmLargest; };
  bool good = state.q.size() == n && vpIsPlausibleForArm(state.q) && vpIsPlausibleForArm(state.velocity) &&
              state.selfMotionShare >= 0. && state.selfMotionShare <= 1. && std::isfinite(state.best) &&
              std::isfinite(state.waiting) && vpIsPlausibleForArm(input.goal.p) && vpIsPlausibleForArm(input.goal.R) &&
              input.indexCount >= 0 && input.indexCount <= vpMaxArmIndices;
  good = good && (input.goal.R * input.goal.R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6 &&
         input.goal.R.determinant() > 0.;
  for (std::size_t i = 0; i < 6; ++i) {
    good = good && plausible(input.twist[i]);
  }
  return good;
}

void vpClosedLoopKinematics::brake(vpClosedLoopState &state, vpClosedLoopOutput &output) noexcept
{
  m_input.previous = state.velocity;
  m_solver.step(vpArmData(), m_input, output.solver);
  output.error.setZero();
  output.status = state.status = vpClosedLoopStatus::InvalidInput;
  state.velocity = output.solver.velocity;
  if (state.q.size() == m_model->size()) {
    state.q += m_solver.spec().period * state.velocity;
  }
}

void vpClosedLoopKinematics::step(const vpClosedLoopInput &input, vpClosedLoopState &state,
                                  vpClosedLoopOutput &output) noexcept
{
  const int n = m_model->size();
  const double dt = m_solver.spec().period;
  if (state.velocity.size() != n) {
    state.velocity.setZero(n);
  }
  if (!usable(input, state)) {
    brake(state, output);
    return;
  }
  vpArmKinematics::update(*m_model, state.q, m_data);
  output.error = between(m_data.tool, input.goal);
  for (int k = 0; k < 6; ++k) {
    if (input.free[static_cast<std::size_t>(k)]) {
      output.error(k) = 0.;
    }
  }
  const double error = output.error.head<3>().norm() + m_solver.spec().taskLength * output.error.tail<3>().norm();
  if (state.best < 0. || !sameGoal(state.goal, input.goal)) {
    state.goal = input.goal;
    state.best = error;
    state.waiting = 0.;
    state.status = vpClosedLoopStatus::Moving;
  }
  m_input.free = input.free;
  m_input.indices = input.indices;
  m_input.previous = state.velocity;
  motion(input, state, output);
  if (output.solver.status == vpRedundancyStatus::InvalidInput) {
    brake(state, output);
    return;
  }
  state.velocity = output.solver.velocity;
  state.q += dt * state.velocity;

  if (output.error.head<3>().norm() <= m_spec.linearTolerance &&
      output.error.tail<3>().norm() <= m_spec.angularTolerance) {
    state.status = vpClosedLoopStatus::Reached;
    state.waiting = 0.;
    state.best = error;
  }
  else if (!givenUp(state.status)) {
    state.status = vpClosedLoopStatus::Moving;
    state.waiting += dt;
    if (error < 0.99 * state.best) {
      state.best = error;
      state.waiting = 0.;
    }
    if (state.waiting > m_spec.stallTime) {
      const bool limits = output.solver.stoppedJoints != 0U || output.solver.scale < 0.01;
      const bool singular = output.solver.smallestSingular < m_solver.spec().singularRegion;
      const bool lacking = output.solver.status == vpRedundancyStatus::AxisUnreachable;
      state.status = limits     ? vpClosedLoopStatus::StoppedByLimits
                     : lacking  ? vpClosedLoopStatus::StoppedByAxis
                     : singular ? vpClosedLoopStatus::StoppedBySingularity
                                : vpClosedLoopStatus::Stalled;
    }
  }
  output.status = state.status;
}

END_VISP_NAMESPACE
