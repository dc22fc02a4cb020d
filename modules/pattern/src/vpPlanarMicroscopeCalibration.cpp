/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCalibrationInput.h"
#include "vpFieldCheck.h"
#include "vpMicroscopeCalibrationProblem.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>
#include <visp3/pattern/vpPlanarMicroscopeCalibration.h>

#include <algorithm>
#include <cmath>
#include <optional>

BEGIN_VISP_NAMESPACE

namespace
{
using State = vpMicroscopeState;
using Solution = vpBundleSolution<State>;

constexpr std::size_t leastPoints = 6;
constexpr double largestUnseen = 0.01; // share of the distance that an unseen distortion moves the farthest corner by

// Internal results and decisions.
struct Decision {
  double kappa1 = 0.;            // estimate, px^-2, whether it is used or not
  double significance = 0.;      // of kappa1, standard deviations
  bool hiddenDistortion = false; // distortion is present, but the points cover too little of the image to estimate it
  double looksTilted = 0.;       // from foreshortening, rad
};

std::string aboutKappa1(const vpMicroscopeCalibrationResult &result, const Decision &decision,
                        const vpMicroscopeCalibrationSpec &spec)
{
  switch (result.kappa1Status) {
  case vpKappa1Status::NotAsked:
    return "The distortion was not asked for.";
  case vpKappa1Status::Estimated:
    return vpSentence("The distortion kappa1 is %.4g +- %.2g px^-2 and moves the worst corner of the image by %.2g px.",
                      decision.kappa1, result.kappa1Sigma, result.kappa1Effect);
  case vpKappa1Status::Unobservable:
    break;
  }
  if (result.kappa1CornerSigma > spec.maxCornerSigma) {
    return vpSentence(
        "The distortion kappa1 is unobservable and taken as 0: the points cover so little of the image that "
        "its deviation of %.2g px^-2 is %.3g px at the farthest corner, more than %g px.",
        result.kappa1Sigma, result.kappa1CornerSigma, spec.maxCornerSigma);
  }
  if (decision.significance < spec.minSignificance) {
    return vpSentence("The distortion kappa1 is unobservable and taken as 0: the points say %.2g +- %.2g px^-2, %.1f "
                      "standard deviations from zero, less than %g.",
                      decision.kappa1, result.kappa1Sigma, decision.significance, spec.minSignificance);
  }
  return vpSentence(
      "The distortion kappa1 is unobservable and taken as 0: in this field of view it would move the worst "
      "corner by %.2g px, less than %g px.",
      result.kappa1Effect, spec.minEffect);
}

std::string aboutTilt(const vpMicroscopeCalibrationResult &result, const vpMicroscopeCalibrationSpec &spec)
{
  if (!spec.estimateTilt) {
    return "";
  }
  const vpMicroscopeCalibration &c = result.calibration;
  const double tilt = std::hypot(c.tiltX, c.tiltY);
  const double sigma = std::hypot(result.sigma(vpMicroscopeTiltX), result.sigma(vpMicroscopeTiltY)) / std::sqrt(2.);
  return vpSentence(" By a tilt the scale changes by %.2g +- %.1g %% over the width of the image.",
                    100. * tilt * c.width, 100. * sigma * c.width);
}

std::string messageOf(const vpMicroscopeCalibrationResult &result, const Decision &decision,
                      const vpMicroscopeCalibrationSpec &spec)
{
  const vpMicroscopeCalibration &c = result.calibration;
  std::string text = vpSentence("The scale is %.8g +- %.2g px/m (%.6g um a pixel)", c.scaleX,
                                result.sigma(vpMicroscopeScaleX), c.pixelSizeUm());
  if (c.scaleY != c.scaleX) {
    text += vpSentence(" along u and %.8g +- %.2g px/m along v", c.scaleY, result.sigma(vpMicroscopeScaleY));
  }
  text += ". " + aboutKappa1(result, decision, spec) + aboutTilt(result, spec);
  text += vpSentence(" The residuals are %.3g px (rms), %.3g times what the points' deviations say.",
                     result.residualRms, std::sqrt(result.varianceFactor));
  if (!result.converged) {
    text += " The refinement did not come to its end.";
  }
  if (!result.reliable) {
    text += " This is not reliable.";
  }
  if (decision.hiddenDistortion) {
    text +=
        vpSentence(" There is a distortion (%.1f standard deviations from zero) that the points cannot tell for the "
                   "whole image: cover more of it.",
                   decision.significance);
  }
  if (result.looksTiltedTooFar) {
    text += vpSentence(
        " The product looks as if tilted by %.3g degrees: it is, or a pitch is wrong, or the cells are on another "
        "lattice than specified.",
        vpMath::deg(decision.looksTilted));
  }
  return text + " " + result.fit.message(result.varianceFactor);
}

// Largest distance between the two at the corners of the image, px. Infinite where one of them has no inverse.
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

// One run: closed-form initial value, fit without distortion, fit with it, choice between the two.
class Calibrator
{
public:
  Calibrator(const std::vector<std::vector<vpCalibrationPoint>> &points, const vpMicroscopeCalibrationSpec &spec,
             unsigned int width, unsigned int height)
    : m_points(points), m_spec(spec), m_width(width), m_height(height)
  {
    for (const std::vector<vpCalibrationPoint> &view : points) {
      m_views.push_back(vpMakePlanarView(view, spec.u0, spec.v0, spec.aspect));
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
    // Without distortion first: it is the result where kappa1 is unobservable, and the reference for its effect.
    Fit best = fit(false, false, start(false));
    if (m_spec.estimateKappa1) {
      Fit bent = fit(true, false, start(true));
      if (!(bent.solution.chi2 <= best.solution.chi2)) { // an initial value that no pixel allows
        bent = fit(true, false, best.solution.state);
      }
      if (judgeKappa1(bent, best)) {
        best = bent;
        if (m_spec.estimatePrincipalPoint) {
          best = fit(true, true, bent.solution.state);
          takeKappa1(best);
          m_result.principalPointEstimated = true;
        }
      }
      else {
        m_unseen = bent;
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
    state.shared = {{scale.scale, m_spec.aspect, scale.kappa1, m_spec.u0, m_spec.v0, 0., 0., 0., 0.}};
    for (const vpPlanarStart &view : m_starts) {
      state.local.emplace_back(view.rotation, scale.scale * view.t.x(), scale.scale * view.t.y());
    }
    return state;
  }

  [[nodiscard]] Fit fit(bool kappa1, bool principalPoint, const State &from) const
  {
    const bool tilt = m_spec.estimateTilt, aspect = m_spec.estimateAspect;
    // Aspect and stretch are equivalent except for the distortion.
    const std::array<bool, State::SharedCount> isFree = {
        {true, aspect, kappa1, principalPoint, principalPoint, tilt, tilt, tilt && !aspect, tilt}};
    const vpMicroscopeProblem problem(m_points, m_views, isFree, m_weightScale);
    return {problem, vpSolveBundle(problem, from)};
  }

  [[nodiscard]] int degreesOf(const Fit &fitted) const
  {
    std::size_t numbers = 0;
    for (const std::vector<vpCalibrationPoint> &view : m_points) {
      numbers += 2 * view.size();
    }
    return static_cast<int>(numbers) - static_cast<int>(fitted.problem.shared()) - 3 * static_cast<int>(m_views.size());
  }

  [[nodiscard]] double varianceFactorOf(const Fit &fitted) const
  {
    const int degrees = degreesOf(fitted);
    return degrees > 0 ? fitted.solution.chi2 / degrees : 1.;
  }

  // Factor of the covariance.
  [[nodiscard]] double factorOf(const Fit &fitted) const
  {
    return m_spec.sigmaFromResiduals ? varianceFactorOf(fitted) : 1.;
  }

  [[nodiscard]] vpMicroscopeCalibration calibration(const Fit &fitted) const
  {
    return vpMicroscopeCalibrationOf(fitted.solution.state, m_views[0], m_width, m_height);
  }

  [[nodiscard]] vpMicroscopeCovariance covarianceOf(const Fit &fitted, std::size_t k) const
  {
    return factorOf(fitted) * vpMicroscopeCovarianceOf(fitted.solution, fitted.problem.freeParameters(), m_views[k], k);
  }

  // Distance of the farthest image corner from the principal point, px (columns).
  [[nodiscard]] double farthestCorner(const State &state) const
  {
    const double u0 = state.shared[State::U0], v0 = state.shared[State::V0];
    return std::hypot(std::max(std::abs(u0), std::abs(m_width - 1. - u0)),
                      std::max(std::abs(v0), std::abs(m_height - 1. - v0)) / state.shared[State::Aspect]);
  }

  void takeKappa1(const Fit &fitted)
  {
    const std::vector<int> &isFree = fitted.problem.freeParameters();
    const auto at = std::find(isFree.begin(), isFree.end(), State::Kappa1) - isFree.begin();
    m_decision.kappa1 = fitted.solution.state.shared[State::Kappa1];
    m_result.kappa1Sigma = std::sqrt(fitted.solution.sharedCovariance(at, at) * factorOf(fitted));
    m_result.kappa1CornerSigma = m_result.kappa1Sigma * std::pow(farthestCorner(fitted.solution.state), 3);
    m_decision.significance = std::abs(m_decision.kappa1) / m_result.kappa1Sigma;
  }

  // Whether the distortion is significant, relevant, and known.
  bool judgeKappa1(const Fit &bent, const Fit &straight)
  {
    takeKappa1(bent);
    m_result.kappa1Effect = differenceAtCorners(calibration(bent), calibration(straight));
    const bool isThere = bent.solution.converged && m_decision.significance >= m_spec.minSignificance &&
                         m_result.kappa1Effect >= m_spec.minEffect;
    const bool isKnown = m_result.kappa1CornerSigma <= m_spec.maxCornerSigma;
    m_decision.hiddenDistortion = isThere && !isKnown;
    m_result.kappa1Status = isThere && isKnown ? vpKappa1Status::Estimated : vpKappa1Status::Unobservable;
    return isThere && isKnown;
  }

  // Effect on the other parameters of a distortion taken as zero: of its deviation or its estimate.
  [[nodiscard]] vpMicroscopeCovariance unseenBy(std::size_t k) const
  {
    const vpMicroscopeCovariance C = covarianceOf(*m_unseen, k);
    const double corner = farthestCorner(m_unseen->solution.state);
    const double kappa1 =
        std::min(std::max(m_result.kappa1Sigma, std::abs(m_decision.kappa1)), largestUnseen / (corner * corner));
    Eigen::Matrix<double, vpMicroscopeParameterCount, 1> change =
        C.col(vpMicroscopeKappa1) * (kappa1 / C(vpMicroscopeKappa1, vpMicroscopeKappa1));
    change[vpMicroscopeKappa1] = 0.;
    return change * change.transpose();
  }

  void fill(const Fit &best)
  {
    const Solution &solution = best.solution;
    m_result.calibration = calibration(best);
    for (std::size_t k = 0; k < m_views.size(); ++k) {
      vpMicroscopeCovariance covariance = covarianceOf(best, k);
      if (m_unseen) {
        covariance += unseenBy(k);
      }
      m_result.placements.push_back(vpMicroscopePlaceOf(solution.state, m_views[k], k));
      m_result.placements.back().covariance = covariance.block<3, 3>(vpMicroscopeRotation, vpMicroscopeRotation);
      if (k == 0) {
        m_result.covariance = covariance;
      }
    }
    m_result.condition = solution.condition;
    m_result.iterations = solution.iterations;
    m_result.converged = solution.converged;
    m_result.degreesOfFreedom = degreesOf(best);
    m_result.varianceFactor = varianceFactorOf(best);
    judgeFit(best);
    m_result.message = messageOf(m_result, m_decision, m_spec);
  }

  void judgeFit(const Fit &best)
  {
    const std::vector<vpFitTestView> views = vpLinearised(best.problem, best.solution, m_points);
    m_result.fit = vpTestFit(views, m_spec.falseAlarm, !m_spec.sigmaFromResiduals);
    double squares = 0., count = 0.;
    for (const vpFitTestView &view : views) {
      squares += view.linear.residual.cwiseProduct(view.sigma.reshaped()).squaredNorm();
      count += static_cast<double>(view.sigma.cols());
    }
    m_result.residualRms = std::sqrt(squares / count);
    // Along and across the tilt the scales are as 1 + s and 1 - s.
    const double s = std::hypot(m_result.calibration.stretch, m_result.calibration.shear);
    const double sigma = std::hypot(m_result.sigma(vpMicroscopeStretch), m_result.sigma(vpMicroscopeShear));
    m_decision.looksTilted = std::acos(std::max(-1., (1. - s) / (1. + s)));
    const double sure = std::max(0., s - 3. * sigma);
    m_result.looksTiltedTooFar = (1. - sure) / (1. + sure) < std::cos(m_spec.maxTilt);
    m_result.reliable = m_result.converged && m_result.fit.verdict == vpFitVerdict::Fits &&
                        !m_decision.hiddenDistortion && !m_result.looksTiltedTooFar;
  }

  const std::vector<std::vector<vpCalibrationPoint>> &m_points; // owned by the caller
  const vpMicroscopeCalibrationSpec &m_spec;                    // owned by the caller
  unsigned int m_width;
  unsigned int m_height;
  std::vector<vpPlanarView> m_views;
  std::vector<vpPlanarStart> m_starts;
  double m_weightScale = 0.; // px/m
  Decision m_decision;
  std::optional<Fit> m_unseen; // with the distortion that the result omits
  vpMicroscopeCalibrationResult m_result;
};
} // namespace

void vpMicroscopeCalibrationSpec::check() const
{
  constexpr vpFieldCheck fields("the calibration");
  vpCheckPrincipalPoint("u0", u0);
  vpCheckPrincipalPoint("v0", v0);
  fields.in("aspect", aspect, {0.1, 10.});
  fields.in("minSignificance", minSignificance, {0., 100.});
  fields.in("minEffect", minEffect, {0., 1e6}, "px");
  fields.in("maxCornerSigma", maxCornerSigma, {0., 1e6}, "px");
  fields.in("maxTilt", maxTilt, {0., 0.5}, "rad");
  fields.in("falseAlarm", falseAlarm, {1e-12, 0.5});
}

double vpMicroscopeCalibrationResult::sigma(vpMicroscopeParameter parameter) const
{
  return std::sqrt(std::max(0., covariance(parameter, parameter)));
}

vpPlanarMicroscopeCalibration::vpPlanarMicroscopeCalibration(unsigned int width, unsigned int height,
                                                             const vpMicroscopeCalibrationSpec &spec)
  : m_width(width), m_height(height), m_spec(spec)
{
  vpCheckCalibrationImage(width, height);
  spec.check();
  if (std::isnan(spec.u0)) {
    m_spec.u0 = 0.5 * (width - 1.);
  }
  if (std::isnan(spec.v0)) {
    m_spec.v0 = 0.5 * (height - 1.);
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
  return Calibrator(m_views, m_spec, m_width, m_height).run();
}

const char *vpToString(vpKappa1Status status)
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
