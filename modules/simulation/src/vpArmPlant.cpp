/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpArmPlant.h>

#include <visp3/core/vpException.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

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

END_VISP_NAMESPACE
