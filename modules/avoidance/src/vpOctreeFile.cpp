/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpOctomapCells.h"
#include "vpOctreeOutline.h"
#include "vpReading.h"

#include <sstream>

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

namespace
{
vpOctree read(const std::string &file)
{
  const std::string bytes = vpReadFileText(file, vpLargestDataFile);
  const vpOctreeOutline outline = vpRequireOctree(bytes, file);
  octomap::OcTree tree(outline.resolution);
  if (outline.size > 0) {
    std::istringstream data(bytes.substr(outline.data));
    outline.binary ? tree.readBinaryData(data) : tree.readData(data);
  }
  return vpOctree(vpOctomapCells(tree), file);
}
} // namespace

vpOctree vpOctree::load(const std::string &file)
{
  return vpReading([&] { return read(file); });
}

END_VISP_NAMESPACE
