/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/printing/vpFrictionIdentification.h>
#include <visp3/printing/vpFrictionModel.h>

#include "vpPrintingCheck.h"

#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpTailProbability.h>

#include <Eigen/Dense>

#include <algorithm>

BEGIN_VISP_NAMESPACE

using namespace vpPrintingCheck;

double vpFrictionModel::friction(double velocity) const noexcept
{
  if (velocity == 0.) {
    return 0.;
  }
  const double ratio = velocity / stribeckVelocity;
  return viscous * velocity + std::copysign(coulomb + (stiction - coulomb) * std::exp(-ratio * ratio), velocity);
}

double vpFrictionModel::force(double velocity, double acceleration) const noexcept
{
  return mass * acceleration + friction(velocity);
}

void vpFrictionModel::validate(const char *owner) const
{
  positive("mass", owner, mass);
  notNegative("viscous", owner, viscous);
  notNegative("coulomb", owner, coulomb);
  notNegative("stiction", owner, stiction);
  positive("stribeckVelocity", owner, stribeckVelocity);
}

namespace
{
//! \brief Result of a robust linear fit.
struct Fit {
  Eigen::VectorXd x, weights, psi; // psi: the weighted residuals, which the regressors do not explain
  Eigen::MatrixXd covariance;
  double sigma = 0., cost = 0., condition = std::numeric_limits<double>::infinity();
};

// Median of absolute values times 1.4826: the standard deviation, if at least half of them are inliers.
double robustSigma(const Eigen::VectorXd &r)
{
  const Eigen::VectorXd a = r.cwiseAbs();
  return 1.4826 * vpMedian({a.data(), a.data() + a.size()});
}

double conditionOf(const Eigen::MatrixXd &A)
{
  Eigen::MatrixXd scaled = A;
  for (Eigen::Index k = 0; k < A.cols(); ++k) {
    const double norm = A.col(k).norm();
    if (!(norm > 0.)) {
      return std::numeric_limits<double>::infinity();
    }
    scaled.col(k) /= norm;
  }
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(scaled).singularValues();
  return values[values.size() - 1] > 0. ? values[0] / values[values.size() - 1]
                                        : std::numeric_limits<double>::infinity();
}

Eigen::VectorXd solveWeighted(const Eigen::MatrixXd &A, const Eigen::VectorXd &b, const Eigen::VectorXd &w)
{
  const Eigen::VectorXd root = w.cwiseSqrt();
  return (root.asDiagonal() * A).colPivHouseholderQr().solve(root.cwiseProduct(b));
}

Fit robustFit(const Eigen::MatrixXd &A, const Eigen::VectorXd &b, double outlier)
{
  Fit fit;
  fit.weights = Eigen::VectorXd::Ones(b.size());
  fit.x = solveWeighted(A, b, fit.weights);
  // First an L1 fit, which is robust to outliers. Then Tukey at a fixed scale.
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd r = b - A * fit.x;
    const double floor = 1e-3 * robustSigma(r) + 1e-15;
    fit.weights = r.cwiseAbs().cwiseMax(floor).cwiseInverse();
    fit.x = solveWeighted(A, b, fit.weights);
  }
  const double scale = std::max(robustSigma(b - A * fit.x), 1e-12 * (b.cwiseAbs().maxCoeff() + 1e-300));
  for (int i = 0; i < 30; ++i) {
    const Eigen::ArrayXd u = (b - A * fit.x).array() / (outlier * scale);
    fit.weights = (u.abs() < 1.).select((1. - u.square()).square(), 0.).matrix();
    const Eigen::VectorXd before = fit.x;
    fit.x = solveWeighted(A, b, fit.weights);
    if ((fit.x - before).norm() <= 1e-12 * fit.x.norm()) {
      break;
    }
  }
  const Eigen::VectorXd r = b - A * fit.x;
  const Eigen::ArrayXd u = (r.array() / (outlier * scale)).abs().min(1.);
  fit.cost = (1. - (1. - u.square()).cube()).sum(); // Tukey's cost at this scale
  fit.condition = conditionOf(A);
  // Asymptotic covariance of an M-estimator.
  fit.psi = fit.weights.cwiseProduct(r);
  const Eigen::ArrayXd slope = (u < 1.).select((1. - u.square()) * (1. - 5. * u.square()), 0.);
  const double n = static_cast<double>(b.size()), freedom = std::max(1., n - static_cast<double>(A.cols()));
  const double meanSlope = std::max(slope.mean(), 1e-6);
  const double variance = fit.psi.squaredNorm() / freedom / (meanSlope * meanSlope);
  fit.sigma = robustSigma(r);
  fit.covariance = variance * (A.transpose() * A).ldlt().solve(Eigen::MatrixXd::Identity(A.cols(), A.cols()));
  return fit;
}

