/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCalibrationInput.h"
#include "vpMicroscopeCalibrationProblem.h"

#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
using State = vpMicroscopeState;
using Solution = vpBundleSolution<State>;

constexpr std::size_t leastPoints = 6;
constexpr double suspicious = 5.; // residuals over what the points' deviations say

double wrapped(double angle) { return std::remainder(angle, 2. * M_PI); }

// The placement of one view and its derivatives by (scale, rotation, place of the view's origin in px).
struct Placed {
  vpMicroscopePlacement placement;
  Eigen::Matrix<double, 3, 4> by;
};

// t = place / scale - R F origin.
Placed placeOf(const State &state, const vpPlanarView &view, std::size_t k)
{
  const double scale = state.shared[State::Scale], angle = state.local[k][0];
  const double c = std::cos(angle), s = std::sin(angle);
  const Eigen::Vector2d origin(view.origin.x(), view.mirrored ? -view.origin.y() : view.origin.y());
  const Eigen::Vector2d place = state.local[k].tail<2>();
  Placed placed;
  placed.placement.rotation = wrapped(angle);
  placed.placement.tx = place.x() / scale - (c * origin.x() - s * origin.y());
  placed.placement.ty = place.y() / scale - (s * origin.x() + c * origin.y());
  placed.by << 0., 1., 0., 0.,                                                       //
      -place.x() / (scale * scale), s * origin.x() + c * origin.y(), 1. / scale, 0., //
      -place.y() / (scale * scale), -c * origin.x() + s * origin.y(), 0., 1. / scale;
  return placed;
}

// Covariance of (all shared, local k), zero where a parameter was given.
Eigen::Matrix<double, 8, 8> covarianceOf(const Solution &solution, const std::vector<int> &isFree, std::size_t k)
{
  Eigen::Matrix<double, 8, 8> all = Eigen::Matrix<double, 8, 8>::Zero();
  for (std::size_t i = 0; i < isFree.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < isFree.size(); ++j) {
      all(isFree[i], isFree[j]) = solution.sharedCovariance(row, static_cast<Eigen::Index>(j));
    }
    all.block<1, 3>(isFree[i], State::SharedCount) = solution.crossCovariance[k].row(row);
    all.block<3, 1>(State::SharedCount, isFree[i]) = solution.crossCovariance[k].row(row).transpose();
  }
  all.bottomRightCorner<3, 3>() = solution.localCovariance[k];
  return all;
}

// From (scale, aspect, kappa1, u0, v0, local of the view) to vpMicroscopeParameter.
Eigen::Matrix<double, 8, 8> resultBy(const State &state, const Placed &placed)
{
  Eigen::Matrix<double, 8, 8> by = Eigen::Matrix<double, 8, 8>::Zero();
  by(vpMicroscopeScaleX, State::Scale) = 1.;
  by(vpMicroscopeScaleY, State::Scale) = state.shared[State::Aspect];
  by(vpMicroscopeScaleY, State::Aspect) = state.shared[State::Scale];
  by(vpMicroscopeKappa1, State::Kappa1) = 1.;
  by(vpMicroscopeU0, State::U0) = 1.;
  by(vpMicroscopeV0, State::V0) = 1.;
  by.block<3, 1>(vpMicroscopeRotation, State::Scale) = placed.by.col(0);
  by.block<3, 3>(vpMicroscopeRotation, State::SharedCount) = placed.by.rightCols<3>();
  return by;
}

vpMicroscopeCalibration calibrationOf(const State &state, const vpPlanarView &first, unsigned int width,
                                      unsigned int height)
{
  vpMicroscopeCalibration calibration;
  calibration.width = width;
  calibration.height = height;
  calibration.scaleX = state.shared[State::Scale];
  calibration.scaleY = state.shared[State::Scale] * state.shared[State::Aspect];
  calibration.kappa1 = state.shared[State::Kappa1];
  calibration.u0 = state.shared[State::U0];
  calibration.v0 = state.shared[State::V0];
  calibration.mirrored = first.mirrored;
  const vpMicroscopePlacement placement = placeOf(state, first, 0).placement;
  calibration.rotation = placement.rotation;
  calibration.tx = placement.tx;
  calibration.ty = placement.ty;
  return calibration;
}

