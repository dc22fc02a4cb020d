/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file seenBox.h
 * \brief A box with a photograph that appears before the camera in the hand, for figures 8.8 and 8.10 with their sensor.
 */
#ifndef avoidObstacle_seenBox_h
#define avoidObstacle_seenBox_h

#include "options.h"

#include "lab/avoidance/vpAvoidanceRunSpec.h"

namespace avoidObstacle
{
/*!
 * Add the box of the default scene and the image sensor of section 8.3.2: 10 Hz, 640 x 480 px, a database of photographs.
 * \param options : Targets, noise, latency. \param place : Centre of the box, whose photograph looks along -y, m.
 * \param appears : Time at which it appears, s. \param spec : Gets box and sensor.
 * \throw std::runtime_error or vpException naming the file of the scene and what is wrong in it.
 */
void addSeenBox(const Options &options, const Eigen::Vector3d &place, double appears, vpAvoidanceRunSpec &spec);
} // namespace avoidObstacle

#endif
