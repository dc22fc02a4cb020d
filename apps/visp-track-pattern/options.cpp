/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "commandLine.h"
#include "imageSource.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace trackPattern
{
namespace
{
constexpr const char *ABOUT =
    R"(Find the cells of a repetitive product (openings of a display, dots of a grid, pads of a wafer) in every image, to
hundredths of a pixel, and say how far the product moved since the image before. Nothing needs to be known of the
product: its lattice and its appearance are learned from the first images (some 60 of a product that moves). The images must
show at least two cells each way, on a rectangular lattice with one cell a period (a hexagonal grid is for --calibrate
--dot-grid only). From image to image the product must move by less than half a pitch: more is taken for less, and a
multiple of the pitch cannot be seen. Record without loss, as PNG or FFV1: what H.264 does to the images is not in the
standard deviations. Colour is converted to grey; 16 bits per value are scaled to 8 by the range that they use;
JPEG and TIFF images are rotated by their orientation tag; every page of a TIFF is an image.

INPUT is a folder, image files, a pattern such as img%04d.png, a video file, or /dev/video0. Where the numbers in the names
jump, images are missing, and no displacement is given. Images that cannot be read are skipped. Without input the program
renders a sequence and reports the errors against its ground truth, as it does for a folder that
visp-generate-pattern wrote.)";

constexpr const char *EXAMPLES =
    R"(Examples:
  visp-track-pattern
      a rendered sequence: what the method can do; open out/track-pattern/report.html
  visp-generate-pattern --noise 4 --dust 7 --out hard && visp-track-pattern hard --out tracked
      a dirty product with known truth
  visp-track-pattern --camera 0 --frames 500 --display
      what is under the microscope now
  visp-track-pattern recording --calibrate --pitch-um 220 80 --out scale
      how large a pixel is: the product, whose pitches are known, is the ruler
  visp-track-pattern recording --calibration scale/calibration.json --out moved
      the same recording in pixels and in micrometres

Written into the folder of --out: report.html (read this first), cells.csv, motion.csv, summary.json, and the overlay.
data/pattern/README.md describes the files. Ctrl-C ends the run with the report of what was seen until
then. Positions are in pixels; (0, 0) is the centre of the top left one.

Exit status: 0 done, 1 an image, a file or the camera does not allow it or shows no pattern, 2 the command line is wrong,
130 ended by Ctrl-C.)";

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

void addInput(vpApp::CommandLine &line, Options &options)
{
  line.add(
      "INPUT", " ", "Folder, image files, pattern, video file, or /dev/videoN (default: a rendered sequence)", "",
      [&options](const auto &values) { options.inputs = values; }, -1);
  line.group("Input");
  line.text("--camera", options.camera, "N", "Read from the camera /dev/videoN");
  line.whole("--frames", options.frames, {1, 1e7}, "N",
             "Maximum number of frames (default: all; 200 of a rendered sequence, 300 of a camera)");
  line.add("--roi", "X,Y,W,H", "Process only this region; positions still refer to the whole image", "",
           [&options](const auto &values) { options.roi = roiOf(values[0]); });
  line.whole("--seed", options.seed, {0, 4294967295.}, "N", "Seed of the rendered sequence");
}

void addOutput(vpApp::CommandLine &line, Options &options)
{
  line.group("Output");
  line.text("--out", options.out, "DIR", "Folder for the result");
  line.choice("--overlay", options.overlay,
              {{"none", OverlayKind::None}, {"png", OverlayKind::Png}, {"mp4", OverlayKind::Mp4}},
              "Images with the cells that were found");
  line.number("--video-rate", options.videoRate, {1., 240.}, "HZ", "Frames per second of the overlay video");
  line.flag("--display", options.display, "Show the overlay in a window; a click ends the run");
}

