/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpGoalConfiguration_h
#define vpGoalConfiguration_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief What was found of a goal.
enum class vpGoalConfigurationStatus {
  Free,        //!< A configuration that keeps the margin.
  InCollision, //!< The place can be reached, but no configuration that was found keeps the margin.
  Unreachable  //!< No configuration was found that brings the end effector there.
};

//! \ingroup group_avoidance
//! \brief A configuration and what it is worth.
struct VISP_EXPORT vpGoalConfiguration {
  vpGoalConfigurationStatus status = vpGoalConfigurationStatus::Unreachable; //!< Look at it before q.
  //! rad or m, within the position limits. InCollision: the first that was found, to tell what is in the way;
  //! Unreachable: empty.
  vpJointVector q;

  //! True when q may be moved to.
  [[nodiscard]] bool isFree() const noexcept { return status == vpGoalConfigurationStatus::Free; }
};

/*!
 * \ingroup group_avoidance
 * \brief Finds a configuration with the end effector's origin at a position, orientation free.
 *
 * Closed-loop inverse kinematics (vpClosedLoopKinematics) from \e from and, if that gives no free configuration, from
 * random configurations. Takes milliseconds; allocates.
 * \param scene : Arm and obstacles.
 * \param from : n numbers, rad or m: the answer is the first one found, so near here when the straight way leads there.
 * \param position : In the base, m. \param margin : Clearance wanted, m, >= 0.
 * \param attempts : Starts that are tried, >= 1. \param seed : Of the random ones, >= 1.
 * \return The first configuration that keeps the margin, or a status that says what is missing.
 * \throw vpException (badValue) when \e from does not fit the arm or \e position is not finite.
 */
[[nodiscard]] VISP_EXPORT vpGoalConfiguration vpFindGoalConfiguration(const vpCollisionScene &scene,
                                                                      const vpJointVector &from,
                                                                      const Eigen::Vector3d &position,
                                                                      double margin = 0., int attempts = 20,
                                                                      unsigned int seed = 1);

END_VISP_NAMESPACE
#endif
