/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpOctomapCells_h
#define vpOctomapCells_h

#include <visp3/avoidance/vpOctree.h>

#include <octomap/octomap.h>

BEGIN_VISP_NAMESPACE

//! Occupied leaves.
std::vector<vpOctreeCell> vpOctomapCells(const octomap::OcTree &tree);

END_VISP_NAMESPACE
#endif