void addMethod(vpApp::CommandLine &line, vpPatternTrackerSpec &tracker)
{
  line.group("Method");
  line.choice("--method", tracker.method,
              {{"gauss-newton", vpPatternMethod::GaussNewton},
               {"half-maximum", vpPatternMethod::HalfMaximumEdges},
               {"thesis", vpPatternMethod::ThesisAlgorithm},
               {"thesis-fixed", vpPatternMethod::ThesisAlgorithmFixed}},
              "How a centre is measured; the others are baselines to compare with");
  line.choice("--threshold", tracker.threshold,
              {{"otsu", vpPatternThreshold::Otsu},
               {"isodata", vpPatternThreshold::Isodata},
               {"minimum-error", vpPatternThreshold::MinimumError}},
              "Threshold between bright and dark");
  line.choice("--derivative", tracker.derivative,
              {{"symmetric", vpPatternDerivative::Symmetric},
               {"roberts", vpPatternDerivative::Roberts},
               {"prewitt", vpPatternDerivative::Prewitt},
               {"sobel", vpPatternDerivative::Sobel}},
              "Derivative filter of the two thesis methods");
  line.whole("--threads", tracker.threads, {1, 64}, "N",
             "Threads that share the cells of an image of 128 cells and more; results are the same");
  line.choice("--polarity", tracker.polarity,
              {{"automatic", vpPatternPolarity::Automatic},
               {"bright", vpPatternPolarity::Bright},
               {"dark", vpPatternPolarity::Dark}},
              "What is a cell");
}

void addScale(vpApp::CommandLine &line, Options &options)
{
  line.group("Micrometres");
  line.text("--calibration", options.calibration, "FILE",
            "Results also in um, by this file: .json of --calibrate, or .xml of ViSP");
  line.text("--camera-name", options.cameraName, "NAME", "Name of the camera in that .xml file");
  line.flag("--calibrate", options.calibrate, "Write calibration.json and .xml; the product is the ruler");
  line.flag("--dot-grid", options.dotGrid, "For --calibrate: each image shows a grid of dots, at rest or not");
  line.add(
      "--pitch-um", "X Y", "For --calibrate: from column to column, and from row to row", "",
      [&pitch = options.pitch](const auto &values) {
        pitch.columns = 1e-6 * vpApp::numberIn("--pitch-um", values[0], {0., 1e9, true});
        pitch.rows = 1e-6 * vpApp::numberIn("--pitch-um", values[1], {0., 1e9, true});
      },
      2);
  line.add(
      "--axes-deg", "A",
      "For --calibrate: from the columns' direction to the rows' (default: as found: 60 when the grid is hexagonal "
      "and both pitches are the same, otherwise 90)",
      "", [&pitch = options.pitch](const auto &values) {
        pitch.angle = vpMath::rad(vpApp::numberIn("--axes-deg", values[0], {30., 150.}));
      });
  line.add("--pitch-sigma-um", "S", "For --calibrate: standard deviation of a cell's position on the product", "0",
           [&pitch = options.pitch](const auto &values) {
             pitch.sigmaPlane = 1e-6 * vpApp::numberIn("--pitch-sigma-um", values[0], {0., 1e9});
           });
}

void checkScale(const vpApp::CommandLine &line, const Options &options)
{
  for (const char *name : {"--dot-grid", "--pitch-um", "--axes-deg", "--pitch-sigma-um"}) {
    if (!options.calibrate && line.isGiven(name)) {
      throw vpApp::UsageError(std::string(name) + " is given without --calibrate, which it belongs to");
    }
  }
  if (options.calibrate && !options.calibration.empty()) {
    throw vpApp::UsageError("--calibrate makes a calibration and --calibration uses one: not both in one run");
  }
  if (options.calibrate && !line.isGiven("--pitch-um")) {
    throw vpApp::UsageError("--calibrate needs --pitch-um X Y, the distances of columns and of rows");
  }
}

//! A camera may be given as --camera N, --camera /dev/videoN or as the input itself.
void findCamera(Options &options)
{
  std::string given = options.camera;
  if (!given.empty() && !options.inputs.empty()) {
    throw vpApp::UsageError("--camera and the input " + options.inputs[0] + " are both given");
  }
  if (options.inputs.size() == 1 && options.inputs[0].rfind("/dev/video", 0) == 0) {
    given = options.inputs[0];
    options.inputs.clear();
  }
  options.camera = vpApp::cameraDevice(given);
  if (options.camera.empty() && !given.empty()) {
    throw vpApp::UsageError("--camera is " + given + ", must be a number or /dev/videoN");
  }
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-track-pattern", ABOUT, EXAMPLES);
  addInput(line, options);
  addOutput(line, options);
  addMethod(line, options.tracker);
  addScale(line, options);
  if (!line.parse(argc, argv)) {
    return false;
  }
  checkScale(line, options);
  findCamera(options);
  return true;
}
} // namespace trackPattern
