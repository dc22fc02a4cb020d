/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpRedundancyCycle.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double slack = 1e-9;     // rad/s: tolerance of bounds
constexpr double exactness = 1e-6; // relative error of the velocity that still counts as exact
constexpr double least = 1e-3;     // m/s: slower requests have the absolute tolerance of this one

template <class Joints> void toVector(const Joints &from, int n, vpJointVector &to) { to = from.head(n); }
} // namespace

template <int N> void vpRedundancyCycle<N>::setMainTask()
{
  const vpArmJacobian J = vpArmKinematics::geometric(m_model, m_data, m_input.frame);
  unsigned int axes = 0;
  for (int k = 0; k < 6; ++k) {
    const std::size_t component = static_cast<std::size_t>(k);
    if (!m_input.free[component]) {
      const double unit = k < 3 ? 1. : m_spec.taskLength;
      for (int i = 0; i < m_n; ++i) {
        m_B(i, m_rows) = unit * J(k, i) * m_scale(i);
      }
      m_r(m_rows) = unit * m_input.twist[component];
      m_row[static_cast<std::size_t>(m_rows++)] = k;
      axes |= 1U << k;
    }
  }
  m_lacking = m_lackTable[64U * static_cast<unsigned int>(m_input.frame) + axes];
}

// Rows without the joints that are stopped.
template <int N> typename vpRedundancyCycle<N>::Rows vpRedundancyCycle<N>::moving(Rows B) const
{
  for (int i = 0; i < m_n; ++i) {
    if (isStopped(i)) {
      B.row(i).setZero();
    }
  }
  return B;
}

/*!
 * The axes whose unit vectors lie most in the directions that the arm lacks, by pivoted Gram-Schmidt: without them the
 * rest of the task has full rank. Rotations count double: a camera rather leaves one of these than its place.
 */
template <int N> void vpRedundancyCycle<N>::findUnreachable()
{
  Eigen::Matrix<double, 6, 6> U = Eigen::Matrix<double, 6, 6>::Zero(); // a row for each row of the task
  U.topLeftCorner(m_rows, m_lacking) = m_info.lacking.topLeftCorner(m_rows, m_lacking);
  m_beyond = (U.transpose() * m_r).norm();
  m_unreachable = 0;
  for (int k = 0; k < m_lacking; ++k) {
    Eigen::Index most = 0;
    Task size = U.rowwise().squaredNorm();
    for (int i = 0; i < m_rows; ++i) {
      size(i) *= m_row[static_cast<std::size_t>(i)] < 3 ? 1. : 4.;
    }
    size.maxCoeff(&most);
    const Task unit = U.row(most).transpose().normalized();
    U -= (U * unit * unit.transpose()).eval();
    m_unreachable |= 1U << m_row[static_cast<std::size_t>(most)];
  }
}

// Joint motion out of a singularity, in weighted coordinates.
template <int N> typename vpRedundancyCycle<N>::Joints vpRedundancyCycle<N>::escape(const Rows &B, const Joints &y)
{
  double demand = 0.;
  Eigen::Matrix<double, 6, 1> lost = Eigen::Matrix<double, 6, 1>::Zero(); // lost direction in components of the twist
  Joints slope = Joints::Zero();
  for (int i = 0; i < m_rows; ++i) {
    const int k = m_row[static_cast<std::size_t>(i)];
    const double u = m_info.lost(i);
    demand += u * m_r(i);
    lost(k) = u * (k < 3 ? 1. : m_spec.taskLength);
    slope += u * B.col(i);
  }
  if (!(std::fabs(demand) > 1e-9)) {
    return Joints::Zero();
  }
  // Space that neither the regular directions nor stopped joints need.
  typename Level::Basis regular;
  Joints mayMove = Joints::Zero();
  for (int i = 0; i < m_n; ++i) {
    mayMove(i) = isStopped(i) ? 0. : 1.;
  }
  for (int i = 0; i < m_basis.count; ++i) {
    const Joints v = m_basis.vectors.col(i);
    if (std::fabs(slope.dot(v)) < 0.5 * slope.norm() || slope.norm() < 1e-6) {
      regular.add(v);
    }
  }
  const Square H = Escape::curvature(m_model, m_data, m_input.frame, lost, m_scale);
  Joints z;
  if (!Escape::direction(Escape::room(regular, mayMove), H, demand > 0. ? 1. : -1., slope, y, z)) {
    return Joints::Zero();
  }
  // A joint at its limit decides between the two signs if it can follow only one.
  const auto possible = [&](double sign) {
    for (int i = 0; i < m_n; ++i) {
      if ((sign * z(i) > 0.05 && m_bounds.upper(i) < 1e-6) || (sign * z(i) < -0.05 && m_bounds.lower(i) > -1e-6)) {
        return false;
      }
    }
    return true;
  };
  if (!possible(1.) && possible(-1.)) {
    z = -z;
  }
  m_escaping = true;
  const double ratio = m_info.smallest / m_spec.singularRegion;
  const double speed =
      m_spec.escapeSpeed * (1. - ratio * ratio) * std::min(1., std::fabs(demand) / m_spec.escapeDemand);
  return speed / std::max(1e-9, m_scale.cwiseProduct(z).norm()) * z;
}

