/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Tsai's calibration of bodies and planes against random truths and ViSP's vpCalibration; correct covariance;
// unobservable parameters are not reported; invalid input.
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpImagePoint.h>
#include <visp3/pattern/vpTsaiCalibration.h>
#include <visp3/vision/vpCalibration.h>

#include <Eigen/Dense>

#include <cmath>
#include <functional>
#include <iostream>
#include <sstream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using Points = std::vector<vpCalibrationPoint>;

using vpTestSupport::uniform;

struct Camera {
  double px = 700., py = 700., u0 = 319.5, v0 = 239.5, kappa1 = 0.;

  // Bisection on the radius: an oracle for the inverse of (4.5).
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d &p) const
  {
    const Eigen::Vector2d ideal = px * p.head<2>() / p.z();
    double low = 0., high = 2. * ideal.norm() + 1.;
    for (int i = 0; i < 200; ++i) {
      const double r = 0.5 * (low + high);
      (r * (1. + kappa1 * r * r) < ideal.norm() ? low : high) = r;
    }
    const Eigen::Vector2d d = ideal.norm() > 0. ? Eigen::Vector2d(low / ideal.norm() * ideal) : ideal;
    return {u0 + d.x(), v0 + py / px * d.y()};
  }
};

vpHomogeneousMatrix randomPose(std::mt19937_64 &rng, double leastTilt, double mostTilt)
{
  const double tilt = uniform(rng, leastTilt, mostTilt), way = uniform(rng, -M_PI, M_PI);
  const vpHomogeneousMatrix lean(0., 0., 0., tilt * std::cos(way), tilt * std::sin(way), 0.);
  const vpHomogeneousMatrix turn(0., 0., 0., 0., 0., uniform(rng, -M_PI, M_PI));
  const vpHomogeneousMatrix place(uniform(rng, -0.05, 0.05), uniform(rng, -0.05, 0.05), uniform(rng, 0.6, 0.8), 0., 0.,
                                  0.);
  return place * lean * turn;
}

// A plane of 8 x 8 points over 0.28 m, or that with half of the points raised: a body.
Points pointsOf(const Camera &camera, const vpHomogeneousMatrix &cMo, bool body, double sigma, std::mt19937_64 &rng)
{
  std::normal_distribution<double> normal;
  Points points;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      vpCalibrationPoint point;
      point.x = 0.04 * (column - 3.5);
      point.y = 0.04 * (row - 3.5);
      point.z = body && (row + column) % 2 == 0 ? -0.02 * (1 + (row * 3 + column) % 5) : 0.;
      const vpColVector p = cMo * vpColVector({point.x, point.y, point.z, 1.});
      const Eigen::Vector2d seen = camera.project({p[0], p[1], p[2]});
      point.u = seen.x() + sigma * normal(rng);
      point.v = seen.y() + sigma * normal(rng);
      point.sigmaU = point.sigmaV = sigma > 0. ? sigma : 1.;
      points.push_back(point);
    }
  }
  return points;
}

Camera randomCamera(std::mt19937_64 &rng)
{
  Camera camera;
  camera.px = uniform(rng, 500., 1100.);
  camera.py = camera.px * uniform(rng, 0.97, 1.03);
  camera.u0 += uniform(rng, -15., 15.);
  camera.v0 += uniform(rng, -15., 15.);
  camera.kappa1 = uniform(rng, -2e-7, 4e-7);
  return camera;
}

double difference(const vpHomogeneousMatrix &a, const vpHomogeneousMatrix &b)
{
  double worst = 0.;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 4; ++j) {
      worst = std::max(worst, std::abs(a[i][j] - b[i][j]));
    }
  }
  return worst;
}

//! \brief Result of a scenario of the test.
struct Scene {
  Camera camera;
  std::vector<vpHomogeneousMatrix> poses;
  std::vector<Points> views;
};

enum class Kind { Body, Plane, Planes };

Scene randomScene(Kind kind, double sigma, std::mt19937_64 &rng)
{
  Scene scene;
  scene.camera = randomCamera(rng);
  if (kind == Kind::Plane) { // aspect and principal point are unobservable in one view of a plane
    scene.camera.py = scene.camera.px;
    scene.camera.u0 = 319.5;
    scene.camera.v0 = 239.5;
  }
  for (int k = 0; k < (kind == Kind::Planes ? 5 : 1); ++k) {
    scene.poses.push_back(randomPose(rng, 0.35, 0.7));
    scene.views.push_back(pointsOf(scene.camera, scene.poses.back(), kind == Kind::Body, sigma, rng));
  }
  return scene;
}

