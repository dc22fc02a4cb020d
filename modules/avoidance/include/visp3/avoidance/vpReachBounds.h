/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReachBounds.h
 * \brief Largest distances of an arm's links from its joint axes.
 */
#ifndef vpReachBounds_h
#define vpReachBounds_h

#include <visp3/manipulator/vpArmModel.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpReachBounds
 * \ingroup group_avoidance
 * \brief Reach bounds R(l, j), m: maximum distance of any point of the axes of link l's capsules from the axis of joint
 * j.
 *
 * Along dq the axis of a capsule on link l thus moves by at most sum_j R(l, j) |dq_j| (R = 1 for a prismatic joint that
 * carries it, 0 for joints behind it); so does any point of the convex hull of the link's axes. A point at a distance r
 * of that hull may be r farther from a revolute axis: R + r. Followers add the bounds of their axes times their ratios
 * to those of their joint: ofLink(); ofChain() has them one by one.
 *
 * The positions that these axes can take relative to joint j form a body; its convex hull is propagated from the link
 * inwards through the joints by its support function, as a body of revolution about every revolute axis: position
 * limits of revolute joints are ignored, those of prismatic joints apply, slightly widened, so the bounds hold for any
 * angle and wherever holds() is true. Between samples the support function is bounded from above by its sublinearity.
 * About 0.1 % above the true maximum without limits.
 *
 * \code
 * const vpReachBounds reach(arm);
 * if (reach.holds(q)) {
 *   std::cout << "0.1 rad of joint 1 move the last link by at most " << 0.1 * reach.ofLink(arm.links(), 0) << " m\n";
 * }
 * \endcode
 */
class VISP_EXPORT vpReachBounds
{
public:
  //! Computes the bounds, in some 1 ms for seven joints: for set-up. vpArmModel::derived() shares them.
  explicit vpReachBounds(const vpArmModel &arm);

  //! R(l, joint) of the link l of a capsule, both from 0.
  [[nodiscard]] double operator()(int capsule, int joint) const noexcept
  {
    return ofLink(m_links[static_cast<std::size_t>(capsule)], joint);
  }
  //! R(link, joint), link 0..l (0: the base), joint 0..n-1; 0 for a link without capsules.
  [[nodiscard]] double ofLink(int link, int joint) const noexcept
  {
    return m_bounds[static_cast<std::size_t>(link * m_joints + joint)];
  }
  //! R(link, k) for joint or follower k of the chain alone, 0..l-1, per unit of its own coordinate.
  [[nodiscard]] double ofChain(int link, int k) const noexcept
  {
    return m_alone[static_cast<std::size_t>(link) * m_chain.size() + static_cast<std::size_t>(k)];
  }

  //! True if the bounds hold for all configurations within \e way (rad or m, >= 0) of \e q (of the arm's size): finite,
  //! and every prismatic joint within its position limits, or beyond them by at most 1/20 of its range.
  [[nodiscard]] bool holds(const vpJointVector &q, const vpJointVector &way) const noexcept;
  //! True if the bounds hold at \e q.
  [[nodiscard]] bool holds(const vpJointVector &q) const noexcept { return holds(q, vpJointVector::Zero(q.size())); }

private:
  void follow(const vpArmModel &arm, int link);

  int m_joints = 0;
  std::vector<vpArmChainJoint> m_chain;
  vpJointVector m_low, m_high; // limits of the chain's coordinates within which the bounds hold
  std::vector<int> m_links;    // of the capsules
  std::vector<double> m_bounds, m_alone;
};

END_VISP_NAMESPACE
#endif
