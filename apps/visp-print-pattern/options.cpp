/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "numberText.h"

#include <CLI/CLI.hpp>

#include <visp3/core/vpException.h>

#include <map>

namespace printPattern
{
namespace
{
constexpr const char *ABOUT =
    R"(Print a drop into every cell of a moving, flexible product, with the camera as the only encoder: camera -> cells ->
motion -> trajectory -> control -> stage -> drops, all simulated, and a report. Lengths are px of the image (4.5 um),
times are frames (1/1600 s). The product, the stage and the figures are those of chapter 7 of the thesis.)";

constexpr const char *EXAMPLES =
    R"(Examples:
  visp-print-pattern
      40 cells through rendered images and the tracker, the experiments of the thesis, out/print-pattern/report.html
  visp-print-pattern --axis xy --rows 4 --flex 2 --defects
      four rows of a flexible, dirty product, printed one after another
  visp-print-pattern --controller pid-ff --sensor thesis --trigger thesis --runs 50 --cells 200
      the thesis's own way, 50 times
  visp-print-pattern --reference constant --no-thesis
      constant velocity, for the throughput to compare with
  visp-print-pattern --explore data/explore/camera.json
      cameras, controllers and velocities against each other; out/print-explore/report.html
  mpirun -n 8 visp-print-pattern --explore data/explore/wide.json
      the same on 8 processes, on a cluster too, with the same result

Exit status: 0 done, 1 a file, the machine or the disk does not allow it, 2 the command line is wrong.)";

constexpr std::size_t NAME_COLUMN = 34; // width, characters

template <typename Value>
Value valueOf(const std::string &option, const std::string &name, const std::map<std::string, Value> &values)
{
  const auto found = values.find(name);
  if (found == values.end()) {
    std::vector<std::string> names;
    for (const auto &value : values) {
      names.push_back(value.first);
    }
    throw vpApp::UsageError(option + " is " + name + ", must be one of " + vpApp::enumerate(names));
  }
  return found->second;
}

//! \brief Texts and numbers from the command line, before conversion to a specification.
struct RawOptions {
  std::string controller = "observer", reference = "centres", trigger = "horizon", axis = "x";
  std::vector<double> filter;
  bool defects = false, noReplicas = false;
  int rows = 0;
  double meanVelocity = 5., maxVelocity = 6., dropTime = 10.8, flex = 0., flexPeriod = 20., jitter = 0., noise = 4.;
  double dropVelocity = 4., visionDelay = 1.28, travelTime = 0.32, nozzle = 0., dropped = 0.;
  int cells = 40, frames = 0;
  unsigned int seed = 1;
};

void addControl(CLI::App &app, RawOptions &raw, Options &options)
{
  const char *group = "Control";
  app.add_option("--controller", raw.controller,
                 "observer, pid or pid-ff (with mass and friction feedforward) (default: observer)")
      ->option_text("NAME")
      ->group(group);
  app.add_option("--filter", raw.filter, "Gains of the alpha-beta filter, for pid and pid-ff")
      ->expected(2)
      ->option_text("ALPHA BETA")
      ->group(group);
  app.add_option(
         "--sensor", options.sensor,
         "image: rendered pictures through vpPatternTracker; tracker, thesis: true places with the errors of that "
         "tracker, or of the thesis's detection (default: image)")
      ->option_text("NAME")
      ->group(group);
  app.add_flag("--identify", options.identify,
               "First find mass and friction of the stage from a ramp that the camera watches, and use them")
      ->group(group);
  app.add_option("--trigger", raw.trigger, "horizon: each cell exactly once; thesis: algorithm 7.5 (default: horizon)")
      ->option_text("NAME")
      ->group(group);
}

