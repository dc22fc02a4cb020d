/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpGoalConfiguration_h
#define vpGoalConfiguration_h

#include <visp3/avoidance/vpCollisionScene.h>

#include <optional>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief A configuration that brings the end effector's origin to a place, the orientation left free.
 *
 * Closed-loop inverse kinematics (vpClosedLoopKinematics) from \e from and, if that leads to no free configuration, from
 * random ones. Takes milliseconds; allocates.
 * \param scene : Arm and obstacles.
 * \param from : n numbers, rad or m: the answer is the first one found, so near here when the straight way leads there.
 * \param position : In the base, m. \param margin : Clearance wanted, m, >= 0.
 * \param attempts : Starts that are tried, >= 1. \param seed : Of the random ones, >= 1.
 * \return A configuration within the position limits, free with the margin when there is one among those found and else
 * the first found; none when the place cannot be reached.
 * \throw vpException (badValue) when \e from does not fit the arm or \e position is not finite.
 */
[[nodiscard]] VISP_EXPORT std::optional<vpJointVector>
goalConfiguration(const vpCollisionScene &scene, const vpJointVector &from, const Eigen::Vector3d &position,
                  double margin = 0., int attempts = 20, unsigned int seed = 1);

END_VISP_NAMESPACE
#endif
