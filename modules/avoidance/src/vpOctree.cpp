/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSegmentNearest.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <limits>

BEGIN_VISP_NAMESPACE

vpOctree::vpOctree(const std::vector<vpOctreeCell> &cells, const std::string &label)
{
  auto data = std::make_shared<vpOctreeData>();
  data->label = label;
  data->cells = cells;
  std::vector<vpBoxTree::Item> items;
  items.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const vpOctreeCell &cell = cells[i];
    if (!(cell.centre.cwiseAbs().array() <= vpLargestLength).all() || !(cell.size <= vpLargestLength) ||
        !(cell.size > 0.)) {
      throw vpException(vpException::badValue, "%s: cell %lu has the size %g m, must be > 0, and all within %g m",
                        label.c_str(), static_cast<unsigned long>(i), cell.size, vpLargestLength);
    }
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * cell.size);
    items.push_back({cell.centre - half, cell.centre + half});
  }
  data->tree = vpBoxTree(items);
  m_data = data;
}

const std::vector<vpOctreeCell> &vpOctree::cells() const &noexcept { return m_data->cells; }
const std::string &vpOctree::label() const noexcept { return m_data->label; }

vpNearestPoints vpOctreeData::nearest(const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                                      double cutoff) const noexcept
{
  int index = -1;
  const auto exact = [&](int i) {
    const vpOctreeCell &cell = cells[static_cast<std::size_t>(i)];
    vpNearestPoints near =
        vpSegmentNearest::box(from - cell.centre, to - cell.centre, Eigen::Vector3d::Constant(0.5 * cell.size));
    near.onSegment += cell.centre;
    near.onOther += cell.centre;
    return near;
  };
  vpNearestPoints best = tree.nearest(from, to, cutoff, exact, index);
  if (index < 0) {
    best.distance = std::numeric_limits<double>::infinity();
  }
  return best;
}

END_VISP_NAMESPACE