void addMotion(CLI::App &app, RawOptions &raw)
{
  const char *group = "Motion";
  app.add_option("--reference", raw.reference,
                 "centres: drop velocity at the centres and faster between; arrival: a fixed time from cell to cell; "
                 "limited: as fast as a limit allows; constant: drop velocity all the way (default: centres)")
      ->option_text("NAME")
      ->group(group);
  app.add_option("--drop-velocity", raw.dropVelocity, "At the centres (default: 4)")
      ->option_text("PX/FRAME")
      ->group(group);
  app.add_option("--mean-velocity", raw.meanVelocity, "For centres (default: 5)")
      ->option_text("PX/FRAME")
      ->group(group);
  app.add_option("--drop-time", raw.dropTime, "For arrival (default: 10.8)")->option_text("FRAMES")->group(group);
  app.add_option("--max-velocity", raw.maxVelocity, "For limited (default: 6)")->option_text("PX/FRAME")->group(group);
  app.add_option("--axis", raw.axis, "x: one row; xy: rows one after another, to and fro (default: x)")
      ->option_text("NAME")
      ->group(group);
  app.add_option("--rows", raw.rows, "With --axis xy (default: 3)")->option_text("N")->group(group);
  app.add_option("--cells", raw.cells, "In a row (default: 40)")->option_text("N")->group(group);
  app.add_option("--frames", raw.frames, "Stop after N frames; 0: when all cells are printed (default: 0)")
      ->option_text("N")
      ->group(group);
}

void addWorld(CLI::App &app, RawOptions &raw)
{
  const char *group = "Product, camera and head";
  app.add_option("--flex", raw.flex,
                 "Flexible pitch: cells lie up to this far before or behind their place, in x and y (default: 0)")
      ->option_text("PX")
      ->group(group);
  app.add_option("--flex-period", raw.flexPeriod, "Period of the flexible pitch (default: 20)")
      ->option_text("CELLS")
      ->group(group);
  app.add_option("--jitter", raw.jitter, "Standard deviation of a cell's place (default: 0)")
      ->option_text("PX")
      ->group(group);
  app.add_flag("--defects", raw.defects, "Dust and cracks: 12 and 3 in view")->group(group);
  app.add_option("--noise", raw.noise, "Of the camera, see visp-generate-pattern (default: 4)")
      ->option_text("NS")
      ->group(group);
  app.add_option("--vision-delay", raw.visionDelay, "From exposure to control (default: 1.28)")
      ->option_text("FRAMES")
      ->group(group);
  app.add_option("--dropped", raw.dropped, "Share of frames that never arrive (default: 0)")
      ->option_text("SHARE")
      ->group(group);
  app.add_option("--travel-time", raw.travelTime, "Of a drop (default: 0.32)")->option_text("FRAMES")->group(group);
  app.add_option("--nozzle", raw.nozzle, "Place of the nozzle from the middle of the image (default: 0)")
      ->option_text("PX")
      ->group(group);
}

//! With --explore the file defines the runs: other options would be ignored.
void checkExploration(const CLI::App &app, Options &options)
{
  for (const CLI::Option *option : app.get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && name != "--explore" && name != "--out" && name != "--jobs") {
      throw vpApp::UsageError(name + " is given beside --explore, which takes --out and --jobs only");
    }
  }
  options.out = app.get_option("--out")->count() > 0 ? options.out : "out/print-explore";
}

