/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Against the Riccati equation, the information form, order of arrival, and consistency of the reported covariance.
#include "vpCatch.h"

#include <visp3/printing/vpMotionKalmanFilter.h>

#include <Eigen/Dense>

#include <algorithm>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using vpTestSupport::uniform;
double logUniform(std::mt19937_64 &rng, double low, double high)
{
  return std::exp(uniform(rng, std::log(low), std::log(high)));
}

//! Exact transition and noise of a chain of n integrators driven by white noise, by Van Loan's matrix exponential.
void discretise(int n, double q, double T, Eigen::MatrixXd &F, Eigen::MatrixXd &Q)
{
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    A(i, i + 1) = 1.;
  }
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(n, n);
  W(n - 1, n - 1) = q;
  Eigen::MatrixXd M(2 * n, 2 * n);
  M << -A, W, Eigen::MatrixXd::Zero(n, n), A.transpose();
  M *= T;
  Eigen::MatrixXd E = Eigen::MatrixXd::Identity(2 * n, 2 * n), term = E;
  for (int k = 1; k < 40; ++k) {
    term = (term * M / k).eval();
    E += term;
  }
  F = E.bottomRightCorner(n, n).transpose();
  Q = F * E.topRightCorner(n, n);
}

vpMotionKalmanSpec randomSpec(std::mt19937_64 &rng)
{
  vpMotionKalmanSpec spec;
  spec.model = uniform(rng, 0., 1.) < 0.5 ? vpMotionModel::ConstantVelocity : vpMotionModel::ConstantAcceleration;
  spec.processNoise = logUniform(rng, 1e-4, 1e-1);
  spec.sigmaPosition = 1.;
  spec.sigmaVelocity = 1.;
  spec.gate = std::numeric_limits<double>::infinity();
  return spec;
}
} // namespace

TEST_CASE("The steady state is the solution of the Riccati equation", "[kalman]")
{
  auto rng = vpTestSupport::generator(10);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 300; ++problem) {
    const vpMotionKalmanSpec spec = randomSpec(rng);
    const int n = spec.model == vpMotionModel::ConstantVelocity ? 2 : 3;
    const double T = uniform(rng, 0.5, 2.), sigma = logUniform(rng, 0.01, 1.);
    Eigen::MatrixXd F, Q;
    discretise(n, spec.processNoise, T, F, Q);
    Eigen::MatrixXd P = Eigen::MatrixXd::Identity(n, n); // predicted; iterate the equation
    for (int k = 0; k < 5000; ++k) {
      const Eigen::VectorXd K = P.col(0) / (P(0, 0) + sigma * sigma);
      P = F * (P - K * P.row(0)) * F.transpose() + Q;
    }
    vpMotionKalmanFilter filter(spec);
    for (int k = 1; k <= 600; ++k) {
      filter.add({vpMotionReadingKind::Position, k * T, 0., sigma});
    }
    const Eigen::MatrixXd found = filter.at(601. * T).covariance.topLeftCorner(n, n);
    CAPTURE(problem, n, T, sigma, spec.processNoise);
    REQUIRE((found - P).norm() < 1e-6 * P.norm());
  }
}

