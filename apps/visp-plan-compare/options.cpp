/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "commandLine.h"
#include "plugin.h"

namespace planCompare
{
namespace
{
constexpr const char *ABOUT =
    R"(Compare ways to bring an arm to a goal among obstacles: the potential field of the thesis as printed and corrected,
direct trajectory generation point to point and through a via, a planner with a timed path, and the planner with its
path tracked and replanned on the fly. All of them get the same scenes, the same noise and the same limits. The arm,
its sensors and the obstacles are simulated. The result is a folder with report.html (open it in a browser),
summary.json, runs.csv, a CSV file for each shown run, and logs for Planner Arena.)";

constexpr const char *EXAMPLES =
    R"(Scenes: S1 the ball of figures 8.6 to 8.12, S2 random obstacles, S3 crossing obstacles, S4 pillar and shelf,
S5 self-motion, S6 a trap, S7 the moving goal of figure 8.13, FILE.json a scene of your own with tasks. --list says more.

Examples:
  visp-plan-compare
      everything; below 5 minutes on 2 cores
  visp-plan-compare --quick
      everything with a few seeds
  visp-plan-compare --scene S3 --method dtg,planner-dtg --seeds 50
      two methods among obstacles that move
  visp-plan-compare --scene my-scene.json --seeds 10
      your own scene: data/scene/README.md has the fields
  visp-plan-compare --robot my-arm.urdf --robot-tip tool0 --srdf my-arm.srdf
      your own arm: scenes are fitted to its reach, those with tasks for AMOR are left out
  mpirun -n 8 visp-plan-compare --scene S2,S3 --seeds 1000
      on 8 processes, on a cluster too, with the same result

Exit status: 0 done, 1 the data do not allow it, 2 the command line is wrong. Nothing is written unless all succeeded.)";
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-plan-compare", ABOUT, EXAMPLES);
  line.group("Comparison");
  vpApp::addPluginOption(line, "avoidance methods and path planners");
  line.list("--scene", options.scenes, "SCENE,...", "Scenes to run, S1 to S7 or files (default: all)");
  line.list("--method", options.methods, "NAME,...", "Methods to compare (default: all)");
  line.whole("--seeds", options.seeds, {1, 100000}, "N", "Seeds of each scene (default: 5 to 200, see --list)");
  line.whole("--seed", options.firstSeed, {1, 100000}, "S", "The first seed");
  line.flag("--quick", options.quick, "A few seeds of each scene: some seconds");
  line.number("--friction", options.friction, {0., 10.}, "F",
              "Drives by torques against this share of the arm's friction, not compensated; 0: ideal drives");
  line.flag("--compensate-friction", options.compensateFriction,
            "With --friction: the control of the drives adds the friction of the arm's file");
  line.text("--out", options.out, "DIR", "Result folder");
  line.whole("--jobs", options.jobs, {1, 256}, "N", "Runs at a time (default: one for each core)");
  line.flag("--list", options.list, "Name the scenes and methods, a sentence each, and end");
  vpApp::addRobotOptions(line, options.robot,
                         "The arm: amor, or a .urdf or .json file, see data/robot/README.md; visp-arm tells more");
  if (!line.parse(argc, argv)) {
    return false;
  }
  if (options.quick && line.isGiven("--seeds")) {
    throw vpApp::UsageError("--quick has its own number of seeds, it cannot be combined with --seeds");
  }
  if (options.compensateFriction && !(options.friction > 0.)) {
    throw vpApp::UsageError("--compensate-friction is for drives with friction, --friction is 0");
  }
  return true;
}
} // namespace planCompare
