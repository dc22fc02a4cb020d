/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// All shapes of a body as one mesh in the frame of its link.
#ifndef vpBodyMesh_h
#define vpBodyMesh_h

#include <visp3/avoidance/vpTriangleMesh.h>
#include <visp3/manipulator/vpArmSpec.h>

#include <optional>

BEGIN_VISP_NAMESPACE

struct vpBodyMesh {
  std::optional<vpTriangleMesh> mesh; // meshes, boxes, cylinders; none if there are only spheres
  std::vector<vpArmCapsule> spheres;  // exact
};

// Throws vpException if a mesh cannot be read.
vpBodyMesh vpMakeBodyMesh(const vpArmSpec &arm, int body);

END_VISP_NAMESPACE
#endif
