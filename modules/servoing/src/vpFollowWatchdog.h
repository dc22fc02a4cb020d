/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFollowWatchdog.h
 * \brief Compares the commanded with the observed motion of a robot.
 */
#ifndef vpFollowWatchdog_h
#define vpFollowWatchdog_h

#include "vpRigidMotion.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Sums commanded motions, and what the observed ones lack of them, over about a second. A robot may lag and lose a
 * little to friction: it does not follow if more than half of the commanded motion and a tolerance are missing.
 */
class vpFollowWatchdog
{
public:
  void reset() noexcept { *this = vpFollowWatchdog(); }
  void command(const vpTwist &motion) noexcept
  {
    add(motion, m_commanded);
    add(motion, m_missing);
  }
  void observe(const vpTwist &motion) noexcept { add(motion.scaled(-1.), m_missing); }
  //! The time that passed.
  void pass(double time) noexcept
  {
    const double kept = std::max(0., 1. - time / memory);
    m_commanded = m_commanded.scaled(kept);
    m_missing = m_missing.scaled(kept);
  }
  //! \param length, angle : Tolerances, m and rad.
  [[nodiscard]] bool isFollowing(double length, double angle) const noexcept
  {
    return m_missing.linearNorm() <= length + 0.5 * m_commanded.linearNorm() &&
           m_missing.angularNorm() <= angle + 0.5 * m_commanded.angularNorm();
  }

private:
  static constexpr double memory = 1.; // s

  static void add(const vpTwist &motion, vpTwist &sum) noexcept
  {
    for (std::size_t i = 0; i < 6; ++i) {
      sum[i] += motion[i];
    }
  }
  vpTwist m_commanded, m_missing;
};

END_VISP_NAMESPACE
#endif
