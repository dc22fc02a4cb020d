/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// How tightly capsules cover a mesh: see vpCapsuleCover.
#ifndef vpCoverMeasure_h
#define vpCoverMeasure_h

#include "vpCoverCells.h"

#include <visp3/avoidance/vpCapsuleCover.h>

BEGIN_VISP_NAMESPACE

namespace vpCover
{
double overhangOf(const vpTriangleMesh &mesh, const std::vector<vpArmCapsule> &capsules);
double unionVolume(const std::vector<vpArmCapsule> &capsules);
double radiusOf(const vpTriangleMesh &mesh);
double hullVolume(const vpTriangleMesh &mesh);
vpCapsuleCover measured(const vpTriangleMesh &mesh, const std::vector<vpArmCapsule> &capsules);
} // namespace vpCover

END_VISP_NAMESPACE
#endif