vpTsaiCalibrationResult calibrate(const Scene &scene)
{
  vpTsaiCalibration calibration(640, 480);
  for (const Points &points : scene.views) {
    calibration.addView(points);
  }
  return calibration.compute();
}

// ViSP's result for the same points, with its reports on std::cout muted.
bool calibrateByViSP(const Scene &scene, vpCameraParameters &camera)
{
  std::ostringstream sink;
  std::streambuf *const out = std::cout.rdbuf(sink.rdbuf());
  std::streambuf *const err = std::cerr.rdbuf(sink.rdbuf());
  bool good = false;
  try {
    camera.initPersProjWithDistortion(800., 800., 319.5, 239.5, 0., 0.);
    std::vector<vpCalibration> table;
    for (const Points &points : scene.views) {
      vpCalibration calibration;
      calibration.clearPoint();
      for (const vpCalibrationPoint &p : points) {
        vpImagePoint place(p.v, p.u);
        calibration.addPoint(p.x, p.y, p.z, place);
      }
      table.push_back(calibration);
    }
    double residual = 0.;
    if (table.size() == 1) {
      vpHomogeneousMatrix cMo;
      good = table[0].computeCalibration(vpCalibration::CALIB_LAGRANGE_VIRTUAL_VS_DIST, cMo, camera, false) == 0;
    }
    else {
      // Lagrange's closed form needs a body.
      good = vpCalibration::computeCalibrationMulti(vpCalibration::CALIB_VIRTUAL_VS_DIST, table, camera, residual,
                                                    false) == 0;
    }
  }
  catch (const vpException &) {
  }
  std::cout.rdbuf(out);
  std::cerr.rdbuf(err);
  return good && std::isfinite(camera.get_px());
}
} // namespace

TEST_CASE("without noise bodies, a plane and planes give the camera exactly", "[calibration][tsai]")
{
  auto rng = vpTestSupport::generator(530);
  CAPTURE(vpTestSupport::seed());
  for (int trial = 0; trial < 300; ++trial) {
    const Kind kind = static_cast<Kind>(trial % 3);
    const Scene scene = randomScene(kind, 0., rng);
    const vpTsaiCalibrationResult result = calibrate(scene);
    CAPTURE(trial, result.message, scene.camera.px, scene.camera.py, scene.camera.kappa1);
    REQUIRE(result.converged);
    REQUIRE(result.residualRms < 1e-5);
    REQUIRE(result.px == Approx(scene.camera.px).epsilon(1e-6));
    REQUIRE(result.py == Approx(scene.camera.py).epsilon(1e-6));
    REQUIRE(result.u0 == Approx(scene.camera.u0).margin(1e-3));
    REQUIRE(result.v0 == Approx(scene.camera.v0).margin(1e-3));
    REQUIRE(result.kappa1 == Approx(scene.camera.kappa1).margin(1e-11));
    for (std::size_t k = 0; k < scene.poses.size(); ++k) {
      REQUIRE(difference(result.cMo[k], scene.poses[k]) < 1e-5);
    }
  }
}

TEST_CASE("an origin that is seen at the principal point is no trouble", "[calibration][tsai]")
{
  auto rng = vpTestSupport::generator(531); // (4.9) divides by ty
  CAPTURE(vpTestSupport::seed());
  for (int trial = 0; trial < 100; ++trial) {
    Scene scene;
    scene.camera.kappa1 = 1e-7;
    vpHomogeneousMatrix cMo = randomPose(rng, 0.35, 0.7);
    cMo[0][3] = cMo[1][3] = 0.;
    scene.poses.push_back(cMo);
    scene.views.push_back(pointsOf(scene.camera, cMo, trial % 2 == 0, 0., rng));
    const vpTsaiCalibrationResult result = calibrate(scene);
    CAPTURE(trial, result.message);
    CHECK(result.px == Approx(700.).epsilon(1e-6));
    CHECK(difference(result.cMo[0], cMo) < 1e-5);
  }
}

