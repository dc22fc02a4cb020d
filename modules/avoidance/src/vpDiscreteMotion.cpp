/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpDiscreteMotion.h>
#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

const char *vpMotionResult::message() const noexcept
{
  switch (status) {
  case vpMotionStatus::Free:
    return "the motion is free";
  case vpMotionStatus::Collision:
    return "the motion collides";
  case vpMotionStatus::Undecided:
    return "the motion comes so near to the margin that it cannot be decided";
  default:
    return "a configuration has the wrong size, is not finite or is out of all range";
  }
}

bool vpSceneChecker::inCollision(const vpJointVector &q, double margin)
{
  m_scene->place(q, m_data);
  return m_scene->inCollision(m_data, margin);
}

vpClearance vpSceneChecker::clearance(const vpJointVector &q, double cutoff)
{
  m_scene->place(q, m_data);
  return m_scene->clearance(m_data, cutoff);
}

vpDiscreteMotion::vpDiscreteMotion(vpCollisionChecker &checker, double step, double margin)
  : m_checker(&checker), m_step(step), m_margin(margin)
{
  if (!std::isfinite(step) || !(step > 0.)) {
    throw vpException(vpException::badValue, "step of the discrete motion is %g, must be > 0 and finite", step);
  }
  if (!std::isfinite(margin) || !(margin >= 0.)) {
    throw vpException(vpException::badValue, "margin of the discrete motion is %g m, must be >= 0 and finite", margin);
  }
}

vpMotionResult vpDiscreteMotion::check(const vpJointVector &from, const vpJointVector &to)
{
  vpMotionResult result;
  if (from.size() != m_checker->jointCount() || to.size() != from.size() || !from.allFinite() || !to.allFinite()) {
    return result;
  }
  const vpJointVector change = to - from;
  const double steps = std::ceil(change.lpNorm<Eigen::Infinity>() / m_step);
  if (!(steps < 1e8)) {
    return result;
  }
  const int n = std::max(1, static_cast<int>(steps));
  const auto collides = [&](int k) {
    ++result.evaluated;
    const double s = static_cast<double>(k) / n;
    const vpJointVector q = from + s * change;
    if (!m_checker->inCollision(q, m_margin)) {
      return false;
    }
    result.status = vpMotionStatus::Collision;
    result.s = s;
    result.pair = m_checker->clearance(q, std::numeric_limits<double>::infinity());
    return true;
  };
  if (collides(0) || collides(n)) {
    return result;
  }
  // Midpoints of ever shorter intervals: k = odd multiples of n / 2, n / 4, ... each inner sample once.
  int top = 1;
  while (top < n) {
    top *= 2;
  }
  for (int piece = top; piece > 1; piece /= 2) {
    for (int k = piece / 2; k < n; k += piece) {
      if (collides(k)) {
        return result;
      }
    }
  }
  result.status = vpMotionStatus::Free;
  return result;
}

END_VISP_NAMESPACE
