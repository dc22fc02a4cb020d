/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"

#include <CLI/CLI.hpp>

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace trackPattern
{
namespace
{
constexpr const char *ABOUT =
    R"(Find the cells of a repetitive product (openings of a display, dots of a grid, pads of a wafer) in every image, to
hundredths of a pixel, and say how far the product moved since the image before. Nothing needs to be known of the
product: its lattice and its looks are learned from the first images (some 60 of a product that moves). The images must
show at least two cells each way. Colour is made grey; 16 bits a value are scaled to 8 by the range that they use; JPEG
and TIFF images are turned as their orientation tag says; every page of a TIFF is an image.

INPUT is a folder, image files, a pattern such as img%04d.png, a video file, or /dev/video0. Where the numbers in the names
jump, images are missing, and no displacement is given. What cannot be read is left out. Without input the program
makes a sequence of its own and says how far the answers are from the truth. It does so too for a folder that
visp-generate-pattern wrote.)";

constexpr const char *EXAMPLES =
    R"(Examples:
  visp-track-pattern
      its own sequence: what the method can do; open out/track-pattern/report.html
  visp-generate-pattern --noise 4 --dust 7 --out hard && visp-track-pattern hard --out tracked
      a dirty product with known truth
  visp-track-pattern --camera 0 --frames 500 --display
      what is under the microscope now
  visp-track-pattern recording --calibrate --pitch-um 220 80 --out scale
      how large a pixel is: the product, whose pitches are known, is the ruler
  visp-track-pattern recording --calibration scale/calibration.json --out moved
      the same recording in pixels and in micrometres

Written into the folder of --out: report.html (read this first), cells.csv, motion.csv, summary.json, and the overlay.
data/pattern/README.md describes the files. Ctrl-C ends the run with the report of what was seen until then. Places are pixels; (0, 0) is the centre of the top left one.

Exit status: 0 done, 1 an image, a file or the camera does not allow it or shows no pattern, 2 the command line is wrong,
130 ended by Ctrl-C.)";

constexpr std::size_t NAME_COLUMN = 34; // width, characters

const std::map<std::string, vpPatternMethod> METHODS = {{"gauss-newton", vpPatternMethod::GaussNewton},
                                                        {"half-maximum", vpPatternMethod::HalfMaximumEdges},
                                                        {"thesis", vpPatternMethod::ThesisAlgorithm},
                                                        {"thesis-fixed", vpPatternMethod::ThesisAlgorithmFixed}};
const std::map<std::string, vpPatternThreshold> THRESHOLDS = {{"otsu", vpPatternThreshold::Otsu},
                                                              {"isodata", vpPatternThreshold::Isodata},
                                                              {"minimum-error", vpPatternThreshold::MinimumError}};
const std::map<std::string, vpPatternDerivative> DERIVATIVES = {{"symmetric", vpPatternDerivative::Symmetric},
                                                                {"roberts", vpPatternDerivative::Roberts},
                                                                {"prewitt", vpPatternDerivative::Prewitt},
                                                                {"sobel", vpPatternDerivative::Sobel}};
const std::map<std::string, vpPatternPolarity> POLARITIES = {{"automatic", vpPatternPolarity::Automatic},
                                                             {"bright", vpPatternPolarity::Bright},
                                                             {"dark", vpPatternPolarity::Dark}};
const std::map<std::string, OverlayKind> OVERLAYS = {
    {"none", OverlayKind::None}, {"png", OverlayKind::Png}, {"mp4", OverlayKind::Mp4}};

template <class Value> std::string namesOf(const std::map<std::string, Value> &table)
{
  std::string names;
  std::size_t left = table.size();
  for (const auto &entry : table) {
    --left;
    names += entry.first + (left == 0 ? "" : left == 1 ? " or " : ", ");
  }
  return names;
}

