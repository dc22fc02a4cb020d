/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpStopPlan_h
#define vpStopPlan_h

#include <visp3/manipulator/vpArmModel.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>

BEGIN_VISP_NAMESPACE

/*!
 * A time at constant velocity, then all joints to rest at the same time, the slowest to brake at its acceleration limit.
 * No allocation. \param keep : s, >= 0. \param plan : Of as many axes as the arm has joints; replaced.
 */
void planStop(const vpArmModel &arm, const vpJointVector &q, const vpJointVector &velocity, double keep,
              vpTrajectoryPlan &plan) noexcept;

END_VISP_NAMESPACE
#endif