vpPrintExperimentSpec specOf(const RawOptions &raw, const Options &options)
{
  const auto controller = valueOf<vpPrintController>("--controller", raw.controller,
                                                     {{"observer", vpPrintController::Observer},
                                                      {"pid", vpPrintController::Pid},
                                                      {"pid-ff", vpPrintController::PidFeedforward}});
  const auto model = valueOf<vpPrintSensorModel>("--sensor", options.sensor,
                                                 {{"image", vpPrintSensorModel::tracker()},
                                                  {"tracker", vpPrintSensorModel::tracker()},
                                                  {"thesis", vpPrintSensorModel::thesis()}});
  vpPrintExperimentSpec spec = vpPrintExperimentSpec::withObserver(model);
  if (controller != vpPrintController::Observer) {
    const vpPrintExperimentSpec pid = controller == vpPrintController::Pid ? vpPrintExperimentSpec::thesisPid()
                                                                           : vpPrintExperimentSpec::thesisFeedforward();
    spec.controller = controller;
    spec.pid = pid.pid;
    spec.filter = pid.filter;
  }
  if (!raw.filter.empty()) {
    spec.filter = {raw.filter[0], raw.filter[1]};
  }
  spec.sensor = options.sensor == "image" ? vpPrintSensor::Image : vpPrintSensor::Model;
  spec.trigger = valueOf<vpPrintTriggerMethod>(
      "--trigger", raw.trigger,
      {{"horizon", vpPrintTriggerMethod::Horizon}, {"thesis", vpPrintTriggerMethod::ThesisAlgorithm}});
  spec.reference.mode = valueOf<vpPrintReferenceMode>("--reference", raw.reference,
                                                      {{"centres", vpPrintReferenceMode::CellVelocity},
                                                       {"arrival", vpPrintReferenceMode::FixedArrival},
                                                       {"limited", vpPrintReferenceMode::LimitedVelocity},
                                                       {"constant", vpPrintReferenceMode::ConstantVelocity}});
  spec.reference.meanVelocity = raw.meanVelocity;
  spec.reference.maxVelocity = raw.maxVelocity;
  spec.reference.dropTime = raw.dropTime;
  spec.dropVelocity = raw.dropVelocity;
  const bool both = valueOf<bool>("--axis", raw.axis, {{"x", false}, {"xy", true}});
  if (!both && raw.rows > 1) {
    throw vpApp::UsageError("--rows is " + std::to_string(raw.rows) + ", more than one row needs --axis xy");
  }
  spec.rows = both ? (raw.rows == 0 ? 3 : raw.rows) : 1;
  spec.cellsPerRow = raw.cells;
  spec.frames = raw.frames;
  spec.product.flexAmplitudeX = spec.product.flexAmplitudeY = raw.flex;
  spec.product.flexPeriodX = spec.product.flexPeriodY = raw.flexPeriod;
  spec.product.jitter = raw.jitter;
  spec.product.noise = raw.noise;
  spec.product.dust = raw.defects ? 12. / 1.6 : 0.; // per 100 x 100 px
  spec.product.cracks = raw.defects ? 3. / 1.6 : 0.;
  spec.product.seed = raw.seed;
  spec.visionDelay = raw.visionDelay;
  spec.dropped = raw.dropped;
  spec.travelTime = raw.travelTime;
  spec.nozzleOffset = raw.nozzle;
  spec.seed = raw.seed;
  return spec;
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  CLI::App app(ABOUT, "visp-print-pattern");
  app.get_formatter()->column_width(NAME_COLUMN);
  app.footer(EXAMPLES);
  RawOptions raw;
  app.add_option("--out", options.out, "Folder for the result (default: out/print-pattern)")->option_text("DIR");
  app.add_option("--explore", options.explore,
                 "Explore the design space of a file (data/explore/README.md) instead: which frame rate, image, "
                 "magnification, exposure, controller and velocity; also under mpirun")
      ->option_text("FILE.json");
  app.add_option("--runs", options.runs, "Repeat with other seeds, 1..10000 (default: 1)")->option_text("N");
  app.add_option("--seed", raw.seed, "Of everything random (default: 1)")->option_text("N");
  app.add_option("--jobs", options.jobs, "Runs at a time (default: one for each core)")->option_text("N");
  app.add_flag("--no-thesis", raw.noReplicas, "Leave out the experiments of the thesis");
  app.add_flag("--video", options.video, "Write camera.mp4: what the camera sees, and the drops");
  addControl(app, raw, options);
  addMotion(app, raw);
  addWorld(app, raw);
  if (!vpApp::parseCommandLine(app, argc, argv)) {
    return false;
  }
  if (app.get_option("--explore")->count() > 0) {
    checkExploration(app, options);
  }
  if (options.runs < 1 || options.runs > 10000) {
    throw vpApp::UsageError("--runs is " + std::to_string(options.runs) + ", must be 1..10000");
  }
  if (app.count("--jobs") > 0 && (options.jobs < 1 || options.jobs > 256)) {
    throw vpApp::UsageError("--jobs is " + std::to_string(options.jobs) + ", must be 1..256");
  }
  options.replicas = !raw.noReplicas;
  options.spec = specOf(raw, options);
  try {
    options.spec.validate();
  }
  catch (const vpException &error) {
    throw vpApp::UsageError(vpApp::sentenceOf(error));
  }
  return true;
}
} // namespace printPattern