// Largest share of the task, y = share * a + b, at which no joint exceeds its velocity limit; negative if there is
// none.
template <int N> double vpRedundancyCycle<N>::shareWithin(const Joints &a, const Joints &b) const
{
  double low = 0., top = 1.;
  for (int i = 0; i < m_n; ++i) {
    const double limit = m_bounds.velocityLimit(i) / m_scale(i), slope = std::fabs(a(i));
    const double along = a(i) < 0. ? -b(i) : b(i);
    if (isStopped(i) || isSaturated(i)) {
      continue;
    }
    if (slope > 1e-12 * limit) {
      low = std::max(low, (-limit - along) / slope);
      top = std::min(top, (limit - along) / slope);
    }
    else if (std::fabs(along) > limit) {
      return -1.;
    }
  }
  return low <= top ? top : -1.;
}

/*!
 * Saturation in the null space: the joint that exceeds its velocity limit most is held at it by a motion that leaves
 * the task unchanged, and the next one, while the task's share grows. Returns this share of y.
 */
template <int N> double vpRedundancyCycle<N>::saturate(Joints &y)
{
  constexpr int rounds = 4;
  constexpr double smallest = 1e-6; // squared length of the part of a joint's own direction that is free
  m_saturated = 0;
  bool within = true;
  for (int i = 0; i < m_n; ++i) {
    within = within && std::fabs(y(i)) * m_scale(i) <= m_bounds.velocityLimit(i);
  }
  if (within || m_escaping || m_spec.policy == vpLimitPolicy::ScaleMotion) {
    return 1.; // the limits scale the whole motion later
  }
  double best = shareWithin(y, Joints::Zero());
  Joints a = y, b = Joints::Zero();
  int count = m_basis.count;
  unsigned int saturated = 0;
  y *= best;
  for (int round = 0; round < rounds; ++round) {
    int worst = -1;
    double most = 1.;
    for (int i = 0; i < m_n; ++i) {
      const double over = std::fabs(a(i) + b(i)) * m_scale(i) / m_bounds.velocityLimit(i);
      if (!isStopped(i) && !isSaturated(i) && over > most) {
        most = over;
        worst = i;
      }
    }
    const Joints v = worst < 0 ? Joints(Joints::Zero()) : m_basis.free(Joints::Unit(worst));
    const double length2 = v.squaredNorm();
    if (!(length2 > smallest)) {
      break; // no joint, or the task needs it
    }
    const double limit = std::copysign(m_bounds.velocityLimit(worst) / m_scale(worst), a(worst) + b(worst));
    a -= v * (a(worst) / length2);
    b += v * ((limit - b(worst)) / length2);
    m_basis.add(v / std::sqrt(length2));
    m_saturated |= 1U << worst;
    const double share = shareWithin(a, b);
    if (share > best) {
      best = share;
      y = share * a + b;
      count = m_basis.count;
      saturated = m_saturated;
    }
  }
  m_basis.count = count;
  m_saturated = saturated;
  return best;
}

// All tasks in order, with the stopped joints at their velocities.
template <int N> void vpRedundancyCycle<N>::solveTasks()
{
  const typename Level::Options options{m_spec.singularRegion, m_spec.damping, 0};
  const typename Level::Options ofMain{m_spec.singularRegion, m_spec.damping, m_lacking};
  m_basis.count = 0;
  m_escaping = false;
  // Motion of the stopped joints; the other joints compensate its effect on the task.
  Task r = m_r;
  Joints held = Joints::Zero();
  for (int i = 0; i < m_n; ++i) {
    if (isStopped(i)) {
      held(i) = m_held(i) / m_scale(i);
    }
  }
  for (int i = 0; i < m_rows; ++i) {
    r(i) -= m_B.col(i).dot(held);
  }
  const Rows B = moving(m_B);
  Joints y = Joints::Zero();
  m_info = Level::solve(B, r, m_rows, ofMain, m_basis, y);
  if (m_lacking > 0 && m_stopped == 0U) { // stopped joints would hide it
    findUnreachable();
  }
  if (m_info.singular && m_spec.escapeSpeed > 0.) {
    y += escape(B, y);
  }
  m_share = saturate(y);
  held *= m_share;
  for (int t = 0; t < m_input.taskCount; ++t) {
    const vpArmTask &task = m_input.tasks[static_cast<std::size_t>(t)];
    Rows lower = Rows::Zero();
    Task wanted = Task::Zero();
    for (int k = 0; k < task.rows; ++k) {
      wanted(k) = m_share * task.velocity(k);
      for (int i = 0; i < m_n; ++i) {
        lower(i, k) = task.J(k, i) * m_scale(i);
      }
      wanted(k) -= lower.col(k).dot(held);
    }
    static_cast<void>(Level::solve(moving(lower), wanted, task.rows, options, m_basis, y));
  }
  m_motion = m_scale.cwiseProduct(y + held);
}

