/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "jobs.h"
#include "numberText.h"

#include <CLI/CLI.hpp>

#include <cmath>

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

constexpr const char *EXAMPLES = R"(Scenes (--list says more):
  S1 the ball of figures 8.6-8.12   S2 random obstacles   S3 crossing obstacles   S4 pillar and shelf
  S5 self-motion   S6 a trap   S7 the moving goal of figure 8.13   FILE.json a scene of your own with tasks

Examples:
  visp-plan-compare
      everything; below 5 minutes on 2 cores
  visp-plan-compare --quick
      everything with a few seeds
  visp-plan-compare --scene S3 --method dtg,planner-dtg --seeds 50
      two methods among obstacles that move
  visp-plan-compare --scene my-scene.json --seeds 10
      your own scene: data/scene/README.md has the fields

Exit status: 0 done, 1 the data do not allow it, 2 the command line is wrong. Nothing is written unless all succeeded.)";

constexpr std::size_t NAME_COLUMN = 22; // width, characters

unsigned int atLeastOne(const char *option, const std::string &text)
{
  std::size_t used = 0;
  long long number = 0;
  try {
    number = std::stoll(text, &used);
  }
  catch (const std::exception &) {
    used = 0;
  }
  if (used != text.size() || number < 1 || number > 100000) {
    throw vpApp::UsageError(std::string(option) + " is " + text + ", must be a whole number from 1 to 100000");
  }
  return static_cast<unsigned int>(number);
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  CLI::App app(ABOUT, "visp-plan-compare");
  app.get_formatter()->column_width(NAME_COLUMN);
  app.footer(EXAMPLES);

  std::string seeds, first = "1", jobs = std::to_string(vpApp::coreCount());
  app.add_option("--scene", options.scenes, "Scenes to run, S1 to S7 or files (default: all)")
      ->delimiter(',')
      ->option_text("SCENE,...");
  app.add_option("--method", options.methods, "Methods to compare (default: all)")
      ->delimiter(',')
      ->option_text("NAME,...");
  app.add_option("--seeds", seeds, "Seeds of each scene (default: 5 to 200, see --list)")->option_text("N");
  app.add_option("--seed", first, "The first seed (default: 1)")->option_text("S");
  app.add_flag("--quick", options.quick, "A few seeds of each scene: some seconds");
  app.add_option("--arm", options.arm, "Another arm than AMOR, see data/robot/README.md")->option_text("FILE.json");
  app.add_option("--friction", options.friction,
                 "Drives by torques against so much of the arm's friction; 0: ideal drives (default)")
      ->option_text("F");
  app.add_option("--out", options.out, "Result folder (default: out/plan-compare)")->option_text("DIR");
  app.add_option("--jobs", jobs, "Runs at a time (default: one for each core)")->option_text("N");
  app.add_flag("--list", options.list, "Name the scenes and methods, a sentence each, and end");

  if (!vpApp::parseCommandLine(app, argc, argv)) {
    return false;
  }
  if (!seeds.empty()) {
    options.seeds = atLeastOne("--seeds", seeds);
  }
  options.firstSeed = atLeastOne("--seed", first);
  options.jobs = atLeastOne("--jobs", jobs);
  if (options.quick && !seeds.empty()) {
    throw vpApp::UsageError("--quick has its own number of seeds, it cannot be combined with --seeds");
  }
  if (!std::isfinite(options.friction) || options.friction < 0.) {
    throw vpApp::UsageError("--friction is " + vpApp::number(options.friction, 6) + ", must be >= 0 and finite");
  }
  return true;
}
} // namespace planCompare
