/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMissingLibrary.h"

#include <visp3/avoidance/vpTriangleMesh.h>

BEGIN_VISP_NAMESPACE

vpTriangleMesh vpTriangleMesh::load(const std::string &file, double) { return load(file, Eigen::Vector3d::Ones()); }
vpTriangleMesh vpTriangleMesh::load(const std::string &file, const Eigen::Vector3d &)
{
  vpMissingLibrary((file + ": a mesh").c_str(), "assimp");
}

END_VISP_NAMESPACE
