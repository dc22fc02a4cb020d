/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpReachPoint.h
 * \brief Finds a configuration near another one with the tool at a given position.
 */
#ifndef vpReachPoint_h
#define vpReachPoint_h

#include <visp3/manipulator/vpArmKinematics.h>

BEGIN_VISP_NAMESPACE

/*!
 * Damped Newton iteration on the end-effector position alone, within the position limits.
 * \param q : Start; receives the result. \return False if the error exceeds 1e-9 m after 200 steps.
 */
[[nodiscard]] bool vpReachPoint(const vpArmModel &model, const Eigen::Vector3d &place, vpJointVector &q);

END_VISP_NAMESPACE
#endif
