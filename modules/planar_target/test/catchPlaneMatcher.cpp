/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The covariance of a homography: against repeated fits, on photographs with known points, and when it extrapolates.
#include "vpCaseFile.h"
#include "vpCatch.h"
#include "vpPosters.h"

#include <visp3/planar_target/vpPlaneMatcher.h>

#include <opencv2/calib3d.hpp>

#include <fstream>
#include <sstream>

namespace
{
using Image = vpPlanarScene::Image;

cv::Point2d through(const std::array<double, 9> &H, double u, double v)
{
  const double w = H[6] * u + H[7] * v + H[8];
  return {(H[0] * u + H[1] * v + H[2]) / w, (H[3] * u + H[4] * v + H[5]) / w};
}

//! A poster in a frame of which only a part is shown; the rest is wall.
Image viewOf(const vpPlanarScene::Target &target, double shown, std::mt19937_64 &rng)
{
  Image view = vpPosters::wall(rng), whole = view;
  std::uniform_real_distribution<double> u(-0.2, 0.2);
  vpPlanarScene::draw(whole, target, vpPlanarScene::camera(), vpPlanarScene::pose(0., 0., 0.3, u(rng), u(rng), u(rng)));
  const unsigned int side = static_cast<unsigned int>(shown * 400.);
  for (unsigned int i = 0; i < 480; ++i) {
    for (unsigned int j = 0; j < 640; ++j) {
      if (i >= 40 && i < 40 + side && j >= 120 && j < 120 + side) {
        view[i][j] = whole[i][j];
      }
    }
  }
  vpPlanarScene::spoil(view, 0.7, 0.95, 3., rng);
  return view;
}
} // namespace

TEST_CASE("the spread is that of fits to data with other noise", "[planar_target][plane-matcher]")
{
  // Oracle: the inliers at the positions given by the homography, with noise of the estimated size, fitted repeatedly
  // by OpenCV. Their spread is known to 1/sqrt(2 * 400) = 3.5 % per axis; 20 % is five times that and allows for the
  // second order.
  CAPTURE(vpTestSupport::seed());
  constexpr int repeats = 400;
  for (unsigned int trial = 0; trial < 4; ++trial) {
    auto rng = vpTestSupport::generator(trial);
    const vpPlanarScene::Target target = vpPosters::poster(rng);
    vpPlaneMatcher matcher(target.image);
    const vpPlaneMatch &match = matcher.match(viewOf(target, 1., rng));
    CAPTURE(trial, match.message);
    REQUIRE(match.hasHomography());
    std::normal_distribution<double> noise(0., match.sigma);
    std::vector<cv::Point2d> from, exact, to;
    for (const auto &pair : match.inliers) {
      from.emplace_back(pair.first.get_u(), pair.first.get_v());
      exact.push_back(through(match.homography, from.back().x, from.back().y));
    }
    const double places[3][2] = {{0., 0.}, {150., 150.}, {299., 299.}};
    double squares[3] = {0., 0., 0.};
    for (int k = 0; k < repeats; ++k) {
      to.clear();
      for (const cv::Point2d &p : exact) {
        to.emplace_back(p.x + noise(rng), p.y + noise(rng));
      }
      const cv::Mat H = cv::findHomography(from, to, 0);
      std::array<double, 9> h{};
      std::copy_n(H.ptr<double>(), 9, h.begin());
      for (int i = 0; i < 3; ++i) {
        const cv::Point2d e =
            through(h, places[i][0], places[i][1]) - through(match.homography, places[i][0], places[i][1]);
        squares[i] += e.dot(e) / repeats;
      }
    }
    for (int i = 0; i < 3; ++i) {
      CHECK(match.deviation(vpImagePoint(places[i][1], places[i][0])) == Approx(std::sqrt(squares[i])).epsilon(0.2));
    }
  }
}

TEST_CASE("inliers in a corner do not speak for the whole image", "[planar_target][plane-matcher]")
{
  CAPTURE(vpTestSupport::seed());
  int whole = 0, part = 0, certain = 0, corners = 0;
  for (unsigned int trial = 0; trial < 12; ++trial) {
    auto rng = vpTestSupport::generator(100 + trial);
    const vpPlanarScene::Target target = vpPosters::poster(rng);
    vpPlaneMatcher matcher(target.image);
    whole += matcher.match(viewOf(target, 1., rng)).found() ? 1 : 0;
    const vpPlaneMatch &match = matcher.match(viewOf(target, 0.25, rng));
    CAPTURE(trial, match.message);
    if (match.inliers.size() < 12) {
      continue;
    }
    ++part;
    certain += match.found() ? 1 : 0;
    corners += match.cornerDeviation > match.deviation(match.inliers[0].first) ? 1 : 0;
    if (!match.found()) {
      CHECK(match.status == vpPlanarTargetStatus::Extrapolated);
      CHECK(match.message.find("px; a corner of the image is uncertain by ") != std::string::npos);
    }
  }
  CHECK(whole == 12);
  CHECK(corners == part);
  CHECK(2 * certain <= part);
}

