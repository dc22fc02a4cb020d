/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The planar calibration against random truths: exactness, correct covariance, observability of kappa1, invalid input.
#include "vpCatch.h"
#include "vpPlanarProblem.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>

#include <Eigen/Dense>

#include <cmath>
#include <functional>

VISP_DIRECT_USING_NAMESPACE
using namespace vpPatternTest;

namespace
{
constexpr int all = vpMicroscopeParameterCount;
using Parameters = Eigen::Matrix<double, all, 1>;

Parameters parametersOf(const vpMicroscopeCalibration &c)
{
  Parameters p;
  p << c.scaleX, c.scaleY, c.kappa1, c.u0, c.v0, c.rotation, c.tx, c.ty, c.tiltX, c.tiltY, c.stretch, c.shear;
  return p;
}

Parameters errorOf(const vpMicroscopeCalibration &found, const vpMicroscopeCalibration &truth)
{
  Parameters error = parametersOf(found) - parametersOf(truth);
  error[vpMicroscopeRotation] = std::remainder(error[vpMicroscopeRotation], 2. * M_PI);
  return error;
}

// Sum of squares of a calibration over a view, by its public functions: an oracle for the minimum.
double chi2Of(const Parameters &p, bool mirrored, const Points &points)
{
  vpMicroscopeCalibration c;
  c.scaleX = p[0];
  c.scaleY = p[1];
  c.kappa1 = p[2];
  c.u0 = p[3];
  c.v0 = p[4];
  c.rotation = p[5];
  c.tx = p[6];
  c.ty = p[7];
  c.tiltX = p[8];
  c.tiltY = p[9];
  c.stretch = p[10];
  c.shear = p[11];
  c.mirrored = mirrored;
  double sum = 0.;
  for (const vpCalibrationPoint &point : points) {
    const Eigen::Vector2d seen = c.toImage(point.x, point.y);
    sum += std::pow((seen.x() - point.u) / point.sigmaU, 2) + std::pow((seen.y() - point.v) / point.sigmaV, 2);
  }
  return sum;
}

} // namespace

TEST_CASE("without noise every calibration is found exactly", "[calibration]")
{
  auto rng = vpTestSupport::generator(510);
  CAPTURE(vpTestSupport::seed());
  for (int trial = 0; trial < 300; ++trial) {
    const int views = 1 + trial % 3;
    const double size = uniform(rng, 3e-8, 3e-7); // without distortion there is no principal point
    Problem problem = randomProblem(rng, views, trial % 2 == 0 ? size : -size, 640, 480, 0.035);
    vpMicroscopeCalibrationSpec spec;
    spec.minSignificance = spec.minEffect = 0.;
    spec.maxCornerSigma = 1e6;
    const bool everything = trial % 4 == 3;
    if (everything) { // aspect and principal point too
      const double aspect = uniform(rng, 0.95, 1.05), u0 = uniform(rng, 290., 350.), v0 = uniform(rng, 210., 270.);
      problem.truth.scaleY *= aspect;
      problem.truth.u0 = u0;
      problem.truth.v0 = v0;
      problem.truth.stretch = 0.; // is aspect
      for (vpMicroscopeCalibration &view : problem.views) {
        view.stretch = 0.;
        view.scaleY *= aspect;
        view.u0 = u0;
        view.v0 = v0;
      }
      spec.estimateAspect = spec.estimatePrincipalPoint = true;
    }
    vpPlanarMicroscopeCalibration calibration(640, 480, spec);
    for (std::size_t k = 0; k < problem.views.size(); ++k) {
      calibration.addView(pointsOf(problem, k, 0., 0., rng));
    }
    const vpMicroscopeCalibrationResult result = calibration.compute();
    CAPTURE(trial, result.message, problem.truth.kappa1);
    REQUIRE(result.converged);
    REQUIRE(result.residualRms < 1e-6);
    REQUIRE(result.calibration.mirrored == problem.truth.mirrored);
    const Parameters error = errorOf(result.calibration, problem.truth);
    REQUIRE(std::abs(error[vpMicroscopeScaleX]) < 1e-8 * problem.truth.scaleX);
    REQUIRE(std::abs(error[vpMicroscopeScaleY]) < 1e-8 * problem.truth.scaleY);
    REQUIRE(std::abs(error[vpMicroscopeKappa1]) < 1e-12);
    REQUIRE(error.segment<2>(vpMicroscopeU0).norm() < 1e-3);
    REQUIRE(std::abs(error[vpMicroscopeRotation]) < 1e-8);
    REQUIRE(error.segment<2>(vpMicroscopeTx).norm() < 1e-8);
    REQUIRE(error.segment<2>(vpMicroscopeTiltX).norm() < 1e-10);
    REQUIRE(error.tail<2>().norm() < 1e-8);
    for (std::size_t k = 0; k < problem.views.size(); ++k) {
      REQUIRE(std::remainder(result.placements[k].rotation - problem.views[k].rotation, 2. * M_PI) ==
              Approx(0.).margin(1e-8));
      REQUIRE(result.placements[k].tx == Approx(problem.views[k].tx).margin(1e-8));
      REQUIRE(result.placements[k].ty == Approx(problem.views[k].ty).margin(1e-8));
    }
  }
}

