/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCalibrationBundle.h"
#include "vpFieldCheck.h"
#include "vpCalibrationInput.h"
#include "vpTsaiCalibrationStart.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpRotationMatrix.h>
#include <visp3/core/vpTranslationVector.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/pattern/vpTsaiCalibration.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr std::size_t leastPoints = 6;
constexpr std::size_t leastOfBody = 8;
constexpr std::size_t mostLeftOut = 30; // views left out in turn after a misfit
constexpr double largestDoubt = 0.1;    // standard deviation of f over f in a reliable result

struct State {
  // f (px, columns), aspect, kappa1 (px^-2), u0, v0 (px).
  enum Shared { F, Aspect, Kappa1, U0, V0, SharedCount };
  std::array<double, SharedCount> shared{};
  std::vector<vpTsaiPose> poses;
};

// Step 2 of Tsai's calibration: distances in the image, for vpSolveBundle().
class Problem
{
public:
  Problem(const std::vector<std::vector<vpCalibrationPoint>> &points, const std::vector<vpTsaiView> &views,
          const std::array<bool, State::SharedCount> &isFree)
    : m_points(&points), m_views(&views)
  {
    for (int i = 0; i < State::SharedCount; ++i) {
      if (isFree[static_cast<std::size_t>(i)]) {
        m_free.push_back(i);
      }
    }
  }
  [[nodiscard]] Eigen::Index shared() const { return static_cast<Eigen::Index>(m_free.size()); }
  [[nodiscard]] std::size_t views() const { return m_views->size(); }
  [[nodiscard]] const std::vector<int> &freeParameters() const { return m_free; }
  // Local parameters: a rotation of the camera frame (rad), then t (m).
  [[nodiscard]] vpBundleView view(const State &state, std::size_t k) const;
  // Standard deviation of a residual, px.
  [[nodiscard]] Eigen::Vector2d sigma(std::size_t k, std::size_t i) const
  {
    return {(*m_points)[k][i].sigmaU, (*m_points)[k][i].sigmaV};
  }
  [[nodiscard]] State plus(const State &state, const Eigen::VectorXd &shared,
                           const std::vector<Eigen::VectorXd> &local) const;

private:
  const std::vector<std::vector<vpCalibrationPoint>> *m_points; // owned by the caller
  const std::vector<vpTsaiView> *m_views;                       // owned by the caller
  std::vector<int> m_free;
};

vpBundleView Problem::view(const State &state, std::size_t k) const
{
  const std::vector<vpCalibrationPoint> &points = (*m_points)[k];
  const auto n = static_cast<Eigen::Index>(points.size());
  vpBundleView result;
  result.byShared.setZero(2 * n, shared());
  result.byLocal.setZero(2 * n, 6);
  result.residual.resize(2 * n);
  const double f = state.shared[State::F], aspect = state.shared[State::Aspect];
  const vpTsaiPose &pose = state.poses[k];
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d turned = pose.R * (*m_views)[k].p.col(i), p = turned + pose.t;
    if (!(f > 0. && aspect > 0. && p.z() > 0.)) {
      result.residual.setConstant(std::numeric_limits<double>::quiet_NaN());
      return result;
    }
    const Eigen::Vector2d normalised = p.head<2>() / p.z();
    const vpDistortedPoint seen = vpDistort(f * normalised, state.shared[State::Kappa1]);
    const vpCalibrationPoint &point = points[static_cast<std::size_t>(i)];
    result.residual[2 * i] = (point.u - state.shared[State::U0] - seen.d.x()) / point.sigmaU;
    result.residual[2 * i + 1] = (point.v - state.shared[State::V0] - aspect * seen.d.y()) / point.sigmaV;
    const Eigen::Vector2d toPixel(1. / point.sigmaU, aspect / point.sigmaV); // of d
    Eigen::Matrix<double, 2, State::SharedCount> byAll;
    byAll.col(State::F) = toPixel.asDiagonal() * seen.byIdeal * normalised;
    byAll.col(State::Aspect) << 0., seen.d.y() / point.sigmaV;
    byAll.col(State::Kappa1) = toPixel.asDiagonal() * seen.byKappa1;
    byAll.col(State::U0) << 1. / point.sigmaU, 0.;
    byAll.col(State::V0) << 0., 1. / point.sigmaV;
    for (std::size_t j = 0; j < m_free.size(); ++j) {
      result.byShared.block<2, 1>(2 * i, static_cast<Eigen::Index>(j)) = byAll.col(m_free[j]);
    }
    Eigen::Matrix<double, 2, 3> projection;
    projection << 1., 0., -normalised.x(), 0., 1., -normalised.y();
    const Eigen::Matrix<double, 2, 3> byPoint = toPixel.asDiagonal() * seen.byIdeal * (f / p.z()) * projection;
    result.byLocal.block<2, 3>(2 * i, 0) = -byPoint * vpSO3::skew(turned);
    result.byLocal.block<2, 3>(2 * i, 3) = byPoint;
  }
  return result;
}

