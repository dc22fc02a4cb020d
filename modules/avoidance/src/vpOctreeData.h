/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpOctreeData_h
#define vpOctreeData_h

#include "vpBoxTree.h"

#include <visp3/avoidance/vpOctree.h>

BEGIN_VISP_NAMESPACE

struct vpOctreeData {
  std::string label;
  std::vector<vpOctreeCell> cells;
  vpBoxTree tree;

  // Nearest points to a segment in the map's frame, never negative. Infinite, without points, beyond the cutoff.
  [[nodiscard]] vpNearestPoints nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                        double cutoff) const noexcept;
};

END_VISP_NAMESPACE
#endif
