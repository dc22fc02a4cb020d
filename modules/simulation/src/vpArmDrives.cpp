/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpArmDriveGains.h"

#include <visp3/simulation/vpArmDrives.h>
#include <visp3/simulation/vpArmPlant.h>

#include <visp3/core/vpException.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstdio>
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
void requireGood(const char *field, double value, bool good, const char *range)
{
  if (!good || !std::isfinite(value)) {
    throw vpException(vpException::badValue, "%s of the arm's drives is %g, must be %s and finite", field, value,
                      range);
  }
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

double vpJointShortfall::missing() const noexcept
{
  return std::max(0., std::fabs(needed) - std::copysign(1., needed) * given);
}

std::string vpJointShortfall::message(const vpArmModel &model) const
{
  if (joint < 0 || joint >= model.size()) {
    return "";
  }
  const char *unit = model.isPrismatic(joint) ? "N" : "Nm";
  char text[160];
  std::snprintf(text, sizeof(text), "the motion takes %.3g %s, the drive gives %.3g %s", std::fabs(needed), unit,
                std::copysign(1., needed) * given, unit);
  std::string sentence = text;
  if (std::isfinite(model.torque()(joint))) {
    std::snprintf(text, sizeof(text), " of at most %.3g %s", model.torque()(joint), unit);
    sentence += text;
  }
  if (missing() > 0.) {
    std::snprintf(text, sizeof(text), ", %.3g %s are missing", missing(), unit);
    sentence += text;
  }
  return sentence;
}

vpArmDrives::vpArmDrives(const vpArmModel &model, const vpArmDriveSpec &spec) : m_model(&model), m_spec(spec)
{
  spec.validate(model);
  if (!spec.ideal) {
    m_plant.emplace(model, spec.frictionScale);
    m_dynamics.emplace(model);
    m_control.emplace(vpDriveControlOf(model, spec));
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
  m_needed.setZero(q.size());
  m_saturated = 0;
  m_random.seed(m_spec.seed);
  m_noise = std::normal_distribution<double>(0., 1.);
  if (m_plant) {
    m_plant->reset(q);
    m_dynamics->gravity(q, m_output.torque);
    m_estimator.reset();
    if (m_spec.encoderNoise > 0.) {
      m_estimator.emplace(m_model->size(), m_spec.period, vpDriveEstimatorBandwidth);
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
  const vpJointVector before = m_command;
  if (m_spec.reference == vpDriveReference::Measured && m_plant && velocity.size() == m_wanted.size() &&
      (velocity.array() != 0.).any()) {
    m_wanted = m_input.q;
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
  updateNeeded(before, duration);
  const int cycles = std::max(1, static_cast<int>(std::ceil(duration / m_spec.period - 1e-9)));
  bool moved = good;
  for (int i = 0; i < cycles; ++i) {
    moved = cycle(duration / cycles) && moved;
  }
  return moved;
}

void vpArmDrives::updateNeeded(const vpJointVector &before, double duration) noexcept
{
  vpJointMatrix M;
  vpJointVector coriolis, gravity, friction;
  m_needed.setZero();
  if (m_dynamics->inertia(q(), M) && m_dynamics->coriolis(q(), m_command, coriolis) &&
      m_dynamics->gravity(q(), gravity) && m_plant->friction().torque(m_command, friction)) {
    m_needed = M * (m_command - before) / duration + coriolis + gravity + friction;
  }
  if (!vpIsPlausibleForArm(m_needed)) {
    m_needed.setZero();
  }
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
