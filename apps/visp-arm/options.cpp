/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"

namespace armProgram
{
namespace
{
constexpr const char *ABOUT =
    R"(Show how a robot file is understood, before anything moves: joints with their limits, what collision checks see of
each link, the pairs of links that are checked against each other, masses, reach, and what the files leave open.)";

constexpr const char *EXAMPLES = R"(Examples:
  visp-arm
      AMOR, the arm of the thesis
  visp-arm my-arm.urdf --robot-tip tool0 --srdf my-arm.srdf --out out/my-arm
      with a report that shows the robot in 3D
  visp-arm my-arm.urdf --robot-tip tool0 --hold left_finger=0.02,right_finger=0.02 --json
      for another program; the fingers are promised to stay where they are
  visp-arm my-arm.urdf --robot-tip tool0 --fk 0,-1.57,1.57,0,0,0
      the pose of the tool in a configuration
  visp-arm my-arm.urdf --robot-tip tool0 --touches my-scene.json --at 0,-1.57,1.57,0,0,0
      what touches in a configuration: data/scene/README.md has the fields of scenes

Exit status: 0 the robot is usable, 1 it is not, with the reason, or a file is missing or wrong, 2 the command line is wrong.)";
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-arm", ABOUT, EXAMPLES);
  const auto numbers = [&line](const char *name, std::vector<double> &values, const std::string &sentence) {
    line.add(name, "Q,...", sentence, "",
             [&values, name](const auto &texts) { values = vpApp::numbersIn(name, texts[0]); });
  };
  line.text("FILE", options.robot.robot, " ", "The robot: a .urdf or .json file, see data/robot/README.md, or amor");
  vpApp::addRobotOptions(line, options.robot, "");
  line.group("Questions and results");
  line.flag("--json", options.json, "Print JSON on standard output");
  line.text("--out", options.out, "DIR", "Result folder for the same as JSON, and a report with the robot in 3D");
  numbers("--fk", options.fk, "Tell the pose of the tool in the base at this configuration, rad or m");
  line.text("--touches", options.touches, "FILE.json", "Tell what touches in this scene, with --at");
  numbers("--at", options.at, "Configuration for --touches, rad or m");
  line.text("--write-pairs", options.writtenPairs, "FILE",
            "Write which pairs of bodies touch in 10,000 random configurations, for --allowed-pairs; takes minutes");
  if (!line.parse(argc, argv)) {
    return false;
  }
  if (options.touches.empty() != options.at.empty()) {
    throw vpApp::UsageError(options.at.empty() ? "--touches needs the configuration, --at Q,..."
                                               : "--at needs the scene, --touches FILE.json");
  }
  return true;
}
} // namespace armProgram
