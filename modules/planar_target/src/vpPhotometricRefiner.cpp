/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPhotometricRefiner.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double largestShift = 0.3; // samples; at the start of a level
constexpr double usualMove = 0.1;    // usual step, share of the distance
constexpr double usualTurn = 0.03;   // usual step, rad
constexpr double coarsePixels = 4.;  // per sample; at coarser levels
constexpr double coarseTilt = 1e-4;  // rad, keeps the tilt unchanged
constexpr double converged = 0.02;   // samples; the last step at the finest level
constexpr double largestStep = 0.5;  // rad, and share of the distance; a longer step is divergence
constexpr unsigned int patience = 8; // steps; if the last one is still large, there is no convergence

// The eight parameters of a homography I + A near the identity:
// dx = a0 x + a1 y + a2 - x (a6 x + a7 y), dy = a3 x + a4 y + a5 - y (a6 x + a7 y).
Eigen::Matrix<double, 8, 1> planeMotion(const Eigen::Matrix3d &A)
{
  Eigen::Matrix<double, 8, 1> a;
  a << A(0, 0) - A(2, 2), A(0, 1), A(0, 2), A(1, 0), A(1, 1) - A(2, 2), A(1, 2), A(2, 0), A(2, 1);
  return a;
}

// P of "homography, gain and bias = P (v, w, gain, bias)": M(T) of the class description with its -g.
Eigen::Matrix<double, 10, 8> poseToDesign(const vpRigidPose &pose, double unit, double gain)
{
  Eigen::Matrix3d G;
  G << unit * pose.R.col(0), unit * pose.R.col(1), pose.t;
  const Eigen::Matrix3d inverse = G.inverse();
  Eigen::Matrix<double, 10, 8> P = Eigen::Matrix<double, 10, 8>::Zero();
  for (int j = 0; j < 3; ++j) {
    P.block<8, 1>(0, j) = -gain * planeMotion(inverse.col(j) * Eigen::RowVector3d(0., 0., 1.));
    Eigen::Matrix3d turned = vpSO3::skew(Eigen::Vector3d::Unit(j)) * G;
    turned.col(2).setZero();
    P.block<8, 1>(0, 3 + j) = -gain * planeMotion(inverse * turned);
  }
  P(8, 6) = P(9, 7) = 1.;
  return P;
}
} // namespace

vpPhotometricRefiner::vpPhotometricRefiner(const vpPhotometricModel &model, const vpTargetPlane &plane,
                                           const vpPinhole &camera, bool precise)
  : m_model(model), m_plane(plane), m_photometry(model, camera), m_precise(precise)
{}

std::size_t vpPhotometricRefiner::finestUseful(const vpRigidPose &pose) const
{
  std::size_t level = 0;
  // More than two samples a pixel each way only cost time.
  while (level + 1 < m_model.levels() && m_photometry.pixelsPerSample(level, pose) < 0.5) {
    ++level;
  }
  return level;
}

// Sum of w row row^T with the residual in column 10.
vpPhotometricRefiner::Design vpPhotometricRefiner::accumulate(const vpPhotometricLevel &level, double sigma,
                                                              double shift) const
{
  const vpGreyGrid grid = {level.rows,
                           level.stride,
                           static_cast<float>(level.firstX),
                           static_cast<float>(level.pitchX),
                           static_cast<float>(level.firstY),
                           static_cast<float>(level.pitchY)};
  double sums[144] = {};
  m_loops.normalSums(m_photometry.samples(level, sigma, shift), grid, sums);
  const Design upper = Eigen::Map<const Eigen::Matrix<double, 12, 12, Eigen::RowMajor>>(sums);
  return upper.selfadjointView<Eigen::Upper>();
}

/*
 * One Gauss-Newton step at one level. shift, in samples, is the possible pose error, before and after. sigma never
 * grows within a level: otherwise a step that increases the residuals would look like a noisier image.
 */
bool vpPhotometricRefiner::iterate(const std::vector<cv::Mat> &pyramid, std::size_t index,
                                   const vpPhotometricLevel &level, vpRigidPose &pose, double &shift, double &sigma)
{
  sigma = std::min(sigma, m_photometry.textureDeviation(level));
  const Design N = accumulate(level, sigma, shift);
  const double gain = std::max(m_photometry.gain(), vpPhotometry::smallestGain);
  const Eigen::Matrix<double, 10, 8> P = poseToDesign(pose, m_model.unit(), gain);
  Eigen::Matrix<double, 8, 8> normal = P.transpose() * N.topLeftCorner<10, 10>() * P;
  // Prior on the step size: regularises weakly observable directions, above all the tilt, without moving a fixed point.
  const double tilt = m_photometry.pixelsPerSample(index, pose) > coarsePixels ? coarseTilt : usualTurn;
  const auto hold = [sigma](double usual) { return sigma * sigma / (usual * usual); };
  normal.diagonal().head<3>().array() += hold(usualMove * pose.t.norm());
  normal.diagonal().segment<2>(3).array() += hold(tilt);
  normal(5, 5) += hold(usualTurn);
  const Eigen::Matrix<double, 8, 1> step = normal.ldlt().solve(P.transpose() * N.block<10, 1>(0, 10));
  const Eigen::Vector3d v = step.head<3>(), w = step.segment<3>(3);
  if (!step.allFinite() || w.norm() > largestStep || v.norm() > largestStep * pose.t.norm()) {
    return false;
  }
  pose.R = vpSO3::exp(w) * pose.R;
  pose.t += v;
  m_photometry.addToLight(step(6), step(7));
  // Each of the eight parameters alone moves the points of the plane by at most this.
  shift = (P.topLeftCorner<8, 6>() * step.head<6>()).lpNorm<Eigen::Infinity>() / (gain * level.pitchX);
  return nearestCornerDepth(m_plane, pose) > 0. &&
         m_photometry.sample(pyramid, index, pose) >= vpPhotometry::fewestSamples;
}

