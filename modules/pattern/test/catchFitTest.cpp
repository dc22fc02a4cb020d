/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Calibrations that do not fit their points are not reported reliable, and those that fit are, at the given level.
#include "vpCatch.h"
#include "vpPlanarProblem.h"

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/pattern/vpTsaiCalibration.h>

#include <Eigen/Dense>

#include <cmath>

VISP_DIRECT_USING_NAMESPACE
using vpPatternTest::Points;
using vpPatternTest::uniform;

namespace
{
constexpr double noise = 0.1; // px

// Five views of a grid of 9 x 7 points, 30 x 25 mm apart, by a camera of f = 1200 px.
std::vector<Points> fiveViews(std::mt19937_64 &rng)
{
  std::normal_distribution<double> normal;
  std::vector<Points> views(5);
  for (Points &view : views) {
    const double way = uniform(rng, -M_PI, M_PI), tilt = uniform(rng, 0.35, 0.7);
    const vpHomogeneousMatrix cMo =
        vpHomogeneousMatrix(uniform(rng, -0.03, 0.03), uniform(rng, -0.03, 0.03), uniform(rng, 0.8, 1.), 0., 0., 0.) *
        vpHomogeneousMatrix(0., 0., 0., tilt * std::cos(way), tilt * std::sin(way), 0.) *
        vpHomogeneousMatrix(0., 0., 0., 0., 0., uniform(rng, -M_PI, M_PI));
    for (int i = 0; i < 63; ++i) {
      vpCalibrationPoint point;
      point.x = 0.03 * (i % 9 - 4);
      point.y = 0.025 * (i / 9 - 3);
      const vpColVector p = cMo * vpColVector({point.x, point.y, 0., 1.});
      point.u = 319.5 + 1200. * p[0] / p[2] + noise * normal(rng);
      point.v = 239.5 + 1200. * p[1] / p[2] + noise * normal(rng);
      point.sigmaU = point.sigmaV = noise;
      view.push_back(point);
    }
  }
  return views;
}

vpTsaiCalibrationResult calibrate(const std::vector<Points> &views, bool stated, double level = 0.01)
{
  vpTsaiCalibrationSpec spec;
  spec.sigmaFromResiduals = !stated;
  spec.falseAlarm = level;
  vpTsaiCalibration calibration(640, 480, spec);
  for (Points view : views) {
    for (vpCalibrationPoint &point : view) {
      point.sigmaU = point.sigmaV = stated ? noise : 1.;
    }
    calibration.addView(view);
  }
  return calibration.compute();
}

vpMicroscopeCalibrationResult calibrate(const vpPatternTest::Problem &problem, const std::vector<Points> &views,
                                        bool stated, double level = 0.01)
{
  vpMicroscopeCalibrationSpec spec;
  spec.sigmaFromResiduals = !stated;
  spec.falseAlarm = level;
  vpPlanarMicroscopeCalibration calibration(problem.truth.width, problem.truth.height, spec);
  for (const Points &view : views) {
    calibration.addView(view);
  }
  return calibration.compute();
}

// The number of false alarms lies within five deviations of its mean.
void checkAlarms(int alarms, int fits, double level)
{
  CAPTURE(alarms, fits, level);
  const double spread = 5. * std::sqrt(level * (1. - level) * fits);
  CHECK(alarms < level * fits + spread);
  CHECK(alarms > level * fits - spread);
}
} // namespace

TEST_CASE("three gross outliers in one of five views are named, with a stated deviation or none", "[calibration][fit]")
{
  CAPTURE(vpTestSupport::seed());
  for (unsigned int trial = 0; trial < 40; ++trial) {
    auto rng = vpTestSupport::generator(600 + trial);
    std::vector<Points> views = fiveViews(rng);
    const int bad = static_cast<int>(trial % 5);
    for (const std::size_t i : {4U, 30U, 55U}) {
      views[static_cast<std::size_t>(bad)][i].u += uniform(rng, 15., 40.);
      views[static_cast<std::size_t>(bad)][i].v -= uniform(rng, 15., 40.);
    }
    for (const bool stated : {true, false}) {
      const vpTsaiCalibrationResult result = calibrate(views, stated);
      CAPTURE(trial, stated, result.message);
      CHECK_FALSE(result.reliable);
      CHECK(result.fit.verdict == vpFitVerdict::Misfit);
      CHECK(result.fit.worstView == bad);
      CHECK(result.fit.worstPointView == bad);
      CHECK((result.fit.worstPoint == 4 || result.fit.worstPoint == 30 || result.fit.worstPoint == 55));
      CHECK(result.fit.worstPointDistance > 10.);
      CHECK(result.message.find("This is not reliable") != std::string::npos);
      CHECK(result.message.find("The model does not fit the points: ") != std::string::npos);
      CHECK(result.message.find("View " + std::to_string(bad) + " fits worst") != std::string::npos);
    }
  }
}