Eigen::MatrixXd regressors(const std::vector<vpFrictionSample> &log, double stribeckVelocity)
{
  Eigen::MatrixXd A(static_cast<Eigen::Index>(log.size()), stribeckVelocity > 0. ? 4 : 3);
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    const vpFrictionSample &s = log[static_cast<std::size_t>(i)];
    const double sign = std::copysign(1., s.velocity);
    A(i, 0) = s.acceleration;
    A(i, 1) = s.velocity;
    A(i, 2) = sign;
    if (stribeckVelocity > 0.) {
      const double ratio = s.velocity / stribeckVelocity;
      A(i, 3) = sign * std::exp(-ratio * ratio);
    }
  }
  return A;
}

// What would show that the model lacks something: an offset, and powers of the velocity, even and odd.
Eigen::MatrixXd alternatives(const std::vector<vpFrictionSample> &log, double fastest)
{
  Eigen::MatrixXd Z(static_cast<Eigen::Index>(log.size()), 6);
  for (Eigen::Index i = 0; i < Z.rows(); ++i) {
    const double v = log[static_cast<std::size_t>(i)].velocity / fastest, s = std::fabs(v);
    Z.row(i) << 1., s, v * v, v * s, v * v * v, v * v * s;
  }
  return Z;
}

// Probability of residuals that the alternatives explain so well, if they are independent: psi on what of the alternatives
// is not in the regressors already (Rao's score test for M-estimators).
double lackOfFit(const Eigen::MatrixXd &A, const Eigen::MatrixXd &Z, const Eigen::VectorXd &psi)
{
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> in(A);
  Eigen::MatrixXd rest = Z;
  for (Eigen::Index k = 0; k < Z.cols(); ++k) {
    rest.col(k) /= Z.col(k).norm();
    rest.col(k) -= A * in.solve(rest.col(k).eval());
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rest.rows(), rest.cols());
  qr.setThreshold(1e-4 / std::max(1e-4, rest.colwise().norm().maxCoeff())); // below: the log does not tell them apart
  qr.compute(rest);
  const Eigen::Index k = qr.rank();
  const double below = static_cast<double>(A.rows() - in.rank() - k), all = psi.squaredNorm();
  if (k == 0 || !(below > 0.) || !(all > 0.)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Eigen::VectorXd turned = qr.householderQ().transpose() * psi;
  const double explained = std::min(turned.head(k).squaredNorm(), all);
  return vpFisherTail(explained / static_cast<double>(k) / ((all - explained) / below), static_cast<double>(k), below);
}

// Probability of neighbours that are so much alike, or unlike, if they are independent: their correlation is about normal,
// with the variance 1 / n.
double likeness(const Eigen::VectorXd &psi)
{
  const Eigen::Index n = psi.size();
  const double correlation = psi.head(n - 1).dot(psi.tail(n - 1)) / psi.squaredNorm();
  return vpChiSquareTail(static_cast<double>(n) * correlation * correlation, 1.);
}

// Of both tests together. stribeck: that was fitted, 0 if none.
double fitProbability(const std::vector<vpFrictionSample> &log, double stribeck, double fastest,
                      const Eigen::VectorXd &psi)
{
  Eigen::MatrixXd A = regressors(log, stribeck);
  if (stribeck > 0.) { // and what another velocity of Stribeck would change, which the search for it has used up
    A.conservativeResize(Eigen::NoChange, 5);
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const double ratio = log[static_cast<std::size_t>(i)].velocity / stribeck;
      A(i, 4) = A(i, 3) * ratio * ratio;
    }
  }
  const double lack = lackOfFit(A, alternatives(log, fastest), psi), alike = likeness(psi);
  return std::isnan(lack) ? alike : std::min(1., 2. * std::min(lack, alike));
}

