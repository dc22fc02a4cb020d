/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpOctomapCells_h
#define vpOctomapCells_h

#include <visp3/avoidance/vpOctree.h>

#include <octomap/octomap.h>

BEGIN_VISP_NAMESPACE

/*!
 * Occupied leaves, in the order of octomap's iterator.
 * \param skipsFree : Leaves out what is below free inner nodes. Only if each is as occupied as its most occupied child, as after
 * updateInnerOccupancy(); a file may say otherwise.
 */
std::vector<vpOctreeCell> vpOctomapCells(const octomap::OcTree &tree, bool skipsFree);

END_VISP_NAMESPACE
#endif
