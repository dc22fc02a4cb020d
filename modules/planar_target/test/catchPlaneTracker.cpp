/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Corners of a tilted reference view found again: against the true homography, beside keypoints, and when they are not
// there.
#include "vpCatch.h"
#include "vpPlanarScene.h"

#include <visp3/core/vpException.h>
#include <visp3/planar_target/vpPlaneTracker.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <iostream>

VISP_DIRECT_USING_NAMESPACE

using vpPlanarScene::Image;
using vpTestSupport::uniform;

namespace
{
Eigen::Matrix3d planeToPixels(const vpHomogeneousMatrix &cMo)
{
  const vpCameraParameters camera = vpPlanarScene::camera();
  Eigen::Matrix3d K, P;
  K << camera.get_px(), 0., camera.get_u0(), 0., camera.get_py(), camera.get_v0(), 0., 0., 1.;
  for (unsigned int i = 0; i < 3; ++i) {
    P.row(i) << cMo[i][0], cMo[i][1], cMo[i][3];
  }
  return K * P;
}

Image view(const vpHomogeneousMatrix &cMo, double gain, std::mt19937_64 &rng)
{
  static const vpPlanarScene::Target target = vpPlanarScene::klimt();
  Image image = vpPlanarScene::background(rng);
  vpPlanarScene::draw(image, target, vpPlanarScene::camera(), cMo);
  vpPlanarScene::spoil(image, 0.7, gain, 3., rng);
  return image;
}

vpHomogeneousMatrix somewhere(std::mt19937_64 &rng, double near, double far, double turn)
{
  const double Z = uniform(rng, near, far), x = uniform(rng, -0.05, 0.05), y = uniform(rng, -0.04, 0.04);
  const double roll = uniform(rng, -turn, turn), pitch = uniform(rng, -0.4, 0.4);
  return vpPlanarScene::pose(x, y, Z, roll, pitch, uniform(rng, -0.4, 0.4));
}

struct Errors {
  double squares = 0.;
  int count = 0;
  void add(const Eigen::Vector2d &e)
  {
    squares += e.squaredNorm();
    ++count;
  }
  [[nodiscard]] double rms() const { return std::sqrt(squares / (2. * count)); }
};

Eigen::Vector2d through(const Eigen::Matrix3d &H, const vpImagePoint &p)
{
  return Eigen::Vector3d(H * Eigen::Vector3d(p.get_u(), p.get_v(), 1.)).hnormalized();
}
} // namespace

TEST_CASE("corners are found to a fraction of a pixel, better than keypoints", "[planar_target][plane-tracker]")
{
  CAPTURE(vpTestSupport::seed());
  Errors corners, keypoints;
  double told = 0.;
  const int count = vpTestSupport::longer(12);
  for (int i = 0; i < count; ++i) {
    CAPTURE(i);
    auto rng = vpTestSupport::generator(static_cast<unsigned int>(i));
    const vpHomogeneousMatrix rMo = somewhere(rng, 0.35, 0.45, 0.3), cMo = somewhere(rng, 0.25, 0.8, 1.);
    const Image reference = view(rMo, 1., rng), frame = view(cMo, uniform(rng, 0.6, 1.1), rng);
    const Eigen::Matrix3d H = planeToPixels(cMo) * planeToPixels(rMo).inverse();
    vpPlaneTracker tracker(reference);
    const vpPlaneTrack &track = tracker.acquire(frame);
    INFO(track.message);
    REQUIRE(track.found);
    told += track.sigma * track.sigma / count;
    vpPlaneMatcher matcher(reference);
    const vpPlaneMatch &match = matcher.match(frame);
    const Eigen::Matrix3d M = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(match.homography.data());
    for (std::size_t k = 0; k < track.points.size(); ++k) {
      if (track.visible[k]) {
        const Eigen::Vector2d truth = through(H, tracker.reference()[k]);
        corners.add(Eigen::Vector2d(track.points[k].get_u(), track.points[k].get_v()) - truth);
        keypoints.add(through(M, tracker.reference()[k]) - truth);
      }
    }
    // And from a guess that is off by a few pixels.
    const vpPlaneTrack before = track;
    std::array<double, 9> guess = before.homography;
    guess[2] += uniform(rng, -8., 8.);
    guess[5] += uniform(rng, -8., 8.);
    const vpPlaneTrack &again = tracker.track(frame, guess);
    REQUIRE(again.found);
    CHECK(again.count > 0.8 * before.count);
  }
  std::cout << "error of a corner " << corners.rms() << " px, told " << std::sqrt(told)
            << "; of the keypoints' homography " << keypoints.rms() << " px" << std::endl;
  CHECK(corners.rms() < 0.3);
  CHECK(corners.rms() < 0.7 * keypoints.rms());
  CHECK(std::sqrt(told) > 0.5 * corners.rms());
}

TEST_CASE("a plane that is not there is not found", "[planar_target][plane-tracker]")
{
  auto rng = vpTestSupport::generator(1);
  vpPlaneTracker tracker(view(somewhere(rng, 0.35, 0.45, 0.3), 1., rng));
  const Image wall = vpPlanarScene::background(rng);
  CHECK_FALSE(tracker.acquire(wall).found);
  CHECK_FALSE(tracker.track(wall, {1., 0., 0., 0., 1., 0., 0., 0., 1.}).found);
  CHECK(tracker.result().message == "The plane is not near the expected place.");
  CHECK(tracker.result().count == 0);
  for (const double bad : {std::nan(""), 0., 1e300}) {
    CHECK_FALSE(tracker.track(wall, {bad, bad, bad, bad, bad, bad, bad, bad, bad}).found);
  }
  CHECK_FALSE(tracker.acquire(Image(16, 16)).found);
  CHECK_FALSE(tracker.track(Image(16, 16), {1., 0., 0., 0., 1., 0., 0., 0., 1.}).found);
  CHECK_THROWS_WITH(vpPlaneTracker(wall, 5), Catch::Contains("the plane tracker has 5 points, must have 20..2000"));
  CHECK_THROWS_WITH(vpPlaneTracker(Image(480, 640, 100)), Catch::Contains("too little texture"));
}
