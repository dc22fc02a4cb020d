/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpDetour_h
#define vpDetour_h

#include "vpToolForecast.h"

#include <vector>

BEGIN_VISP_NAMESPACE

//! How far the object's surface, inflation included, lies from its origin at most along a unit direction, m; of an
//! octree only what is near a place.
[[nodiscard]] double extentAlong(const vpCollisionObject &object, const Eigen::Vector3d &direction,
                                 const Eigen::Vector3d &place);

/*!
 * Places beside what is in the way of a tool that goes from \e from to \e to: on every side of the obstacle, by its
 * extent there and a clearance; where the tool is not what would touch, also further out. When nothing is in the way but
 * the arm does not come along, places about the one where it stays behind.
 * \param conflict : Foreseen. \param clearance : Of the tool's origin from the extent, m. \param sides : How many, >= 2.
 */
[[nodiscard]] std::vector<Eigen::Vector3d> placesBeside(const vpCollisionScene &scene, const vpForecast &conflict,
                                                        const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                                        double clearance, int sides);

END_VISP_NAMESPACE
#endif