TEST_CASE("the camera has the errors that the covariance says", "[calibration][tsai]")
{
  auto rng = vpTestSupport::generator(532);
  CAPTURE(vpTestSupport::seed());
  constexpr int problems = 1000;
  for (const Kind kind : {Kind::Body, Kind::Plane, Kind::Planes}) {
    const std::vector<int> index = kind == Kind::Plane
                                       ? std::vector<int>{vpTsaiPx, vpTsaiKappa1}
                                       : std::vector<int>{vpTsaiPx, vpTsaiPy, vpTsaiKappa1, vpTsaiU0, vpTsaiV0};
    const auto n = static_cast<Eigen::Index>(index.size());
    double nees = 0., factor = 0.;
    int unreliable = 0;
    for (int trial = 0; trial < problems; ++trial) {
      const Scene scene = randomScene(kind, 0.05, rng);
      const vpTsaiCalibrationResult result = calibrate(scene);
      unreliable += result.reliable ? 0 : 1;
      const double truth[] = {scene.camera.px, scene.camera.py, scene.camera.kappa1, scene.camera.u0, scene.camera.v0};
      const double found[] = {result.px, result.py, result.kappa1, result.u0, result.v0};
      Eigen::VectorXd e(n);
      Eigen::MatrixXd C(n, n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const int a = index[static_cast<std::size_t>(i)];
        e[i] = (found[a] - truth[a]) / result.sigma(static_cast<vpTsaiParameter>(a));
        for (Eigen::Index j = 0; j < n; ++j) {
          const int b = index[static_cast<std::size_t>(j)];
          C(i, j) = result.covariance(a, b) /
                    (result.sigma(static_cast<vpTsaiParameter>(a)) * result.sigma(static_cast<vpTsaiParameter>(b)));
        }
      }
      nees += e.dot(C.ldlt().solve(e)) / problems;
      factor += result.varianceFactor / problems;
    }
    WARN((kind == Kind::Body    ? "body"
          : kind == Kind::Plane ? "one plane"
                                : "five planes")
         << ": NEES " << nees << " (expected " << n << ") over " << problems << " problems, variance factor " << factor
         << ", not reliable " << unreliable);
    CHECK(nees == Approx(static_cast<double>(n)).epsilon(0.12));
    CHECK(factor == Approx(1.).margin(0.02));
    CHECK(unreliable <= 30); // 10 +- 3.2 false alarms are expected
  }
}

TEST_CASE("beside ViSP's vpCalibration on the same points", "[calibration][tsai][visp]")
{
  auto rng = vpTestSupport::generator(533);
  CAPTURE(vpTestSupport::seed());
  for (const Kind kind : {Kind::Body, Kind::Planes}) {
    double ours = 0., visps = 0., oursPrincipal = 0., vispsPrincipal = 0.;
    int refused = 0, far = 0, n = 0;
    for (int trial = 0; trial < (kind == Kind::Body ? 100 : 15); ++trial) { // ViSP takes a second for five planes
      const Scene scene = randomScene(kind, 0.1, rng);
      const vpTsaiCalibrationResult result = calibrate(scene);
      vpCameraParameters visp;
      if (!calibrateByViSP(scene, visp)) {
        ++refused;
        continue;
      }
      if (std::abs(visp.get_px() / scene.camera.px - 1.) > 0.2) {
        ++far;
        continue;
      }
      ours += std::pow(result.px / scene.camera.px - 1., 2);
      visps += std::pow(visp.get_px() / scene.camera.px - 1., 2);
      oursPrincipal += std::pow(result.u0 - scene.camera.u0, 2) + std::pow(result.v0 - scene.camera.v0, 2);
      vispsPrincipal += std::pow(visp.get_u0() - scene.camera.u0, 2) + std::pow(visp.get_v0() - scene.camera.v0, 2);
      ++n;
    }
    REQUIRE(n > 0);
    WARN((kind == Kind::Body ? "body" : "five planes")
         << ", 0.1 px of noise, " << n << " scenes: rms error of px " << 100. * std::sqrt(ours / n) << " % (ViSP "
         << 100. * std::sqrt(visps / n) << " %), of the principal point " << std::sqrt(oursPrincipal / n)
         << " px (ViSP " << std::sqrt(vispsPrincipal / n) << " px); ViSP refused " << refused
         << " and was more than 20 % off in " << far);
    // Not worse: of two sums of m squares of independent normal errors of one size the logarithm of the ratio has a variance of
    // about 4 / m; errors on the same points are correlated and differ less. Five deviations.
    CHECK(ours <= std::exp(5. * std::sqrt(4. / n)) * visps);
    CHECK(oursPrincipal <= std::exp(5. * std::sqrt(2. / n)) * vispsPrincipal);
  }
}

