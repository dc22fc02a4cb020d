/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The lattice of dots of every kind, and none where there is none. Calibrations from images of dots and of the product.
#include "vpAnalyticPattern.h"
#include "vpCatch.h"
#include "vpDotScene.h"

#include <visp3/core/vpException.h>
#include <visp3/pattern/vpDotLattice.h>
#include <visp3/pattern/vpPatternTracker.h>
#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <cstdlib>
#include <string>

VISP_DIRECT_USING_NAMESPACE
using namespace vpPatternTest;

namespace
{
Eigen::Vector2d stepA(const vpDotLattice &lattice) { return {lattice.ax, lattice.ay}; }
Eigen::Vector2d stepB(const vpDotLattice &lattice) { return {lattice.bx, lattice.by}; }
} // namespace

TEST_CASE("lattices of every kind are found at any rotation, with gaps and strangers", "[lattice]")
{
  CAPTURE(vpTestSupport::seed());
  // Maximum percentage wrong or refused; the prototype had none, and up to 5 with a third missing.
  const struct {
    DotKind kind;
    int percent;
  } kinds[] = {{{"row", DotShape::Row, false, false, false, 0.1, 0.1}, 2},
               {{"rectangular", DotShape::Rectangular, false, false, false, 0.1, 0.1}, 2},
               {{"hexagonal", DotShape::Hexagonal, false, false, false, 0.1, 0.1}, 2},
               {{"quincunx", DotShape::Quincunx, false, false, false, 0.1, 0.1}, 2},
               {{"honeycomb", DotShape::Honeycomb, false, false, false, 0.1, 0.1}, 2},
               {{"two shapes", DotShape::TwoShapes, false, false, false, 0.1, 0.1}, 2},
               {{"rectangular, vignetting", DotShape::Rectangular, true, false, false, 0.1, 0.1}, 2},
               {{"hexagonal, vignetting", DotShape::Hexagonal, true, false, false, 0.1, 0.1}, 2},
               {{"three levels", DotShape::Rectangular, false, true, false, 0.1, 0.1}, 3},
               {{"rectangular, perspective", DotShape::Rectangular, false, false, true, 0.1, 0.1}, 2},
               {{"hexagonal, perspective", DotShape::Hexagonal, false, false, true, 0.1, 0.1}, 2},
               {{"rectangular, a third missing", DotShape::Rectangular, false, false, false, 0.3, 0.3}, 8},
               {{"hexagonal, a third missing", DotShape::Hexagonal, false, false, false, 0.3, 0.3}, 8},
               {{"row, a third missing", DotShape::Row, false, false, false, 0.3, 0.3}, 10}};
  unsigned int number = 800;
  for (const auto &line : kinds) {
    auto rng = vpTestSupport::generator(number++);
    const int n = vpTestSupport::longer(10);
    int wrong = 0, refused = 0;
    for (int trial = 0; trial < n; ++trial) {
      const DotScene scene = makeDots(line.kind, rng);
      const vpDotLattice found = vpFindDotLattice(scene.image);
      if (found.kind == vpDotLatticeKind::None) {
        ++refused;
      }
      else if (!sameLattice(stepA(found), stepB(found), scene.a, scene.b)) {
        ++wrong;
      }
    }
    WARN(line.kind.name << ": " << wrong << " wrong, " << refused << " refused of " << n);
    const double share = 0.01 * line.percent; // a count of that share, and four of its deviations
    CHECK(wrong + refused <= share * n + 4. * std::sqrt(share * n));
  }
}

TEST_CASE("random spots are no lattice", "[lattice]")
{
  auto rng = vpTestSupport::generator(820);
  CAPTURE(vpTestSupport::seed());
  const int n = vpTestSupport::longer(100);
  for (int trial = 0; trial < n; ++trial) {
    const DotKind kind = {"none", DotShape::Random, trial % 2 == 0, false, false, 1., between(rng, 0.05, 1.)};
    const vpDotLattice found = vpFindDotLattice(makeDots(kind, rng).image);
    CAPTURE(trial, found.message);
    CHECK(found.kind == vpDotLatticeKind::None);
    CHECK(found.dots.empty());
    CHECK(found.message.find("no lattice was found: ") != std::string::npos);
  }
  for (const unsigned char grey : {0, 128, 255}) {
    CHECK(vpFindDotLattice(vpImage<unsigned char>(100, 100, grey)).kind == vpDotLatticeKind::None);
  }
  CHECK_THROWS_WITH(vpFindDotLattice(vpImage<unsigned char>(0, 0)),
                    Catch::Contains("the image has 0 x 0 px, must have at least 16 x 16"));
  CHECK_THROWS_WITH(vpFindDotLattice(vpImage<unsigned char>(15, 100)), Catch::Contains("the image has 100 x 15 px"));
}

