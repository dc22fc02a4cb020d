/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "numberText.h"
#include "replicas.h"

#include <CLI/CLI.hpp>

#include <visp3/avoidance/vpAvoidanceMethods.h>

#include <algorithm>
#include <cmath>

namespace avoidObstacle
{
namespace
{
constexpr const char *ABOUT =
    R"(Bring an arm to a goal past obstacles that the camera in its hand sees: pictures of real photographs are rendered,
obstacles are found in them, tracked, put into the scene that the method knows, and the drives of a simulated arm follow
what the method commands. The result is a folder with report.html (open it in a browser), samples.csv, tracks.csv,
frames.csv and summary.json.)";

constexpr const char *EXAMPLES = R"(Examples:
  visp-avoid-obstacle
      past a box that stands in the way of AMOR's tool
  visp-avoid-obstacle --method planner-dtg --hide 0.5:1.2 --record
      another method, the camera covered for a while, with a video
  visp-avoid-obstacle --scene my-scene.json --sensor depth
      your own scene: data/scene/README.md has the fields; depth and poses need no photographs
  visp-avoid-obstacle --replica fig8.7
      a figure of the thesis; --list names them

Exit status: 0 done (also when the arm had to wait), 1 the data do not allow it, 2 the command line is wrong, 3 done, and the
moving arm hit something.)";

constexpr std::size_t NAME_COLUMN = 22; // width, characters

//! A number in a range. \throw vpApp::UsageError naming the option.
double numberIn(const char *option, const std::string &text, double least, double most, bool orLeast)
{
  std::size_t used = 0;
  double value = NAN;
  try {
    value = std::stod(text, &used);
  }
  catch (const std::exception &) {
    used = 0;
  }
  const bool good = used == text.size() && used > 0 && std::isfinite(value) && value <= most &&
                    (orLeast ? value >= least : value > least);
  if (!good) {
    throw vpApp::UsageError(std::string(option) + " is " + text + ", must be a number " + (orLeast ? ">= " : "> ") +
                            vpApp::number(least, 4) + " and <= " + vpApp::number(most, 6));
  }
  return value;
}

unsigned int seedOf(const std::string &text)
{
  const double value = numberIn("--seed", text, 1., 1e6, true);
  if (value != std::floor(value)) {
    throw vpApp::UsageError("--seed is " + text + ", must be a whole number");
  }
  return static_cast<unsigned int>(value);
}

std::pair<double, double> intervalOf(const std::string &text)
{
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) {
    throw vpApp::UsageError("--hide is " + text + ", must be FROM:UNTIL in s");
  }
  const double from = numberIn("--hide", text.substr(0, colon), 0., 1e4, true);
  const double until = numberIn("--hide", text.substr(colon + 1), 0., 1e4, true);
  if (until <= from) {
    throw vpApp::UsageError("--hide is " + text + ", must end after it begins");
  }
  return {from, until};
}

SensorKind sensorOf(const std::string &text)
{
  for (const SensorKind kind : {SensorKind::Image, SensorKind::Depth, SensorKind::Poses}) {
    if (text == nameOf(kind)) {
      return kind;
    }
  }
  throw vpApp::UsageError("--sensor is " + text + ", must be image, depth or poses");
}

void requireKnown(const char *option, const std::string &name, const std::vector<std::string> &known)
{
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw vpApp::UsageError(std::string(option) + ": unknown \"" + name + "\"; known are " + vpApp::enumerate(known));
  }
}

//! A replica follows the thesis: only its result folder, and values that the thesis leaves open, may be chosen.
void requireNothingElse(const CLI::App &app)
{
  for (const char *other : {"--method", "--scene", "--targets", "--sensor", "--hide", "--vision-rate", "--latency",
                            "--duration", "--noise", "--forget", "--record", "--display"}) {
    if (app.get_option(other)->count() > 0) {
      throw vpApp::UsageError(std::string(other) + " cannot be combined with --replica, which has its own");
    }
  }
}

