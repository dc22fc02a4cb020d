/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Real photographs of dots: a printed grid seen at an angle, and a box in a hand. From ViSP's images.
#include "vpCatch.h"

#include <visp3/core/vpImageTools.h>
#include <visp3/core/vpIoTools.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/vision/vpHomography.h>

#include <cmath>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
std::string imagesFolder()
{
  const std::string folder = vpIoTools::getViSPImagesDataPath();
  if (folder.empty() || !vpIoTools::checkDirectory(folder + "/mire-2")) {
    vpTestSupport::skip("visp-images-data is not installed and VISP_INPUT_IMAGE_PATH does not name it");
    return "";
  }
  return folder;
}

struct Residual {
  int cells = 0;
  double rms = 0.; // px
};

// A printed grid is plane and regular: a homography maps rows and columns to the image, up to distortion and errors.
Residual gridResidual(const vpPatternFrame &frame)
{
  std::vector<double> column, row, x, y;
  for (const vpPatternCell &cell : frame.cells) {
    if (cell.valid) {
      column.push_back(0.1 * cell.column); // of the size of normalised coordinates
      row.push_back(0.1 * cell.row);
      x.push_back((cell.x - 320.) / 600.);
      y.push_back((cell.y - 240.) / 600.);
    }
  }
  vpHomography h;
  vpHomography::DLT(column, row, x, y, h, true);
  double sum = 0.;
  for (std::size_t i = 0; i < column.size(); ++i) {
    const double w = h[2][0] * column[i] + h[2][1] * row[i] + h[2][2];
    const double u = (h[0][0] * column[i] + h[0][1] * row[i] + h[0][2]) / w;
    const double v = (h[1][0] * column[i] + h[1][1] * row[i] + h[1][2]) / w;
    sum += std::pow(600. * (u - x[i]), 2) + std::pow(600. * (v - y[i]), 2);
  }
  return {static_cast<int>(column.size()), std::sqrt(sum / static_cast<double>(2 * column.size()))};
}
} // namespace

TEST_CASE("printed grids seen at an angle are found whole and followed", "[pattern][photo]")
{
  const std::string folder = imagesFolder();
  if (folder.empty()) {
    return;
  }
  const int number = GENERATE(1, 2, 3, 4);
  const auto method = GENERATE(vpPatternMethod::GaussNewton, vpPatternMethod::HalfMaximumEdges);
  CAPTURE(number, toString(method));
  vpImage<unsigned char> photo, image;
  vpImageIo::read(photo, folder + "/calibration/grid36-0" + std::to_string(number) + ".pgm");
  vpPatternOptions options;
  options.method = method;
  vpPatternTracker tracker(photo.getWidth() - 24, photo.getHeight() - 24, options);
  int tracked = 0;
  for (int k = 0; k < 150; ++k) {
    // The camera goes round: another part of the photograph each time, by whole pixels, so that the motion is known.
    const int left = 12 + static_cast<int>(std::lround(11. * std::cos(0.1 * k)));
    const int top = 12 + static_cast<int>(std::lround(11. * std::sin(0.1 * k)));
    const int lastLeft = 12 + static_cast<int>(std::lround(11. * std::cos(0.1 * (k - 1))));
    vpImageTools::crop(photo, top, left, photo.getHeight() - 24, photo.getWidth() - 24, image);
    const vpPatternFrame &frame = tracker.track(image);
    CAPTURE(k, frame.message());
    CHECK(frame.status != vpPatternStatus::Lost);
    CHECK(frame.epoch == 0);
    if (frame.status == vpPatternStatus::Tracking) {
      ++tracked;
      CHECK(frame.validCells >= 20);
      CHECK(frame.hasMotion == (k > 0));
      // 0.2 px: the dots differ from the one template, and the first image after learning from the edges before it.
      CHECK((k == 0 || std::abs(frame.dx - (lastLeft - left)) < 0.2));
    }
  }
  CHECK(tracked >= 90);
  // Edges give the centre of each dot in its own shape; one template for dots of different sizes is worse.
  const Residual residual = gridResidual(tracker.frame());
  std::cout << "grid36-0" << number << ", " << toString(method) << ": " << residual.cells
            << " dots, residual of the homography " << residual.rms << " px rms\n";
  CHECK(residual.rms < (method == vpPatternMethod::GaussNewton ? 0.8 : 0.4));
}

TEST_CASE("four dots on a box in a hand are followed while it hardly turns", "[pattern][photo]")
{
  const std::string folder = imagesFolder();
  if (folder.empty()) {
    return;
  }
  // Lattice and template are a plane product's; the box turns away after image 150, and then it is rightly lost. The
  // window leaves out most of the room behind the box.
  vpImage<unsigned char> photo, image;
  vpPatternTracker tracker(235, 178);
  int lost = 0, cells = 0, images = 0;
  for (int k = 20; k <= 150; ++k, ++images) {
    const std::string digits = std::to_string(k);
    vpImageIo::read(photo, folder + "/mire-2/image." + std::string(4 - digits.size(), '0') + digits + ".pgm");
    vpImageTools::crop(photo, 110, 55, 178, 235, image);
    const vpPatternFrame &frame = tracker.track(image);
    lost += frame.status == vpPatternStatus::Lost ? 1 : 0;
    cells += frame.validCells;
    CHECK(frame.cells.size() <= 6);
  }
  std::cout << "mire-2: " << images << " images, " << lost << " lost, " << cells / static_cast<double>(images)
            << " dots on average\n";
  CHECK(lost == 0);
  CHECK(cells > 2 * images);
}
