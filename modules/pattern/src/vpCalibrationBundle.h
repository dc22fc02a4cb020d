/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Levenberg-Marquardt over parameters shared by all views and others that belong to one view each. The normal matrix is
// an arrow; the views are eliminated one by one, so that the effort grows with their number and not with its cube.
//
// Radial distortion d (1 + kappa |d|^2) = w of (4.5) and (7.5): from the ideal position w to the observed one, d.
//
// Tests of a bundle by its residuals, from its linearisation at the solution.
#ifndef vpCalibrationBundle_h
#define vpCalibrationBundle_h

#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/pattern/vpCalibrationPoint.h>
#include <visp3/pattern/vpFitTest.h>

#include <Eigen/Core>
#include <Eigen/Dense>

#include <cmath>
#include <vector>

BEGIN_VISP_NAMESPACE

struct vpDistortedPoint {
  Eigen::Vector2d d;        // observed position; NaN where the distortion has no inverse
  Eigen::Matrix2d byIdeal;  // derivative of d with respect to w
  Eigen::Vector2d byKappa1; // derivative of d with respect to kappa
};

[[nodiscard]] vpDistortedPoint vpDistort(const Eigen::Vector2d &ideal, double kappa1);

// Residuals of one view in standard deviations, (measured - predicted) / sigma, and derivatives of predicted / sigma.
struct vpBundleView {
  Eigen::MatrixXd byShared;
  Eigen::MatrixXd byLocal;
  Eigen::VectorXd residual;
};

struct vpBundleCovariance {
  double condition = 1.; // of the shared parameters, views eliminated, columns scaled
  Eigen::MatrixXd sharedCovariance;
  std::vector<Eigen::MatrixXd> localCovariance; // one for each view
  std::vector<Eigen::MatrixXd> crossCovariance; // of shared (rows) and local (columns) parameters
};

template <class State> struct vpBundleSolution : vpBundleCovariance {
  State state;
  double chi2 = 0.;
  int iterations = 0;
  bool converged = false;
};

// One linearisation, reduced to the shared parameters.
class vpBundleNormal
{
public:
  vpBundleNormal(Eigen::Index shared, std::size_t views);
  void set(std::size_t k, const vpBundleView &view);
  // Solves with the diagonal raised by the share lambda. Returns false when the matrix is singular.
  bool solve(double lambda, Eigen::VectorXd &shared, std::vector<Eigen::VectorXd> &local) const;
  // Squared length of a step, in standard deviations.
  [[nodiscard]] double length2(const Eigen::VectorXd &shared, const std::vector<Eigen::VectorXd> &local) const;
  void covariances(vpBundleCovariance &solution) const;

private:
  Eigen::MatrixXd m_shared;
  Eigen::VectorXd m_gradient;
  std::vector<Eigen::MatrixXd> m_local;
  std::vector<Eigen::MatrixXd> m_mixed;
  std::vector<Eigen::VectorXd> m_localGradient;
};

/*
 * Problem: shared() and views() give sizes; view(state, k) the residuals (NaN where the state is invalid); plus(state,
 * shared, local) the state after a step.
 */
template <class Problem, class State> vpBundleSolution<State> vpSolveBundle(const Problem &problem, const State &start)
{
  constexpr int mostIterations = 200;
  constexpr double enough = 1e-6; // length of the last step at convergence, standard deviations
  vpBundleSolution<State> solution;
  solution.state = start;
  const auto linearise = [&problem](const State &state, vpBundleNormal &normal) {
    double chi2 = 0.;
    for (std::size_t k = 0; k < problem.views(); ++k) {
      const vpBundleView view = problem.view(state, k);
      chi2 += view.residual.squaredNorm();
      normal.set(k, view);
    }
    return chi2;
  };
  vpBundleNormal normal(problem.shared(), problem.views());
  solution.chi2 = linearise(start, normal);
  double lambda = 1e-3;
  Eigen::VectorXd shared;
  std::vector<Eigen::VectorXd> local;
  while (solution.iterations < mostIterations && !solution.converged && lambda < 1e12) {
    ++solution.iterations;
    if (!normal.solve(lambda, shared, local)) {
      lambda *= 10.;
      continue;
    }
    const bool small = normal.length2(shared, local) < enough * enough;
    const State next = problem.plus(solution.state, shared, local);
    vpBundleNormal nextNormal(problem.shared(), problem.views());
    const double chi2 = linearise(next, nextNormal);
    if (chi2 <= solution.chi2) { // false for NaN
      solution.state = next;
      solution.chi2 = chi2;
      normal = nextNormal;
      lambda = std::max(0.1 * lambda, 1e-12);
      solution.converged = small;
    }
    else { // a small step that no longer improves is the limit of rounding
      solution.converged = small;
      lambda *= 10.;
    }
  }
  normal.covariances(solution);
  return solution;
}

struct vpFitTestView {
  vpBundleView linear;        // residuals (two per point) and derivatives, in standard deviations
  Eigen::MatrixXd covariance; // of (shared, local of this view)
  Eigen::Matrix2Xd sigma;     // of the points, px
  Eigen::Matrix2Xd place;     // image positions of the points, px
};

// stated: the deviations are absolute, not only ratios.
[[nodiscard]] vpFitTest vpTestFit(const std::vector<vpFitTestView> &views, double level, bool stated);

// The joint covariance of the shared and one view's own parameters.
[[nodiscard]] Eigen::MatrixXd vpJointCovariance(const vpBundleCovariance &solution, std::size_t k);

// Input of vpTestFit(), at the solution. Problem: also sigma(k, i), the deviations of the residuals of a point, px.
template <class Problem, class State>
[[nodiscard]] std::vector<vpFitTestView> vpLinearised(const Problem &problem, const vpBundleSolution<State> &solution,
                                                      const std::vector<std::vector<vpCalibrationPoint>> &points)
{
  std::vector<vpFitTestView> views(problem.views());
  for (std::size_t k = 0; k < views.size(); ++k) {
    const auto n = static_cast<Eigen::Index>(points[k].size());
    views[k] = {problem.view(solution.state, k), vpJointCovariance(solution, k), Eigen::Matrix2Xd(2, n),
                Eigen::Matrix2Xd(2, n)};
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto point = static_cast<std::size_t>(i);
      views[k].sigma.col(i) = problem.sigma(k, point);
      views[k].place.col(i) << points[k][point].u, points[k][point].v;
    }
  }
  return views;
}

END_VISP_NAMESPACE
#endif