//! An option whose value is one of a table.
template <class Value>
void addChoice(CLI::App &app, const std::string &name, const std::map<std::string, Value> &table, Value &target,
               const std::string &sentence, const std::string &preset, const std::string &group)
{
  app.add_option_function<std::string>(
         name,
         [&table, &target, name](const std::string &value) {
           const auto found = table.find(value);
           if (found == table.end()) {
             throw vpApp::UsageError(name + " is " + value + ", must be " + namesOf(table));
           }
           target = found->second;
         },
         sentence + ": " + namesOf(table) + " (default: " + preset + ")")
      ->option_text("NAME")
      ->group(group);
}

Roi roiOf(const std::string &text)
{
  Roi roi;
  int used = 0;
  unsigned int values[4] = {0, 0, 0, 0};
  const bool digits = text.find_first_not_of("0123456789,") == std::string::npos && text.size() < 40;
  if (!digits ||
      std::sscanf(text.c_str(), "%u,%u,%u,%u%n", &values[0], &values[1], &values[2], &values[3], &used) != 4 ||
      static_cast<std::size_t>(used) != text.size() || values[2] < 16 || values[3] < 16) {
    throw vpApp::UsageError("--roi is " + text + ", must be X,Y,WIDTH,HEIGHT in whole pixels, at least 16 x 16");
  }
  roi.x = values[0];
  roi.y = values[1];
  roi.width = values[2];
  roi.height = values[3];
  return roi;
}

void addInput(CLI::App &app, Options &options, std::string &roi)
{
  app.add_option("INPUT", options.inputs,
                 "Folder, image files, pattern, video file, or /dev/videoN (none: a sequence "
                 "of its own)");
  app.add_option("--camera", options.camera, "Read from the camera /dev/videoN")->option_text("N")->group("Input");
  app.add_option("--frames", options.frames, "Read so many at most (default: all; 200 of its own, 300 of a camera)")
      ->option_text("N")
      ->group("Input");
  app.add_option("--roi", roi, "Look only here; places are still those in the whole image")
      ->option_text("X,Y,W,H")
      ->group("Input");
  app.add_option("--seed", options.seed, "Of its own sequence (default: 1)")->option_text("N")->group("Input");
}

void addOutput(CLI::App &app, Options &options)
{
  app.add_option("--out", options.out, "Folder for the result (default: out/track-pattern)")
      ->option_text("DIR")
      ->group("Output");
  addChoice(app, "--overlay", OVERLAYS, options.overlay, "Pictures of what was found", "mp4", "Output");
  app.add_option("--video-rate", options.videoRate, "Frames per second of the overlay video (default: 25)")
      ->option_text("HZ")
      ->group("Output");
  app.add_flag("--display", options.display, "Show the overlay in a window; a click ends the run")->group("Output");
}

void addMethod(CLI::App &app, Options &options)
{
  const std::string group = "Method";
  addChoice(app, "--method", METHODS, options.tracker.method,
            "How a centre is measured; the others are baselines to compare with", "gauss-newton", group);
  addChoice(app, "--threshold", THRESHOLDS, options.tracker.threshold, "How bright and dark are told apart", "otsu",
            group);
  addChoice(app, "--derivative", DERIVATIVES, options.tracker.derivative, "For the two thesis methods", "symmetric",
            group);
  addChoice(app, "--polarity", POLARITIES, options.tracker.polarity, "What is a cell", "automatic", group);
}

void addScale(CLI::App &app, Options &options, std::vector<double> &pitch, double &sigma, double &axes)
{
  const std::string group = "Micrometres";
  app.add_option("--calibration", options.calibration,
                 "Results also in um, by this file: .json of --calibrate, or .xml "
                 "of ViSP")
      ->option_text("FILE")
      ->group(group);
  app.add_option("--camera-name", options.cameraName, "Of the camera in that .xml file (default: microscope)")
      ->option_text("NAME")
      ->group(group);
  app.add_flag("--calibrate", options.calibrate, "Write calibration.json and .xml; the product is the ruler")
      ->group(group);
  app.add_flag("--dot-grid", options.dotGrid, "For --calibrate: each image shows a grid of dots, at rest or not")
      ->group(group);
  app.add_option("--pitch-um", pitch, "For --calibrate: from column to column, and from row to row")
      ->expected(2)
      ->option_text("X Y")
      ->group(group);
  app.add_option(
         "--axes-deg", axes,
         "For --calibrate: from the columns' direction to the rows' (as found: 60 when the grid is hexagonal and "
         "both pitches are the same, otherwise 90)")
      ->option_text("A")
      ->group(group);
  app.add_option("--pitch-sigma-um", sigma,
                 "For --calibrate: standard deviation of a cell's place on the product (default: 0)")
      ->option_text("S")
      ->group(group);
}

