/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "selfMotion.h"

#include <Eigen/Geometry>

namespace planCompare
{
namespace
{
constexpr int JOINT_4 = 3;

struct Index {
  const char *name;
  std::function<vpSelfMotionIndex(vpIndexSense)> make;
};

//! The things of section 8.3.5: a point beside joint 4, the line from base to tool, the plane through three points.
std::vector<Index> indices()
{
  const Eigen::Vector3d point(0.45, 0.1, 0.4), base(0., 0., 0.), above(0., 0., 1.), third(1., 1., 0.5);
  const Eigen::Vector3d normal = (above - base).cross(third - base);
  return {{"point", [=](vpIndexSense s) { return vpSelfMotionIndex::pointDistance(JOINT_4, point, s); }},
          {"line", [=](vpIndexSense s) { return vpSelfMotionIndex::lineDistance(JOINT_4, s); }},
          {"plane", [=](vpIndexSense s) { return vpSelfMotionIndex::planeDistance(JOINT_4, base, normal, s); }}};
}
} // namespace

std::vector<SelfMotionRow> runSelfMotion(const Plan &plan)
{
  std::vector<SelfMotionRow> rows;
  if (!plan.selfMotion) {
    return rows;
  }
  vpSelfMotionRunSpec spec;
  spec.arm = plan.arm;
  spec.start = plan.arm->home();
  vpArmData data;
  vpArmKinematics::forward(*plan.arm, spec.start, data);
  for (const Eigen::Vector3d &way :
       {Eigen::Vector3d(0.05, 0.07, 0.), Eigen::Vector3d(-0.05, 0.12, 0.), Eigen::Vector3d(0., 0.17, 0.)}) {
    spec.places.push_back(data.tool.p + way); // two vias and a final point, as in 8.3.3
  }
  for (const Index &index : indices()) {
    for (const double share : {-0.6, -0.3, 0., 0.3, 0.6}) {
      const vpIndexSense sense = share < 0. ? vpIndexSense::Attract : vpIndexSense::Repel;
      spec.index = index.make(sense);
      spec.share = std::abs(share);
      rows.push_back({index.name,
                      share < 0.   ? "attract"
                      : share > 0. ? "repel"
                                   : "none",
                      std::abs(share), runSelfMotionExperiment(spec)});
    }
  }
  return rows;
}
} // namespace planCompare