State Problem::plus(const State &state, const Eigen::VectorXd &shared, const std::vector<Eigen::VectorXd> &local) const
{
  State next = state;
  for (std::size_t j = 0; j < m_free.size(); ++j) {
    next.shared[static_cast<std::size_t>(m_free[j])] += shared[static_cast<Eigen::Index>(j)];
  }
  for (std::size_t k = 0; k < local.size(); ++k) {
    next.poses[k].R = vpSO3::exp(local[k].head<3>()) * next.poses[k].R;
    next.poses[k].t += local[k].tail<3>();
  }
  return next;
}

vpHomogeneousMatrix poseOf(const vpTsaiPose &pose, const Eigen::Vector3d &origin)
{
  const Eigen::Vector3d t = pose.t - pose.R * origin;
  vpRotationMatrix R;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      R[i][j] = pose.R(i, j);
    }
  }
  return {vpTranslationVector(t.x(), t.y(), t.z()), R};
}

// Focal length and pose from one view; the better of two where the tilt may have two signs.
vpTsaiDepth bestDepth(const vpTsaiView &view, const std::vector<vpTsaiPose> &poses, double f, vpTsaiPose &best)
{
  vpTsaiDepth result;
  for (const vpTsaiPose &pose : poses) {
    const vpTsaiDepth depth = vpFindTsaiDepth(view, pose, f);
    if (depth.sensible && (!result.sensible || depth.misfit < result.misfit)) {
      result = depth;
      best = pose;
      best.t.z() = depth.tz;
    }
  }
  return result;
}

// Poses for a focal length; false when a view has none.
bool placeAll(const std::vector<vpTsaiView> &views, const std::vector<std::vector<vpTsaiPose>> &candidates, double f,
              State &state, double &misfit)
{
  state.poses.assign(views.size(), vpTsaiPose());
  misfit = 0.;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const vpTsaiDepth depth = bestDepth(views[k], candidates[k], f, state.poses[k]);
    if (!depth.sensible) {
      return false;
    }
    misfit += depth.misfit * depth.misfit;
  }
  state.shared[State::F] = f;
  return true;
}

// The focal length with which all views fit best, among those of single views and a range of plausible ones: a view
// with little tilt contains little information.
bool start(const std::vector<vpTsaiView> &views, const std::vector<std::vector<vpTsaiPose>> &candidates, double width,
           State &state)
{
  std::vector<double> told;
  for (std::size_t k = 0; k < views.size(); ++k) {
    vpTsaiPose ignored;
    const vpTsaiDepth depth = bestDepth(views[k], candidates[k], 0., ignored);
    if (depth.sensible) {
      told.push_back(depth.f);
    }
  }
  if (!told.empty()) {
    told.push_back(vpMedian(told));
  }
  for (const double share : {0.5, 0.8, 1.2, 2., 4., 8.}) {
    told.push_back(share * width);
  }
  double least = HUGE_VAL;
  for (const double f : told) {
    State trial = state;
    double misfit = 0.;
    if (placeAll(views, candidates, f, trial, misfit) && misfit < least) {
      least = misfit;
      state = trial;
    }
  }
  return std::isfinite(least);
}

