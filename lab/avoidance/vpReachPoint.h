/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReachPoint.h
 * \brief A configuration near another one that brings the tool to a place.
 */
#ifndef vpReachPoint_h
#define vpReachPoint_h

#include <visp3/manipulator/vpArmKinematics.h>

BEGIN_VISP_NAMESPACE

/*!
 * Damped Newton steps on the place of the end effector alone, within the position limits.
 * \param q : Where to begin; the result. \return False when the place is farther than 1e-9 m after 200 steps.
 */
[[nodiscard]] bool vpReachPoint(const vpArmModel &model, const Eigen::Vector3d &place, vpJointVector &q);

END_VISP_NAMESPACE
#endif
