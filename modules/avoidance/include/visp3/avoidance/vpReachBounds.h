/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReachBounds.h
 * \brief How far the capsules of an arm can be from its axes.
 */
#ifndef vpReachBounds_h
#define vpReachBounds_h

#include <visp3/manipulator/vpArmModel.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpReachBounds
 * \ingroup group_avoidance
 * \brief R(i, j): no point of the axis of capsule i is ever farther from the axis of joint j, m.
 *
 * So along dq the axis of capsule i moves by no more than sum_j R(i, j) |dq_j| (R = 1 for a prismatic joint that
 * carries it, 0 for joints behind it).
 *
 * The places that a capsule can take seen from joint j form a body; its convex hull is carried from the capsule inwards
 * through the joints by its support function, taken as a body of revolution about every revolute axis: position
 * limits of revolute joints are left out, those of prismatic joints count, a little widened, so the bounds hold for any
 * angle and wherever holds() says so. Between samples the support function is bounded from above by its sublinearity. About 0.1 % above the true maximum without limits.
 */
class VISP_EXPORT vpReachBounds
{
public:
  //! Takes some 10 ms; for set-up.
  explicit vpReachBounds(const vpArmModel &arm);

  //! R(capsule, joint), both from 0.
  [[nodiscard]] double operator()(int capsule, int joint) const noexcept
  {
    return m_bounds[static_cast<std::size_t>(capsule * m_joints + joint)];
  }

  //! True when the bounds hold for configuration \e q (of the arm's size) and \e way (rad or m, >= 0) about it: finite, and
  //! every prismatic joint within its position limits, or beyond them by no more than a twentieth of its range.
  [[nodiscard]] bool holds(const vpJointVector &q, const vpJointVector &way) const noexcept;
  //! The same for \e q alone.
  [[nodiscard]] bool holds(const vpJointVector &q) const noexcept { return holds(q, vpJointVector::Zero(q.size())); }

private:
  int m_joints = 0;
  vpJointVector m_low, m_high; // within which they hold
  std::vector<double> m_bounds;
};

END_VISP_NAMESPACE
#endif