// Stops the joint that exceeds its position bound most. False if none does.
template <int N> bool vpRedundancyCycle<N>::stopWorst()
{
  int worst = -1;
  double most = slack;
  for (int i = 0; i < m_n; ++i) {
    const double v = m_motion(i);
    // A bound equal to the velocity limit is not a position bound.
    const double over = std::max(m_bounds.upper(i) < m_bounds.velocityLimit(i) ? v - m_bounds.upper(i) : 0.,
                                 m_bounds.lower(i) > -m_bounds.velocityLimit(i) ? m_bounds.lower(i) - v : 0.);
    if (!isStopped(i) && over > most) {
      most = over;
      worst = i;
    }
  }
  if (worst < 0) {
    return false;
  }
  m_stopped |= 1U << worst;
  m_held(worst) = m_motion(worst) > 0. ? m_bounds.upper(worst) : m_bounds.lower(worst);
  return true;
}

// Largest factor up to 1 that brings the motion within its bounds.
template <int N> double vpRedundancyCycle<N>::scaleWithin() const
{
  double scale = 1.;
  for (int i = 0; i < m_n; ++i) {
    const double v = std::fabs(m_motion(i)), bound = m_bounds.velocityLimit(i);
    scale = v > bound && !isSaturated(i) ? std::min(scale, bound / v) : scale;
  }
  if (m_spec.policy == vpLimitPolicy::ScaleMotion) {
    vpJointVector direction;
    toVector(scale * m_motion, m_n, direction);
    scale *= m_bounds.together(m_model, direction, m_spec.period);
  }
  return scale;
}

// Joint velocities of the part of z that moves neither the tasks nor a joint that is held at a limit.
template <int N> typename vpRedundancyCycle<N>::Joints vpRedundancyCycle<N>::freeMotion(const Joints &z) const
{
  Joints motion = m_scale.cwiseProduct(m_basis.free(z));
  for (int i = 0; i < m_n; ++i) {
    motion(i) = isSaturated(i) ? 0. : motion(i); // not even by rounding
  }
  return motion;
}

// Moves the last self-motion towards the new one with a fraction of the accelerations; the task has the rest.
template <int N> typename vpRedundancyCycle<N>::Joints vpRedundancyCycle<N>::slowlyChanged(const Joints &wanted) const
{
  Joints before = Joints::Zero();
  for (int i = 0; i < m_n; ++i) {
    before(i) = isStopped(i) ? 0. : m_input.previous(i) / m_scale(i);
  }
  before = freeMotion(before);
  double share = 1.;
  for (int i = 0; i < m_n; ++i) {
    const double change = std::fabs(wanted(i) - before(i));
    share =
        std::min(share, m_spec.selfAcceleration * m_model.acceleration()(i) * m_spec.period / std::max(1e-12, change));
  }
  return before + share * (wanted - before);
}

// Self-motion in joint velocities: gradient, projection, k0, reduced to the bounds.
template <int N> typename vpRedundancyCycle<N>::Joints vpRedundancyCycle<N>::selfMotion() const
{
  Joints gradient = Joints::Zero();
  vpIndexValue index;
  for (int k = 0; k < m_input.indexCount; ++k) {
    const vpSelfMotionIndex &wish = m_input.indices[static_cast<std::size_t>(k)];
    if (wish.gain > 0. && vpEvaluateIndex(m_model, m_data, wish, index)) {
      for (int i = 0; i < m_n; ++i) {
        gradient(i) += wish.gain * index.gradient(i);
      }
    }
  }
  for (int i = 0; i < m_n; ++i) {
    gradient(i) = isStopped(i) ? 0. : gradient(i) * m_scale(i);
  }
  Joints motion = freeMotion(gradient);
  const double length = motion.norm();
  if (!(length > 1e-12 * (1. + gradient.norm()))) {
    return Joints::Zero();
  }
  motion *= m_input.selfMotionShare * m_spec.selfMotion * std::max(m_motion.norm(), m_spec.minSelfMotion) /
            std::max(length, m_spec.softGradient);
  if (m_spec.selfAcceleration > 0.) {
    motion = slowlyChanged(motion);
  }
  double room = 1.;
  for (int i = 0; i < m_n; ++i) {
    const double bound = motion(i) > 0. ? m_bounds.upper(i) - m_motion(i) : m_motion(i) - m_bounds.lower(i);
    if (std::fabs(motion(i)) > std::max(0., bound)) {
      room = std::min(room, std::max(0., bound) / std::fabs(motion(i)));
    }
  }
  vpJointVector direction;
  toVector(room * motion, m_n, direction);
  return m_bounds.together(m_model, direction, m_spec.period) * room * motion;
}