// Sum of absolute residuals of the fit that makes it least, by a few reweighted steps.
double absoluteCost(const Eigen::MatrixXd &A, const Eigen::VectorXd &b)
{
  Eigen::VectorXd r = b - A * solveWeighted(A, b, Eigen::VectorXd::Ones(b.size()));
  for (int i = 0; i < 10; ++i) {
    const double floor = 1e-3 * robustSigma(r) + 1e-15;
    r = b - A * solveWeighted(A, b, r.cwiseAbs().cwiseMax(floor).cwiseInverse());
  }
  return r.cwiseAbs().sum();
}

// The Stribeck velocity of the smallest residuals, by a scan in its logarithm and golden sections. With weights:
// squares; without weights yet: absolute values, because weights from a fit without Stribeck's term would exclude the
// slow samples.
double bestStribeck(const std::vector<vpFrictionSample> &log, const Eigen::VectorXd &b, const Eigen::VectorXd &weights,
                    double low, double high)
{
  const auto cost = [&](double logVelocity) {
    const Eigen::MatrixXd A = regressors(log, std::exp(logVelocity));
    if (weights.size() == 0) {
      return absoluteCost(A, b);
    }
    const Eigen::VectorXd root = weights.cwiseSqrt();
    return (root.cwiseProduct(b - A * solveWeighted(A, b, weights))).squaredNorm();
  };
  const double from = std::log(low), to = std::log(high);
  constexpr int steps = 40;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i) {
    const double c = cost(from + (to - from) * i / steps);
    if (c < least) {
      least = c;
      best = i;
    }
  }
  double a = from + (to - from) * std::max(0, best - 1) / steps,
         z = from + (to - from) * std::min(steps, best + 1) / steps;
  const double golden = 0.5 * (std::sqrt(5.) - 1.);
  for (int i = 0; i < 40; ++i) {
    const double p = z - golden * (z - a), q = a + golden * (z - a);
    (cost(p) < cost(q) ? z : a) = cost(p) < cost(q) ? q : p;
  }
  return std::exp(0.5 * (a + z));
}
} // namespace

void vpFrictionIdentificationSpec::validate() const
{
  const char *const owner = "friction identification";
  notNegative("minVelocity", owner, minVelocity);
  require(outlier > 1. && std::isfinite(outlier), "outlier", owner, outlier, "> 1 and finite");
  require(falseAlarm > 0. && falseAlarm < 1., "falseAlarm", owner, falseAlarm, "> 0 and < 1");
  require(maxCondition > 1., "maxCondition", owner, maxCondition, "> 1");
}

const char *vpFrictionIdentification::message() const
{
  switch (status) {
  case vpFrictionStatus::Good:
    return "Good: all parameters are identified.";
  case vpFrictionStatus::TooFewSamples:
    return "TooFewSamples: less than ten moving samples for each parameter.";
  case vpFrictionStatus::NotExcited:
    return "NotExcited: velocities or accelerations vary too little to tell the parameters apart.";
  case vpFrictionStatus::NoStribeck:
    return "NoStribeck: the slow samples show no Stribeck term; stiction is set to Coulomb friction.";
  case vpFrictionStatus::Misfit:
    return "Misfit: the forces hold more than this model and independent noise; the parameters are its best, their "
           "standard "
           "deviations are too small.";
  default:
    return "NotFinite: a sample is not finite or beyond 1e12.";
  }
}

