/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A tilted plane seen by points in a part of the image: the tilt is not taken for distortion, and no distortion is
// reported that the points do not determine.
#include "vpCatch.h"
#include "vpPlanarProblem.h"

#include <cmath>

VISP_DIRECT_USING_NAMESPACE
using vpPatternTest::Moments;
using vpPatternTest::Points;
using vpPatternTest::uniform;

namespace
{
constexpr unsigned int width = 2456, height = 2054;
constexpr double noise = 0.1, distance = 40000., edge = 1228.; // px

// 9 x 9 points of a plane at a distance of 40000 px, tilted about a random axis, over a square part of the image; by a
// pinhole and not by the calibration's own model. kappa1 in px at the edge of the image.
Points tiltedGrid(double span, double tilt, std::mt19937_64 &rng)
{
  std::normal_distribution<double> normal;
  const double way = uniform(rng, -M_PI, M_PI), c = std::cos(way), s = std::sin(way);
  Points points;
  for (int i = 0; i < 81; ++i) {
    vpCalibrationPoint point;
    const double X = 0.15 * span + span * (i % 9 / 8. - 0.5), Y = -0.1 * span + span * (i / 9 / 8. - 0.5); // px
    const double along = c * X + s * Y, across = -s * X + c * Y;
    const double depth = 1. + std::sin(tilt) * along / distance, seen = std::cos(tilt) * along;
    point.x = 1e-6 * X;
    point.y = 1e-6 * Y;
    point.u = 0.5 * (width - 1.) + (c * seen - s * across) / depth + noise * normal(rng);
    point.v = 0.5 * (height - 1.) + (s * seen + c * across) / depth + noise * normal(rng);
    point.sigmaU = point.sigmaV = noise;
    points.push_back(point);
  }
  return points;
}

vpMicroscopeCalibrationResult calibrate(const Points &points, const vpMicroscopeCalibrationSpec &spec)
{
  vpPlanarMicroscopeCalibration calibration(width, height, spec);
  calibration.addView(points);
  return calibration.compute();
}
} // namespace

TEST_CASE("a tilt of two degrees is not taken for distortion, whatever part of the image the points cover",
          "[calibration][tilt]")
{
  auto rng = vpTestSupport::generator(740);
  CAPTURE(vpTestSupport::seed());
  // Deviation of kappa1, px at the edge, when scale, foreshortening and tilt are estimated with it (by linear algebra).
  const struct {
    double span, sigma;
  } table[] = {{180., 61.}, {600., 1.64}, {1200., 0.21}, {2000., 0.044}};
  constexpr int trials = 100;
  for (const auto &line : table) {
    Moments with, without, factor;
    int given = 0, reliable = 0;
    double sigma = 0., worstCorner = 0.;
    for (int trial = 0; trial < trials; ++trial) {
      const Points points = tiltedGrid(line.span, 0.0349, rng);
      vpMicroscopeCalibrationSpec spec;
      const vpMicroscopeCalibrationResult result = calibrate(points, spec);
      CAPTURE(line.span, trial, result.message);
      given += result.kappa1Status == vpKappa1Status::Estimated ? 1 : 0;
      reliable += result.reliable ? 1 : 0;
      sigma += result.kappa1Sigma * std::pow(edge, 3) / trials;
      const double middle = (result.calibration.scaleX - 1e6) / result.sigma(vpMicroscopeScaleX);
      CHECK(std::abs(middle) < 6. + 305. / result.sigma(vpMicroscopeScaleX)); // foreshortening: the mean is 0.03 % less
      worstCorner = std::max(worstCorner, result.kappa1CornerSigma);
      if (result.kappa1Sigma * std::pow(std::hypot(edge, 1027.), 3) > 0.55) {
        CHECK(result.message.find("the points cover so little of the image") != std::string::npos);
      }
      spec.minSignificance = spec.minEffect = 0.; // whatever comes out
      spec.maxCornerSigma = 1e6;
      with.add(calibrate(points, spec).calibration.kappa1 * std::pow(edge, 3));
      spec.estimateTilt = false;
      const vpMicroscopeCalibrationResult old = calibrate(points, spec);
      without.add(old.calibration.kappa1 * std::pow(edge, 3));
      factor.add(old.varianceFactor);
    }
    WARN("span " << line.span << " px of 2456: kappa1 at the edge " << with.mean() << " +- " << with.sigma()
                 << " px with tilt (stated " << sigma << "), " << without.mean() << " +- " << without.sigma()
                 << " without (variance factor " << factor.mean() << "); given in " << given << ", reliable in "
                 << reliable << " of " << trials);
    CHECK(std::abs(with.mean()) < 4. * with.sigma() / std::sqrt(trials));
    CHECK(with.sigma() == Approx(sigma).epsilon(0.35)); // of 100 samples: 0.07, five times
    CHECK(sigma == Approx(line.sigma).epsilon(0.1));
    CHECK(given == 0);             // there is no distortion
    CHECK(reliable >= trials - 8); // one in a hundred is stated
  }
}

TEST_CASE("a distortion is given where it is known at the corner, and missed where it is not", "[calibration][tilt]")
{
  auto rng = vpTestSupport::generator(741);
  CAPTURE(vpTestSupport::seed());
  const double kappa = 20. / std::pow(edge, 3); // 20 px at the edge
  for (const double span : {600., 1200., 2000.}) {
    for (int trial = 0; trial < 50; ++trial) {
      Points points = tiltedGrid(span, uniform(rng, 0., 0.0349), rng);
      for (vpCalibrationPoint &point : points) {
        const double u = point.u - 0.5 * (width - 1.), v = point.v - 0.5 * (height - 1.);
        const double r = std::hypot(u, v), share = 1. - kappa * r * r; // r (1 + kappa r^2), to first order
        double seen = r * share;
        for (int i = 0; i < 20; ++i) {
          seen = r / (1. + kappa * seen * seen);
        }
        point.u += u * (seen / r - 1.);
        point.v += v * (seen / r - 1.);
      }
      const vpMicroscopeCalibrationResult result = calibrate(points, {});
      CAPTURE(span, trial, result.message);
      if (span > 1000.) {
        CHECK(result.kappa1Status == vpKappa1Status::Estimated);
        CHECK(std::abs(result.calibration.kappa1 - kappa) < 5. * result.kappa1Sigma);
        CHECK(result.kappa1CornerSigma <= 0.5);
      }
      else { // present, but undetermined at the corner
        CHECK(result.kappa1Status == vpKappa1Status::Unobservable);
        CHECK(result.calibration.kappa1 == 0.);
        CHECK_FALSE(result.reliable);
        CHECK(result.message.find("There is a distortion") != std::string::npos);
      }
    }
  }
}