TEST_CASE("scale, kappa1 and placement have the errors that the covariance says", "[calibration]")
{
  auto rng = vpTestSupport::generator(511);
  CAPTURE(vpTestSupport::seed());
  constexpr int problems = 1500;
  Moments nees, scale, kappa, factor, rotation;
  Moments gain[2]; // printed over corrected: squared errors in units of our deviations
  int failed = 0;
  for (int trial = 0; trial < problems; ++trial) {
    const double size = uniform(rng, 4e-8, 3e-7);
    Problem problem =
        randomProblem(rng, 1 + trial % 2, trial % 2 == 0 ? size : -size, 640, 480, trial < problems / 2 ? 0. : 0.035);
    if (trial % 3 != 0) { // the origin in view: its position then depends on the scale and not only on the rotation
      problem.views[0].tx *= 0.1;
      problem.views[0].ty *= 0.1;
      problem.truth = problem.views[0];
    }
    vpMicroscopeCalibrationSpec spec;
    spec.minSignificance = 0.; // minimum 0, so that nothing is selected
    spec.minEffect = 0.;
    vpPlanarMicroscopeCalibration calibration(640, 480, spec);
    Points first;
    for (std::size_t k = 0; k < problem.views.size(); ++k) {
      const Points points = pointsOf(problem, k, 0.06, 0.03, rng);
      first = k == 0 ? points : first;
      calibration.addView(points);
    }
    const vpMicroscopeCalibrationResult result = calibration.compute();
    REQUIRE(result.converged);
    REQUIRE(result.kappa1Status == vpKappa1Status::Estimated);
    const Parameters error = errorOf(result.calibration, problem.truth);
    Eigen::Matrix<double, 5, 1> e;
    Eigen::Matrix<double, 5, 5> C;
    const int index[5] = {vpMicroscopeScaleX, vpMicroscopeKappa1, vpMicroscopeRotation, vpMicroscopeTx, vpMicroscopeTy};
    for (int i = 0; i < 5; ++i) {
      const double si = result.sigma(static_cast<vpMicroscopeParameter>(index[i]));
      e[i] = error[index[i]] / si;
      for (int j = 0; j < 5; ++j) {
        C(i, j) =
            result.covariance(index[i], index[j]) / (si * result.sigma(static_cast<vpMicroscopeParameter>(index[j])));
      }
    }
    nees.add(e.dot(C.ldlt().solve(e)));
    scale.add(e[0]);
    kappa.add(e[1]);
    rotation.add(e[2]);
    factor.add(result.varianceFactor);
    REQUIRE(result.kappa1Sigma == Approx(result.sigma(vpMicroscopeKappa1)));
    if (problem.views.size() == 1) {
      const Literal printed = literal(first, problem.truth.u0, problem.truth.v0, problem.truth.mirrored, false);
      if (std::abs(printed.scale / problem.truth.scaleX - 1.) < 0.1) {
        gain[0].add((printed.scale - problem.truth.scaleX) / result.sigma(vpMicroscopeScaleX));
        gain[1].add((printed.kappa - problem.truth.kappa1) / result.sigma(vpMicroscopeKappa1));
      }
      else {
        ++failed;
      }
    }
  }
  WARN("NEES of (scale, kappa1, rotation, tx, ty) over "
       << problems << " problems: " << nees.mean() << " (expected 5)"
       << "; mean and rms of error over sigma: scale " << scale.mean() << ", " << scale.rms() << "; kappa1 "
       << kappa.mean() << ", " << kappa.rms() << "; rotation " << rotation.mean() << ", " << rotation.rms()
       << "; variance factor " << factor.mean() << ". As printed: rms error over our sigma: scale " << gain[0].rms()
       << ", kappa1 " << gain[1].rms() << "; scale wrong by more than 10 % in " << failed << " of "
       << gain[0].n + failed);
  const double tolerance = 5. / std::sqrt(1. * problems);
  CHECK(nees.mean() == Approx(5.).margin(std::sqrt(10.) * tolerance));
  CHECK(std::abs(scale.mean()) < tolerance);
  CHECK(std::abs(kappa.mean()) < tolerance);
  CHECK(std::abs(rotation.mean()) < tolerance);
  CHECK(scale.rms() == Approx(1.).margin(tolerance));
  CHECK(kappa.rms() == Approx(1.).margin(tolerance));
  CHECK(factor.mean() == Approx(1.).margin(0.02));
  CHECK(gain[0].rms() > 1.3);
  CHECK(gain[1].rms() > 1.2);
}

