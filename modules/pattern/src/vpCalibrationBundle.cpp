/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCalibrationBundle.h"

#include "vpCalibrationInput.h"

#include <visp3/direct_core/vpTailProbability.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
// r with r (1 + kappa r^2) = rho, on the branch that begins at zero; NaN beyond its end.
double seenRadius(double rho, double kappa)
{
  if (kappa < 0. && rho > 2. / (3. * std::sqrt(-3. * kappa))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  // Newton from the side where the curve bends towards the root, so that it converges monotonically.
  double r = kappa < 0. ? rho : std::min(rho, std::cbrt(rho / kappa));
  for (int i = 0; i < 60; ++i) {
    const double slope = 1. + 3. * kappa * r * r;
    const double step = (rho - r * (1. + kappa * r * r)) / slope;
    if (!std::isfinite(step)) {
      break;
    }
    r += step;
    if (std::abs(step) <= 1e-15 * r) {
      break;
    }
  }
  return r;
}

constexpr double leastTold = 1e-9; // information of other views on a shared direction over that of all
constexpr double leastLeft =
    1e-4;                         // share of a direction that the fit leaves; less is lost in the covariance's rounding
constexpr double rounding = 1e-6; // px: residuals below are not noise of a measurement

constexpr double leastEigenvalue = 1e-15; // over the largest

Eigen::MatrixXd raised(Eigen::MatrixXd matrix, double lambda)
{
  matrix.diagonal() *= 1. + lambda;
  return matrix;
}

// Parameters have units from px^-2 to px/m; only after scaling are their magnitudes meaningful.
Eigen::MatrixXd scaledInverse(const Eigen::MatrixXd &matrix, double *condition = nullptr)
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

// A part of the sum of squares and its degrees of freedom.
struct Part {
  double squares = 0.;
  int degrees = 0;
};

// b' A^+ b and the rank of A, which is symmetric; directions with an eigenvalue below least are ignored.
Part quadratic(const Eigen::MatrixXd &A, const Eigen::VectorXd &b, double least)
{
  Part part;
  if (A.rows() == 0) {
    return part;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  const Eigen::VectorXd along = solver.eigenvectors().transpose() * b;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    if (solver.eigenvalues()[i] > least) {
      part.squares += along[i] * along[i] / solver.eigenvalues()[i];
      ++part.degrees;
    }
  }
  return part;
}

class FitTester
{
public:
  FitTester(const std::vector<vpFitTestView> &views, double level, bool stated) : m_views(views), m_stated(stated)
  {
    m_test.level = level;
    Eigen::Index parameters = views.front().linear.byShared.cols();
    for (const vpFitTestView &view : views) {
      m_all.squares += view.linear.residual.squaredNorm();
      m_all.degrees += static_cast<int>(view.linear.residual.size());
      parameters += view.linear.byLocal.cols();
    }
    m_all.degrees -= static_cast<int>(parameters);
  }

  vpFitTest run()
  {
    if (m_all.degrees <= 0 || !std::isfinite(m_all.squares)) {
      return m_test;
    }
    if (m_stated) {
      m_test.wholeProbability = vpChiSquareTail(m_all.squares, m_all.degrees);
    }
    leaveOutViews();
    if (roundingAlone()) {
      m_test.verdict = vpFitVerdict::Fits;
      return m_test;
    }
    leaveOutPoints();
    lookForFields();
    judge();
    return m_test;
  }

private:
  // Probability that a part of the squares is this large relative to the rest; NaN when there is no part or no rest.
  [[nodiscard]] double probabilityOf(const Part &part) const
  {
    const int below = m_all.degrees - part.degrees;
    if (part.degrees <= 0 || below <= 0) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double rest = std::max(0., m_all.squares - part.squares) / below, mean = part.squares / part.degrees;
    if (rest <= 1e-24 * mean) { // the rest fits exactly
      return mean > 0. ? 0. : 1.;
    }
    return vpFisherTail(mean / rest, part.degrees, below);
  }

  // Information of one view alone on the shared parameters leaves with the view.
  void leaveOutViews()
  {
    const std::size_t n = m_views.size();
    m_test.worstView = 0;
    m_test.worstViewRms = rmsOf(0);
    if (n < 2) {
      return;
    }
    std::vector<Eigen::MatrixXd> information;
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(shared(), shared());
    for (const vpFitTestView &view : m_views) {
      const Eigen::MatrixXd &S = view.linear.byShared, &L = view.linear.byLocal;
      const Eigen::MatrixXd rest = S - L * L.colPivHouseholderQr().solve(S);
      information.push_back(S.transpose() * rest);
      sum += information.back();
    }
    const Eigen::VectorXd scale = sum.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    double worst = 2., worstRatio = 0.;
    for (std::size_t k = 0; k < n; ++k) {
      const vpBundleView &view = m_views[k].linear;
      Eigen::MatrixXd others = scale.asDiagonal() * (sum - information[k]) * scale.asDiagonal();
      others = (0.5 * (others + others.transpose())).eval();
      const Eigen::VectorXd gradient = scale.asDiagonal() * (view.byShared.transpose() * view.residual);
      const Part pull = quadratic(others, gradient, leastTold);
      Part part;
      part.squares = view.residual.squaredNorm() + pull.squares;
      part.degrees = static_cast<int>(view.residual.size() - view.byLocal.cols() - shared()) + pull.degrees;
      const double probability = probabilityOf(part), ratio = part.squares / std::max(1, part.degrees);
      if (probability < worst || (probability == worst && ratio > worstRatio)) {
        worst = probability;
        worstRatio = ratio;
        m_test.worstView = static_cast<int>(k);
        m_test.worstViewRms = rmsOf(k);
      }
    }
    m_test.viewProbability = worst > 1. ? m_test.viewProbability : std::min(1., worst * static_cast<double>(n));
  }

  void leaveOutPoints()
  {
    double worst = 2., worstRatio = 0.;
    std::size_t count = 0;
    for (std::size_t k = 0; k < m_views.size(); ++k) {
      const vpFitTestView &view = m_views[k];
      const Eigen::MatrixXd J = derivativesOf(view);
      for (Eigen::Index i = 0; i < view.sigma.cols(); ++i) {
        const Eigen::MatrixXd rows = J.middleRows<2>(2 * i);
        const Eigen::Matrix2d left = Eigen::Matrix2d::Identity() - rows * view.covariance * rows.transpose();
        const Eigen::Vector2d residual = view.linear.residual.segment<2>(2 * i);
        const Part part = quadratic(left, residual, leastLeft);
        const double probability = probabilityOf(part), ratio = part.squares / std::max(1, part.degrees);
        count += std::isnan(probability) ? 0 : 1;
        if (probability < worst || (probability == worst && ratio > worstRatio)) {
          worst = probability;
          worstRatio = ratio;
          m_test.worstPointView = static_cast<int>(k);
          m_test.worstPoint = static_cast<int>(i);
          m_test.worstPointDistance =
              left.completeOrthogonalDecomposition().solve(residual).cwiseProduct(view.sigma.col(i)).norm();
        }
      }
    }
    m_test.pointProbability = count == 0 ? m_test.pointProbability : std::min(1., worst * static_cast<double>(count));
  }

  // Squares that polynomials of the image position, added to the model, would explain.
  void lookForFields()
  {
    double worst = 2.;
    int count = 0;
    for (const vpFitTestView &view : m_views) {
      const Eigen::Index points = view.place.cols();
      const int degree = points >= 20 ? 3 : points >= 12 ? 2 : 0;
      if (degree == 0) {
        continue;
      }
      const Eigen::Vector2d centre = view.place.rowwise().mean();
      const double size = (view.place.colwise() - centre).cwiseAbs().maxCoeff();
      Eigen::MatrixXd field = Eigen::MatrixXd::Zero(2 * points, (degree + 1) * (degree + 2));
      for (Eigen::Index i = 0; i < points; ++i) {
        const Eigen::Vector2d q = (view.place.col(i) - centre) / size;
        Eigen::Index column = 0;
        for (int a = 0; a <= degree; ++a) {
          for (int b = 0; a + b <= degree; ++b) {
            const double value = std::pow(q.x(), a) * std::pow(q.y(), b);
            field(2 * i, column++) = value;
            field(2 * i + 1, column++) = value;
          }
        }
      }
      const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(field);
      const Eigen::MatrixXd E =
          qr.householderQ() * Eigen::MatrixXd::Identity(field.rows(), std::min(qr.rank(), field.rows()));
      const Eigen::MatrixXd EJ = E.transpose() * derivativesOf(view);
      const Eigen::MatrixXd left =
          Eigen::MatrixXd::Identity(E.cols(), E.cols()) - EJ * view.covariance * EJ.transpose();
      const double probability = probabilityOf(quadratic(left, E.transpose() * view.linear.residual, leastLeft));
      count += std::isnan(probability) ? 0 : 1;
      worst = probability < worst ? probability : worst;
    }
    m_test.fieldProbability = count == 0 ? m_test.fieldProbability : std::min(1., worst * count);
  }

  void judge()
  {
    const double all[] = {m_test.wholeProbability, m_test.viewProbability, m_test.pointProbability,
                          m_test.fieldProbability};
    const auto tests = std::count_if(std::begin(all), std::end(all), [](double p) { return !std::isnan(p); });
    if (tests == 0) {
      return;
    }
    const double share = m_test.level / static_cast<double>(tests);
    const bool misfit = std::any_of(std::begin(all), std::end(all), [share](double p) { return p < share; });
    m_test.verdict = misfit ? vpFitVerdict::Misfit : vpFitVerdict::Fits;
  }

  [[nodiscard]] bool roundingAlone() const
  {
    for (std::size_t k = 0; k < m_views.size(); ++k) {
      if (!(rmsOf(k) < rounding)) {
        return false;
      }
    }
    return true;
  }
  [[nodiscard]] Eigen::Index shared() const { return m_views.front().linear.byShared.cols(); }
  [[nodiscard]] static Eigen::MatrixXd derivativesOf(const vpFitTestView &view)
  {
    Eigen::MatrixXd J(view.linear.byShared.rows(), view.linear.byShared.cols() + view.linear.byLocal.cols());
    J << view.linear.byShared, view.linear.byLocal;
    return J;
  }
  [[nodiscard]] double rmsOf(std::size_t k) const
  {
    const vpFitTestView &view = m_views[k];
    double squares = 0.;
    for (Eigen::Index i = 0; i < view.sigma.cols(); ++i) {
      squares += view.linear.residual.segment<2>(2 * i).cwiseProduct(view.sigma.col(i)).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(view.sigma.cols()));
  }

  const std::vector<vpFitTestView> &m_views; // owned by the caller
  bool m_stated;
  Part m_all;
  vpFitTest m_test;
};
} // namespace

