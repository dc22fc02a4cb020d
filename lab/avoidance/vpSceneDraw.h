/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSceneDraw.h
 * \brief Common functions of the random scenes.
 */
#ifndef vpSceneDraw_h
#define vpSceneDraw_h

#include "vpHashRandom.h"

#include "lab/avoidance/vpAvoidanceScenes.h"
#include "lab/avoidance/vpSceneFrame.h"

BEGIN_VISP_NAMESPACE

namespace vpSceneDraw
{
constexpr int mostDraws = 20000;

//! Random stream of a scene for draw number \e draw.
[[nodiscard]] vpHashRandom random(unsigned int scene, unsigned int seed, int draw);
//! \throw vpException (badValue) if there is no arm or it has fewer than three joints.
void requireArm(const std::shared_ptr<const vpArmModel> &arm);
//! \throw vpException (badValue): no draw met the conditions.
[[noreturn]] void giveUp(const char *scene, unsigned int seed);
//! Run between two configurations, with seeds set; its scene has no object and no ground.
[[nodiscard]] vpAvoidanceRunSpec between(const std::shared_ptr<const vpArmModel> &arm, const vpJointVector &start,
                                         const vpJointVector &goal, unsigned int seed);
//! Random configuration at least 1/20 of the range inside the limits; continuous joints within +-pi, others of more than a
//! turn within +-pi of their middle.
[[nodiscard]] vpJointVector configuration(const vpArmModel &arm, vpHashRandom &random);
//! Goal with continuous joints by the shorter way from the start.
[[nodiscard]] vpJointVector shortWay(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal);
//! Random unit vector, uniformly distributed.
[[nodiscard]] Eigen::Vector3d direction(vpHashRandom &random);
//! Tool position, m.
[[nodiscard]] Eigen::Vector3d tool(const vpArmModel &arm, const vpJointVector &q);
//! True if no pair is nearer than \e margin, m.
[[nodiscard]] bool isFree(const vpCollisionScene &scene, const vpJointVector &q, double margin);
/*!
 * Configurations of a straight tool motion from \e start to the tool position at \e goal, \e count of them in equal
 * steps; empty if impossible.
 */
[[nodiscard]] std::vector<vpJointVector> toolLine(const vpArmModel &arm, const vpJointVector &start,
                                                  const vpJointVector &goal, int count);
//! True if a planner with an iteration limit finds a certified path.
[[nodiscard]] bool hasPath(const vpCollisionScene &scene, const vpJointVector &start, const vpJointVector &goal,
                           unsigned int seed);
} // namespace vpSceneDraw

END_VISP_NAMESPACE
#endif
