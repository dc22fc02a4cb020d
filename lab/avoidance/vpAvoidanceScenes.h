/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAvoidanceScenes.h
 * \brief The scenes on which avoidance methods are compared.
 */
#ifndef vpAvoidanceScenes_h
#define vpAvoidanceScenes_h

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include "lab/avoidance/vpAvoidanceRunSpec.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief A scene, ready to run with any method: set vpAvoidanceRunSpec::method.
 */
struct vpAvoidanceScenario {
  std::string name;       //!< For reports.
  vpAvoidanceRunSpec run; //!< Its seeds are the scenario's.
  int draws = 1;          //!< Random scenes that were drawn until one met the conditions.
};

/*!
 * \brief The obstacles of vpAvoidanceScenes::crossing() and how they are seen.
 */
struct vpCrossingSpec {
  double speed = 0.3;      //!< Of the obstacles, m/s, > 0.
  double visionRate = 30.; //!< Hz, > 0.
  double latency = 0.05;   //!< s, >= 0.
};

/*!
 * \brief Scenes by number, thesis chapter 8 and beyond. A scene depends on arm and seed alone: it repeats on any machine,
 * and no method that is compared has a say in it.
 *
 * Random scenes are drawn until one meets conditions that make it neither trivial nor impossible; they are checked by
 * proofs (vpCertifiedMotion, vpPathPlanner with certified motions and a limit of iterations instead of time), with a
 * clearance of \ref feasibleMargin where methods keep 10 mm. Made for AMOR; arms of its size do, too. All functions
 * throw vpException (badValue) when there is no arm, when places cannot be reached, or when no draw of many meets the
 * conditions.
 */
namespace vpAvoidanceScenes
{
//! Clearance with which random scenes are known to be feasible, m.
constexpr double feasibleMargin = 0.03;

/*!
 * S1, figures 8.6 to 8.12: from the tool at (0.05, 0.63) m straight on to (0.05, 0.93) m. Between 0.2 and 0.45 s a ball
 * appears on the way, and with it the goal moves to (0.225, 0.93) m, as in figure 8.8. The thesis tells place and time
 * of the new goal, not of the obstacle: its radius is 50 mm, its place and the time hang on the seed; the straight way
 * touches it, but not where the arm already is or cannot stop any more, and a path from the start to the new goal is
 * known. Camera at 10 Hz.
 */
[[nodiscard]] vpAvoidanceScenario figure88(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed);
/*!
 * S2: three to ten boxes, balls, capsules and cylinders of 6 to 60 cm about the arm, known from the start; start and
 * goal are random configurations whose tools are 0.3 to 0.8 m apart. Neither the straight motion of the joints nor that
 * of the tool is free, and a path is known. Needs OMPL.
 */
[[nodiscard]] vpAvoidanceScenario randomStatic(const std::shared_ptr<const vpArmModel> &arm,
                                                           unsigned int seed);
/*!
 * S3: a ball and a capsule at constant speed cross the way of the arm, seen with noise of 3 mm. An arm that takes no
 * notice is hit while it moves, whether it moves its joints straight, at half their speed, or its tool, at 0.25 m/s on
 * average; one that waits at the start until they are gone, and then moves its joints straight, is not.
 */
[[nodiscard]] vpAvoidanceScenario crossing(const std::shared_ptr<const vpArmModel> &arm, unsigned int seed,
                                                       const vpCrossingSpec &spec = {});
/*!
 * S4, S6 and files of one's own: task number \e task of a scene, all of it known from the start. The seed is that of
 * the methods alone.
 */
[[nodiscard]] vpAvoidanceScenario fromTask(const std::shared_ptr<const vpArmModel> &arm,
                                                       const vpCollisionSceneFile &file, std::size_t task,
                                                       unsigned int seed);
/*!
 * S7, figure 8.13: nothing is in the way, but the goal moves: (0.1, 0.3) m from the start of the tool, between 0.5 and
 * 0.9 s to (0.23, 0.13), between 1.7 and 1.9 s to (0.14, 0.04); told at 50 Hz with noise of 10 mm until it rests.
 */
[[nodiscard]] vpAvoidanceScenario movingGoal(const std::shared_ptr<const vpArmModel> &arm,
                                                         unsigned int seed);
} // namespace vpAvoidanceScenes

END_VISP_NAMESPACE
#endif
