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
 * Constant velocity for a time, then all joints brake to rest simultaneously, the slowest at its acceleration limit;
 * a joint that would exceed its position limit brakes harder. No allocation.
 * \param keep : Time at constant velocity, s, >= 0. \param plan : One axis per joint; replaced.
 * \return False if a joint exceeds its position limit even at full braking, or a number is not finite.
 */
bool planStop(const vpArmModel &arm, const vpJointVector &q, const vpJointVector &velocity, double keep,
              vpTrajectoryPlan &plan) noexcept;

//! Velocities of the next period when braking at the acceleration limits, each joint separately.
vpJointVector brakeOnce(const vpArmModel &arm, const vpJointVector &velocity, double period) noexcept;

//! Distance that a joint may move in the direction of \e velocity, rad or m: to its limit plus 1e-9 max(1, |limit|).
double roomAhead(const vpArmModel &arm, int joint, double q, double velocity) noexcept;

END_VISP_NAMESPACE
#endif
