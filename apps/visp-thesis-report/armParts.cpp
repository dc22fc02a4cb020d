/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Table 8.1: tracking errors of joints and tool of the arm. Figures 8.14 to 8.17: self-motion while the tool follows its
// path.
#include "part.h"

#include "dataFile.h"
#include "numberText.h"

#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/simulation/vpArmDrives.h>
#include "lab/arm/vpSelfMotionExperiment.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

VISP_DIRECT_USING_NAMESPACE

namespace thesisReport
{
namespace
{
constexpr const char *CHAPTER = "Chapter 8: obstacle avoidance";
constexpr double PERIOD = 0.005; // s, 200 Hz as in the thesis
constexpr double FAST = 0.001;   // s, 1 kHz
constexpr double DURATION = 10.; // s
constexpr int JOINTS = 7;

std::shared_ptr<const vpArmModel> amor()
{
  return std::make_shared<const vpArmModel>(vpLoadArmJson(vpApp::dataFile("robot/amor.json")));
}

//! Desired and actual motion.
struct Tracking {
  std::vector<double> time;
  std::array<std::vector<double>, JOINTS> joints; //!< Desired minus actual, rad.
  std::array<std::vector<double>, 6> tool;        //!< x y z m, roll pitch yaw rad.
};

double rms(const std::vector<double> &values)
{
  Spread spread;
  for (const double value : values) {
    spread.add(value);
  }
  return spread.rms();
}

//! Roll, pitch, yaw: about x, y and z of the base, R = Rz Ry Rx.
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d &R)
{
  return {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          std::atan2(R(1, 0), R(0, 0))};
}

//! Along the line of figure 8.8, 0.8 of its length in 4.5 s, minimum jerk, and back. \param period : Of the references, s.
Tracking follow(const vpArmModel &arm, bool compensated, double period, const Setting &setting, double done)
{
  vpArmDriveSpec spec;
  spec.compensateFriction = compensated;
  vpArmDrives drives(arm, spec);
  vpClosedLoopKinematics loop(arm);
  vpClosedLoopState state;
  vpClosedLoopInput input;
  vpClosedLoopOutput output;
  state.q = arm.home();
  vpArmData wanted, actual;
  vpArmKinematics::forward(arm, arm.home(), wanted);
  const vpRigidTransform start = wanted.tool;
  const Eigen::Vector3d way = Eigen::Vector3d(0.225, 0.93, start.p(2)) - start.p;
  const auto periods = static_cast<int>(std::lround(DURATION / period));
  const int half = periods / 2;
  Tracking tracking;
  for (int k = 0; k < periods; ++k) {
    const double t = std::min(1., (k < half ? k : periods - 1 - k) / (0.9 * half));
    input.goal = start;
    input.goal.p += 0.8 * t * t * t * (10. - 15. * t + 6. * t * t) * way;
    loop.step(input, state, output);
    drives.move(state.velocity, period);
    vpArmKinematics::forward(arm, drives.wanted(), wanted);
    vpArmKinematics::forward(arm, drives.q(), actual);
    tracking.time.push_back((k + 1) * period);
    for (int i = 0; i < JOINTS; ++i) {
      tracking.joints[static_cast<std::size_t>(i)].push_back(drives.wanted()[i] - drives.q()[i]);
    }
    const Eigen::Vector3d place = wanted.tool.p - actual.tool.p;
    const Eigen::Vector3d turn = rollPitchYaw(wanted.tool.R) - rollPitchYaw(actual.tool.R);
    for (int i = 0; i < 3; ++i) {
      tracking.tool[static_cast<std::size_t>(i)].push_back(place[i]);
      tracking.tool[static_cast<std::size_t>(3 + i)].push_back(std::remainder(turn[i], 2. * M_PI));
    }
    if (k % 100 == 0) {
      setting.progress(done + 0.3 * k / periods);
    }
  }
  return tracking;
}

const std::array<std::string, 6> &toolNames()
{
  static const std::array<std::string, 6> names = {"X", "Y", "Z", "roll", "pitch", "yaw"};
  return names;
}

std::vector<Item> trackingErrors(const Setting &setting)
{
  constexpr std::array<double, JOINTS> thesisJoints = {0.0064, 0.0086, 0.0052, 0.0125, 0.0082, 0.0085, 0.0064};
  constexpr std::array<double, 6> thesisTool = {0.0030, 0.0056, 0.0052, 0.0062, 0.0039, 0.0072};
  const auto arm = amor();
  const Tracking plain = follow(*arm, false, PERIOD, setting, 0.),
                 compensated = follow(*arm, true, PERIOD, setting, 0.3),
                 faster = follow(*arm, false, FAST, setting, 0.6);
  const std::string reason = "Masses, gains and friction of the arm are not given; those of the model are assumed.";
  Item item;
  item.id = "table8.1";
  std::string csv = "axis,unit,thesis,pd_and_gravity,with_friction_compensation\n";
  const auto add = [&](const std::string &name, const std::string &unit, double thesis, const std::vector<double> &ours,
                       const std::vector<double> &better) {
    item.quantities.push_back({name + ", rms", unit, thesis, rms(ours), Tolerance::factor(2.), Good::Smaller, reason,
                               "PD with gravity, as in the thesis."});
    item.quantities.push_back({name + ", rms, with friction compensation", unit, std::nullopt, rms(better),
                               Tolerance::factor(2.), Good::Neither, "", ""});
    csv += name + "," + unit + "," + vpApp::number(thesis, 6) + "," + vpApp::number(rms(ours), 6) + "," +
           vpApp::number(rms(better), 6) + "\n";
  };
  vpApp::Plot joints = vpApp::timePlot("Errors of the joints", "wanted - true (rad)"),
              tool = vpApp::timePlot("Errors of the tool", "wanted - true (m)");
  for (std::size_t i = 0; i < JOINTS; ++i) {
    const std::string name = "q" + std::to_string(i + 1);
    add(name, "rad", thesisJoints[i], plain.joints[i], compensated.joints[i]);
    addCurve(joints, name, plain.time, plain.joints[i]);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    add(toolNames()[i], i < 3 ? "m" : "rad", thesisTool[i], plain.tool[i], compensated.tool[i]);
    if (i < 3) {
      addCurve(tool, toolNames()[i], plain.time, plain.tool[i]);
    }
  }
  const auto mean = [](const auto &values, std::size_t count) {
    return std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count), 0.) /
           static_cast<double>(count);
  };
  const auto meanRms = [&](const Tracking &tracking) {
    std::vector<double> errors;
    std::transform(tracking.joints.begin(), tracking.joints.end(), std::back_inserter(errors), rms);
    return mean(errors, errors.size());
  };
  item.quantities.push_back(
      {"mean rms error of the joints, references at 1 kHz over 200 Hz", "1", 0.5, meanRms(faster) / meanRms(plain),
       Tolerance::atMost(), Good::Smaller, "",
       "The thesis: 200 Hz are the dominant reason for the errors. PD with gravity at 1 kHz in both."});
  item.quantities.push_back({"mean of the thesis's errors of the joints", "rad", 0.008,
                             mean(thesisJoints, thesisJoints.size()), Tolerance::distance(0.0005), Good::Neither, "",
                             ""});
  item.quantities.push_back({"mean of the thesis's errors of X, Y and Z over the 0.1 mm of industrial arms", "1", 10.,
                             mean(thesisTool, 3) / 1e-4, Tolerance::factor(std::sqrt(10.)), Good::Neither,
                             "3.0 to 5.6 mm against 0.1 mm, the worst of those arms, are nearer to two orders.",
                             "The thesis: 0.1 to 0.01 mm, an order of magnitude."});
  item.data.push_back({"rms.csv", csv});
  item.remarks = {"The thesis does not say on which motion its errors were taken."};
  item.parameters = {{"arm", "AMOR, 7 joints, by torques: PD with gravity at 1 kHz, references at 200 Hz"},
                     {"motion", "0.8 of the way of figure 8.8, there and back in 10 s, least jerk"},
                     {"friction", "viscous, Coulomb and static, of the arm's file"}};
  addPlot(item, "errors", "Errors of joints and tool without friction compensation",
          "Friction holds every joint some mrad back, against its direction of motion.", {joints, tool});
  return {item};
}

