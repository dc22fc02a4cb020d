/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/servoing/vpArmMotionCheck.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

BEGIN_VISP_NAMESPACE

namespace
{
// What may be missing of a twist; a singularity may take a little.
constexpr double shortfall = 1e-3, dampedShortfall = 0.02;
// Of the limits of jerk, the part for the copy: the arm's period is another one.
constexpr double jerkPart = 0.9;
// Near a singularity or a joint limit no factor is exact: a slower motion leaves the self-motion time to get past it.
constexpr double slower = 1.5;
constexpr double step = 0.01; // s, the period of the copy's solver

vpRedundancySpec withPeriod(vpRedundancySpec spec)
{
  spec.period = step;
  return spec;
}
} // namespace

vpArmMotionCheck::vpArmMotionCheck(const vpArmModel &model, const vpRedundancySpec &spec,
                                   const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free,
                                   const vpJointVector &jerk, vpArmFrame frame)
  : m_model(&model), m_spec(withPeriod(spec)), m_solver(model, m_spec), m_q(model.home()),
    m_velocity(vpJointVector::Zero(model.size())), m_place(m_q), m_jerk(jerk), m_acceleration(m_velocity)
{
  if (jerk.size() != 0 && jerk.size() != model.size()) {
    throw vpException(vpException::badValue, "the arm has %d joints and %d limits of jerk, must have as many or none",
                      model.size(), static_cast<int>(jerk.size()));
  }
  for (int i = 0; i < jerk.size(); ++i) {
    if (!(jerk(i) > 0.)) {
      throw vpException(vpException::badValue, "the limit of jerk of joint %s is %g, must be > 0",
                        model.spec().joints[static_cast<std::size_t>(i)].name.c_str(), jerk(i));
    }
  }
  m_input.frame = frame;
  m_input.free = free;
  m_input.indexCount = static_cast<int>(std::min<std::size_t>(indices.size(), vpMaxArmIndices));
  std::copy_n(indices.begin(), m_input.indexCount, m_input.indices.begin());
  m_input.previous = m_velocity;
}

void vpArmMotionCheck::setState(const vpJointVector &q, const vpJointVector &velocity) noexcept
{
  m_q = q;
  m_velocity = velocity;
}

void vpArmMotionCheck::begin() noexcept
{
  m_place = m_q;
  m_input.previous = m_velocity;
  m_isAccelerationKnown = false;
}

// Of the step of the copy that was taken last.
double vpArmMotionCheck::jerkExcess(double dt) noexcept
{
  double excess = 0.;
  for (int i = 0; i < m_jerk.size(); ++i) {
    const double acceleration = (m_output.velocity(i) - m_input.previous(i)) / dt;
    const double share = std::abs(acceleration - m_acceleration(i)) / dt / (jerkPart * m_jerk(i));
    m_acceleration(i) = acceleration;
    excess = share <= excess ? excess : share;
  }
  return std::exchange(m_isAccelerationKnown, true) ? std::cbrt(excess) : 0.;
}

double vpArmMotionCheck::add(const vpTwist &twist, double dt) noexcept
{
  if (!vpArmKinematics::update(*m_model, m_place, m_data)) {
    return std::numeric_limits<double>::infinity();
  }
  m_input.twist = twist;
  m_solver.step(m_data, m_input, m_output);
  m_place += dt * m_output.velocity;
  const double jerk = jerkExcess(dt);
  m_input.previous = m_output.velocity;
  const double limits = armExcess();
  return jerk <= limits ? limits : jerk;
}

double vpArmMotionCheck::armExcess() const noexcept
{
  switch (m_output.status) {
  case vpRedundancyStatus::Exact:
    return 0.;
  case vpRedundancyStatus::Accelerating:
  case vpRedundancyStatus::Scaled:
    return m_output.taskShare >= 1. - shortfall ? 1. : std::min(1. / m_output.taskShare, slower);
  case vpRedundancyStatus::Damped:
  case vpRedundancyStatus::Escaping:
  case vpRedundancyStatus::JointsStopped:
    return m_output.taskShare >= 1. - dampedShortfall ? 1. : slower;
  default:
    return std::numeric_limits<double>::infinity();
  }
}

END_VISP_NAMESPACE
