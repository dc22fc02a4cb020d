/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file reach.h
 * \brief Whether an arm can get to its goal, for warnings and for the reason of a failure.
 */
#ifndef visualServo_reach_h
#define visualServo_reach_h

#include <visp3/manipulator/vpArmModel.h>

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace visualServo
{
/*!
 * Where the camera, or the end effector before a fixed camera, is at the goal, in the base.
 * \param isFixed : The camera is fixed. \param fMc : Its pose then, in the base.
 * \param moving : Pose in the base of what moves. \param cMo, cdMo : Object in the camera, now and at the goal.
 */
[[nodiscard]] vpRigidTransform placeAtGoal(bool isFixed, const vpRigidTransform &fMc, const vpRigidTransform &moving,
                                           const vpRigidTransform &cMo, const vpRigidTransform &cdMo);

/*!
 * What stands between the arm and its goal: joints at their limits, and whether no joint positions were found that reach the goal, by closed-loop
 * inverse kinematics from \e q and from 20 random ones. Obstacles and the view are not considered.
 * \param q : Joint positions, rad or m. \param place : See placeAtGoal(). \param isFixed : The end effector gets there, not the camera.
 * \return Sentences without a full stop; none: the goal can be reached.
 */
[[nodiscard]] std::vector<std::string> hindrances(const vpArmModel &arm, const vpJointVector &q,
                                                  const vpRigidTransform &place, bool isFixed);
} // namespace visualServo

#endif