// How far the two differ at the worst corner of the image, px. Infinite where one of them sees nothing.
double differenceAtCorners(const vpMicroscopeCalibration &a, const vpMicroscopeCalibration &b)
{
  double worst = 0.;
  for (const double u : {0., a.width - 1.}) {
    for (const double v : {0., a.height - 1.}) {
      const Eigen::Vector2d plane = a.toPlane(u, v), again = b.toImage(plane.x(), plane.y());
      const double distance = std::hypot(again.x() - u, again.y() - v);
      worst = std::isfinite(distance) ? std::max(worst, distance) : HUGE_VAL;
    }
  }
  return worst;
}

void fillResiduals(const vpMicroscopeProblem &problem, const Solution &solution, vpMicroscopeCalibrationResult &result)
{
  double squares = 0.;
  std::size_t count = 0;
  for (std::size_t k = 0; k < problem.views(); ++k) {
    const Eigen::VectorXd residual = problem.view(solution.state, k).residual;
    for (Eigen::Index i = 0; i < residual.size() / 2; ++i) {
      const Eigen::Vector2d whitened = residual.segment<2>(2 * i);
      squares += whitened.cwiseProduct(problem.sigma(k, static_cast<std::size_t>(i))).squaredNorm();
      ++count;
      if (whitened.norm() > result.worstResidual) {
        result.worstResidual = whitened.norm();
        result.worstView = static_cast<int>(k);
        result.worstPoint = static_cast<int>(i);
      }
    }
  }
  result.residualRms = std::sqrt(squares / static_cast<double>(count));
  result.degreesOfFreedom = static_cast<int>(2 * count - problem.freeParameters().size() - 3 * problem.views());
  result.varianceFactor = result.degreesOfFreedom > 0 ? solution.chi2 / result.degreesOfFreedom : 1.;
}

