/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include <visp3/core/vpExponentialMap.h>
#include <visp3/direct_core/vpSO3.h>
#include "lab/servo/vpServoExperiment.h"
#include "lab/servo/vpServoSensor.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

VISP_DIRECT_USING_NAMESPACE

namespace
{
// A view of the task's object, completely in the image.
vpHomogeneousMatrix randomView(std::mt19937_64 &rng)
{
  std::uniform_real_distribution<double> unit(-1., 1.);
  return vpHomogeneousMatrix(0.03 * unit(rng), 0.02 * unit(rng), 0.55 + 0.08 * unit(rng), 0.5 * unit(rng),
                             0.5 * unit(rng), unit(rng));
}

// Difference of two poses as a vector: translation, m, then rotation, rad.
Eigen::Matrix<double, 6, 1> poseError(const vpHomogeneousMatrix &measured, const vpHomogeneousMatrix &truth)
{
  const vpColVector v = vpExponentialMap::inverse(measured * truth.inverse());
  Eigen::Matrix<double, 6, 1> e;
  e << v[0], v[1], v[2], v[3], v[4], v[5];
  return e;
}

// The least covariance that any unbiased estimate can have (Cramer-Rao), by finite differences of the projection.
Eigen::Matrix<double, 6, 6> smallestCovariance(const vpServoSensor &sensor, const vpHomogeneousMatrix &cMo,
                                               double sigma)
{
  const std::size_t n = sensor.goal(cMo).points.size();
  Eigen::MatrixXd J(2 * n, 6);
  for (unsigned int k = 0; k < 6; ++k) {
    vpColVector d(6);
    d[k] = 1e-6;
    const auto plus = sensor.goal(vpExponentialMap::direct(d) * cMo).points;
    const auto minus = sensor.goal(vpExponentialMap::direct(-d) * cMo).points;
    for (std::size_t i = 0; i < n; ++i) {
      J(2 * i, k) = (plus[i].x - minus[i].x) / 2e-6;
      J(2 * i + 1, k) = (plus[i].y - minus[i].y) / 2e-6;
    }
  }
  return sigma * sigma * (J.transpose() * J).inverse();
}
} // namespace

TEST_CASE("without noise the pose is exact and the points are those of the goal there", "[sensor]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  const vpServoTask task = vpServoTask::thesis();
  const auto sensor = vpServoSensor::points(task, 0., 1);
  vpServoMeasurement m;
  for (int i = 0; i < 200; ++i) {
    const vpHomogeneousMatrix cMo = randomView(rng);
    sensor->measure(cMo, 0.25, m);
    REQUIRE(m.valid);
    REQUIRE(m.time == 0.25);
    REQUIRE(poseError(m.cMo, cMo).norm() < 1e-9);
    const vpServoGoal goal = sensor->goal(cMo);
    REQUIRE(m.points.size() == task.pointCount);
    for (std::size_t k = 0; k < m.points.size(); ++k) {
      REQUIRE(m.points[k].visible);
      REQUIRE(m.points[k].x == Approx(goal.points[k].x).margin(1e-12));
      REQUIRE(m.points[k].Z == Approx(goal.points[k].Z).margin(1e-9));
    }
    // Corners, top left first, then clockwise as seen.
    const double x[] = {-0.09, 0.09, 0.09, -0.09}, y[] = {-0.09, -0.09, 0.09, 0.09};
    for (unsigned int k = 0; k < 4; ++k) {
      const double Z = cMo[2][0] * x[k] + cMo[2][1] * y[k] + cMo[2][3];
      REQUIRE(m.outline[k].x == Approx((cMo[0][0] * x[k] + cMo[0][1] * y[k] + cMo[0][3]) / Z).margin(1e-8));
      REQUIRE(m.outline[k].y == Approx((cMo[1][0] * x[k] + cMo[1][1] * y[k] + cMo[1][3]) / Z).margin(1e-8));
    }
  }
}

TEST_CASE("the pose from noisy points is as good as the Cramer-Rao bound allows", "[sensor]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  const double noise = 0.5;
  const vpServoTask task = vpServoTask::thesis();
  for (int view = 0; view < 4; ++view) {
    const vpHomogeneousMatrix cMo = view == 0 ? task.initial : randomView(rng);
    const auto sensor = vpServoSensor::points(task, noise, 100 + view);
    const Eigen::Matrix<double, 6, 6> bound = smallestCovariance(*sensor, cMo, noise / task.camera.get_px());
    Eigen::Matrix<double, 6, 6> found = Eigen::Matrix<double, 6, 6>::Zero();
    const int frames = 1500;
    vpServoMeasurement m;
    for (int i = 0; i < frames; ++i) {
      sensor->measure(cMo, 0., m);
      REQUIRE(m.valid);
      const auto e = poseError(m.cMo, cMo);
      found += e * e.transpose() / frames;
    }
    for (int k = 0; k < 6; ++k) {
      CAPTURE(view, k, std::sqrt(bound(k, k)));
      CHECK(std::sqrt(found(k, k) / bound(k, k)) == Approx(1.).epsilon(0.08)); // 1500 frames tell it to 2 %
    }
  }
}

