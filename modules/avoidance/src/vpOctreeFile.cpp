/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpOctomapCells.h"

#include <visp3/core/vpException.h>

#include <fstream>

BEGIN_VISP_NAMESPACE

std::vector<vpOctreeCell> vpOctomapCells(const octomap::OcTree &tree)
{
  std::vector<vpOctreeCell> cells;
  for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
    if (tree.isNodeOccupied(*leaf)) {
      cells.push_back({{leaf.getX(), leaf.getY(), leaf.getZ()}, leaf.getSize()});
    }
  }
  return cells;
}

vpOctree vpOctree::load(const std::string &file)
{
  if (!std::ifstream(file)) {
    throw vpException(vpException::ioError, "%s: cannot be read", file.c_str());
  }
  const bool binary = file.size() > 3 && file.compare(file.size() - 3, 3, ".bt") == 0;
  std::unique_ptr<octomap::AbstractOcTree> any;
  auto tree = std::make_unique<octomap::OcTree>(0.1);
  if (!binary) {
    any.reset(octomap::AbstractOcTree::read(file));
  }
  octomap::OcTree *read = dynamic_cast<octomap::OcTree *>(any.get());
  if (binary && tree->readBinary(file)) {
    read = tree.get();
  }
  if (!read) {
    throw vpException(vpException::ioError, "%s: is no octree of octomap", file.c_str());
  }
  return vpOctree(vpOctomapCells(*read), file);
}

END_VISP_NAMESPACE
