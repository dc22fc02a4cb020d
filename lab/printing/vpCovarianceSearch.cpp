/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/printing/vpCovarianceSearch.h"

#include "vpFieldCheck.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

BEGIN_VISP_NAMESPACE

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr vpFieldCheck fields("the covariance search");

//! Weights and rates of the strategy, by Hansen's formulas.
struct Rates {
  Rates(int n, int population) : weights(population / 2)
  {
    for (int i = 0; i < weights.size(); ++i) {
      weights(i) = std::log(0.5 * (population + 1.)) - std::log(i + 1.);
    }
    weights /= weights.sum();
    effective = 1. / weights.squaredNorm();
    sigma = (effective + 2.) / (n + effective + 5.);
    damping = 1. + 2. * std::max(0., std::sqrt((effective - 1.) / (n + 1.)) - 1.) + sigma;
    path = (4. + effective / n) / (n + 4. + 2. * effective / n);
    one = 2. / ((n + 1.3) * (n + 1.3) + effective);
    mean = std::min(1. - one, 2. * (effective - 2. + 1. / effective) / ((n + 2.) * (n + 2.) + effective));
    length = std::sqrt(n) * (1. - 1. / (4. * n) + 1. / (21. * n * n));
  }
  VectorXd weights;
  double effective = 0., sigma = 0., damping = 0., path = 0., one = 0., mean = 0., length = 0.;
};
} // namespace

vpCovarianceSearch::Result vpCovarianceSearch::run(const VectorXd &start,
                                                   const std::function<double(const VectorXd &)> &f,
                                                   const std::function<bool(int, double)> &progress) const
{
  fields.in("generations", generations, {1});
  fields.in("population", population, {0});
  fields.positive("step", step);
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    fields.in("start", start(i), {0., 1.});
  }
  const int n = static_cast<int>(start.size());
  const int points = std::max(4, population > 0 ? population : 4 + static_cast<int>(3. * std::log(n)));
  const Rates rates(n, points);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  VectorXd mean = start, pathC = VectorXd::Zero(n), pathS = pathC;
  MatrixXd C = MatrixXd::Identity(n, n);
  Result best;
  best.x = start;
  best.value = std::numeric_limits<double>::infinity();
  best.step = step;
  std::vector<VectorXd> moves(static_cast<std::size_t>(points));
  std::vector<double> values(moves.size());
  std::vector<std::size_t> order(moves.size());
  for (int generation = 0; generation < generations && best.step > smallestStep; ++generation) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> axes(C);
    const VectorXd lengths = axes.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
    for (std::size_t k = 0; k < moves.size(); ++k) {
      moves[k] = axes.eigenvectors() * lengths.cwiseProduct(VectorXd::NullaryExpr(n, [&] { return normal(random); }));
      const VectorXd x = mean + best.step * moves[k], inside = x.cwiseMax(0.).cwiseMin(1.);
      const double value = f(inside);
      ++best.evaluations;
      if (value < best.value) {
        best.value = value;
        best.x = inside;
      }
      values[k] =
          std::isnan(value) ? std::numeric_limits<double>::infinity() : value + outside * (x - inside).squaredNorm();
    }
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    VectorXd move = VectorXd::Zero(n);
    MatrixXd spread = MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < rates.weights.size(); ++i) {
      const VectorXd &y = moves[order[static_cast<std::size_t>(i)]];
      move += rates.weights(i) * y;
      spread += rates.weights(i) * y * y.transpose();
    }
    mean += best.step * move;
    const VectorXd whitened = axes.eigenvectors() * (axes.eigenvectors().transpose() * move).cwiseQuotient(lengths);
    pathS = (1. - rates.sigma) * pathS + std::sqrt(rates.sigma * (2. - rates.sigma) * rates.effective) * whitened;
    const bool steady = pathS.norm() / std::sqrt(1. - std::pow(1. - rates.sigma, 2. * (generation + 1.))) <
                        (1.4 + 2. / (n + 1.)) * rates.length;
    pathC =
        (1. - rates.path) * pathC + (steady ? std::sqrt(rates.path * (2. - rates.path) * rates.effective) : 0.) * move;
    C = (1. - rates.one - rates.mean) * C + rates.one * pathC * pathC.transpose() + rates.mean * spread;
    best.step *= std::exp(rates.sigma / rates.damping * (pathS.norm() / rates.length - 1.));
    if (progress && !progress(generation, best.value)) {
      break;
    }
  }
  return best;
}

END_VISP_NAMESPACE
