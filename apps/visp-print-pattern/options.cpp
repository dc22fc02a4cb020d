/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "commandLine.h"
#include "numberText.h"

#include <visp3/core/vpException.h>

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
      the method of the thesis, 50 times
  visp-print-pattern --reference constant --no-thesis
      constant velocity, for the throughput to compare with
  visp-print-pattern --explore data/explore/camera.json
      cameras, controllers and velocities against each other; out/print-explore/report.html
  mpirun -n 8 visp-print-pattern --explore data/explore/wide.json
      the same on 8 processes, on a cluster too, with the same result

Exit status: 0 done, 1 a file, the machine or the disk does not allow it, 2 the command line is wrong.)";

enum class Axes { One, Both };

//! \brief What is not a field of the specification as it is.
struct Choices {
  vpPrintController controller = vpPrintController::Observer;
  Axes axes = Axes::One;
  std::vector<double> filter; // alpha, beta; empty: that of the controller
  bool defects = false, noReplicas = false;
  int rows = 0; // 0: one, or three with both axes
  double flex = 0., flexPeriod = 20.;
};

// As vpPrintExperimentSpec::validate() has them, which also checks what depends on several options.
constexpr vpApp::Range ANY, POSITIVE = {0., 1e9, true}, NOT_NEGATIVE = {0., 1e9};

void addControl(vpApp::CommandLine &line, Choices &choices, Options &options)
{
  line.group("Control");
  line.choice("--controller", choices.controller,
              {{"observer", vpPrintController::Observer},
               {"pid", vpPrintController::Pid},
               {"pid-ff", vpPrintController::PidFeedforward}},
              "observer, pid or pid-ff (with mass and friction feedforward)");
  line.add(
      "--filter", "ALPHA BETA", "Gains of the alpha-beta filter, for pid and pid-ff", "",
      [&choices](const auto &values) {
        choices.filter = {vpApp::numberIn("--filter", values[0], {}), vpApp::numberIn("--filter", values[1], {})};
      },
      2);
  line.choice(
      "--sensor", options.sensor,
      {{"image", std::string("image")}, {"tracker", std::string("tracker")}, {"thesis", std::string("thesis")}},
      "image: rendered images through vpPatternTracker; tracker, thesis: true positions with the errors of that "
      "tracker, or of the thesis's detection");
  line.flag("--identify", options.identify,
            "First find mass and friction of the stage from a ramp that the camera watches, and use them");
  line.choice("--trigger", options.spec.trigger,
              {{"horizon", vpPrintTriggerMethod::Horizon}, {"thesis", vpPrintTriggerMethod::ThesisAlgorithm}},
              "horizon: each cell exactly once; thesis: algorithm 7.5");
}

void addMotion(vpApp::CommandLine &line, Choices &choices, vpPrintExperimentSpec &spec)
{
  line.group("Motion");
  line.choice("--reference", spec.reference.mode,
              {{"centres", vpPrintReferenceMode::CellVelocity},
               {"arrival", vpPrintReferenceMode::FixedArrival},
               {"limited", vpPrintReferenceMode::LimitedVelocity},
               {"constant", vpPrintReferenceMode::ConstantVelocity}},
              "centres: drop velocity at the centres and faster between; arrival: a fixed time from cell to cell; "
              "limited: as fast as a limit allows; constant: drop velocity all the way");
  line.number("--drop-velocity", spec.dropVelocity, POSITIVE, "PX/FRAME",
              "Velocity at the centres, below half a pitch");
  line.number("--mean-velocity", spec.reference.meanVelocity, POSITIVE, "PX/FRAME", "Mean velocity, for centres");
  line.number("--drop-time", spec.reference.dropTime, POSITIVE, "FRAMES", "Time from cell to cell, for arrival");
  line.number("--max-velocity", spec.reference.maxVelocity, POSITIVE, "PX/FRAME", "Limit of the velocity, for limited");
  line.choice("--axis", choices.axes, {{"x", Axes::One}, {"xy", Axes::Both}},
              "x: one row; xy: rows one after another, to and fro");
  line.whole("--rows", choices.rows, {1, 10000}, "N", "Rows, with --axis xy (default: 3)");
  line.whole("--cells", spec.cellsPerRow, {1, 10000}, "N", "Cells in a row");
  line.whole("--frames", spec.frames, {0, 1e9}, "N", "Stop after N frames; 0: when all cells are printed");
}

void addWorld(vpApp::CommandLine &line, Choices &choices, vpPrintExperimentSpec &spec)
{
  line.group("Product, camera and head");
  line.number("--flex", choices.flex, NOT_NEGATIVE, "PX",
              "Flexible pitch: largest displacement of a cell from its regular position, in x and y");
  line.number("--flex-period", choices.flexPeriod, {4., 1e6}, "CELLS", "Period of the flexible pitch");
  line.number("--jitter", spec.product.jitter, NOT_NEGATIVE, "PX", "Standard deviation of a cell's position");
  line.flag("--defects", choices.defects, "Dust and cracks: 12 and 3 in view");
  line.number("--noise", spec.product.noise, {0., 50.}, "NS", "Noise of the camera, see visp-generate-pattern");
  line.number("--vision-delay", spec.visionDelay, {0., 8.}, "FRAMES", "Time from exposure to control");
  line.number("--dropped", spec.dropped, {0., 0.5}, "SHARE", "Share of frames that never arrive");
  line.number("--travel-time", spec.travelTime, NOT_NEGATIVE, "FRAMES", "Travel time of a drop");
  line.number("--nozzle", spec.nozzleOffset, ANY, "PX", "Position of the nozzle from the middle of the image");
}

