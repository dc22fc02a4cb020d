/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"
#include "vpPlanarScene.h"

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