TEST_CASE("the result is the minimum, in every direction", "[calibration]")
{
  auto rng = vpTestSupport::generator(512);
  CAPTURE(vpTestSupport::seed());
  for (int trial = 0; trial < 40; ++trial) {
    Problem problem = randomProblem(rng, 1, uniform(rng, 1e-7, 3e-7));
    problem.views[0].tx *= 0.1; // the origin in view
    problem.views[0].ty *= 0.1;
    problem.truth = problem.views[0];
    const Points points = pointsOf(problem, 0, 0.1, 0.05, rng);
    vpMicroscopeCalibrationSpec spec;
    spec.estimateAspect = spec.estimatePrincipalPoint = true;
    vpPlanarMicroscopeCalibration calibration(640, 480, spec);
    calibration.addView(points);
    const vpMicroscopeCalibrationResult result = calibration.compute();
    CAPTURE(trial, result.message);
    REQUIRE(result.principalPointEstimated);
    const Parameters best = parametersOf(result.calibration);
    const double least = chi2Of(best, result.calibration.mirrored, points);
    // Along the eigenvectors of the covariance, a step of one deviation raises the sum of squares by one.
    const Parameters sigma = result.covariance.diagonal().cwiseSqrt();
    const Parameters unit = (sigma.array() > 0.).select(sigma, 1.); // the stretch is the aspect here
    const Eigen::Matrix<double, all, all> correlation =
        unit.cwiseInverse().asDiagonal() * result.covariance * unit.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, all, all>> solver(correlation);
    for (int i = 1; i < all; ++i) {
      const Parameters step = unit.asDiagonal() * solver.eigenvectors().col(i) * std::sqrt(solver.eigenvalues()[i]);
      for (const double sign : {1., -1.}) {
        CHECK(chi2Of(best + sign * step, result.calibration.mirrored, points) - least == Approx(1.).margin(0.03));
      }
    }
    CHECK(least == Approx(result.varianceFactor * result.degreesOfFreedom).epsilon(1e-9));
  }
}

TEST_CASE("the covariance also holds for points at the edge of the image", "[calibration]")
{
  auto rng = vpTestSupport::generator(522);
  CAPTURE(vpTestSupport::seed());
  for (int trial = 0; trial < 40; ++trial) { // off the centre, position and scale are correlated
    Problem problem = randomProblem(rng, 1, 0.);
    problem.views[0].tx *= 0.1;
    problem.views[0].ty *= 0.1;
    Points points;
    for (const vpCalibrationPoint &point : pointsOf(problem, 0, 0.1, 0.05, rng)) {
      if (point.u > 420.) {
        points.push_back(point);
      }
    }
    vpMicroscopeCalibrationSpec spec;
    spec.estimateKappa1 = false;
    vpPlanarMicroscopeCalibration calibration(640, 480, spec);
    calibration.addView(points);
    const vpMicroscopeCalibrationResult result = calibration.compute();
    const Parameters best = parametersOf(result.calibration);
    const double least = chi2Of(best, result.calibration.mirrored, points);
    const Parameters sigma = result.covariance.diagonal().cwiseSqrt();
    const Parameters unit = (sigma.array() > 0.).select(sigma, 1.);
    const Eigen::Matrix<double, all, all> correlation =
        unit.cwiseInverse().asDiagonal() * result.covariance * unit.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, all, all>> solver(correlation);
    int directions = 0;
    for (int i = 0; i < all; ++i) {
      if (solver.eigenvalues()[i] > 1e-9) { // the others were given
        const Parameters step = unit.asDiagonal() * solver.eigenvectors().col(i) * std::sqrt(solver.eigenvalues()[i]);
        CHECK(chi2Of(best + step, result.calibration.mirrored, points) - least == Approx(1.).margin(0.01));
        ++directions;
      }
    }
    CHECK(directions == 8); // scale, rotation, tx, ty, tilt
  }
}

