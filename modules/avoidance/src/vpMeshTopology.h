/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Determines whether a set of triangles is a solid, and orients it outwards.
#ifndef vpMeshTopology_h
#define vpMeshTopology_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

struct vpMeshTopology {
  int openEdges = 0;  // edges of one triangle
  int otherEdges = 0; // edges of more than two, or between triangles that cannot be oriented consistently
};

/*
 * Orients the triangles of each closed shell consistently outwards. A shell that is oriented inwards as a whole is
 * kept, as a cavity, if it lies within the bounds of another one; oriented outwards it would count as filled.
 */
vpMeshTopology vpOrientMesh(const std::vector<Eigen::Vector3d> &vertices, std::vector<std::array<int, 3>> &triangles);

END_VISP_NAMESPACE
#endif
