/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "selfMotion.h"

namespace planCompare
{
namespace
{
constexpr int JOINT_4 = 3;

struct Index {
  const char *name;
  std::function<vpSelfMotionIndex(vpIndexSense)> make;
};

//! The geometry of section 8.3.5: a point beside joint 4, the line from base to tool, the plane through three points.
std::vector<Index> indices(const vpArmModel &arm)
{
  const Eigen::Vector3d point(0.45, 0.1, 0.4);
  return {{"point", [=](vpIndexSense s) { return vpSelfMotionIndex::pointDistance(JOINT_4, point, s); }},
          {"line", [=](vpIndexSense s) { return vpSelfMotionIndex::lineDistance(JOINT_4, s); }},
          {"plane", [&arm](vpIndexSense s) { return vpSelfMotionRunSpec::thesisPlane(arm, s); }}};
}
} // namespace

std::vector<SelfMotionRow> runSelfMotion(const Plan &plan)
{
  std::vector<SelfMotionRow> rows;
  if (!plan.selfMotion) {
    return rows;
  }
  vpSelfMotionRunSpec spec = vpSelfMotionRunSpec::thesis(plan.arm);
  for (const Index &index : indices(*plan.arm)) {
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