TEST_CASE("dots of a grid of any kind calibrate a microscope, and one of another kind than specified is refused",
          "[lattice][calibration]")
{
  auto rng = vpTestSupport::generator(830);
  CAPTURE(vpTestSupport::seed());
  for (int trial = 0; trial < 12; ++trial) {
    const DotShape shape = trial % 2 == 0 ? DotShape::Hexagonal : DotShape::Rectangular;
    const DotScene scene = makeDots({"", shape, false, false, false, 0.05, 0.05}, rng);
    const double scale = 2e5; // px/m
    vpCalibrationPitch pitch{scene.a.norm() / scale, scene.b.norm() / scale, 0.};
    const auto calibrate = [&scene, &pitch] {
      vpMicroscopeCalibrationSpec spec;
      spec.sigmaFromResiduals = true;
      vpPlanarMicroscopeCalibration calibration(320, 240, spec);
      calibration.addView(vpCalibrationPoints(scene.image, pitch));
      return calibration.compute();
    };
    const vpDotLattice found = vpFindDotLattice(scene.image);
    CAPTURE(trial, found.message);
    if (shape == DotShape::Hexagonal) {
      CHECK(std::string(found.name()) == "hexagonal");
      CHECK(std::abs(found.angle() - 90.) == Approx(30.).margin(0.5));
      pitch.columns = pitch.rows = 0.5 * (pitch.columns + pitch.rows); // equal but for rounding
    }
    vpMicroscopeCalibrationResult result = calibrate();
    CAPTURE(result.message);
    CHECK(result.calibration.scaleX == Approx(scale).epsilon(3e-3));
    if (shape == DotShape::Hexagonal) { // a square one is specified
      pitch.angle = M_PI / 2.;
      result = calibrate();
      CAPTURE(result.message);
      CHECK_FALSE(result.reliable);
      CHECK(result.message.find("The product looks as if tilted by 5") != std::string::npos);
      CHECK(result.message.find("the cells are on another lattice than specified") != std::string::npos);
      pitch.angle = M_PI / 3.;
      CHECK(calibrate().calibration.scaleX == Approx(scale).epsilon(3e-3));
    }
  }
  const DotScene row = makeDots({"", DotShape::Row, false, false, false, 0., 0.}, rng);
  CHECK_THROWS_WITH(vpCalibrationPoints(row.image, {1e-4, 1e-4, 0.}),
                    Catch::Contains("no dots of a grid were found: ") && Catch::Contains("dots are in one row"));
  CHECK_THROWS_WITH(vpCalibrationPoints(row.image, {1e-4, 1e-4, 0., 0.1}),
                    Catch::Contains("angle of the pitch is 0.1 rad, must be 0.5..2.7"));
}

TEST_CASE("calibrations from pictures of random lattices err as they say", "[lattice][calibration]")
{
  CAPTURE(vpTestSupport::seed());
  const int scenes = vpTestSupport::longer(60);
  constexpr double truth = 2e5; // px/m
  double nees = 0., squares = 0., sigmas = 0.;
  int unreliable = 0;
  for (int i = 0; i < scenes; ++i) {
    auto rng = vpTestSupport::generator(850 + static_cast<unsigned int>(i));
    const DotShape shape = i % 2 == 0 ? DotShape::Hexagonal : DotShape::Rectangular;
    const DotScene scene = makeDots({"", shape, false, false, false, 0.1, 0.}, rng);
    vpMicroscopeCalibrationSpec spec;
    spec.sigmaFromResiduals = true;
    spec.estimateKappa1 = false; // there is none; what is not seen of it would be allowed for
    vpPlanarMicroscopeCalibration calibration(320, 240, spec);
    calibration.addView(vpCalibrationPoints(scene.image, {scene.a.norm() / truth, scene.b.norm() / truth, 0.,
                                                          shape == DotShape::Hexagonal ? M_PI / 3. : M_PI / 2.}));
    const vpMicroscopeCalibrationResult result = calibration.compute();
    const double sigma = result.sigma(vpMicroscopeScaleX), error = result.calibration.scaleX - truth;
    nees += error * error / (sigma * sigma) / scenes;
    squares += error * error / (truth * truth) / scenes;
    sigmas += sigma * sigma / (truth * truth) / scenes;
    unreliable += result.reliable ? 0 : 1;
  }
  WARN("scale from " << scenes << " pictures: " << std::sqrt(squares) << " rms, " << std::sqrt(sigmas)
                     << " stated; NEES " << nees << ", " << unreliable << " not reliable");
  // Variance of the mean of squares of normal numbers, 2 / n, and of the deviation from some 100 residuals, as much as
  // 1 / 100; not exceeded once in 100,000 times.
  CHECK(nees == Approx(1.).margin(0.1 + 4.42 * std::sqrt(2.1 / scenes)));
}

