/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "keypointItems.h"

#include "dataFile.h"

#include <visp3/io/vpImageIo.h>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace thesisReport
{
namespace
{
constexpr unsigned int WIDTH = 640, HEIGHT = 480;  // px
constexpr double FOCAL_LENGTH = 800.;              // px
constexpr double TARGET_WIDTH = 0.2;               // m
constexpr double CLUTTER_WIDTH = 0.9, BEHIND = 1.; // m: fills the view

vpImage<unsigned char> photo(const std::string &name)
{
  vpImage<unsigned char> image;
  vpImageIo::read(image, vpApp::dataFile("target/" + name));
  return image;
}

double heightOf(const vpImage<unsigned char> &image, double width)
{
  return width * image.getHeight() / image.getWidth();
}

vpPlaneRenderer clutter()
{
  const vpImage<unsigned char> image = photo("starry-night.jpg");
  return {image, CLUTTER_WIDTH, heightOf(image, CLUTTER_WIDTH), keypointCamera(), WIDTH, HEIGHT};
}
} // namespace

vpCameraParameters keypointCamera() { return {FOCAL_LENGTH, FOCAL_LENGTH, 0.5 * (WIDTH - 1.), 0.5 * (HEIGHT - 1.)}; }

vpHomogeneousMatrix poseOf(double x, double y, double z, double roll, double pitch, double yaw)
{
  const vpHomogeneousMatrix Rx(0., 0., 0., pitch, 0., 0.), Ry(0., 0., 0., 0., yaw, 0.), Rz(0., 0., 0., 0., 0., roll);
  return vpHomogeneousMatrix(x, y, z, 0., 0., 0.) * Ry * Rx * Rz;
}

vpPlaneMatcher matcherWith(const vpImage<unsigned char> &reference, vpKeypointType type, unsigned int keypoints)
{
  vpPlanarTargetSpec spec;
  spec.keypoints = type;
  spec.maxKeypoints = keypoints;
  vpPlaneMatcher matcher(reference, spec);
  for (int i = 0; i < 4; ++i) {
    const auto found = static_cast<double>(matcher.result().referenceKeypoints);
    if (found >= keypoints) {
      break;
    }
    const auto more = static_cast<unsigned int>(std::lround(spec.maxKeypoints + std::max(1., keypoints - found)));
    spec.maxKeypoints = more;
    vpPlaneMatcher next(reference, spec);
    if (next.result().referenceKeypoints == matcher.result().referenceKeypoints) {
      break; // no more keypoints
    }
    matcher = std::move(next);
  }
  return matcher;
}

KeypointScene::KeypointScene()
  : m_photo(photo("klimt.jpg")), m_width(TARGET_WIDTH), m_height(heightOf(m_photo, TARGET_WIDTH)),
    m_target(m_photo, m_width, m_height, keypointCamera(), WIDTH, HEIGHT), m_background(clutter())
{}

void KeypointScene::renderAlone(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
                                vpImage<unsigned char> &image)
{
  m_target.render(cMo, faults, 2 * seed + 1, image);
}

void KeypointScene::render(const vpHomogeneousMatrix &cMo, const vpCameraFaults &faults, unsigned int seed,
                           vpImage<unsigned char> &image)
{
  vpCameraFaults behind = faults;
  behind.occlusion = 0.;
  vpImage<unsigned char> target;
  m_background.render(vpHomogeneousMatrix(0., 0., BEHIND, 0., 0., 0.), behind, 2 * seed, image);
  renderAlone(cMo, faults, seed, target);
  std::vector<cv::Point> corners;
  for (const auto &corner : {std::make_pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}}) {
    const double X = 0.5 * m_width * corner.first, Y = 0.5 * m_height * corner.second;
    const double z = cMo[2][0] * X + cMo[2][1] * Y + cMo[2][3];
    const double x = (cMo[0][0] * X + cMo[0][1] * Y + cMo[0][3]) / z,
                 y = (cMo[1][0] * X + cMo[1][1] * Y + cMo[1][3]) / z;
    corners.emplace_back(static_cast<int>(std::lround(FOCAL_LENGTH * x + 0.5 * (WIDTH - 1.))),
                         static_cast<int>(std::lround(FOCAL_LENGTH * y + 0.5 * (HEIGHT - 1.))));
  }
  const auto view = [](vpImage<unsigned char> &of) { return cv::Mat(HEIGHT, WIDTH, CV_8UC1, of.bitmap); };
  cv::Mat mask(HEIGHT, WIDTH, CV_8UC1, cv::Scalar(0));
  cv::fillConvexPoly(mask, corners, cv::Scalar(255));
  view(target).copyTo(view(image), mask);
}
} // namespace thesisReport
