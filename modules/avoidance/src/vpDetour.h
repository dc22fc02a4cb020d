/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpDetour_h
#define vpDetour_h

#include "vpToolForecast.h"

#include <vector>

BEGIN_VISP_NAMESPACE

//! Largest extent of the object's surface, inflation included, from its origin along a unit direction, m; for an
//! octree only near a position.
[[nodiscard]] double extentAlong(const vpCollisionObject &object, const Eigen::Vector3d &direction,
                                 const Eigen::Vector3d &place);

/*!
 * Positions beside the obstacle in the way of a tool moving from \e from to \e to: on every side of the obstacle, at
 * its extent there plus a clearance; if another part than the tool would touch, also farther out. If nothing is in the
 * way but the arm cannot follow, positions around the one where it lags behind.
 * \param conflict : Predicted conflict. \param clearance : Clearance of the tool's origin from the extent, m.
 * \param sides : Number of sides, >= 2.
 */
[[nodiscard]] std::vector<Eigen::Vector3d> placesBeside(const vpCollisionScene &scene, const vpForecast &conflict,
                                                        const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                                        double clearance, int sides);

END_VISP_NAMESPACE
#endif