//! Options read as text, so that messages can name them.
struct Texts {
  std::string visionRate = "30", latency = "0.05", duration = "20", noise = "2", forget = "0", friction = "1",
              seed = "1";
  std::string sensor = "image";
  std::vector<std::string> hidden;
};

void addOptions(CLI::App &app, Options &options, Texts &texts)
{
  app.add_option("--method", options.method,
                 "How to avoid: " + vpApp::enumerate(avoidanceMethodNames()) + " (default: dtg-via)")
      ->option_text("NAME");
  app.add_option("--scene", options.scene, "Obstacles and motion (default: data/scene/photo-box.json)")
      ->option_text("FILE.json");
  app.add_option("--arm", options.arm, "Another arm than AMOR, see data/robot/README.md")->option_text("FILE.json");
  app.add_option("--targets", options.targets, "Photographs that are known (default: data/target)")->option_text("DIR");
  app.add_option("--sensor", texts.sensor, "How obstacles are seen: image (default), depth or poses")
      ->option_text("KIND");
  app.add_option("--hide", texts.hidden, "The camera is covered from A to B s; may be given several times")
      ->option_text("A:B");
  app.add_option("--vision-rate", texts.visionRate, "Pictures a second (default: 30)")->option_text("HZ");
  app.add_option("--latency", texts.latency, "From exposure to result (default: 0.05)")->option_text("S");
  app.add_option("--forget", texts.forget, "What was not seen for so long is not there any more; 0: never (default)")
      ->option_text("S");
  app.add_option("--noise", texts.noise, "Of pictures, grey values (default: 2)")->option_text("GREY");
  app.add_option("--friction", texts.friction, "Friction of the joints, 1: the arm's file (default), 0: ideal drives")
      ->option_text("F");
  app.add_option("--duration", texts.duration, "At most so long (default: 20)")->option_text("S");
  app.add_option("--seed", texts.seed, "Of all noise and of planners (default: 1)")->option_text("N");
  app.add_option("--replica", options.replica, "A figure of the thesis, fig8.6 to fig8.13, see --list")
      ->option_text("NAME");
  app.add_option("--out", options.out, "Result folder (default: out/avoid-obstacle)")->option_text("DIR");
  app.add_flag("--record", options.record, "Write a video: the camera's view beside the arm");
  app.add_flag("--display", options.display, "Show the same in a window; needs a screen");
  app.add_flag("--list", options.list, "Name the methods and replicas, a sentence each, and end");
}
} // namespace

const char *nameOf(SensorKind kind)
{
  return kind == SensorKind::Image ? "image" : kind == SensorKind::Depth ? "depth" : "poses";
}

bool readOptions(int argc, const char *const *argv, Options &options)
{
  CLI::App app(ABOUT, "visp-avoid-obstacle");
  app.get_formatter()->column_width(NAME_COLUMN);
  app.footer(EXAMPLES);
  Texts texts;
  addOptions(app, options, texts);
  if (!vpApp::parseCommandLine(app, argc, argv)) {
    return false;
  }
  requireKnown("--method", options.method, avoidanceMethodNames());
  if (!options.replica.empty()) {
    requireKnown("--replica", options.replica, replicaNames());
    requireNothingElse(app);
  }
  options.sensor = sensorOf(texts.sensor);
  for (const std::string &interval : texts.hidden) {
    options.hidden.push_back(intervalOf(interval));
  }
  options.visionRate = numberIn("--vision-rate", texts.visionRate, 0., 200., false);
  options.latency = numberIn("--latency", texts.latency, 0., 10., true);
  options.duration = numberIn("--duration", texts.duration, 0., 600., false);
  options.forget = numberIn("--forget", texts.forget, 0., 1e4, true);
  options.noise = numberIn("--noise", texts.noise, 0., 100., true);
  options.friction = numberIn("--friction", texts.friction, 0., 10., true);
  options.seed = seedOf(texts.seed);
  return true;
}
} // namespace avoidObstacle
