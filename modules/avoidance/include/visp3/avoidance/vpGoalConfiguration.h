/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpGoalConfiguration_h
#define vpGoalConfiguration_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief Result of the search for a goal configuration.
enum class vpGoalConfigurationStatus {
  Free,        //!< A configuration that keeps the margin.
  InCollision, //!< The place can be reached, but no configuration that was found keeps the margin.
  Unreachable  //!< No configuration was found that brings the end effector there.
};

//! \ingroup group_avoidance
//! \brief A configuration and the result of the search for it.
struct VISP_EXPORT vpGoalConfiguration {
  vpGoalConfigurationStatus status = vpGoalConfigurationStatus::Unreachable; //!< Read it before #q.
  //! Configuration, rad or m, within the position limits. InCollision: the first that was found, for a message;
  //! Unreachable: empty.
  vpJointVector q;

  //! True when q may be moved to.
  [[nodiscard]] bool isFree() const noexcept { return status == vpGoalConfigurationStatus::Free; }
  //! Status as a readable sentence.
  [[nodiscard]] const char *message() const noexcept;
};

/*!
 * \ingroup group_avoidance
 * \brief Finds a configuration with the end effector's origin at a position, orientation free.
 *
 * Closed-loop inverse kinematics (vpClosedLoopKinematics) from \e from and, if that gives no free configuration, from
 * random configurations. Takes milliseconds; allocates.
 *
 * \code
 * const vpGoalConfiguration found = vpFindGoalConfiguration(scene, q, {-0.1, 0.4, 0.3}, 0.01); // m
 * if (found.isFree()) {
 *   std::cout << found.q.transpose() << " rad" << std::endl;
 * }
 * else {
 *   std::cerr << found.message() << std::endl;
 * }
 * \endcode
 * \param scene : Arm and obstacles.
 * \param from : Configuration from which the search starts, n numbers, rad or m. The first solution is returned, so it
 *   is near this configuration where a direct motion leads to it.
 * \param position : Position of the end effector's origin in the base frame, m. \param margin : Clearance wanted, m, >=
 *   0.
 * \param attempts : Number of start configurations tried, >= 1. \param seed : Seed of the random ones, >= 1.
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