// Share of the request that is done, and likeness with it.
template <int N> typename vpRedundancyCycle<N>::Likeness vpRedundancyCycle<N>::compare(vpRedundancyOutput &output) const
{
  double done = 0., missed = 0.;
  for (int i = 0; i < m_rows; ++i) {
    double rate = 0.;
    for (int k = 0; k < m_n; ++k) {
      rate += m_B(k, i) / m_scale(k) * output.velocity(k);
    }
    done += rate * m_r(i);
    missed += (rate - m_r(i)) * (rate - m_r(i));
  }
  const double wanted = m_r.squaredNorm();
  output.taskShare = wanted > 1e-18 ? std::min(1., std::max(0., done / wanted)) : 1.;
  const double tolerance = exactness * (std::sqrt(wanted) + least);
  const double along =
      wanted > 0. ? (wanted - done) * (wanted - done) / wanted : 0.; // fraction in the requested direction
  return {std::sqrt(missed) <= tolerance, std::sqrt(std::max(0., missed - along)) <= tolerance};
}

template <int N>
vpRedundancyStatus vpRedundancyCycle<N>::judge(bool accelerating, bool clamped, const Likeness &likeness,
                                               const vpRedundancyOutput &output) const
{
  const bool wanted = m_r.norm() > 1e-9;
  const bool little = wanted && output.taskShare < 0.01 && !accelerating;
  const bool limits = m_stopped != 0U || output.scale < 1.;
  if (little && limits) {
    return vpRedundancyStatus::BlockedByLimits;
  }
  if (m_beyond > exactness * (m_r.norm() + least)) {
    return vpRedundancyStatus::AxisUnreachable;
  }
  if (little && m_info.singular && !m_escaping) {
    return vpRedundancyStatus::BlockedBySingularity;
  }
  if ((m_stopped != 0U && !likeness.exact) || clamped) {
    return vpRedundancyStatus::JointsStopped;
  }
  if (m_escaping) {
    return vpRedundancyStatus::Escaping;
  }
  if (output.scale < 1. && likeness.onPath) {
    return vpRedundancyStatus::Scaled;
  }
  if (m_info.singular && !likeness.exact && !accelerating) {
    return vpRedundancyStatus::Damped;
  }
  return likeness.exact && !accelerating ? vpRedundancyStatus::Exact : vpRedundancyStatus::Accelerating;
}

template <int N> bool vpRedundancyCycle<N>::run(vpRedundancyOutput &output) noexcept
{
  setMainTask();
  m_bounds.update(m_model, m_data.q, m_input.previous, m_spec.period, m_spec.positionMargin);
  do {
    solveTasks();
  } while (m_spec.policy == vpLimitPolicy::StopJoints && stopWorst());
  const double scale = scaleWithin();
  m_motion *= scale;
  output.scale = scale * m_share;
  Joints motion = m_motion;
  if (m_input.indexCount > 0 && m_input.selfMotionShare > 0. && m_spec.selfMotion > 0.) {
    const Joints self = selfMotion();
    toVector(self, m_n, output.selfMotion);
    motion += self;
  }
  if (!motion.allFinite()) { // the tasks have no finite solution
    return false;
  }

  // One factor on the change of velocity for all joints, so that a start from rest keeps its direction.
  double blend = 1.;
  for (int i = 0; i < m_n; ++i) {
    const double change = std::fabs(motion(i) - m_input.previous(i)), most = m_spec.period * m_model.acceleration()(i);
    blend = change > most ? std::min(blend, most / change) : blend;
  }
  bool clamped = false;
  output.velocity.resize(m_n);
  for (int i = 0; i < m_n; ++i) {
    const double wanted = m_input.previous(i) + blend * (motion(i) - m_input.previous(i));
    output.velocity(i) = m_bounds.clamp(i, wanted);
    clamped = clamped || std::fabs(output.velocity(i) - wanted) > 1e-6;
  }

  const Likeness likeness = compare(output);
  output.smallestSingular = m_info.smallest;
  output.stoppedJoints = m_stopped;
  output.saturatedJoints = m_saturated;
  output.unreachableAxes = m_unreachable;
  output.status = judge(blend < 1., clamped, likeness, output);
  return true;
}

template class vpRedundancyCycle<8>;
template class vpRedundancyCycle<vpArmMaxJoints>;

END_VISP_NAMESPACE