bool vpPhotometricRefiner::start(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpRigidPose &pose)
{
  if (m_photometry.sample(pyramid, index, pose) < vpPhotometry::fewestSamples) {
    return false;
  }
  m_photometry.start(m_model.level(index, 0));
  return true;
}

// Steps at one level until they are small or their number is used up; shift is the length of the last one, samples.
bool vpPhotometricRefiner::descend(const std::vector<cv::Mat> &pyramid, std::size_t index, std::size_t soft,
                                   vpRigidPose &pose, unsigned int iterations, unsigned int &budget, double &shift)
{
  const double enough = index == 0 && m_precise ? 0.004 : 0.02;
  double sigma = std::numeric_limits<double>::infinity();
  shift = largestShift;
  if (m_photometry.sample(pyramid, index, pose) < vpPhotometry::fewestSamples) {
    return false;
  }
  for (unsigned int k = 0; k < iterations && shift > enough; ++k) {
    --budget;
    if (k >= patience && shift > largestShift) {
      return false;
    }
    shift = std::clamp(shift, vpPhotometry::smallestShift, largestShift);
    if (!iterate(pyramid, index, m_model.level(index, soft), pose, shift, sigma)) {
      return false;
    }
  }
  return true;
}

bool vpPhotometricRefiner::refine(const std::vector<cv::Mat> &pyramid, vpRigidPose &pose, double reach,
                                  unsigned int maxIterations)
{
  const std::size_t finest = finestUseful(pose);
  std::size_t coarsest = finest;
  while (coarsest + 1 < m_model.levels() && m_photometry.pixelsPerSample(coarsest, pose) < reach) {
    ++coarsest;
  }
  unsigned int budget = maxIterations;
  for (std::size_t index = coarsest; index > finest; --index) {
    if (index == coarsest && !start(pyramid, index, pose)) {
      return false;
    }
    const unsigned int share = budget / static_cast<unsigned int>(index - finest + 1);
    double shift = 0.;
    // A coarse level of the frame is sharp, however blurred the frame is.
    if (!descend(pyramid, index, 0, pose, share, budget, shift)) {
      return false;
    }
  }
  if (coarsest == finest && !start(pyramid, finest, pose)) {
    return false;
  }
  // The blur can be estimated only at the right pose, and the pose only with the right blur.
  double shift = largestShift;
  do {
    if (!descend(pyramid, finest, m_soft, pose, budget, budget, shift)) {
      return false;
    }
  } while (matchBlur(finest) && budget > 0);
  if (shift > converged) {
    return false;
  }
  // Products of rotations drift from orthonormality: nearest rotation by one Newton step.
  pose.R = 0.5 * pose.R * (3. * Eigen::Matrix3d::Identity() - pose.R.transpose() * pose.R);
  return true;
}

// Select the softness with the smallest residuals relative to the gain, by descent from the current one; true if
// changed.
bool vpPhotometricRefiner::matchBlur(std::size_t index)
{
  const std::size_t before = m_soft;
  const auto misfit = [&](std::size_t soft) {
    m_photometry.fit(m_model.level(index, soft));
    const double sigma = m_photometry.textureDeviation(m_model.level(index, soft)), gain = m_photometry.gain();
    return gain > vpPhotometry::smallestGain ? sigma / gain : std::numeric_limits<double>::infinity();
  };
  double best = misfit(m_soft);
  for (const int direction : {-1, 1}) {
    while (direction < 0 ? m_soft > 0 : m_soft + 1 < vpPhotometricModel::softness.size()) {
      const std::size_t next = direction < 0 ? m_soft - 1 : m_soft + 1;
      const double other = misfit(next);
      if (!(other < best)) {
        break;
      }
      best = other;
      m_soft = next;
    }
  }
  misfit(m_soft);
  return m_soft != before;
}

vpPhotometricFit vpPhotometricRefiner::verify(const std::vector<cv::Mat> &pyramid, const vpRigidPose &pose)
{
  const std::size_t index = finestUseful(pose);
  const vpPhotometricLevel &level = m_model.level(index, m_soft);
  const std::size_t inside = m_photometry.sample(pyramid, index, pose);
  if (inside < vpPhotometry::fewestSamples) {
    vpPhotometricFit fit;
    fit.inImage = static_cast<double>(inside) / static_cast<double>(level.size());
    return fit;
  }
  m_photometry.start(level);
  return m_photometry.judge(level, m_photometry.fit(level));
}

END_VISP_NAMESPACE