void checkScale(Options &options, const std::vector<double> &pitch, double sigma, double axes)
{
  if (!options.calibrate && (options.dotGrid || !pitch.empty() || sigma != 0. || !std::isnan(axes))) {
    throw vpApp::UsageError("--dot-grid, --pitch-um, --axes-deg and --pitch-sigma-um belong to --calibrate");
  }
  if (options.calibrate && !options.calibration.empty()) {
    throw vpApp::UsageError("--calibrate makes a calibration and --calibration uses one: not both in one run");
  }
  if (options.calibrate) {
    if (pitch.size() != 2) {
      throw vpApp::UsageError("--calibrate needs --pitch-um X Y, the distances of columns and of rows");
    }
    for (const double value : pitch) {
      if (!(value > 0. && value < 1e9)) {
        throw vpApp::UsageError("--pitch-um is " + std::to_string(value) + " um, must be > 0");
      }
    }
    if (!(sigma >= 0. && sigma < 1e9)) {
      throw vpApp::UsageError("--pitch-sigma-um is " + std::to_string(sigma) + " um, must be >= 0");
    }
    if (!std::isnan(axes) && !(axes >= 30. && axes <= 150.)) {
      throw vpApp::UsageError("--axes-deg is " + std::to_string(axes) + ", must be 30..150");
    }
    options.pitch.angle = vpMath::rad(axes);
    options.pitch.columns = 1e-6 * pitch[0];
    options.pitch.rows = 1e-6 * pitch[1];
    options.pitch.sigmaPlane = 1e-6 * sigma;
  }
}

//! A camera may be given as --camera N, --camera /dev/videoN or as the input itself.
void findCamera(Options &options)
{
  if (!options.camera.empty()) {
    if (!options.inputs.empty()) {
      throw vpApp::UsageError("--camera and the input " + options.inputs[0] + " are both given");
    }
    if (options.camera.find_first_not_of("0123456789") == std::string::npos) {
      options.camera = "/dev/video" + options.camera;
    }
  }
  else if (options.inputs.size() == 1 && options.inputs[0].rfind("/dev/video", 0) == 0) {
    options.camera = options.inputs[0];
    options.inputs.clear();
  }
  if (!options.camera.empty()) {
    const std::string number = options.camera.rfind("/dev/video", 0) == 0 ? options.camera.substr(10) : "";
    if (number.empty() || number.size() > 4 || number.find_first_not_of("0123456789") != std::string::npos) {
      throw vpApp::UsageError("--camera is " + options.camera + ", must be a number or /dev/videoN");
    }
  }
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  CLI::App app(ABOUT, "visp-track-pattern");
  app.get_formatter()->column_width(NAME_COLUMN);
  app.footer(EXAMPLES);
  std::string roi;
  std::vector<double> pitch;
  double sigma = 0., axes = std::numeric_limits<double>::quiet_NaN(); // NaN: as detected
  addInput(app, options, roi);
  addOutput(app, options);
  addMethod(app, options);
  addScale(app, options, pitch, sigma, axes);
  if (!vpApp::parseCommandLine(app, argc, argv)) {
    return false;
  }
  if (app.count("--frames") > 0 && (options.frames < 1 || options.frames > 10000000)) {
    throw vpApp::UsageError("--frames is " + std::to_string(options.frames) + ", must be 1..10000000");
  }
  if (app.count("--roi") > 0) {
    options.roi = roiOf(roi);
  }
  if (!(options.videoRate >= 1. && options.videoRate <= 240.)) {
    throw vpApp::UsageError("--video-rate is " + std::to_string(options.videoRate) + ", must be 1..240");
  }
  checkScale(options, pitch, sigma, axes);
  findCamera(options);
  return true;
}
} // namespace trackPattern