template <class... Values> std::string sentence(const char *format, Values... values)
{
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string kappa1Sentence(const vpMicroscopeCalibrationResult &result, double estimate, double significance,
                           const vpMicroscopeCalibrationOptions &options)
{
  switch (result.kappa1Status) {
  case vpKappa1Status::NotAsked:
    return "The distortion was not asked for.";
  case vpKappa1Status::Estimated:
    return sentence("The distortion kappa1 is %.4g +- %.2g px^-2 and moves the worst corner of the image by %.2g px.",
                    estimate, result.kappa1Sigma, result.kappa1Effect);
  case vpKappa1Status::Unobservable:
    break;
  }
  if (significance < options.minSignificance) {
    return sentence("The distortion kappa1 is unobservable and taken as 0: the points say %.2g +- %.2g px^-2, %.1f "
                    "standard deviations from zero, less than %g.",
                    estimate, result.kappa1Sigma, significance, options.minSignificance);
  }
  return sentence("The distortion kappa1 is unobservable and taken as 0: in this field of view it would move the worst "
                  "corner by %.2g px, less than %g px.",
                  result.kappa1Effect, options.minEffect);
}

std::string messageOf(const vpMicroscopeCalibrationResult &result, const std::string &aboutKappa1)
{
  const vpMicroscopeCalibration &c = result.calibration;
  std::string text = sentence("The scale is %.8g +- %.2g px/m (%.6g um a pixel)", c.scaleX,
                              result.sigma(vpMicroscopeScaleX), c.pixelSizeUm());
  if (c.scaleY != c.scaleX) {
    text += sentence(" along u and %.8g +- %.2g px/m along v", c.scaleY, result.sigma(vpMicroscopeScaleY));
  }
  text += ". " + aboutKappa1;
  text += sentence(" The residuals are %.3g px (rms), %.3g times what the points' deviations say.", result.residualRms,
                   std::sqrt(result.varianceFactor));
  if (result.varianceFactor > suspicious * suspicious) {
    text +=
        " That is far too much: the plane is not parallel to the image, points are named wrongly, or the product is "
        "less regular than told.";
  }
  if (!result.converged) {
    text += " The refinement did not come to its end.";
  }
  return text;
}
// One run: closed-form start, fit without distortion, fit with it, choice between the two.
class Calibrator
{
public:
  Calibrator(const std::vector<std::vector<vpCalibrationPoint>> &points, const vpMicroscopeCalibrationOptions &options,
             unsigned int width, unsigned int height)
    : m_points(points), m_options(options), m_width(width), m_height(height)
  {
    for (const std::vector<vpCalibrationPoint> &view : points) {
      m_views.push_back(vpMakePlanarView(view, options.u0, options.v0, options.aspect));
      m_starts.push_back(vpStartPlanarView(m_views.back()));
      if (m_views.back().mirrored != m_views.front().mirrored) {
        const auto word = [](const vpPlanarView &v) { return v.mirrored ? "mirrored" : "as it is"; };
        throw vpException(vpException::badValue, "view %zu shows the product %s and view 0 %s", m_views.size() - 1,
                          word(m_views.back()), word(m_views.front()));
      }
    }
    m_weightScale = start(false).shared[State::Scale];
  }

  vpMicroscopeCalibrationResult run()
  {
    // Without distortion first: it is the answer where kappa1 cannot be told, and what its effect is compared with.
    Fit best = fit(false, false, start(false));
    if (m_options.estimateKappa1) {
      Fit bent = fit(true, false, start(true));
      if (!(bent.solution.chi2 <= best.solution.chi2)) { // a start that no pixel allows
        bent = fit(true, false, best.solution.state);
      }
      if (judgeKappa1(bent, best)) {
        best = bent;
        if (m_options.estimatePrincipalPoint) {
          best = fit(true, true, bent.solution.state);
          takeKappa1(best);
          m_result.principalPointEstimated = true;
        }
      }
    }
    fill(best);
    return m_result;
  }

private:
  struct Fit {
    vpMicroscopeProblem problem;
    Solution solution;
  };

  [[nodiscard]] State start(bool withKappa1) const
  {
    const vpPlanarScale scale = vpStartPlanarScale(m_views, m_starts, withKappa1);
    State state;
    state.shared = {{scale.scale, m_options.aspect, scale.kappa1, m_options.u0, m_options.v0}};
    for (const vpPlanarStart &view : m_starts) {
      state.local.emplace_back(view.rotation, scale.scale * view.t.x(), scale.scale * view.t.y());
    }
    return state;
  }

  [[nodiscard]] Fit fit(bool kappa1, bool principalPoint, const State &from) const
  {
    const std::array<bool, State::SharedCount> isFree = {
        {true, m_options.estimateAspect, kappa1, principalPoint, principalPoint}};
    const vpMicroscopeProblem problem(m_points, m_views, isFree, m_weightScale);
    return {problem, vpSolveBundle(problem, from)};
  }

  // What the covariance is multiplied by.
  [[nodiscard]] double factorOf(const Fit &fitted) const
  {
    vpMicroscopeCalibrationResult residuals;
    fillResiduals(fitted.problem, fitted.solution, residuals);
    return m_options.sigmaFromResiduals ? residuals.varianceFactor : 1.;
  }

  [[nodiscard]] vpMicroscopeCalibration calibration(const Fit &fitted) const
  {
    return calibrationOf(fitted.solution.state, m_views[0], m_width, m_height);
  }

  void takeKappa1(const Fit &fitted)
  {
    const std::vector<int> &isFree = fitted.problem.freeParameters();
    const auto at = std::find(isFree.begin(), isFree.end(), State::Kappa1) - isFree.begin();
    m_kappa1 = fitted.solution.state.shared[State::Kappa1];
    m_result.kappa1Sigma = std::sqrt(fitted.solution.sharedCovariance(at, at) * factorOf(fitted));
    m_significance = std::abs(m_kappa1) / m_result.kappa1Sigma;
  }

  // Whether the distortion is there and matters.
  bool judgeKappa1(const Fit &bent, const Fit &straight)
  {
    takeKappa1(bent);
    m_result.kappa1Effect = differenceAtCorners(calibration(bent), calibration(straight));
    const bool observable = bent.solution.converged && m_significance >= m_options.minSignificance &&
                            m_result.kappa1Effect >= m_options.minEffect;
    m_result.kappa1Status = observable ? vpKappa1Status::Estimated : vpKappa1Status::Unobservable;
    return observable;
  }

  void fill(const Fit &best)
  {
    const Solution &solution = best.solution;
    fillResiduals(best.problem, solution, m_result);
    const double factor = factorOf(best);
    m_result.calibration = calibration(best);
    for (std::size_t k = 0; k < m_views.size(); ++k) {
      const Placed placed = placeOf(solution.state, m_views[k], k);
      const Eigen::Matrix<double, 8, 8> by = resultBy(solution.state, placed);
      const Eigen::Matrix<double, 8, 8> covariance =
          factor * by * covarianceOf(solution, best.problem.freeParameters(), k) * by.transpose();
      m_result.placements.push_back(placed.placement);
      m_result.placements.back().covariance = covariance.bottomRightCorner<3, 3>();
      if (k == 0) {
        m_result.covariance = covariance;
      }
    }
    m_result.condition = solution.condition;
    m_result.iterations = solution.iterations;
    m_result.converged = solution.converged;
    m_result.message = messageOf(m_result, kappa1Sentence(m_result, m_kappa1, m_significance, m_options));
  }

  const std::vector<std::vector<vpCalibrationPoint>> &m_points; // owned by the caller
  const vpMicroscopeCalibrationOptions &m_options;              // owned by the caller
  unsigned int m_width;
  unsigned int m_height;
  std::vector<vpPlanarView> m_views;
  std::vector<vpPlanarStart> m_starts;
  double m_weightScale = 0.; // px/m
  double m_kappa1 = 0.;      // estimate, px^-2, whether it is used or not
  double m_significance = 0.;
  vpMicroscopeCalibrationResult m_result;
};
} // namespace