TEST_CASE("a plane seen straight on says that it tells no focal length", "[calibration][tsai]")
{
  auto rng = vpTestSupport::generator(534);
  CAPTURE(vpTestSupport::seed());
  int reliable = 0, refused = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Scene scene;
    scene.camera.kappa1 = uniform(rng, 0., 2e-7);
    scene.poses.push_back(randomPose(rng, 0., 0.01));
    scene.views.push_back(pointsOf(scene.camera, scene.poses[0], false, 0.1, rng));
    try {
      const vpTsaiCalibrationResult result = calibrate(scene);
      reliable += result.reliable ? 1 : 0;
      CAPTURE(result.message);
      CHECK((result.reliable ||
             result.message.find("This is not reliable: the views do not tell the focal length") != std::string::npos));
    }
    catch (const vpException &) {
      ++refused;
    }
  }
  CHECK(reliable <= 2);
  CHECK(refused == 0);
}

TEST_CASE("bad input to Tsai's calibration is refused in words", "[calibration][tsai]")
{
  auto rng = vpTestSupport::generator(535);
  CAPTURE(vpTestSupport::seed());
  const Scene scene = randomScene(Kind::Body, 0., rng);
  const auto refusalOf = [&](const std::function<void(Points &)> &spoil) -> std::string {
    Points points = scene.views[0];
    spoil(points);
    vpTsaiCalibration calibration(640, 480);
    try {
      calibration.addView(points);
      return calibration.compute().reliable ? "reliable" : "not reliable";
    }
    catch (const vpException &error) {
      return error.getStringMessage();
    }
  };
  CHECK(refusalOf([](Points &p) { p.resize(5); }) == "view 0 has 5 points, must have at least 6");
  CHECK(refusalOf([](Points &p) { p = {p[0], p[1], p[2], p[8], p[9], p[10], p[17]}; }) ==
        "view 0 has 7 points that lie in no plane, must have at least 8");
  CHECK(refusalOf([](Points &p) { p[3].z = NAN; }) == "point 3 of view 0: z is nan, must be finite");
  CHECK(refusalOf([](Points &p) { p[4].sigmaU = -1.; }) == "point 4 of view 0: sigmaU is -1 px, must be > 0");
  CHECK(refusalOf([](Points &p) {
          for (vpCalibrationPoint &point : p) {
            point.y = point.z = point.x;
          }
        }) == "the points of view 0 lie on a line of the object");
  CHECK(refusalOf([](Points &p) {
          for (vpCalibrationPoint &point : p) {
            point.v = 10.;
          }
        }) == "the points of view 0 lie on a line of the image");
  CHECK(refusalOf([&](Points &p) { // all but one on a line
          p = pointsOf(Camera(), scene.poses[0], false, 0., rng);
          p = {p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[20]};
        }) == "the points of view 0 do not determine its pose: too many of them lie on a line");
  CHECK(refusalOf([](Points &p) { // a mirrored body
          for (vpCalibrationPoint &point : p) {
            point.x = -point.x;
          }
        }) != "reliable");
  CHECK(refusalOf([](Points &p) { // two positions, repeated
          for (std::size_t i = 0; i < p.size(); ++i) {
            p[i] = p[i % 2];
          }
        }) == "the points of view 0 lie on a line of the object");
  CHECK_THROWS_WITH(vpTsaiCalibration(0, 0), Catch::Contains("width of the calibration is 0 px, must be 8..65536"));
  CHECK_THROWS_WITH(vpTsaiCalibration(640, 480).compute(), Catch::Contains("there is no view to calibrate from"));
  CHECK_THROWS_WITH(vpTsaiCalibration(1, 480), Catch::Contains("width of the calibration is 1 px, must be 8..65536"));
  vpTsaiCalibrationSpec spec;
  spec.aspect = NAN;
  CHECK_THROWS_WITH(vpTsaiCalibration(640, 480, spec),
                    Catch::Contains("aspect of the calibration is nan, must be 0.1..10"));
}
