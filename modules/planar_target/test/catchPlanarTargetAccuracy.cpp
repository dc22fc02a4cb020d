/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpPosters.h"

#include <visp3/planar_target/vpPlanarTarget.h>

#include <cmath>
#include <iostream>

namespace
{
//! Three times the root mean square of the rotation error about each axis; a systematic error counts too.
struct Spread {
  double sum2[3] = {0., 0., 0.};
  unsigned int n = 0;

  void add(const vpColVector &e)
  {
    for (unsigned int i = 0; i < 3; ++i) {
      sum2[i] += e[i] * e[i];
    }
    ++n;
  }
  double threeSigma(unsigned int axis) const { return 3. * std::sqrt(sum2[axis] / n); }
  void print(const char *title) const
  {
    std::cout << title << ": 3 sigma of roll/pitch/yaw " << threeSigma(2) << " / " << threeSigma(0) << " / "
              << threeSigma(1) << " deg over " << n << " poses" << std::endl;
  }
};
} // namespace

TEST_CASE("clean renders: 3 sigma of every angle is at most 0.03 deg", "[planar_target][accuracy]")
{
  CAPTURE(vpTestSupport::seed());
  const vpPlanarScene::Target target = vpPlanarScene::klimt();
  vpPlanarTarget tracker(target.image, target.width, target.height, vpPlanarScene::camera());
  Spread spread;
  double position = 0.;
  for (unsigned int i = 0; i < 40; ++i) {
    auto rng = vpTestSupport::generator(100 + i);
    CAPTURE(i);
    vpPlanarScene::Image I = vpPlanarScene::background(rng);
    const vpHomogeneousMatrix cMo = vpPlanarScene::randomPose(rng, M_PI / 6.);
    vpPlanarScene::draw(I, target, vpPlanarScene::camera(), cMo);
    const vpPlanarTargetResult &r = tracker.acquire(I);
    CAPTURE(r.message);
    REQUIRE(r.status == vpPlanarTargetStatus::Acquired);
    spread.add(vpPlanarScene::rotationError(cMo, r.cMo));
    position = std::max(position, vpPlanarScene::positionError(cMo, r.cMo));
    CHECK(r.correlation > 0.97);
    CHECK(r.visible > 0.9);
  }
  spread.print("clean");
  std::cout << "clean: largest position error " << 1e3 * position << " mm" << std::endl;
  for (unsigned int axis = 0; axis < 3; ++axis) {
    CHECK(spread.threeSigma(axis) <= 0.03);
  }
  CHECK(position < 5e-4);
}

TEST_CASE("noise 6, blur 1.5, gain 0.8, 25 % occluded: 3 sigma of every angle is at most 0.25 deg",
          "[planar_target][accuracy]")
{
  CAPTURE(vpTestSupport::seed());
  const vpPlanarScene::Target target = vpPlanarScene::klimt();
  const vpPlanarScene::Image occluder = vpPlanarScene::photo("starry-night.jpg");
  vpPlanarTarget tracker(target.image, target.width, target.height, vpPlanarScene::camera());
  Spread spread;
  int refused = 0, unsure = 0;
  for (unsigned int i = 0; i < 40; ++i) {
    auto rng = vpTestSupport::generator(200 + i);
    CAPTURE(i);
    vpPlanarScene::Image I = vpPlanarScene::background(rng);
    const vpHomogeneousMatrix cMo = vpPlanarScene::randomPose(rng, M_PI / 6.);
    vpPlanarScene::Target hidden = target;
    vpPlanarScene::occlude(hidden.image, occluder, 0.25, rng);
    vpPlanarScene::draw(I, hidden, vpPlanarScene::camera(), cMo);
    vpPlanarScene::spoil(I, 1.5, 0.8, 6., rng);
    const vpPlanarTargetResult &r = tracker.acquire(I);
    CAPTURE(r.message);
    if (!r.found()) { // a status is allowed, a wrong pose is not
      ++refused;
      std::cout << "spoiled, pose " << i << ": " << vpToString(r.status) << ", " << r.message << std::endl;
      continue;
    }
    CHECK(r.correlation > 0.8);
    if (!std::isfinite(
            r.covariance.rotationDeviation())) { // the last stage did not converge: keypoints and a few pixels
      ++unsure;
      continue;
    }
    spread.add(vpPlanarScene::rotationError(cMo, r.cMo));
  }
  spread.print("spoiled");
  std::cout << "spoiled: " << refused << " refused, " << unsure << " without covariance" << std::endl;
  for (unsigned int axis = 0; axis < 3; ++axis) {
    CHECK(spread.threeSigma(axis) <= 0.25);
  }
  CHECK(refused + unsure <= 10); // of 40; one in twenty would exceed it once in 100,000 runs
}

