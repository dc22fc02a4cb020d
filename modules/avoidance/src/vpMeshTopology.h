/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Is a set of triangles a solid, and which side of them is outside?
#ifndef vpMeshTopology_h
#define vpMeshTopology_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>

#include <array>
#include <vector>

BEGIN_VISP_NAMESPACE

struct vpMeshTopology {
  int openEdges = 0;  // of one triangle
  int otherEdges = 0; // of more than two, or between triangles that cannot be turned to the same side
};

/*
 * Turns the triangles of each closed shell to the same side, and that to the outside. A shell that is turned inwards as a
 * whole stays so, as a cavity, when it lies within the bounds of another one; turned outwards it would count as filled.
 */
vpMeshTopology vpOrientMesh(const std::vector<Eigen::Vector3d> &vertices, std::vector<std::array<int, 3>> &triangles);

END_VISP_NAMESPACE
#endif