TEST_CASE("kappa1 of a good lens is unobservable at 160 x 100 px, whatever the noise and however many frames",
          "[calibration]")
{
  auto rng = vpTestSupport::generator(515);
  CAPTURE(vpTestSupport::seed());
  int seen = 0, insignificant = 0, withoutEffect = 0;
  for (int trial = 0; trial < 400; ++trial) {
    // Table 7.4 (-6.72e-10 um^-2) and the 0.1 % at 200 px of a low-distortion lens.
    const double kappas[] = {-6.72e-10 * 4.5 * 4.5, 6.72e-10 * 4.5 * 4.5, 0.001 / (200. * 200.), 0.};
    const int views = trial % 10 == 0 ? 200 : 1 + trial % 5;
    const Problem problem = randomProblem(rng, views, kappas[trial % 4], 160, 100);
    const bool fine = trial % 2 == 0;
    vpPlanarMicroscopeCalibration calibration(160, 100);
    for (int k = 0; k < views; ++k) {
      calibration.addView(
          pointsOf(problem, static_cast<std::size_t>(k), fine ? 0.0153 : 0.18, fine ? 0.0078 : 0.035, rng));
    }
    const vpMicroscopeCalibrationResult result = calibration.compute();
    if (result.kappa1Status != vpKappa1Status::Unobservable) {
      ++seen;
      CHECK(std::abs(result.calibration.kappa1 - kappas[trial % 4]) < 5. * result.kappa1Sigma);
      continue;
    }
    CHECK(result.calibration.kappa1 == 0.);
    CHECK(result.kappa1Sigma > 0.);
    CHECK(result.covariance(vpMicroscopeKappa1, vpMicroscopeKappa1) == 0.);
    CHECK(result.message.find("The distortion kappa1 is unobservable and taken as 0: ") != std::string::npos);
    insignificant += result.message.find("standard deviations from zero, less than 5") != std::string::npos ? 1 : 0;
    withoutEffect += result.message.find("would move the worst corner by ") != std::string::npos ? 1 : 0;
  }
  CHECK(seen <= 4); // 2.5e-8 is 2.5 deviations below the threshold in some fine views: 0.3 expected
  CHECK(insignificant > 0);
  CHECK(withoutEffect > 0); // significant with 200 frames, but irrelevant
  // A lens ten times as bad as that shows its distortion over the whole sensor, and in many fine frames in the window.
  for (const unsigned int width : {640U, 160U}) {
    const Problem problem = randomProblem(rng, 60, 0.01 / (200. * 200.), width, width == 640U ? 480U : 100U);
    vpPlanarMicroscopeCalibration calibration(width, width == 640U ? 480U : 100U);
    for (std::size_t k = 0; k < 60; ++k) {
      calibration.addView(pointsOf(problem, k, 0.0153, 0.0078, rng));
    }
    const vpMicroscopeCalibrationResult result = calibration.compute();
    CAPTURE(result.message);
    CHECK(result.kappa1Status == vpKappa1Status::Estimated);
    CHECK(result.calibration.kappa1 == Approx(2.5e-7).margin(5. * result.kappa1Sigma));
  }
}

TEST_CASE("noise alone is taken for distortion in less than one of a thousand views", "[calibration]")
{
  auto rng = vpTestSupport::generator(516);
  CAPTURE(vpTestSupport::seed());
  int wrong = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Problem problem = randomProblem(rng, 1, 0., 320, 240);
    vpPlanarMicroscopeCalibration calibration(320, 240);
    calibration.addView(pointsOf(problem, 0, 0.5, 0.5, rng));
    wrong += calibration.compute().kappa1Status == vpKappa1Status::Estimated ? 1 : 0;
  }
  CHECK(wrong <= 1);
}

