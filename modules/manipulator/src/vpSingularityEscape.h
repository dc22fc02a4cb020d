/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Self-motion that leads out of a singularity.
#ifndef vpSingularityEscape_h
#define vpSingularityEscape_h

#include "vpTaskLevel.h"

#include <visp3/manipulator/vpArmKinematics.h>

BEGIN_VISP_NAMESPACE

namespace vpSingularityEscape
{
/*!
 * H(k, l) = lost . dJ_l/dq_k in weighted coordinates: after a time t of the motion y the task velocity in the lost
 * direction is t y^T H y, because lost . J is about zero.
 */
vpTaskLevel::Square curvature(const vpArmModel &model, const vpArmData &data, vpArmFrame frame,
                              const Eigen::Matrix<double, 6, 1> &lost, const vpTaskLevel::Joints &scale);

//! Orthonormal basis of the usable self-motion: the first count columns.
struct Room {
  vpTaskLevel::Square vectors = vpTaskLevel::Square::Zero();
  int count = 0;
};

//! Complement of a set of orthonormal vectors in the space of the movable joints.
Room room(const vpTaskLevel::Basis &taken, const vpTaskLevel::Joints &mayMove);

/*!
 * Unit vector z in the space that makes the lost direction reachable in the sense of the demand.
 * \param sense : +1 or -1, sign of the demand along the lost direction.
 * \param slope : Remaining reachability lost . J.
 * \param motion : Motion for the rest of the task.
 * \return False if there is none: the demand points out of the workspace.
 */
bool direction(const Room &space, const vpTaskLevel::Square &H, double sense, const vpTaskLevel::Joints &slope,
               const vpTaskLevel::Joints &motion, vpTaskLevel::Joints &z);
} // namespace vpSingularityEscape

END_VISP_NAMESPACE
#endif
