/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpArmDrives.h>
#include <visp3/simulation/vpArmPlant.h>

#include <visp3/core/vpException.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <random>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int mostPasses = 200;
constexpr double settled = 1e-12;  // rad/s: change per pass that ends the iteration
constexpr double sticking = 1e-10; // rad/s: residual velocity below which a joint sticks

double clamp(double value, double lower, double upper) { return std::min(upper, std::max(lower, value)); }
} // namespace

vpArmPlant::vpArmPlant(const vpArmModel &model, double frictionScale)
  : m_model(&model), m_dynamics(model), m_friction(vpJointFriction::of(model))
{
  if (!(frictionScale >= 0.) || !std::isfinite(frictionScale)) {
    throw vpException(vpException::badValue, "frictionScale of the arm's plant is %g, must be >= 0 and finite",
                      frictionScale);
  }
  m_friction.viscous *= frictionScale;
  m_friction.coulomb *= frictionScale;
  reset(model.home());
}

void vpArmPlant::reset(const vpJointVector &q)
{
  if (q.size() != m_model->size() || !vpIsPlausibleForArm(q)) {
    throw vpException(vpException::badValue,
                      "the configuration of the arm's plant has %d numbers, must have %d finite ones",
                      static_cast<int>(q.size()), m_model->size());
  }
  m_q = q;
  m_velocity.setZero(q.size());
  m_impulse.setZero(q.size());
  m_stop.setZero(q.size());
}

bool vpArmPlant::step(const vpJointVector &torque, double dt) noexcept
{
  const vpJointVector q = m_q, velocity = m_velocity, impulse = m_impulse, stop = m_stop;
  if (move(torque, dt) && vpIsPlausibleForArm(m_q) && vpIsPlausibleForArm(m_velocity) && m_impulse.allFinite() &&
      m_stop.allFinite()) {
    return true;
  }
  m_q = q;
  m_velocity = velocity;
  m_impulse = impulse;
  m_stop = stop;
  return false;
}

bool vpArmPlant::move(const vpJointVector &torque, double dt) noexcept
{
  const Eigen::Index n = m_q.size();
  vpJointMatrix M;
  vpJointVector coriolis, gravity;
  if (torque.size() != n || !vpIsPlausibleForArm(torque) || !(dt >= 1e-9 && dt <= longestStep) ||
      !m_dynamics.inertia(m_q, M) || !m_dynamics.coriolis(m_q, m_velocity, coriolis) ||
      !m_dynamics.gravity(m_q, gravity)) {
    return false;
  }
  vpJointMatrix damped = M;
  damped.diagonal() += dt * m_friction.viscous;
  const vpJointMatrix compliance = damped.llt().solve(vpJointMatrix::Identity(n, n));
  m_velocity = compliance * (M * m_velocity + dt * (torque - coriolis - gravity));
  holdBack(compliance, dt);
  m_q += dt * m_velocity;
  return true;
}

// Friction impulses are within +-dt Fc, those of a stop push inwards only. Both start from the last step's values,
// which are nearly correct.
void vpArmPlant::holdBack(const vpJointMatrix &compliance, double dt) noexcept
{
  const Eigen::Index n = m_q.size();
  m_impulse = m_impulse.cwiseMax(-dt * m_friction.coulomb).cwiseMin(dt * m_friction.coulomb);
  m_velocity -= compliance * (m_impulse + m_stop);
  for (int pass = 0; pass < mostPasses; ++pass) {
    double change = 0.;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double most = dt * m_friction.coulomb(i), own = compliance(i, i);
      const double friction = clamp(m_impulse(i) + m_velocity(i) / own, -most, most) - m_impulse(i);
      m_impulse(i) += friction;
      m_velocity -= compliance.col(i) * friction;
      // Room to both limits as velocities; the stop's impulse is positive at the upper limit.
      const double above = (m_model->upper()(i) - m_q(i)) / dt, below = (m_model->lower()(i) - m_q(i)) / dt;
      const double free = m_velocity(i) + own * m_stop(i);
      const double stop = (free - clamp(free, std::min(below, 0.), std::max(above, 0.))) / own - m_stop(i);
      m_stop(i) += stop;
      m_velocity -= compliance.col(i) * stop;
      change = std::max(change, own * std::max(std::fabs(friction), std::fabs(stop)));
    }
    if (change < settled) {
      break;
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    m_velocity(i) = std::fabs(m_velocity(i)) < sticking ? 0. : m_velocity(i);
  }
}

namespace
{
constexpr double naturalFrequency = 12.;    // rad/s, minimum for derived gains
constexpr double frictionError = 1. / 300.; // rad or m, largest error by Coulomb friction with such gains
constexpr double estimatorBandwidth = 300.; // rad/s
constexpr int inertiaSamples = 200;

void requireGood(const char *field, double value, bool good, const char *range)
{
  if (!good || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s of the arm's drives is %g, must be %s and finite", field, value,
                      range);
  }
}

// Largest inertia seen by each drive, kg m^2.
vpJointVector largestInertia(const vpArmModel &model)
{
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> share(0., 1.);
  vpArmDynamics dynamics(model);
  vpJointVector most = vpJointVector::Zero(model.size());
  for (int sample = 0; sample < inertiaSamples; ++sample) {
    vpJointVector q(model.size());
    for (int i = 0; i < model.size(); ++i) {
      const double lower = model.isContinuous(i) ? -M_PI : model.lower()(i);
      const double upper = model.isContinuous(i) ? M_PI : model.upper()(i);
      q(i) = lower + share(rng) * (upper - lower);
    }
    vpJointMatrix M;
    dynamics.inertia(q, M);
    most = most.cwiseMax(M.diagonal());
  }
  return most;
}