TEST_CASE("unknown deviations come from the residuals, a product that is not exact from sigmaPlane", "[calibration]")
{
  auto rng = vpTestSupport::generator(517);
  CAPTURE(vpTestSupport::seed());
  Moments byResiduals, byPlane;
  for (int trial = 0; trial < 400; ++trial) {
    const Problem problem = randomProblem(rng, 1, 0., 640, 480);
    Points points = pointsOf(problem, 0, 0.1, 0.1, rng);
    vpMicroscopeCalibrationSpec spec;
    spec.estimateKappa1 = false;
    spec.sigmaFromResiduals = true;
    vpPlanarMicroscopeCalibration first(640, 480, spec);
    for (vpCalibrationPoint &point : points) {
      point.sigmaU = point.sigmaV = 3.; // invalid
    }
    first.addView(points);
    const vpMicroscopeCalibrationResult a = first.compute();
    CHECK(a.kappa1Status == vpKappa1Status::NotAsked);
    CHECK(a.message.find("The distortion was not asked for.") != std::string::npos);
    byResiduals.add((a.calibration.scaleX - problem.truth.scaleX) / a.sigma(vpMicroscopeScaleX));

    std::normal_distribution<double> normal;
    for (vpCalibrationPoint &point : points) {
      point.sigmaU = point.sigmaV = 0.1;
      point.sigmaPlane = 1e-6;
      point.x += 1e-6 * normal(rng);
      point.y += 1e-6 * normal(rng);
    }
    spec.sigmaFromResiduals = false;
    vpPlanarMicroscopeCalibration second(640, 480, spec);
    second.addView(points);
    const vpMicroscopeCalibrationResult b = second.compute();
    // Times its degrees of freedom it is a chi-squared: in 400 trials 5.5 deviations are left once in 1e4 runs.
    CHECK(b.varianceFactor == Approx(1.).margin(5.5 * std::sqrt(2. / (2. * static_cast<double>(points.size()) - 8.))));
    byPlane.add((b.calibration.scaleX - problem.truth.scaleX) / b.sigma(vpMicroscopeScaleX));
  }
  CHECK(byResiduals.rms() == Approx(1.).margin(0.2));
  CHECK(byPlane.rms() == Approx(1.).margin(0.2));
}

TEST_CASE("two rows of cells, which lie on a conic, are enough", "[calibration]")
{
  auto rng = vpTestSupport::generator(518);
  CAPTURE(vpTestSupport::seed());
  for (int trial = 0; trial < 100; ++trial) {
    Problem problem = randomProblem(rng, 1, 0.);
    problem.truth.tx *= 0.1;
    problem.truth.ty *= 0.1;
    std::normal_distribution<double> normal;
    Points points;
    for (int row = 0; row < 2; ++row) {
      for (int column = 0; column < 3; ++column) {
        vpCalibrationPoint point;
        point.x = column * 220e-6;
        point.y = row * 80e-6;
        const Eigen::Vector2d seen = problem.truth.toImage(point.x, point.y);
        point.u = seen.x() + 0.01 * normal(rng);
        point.v = seen.y() + 0.01 * normal(rng);
        point.sigmaU = point.sigmaV = 0.01;
        points.push_back(point);
      }
    }
    for (const bool tilt : {true, false}) { // with tilt six points far from the centre give little information
      vpMicroscopeCalibrationSpec spec;
      spec.estimateTilt = tilt;
      vpPlanarMicroscopeCalibration calibration(640, 480, spec);
      calibration.addView(points);
      const vpMicroscopeCalibrationResult result = calibration.compute();
      CAPTURE(result.message);
      const double error = result.calibration.scaleX - problem.truth.scaleX;
      CHECK(std::abs(error) < (tilt ? 5. * result.sigma(vpMicroscopeScaleX) : 1e-3 * problem.truth.scaleX));
      CHECK(result.calibration.mirrored == problem.truth.mirrored);
    }
  }
}