void vpMicroscopeCalibrationOptions::check() const
{
  vpCheckPrincipalPoint("u0", u0);
  vpCheckPrincipalPoint("v0", v0);
  vpCheckCalibrationRange("aspect", aspect, 0.1, 10., "");
  vpCheckCalibrationRange("minSignificance", minSignificance, 0., 100., "");
  vpCheckCalibrationRange("minEffect", minEffect, 0., 1e6, " px");
}

double vpMicroscopeCalibrationResult::sigma(vpMicroscopeParameter parameter) const
{
  return std::sqrt(std::max(0., covariance(parameter, parameter)));
}

vpPlanarMicroscopeCalibration::vpPlanarMicroscopeCalibration(unsigned int width, unsigned int height,
                                                             const vpMicroscopeCalibrationOptions &options)
  : m_width(width), m_height(height), m_options(options)
{
  vpCheckCalibrationImage(width, height);
  options.check();
  if (std::isnan(options.u0)) {
    m_options.u0 = 0.5 * (width - 1.);
  }
  if (std::isnan(options.v0)) {
    m_options.v0 = 0.5 * (height - 1.);
  }
}

void vpPlanarMicroscopeCalibration::addView(const std::vector<vpCalibrationPoint> &points)
{
  const std::size_t view = m_views.size();
  vpCheckCalibrationView(view, points, leastPoints);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].z != 0.) {
      throw vpException(vpException::badValue, "point %zu of view %zu: z is %g m, must be 0", i, view, points[i].z);
    }
  }
  if (vpSpreadOf(points).isLine()) {
    throw vpException(vpException::badValue, "the points of view %zu lie on a line of the product", view);
  }
  if (vpImageSpreadOf(points).isLine()) {
    throw vpException(vpException::badValue, "the points of view %zu lie on a line of the image", view);
  }
  m_views.push_back(points);
}

vpMicroscopeCalibrationResult vpPlanarMicroscopeCalibration::compute() const
{
  if (m_views.empty()) {
    throw vpException(vpException::badValue, "there is no view to calibrate from");
  }
  return Calibrator(m_views, m_options, m_width, m_height).run();
}

const char *toString(vpKappa1Status status)
{
  switch (status) {
  case vpKappa1Status::Estimated:
    return "Estimated";
  case vpKappa1Status::Unobservable:
    return "Unobservable";
  case vpKappa1Status::NotAsked:
    break;
  }
  return "NotAsked";
}

END_VISP_NAMESPACE
