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

template <class State> struct vpBundleSolution {
  State state;
  double chi2 = 0.;
  int iterations = 0;
  bool converged = false;
  double condition = 1.; // of the shared parameters, views eliminated, columns scaled
  Eigen::MatrixXd sharedCovariance;
  std::vector<Eigen::MatrixXd> localCovariance; // one for each view
  std::vector<Eigen::MatrixXd> crossCovariance; // of shared (rows) and local (columns) parameters
};

// One linearisation, reduced to the shared parameters.
class vpBundleNormal
{
public:
  vpBundleNormal(Eigen::Index shared, std::size_t views)
    : m_shared(Eigen::MatrixXd::Zero(shared, shared)), m_gradient(Eigen::VectorXd::Zero(shared)), m_local(views),
      m_mixed(views), m_localGradient(views)
  {}
  void set(std::size_t k, const vpBundleView &view)
  {
    m_shared += view.byShared.transpose() * view.byShared;
    m_gradient += view.byShared.transpose() * view.residual;
    m_local[k] = view.byLocal.transpose() * view.byLocal;
    m_mixed[k] = view.byShared.transpose() * view.byLocal;
    m_localGradient[k] = view.byLocal.transpose() * view.residual;
  }
  // Solves with the diagonal raised by the share lambda. Returns false when the matrix is singular.
  bool solve(double lambda, Eigen::VectorXd &shared, std::vector<Eigen::VectorXd> &local) const
  {
    Eigen::MatrixXd reduced = raised(m_shared, lambda);
    Eigen::VectorXd right = m_gradient;
    std::vector<Eigen::LDLT<Eigen::MatrixXd>> factors(m_local.size());
    for (std::size_t k = 0; k < m_local.size(); ++k) {
      factors[k].compute(raised(m_local[k], lambda));
      reduced -= m_mixed[k] * factors[k].solve(m_mixed[k].transpose());
      right -= m_mixed[k] * factors[k].solve(m_localGradient[k]);
    }
    shared = scaledInverse(reduced) * right;
    local.resize(m_local.size());
    bool finite = shared.allFinite();
    for (std::size_t k = 0; k < m_local.size(); ++k) {
      local[k] = factors[k].solve(m_localGradient[k] - m_mixed[k].transpose() * shared);
      finite = finite && local[k].allFinite();
    }
    return finite;
  }
  // Squared length of a step, in standard deviations.
  double length2(const Eigen::VectorXd &shared, const std::vector<Eigen::VectorXd> &local) const
  {
    double sum = shared.dot(m_shared * shared);
    for (std::size_t k = 0; k < local.size(); ++k) {
      sum += 2. * shared.dot(m_mixed[k] * local[k]) + local[k].dot(m_local[k] * local[k]);
    }
    return sum;
  }
  template <class State> void covariances(vpBundleSolution<State> &solution) const
  {
    Eigen::MatrixXd reduced = m_shared;
    std::vector<Eigen::MatrixXd> inverse(m_local.size()), gain(m_local.size());
    for (std::size_t k = 0; k < m_local.size(); ++k) {
      inverse[k] = scaledInverse(m_local[k]);
      gain[k] = m_mixed[k] * inverse[k];
      reduced -= gain[k] * m_mixed[k].transpose();
    }
    solution.sharedCovariance = scaledInverse(reduced, &solution.condition);
    solution.localCovariance.clear();
    solution.crossCovariance.clear();
    for (std::size_t k = 0; k < m_local.size(); ++k) {
      const Eigen::MatrixXd cross = -solution.sharedCovariance * gain[k];
      solution.crossCovariance.push_back(cross);
      solution.localCovariance.push_back(inverse[k] - gain[k].transpose() * cross);
    }
  }

private:
  static constexpr double leastEigenvalue = 1e-15; // over the largest

  static Eigen::MatrixXd raised(Eigen::MatrixXd matrix, double lambda)
  {
    matrix.diagonal() *= 1. + lambda;
    return matrix;
  }
  // Parameters have units from px^-2 to px/m; only after scaling are their magnitudes meaningful.
  static Eigen::MatrixXd scaledInverse(const Eigen::MatrixXd &matrix, double *condition = nullptr)
  {
    if (matrix.rows() == 0) {
      return matrix;
    }
    const Eigen::VectorXd scale = matrix.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scale.asDiagonal() * matrix * scale.asDiagonal());
    // Rounding may make the eigenvalue of an undetermined direction negative; its deviation must come out large.
    const double most = solver.eigenvalues()[matrix.rows() - 1];
    const Eigen::VectorXd values = solver.eigenvalues().cwiseMax(leastEigenvalue * most);
    if (condition != nullptr) {
      *condition = std::sqrt(most / values[0]);
    }
    return scale.asDiagonal() * solver.eigenvectors() * values.cwiseInverse().asDiagonal() *
           solver.eigenvectors().transpose() * scale.asDiagonal();
  }

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
template <class State>
[[nodiscard]] Eigen::MatrixXd vpJointCovariance(const vpBundleSolution<State> &solution, std::size_t k)
{
  const Eigen::Index s = solution.sharedCovariance.rows(), l = solution.localCovariance[k].rows();
  Eigen::MatrixXd joint(s + l, s + l);
  joint << solution.sharedCovariance, solution.crossCovariance[k], solution.crossCovariance[k].transpose(),
      solution.localCovariance[k];
  return joint;
}

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