constexpr int JOINT_4 = 3;
constexpr double WEAK = 0.3, STRONG = 0.6; // |k_0|
constexpr double VISIBLE = 0.001;          // m: about what can be seen in the figures
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

Runs runsOf(const std::shared_ptr<const vpArmModel> &arm, const MakeIndex &index, const std::vector<double> &gains)
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

//! How far joint 4 goes when the arm moves by itself and the tool rests, over the larger of joints 2 and 6; means of a run.
double freedomOfJoint4(const vpArmModel &arm, const vpSelfMotionRun &run)
{
  constexpr double small = 1e-4; // rad
  constexpr int other[] = {1, 5};
  double ways[2] = {0., 0.}, way = 0.;
  vpArmData data, moved;
  for (const vpSelfMotionSample &sample : run.samples) {
    vpArmKinematics::update(arm, sample.q, data);
    const Eigen::MatrixXd kernel = Eigen::FullPivLU<Eigen::MatrixXd>(data.J).kernel();
    const Eigen::VectorXd spare = kernel.col(0).normalized();
    vpArmKinematics::forward(arm, sample.q + small * spare, moved);
    const auto wayOf = [&](int joint) { return (moved.joint[joint].p - data.joint[joint].p).norm(); };
    way += wayOf(JOINT_4);
    ways[0] += wayOf(other[0]);
    ways[1] += wayOf(other[1]);
  }
  return way / std::max(ways[0], ways[1]);
}