TEST_CASE("The stated uncertainty is that of the errors (NEES)", "[kalman]")
{
  auto rng = vpTestSupport::generator(11);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0., 1.);
  double sum[2] = {0., 0.};
  int count[2] = {0, 0};
  for (int problem = 0; problem < 3000; ++problem) {
    const vpMotionKalmanSpec spec = randomSpec(rng);
    const int n = spec.model == vpMotionModel::ConstantVelocity ? 2 : 3;
    Eigen::VectorXd x(n);
    x[0] = normal(rng) * spec.sigmaPosition;
    x[1] = normal(rng) * spec.sigmaVelocity;
    if (n == 3) {
      x[2] = normal(rng) * spec.sigmaAcceleration;
    }
    vpMotionKalmanFilter filter(spec);
    double t = 0., marked = x[0];
    filter.add({vpMotionReadingKind::Mark, 0., 0., 1.});
    for (int k = 0; k < 30; ++k) {
      const double T = uniform(rng, 0.3, 2.);
      Eigen::MatrixXd F, Q;
      discretise(n, spec.processNoise, T, F, Q);
      Eigen::VectorXd w(n);
      for (int i = 0; i < n; ++i) {
        w[i] = normal(rng);
      }
      x = F * x + Q.llt().matrixL() * w;
      t += T;
      const double sigma = logUniform(rng, 0.02, 0.5), kind = uniform(rng, 0., 1.);
      if (kind < 0.4) {
        filter.add({vpMotionReadingKind::Position, t, x[0] + sigma * normal(rng), sigma});
      }
      else if (kind < 0.8) {
        filter.add({vpMotionReadingKind::Displacement, t, x[0] - marked + sigma * normal(rng), sigma});
        marked = x[0];
      } // else: no measurement
    }
    const vpMotionEstimate e = filter.at(t);
    Eigen::VectorXd error(n);
    error[0] = e.position - x[0];
    error[1] = e.velocity - x[1];
    if (n == 3) {
      error[2] = e.acceleration - x[2];
    }
    sum[n - 2] += error.dot(e.covariance.topLeftCorner(n, n).ldlt().solve(error));
    ++count[n - 2];
  }
  for (int n = 2; n <= 3; ++n) { // chi square of n degrees each: mean n, standard deviation sqrt(2 n / count)
    CHECK(sum[n - 2] / count[n - 2] == Approx(n).margin(4. * std::sqrt(2. * n / count[n - 2])));
  }
}

TEST_CASE("Readings out of order give what they give in order", "[kalman]")
{
  auto rng = vpTestSupport::generator(12);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 1000; ++problem) {
    vpMotionKalmanSpec spec = randomSpec(rng);
    spec.maxDelay = 3.;
    std::vector<std::pair<double, vpMotionReading>> readings; // by arrival
    for (int k = 1; k < 40; ++k) {
      const double t = k + uniform(rng, -0.3, 0.3), delay = uniform(rng, 0., 2.8);
      readings.push_back({t + delay, {vpMotionReadingKind::Position, t, uniform(rng, -1., 1.), 0.2}});
    }
    vpMotionKalmanFilter ordered(spec), arriving(spec);
    for (const auto &r : readings) {
      REQUIRE(ordered.add(r.second) == vpMotionReadingResult::Used);
    }
    std::sort(readings.begin(), readings.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    for (const auto &r : readings) {
      REQUIRE(arriving.add(r.second) == vpMotionReadingResult::Used);
    }
    const vpMotionEstimate a = ordered.at(42.), b = arriving.at(42.);
    REQUIRE(a.position == Approx(b.position).margin(1e-8));
    REQUIRE(a.velocity == Approx(b.velocity).margin(1e-8));
    REQUIRE((a.covariance - b.covariance).norm() < 1e-8 * (1. + a.covariance.norm()));
    REQUIRE(arriving.add({vpMotionReadingKind::Position, 1., 0., 1.}) == vpMotionReadingResult::TooLate);
  }
}

