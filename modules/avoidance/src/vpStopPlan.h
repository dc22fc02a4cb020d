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
 * A time at constant velocity, then all joints to rest at the same time, the slowest to brake at its acceleration limit;
 * a joint that would pass its position limit brakes harder. No allocation.
 * \param keep : s, >= 0. \param plan : Of as many axes as the arm has joints; replaced.
 * \return False when a joint passes its position limit although it brakes as hard as it can, or a number is not finite.
 */
bool planStop(const vpArmModel &arm, const vpJointVector &q, const vpJointVector &velocity, double keep,
              vpTrajectoryPlan &plan) noexcept;

//! The velocities of the next period of braking at the acceleration limits, each joint for itself.
vpJointVector brakeOnce(const vpArmModel &arm, const vpJointVector &velocity, double period) noexcept;

//! How far a joint may go in the sense of \e velocity, rad or m: to its limit and 1e-9 of it (at least 1e-9) beyond.
double roomAhead(const vpArmModel &arm, int joint, double q, double velocity) noexcept;

END_VISP_NAMESPACE
#endif