TEST_CASE("points outside the picture are not visible, and too few give no pose", "[sensor]")
{
  vpServoTask task = vpServoTask::thesis();
  const auto sensor = vpServoSensor::points(task, 0., 1);
  vpServoMeasurement m;
  int seenBefore = static_cast<int>(task.pointCount), lastValid = 0, lostAt = 0;
  for (double x = 0.; x < 0.35; x += 0.005) { // the object leaves to the right
    const vpHomogeneousMatrix cMo(x, 0., 0.47, 0., 0., 0.);
    sensor->measure(cMo, 0., m);
    int seen = 0;
    const auto all = sensor->goal(cMo).points;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double u = 320. + 800. * all[i].x;
      REQUIRE(m.points[i].visible == (u <= 639.));
      seen += m.points[i].visible;
    }
    REQUIRE(seen <= seenBefore);
    seenBefore = seen;
    if (m.valid) {
      REQUIRE(seen >= 4);
      REQUIRE(poseError(m.cMo, cMo).norm() < 1e-7);
      lastValid = seen;
    }
    else if (lostAt == 0) {
      lostAt = seen;
    }
  }
  CHECK(seenBefore == 0);
  CHECK(lastValid <= 8);     // a handful suffices ...
  CHECK(lostAt < lastValid); // ... and once lost it stays lost here

  // A crowd of points in a strip along the border is close to a line: no homography, whatever their number.
  task.pointCount = 3000;
  const auto strip = vpServoSensor::points(task, 0., 1);
  const vpHomogeneousMatrix cMo((320. + 150.) / 800. * 0.47, 0., 0.47, 0., 0., 0.); // 3 px of it are left
  strip->measure(cMo, 0., m);
  CHECK(std::count_if(m.points.begin(), m.points.end(), [](const vpServoPoint &p) { return p.visible; }) > 10);
  CHECK_FALSE(m.valid);
}

TEST_CASE("the covariance of the points' pose is that of its errors", "[sensor][covariance]")
{
  auto rng = vpTestSupport::generator(5);
  CAPTURE(vpTestSupport::seed());
  const vpServoTask task = vpServoTask::thesis();
  const auto sensor = vpServoSensor::points(task, 0.5, vpTestSupport::seed());
  vpServoMeasurement m;
  double sum = 0.;
  const int views = 2000;
  for (int i = 0; i < views; ++i) {
    const vpHomogeneousMatrix cMo = randomView(rng);
    sensor->measure(cMo, 0., m);
    REQUIRE(m.valid);
    REQUIRE(m.covariance.known);
    Eigen::Matrix3d truth, measured;
    Eigen::Matrix<double, 6, 1> e;
    for (unsigned int r = 0; r < 3; ++r) {
      e[r] = cMo[r][3] - m.cMo[r][3];
      for (unsigned int c = 0; c < 3; ++c) {
        truth(r, c) = cMo[r][c];
        measured(r, c) = m.cMo[r][c];
      }
    }
    e.tail<3>() = vpSO3::log(truth * measured.transpose());
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> C(m.covariance.C.data());
    sum += e.dot(C.ldlt().solve(e));
  }
  // Chi squared with 6 degrees: mean 6, variance 12; five standard deviations of the mean.
  CHECK(std::abs(sum / views - 6.) < 5. * std::sqrt(12. / views));
  CHECK_FALSE(vpServoMeasurement().covariance.known);
}

TEST_CASE("the object is the same for every seed, the noise is not", "[sensor]")
{
  const vpServoTask task = vpServoTask::thesis();
  const auto a = vpServoSensor::points(task, 0.5, 1), again = vpServoSensor::points(task, 0.5, 1),
             other = vpServoSensor::points(task, 0.5, 2);
  const auto goal = a->goal(task.initial).points, otherGoal = other->goal(task.initial).points;
  double sum = 0., squares = 0.;
  int count = 0;
  for (int frame = 0; frame < 400; ++frame) {
    vpServoMeasurement ma, mb, mc;
    a->measure(task.initial, 0., ma);
    again->measure(task.initial, 0., mb);
    other->measure(task.initial, 0., mc);
    for (std::size_t i = 0; i < goal.size(); ++i) {
      REQUIRE((goal[i].x == otherGoal[i].x && goal[i].y == otherGoal[i].y));
      REQUIRE((ma.points[i].x == mb.points[i].x && ma.points[i].y == mb.points[i].y));
      REQUIRE(ma.points[i].x != mc.points[i].x);
      const double du = 800. * (ma.points[i].x - goal[i].x), dv = 800. * (ma.points[i].y - goal[i].y);
      sum += du + dv;
      squares += du * du + dv * dv;
      count += 2;
    }
  }
  CHECK(std::sqrt(squares / count) == Approx(0.5).epsilon(0.02));
  CHECK(std::fabs(sum / count) < 0.02);
}

TEST_CASE("A goal that is measured in a view with noise is off by the noise of that view", "[sensor]")
{
  CAPTURE(vpTestSupport::seed());
  vpServoRunSpec spec;
  spec.law = "pbvs1";
  spec.gains.lambda = 4.; // there after 2 s
  for (vpServoSegment &segment : spec.task.segments) {
    segment.duration = 3.;
  }
  spec.noisyReference = true;
  CHECK(runServoExperiment(spec).metrics.end_rotation_deg < 0.01); // without noise nothing changes
  spec.plant.pixelNoise = 4.;
  // The error of the goal, and of one view; what is left of all views is less, as the motion averages over them.
  double exact = 0., measured = 0., one = 0.;
  constexpr int runs = 4;
  for (unsigned int seed = 1; seed <= runs; ++seed) {
    spec.seed = vpTestSupport::seed() + seed;
    for (const bool noisy : {false, true}) {
      spec.noisyReference = noisy;
      const vpServoRun run = runServoExperiment(spec);
      (noisy ? measured : exact) += std::pow(run.samples.back().rotationError, 2) / runs;
      one += noisy ? std::pow(run.samples.back().rotationDeviation, 2) / runs : 0.;
    }
  }
  CAPTURE(std::sqrt(exact), std::sqrt(measured), std::sqrt(one));
  CHECK(measured > 4. * exact);
  CHECK(std::sqrt(measured) < 3. * std::sqrt(one));
  CHECK(std::sqrt(measured) > std::sqrt(one) / 3.);
}