std::string messageOf(const vpTsaiCalibrationResult &result)
{
  std::string text =
      vpSentence("The focal length is %.6g +- %.2g px, the principal point (%.6g +- %.2g, %.6g +- %.2g) px"
                 ", kappa1 %.4g +- %.2g px^-2. The residuals are %.3g px (rms).",
                 result.px, result.sigma(vpTsaiPx), result.u0, result.sigma(vpTsaiU0), result.v0,
                 result.sigma(vpTsaiV0), result.kappa1, result.sigma(vpTsaiKappa1), result.residualRms);
  if (!result.converged) {
    text += " The refinement did not come to its end.";
  }
  if (!(result.sigma(vpTsaiPx) < largestDoubt * result.px)) {
    text += " This is not reliable: the views do not tell the focal length apart from the distance. Tilt the plane, or "
            "for a plane parallel to the image use the planar microscope calibration.";
  }
  else if (!result.reliable) {
    text += " This is not reliable.";
  }
  return text + " " + result.fit.message(result.varianceFactor);
}

Eigen::Matrix<double, vpTsaiParameterCount, vpTsaiParameterCount> covarianceOf(const vpBundleSolution<State> &solution,
                                                                               const std::vector<int> &isFree)
{
  Eigen::Matrix<double, vpTsaiParameterCount, vpTsaiParameterCount> all, by;
  all.setZero();
  by.setIdentity(); // the order is the same, only py consists of two
  by(vpTsaiPy, State::F) = solution.state.shared[State::Aspect];
  by(vpTsaiPy, State::Aspect) = solution.state.shared[State::F];
  for (std::size_t i = 0; i < isFree.size(); ++i) {
    for (std::size_t j = 0; j < isFree.size(); ++j) {
      all(isFree[i], isFree[j]) = solution.sharedCovariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  return by * all * by.transpose();
}

vpTsaiCalibrationResult resultOf(const Problem &problem, const vpBundleSolution<State> &solution,
                                 const std::vector<std::vector<vpCalibrationPoint>> &points,
                                 const std::vector<vpTsaiView> &views, const vpTsaiCalibrationSpec &spec)
{
  vpTsaiCalibrationResult result;
  const std::array<double, State::SharedCount> &s = solution.state.shared;
  result.px = s[State::F];
  result.py = s[State::F] * s[State::Aspect];
  result.kappa1 = s[State::Kappa1];
  result.u0 = s[State::U0];
  result.v0 = s[State::V0];
  const std::vector<vpFitTestView> linear = vpLinearised(problem, solution, points);
  double squares = 0.;
  int count = 0;
  for (std::size_t k = 0; k < views.size(); ++k) {
    result.cMo.push_back(poseOf(solution.state.poses[k], views[k].origin));
    const double ofView = linear[k].linear.residual.cwiseProduct(linear[k].sigma.reshaped()).squaredNorm();
    result.viewRms.push_back(std::sqrt(ofView / static_cast<double>(points[k].size())));
    squares += ofView;
    count += static_cast<int>(points[k].size());
  }
  result.residualRms = std::sqrt(squares / count);
  result.degreesOfFreedom = 2 * count - static_cast<int>(problem.shared()) - 6 * static_cast<int>(views.size());
  result.varianceFactor = result.degreesOfFreedom > 0 ? solution.chi2 / result.degreesOfFreedom : 1.;
  result.covariance =
      (spec.sigmaFromResiduals ? result.varianceFactor : 1.) * covarianceOf(solution, problem.freeParameters());
  result.condition = solution.condition;
  result.iterations = solution.iterations;
  result.converged = solution.converged;
  result.fit = vpTestFit(linear, spec.falseAlarm, !spec.sigmaFromResiduals);
  result.reliable = solution.converged && result.sigma(vpTsaiPx) < largestDoubt * result.px &&
                    result.fit.verdict == vpFitVerdict::Fits;
  return result;
}
} // namespace

void vpTsaiCalibrationSpec::check() const
{
  constexpr vpFieldCheck fields("the calibration");
  vpCheckPrincipalPoint("u0", u0);
  vpCheckPrincipalPoint("v0", v0);
  fields.in("aspect", aspect, {0.1, 10.});
  fields.in("falseAlarm", falseAlarm, {1e-12, 0.5});
}

double vpTsaiCalibrationResult::sigma(vpTsaiParameter parameter) const
{
  return std::sqrt(std::max(0., covariance(parameter, parameter)));
}

vpCameraParameters vpTsaiCalibrationResult::toCamera() const
{
  const double kdu = kappa1 * px * px;
  vpCameraParameters camera;
  camera.initPersProjWithDistortion(px, py, u0, v0, -kdu, kdu);
  return camera;
}

vpTsaiCalibration::vpTsaiCalibration(unsigned int width, unsigned int height, const vpTsaiCalibrationSpec &spec)
  : m_width(width), m_spec(spec)
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

void vpTsaiCalibration::addView(const std::vector<vpCalibrationPoint> &points)
{
  const std::size_t view = m_views.size();
  vpCheckCalibrationView(view, points, leastPoints);
  const vpCalibrationSpread spread = vpSpreadOf(points);
  if (spread.isLine()) {
    throw vpException(vpException::badValue, "the points of view %zu lie on a line of the object", view);
  }
  if (vpImageSpreadOf(points).isLine()) {
    throw vpException(vpException::badValue, "the points of view %zu lie on a line of the image", view);
  }
  if (!spread.isPlane() && points.size() < leastOfBody) {
    throw vpException(vpException::badValue, "view %zu has %zu points that lie in no plane, must have at least %zu",
                      view, points.size(), leastOfBody);
  }
  m_views.push_back(points);
}

vpTsaiCalibrationResult vpTsaiCalibration::compute() const
{
  if (m_views.empty()) {
    throw vpException(vpException::badValue, "there is no view to calibrate from");
  }
  vpTsaiCalibrationResult result = solve(m_views);
  findWorstView(result);
  result.message = messageOf(result);
  return result;
}

// A grossly wrong view biases the others, so that its own residuals need not be the largest: the rest is computed
// without it.
void vpTsaiCalibration::findWorstView(vpTsaiCalibrationResult &result) const
{
  if (result.fit.verdict != vpFitVerdict::Misfit || m_views.size() < 3 || m_views.size() > mostLeftOut) {
    return;
  }
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    std::vector<std::vector<vpCalibrationPoint>> others = m_views;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    try {
      const double factor = solve(others).varianceFactor;
      if (factor < least) {
        least = factor;
        result.fit.worstView = static_cast<int>(k);
        result.fit.worstViewRms = result.viewRms[k];
      }
    }
    catch (const vpException &) { // no camera can see the other views so: it is not this view
    }
  }
}

