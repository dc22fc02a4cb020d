/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figures 8.14 to 8.17: self-motion while the tool follows its path.
#include "curves.h"
#include "part.h"

#include "dataFile.h"
#include "numberText.h"

#include <visp3/manipulator/vpArmJson.h>
#include "lab/arm/vpSelfMotionExperiment.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace thesisReport
{
namespace
{
constexpr int JOINT_4 = 3;
constexpr double WEAK = 0.3, STRONG = 0.6; // |k_0|
constexpr double DRIFT = 1e-4;             // m: tolerance of the tool's task

using MakeIndex = std::function<vpSelfMotionIndex(vpIndexSense)>;

//! The run with a gain: k0 > 0 attracts, < 0 repels, as in the figures.
struct Runs {
  std::vector<std::pair<double, vpSelfMotionRun>> runs;
  [[nodiscard]] const vpSelfMotionRun &with(double k0) const
  {
    return std::find_if(runs.begin(), runs.end(), [&](const auto &run) { return run.first == k0; })->second;
  }
};

std::shared_ptr<const vpArmModel> amor()
{
  return std::make_shared<const vpArmModel>(vpLoadArmJson(vpApp::dataFile("robot/amor.json")));
}

Runs play(const std::shared_ptr<const vpArmModel> &arm, const MakeIndex &index, const std::vector<double> &gains)
{
  Runs all;
  vpSelfMotionRunSpec spec = vpSelfMotionRunSpec::thesis(arm);
  for (const double k0 : gains) {
    spec.index = index(k0 > 0. ? vpIndexSense::Attract : vpIndexSense::Repel);
    spec.share = std::fabs(k0);
    all.runs.emplace_back(k0, runSelfMotionExperiment(spec));
  }
  return all;
}

Quantity meanRatio(const Runs &runs, double strong, double weak, bool larger)
{
  return {"mean distance with k_0 = " + vpApp::number(strong, 2) + " over that with " + vpApp::number(weak, 2),
          "1",
          1.,
          runs.with(strong).mean_distance_m / runs.with(weak).mean_distance_m,
          larger ? Tolerance::atLeast() : Tolerance::atMost(),
          larger ? Good::Larger : Good::Smaller,
          "",
          ""};
}

double leastDifference(const vpSelfMotionRun &a, const vpSelfMotionRun &b)
{
  double least = 0.;
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    least = std::min(least, a.samples[i].distance - b.samples[i].distance);
  }
  return least;
}

Quantity toolKept(const Runs &runs)
{
  double drift = 0.;
  for (const auto &run : runs.runs) {
    drift = std::max(drift, run.second.tcp_drift_m);
  }
  return {"largest error of the tool", "m",           0., drift,
          Tolerance::distance(DRIFT),  Good::Neither, "", "Self-motion must not move the tool."};
}

void illustrate(const Runs &runs, const std::string &distance, Item &item)
{
  vpApp::Plot plot = vpApp::timePlot("Distance of joint q_4 from " + distance, "distance (m)");
  plot.height = 420;
  for (const auto &run : runs.runs) {
    std::vector<double> t, d;
    for (const vpSelfMotionSample &s : run.second.samples) {
      t.push_back(s.time);
      d.push_back(s.distance);
    }
    addCurve(plot, "k_0 = " + vpApp::number(run.first, 2), t, d);
  }
  addPlot(item, "distance", "Distance of joint q_4 from " + distance,
          "The sign of k_0 as in the figures: positive attracts, negative repels.", {plot});
  item.parameters = {
      {"arm", "AMOR, ideal drives, 200 Hz"},
      {"tool", "two vias and a final place, 2 s each, orientation kept; the thesis gives no positions"},
      {"gain", "k_0 as a share of the speed that the spare joints may take (our form of k_0 is bounded)"}};
}

Item point(const char *id, const Eigen::Vector3d &place, const std::string &name)
{
  const Runs runs =
      play(amor(), [&](vpIndexSense sense) { return vpSelfMotionIndex::pointDistance(JOINT_4, place, sense); },
           {0., -WEAK, -STRONG});
  Item item;
  item.id = id;
  item.quantities = {meanRatio(runs, -WEAK, 0., true),
                     meanRatio(runs, -STRONG, 0., true),
                     meanRatio(runs, -STRONG, -WEAK, true),
                     {"least of the distance with k_0 = -0.6 minus that with 0", "m", std::nullopt,
                      leastDifference(runs.with(-STRONG), runs.with(0.)), Tolerance::factor(1.1), Good::Neither, "",
                      "Below 0 the joint would be nearer for a time, for the sake of the rest, as the thesis sees in "
                      "figure 8.14; that depends on the path of the tool."},
                     toolKept(runs)};
  illustrate(runs, name, item);
  item.parameters.emplace_back("point", "[" + vpApp::number(place.x(), 3) + ", " + vpApp::number(place.y(), 3) + ", " +
                                            vpApp::number(place.z(), 3) + "] m, ours: the thesis does not tell it");
  return item;
}

Item besideJoint() { return point("fig8.14", {0.45, 0.1, 0.4}, "the point beside it"); }

//! Point below joint 4 of the first posture.
Item underJoint()
{
  const auto arm = amor();
  vpArmData data;
  vpArmKinematics::forward(*arm, arm->home(), data);
  return point("fig8.15", data.joint[JOINT_4].p - Eigen::Vector3d(0., 0., 0.1), "the point 0.1 m under it");
}

Item line()
{
  const Runs runs = play(amor(), [](vpIndexSense sense) { return vpSelfMotionIndex::lineDistance(JOINT_4, sense); },
                         {0., WEAK, STRONG});
  Item item;
  item.id = "fig8.16";
  item.quantities = {meanRatio(runs, WEAK, 0., false),
                     meanRatio(runs, STRONG, WEAK, false),
                     {"way of all joints, k_0 = 0.6 over k_0 = 0", "1", 1.,
                      runs.with(STRONG).joint_travel_rad / runs.with(0.).joint_travel_rad, Tolerance::atLeast(),
                      Good::Neither, "", "The thesis: d_total is larger with a larger gain."},
                     toolKept(runs)};
  illustrate(runs, "the line from base to tool", item);
  return item;
}

Item plane()
{
  const auto arm = amor();
  const Runs runs = play(arm, [&](vpIndexSense sense) { return vpSelfMotionRunSpec::thesisPlane(*arm, sense); },
                         {-STRONG, -WEAK, 0., WEAK, STRONG});
  Item item;
  item.id = "fig8.17";
  item.quantities = {meanRatio(runs, STRONG, WEAK, false), meanRatio(runs, WEAK, 0., false),
                     meanRatio(runs, -WEAK, 0., true), meanRatio(runs, -STRONG, -WEAK, true), toolKept(runs)};
  illustrate(runs, "the plane through base, the point above it and [1, 1, 0.5]", item);
  return item;
}
} // namespace

std::vector<Part> selfMotionParts()
{
  const auto part = [](const char *id, const char *title, Item (*make)()) {
    return Part{"Chapter 8: obstacle avoidance", {{id, title}}, 1.5, [make](const Setting &) {
                  return std::vector<Item>{make()};
                }};
  };
  return {part("fig8.14", "self-motion away from a point", besideJoint),
          part("fig8.15", "self-motion away from a point under the joint", underJoint),
          part("fig8.16", "self-motion towards the line from base to tool", line),
          part("fig8.17", "self-motion away from a plane and towards it", plane)};
}
} // namespace thesisReport