TEST_CASE("a view whose points have each other's names, and a wrong pitch, are misfits", "[calibration][fit]")
{
  CAPTURE(vpTestSupport::seed());
  for (unsigned int trial = 0; trial < 20; ++trial) {
    auto rng = vpTestSupport::generator(650 + trial);
    const std::vector<Points> good = fiveViews(rng);
    const std::size_t bad = trial % 5;
    for (const bool stated : {true, false}) {
      std::vector<Points> turned = good;
      for (vpCalibrationPoint &point : turned[bad]) { // by 90 degrees: 25 mm are taken for 30
        const double x = point.x / 0.03, y = point.y / 0.025;
        point.x = -0.03 * y;
        point.y = 0.025 * x;
      }
      vpTsaiCalibrationResult result = calibrate(turned, stated);
      CAPTURE(trial, stated, result.message);
      CHECK_FALSE(result.reliable);
      CHECK(result.fit.worstView == static_cast<int>(bad));
      std::vector<Points> stretched = good;
      for (Points &view : stretched) { // a pitch error of 2 %, equal in all views
        for (vpCalibrationPoint &point : view) {
          point.y *= 1.02;
        }
      }
      result = calibrate(stretched, stated);
      CAPTURE(result.message);
      CHECK_FALSE(result.reliable);
    }
  }
}

TEST_CASE("500 random cameras: honest covariance where the fit is called reliable, alarms at the stated level",
          "[calibration][fit]")
{
  auto rng = vpTestSupport::generator(700);
  CAPTURE(vpTestSupport::seed());
  constexpr int problems = 500;
  constexpr double level = 0.05;
  for (const bool stated : {true, false}) {
    double nees = 0.;
    int reliable = 0, alarms = 0;
    for (int trial = 0; trial < problems; ++trial) {
      const vpTsaiCalibrationResult result = calibrate(fiveViews(rng), stated, level);
      alarms += result.fit.verdict == vpFitVerdict::Fits ? 0 : 1;
      if (result.reliable) {
        Eigen::Matrix<double, 5, 1> e, sigma = result.covariance.diagonal().cwiseSqrt();
        e << result.px - 1200., result.py - 1200., result.kappa1, result.u0 - 319.5, result.v0 - 239.5;
        const Eigen::Matrix<double, 5, 5> unit =
            sigma.cwiseInverse().asDiagonal() * result.covariance * sigma.cwiseInverse().asDiagonal();
        e = e.cwiseQuotient(sigma).eval();
        nees += e.dot(unit.ldlt().solve(e));
        ++reliable;
      }
    }
    WARN((stated ? "stated deviations: " : "deviations from residuals: ")
         << "NEES " << nees / reliable << " (expected 5) in " << reliable << " reliable fits, " << alarms
         << " false alarms of " << problems << ", " << level * problems << " stated");
    CHECK(nees / reliable == Approx(5.).margin(5. * std::sqrt(10. / reliable) + 0.1));
    checkAlarms(alarms, problems, level);
  }
}