vpTsaiCalibrationResult vpTsaiCalibration::solve(const std::vector<std::vector<vpCalibrationPoint>> &points) const
{
  std::vector<vpTsaiView> views;
  std::vector<std::vector<vpTsaiPose>> candidates;
  for (const std::vector<vpCalibrationPoint> &view : points) {
    views.push_back(vpMakeTsaiView(view, m_spec.u0, m_spec.v0, m_spec.aspect));
    candidates.push_back(vpAlignTsaiView(views.back()));
    if (candidates.back().empty()) {
      throw vpException(vpException::fatalError,
                        "the points of view %zu do not determine its pose: too many of them lie on a line",
                        views.size() - 1);
    }
  }
  State state;
  state.shared = {{0., m_spec.aspect, 0., m_spec.u0, m_spec.v0}};
  if (!start(views, candidates, m_width, state)) {
    throw vpException(vpException::fatalError, "no camera sees the points so: are they mirrored, or is y or z turned?");
  }
  const bool onePlane = views.size() == 1 && views[0].planar;
  const bool aspect = m_spec.estimateAspect && !onePlane, principal = m_spec.estimatePrincipalPoint && !onePlane;
  // From few parameters to many: far from the solution weakly determined ones diverge.
  const Problem few(points, views, {{true, false, false, false, false}});
  state = vpSolveBundle(few, state).state;
  if (m_spec.estimateKappa1) {
    const Problem more(points, views, {{true, false, true, false, false}});
    state = vpSolveBundle(more, state).state;
  }
  const Problem problem(points, views, {{true, aspect, m_spec.estimateKappa1, principal, principal}});
  return resultOf(problem, vpSolveBundle(problem, state), points, views, m_spec);
}

END_VISP_NAMESPACE