vpDistortedPoint vpDistort(const Eigen::Vector2d &ideal, double kappa1)
{
  vpDistortedPoint point;
  const double rho = ideal.norm();
  if (kappa1 == 0. || rho == 0.) {
    point.d = ideal;
    point.byIdeal.setIdentity();
    point.byKappa1 = -rho * rho * ideal;
    return point;
  }
  const double r = seenRadius(rho, kappa1);
  const double slope = 1. / (1. + 3. * kappa1 * r * r), share = r / rho;
  const Eigen::Vector2d direction = ideal / rho;
  point.d = share * ideal;
  point.byIdeal = share * Eigen::Matrix2d::Identity() + (slope - share) * direction * direction.transpose();
  point.byKappa1 = -slope * r * r * r * direction;
  return point;
}

vpBundleNormal::vpBundleNormal(Eigen::Index shared, std::size_t views)
  : m_shared(Eigen::MatrixXd::Zero(shared, shared)), m_gradient(Eigen::VectorXd::Zero(shared)), m_local(views),
    m_mixed(views), m_localGradient(views)
{}

void vpBundleNormal::set(std::size_t k, const vpBundleView &view)
{
  m_shared += view.byShared.transpose() * view.byShared;
  m_gradient += view.byShared.transpose() * view.residual;
  m_local[k] = view.byLocal.transpose() * view.byLocal;
  m_mixed[k] = view.byShared.transpose() * view.byLocal;
  m_localGradient[k] = view.byLocal.transpose() * view.residual;
}

