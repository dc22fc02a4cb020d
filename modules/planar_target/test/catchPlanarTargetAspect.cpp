/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Cameras and photographs with pixels that are not square.
#include "vpCatch.h"
#include "vpPosters.h"

#include <visp3/planar_target/vpPlanarTarget.h>

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