//! Mean of how much higher a joint is in one run than in the other, m.
double liftedBy(const vpArmModel &arm, const vpSelfMotionRun &run, const vpSelfMotionRun &other, int joint)
{
  Spread lift;
  vpArmData data;
  const auto height = [&](const vpSelfMotionSample &sample) {
    vpArmKinematics::forward(arm, sample.q, data);
    return data.joint[joint].p.z();
  };
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    lift.add(height(run.samples[i]) - height(other.samples[i]));
  }
  return lift.mean();
}

//! \param nearer : Of the thesis: how much nearer the joint is for a time, m, < 0. \param lifted : Of the thesis: by how much, m.
Item point(const char *id, const Eigen::Vector3d &place, const std::string &name, std::optional<double> nearer,
           std::optional<double> lifted)
{
  const auto arm = amor();
  const Runs runs =
      runsOf(arm, [&](vpIndexSense sense) { return vpSelfMotionIndex::pointDistance(JOINT_4, place, sense); },
             {0., -WEAK, -STRONG});
  Item item;
  item.id = id;
  item.quantities = {meanRatio(runs, -WEAK, 0., true),
                     meanRatio(runs, -STRONG, 0., true),
                     meanRatio(runs, -STRONG, -WEAK, true),
                     {"least of the distance with k_0 = -0.6 minus that with 0", "m", nearer,
                      leastDifference(runs.with(-STRONG), runs.with(0.)), Tolerance::atMost(), Good::Neither,
                      "On our path of the tool and with our point the joint is never nearer; the thesis tells neither.",
                      "Below 0 the joint is nearer for a time, for the sake of the rest."},
                     {"height of the joint with k_0 = -0.6 minus that with 0, mean", "m", lifted,
                      liftedBy(*arm, runs.with(-STRONG), runs.with(0.), JOINT_4), Tolerance::atLeast(), Good::Larger,
                      "", ""},
                     toolKept(runs)};
  illustrate(runs, name, item);
  item.parameters.emplace_back("point", "[" + vpApp::number(place.x(), 3) + ", " + vpApp::number(place.y(), 3) + ", " +
                                            vpApp::number(place.z(), 3) + "] m, ours: the thesis does not tell it");
  return item;
}

Item besideJoint()
{
  Item item = point("fig8.14", {0.45, 0.1, 0.4}, "the point beside it", -VISIBLE, std::nullopt);
  item.quantities.push_back({"way by self-motion alone, joint 4 over the larger of joints 2 and 6", "1", 1.,
                             freedomOfJoint4(*amor(), runSelfMotionExperiment(vpSelfMotionRunSpec::thesis(amor()))),
                             Tolerance::atLeast(), Good::Neither, "",
                             "The thesis: joint 4 has the most freedom. Means over the path of the tool."});
  return item;
}

//! Point below joint 4 of the first posture.
Item underJoint()
{
  const auto arm = amor();
  vpArmData data;
  vpArmKinematics::forward(*arm, arm->home(), data);
  return point("fig8.15", data.joint[JOINT_4].p - Eigen::Vector3d(0., 0., 0.1), "the point 0.1 m under it",
               std::nullopt, VISIBLE);
}

Item line()
{
  const Runs runs = runsOf(amor(), [](vpIndexSense sense) { return vpSelfMotionIndex::lineDistance(JOINT_4, sense); },
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
  const Runs runs = runsOf(arm, [&](vpIndexSense sense) { return vpSelfMotionRunSpec::thesisPlane(*arm, sense); },
                           {-STRONG, -WEAK, 0., WEAK, STRONG});
  Item item;
  item.id = "fig8.17";
  item.quantities = {meanRatio(runs, STRONG, WEAK, false), meanRatio(runs, WEAK, 0., false),
                     meanRatio(runs, -WEAK, 0., true), meanRatio(runs, -STRONG, -WEAK, true), toolKept(runs)};
  illustrate(runs, "the plane through base, the point above it and [1, 1, 0.5]", item);
  return item;
}
} // namespace

std::vector<Part> armParts()
{
  const auto part = [](const char *id, const char *title, Item (*make)()) {
    return Part{CHAPTER, {{id, title}}, 1.5, [make](const Setting &) { return std::vector<Item>{make()}; }, false};
  };
  return {{CHAPTER, {{"table8.1", "tracking errors of joints and tool"}}, 3., trackingErrors, false},
          part("fig8.14", "self-motion away from a point", besideJoint),
          part("fig8.15", "self-motion away from a point under the joint", underJoint),
          part("fig8.16", "self-motion towards the line from base to tool", line),
          part("fig8.17", "self-motion away from a plane and towards it", plane)};
}
} // namespace thesisReport
