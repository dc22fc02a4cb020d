/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file otherArm.h
 * \brief The default scene, which is made for AMOR, before another arm.
 */
#ifndef avoidObstacle_otherArm_h
#define avoidObstacle_otherArm_h

#include <visp3/avoidance/vpCollisionSceneJson.h>

namespace avoidObstacle
{
/*!
 * Move a scene of one object and its first task to another arm: the object gets the same pose in the view of the camera at
 * the start, and the straight way of the tool passes it at the same distance and ends as far behind it. The start is the arm's home if start and goal are free there, the straight way is not, and a way past the object
 * is certified; else the first of 20,000 random ones, always the same; the object counts as 60 mm thicker for that, or 40 mm if there is no such start.
 * \param amor : The arm of the file.
 * \throw std::runtime_error naming the arm if there is no such start.
 */
void moveToArm(const vpArmModel &amor, const vpArmModel &arm, vpCollisionSceneFile &file);
} // namespace avoidObstacle

#endif
