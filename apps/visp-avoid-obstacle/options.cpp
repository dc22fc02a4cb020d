/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "commandLine.h"
#include "numberText.h"
#include "plugin.h"
#include "replicas.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>

#include <algorithm>

namespace avoidObstacle
{
namespace
{
constexpr const char *ABOUT =
    R"(Bring an arm to a goal past obstacles that its eye-in-hand camera sees: views of real photographs are rendered,
obstacles are found in them, tracked, put into the scene that the method knows, and the drives of a simulated arm follow
what the method commands. The result is a folder with report.html (open it in a browser; python3 -m
visp_direct.report A B shows several side by side), samples.csv, tracks.csv, frames.csv, views.csv and summary.json.)";

constexpr const char *EXAMPLES = R"(Examples:
  visp-avoid-obstacle
      past a box that stands in the way of AMOR's tool
  visp-avoid-obstacle --method planner-dtg --hide 0.5:1.2 --record
      another method, the camera covered for a while, with a video of its view
  visp-avoid-obstacle --scene my-scene.json --sensor depth
      your own scene: data/scene/README.md has the fields; depth and poses need no photographs
  visp-avoid-obstacle --robot my-arm.urdf --robot-tip tool0 --camera-link camera --srdf my-arm.srdf
      your own arm: the default scene stands in the view of its camera
  visp-avoid-obstacle --replica fig8.7
      a figure of the thesis; --list names them

Exit status: 0 done (also when the arm had to wait), 1 the data do not allow it, 2 the command line is wrong, 3 done, and the
moving arm hit something.)";

std::pair<double, double> intervalOf(const std::string &text)
{
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) {
    throw vpApp::UsageError("--hide is " + text + ", must be FROM:UNTIL in s");
  }
  const double from = vpApp::numberIn("--hide", text.substr(0, colon), {0., 1e4});
  const double until = vpApp::numberIn("--hide", text.substr(colon + 1), {0., 1e4});
  if (until <= from) {
    throw vpApp::UsageError("--hide is " + text + ", must end after it begins");
  }
  return {from, until};
}

void requireKnown(const char *option, const std::string &name, const std::vector<std::string> &known)
{
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw vpApp::UsageError(std::string(option) + ": unknown \"" + name + "\"; known are " + vpApp::enumerate(known));
  }
}

//! A replica follows the thesis: only its result folder, and values that the thesis leaves open, may be chosen.
void requireNoneOfScene(const vpApp::CommandLine &line)
{
  for (const char *option : {"--method", "--scene", "--targets", "--sensor", "--hide", "--vision-rate", "--latency",
                             "--forget", "--noise", "--duration", "--record", "--display"}) {
    const std::string name = option;
    if (line.isGiven(name)) {
      throw vpApp::UsageError(name + " cannot be combined with --replica, which has its own");
    }
  }
}

void addOptions(vpApp::CommandLine &line, Options &options)
{
  line.group("Task");
  vpApp::addPluginOption(line, "avoidance methods and path planners");
  line.text("--method", options.method, "NAME",
            "How to avoid: " + vpApp::enumerate(vpAvoidanceMethodNames()) +
                " (default: dtg-via, planner-dtg for another arm)");
  line.text("--scene", options.scene, "FILE.json", "Obstacles and motion (default: data/scene/photo-box.json)");
  line.text("--targets", options.targets, "DIR", "Photographs that are known (default: data/target)");
  line.group("Camera and drives");
  line.choice<SensorKind>("--sensor", options.sensor,
                          {{nameOf(SensorKind::Image), SensorKind::Image},
                           {nameOf(SensorKind::Depth), SensorKind::Depth},
                           {nameOf(SensorKind::Poses), SensorKind::Poses}},
                          "How obstacles are seen");
  line.add(
      "--hide", "A:B", "The camera is covered from A to B s; may be given several times", "",
      [&options](const auto &values) {
        for (const std::string &interval : values) {
          options.hidden.push_back(intervalOf(interval));
        }
      },
      0);
  line.number("--vision-rate", options.visionRate, {0., 200., true}, "HZ", "Images per second");
  line.number("--latency", options.latency, {0., 10.}, "S", "Time from exposure to result");
  line.number("--forget", options.forget, {0., 1e4}, "S", "Forget obstacles unseen for S seconds; 0: never");
  line.number("--noise", options.noise, {0., 100.}, "GREY", "Standard deviation of the noise of images, grey values");
  line.number(
      "--friction", options.friction, {0., 10.}, "F",
      "Friction of the joints; 1: as in the arm's file, 0: ideal drives (default: 1, of an arm without masses 0)");
  line.group("Run");
  line.number("--duration", options.duration, {0., 600., true}, "S", "Maximum duration");
  line.whole("--seed", options.seed, {1, 1e6}, "N", "Seed of all noise and of planners");
  line.text("--replica", options.replica, "NAME", "A figure of the thesis, fig8.6 to fig8.13, see --list");
  line.text("--out", options.out, "DIR", "Result folder");
  line.flag("--record", options.record, "Write a video of what the camera sees");
  line.flag("--display", options.display, "Show the same in a window; needs a screen");
  line.flag("--list", options.list, "Name the methods and replicas, a sentence each, and end");
  vpApp::addRobotOptions(line, options.robot,
                         "The arm: amor, or a .urdf or .json file, see data/robot/README.md; visp-arm tells more");
}
} // namespace

const char *nameOf(SensorKind kind)
{
  return kind == SensorKind::Image ? "image" : kind == SensorKind::Depth ? "depth" : "poses";
}

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-avoid-obstacle", ABOUT, EXAMPLES);
  addOptions(line, options);
  if (!line.parse(argc, argv)) {
    return false;
  }
  options.frictionGiven = line.isGiven("--friction");
  if (options.method.empty()) {
    options.method = options.robot.robot == "amor" ? "dtg-via" : "planner-dtg";
  }
  requireKnown("--method", options.method, vpAvoidanceMethodNames());
  if (!options.replica.empty()) {
    requireKnown("--replica", options.replica, replicaNames());
    requireNoneOfScene(line);
  }
  return true;
}
} // namespace avoidObstacle
