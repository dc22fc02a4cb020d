/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAvoidanceScenes.h
 * \brief Scenes for comparing avoidance methods.
 */
#ifndef vpAvoidanceScenes_h
#define vpAvoidanceScenes_h

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include "lab/avoidance/vpAvoidanceRunSpec.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief A scene that can be run with any method: set vpAvoidanceRunSpec::method.
 */
struct vpAvoidanceScenario {
  std::string name;       //!< Name for reports.
  vpAvoidanceRunSpec run; //!< The run; its seeds are those of the scenario.
  int draws = 1;          //!< Number of random scenes drawn until one met the conditions.
};

/*!
 * \brief Obstacles of vpAvoidanceScenes::crossing() and their perception.
 */
struct vpCrossingSpec {
  double speed = 0.3;      //!< Speed of the obstacles, m/s, > 0.
  double visionRate = 30.; //!< Rate of exposures, Hz, > 0.
  double latency = 0.05;   //!< Latency from exposure to result, s, >= 0.
};

/*!
 * \brief Scenes by number, thesis chapter 8 and beyond. A scene depends on arm and seed alone: it repeats on any
 * machine and is independent of the methods compared.
 *
 * Random scenes are drawn until one is neither trivial nor infeasible; this is checked by
 * proofs (vpCertifiedMotion, vpPathPlanner with certified motions and an iteration limit instead of a time limit), with
 * a clearance of \ref feasibleMargin where methods keep 10 mm. Designed for AMOR; for another arm lengths and places follow
 * vpSceneFrame, and bodies of vpArmSpec::uncovered are ignored, which the caller has to justify. All functions throw
 * vpException (badValue) if there is no arm, if positions are unreachable, or if no draw meets the conditions.
 */
namespace vpAvoidanceScenes
{
//! Clearance with which random scenes are proven feasible, m.
constexpr double feasibleMargin = 0.03;

/*!
 * S1, figures 8.6 to 8.12: tool from (0.05, 0.63) m straight to (0.05, 0.93) m. Between 0.2 and 0.45 s a ball
 * appears on the path, and the goal moves to (0.225, 0.93) m at the same time, as in figure 8.8. The thesis gives
 * position and time of the new goal, not of the obstacle: its radius is 50 mm, its position and time depend on the
 * seed; the straight path touches it, but not where the arm already is or can no longer stop, and a path from the start
 * to the new goal is known. Camera at 10 Hz. An arm that is not free or does not reach the goals there starts elsewhere,
 * with the plane of the figure turned about the vertical; so in S7.
 */
[[nodiscard]] vpAvoidanceScenario figure88(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed);
/*!
 * S2: three to ten boxes, balls, capsules and cylinders of 6 to 60 cm around the arm, known from the start; start and
 * goal are random configurations with tool positions 0.3 to 0.8 m apart. Neither the straight joint motion nor the
 * straight tool motion is free, and a path is known.
 */
[[nodiscard]] vpAvoidanceScenario randomStatic(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed);
/*!
 * S3: a ball and a capsule at constant speed cross the path of the arm, seen with noise of 3 mm. An arm that ignores
 * them is hit while moving, both on a straight joint motion at half speed and on a straight tool motion at 0.25 m/s on
 * average; one that waits at the start until they have passed, and then moves its joints straight, is not.
 */
[[nodiscard]] vpAvoidanceScenario crossing(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed,
                                           const vpCrossingSpec &spec = {});
/*!
 * S4, S6 and user files: task number \e task of a scene, completely known from the start. The seed is for methods.
 */
[[nodiscard]] vpAvoidanceScenario fromTask(const std::shared_ptr<const vpArmModel> &arm,
                                           const vpCollisionSceneFile &file, std::size_t task, unsigned int seed);
/*!
 * S7, figure 8.13: no obstacle, but a moving goal: (0.1, 0.3) m from the start of the tool, between 0.5 and
 * 0.9 s to (0.23, 0.13), between 1.7 and 1.9 s to (0.14, 0.04); reported at 50 Hz with noise of 10 mm until it rests.
 */
[[nodiscard]] vpAvoidanceScenario movingGoal(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed);
} // namespace vpAvoidanceScenes

END_VISP_NAMESPACE
#endif