vpFrictionIdentification vpIdentifyFriction(const std::vector<vpFrictionSample> &log,
                                            const vpFrictionIdentificationSpec &spec)
{
  spec.validate();
  vpFrictionIdentification result;
  std::vector<vpFrictionSample> used;
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0.;
  for (const vpFrictionSample &s : log) {
    if (!vpIsPlausible(s.force) || !vpIsPlausible(s.velocity) || !vpIsPlausible(s.acceleration)) {
      result.status = vpFrictionStatus::NotFinite;
      return result;
    }
    const double speed = std::fabs(s.velocity);
    if (speed > 0. && speed >= spec.minVelocity) {
      used.push_back(s);
      slowest = std::min(slowest, speed);
      fastest = std::max(fastest, speed);
    }
  }
  result.samples = static_cast<int>(used.size());
  if (used.size() < 30) {
    return result;
  }
  Eigen::VectorXd b(static_cast<Eigen::Index>(used.size()));
  for (std::size_t i = 0; i < used.size(); ++i) {
    b[static_cast<Eigen::Index>(i)] = used[i].force;
  }
  Fit fit = robustFit(regressors(used, 0.), b, spec.outlier);
  result.condition = fit.condition;
  if (!(fit.condition <= spec.maxCondition)) {
    result.status = vpFrictionStatus::NotExcited;
    return result;
  }
  result.status = vpFrictionStatus::Good;
  double stribeck = 0.;
  if (spec.stribeck) {
    result.status = vpFrictionStatus::NoStribeck;
    const double low = std::max(slowest, 1e-3 * fastest), high = 0.5 * fastest;
    if (used.size() >= 50 && high > low) {
      stribeck = bestStribeck(used, b, Eigen::VectorXd(), low, high);
      Fit full = robustFit(regressors(used, stribeck), b, spec.outlier);
      for (int i = 0; i < 2; ++i) { // the outliers are known here
        stribeck = bestStribeck(used, b, full.weights, low, high);
        full = robustFit(regressors(used, stribeck), b, spec.outlier);
      }
      // The search over its velocity makes a noise term look significant at 3 sigma; 5 is safe.
      const bool shown = full.condition <= spec.maxCondition && full.x[3] > 5. * std::sqrt(full.covariance(3, 3));
      if (shown) {
        fit = full;
        result.status = vpFrictionStatus::Good;
        result.condition = full.condition;
      }
    }
  }
  result.model.mass = fit.x[0];
  result.model.viscous = fit.x[1];
  result.model.coulomb = fit.x[2];
  result.model.stiction = fit.x[2];
  result.sigmaMass = std::sqrt(fit.covariance(0, 0));
  result.sigmaViscous = std::sqrt(fit.covariance(1, 1));
  result.sigmaCoulomb = std::sqrt(fit.covariance(2, 2));
  result.sigmaStiction = result.sigmaCoulomb;
  if (result.status == vpFrictionStatus::Good && fit.x.size() == 4) {
    result.model.stiction += fit.x[3];
    result.model.stribeckVelocity = stribeck;
    result.sigmaStiction = std::sqrt(fit.covariance(2, 2) + fit.covariance(3, 3) + 2. * fit.covariance(2, 3));
  }
  result.noise = fit.sigma;
  for (const double x :
       {result.model.mass, result.model.viscous, result.model.coulomb, result.model.stiction, result.sigmaMass,
        result.sigmaViscous, result.sigmaCoulomb, result.sigmaStiction, result.noise}) {
    if (!std::isfinite(x)) {
      result.status = vpFrictionStatus::NotExcited;
      return result;
    }
  }
  result.outliers = static_cast<int>((fit.weights.array() == 0.).count());
  if (fit.sigma > 1e-9 * b.cwiseAbs().maxCoeff()) { // below: rounding, which is no noise
    result.fitProbability = fitProbability(used, fit.x.size() == 4 ? stribeck : 0., fastest, fit.psi);
    if (result.fitProbability < spec.falseAlarm) {
      result.status = vpFrictionStatus::Misfit;
    }
  }
  return result;
}

END_VISP_NAMESPACE