TEST_CASE("the product is its own ruler", "[calibration]")
{
  auto rng = vpTestSupport::generator(519);
  CAPTURE(vpTestSupport::seed());
  Pattern pattern;
  vpPatternTracker tracker(160, 100);
  vpPlanarMicroscopeCalibration calibration(160, 100);
  vpImage<unsigned char> image;
  const vpCalibrationPitch pitch{220e-6, 220e-6 / pattern.pitchX * pattern.pitchY, 0.};
  for (int i = 0; i < 120; ++i) {
    pattern.x += 2.7;
    pattern.y += 0.3;
    pattern.render(rng, image);
    const vpPatternFrame &frame = tracker.process(image);
    if (frame.status == vpPatternStatus::Tracking && i % 4 == 0) {
      calibration.addView(vpCalibrationPoints(frame, pitch));
    }
  }
  REQUIRE(calibration.viewCount() > 5);
  const vpMicroscopeCalibrationResult result = calibration.compute();
  CAPTURE(result.message);
  CHECK(result.kappa1Status == vpKappa1Status::Unobservable);
  CHECK(result.calibration.scaleX == Approx(pattern.pitchX / 220e-6).epsilon(3e-4));
  CHECK(std::abs(result.calibration.scaleX - pattern.pitchX / 220e-6) < 5. * result.sigma(vpMicroscopeScaleX));
  CHECK(std::abs(result.calibration.rotation) < 1e-3);
  CHECK_FALSE(result.calibration.mirrored);
  CHECK(result.varianceFactor == Approx(1.).margin(0.4));

  // One image of a grid.
  pattern.noise = 1.;
  pattern.pitchX = pattern.pitchY = 20.;
  pattern.cellX = pattern.cellY = 10.;
  pattern.render(rng, image);
  vpPlanarMicroscopeCalibration fromGrid(160, 100);
  fromGrid.addView(vpCalibrationPoints(image, {100e-6, 100e-6, 0.}));
  CHECK(fromGrid.compute().calibration.scaleX == Approx(20. / 100e-6).epsilon(1e-3));
  image = 77;
  CHECK_THROWS_WITH(vpCalibrationPoints(image, {100e-6, 100e-6, 0.}),
                    Catch::Contains("no dots of a grid were found: "));
  CHECK_THROWS_WITH(vpCalibrationPoints(image, {-1., 100e-6, 0.}),
                    Catch::Contains("columns of the pitch is -1 m, must be > 0"));
  CHECK_THROWS_WITH(vpCalibrationPoints(tracker.frame(), {1., NAN, 0.}),
                    Catch::Contains("rows of the pitch is nan m, must be > 0"));
  CHECK_THROWS_WITH(vpCalibrationPoints(tracker.frame(), {1., 1., -1.}),
                    Catch::Contains("sigmaPlane of the pitch is -1 m, must be >= 0"));
}

TEST_CASE("centres are those of the dots", "[lattice]")
{
  auto rng = vpTestSupport::generator(840);
  CAPTURE(vpTestSupport::seed());
  double squares = 0.;
  int count = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const DotScene scene = makeDots({"", DotShape::Hexagonal, false, false, false, 0., 0.}, rng);
    for (const vpLatticeDot &dot : vpFindDotLattice(scene.image).dots) {
      double least = 1e9;
      for (const Eigen::Vector2d &place : scene.dots) {
        least = std::min(least, (place - Eigen::Vector2d(dot.x, dot.y)).norm());
      }
      squares += least * least;
      ++count;
    }
  }
  REQUIRE(count > 100);
  WARN("centres off by " << std::sqrt(squares / count) << " px rms");
  CHECK(std::sqrt(squares / count) < 0.1);
}
