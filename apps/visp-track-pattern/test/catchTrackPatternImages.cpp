/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Real images: the dot grids and the film of marks of visp-images-data.
#include "vpCaseFile.h"
#include "vpCatch.h"

#include "fileSource.h"

#include "greyPicture.h"

#include <visp3/core/vpIoTools.h>
#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/pattern/vpTsaiCalibration.h>

#include <Eigen/Dense>

#include <cmath>
#include <filesystem>
#include <string>

namespace
{
using vpApp::imagesOfFolder;

// Empty, and the test skipped, if the images are missing.
std::string imageFolder(const std::string &name)
{
  const std::string folder = vpIoTools::getViSPImagesDataPath() + "/" + name;
  if (!std::filesystem::is_directory(folder)) {
    vpTestSupport::skip("visp-images-data is not installed and VISP_INPUT_IMAGE_PATH does not name it");
    return "";
  }
  return folder;
}

vpImage<unsigned char> greyImage(const std::string &file)
{
  vpPictures::GreyScale scale;
  vpImage<unsigned char> image;
  vpApp::copyGrey(vpApp::readGreyPicture(file, scale), image);
  return image;
}

std::string gridFile(int number)
{
  return vpTestSupport::vispImage("calibration/grid36-0" + std::to_string(number) + ".pgm");
}

// Root mean square distance of the points from the homography of their lattice, px (least squares on normalised data).
double homographyResidual(const std::vector<vpCalibrationPoint> &points)
{
  const auto n = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd rows(2 * n, 9);
  for (Eigen::Index i = 0; i < n; ++i) {
    const vpCalibrationPoint &p = points[static_cast<std::size_t>(i)];
    const double u = (p.u - 320.) / 200., v = (p.v - 240.) / 200.;
    rows.row(2 * i) << p.x, p.y, 1., 0., 0., 0., -u * p.x, -u * p.y, -u;
    rows.row(2 * i + 1) << 0., 0., 0., p.x, p.y, 1., -v * p.x, -v * p.y, -v;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
  const Eigen::VectorXd h = svd.matrixV().col(8);
  double sum = 0.;
  for (const vpCalibrationPoint &p : points) {
    const double w = h[6] * p.x + h[7] * p.y + h[8];
    const double u = 320. + 200. * (h[0] * p.x + h[1] * p.y + h[2]) / w;
    const double v = 240. + 200. * (h[3] * p.x + h[4] * p.y + h[5]) / w;
    sum += std::pow(u - p.u, 2) + std::pow(v - p.v, 2);
  }
  return std::sqrt(sum / static_cast<double>(n));
}
} // namespace

TEST_CASE("all dots of the real grids are found, in straight and in strongly tilted views", "[images]")
{
  const std::string folder = imageFolder("calibration");
  if (folder.empty()) {
    return;
  }
  vpTsaiCalibration tsai(640, 480);
  for (int number = 1; number <= 4; ++number) {
    vpImage<unsigned char> image;
    image = greyImage(gridFile(number));
    const std::vector<vpCalibrationPoint> points = vpCalibrationPoints(image, {0.03, 0.03, 0.});
    CAPTURE(number);
    REQUIRE(points.size() == 36);
    double least[2] = {1e9, 1e9}, most[2] = {-1e9, -1e9};
    for (const vpCalibrationPoint &p : points) {
      least[0] = std::min(least[0], p.x);
      most[0] = std::max(most[0], p.x);
      least[1] = std::min(least[1], p.y);
      most[1] = std::max(most[1], p.y);
    }
    CHECK(most[0] - least[0] == Approx(0.15)); // six by six
    CHECK(most[1] - least[1] == Approx(0.15));
    const double residual = homographyResidual(points);
    WARN("grid36-0" << number << ": " << points.size() << " dots, residual of the homography " << residual
                    << " px (rms)");
    CHECK(residual < 1.5); // includes lens distortion
    tsai.addView(points);
  }
  const vpTsaiCalibrationResult result = tsai.compute();
  WARN("Tsai's calibration from these four: " << result.message);
  CHECK(result.residualRms < 1.);
  // 0.1 px is assumed per dot, but with strong perspective the middle of a dot's edges is not its centre: detected.
  CHECK_FALSE(result.reliable);
  CHECK(result.message.find("The model does not fit the points: the residuals are 2") != std::string::npos);
}

TEST_CASE("a real grid that is moved is tracked", "[images]")
{
  const std::string folder = imageFolder("calibration");
  if (folder.empty()) {
    return;
  }
  for (int number = 1; number <= 4; ++number) {
    vpImage<unsigned char> whole;
    whole = greyImage(gridFile(number));
    // A window moving over the image by whole pixels shows the grid in motion, with real light and real dots.
    const unsigned int width = 580, height = 440;
    vpPatternTracker tracker(width, height);
    vpImage<unsigned char> image(height, width);
    double squares = 0.;
    int motions = 0, valid = 0, tracking = 0, lost = 0;
    int formerU = 0, formerV = 0, at = 0;
    double largest = 0., told = 0.;
    for (int k = 0; k < 160; ++k) {
      const int u = 30 + static_cast<int>(std::lround(25. * std::sin(0.11 * k)));
      const int v = 20 + static_cast<int>(std::lround(15. * std::cos(0.07 * k)));
      for (unsigned int row = 0; row < height; ++row) {
        std::copy_n(whole[row + static_cast<unsigned int>(v)] + u, width, image[row]);
      }
      const vpPatternFrame &frame = tracker.process(image);
      tracking += frame.status == vpPatternStatus::Tracking ? 1 : 0;
      lost += frame.status == vpPatternStatus::Lost ? 1 : 0;
      valid += frame.validCells;
      if (frame.hasMotion) {
        const double error = std::hypot(frame.dx - (formerU - u), frame.dy - (formerV - v));
        squares += error * error;
        if (error > largest) {
          largest = error;
          told = std::hypot(frame.sigmaDx, frame.sigmaDy);
          at = k;
        }
        ++motions;
      }
      formerU = u;
      formerV = v;
    }
    REQUIRE(motions > 0);
    const double rms = std::sqrt(squares / motions);
    WARN("grid36-0" << number << " moved: " << tracking << " of 160 images tracked, " << lost << " lost, "
                    << valid / 160. << " dots on average, displacement off by " << rms << " px (rms), at most "
                    << largest << " px in image " << at << ", where it says " << told
                    << " px; at the end: " << tracker.frame().message());
    CHECK(motions > 140);
    CHECK(rms < 0.2);
    CHECK(valid > 160 * 18);
  }
}

TEST_CASE("a real film without a lattice is not tracked", "[images]")
{
  const std::string folder = imageFolder("mire-2");
  if (folder.empty()) {
    return;
  }
  std::vector<std::filesystem::path> hidden;
  const std::vector<std::filesystem::path> files = imagesOfFolder(folder, hidden);
  REQUIRE(files.size() > 100);
  std::unique_ptr<vpPatternTracker> tracker;
  vpImage<unsigned char> image;
  int tracking = 0, withCells = 0;
  for (const std::filesystem::path &file : files) {
    image = greyImage(file.string());
    if (!tracker) {
      tracker = std::make_unique<vpPatternTracker>(image.getWidth(), image.getHeight());
    }
    const vpPatternFrame &frame = tracker->process(image);
    tracking += frame.status == vpPatternStatus::Tracking ? 1 : 0;
    withCells += frame.validCells > 0 ? 1 : 0;
  }
  WARN("mire-2, five marks on a box in front of clutter: "
       << files.size() << " images, cells in " << withCells
       << " (the four small marks are a lattice of two by two), tracking in " << tracking);
  CHECK(tracking <= withCells);
  CHECK(withCells < static_cast<int>(files.size()) / 2);
}
