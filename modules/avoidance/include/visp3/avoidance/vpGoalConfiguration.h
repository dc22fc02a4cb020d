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
 * \brief Finds a configuration with the end effector's origin at a position, orientation free.
 *
 * Closed-loop inverse kinematics (vpClosedLoopKinematics) from \e from and, if that gives no free configuration, from
 * random configurations. Takes milliseconds; allocates.
 * \param scene : Arm and obstacles.
 * \param from : First start, n numbers, rad or m; the result is near it if the direct motion succeeds.
 * \param position : In the base, m. \param margin : Required clearance, m, >= 0.
 * \param attempts : Number of starts, >= 1. \param seed : Seed of the random starts, >= 1.
 * \return A configuration within the position limits: the first found that is free with the margin, else the first
 * found; none if the position is unreachable.
 * \throw vpException (badValue) if \e from does not fit the arm or \e position is not finite.
 */
[[nodiscard]] VISP_EXPORT std::optional<vpJointVector>
goalConfiguration(const vpCollisionScene &scene, const vpJointVector &from, const Eigen::Vector3d &position,
                  double margin = 0., int attempts = 20, unsigned int seed = 1);

END_VISP_NAMESPACE
#endif