TEST_CASE("bad input to the planar calibration is refused in words", "[calibration]")
{
  auto rng = vpTestSupport::generator(520);
  CAPTURE(vpTestSupport::seed());
  const Problem problem = randomProblem(rng, 2, 0.);
  const Points good = pointsOf(problem, 0, 0., 0., rng);
  const auto refusalOf = [&](const std::function<void(Points &)> &spoil) -> std::string {
    Points points = good;
    spoil(points);
    vpPlanarMicroscopeCalibration calibration(640, 480);
    calibration.addView(good);
    try {
      calibration.addView(points);
      static_cast<void>(calibration.compute());
    }
    catch (const vpException &error) {
      return error.getStringMessage();
    }
    return "accepted";
  };
  CHECK(refusalOf([](Points &p) { p.resize(5); }) == "view 1 has 5 points, must have at least 6");
  CHECK(refusalOf([](Points &p) { p.clear(); }) == "view 1 has 0 points, must have at least 6");
  CHECK(refusalOf([](Points &p) { p[3].u = NAN; }) == "point 3 of view 1: u is nan, must be finite");
  CHECK(refusalOf([](Points &p) { p[2].y = HUGE_VAL; }) == "point 2 of view 1: y is inf, must be finite");
  CHECK(refusalOf([](Points &p) { p[0].sigmaV = 0.; }) == "point 0 of view 1: sigmaV is 0 px, must be > 0");
  CHECK(refusalOf([](Points &p) { p[0].sigmaU = NAN; }) == "point 0 of view 1: sigmaU is nan px, must be > 0");
  CHECK(refusalOf([](Points &p) { p[0].sigmaPlane = -1.; }) == "point 0 of view 1: sigmaPlane is -1 m, must be >= 0");
  CHECK(refusalOf([](Points &p) { p[1].z = 0.1; }) == "point 1 of view 1: z is 0.1 m, must be 0");
  CHECK(refusalOf([](Points &p) {
          for (vpCalibrationPoint &point : p) {
            point.y = 2. * point.x;
          }
        }) == "the points of view 1 lie on a line of the product");
  CHECK(refusalOf([](Points &p) {
          for (vpCalibrationPoint &point : p) {
            point.v = 100.;
          }
        }) == "the points of view 1 lie on a line of the image");
  CHECK(refusalOf([](Points &p) {
          for (vpCalibrationPoint &point : p) {
            point.x = point.y = 0.;
          }
        }) == "the points of view 1 lie on a line of the product");
  const std::string mirrored = refusalOf([](Points &p) {
    for (vpCalibrationPoint &point : p) {
      point.y = -point.y;
    }
  });
  CHECK(mirrored.find("view 1 shows the product ") == 0);

  CHECK(refusalOf([](Points &p) { // two positions, repeated
          for (std::size_t i = 0; i < p.size(); ++i) {
            p[i] = p[i % 2];
          }
        }) == "the points of view 1 lie on a line of the product");
  CHECK_THROWS_WITH(vpPlanarMicroscopeCalibration(0, 0),
                    Catch::Contains("width of the calibration is 0 px, must be 8..65536"));
  CHECK_THROWS_WITH(vpPlanarMicroscopeCalibration(640, 480).compute(),
                    Catch::Contains("there is no view to calibrate from"));
  CHECK_THROWS_WITH(vpPlanarMicroscopeCalibration(640, 4),
                    Catch::Contains("height of the calibration is 4 px, must be 8..65536"));
  vpMicroscopeCalibrationSpec spec;
  spec.aspect = 0.;
  CHECK_THROWS_WITH(vpPlanarMicroscopeCalibration(640, 480, spec),
                    Catch::Contains("aspect of the calibration is 0, must be 0.1..10"));
  spec = vpMicroscopeCalibrationSpec();
  spec.u0 = HUGE_VAL;
  CHECK_THROWS_WITH(vpPlanarMicroscopeCalibration(640, 480, spec), Catch::Contains("u0 is inf px, must be within"));
  spec = vpMicroscopeCalibrationSpec();
  spec.minEffect = -1.;
  CHECK_THROWS_WITH(vpPlanarMicroscopeCalibration(640, 480, spec),
                    Catch::Contains("minEffect of the calibration is -1 px"));
  spec = vpMicroscopeCalibrationSpec();
  spec.minSignificance = NAN;
  CHECK_THROWS_WITH(vpPlanarMicroscopeCalibration(640, 480, spec),
                    Catch::Contains("minSignificance of the calibration is nan"));
  CHECK(std::string(vpToString(vpKappa1Status::Unobservable)) == "Unobservable");
}