// Cameras and photographs with pixels that are not square.
TEST_CASE("a target is found by cameras with pixels that are not square", "[planar_target][aspect]")
{
  CAPTURE(vpTestSupport::seed());
  for (const double aspect : {0.5, 0.75, 1., 1.5, 2.}) {
    const double px = 800. * std::min(1., aspect), py = px / aspect;
    const vpCameraParameters camera(px, py, 319.5, 239.5);
    int found = 0;
    constexpr int trials = 10;
    for (int trial = 0; trial < trials; ++trial) {
      auto rng = vpTestSupport::generator(static_cast<unsigned int>(trial));
      const vpPlanarScene::Target target = vpPosters::poster(rng);
      std::uniform_real_distribution<double> u(-1., 1.);
      const vpHomogeneousMatrix cMo =
          vpPlanarScene::pose(0.02 * u(rng), 0.02 * u(rng), 0.45, 1.5 * u(rng), 0.4 * u(rng), 0.4 * u(rng));
      vpPlanarScene::Image view = vpPosters::wall(rng);
      vpPlanarScene::draw(view, target, camera, cMo, 3);
      vpPlanarScene::spoil(view, 0.5, 0.95, 2., rng);
      vpPlanarTargetSpec spec;
      spec.fallback = false;
      vpPlanarTarget finder(target.image, target.width, target.height, camera, spec);
      const vpPlanarTargetResult &result = finder.acquire(view);
      CAPTURE(aspect, trial, result.message);
      if (result.found()) {
        ++found;
        CHECK(std::sqrt(vpPlanarScene::rotationError(cMo, result.cMo).sumSquare()) < 1.);
        CHECK(vpPlanarScene::positionError(cMo, result.cMo) < 5e-3);
      }
    }
    CAPTURE(aspect, found);
    CHECK(found >= trials - 2);
  }
}

TEST_CASE("a photograph with pixels that are not square serves as a target", "[planar_target][aspect]")
{
  CAPTURE(vpTestSupport::seed());
  for (const int narrow : {1, 2}) {
    int found = 0;
    constexpr int trials = 6;
    for (int trial = 0; trial < trials; ++trial) {
      auto rng = vpTestSupport::generator(static_cast<unsigned int>(50 + trial));
      const vpPlanarScene::Target target = vpPosters::poster(rng);
      vpPlanarScene::Image photo(300, static_cast<unsigned int>(300 / narrow));
      for (unsigned int i = 0; i < photo.getHeight(); ++i) {
        for (unsigned int j = 0; j < photo.getWidth(); ++j) {
          photo[i][j] = narrow == 1
                            ? target.image[i][j]
                            : static_cast<unsigned char>((target.image[i][2 * j] + target.image[i][2 * j + 1]) / 2);
        }
      }
      std::uniform_real_distribution<double> u(-1., 1.);
      const vpHomogeneousMatrix cMo =
          vpPlanarScene::pose(0.02 * u(rng), 0.02 * u(rng), 0.45, 1.5 * u(rng), 0.4 * u(rng), 0.4 * u(rng));
      vpPlanarScene::Image view = vpPosters::wall(rng);
      vpPlanarScene::draw(view, target, vpPlanarScene::camera(), cMo, 3);
      vpPlanarTargetSpec spec;
      spec.fallback = false;
      vpPlanarTarget finder(photo, target.width, target.height, vpPlanarScene::camera(), spec);
      const vpPlanarTargetResult &result = finder.acquire(view);
      CAPTURE(narrow, trial, result.message);
      if (result.found()) {
        ++found;
        CHECK(vpPlanarScene::positionError(cMo, result.cMo) < 5e-3);
      }
    }
    CAPTURE(narrow, found);
    CHECK(found >= trials - 1);
  }
}
