/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSceneDraw.h
 * \brief What the random scenes have in common.
 */
#ifndef vpSceneDraw_h
#define vpSceneDraw_h

#include "vpHashRandom.h"

#include "lab/avoidance/vpAvoidanceScenes.h"

BEGIN_VISP_NAMESPACE

namespace vpSceneDraw
{
constexpr int mostDraws = 2000;

//! The scene's random numbers of draw number \e draw.
[[nodiscard]] vpHashRandom random(unsigned int scene, unsigned int seed, int draw);
//! \throw vpException (badValue) when there is no arm or it has fewer than three joints.
void requireArm(const std::shared_ptr<const vpArmModel> &arm);
//! \throw vpException (badValue): no draw met the conditions.
[[noreturn]] void giveUp(const char *scene, unsigned int seed);
//! The ground that the arm stands on; links 1 and 2 are not checked.
[[nodiscard]] vpHalfSpace ground();
//! A run between two configurations; seeds set.
[[nodiscard]] vpAvoidanceRunSpec between(const std::shared_ptr<const vpArmModel> &arm, const vpJointVector &start,
                                         const vpJointVector &goal, unsigned int seed);
//! Within the limits, a twentieth of the range away from them; continuous joints anywhere in +-pi.
[[nodiscard]] vpJointVector configuration(const vpArmModel &arm, vpHashRandom &random);
//! The goal's angles of continuous joints by the short way from the start.
[[nodiscard]] vpJointVector shortWay(const vpArmModel &arm, const vpJointVector &start, const vpJointVector &goal);
//! A unit vector, all directions alike.
[[nodiscard]] Eigen::Vector3d direction(vpHashRandom &random);
//! Place of the tool, m.
[[nodiscard]] Eigen::Vector3d tool(const vpArmModel &arm, const vpJointVector &q);
//! True when no pair is nearer than \e margin, m.
[[nodiscard]] bool isFree(const vpCollisionScene &scene, const vpJointVector &q, double margin);
/*!
 * Configurations of an arm whose tool goes straight from \e start to the place of \e goal, \e count of them in equal
 * steps; empty when it cannot.
 */
[[nodiscard]] std::vector<vpJointVector> toolLine(const vpArmModel &arm, const vpJointVector &start,
                                                  const vpJointVector &goal, int count);
//! True when a planner with a limit of iterations finds a certified path.
[[nodiscard]] bool hasPath(const vpCollisionScene &scene, const vpJointVector &start, const vpJointVector &goal,
                           unsigned int seed);
} // namespace vpSceneDraw

END_VISP_NAMESPACE
#endif