bool vpBundleNormal::solve(double lambda, Eigen::VectorXd &shared, std::vector<Eigen::VectorXd> &local) const
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

double vpBundleNormal::length2(const Eigen::VectorXd &shared, const std::vector<Eigen::VectorXd> &local) const
{
  double sum = shared.dot(m_shared * shared);
  for (std::size_t k = 0; k < local.size(); ++k) {
    sum += 2. * shared.dot(m_mixed[k] * local[k]) + local[k].dot(m_local[k] * local[k]);
  }
  return sum;
}

void vpBundleNormal::covariances(vpBundleCovariance &solution) const
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

Eigen::MatrixXd vpJointCovariance(const vpBundleCovariance &solution, std::size_t k)
{
  const Eigen::Index s = solution.sharedCovariance.rows(), l = solution.localCovariance[k].rows();
  Eigen::MatrixXd joint(s + l, s + l);
  joint << solution.sharedCovariance, solution.crossCovariance[k], solution.crossCovariance[k].transpose(),
      solution.localCovariance[k];
  return joint;
}

vpFitTest vpTestFit(const std::vector<vpFitTestView> &views, double level, bool stated)
{
  return FitTester(views, level, stated).run();
}

std::string vpFitTest::message(double varianceFactor) const
{
  if (verdict == vpFitVerdict::NotTested) {
    return "The fit could not be tested: there are no more numbers than parameters.";
  }
  const bool stated = !std::isnan(wholeProbability);
  if (verdict == vpFitVerdict::Fits) {
    return vpSentence("The fit holds%s, tested at level %g.", stated ? " against the stated deviations" : "", level);
  }
  std::string text = "The model does not fit the points:";
  text += stated && wholeProbability < level
              ? vpSentence(" the residuals are %.3g times what the stated deviations allow.", std::sqrt(varianceFactor))
              : " the residuals are not noise.";
  text += vpSentence(" View %d fits worst (%.3g px rms)", worstView, worstViewRms);
  if (worstPoint >= 0) {
    text += vpSentence("; the worst point is %d of view %d, %.3g px from where the others put it", worstPoint,
                       worstPointView, worstPointDistance);
  }
  return text + ". Check them, or leave them out.";
}

const char *vpToString(vpFitVerdict verdict)
{
  switch (verdict) {
  case vpFitVerdict::Fits:
    return "Fits";
  case vpFitVerdict::Misfit:
    return "Misfit";
  case vpFitVerdict::NotTested:
    break;
  }
  return "NotTested";
}

END_VISP_NAMESPACE
