/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file shapeOutline.h
 * \brief Outlines of collision shapes in orthographic figures.
 */
#ifndef vpApp_shapeOutline_h
#define vpApp_shapeOutline_h

#include "armPicture.h"

namespace vpApp
{
using Polygon = std::vector<Eigen::Vector2d>;

//! Projection of a point into the figure plane, m: right, up.
[[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d &place, ArmView view);
//! Distance of a point along the view direction, m; the nearer to the viewer, the larger.
[[nodiscard]] double nearness(const Eigen::Vector3d &place, ArmView view);
//! Boundaries of the union of polygons, outer ones and holes, to \e step.
[[nodiscard]] std::vector<Polygon> silhouette(const std::vector<Polygon> &polygons, double step);
//! Convex hull, anticlockwise.
[[nodiscard]] Polygon convexHull(std::vector<Eigen::Vector2d> points);
/*!
 * Polygons that together cover the view of an object: one for spheres, capsules, boxes and cylinders (with
 * inflation), one for every triangle of a mesh and every cell of an octree (without).
 */
[[nodiscard]] std::vector<Polygon> outline(const vpCollisionObject &object, ArmView view);
} // namespace vpApp

#endif
