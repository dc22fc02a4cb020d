/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Checks against external data, with the error printed: OpenCV's graf1 and graf3, photographs with a measured
// homography, and the AprilTag scene of visp-images-data, rendered with known poses.
#include "vpCatch.h"
#include "vpPlanarScene.h"

#include <visp3/core/vpIoTools.h>
#include <visp3/planar_target/vpPlaneMatcher.h>

#include <fstream>
#include <iostream>
#include <sstream>

namespace
{
std::string opencvFile(const std::string &name)
{
  const std::string folder = VISP_DIRECT_OPENCV_SAMPLES;
  return folder + "/" + name;
}

double number(std::istream &stream)
{
  double value = NAN;
  stream >> value;
  return value;
}

// The nine numbers of OpenCV's H1to3p.xml, row by row.
std::array<double, 9> readHomography(const std::string &file)
{
  std::ifstream stream(file);
  std::stringstream text;
  text << stream.rdbuf();
  std::stringstream data(text.str().substr(text.str().find("<data>") + 6));
  std::array<double, 9> H{};
  for (double &h : H) {
    h = number(data);
  }
  return H;
}

std::pair<double, double> apply(const std::array<double, 9> &H, double u, double v)
{
  const double w = H[6] * u + H[7] * v + H[8];
  return {(H[0] * u + H[1] * v + H[2]) / w, (H[3] * u + H[4] * v + H[5]) / w};
}
} // namespace

TEST_CASE("graf1 to graf3: homography of real photographs against the measured one", "[planar_target][outside]")
{
  if (!vpIoTools::checkFilename(opencvFile("graf1.png"))) {
    vpTestSupport::skip("OpenCV's sample images (Debian package opencv-doc) are not installed");
    return;
  }
  vpPlanarScene::Image first, third;
  vpImageIo::read(first, opencvFile("graf1.png"));
  vpImageIo::read(third, opencvFile("graf3.png"));
  const std::array<double, 9> truth = readHomography(opencvFile("H1to3p.xml"));
  for (vpKeypointType type : {vpKeypointType::ORB, vpKeypointType::SIFT, vpKeypointType::AKAZE, vpKeypointType::KAZE,
                              vpKeypointType::BRISK, vpKeypointType::SURF}) {
    vpPlanarTargetSpec spec;
    spec.keypoints = type;
    spec.maxKeypoints = 3000;
    vpPlaneMatcher matcher(first, spec);
    const vpPlaneMatch &match = matcher.match(third);
    CAPTURE(vpToString(type), match.message);
    if (!match.found()) { // 40 deg of view change: too much for SURF of dlib; no homography is better than a wrong one
      std::cout << "graf1/graf3 " << vpToString(type) << ": " << vpToString(match.status) << ", " << match.message
                << std::endl;
      CHECK((type == vpKeypointType::SURF || type == vpKeypointType::BRISK || type == vpKeypointType::KAZE));
      continue;
    }
    double sum = 0.;
    int count = 0;
    for (double u = 100.; u < 700.; u += 20.) {
      for (double v = 100.; v < 540.; v += 20.) {
        const auto a = apply(match.homography, u, v), b = apply(truth, u, v);
        sum += std::hypot(a.first - b.first, a.second - b.second);
        ++count;
      }
    }
    std::cout << "graf1/graf3 " << vpToString(type) << ": mean distance from the measured homography " << sum / count
              << " px, " << match.inliers.size() << " inliers" << std::endl;
    CHECK(sum / count < 5.);
  }
}

TEST_CASE("AprilTag scene: pose of each tag against the renderer's", "[planar_target][outside]")
{
  const std::string folder = vpIoTools::getViSPImagesDataPath() + "/AprilTag/benchmark/640x480";
  if (!vpIoTools::checkFilename(folder + "/tag36_11_640x480.png")) {
    vpTestSupport::skip("visp-images-data is not installed and VISP_INPUT_IMAGE_PATH does not name it");
    return;
  }
  vpPlanarScene::Image I;
  vpImageIo::read(I, folder + "/tag36_11_640x480.png");
  const vpCameraParameters camera(700., 700., 320., 240.);
  const double size[5] = {0.2, 0.2, 0.2, 0.1, 0.1}; // black square, m
  const unsigned int cells = 10, cellSize = 24;     // 8 of the tag and its white rim; px of the reference
  int found = 0;
  for (int tag = 0; tag < 5; ++tag) {
    std::ifstream file(folder + "/cMo_" + std::to_string(tag) + ".txt");
    vpHomogeneousMatrix truth;
    for (unsigned int i = 0; i < 16; ++i) {
      truth[i / 4][i % 4] = number(file);
    }
    truth = truth * vpHomogeneousMatrix(0., 0., 0., M_PI, 0., 0.); // their y is up and z towards the camera

    // The reference is redrawn, with ideal edges; only which cell is black is taken from the image.
    const double width = size[tag] * cells / 8.;
    double grey[10][10], low = 255., high = 0.;
    for (unsigned int r = 0; r < cells; ++r) {
      for (unsigned int c = 0; c < cells; ++c) {
        const double x = ((c + 0.5) / cells - 0.5) * width, y = ((r + 0.5) / cells - 0.5) * width;
        const double Z = truth[2][0] * x + truth[2][1] * y + truth[2][3];
        const double u = 320. + 700. * (truth[0][0] * x + truth[0][1] * y + truth[0][3]) / Z;
        const double v = 240. + 700. * (truth[1][0] * x + truth[1][1] * y + truth[1][3]) / Z;
        grey[r][c] = I.getValue(v, u);
        low = std::min(low, grey[r][c]);
        high = std::max(high, grey[r][c]);
      }
    }
    vpPlanarScene::Image reference(cells * cellSize, cells * cellSize);
    for (unsigned int i = 0; i < reference.getHeight(); ++i) {
      for (unsigned int j = 0; j < reference.getWidth(); ++j) {
        reference[i][j] = grey[i / cellSize][j / cellSize] > 0.5 * (low + high) ? 255 : 0;
      }
    }
    vpPlanarTargetSpec spec;
    spec.refinementSize = 60;
    vpPlanarTarget target(reference, width, width, camera, spec);
    // From an initial value as a tracker has it: some pixels and degrees away.
    const double Z = truth[2][3];
    const vpHomogeneousMatrix shift(0.003 * Z, -0.003 * Z, 0.01 * Z, 0., 0., 0.), turn(0., 0., 0., 0.03, -0.03, 0.04);
    const vpPlanarTargetResult &result = target.track(I, shift * truth * turn);
    CAPTURE(tag, result.message);
    if (!result.found()) {
      std::cout << "AprilTag scene, tag " << tag << " at " << Z << " m: " << vpToString(result.status) << ", "
                << result.message << std::endl;
      continue;
    }
    ++found;
    const double position = vpPlanarScene::positionError(truth, result.cMo) / Z;
    const double angle = std::sqrt(vpPlanarScene::rotationError(truth, result.cMo).sumSquare());
    std::cout << "AprilTag scene, tag " << tag << " at " << Z << " m: position off by " << 100. * position
              << " % of the distance, "
              << "rotation by " << angle << " deg, correlation " << result.correlation << std::endl;
    // The tags are 30 to 80 px wide, and the scene's own corners and poses disagree by 0.14 to 0.36 px.
    CHECK(position < 0.02);
    CHECK(angle < 2.);
  }
  CHECK(found >= 4); // one is 30 px wide: a status is correct there, a wrong pose is not
}