TEST_CASE("500 random microscopes, tilted to two degrees: honest covariance, alarms at the stated level",
          "[calibration][fit]")
{
  auto rng = vpTestSupport::generator(710);
  CAPTURE(vpTestSupport::seed());
  constexpr int problems = 500;
  constexpr double level = 0.05;
  for (const bool isBent : {true, false}) { // observable distortion, and none
    vpPatternTest::Moments nees;
    int alarms = 0;
    for (int trial = 0; trial < problems; ++trial) {
      vpPatternTest::Problem problem =
          vpPatternTest::randomProblem(rng, 1 + trial % 3, isBent ? uniform(rng, 0.5e-7, 3e-7) : 0., 640, 480, 0.035);
      problem.pitchX *= 2.; // fewer cells
      problem.pitchY *= 2.;
      problem.truth = problem.views[0];
      std::vector<Points> views;
      for (std::size_t k = 0; k < problem.views.size(); ++k) {
        views.push_back(vpPatternTest::pointsOf(problem, k, 0.06, 0.03, rng));
      }
      const vpMicroscopeCalibrationResult result = calibrate(problem, views, trial % 2 == 0, level);
      CAPTURE(trial, result.message);
      CHECK(result.kappa1Status == (isBent ? vpKappa1Status::Estimated : vpKappa1Status::Unobservable));
      alarms += result.fit.verdict == vpFitVerdict::Fits ? 0 : 1;
      if (!result.reliable) {
        continue;
      }
      const vpMicroscopeCalibration &c = result.calibration, &t = problem.truth;
      const int index[] = {vpMicroscopeScaleX, vpMicroscopeRotation, vpMicroscopeTx,      vpMicroscopeTy,
                           vpMicroscopeTiltX,  vpMicroscopeTiltY,    vpMicroscopeStretch, vpMicroscopeShear};
      Eigen::Matrix<double, 8, 1> e;
      e << c.scaleX - t.scaleX, std::remainder(c.rotation - t.rotation, 2. * M_PI), c.tx - t.tx, c.ty - t.ty,
          c.tiltX - t.tiltX, c.tiltY - t.tiltY, c.stretch - t.stretch, c.shear - t.shear;
      Eigen::Matrix<double, 8, 8> C;
      for (int i = 0; i < 8; ++i) {
        const double sigma = result.sigma(static_cast<vpMicroscopeParameter>(index[i]));
        e[i] /= sigma;
        for (int j = 0; j < 8; ++j) {
          C(i, j) = result.covariance(index[i], index[j]) /
                    (sigma * result.sigma(static_cast<vpMicroscopeParameter>(index[j])));
        }
      }
      nees.add(e.dot(C.ldlt().solve(e)));
    }
    WARN((isBent ? "distortion found: " : "distortion unseen: ")
         << "NEES " << nees.mean() << " (expected " << (isBent ? "8" : "7 to 8: the unseen distortion is allowed for")
         << ") in " << nees.n << " reliable fits, " << alarms << " false alarms of " << problems << ", "
         << level * problems << " stated");
    const double spread = 4. * std::sqrt(16. / nees.n);
    CHECK(nees.mean() < 8. + spread);
    CHECK(nees.mean() > (isBent ? 8. : 7.) - spread);
    checkAlarms(alarms, problems, level);
  }
}

TEST_CASE("a microscope with a false point, a bent product or a wrong pitch is not reliable", "[calibration][fit]")
{
  CAPTURE(vpTestSupport::seed());
  for (unsigned int trial = 0; trial < 20; ++trial) {
    auto rng = vpTestSupport::generator(720 + trial);
    const vpPatternTest::Problem problem = vpPatternTest::randomProblem(rng, 2, 0.);
    const std::vector<Points> good = {vpPatternTest::pointsOf(problem, 0, noise, noise, rng),
                                      vpPatternTest::pointsOf(problem, 1, noise, noise, rng)};
    for (const bool stated : {true, false}) {
      std::vector<Points> views = good;
      views[1][7].u += 2.;
      vpMicroscopeCalibrationResult result = calibrate(problem, views, stated);
      CAPTURE(trial, stated, result.message);
      CHECK_FALSE(result.reliable);
      CHECK(result.fit.worstPointView == 1);
      CHECK(result.fit.worstPoint == 7);
      CHECK(result.message.find("the worst point is 7 of view 1") != std::string::npos);

      views = good;
      for (vpCalibrationPoint &point : views[0]) { // a fold
        point.u += point.v > 240. ? 0.004 * (point.v - 240.) : 0.;
      }
      result = calibrate(problem, views, stated);
      CAPTURE(result.message);
      CHECK_FALSE(result.reliable);

      views = good;
      for (Points &view : views) { // row distance 2 % larger than specified
        for (vpCalibrationPoint &point : view) {
          point.y *= 0.98;
        }
      }
      result = calibrate(problem, {views[0]}, stated);
      CAPTURE(result.message);
      CHECK_FALSE(result.reliable);
      CHECK(result.message.find("The product looks as if tilted by ") != std::string::npos);
    }
  }
}