//! With --explore the file defines the runs: other options would be ignored.
void checkExploration(const vpApp::CommandLine &line, Options &options)
{
  for (const std::string &name : line.given()) {
    if (name != "--explore" && name != "--out" && name != "--jobs") {
      throw vpApp::UsageError(name + " is given beside --explore, which takes --out and --jobs only");
    }
  }
  options.out = line.isGiven("--out") ? options.out : "out/print-explore";
}

//! Beyond it the camera takes a motion for another one. The fastest velocity of which it is known in advance that it will be reached.
void checkVelocity(const vpPrintExperimentSpec &spec)
{
  const double limit = 0.5 * spec.product.pitchX;
  const auto check = [limit](const char *name, double velocity) {
    if (!(velocity < limit)) {
      throw vpApp::UsageError(
          std::string(name) + " is " + vpApp::number(velocity, 6) + " px/frame, must be below " +
          vpApp::number(limit, 3) +
          ", half the pitch of the cells: from image to image a larger motion looks like a smaller one");
    }
  };
  check("--drop-velocity", spec.dropVelocity);
  if (spec.reference.mode == vpPrintReferenceMode::CellVelocity) {
    check("--mean-velocity", spec.reference.meanVelocity);
  }
  if (spec.reference.mode == vpPrintReferenceMode::LimitedVelocity) {
    check("--max-velocity", spec.reference.maxVelocity);
  }
}

void complete(vpPrintExperimentSpec &spec, const Choices &choices, const std::string &sensor)
{
  if (sensor == "thesis") {
    const vpPrintExperimentSpec coarse = vpPrintExperimentSpec::withObserver(vpPrintSensorModel::thesis());
    spec.sensorModel = coarse.sensorModel;
    spec.observer = coarse.observer;
  }
  spec.sensor = sensor == "image" ? vpPrintSensor::Image : vpPrintSensor::Model;
  spec.controller = choices.controller;
  if (spec.controller != vpPrintController::Observer) {
    const vpPrintExperimentSpec pid =
        vpPrintExperimentSpec::withPid(spec.controller == vpPrintController::PidFeedforward);
    spec.pid = pid.pid;
    spec.filter = pid.filter;
  }
  if (!choices.filter.empty()) {
    spec.filter = {choices.filter[0], choices.filter[1]};
  }
  if (choices.axes == Axes::One && choices.rows > 1) {
    throw vpApp::UsageError("--rows is " + std::to_string(choices.rows) + ", more than one row needs --axis xy");
  }
  spec.rows = choices.axes == Axes::One ? 1 : choices.rows == 0 ? 3 : choices.rows;
  spec.product.flexAmplitudeX = spec.product.flexAmplitudeY = choices.flex;
  spec.product.flexPeriodX = spec.product.flexPeriodY = choices.flexPeriod;
  spec.product.dust = choices.defects ? 12. / 1.6 : 0.; // per 100 x 100 px
  spec.product.cracks = choices.defects ? 3. / 1.6 : 0.;
  spec.product.seed = spec.seed;
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-print-pattern", ABOUT, EXAMPLES);
  Choices choices;
  options.spec = vpPrintExperimentSpec::withObserver(vpPrintSensorModel::tracker());
  options.spec.cellsPerRow = 40;
  line.group("Run");
  line.text("--out", options.out, "DIR", "Folder for the result");
  line.text("--explore", options.explore, "FILE.json",
            "Explore the design space of a file (data/explore/README.md) instead: which frame rate, image, "
            "magnification, exposure, controller and velocity; also under mpirun");
  line.whole("--runs", options.runs, {1, 10000}, "N", "Repeat with other seeds");
  line.whole("--seed", options.spec.seed, {0, 4294967295.}, "N", "Seed of everything random");
  line.whole("--jobs", options.jobs, {1, 256}, "N", "Runs at a time (default: one for each core)");
  line.flag("--no-thesis", choices.noReplicas, "Leave out the experiments of the thesis");
  line.flag("--video", options.video, "Write camera.mp4: what the camera sees, and the drops");
  addControl(line, choices, options);
  addMotion(line, choices, options.spec);
  addWorld(line, choices, options.spec);
  if (!line.parse(argc, argv)) {
    return false;
  }
  if (!options.explore.empty()) {
    checkExploration(line, options);
  }
  options.replicas = !choices.noReplicas;
  complete(options.spec, choices, options.sensor);
  try {
    options.spec.validate();
  }
  catch (const vpException &error) {
    throw vpApp::UsageError(vpApp::sentenceOf(error));
  }
  checkVelocity(options.spec);
  return true;
}
} // namespace printPattern