TEST_CASE("whiteboard: matches in a corner of a real photograph are said to extrapolate",
          "[planar_target][plane-matcher]")
{
  const std::string a = vpTestSupport::caseFile("images/WhiteBoardA.jpg");
  const std::string b = vpTestSupport::caseFile("images/WhiteBoardB.jpg");
  const std::string known = vpTestSupport::caseFile("images/WhiteBoard_pts.txt");
  if (a.empty() || b.empty() || known.empty()) {
    return;
  }
  Image first, second;
  vpImageIo::read(first, a);
  vpImageIo::read(second, b);
  for (const vpKeypointType type : {vpKeypointType::ORB, vpKeypointType::AKAZE, vpKeypointType::SIFT}) {
    vpPlanarTargetSpec spec;
    spec.keypoints = type;
    vpPlaneMatcher matcher(first, spec);
    const vpPlaneMatch &match = matcher.match(second);
    std::ifstream file(known);
    double error = 0.;
    int count = 0;
    for (std::string line; std::getline(file, line);) {
      std::replace_if(
          line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
      std::istringstream numbers(line);
      double u, v, one, x, y, onPlane;
      if (numbers >> u >> v >> one >> x >> y >> one >> onPlane && onPlane > 0.5) {
        const cv::Point2d p = through(match.homography, u, v);
        error += std::hypot(p.x - x, p.y - y);
        ++count;
      }
    }
    REQUIRE(count == 8);
    CAPTURE(vpToString(type), match.message, error / count);
    WARN(vpToString(type) << ": " << vpToString(match.status) << ", " << match.message << " Largest deviation "
                          << match.cornerDeviation << " px, mean error at the known points " << error / count << " px");
    // A homography reported as valid everywhere has small errors everywhere.
    CHECK((!match.found() || error / count < 9.));
    if (type == vpKeypointType::ORB) {
      CHECK(match.status == vpPlanarTargetStatus::Extrapolated);
    }
  }
}

TEST_CASE("SURF's threshold, octaves, scales and orientation are of choice", "[planar_target][plane-matcher]")
{
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(50);
  const vpPlanarScene::Target target = vpPosters::poster(rng);
  vpPlanarTargetSpec spec;
  spec.keypoints = vpKeypointType::SURF;
  spec.maxKeypoints = 5000;
  const auto count = [&](const vpPlanarTargetSpec &with) {
    return vpPlaneMatcher(target.image, with).result().referenceKeypoints;
  };
  std::size_t before = count(spec);
  for (const double threshold : {20., 40., 80.}) { // a higher one keeps fewer
    spec.surfThreshold = threshold;
    const std::size_t now = count(spec);
    CAPTURE(threshold, before, now);
    CHECK(now < before);
    before = now;
  }
  spec = vpPlanarTargetSpec();
  spec.keypoints = vpKeypointType::SURF;
  spec.maxKeypoints = 5000;
  const std::size_t all = count(spec);
  spec.surfOctaves = 1;
  CHECK(count(spec) < all);
  spec.surfOctaves = 4;
  spec.surfLayers = 1;
  CHECK(count(spec) < all);
  spec.surfLayers = 4;

  // A view turned by a right angle: the orientation of the keypoints is what finds them again.
  Image turned(target.image.getWidth(), target.image.getHeight());
  for (unsigned int i = 0; i < turned.getHeight(); ++i) {
    for (unsigned int j = 0; j < turned.getWidth(); ++j) {
      turned[i][j] = target.image[turned.getWidth() - 1 - j][i];
    }
  }
  vpPlaneMatcher oriented(target.image, spec);
  const std::size_t found = oriented.match(turned).inliers.size();
  spec.surfUpright = true;
  vpPlaneMatcher upright(target.image, spec);
  CAPTURE(found, upright.result().referenceKeypoints);
  CHECK(upright.match(target.image).found());
  CHECK(upright.match(turned).inliers.size() < found / 4);

  spec.surfThreshold = -1.;
  CHECK_THROWS_WITH(vpPlaneMatcher(target.image, spec), Catch::Contains("surfThreshold") && Catch::Contains("-1"));
  spec.surfThreshold = 10.;
  spec.surfOctaves = 0;
  CHECK_THROWS_WITH(vpPlaneMatcher(target.image, spec), Catch::Contains("surfOctaves"));
  spec.surfOctaves = 4;
  spec.surfLayers = 17;
  CHECK_THROWS_WITH(vpPlaneMatcher(target.image, spec), Catch::Contains("surfLayers"));
}