TEST_CASE("Scale and offset of an encoder are found, its slip is followed", "[kalman]")
{
  auto rng = vpTestSupport::generator(13);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal(0., 1.);
  int withinScale = 0, withinOffset = 0, withinSlip = 0;
  constexpr int problems = 300;
  for (int problem = 0; problem < problems; ++problem) {
    vpMotionKalmanSpec spec;
    spec.processNoise = 1e-3;
    spec.encoderScaleSigma = 0.02;
    spec.encoderOffsetSigma = 3.;
    const double scale = 0.02 * normal(rng), offset = 3. * normal(rng);
    const bool slips = problem % 2 == 1;
    spec.encoderSlip = slips ? 0.05 : 0.;
    vpMotionKalmanFilter filter(spec);
    filter.reset(0., 0., 5.);
    double slipped = 0.;
    for (int k = 1; k < 300; ++k) {
      slipped += slips ? std::sqrt(0.05) * normal(rng) : 0.;
      const double truth = 5. * k + 20. * std::sin(0.05 * k);
      filter.add(
          {vpMotionReadingKind::Encoder, k + 0., truth * (1. + scale) + offset + slipped + 0.02 * normal(rng), 0.02});
      if (k % 4 == 0) { // the camera is slower and late
        filter.add({vpMotionReadingKind::Position, k - 1.28,
                    5. * (k - 1.28) + 20. * std::sin(0.05 * (k - 1.28)) + 0.05 * normal(rng), 0.05});
      }
    }
    const vpMotionEstimate e = filter.at(299.);
    withinScale += std::fabs(e.encoderScale - scale) < 3. * e.sigmaScale ? 1 : 0;
    withinOffset += std::fabs(e.encoderOffset - offset - slipped) < 3. * e.sigmaOffset ? 1 : 0;
    withinSlip += std::fabs(e.position - (5. * 299. + 20. * std::sin(0.05 * 299.))) < 4. * e.sigmaPosition ? 1 : 0;
    if (!slips) {
      CHECK(e.sigmaScale < 3e-4);
    }
  }
  CHECK(withinScale > 0.96 * problems);
  CHECK(withinOffset > 0.96 * problems);
  CHECK(withinSlip > 0.96 * problems);
}

TEST_CASE("The gate keeps outliers out and gives in when they persist", "[kalman]")
{
  vpMotionKalmanSpec spec;
  spec.processNoise = 1e-4;
  vpMotionKalmanFilter filter(spec);
  filter.reset(0., 0., 2.);
  for (int k = 1; k < 100; ++k) {
    const auto result = filter.add({vpMotionReadingKind::Position, k + 0., 2. * k + (k % 10 == 9 ? 15. : 0.), 0.05});
    CHECK(result == (k % 10 == 9 ? vpMotionReadingResult::Outlier : vpMotionReadingResult::Used));
  }
  CHECK(filter.outliers() == 10);
  CHECK(filter.at(99.).position == Approx(198.).margin(0.2));
  for (int k = 100; k < 130; ++k) { // the product was moved
    filter.add({vpMotionReadingKind::Position, k + 0., 2. * k + 15., 0.05});
  }
  CHECK(filter.at(129.).position == Approx(273.).margin(0.2));
}

TEST_CASE("A motion filter says what is wrong and does not allocate", "[kalman]")
{
  vpMotionKalmanSpec spec;
  spec.processNoise = 0.;
  CHECK_THROWS_WITH(vpMotionKalmanFilter(spec), Catch::Contains("processNoise of the motion filter is 0, must be > 0"));
  spec = vpMotionKalmanSpec();
  spec.gate = -1.;
  CHECK_THROWS_WITH(vpMotionKalmanFilter(spec), Catch::Contains("gate of the motion filter is -1, must be > 0"));
  spec = vpMotionKalmanSpec();
  spec.maxDelay = NAN;
  CHECK_THROWS_WITH(vpMotionKalmanFilter(spec), Catch::Contains("maxDelay of the motion filter is nan"));
  vpMotionKalmanFilter filter;
  CHECK(filter.add({vpMotionReadingKind::Position, NAN, 0., 1.}) == vpMotionReadingResult::Invalid);
  CHECK(filter.add({vpMotionReadingKind::Position, 0., 0., 0.}) == vpMotionReadingResult::Invalid);
  CHECK(filter.add({vpMotionReadingKind::Displacement, 0., 0., 1.}) == vpMotionReadingResult::NoMark);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 1; k < 500; ++k) {
    filter.add({vpMotionReadingKind::Position, k + (k % 3) * 0.9, 5. * k, 0.1});
    static_cast<void>(filter.at(k + 2.));
  }
  CHECK(vpTestSupport::allocationCount() == before);
}