vpJointPositionControlSpec controlOf(const vpArmModel &model, const vpArmDriveSpec &spec)
{
  vpJointPositionControlSpec control;
  const vpJointVector inertia = largestInertia(model);
  control.kp.resize(model.size());
  control.kd.resize(model.size());
  for (int i = 0; i < model.size(); ++i) {
    const vpArmJointSpec &joint = model.spec().joints[static_cast<std::size_t>(i)];
    const bool given = joint.kp > 0.;
    const double stiffness = std::max(inertia(i) * naturalFrequency * naturalFrequency, joint.coulomb / frictionError);
    control.kp(i) = given ? joint.kp : stiffness;
    control.kd(i) = given ? joint.kd : 2. * std::sqrt(stiffness * inertia(i));
  }
  control.kp = spec.kp.size() > 0 ? spec.kp : control.kp;
  control.kd = spec.kd.size() > 0 ? spec.kd : control.kd;
  control.maxTorque = model.torque();
  control.compensateFriction = spec.compensateFriction;
  control.friction = vpJointFriction::of(model);
  return control;
}
} // namespace

void vpArmDriveSpec::validate(const vpArmModel &model) const
{
  requireGood("period", period, period >= 1e-6 && period <= vpArmPlant::longestStep, "> 0, from 1e-6 to 1");
  requireGood("frictionScale", frictionScale, frictionScale >= 0. && frictionScale <= vpArmLargest, ">= 0");
  requireGood("encoderNoise", encoderNoise, encoderNoise >= 0. && encoderNoise <= vpArmLargest, ">= 0");
  for (const vpJointVector *gain : {&kp, &kd}) {
    if (gain->size() > 0 && gain->size() != model.size()) {
      throw vpException(vpException::badValue, "%s of the arm's drives has %d numbers, must have %d or none",
                        gain == &kp ? "kp" : "kd", static_cast<int>(gain->size()), model.size());
    }
  }
}

vpArmDrives::vpArmDrives(const vpArmModel &model, const vpArmDriveSpec &spec) : m_model(&model), m_spec(spec)
{
  spec.validate(model);
  if (!spec.ideal) {
    m_plant.emplace(model, spec.frictionScale);
    m_dynamics.emplace(model);
    m_control.emplace(controlOf(model, spec));
  }
  reset(model.home());
}

void vpArmDrives::reset(const vpJointVector &q)
{
  if (q.size() != m_model->size() || !vpIsPlausibleForArm(q)) {
    throw vpException(vpException::badValue,
                      "the configuration of the arm's drives has %d numbers, must have %d finite ones",
                      static_cast<int>(q.size()), m_model->size());
  }
  m_wanted = q;
  m_command.setZero(q.size());
  m_output.torque.setZero(q.size());
  m_saturated = 0;
  m_random.seed(m_spec.seed);
  m_noise = std::normal_distribution<double>(0., 1.);
  if (m_plant) {
    m_plant->reset(q);
    m_dynamics->gravity(q, m_output.torque);
    m_estimator.reset();
    if (m_spec.encoderNoise > 0.) {
      m_estimator.emplace(m_model->size(), m_spec.period, estimatorBandwidth);
    }
  }
  measure();
}

bool vpArmDrives::move(const vpJointVector &velocity, double duration) noexcept
{
  m_saturated = 0;
  if (!(duration > 0. && duration <= longestMove)) {
    m_command.setZero();
    return false;
  }
  // As long as the desired position stays valid.
  const bool good = velocity.size() == m_wanted.size() && vpIsPlausibleForArm(velocity) &&
                    vpIsPlausibleForArm(m_wanted + duration * velocity);
  if (good) {
    m_command = velocity;
  }
  else {
    m_command.setZero();
  }
  if (m_spec.ideal) {
    m_wanted += duration * m_command;
    measure();
    return good;
  }
  const int cycles = std::max(1, static_cast<int>(std::ceil(duration / m_spec.period - 1e-9)));
  bool moved = good;
  for (int i = 0; i < cycles; ++i) {
    moved = cycle(duration / cycles) && moved;
  }
  return moved;
}

void vpArmDrives::holdHere() noexcept
{
  m_wanted = m_input.q;
  m_command.setZero();
}

bool vpArmDrives::cycle(double dt) noexcept
{
  m_wanted += dt * m_command;
  m_input.wantedQ = m_wanted;
  m_input.wantedVelocity = m_command;
  const bool known = m_dynamics->gravity(m_input.q, m_input.feedforward);
  m_control->step(m_input, m_output);
  m_saturated |= m_output.saturated;
  const bool moved = m_plant->step(m_output.torque, dt);
  measure();
  return known && m_output.valid && moved;
}

void vpArmDrives::measure() noexcept
{
  m_input.q = q();
  m_input.velocity = velocity();
  if (m_estimator) {
    for (Eigen::Index i = 0; i < m_input.q.size(); ++i) {
      m_input.q(i) += m_spec.encoderNoise * m_noise(m_random);
    }
    m_input.velocity = m_estimator->step(m_input.q);
  }
}

END_VISP_NAMESPACE
