/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Table 8.1: tracking errors of joints and tool of the arm.
#include "curves.h"
#include "part.h"

#include "dataFile.h"
#include "numberText.h"

#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmJson.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/simulation/vpArmDrives.h>

#include <array>
#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace thesisReport
{
namespace
{
constexpr double PERIOD = 0.005; // s, 200 Hz as in the thesis
constexpr int PERIODS = 2000;    // 10 s
constexpr int JOINTS = 7;

//! Desired and actual motion.
struct Tracking {
  std::vector<double> time;
  std::array<std::vector<double>, JOINTS> joints; //!< Desired minus actual, rad.
  std::array<std::vector<double>, 6> tool;        //!< x y z m, roll pitch yaw rad.
};

double rms(const std::vector<double> &values)
{
  double sum = 0.;
  for (const double value : values) {
    sum += value * value;
  }
  return std::sqrt(sum / static_cast<double>(values.size()));
}

//! Roll, pitch, yaw: about x, y and z of the base, R = Rz Ry Rx.
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d &R)
{
  return {std::atan2(R(2, 1), R(2, 2)), std::atan2(-R(2, 0), std::hypot(R(2, 1), R(2, 2))),
          std::atan2(R(1, 0), R(0, 0))};
}

//! Along the line of figure 8.8, 0.8 of its length in 4.5 s, minimum jerk, and back.
Tracking follow(const vpArmModel &arm, bool compensated, const Setting &setting, double done)
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
  constexpr int half = PERIODS / 2;
  Tracking tracking;
  for (int k = 0; k < PERIODS; ++k) {
    const double t = std::min(1., (k < half ? k : PERIODS - 1 - k) / (0.9 * half));
    input.goal = start;
    input.goal.p += 0.8 * t * t * t * (10. - 15. * t + 6. * t * t) * way;
    loop.step(input, state, output);
    drives.move(state.velocity, PERIOD);
    vpArmKinematics::forward(arm, drives.wanted(), wanted);
    vpArmKinematics::forward(arm, drives.q(), actual);
    tracking.time.push_back((k + 1) * PERIOD);
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
      setting.progress(done + 0.45 * k / PERIODS);
    }
  }
  return tracking;
}

const std::array<std::string, 6> &toolNames()
{
  static const std::array<std::string, 6> names = {"X", "Y", "Z", "roll", "pitch", "yaw"};
  return names;
}

std::vector<Item> play(const Setting &setting)
{
  constexpr std::array<double, JOINTS> thesisJoints = {0.0064, 0.0086, 0.0052, 0.0125, 0.0082, 0.0085, 0.0064};
  constexpr std::array<double, 6> thesisTool = {0.0030, 0.0056, 0.0052, 0.0062, 0.0039, 0.0072};
  const vpArmModel arm = vpLoadArmJson(vpApp::dataFile("robot/amor.json"));
  const Tracking plain = follow(arm, false, setting, 0.), compensated = follow(arm, true, setting, 0.45);
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
  item.data.push_back({"rms.csv", csv});
  item.remarks = {"The thesis does not say on which motion its errors were taken."};
  item.parameters = {{"arm", "AMOR, 7 joints, by torques: PD with gravity at 1 kHz, references at 200 Hz"},
                     {"motion", "0.8 of the way of figure 8.8, there and back in 10 s, least jerk"},
                     {"friction", "viscous, Coulomb and static, of the arm's file"}};
  addPlot(item, "errors", "Errors of joints and tool without friction compensation",
          "Friction holds every joint some mrad back, against its direction of motion.", {joints, tool});
  return {item};
}
} // namespace

std::vector<Part> armTrackingParts()
{
  return {{"Chapter 8: obstacle avoidance", {{"table8.1", "tracking errors of joints and tool"}}, 3., play}};
}
} // namespace thesisReport
