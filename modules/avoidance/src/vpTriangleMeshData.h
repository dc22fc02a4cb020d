/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpTriangleMeshData_h
#define vpTriangleMeshData_h

#include "vpBoxTree.h"

#include <visp3/avoidance/vpTriangleMesh.h>

BEGIN_VISP_NAMESPACE

struct vpTriangleMeshData {
  std::string label, message;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
  bool watertight = false;
  vpBoxTree tree;
  // Normals for the sign (Baerentzen and Aanaes, 2005): of the face, of the edges 01, 12, 20, of the vertices weighted
  // by angle.
  std::vector<Eigen::Vector3d> faceNormals, vertexNormals;
  std::vector<std::array<Eigen::Vector3d, 3>> edgeNormals;

  // Nearest points to a segment in the mesh's frame; negative distance if the segment is inside a watertight mesh.
  // Infinite, without points, if nothing is within the cutoff.
  [[nodiscard]] vpNearestPoints nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                        double cutoff) const noexcept;
};

END_VISP_NAMESPACE
#endif
