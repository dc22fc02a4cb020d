/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPixelRefiner.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Cholesky>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int lanes = vpTargetPrediction::lanes, blockRows = 8;
constexpr int patch = 2;               // blocks each way whose residuals may be correlated
constexpr double mostPixels = 200000.; // of the target; a larger one is binned
constexpr double tukey = 4.685;        // 95 % efficiency under Gaussian noise
constexpr double madToSigma = 1.4826;  // likewise
constexpr double smallestSigma = 0.35; // grey levels; rounding to whole ones is 0.29
constexpr std::size_t enoughForMedian = 8192;
constexpr double startSlope = 0.3, slope = 0.15; // px, see m_slope
constexpr unsigned int mostRounds = 6, mostSteps = 8;
constexpr double shortStep = 0.05, longStep = 0.5;    // deviations; after a long one the noise is re-estimated
constexpr double roughStep = 0.1;                     // of the way
constexpr double smallShift = 0.1, smallTurn = 0.005; // px, rad: up to these, a prediction is linear,
constexpr double tinyShift = 0.005;                   // px; whatever the deviations, as for an image without noise
constexpr double smallWay = 10.;                      // deviations; and its gradient is accurate to 1 %
constexpr double smallBlur = 0.1;                     // change of half the square of the blur, share of blur^2 + 0.1
constexpr double smallError = 0.05;                   // deviations, or this share of the way
constexpr double maskShift = 0.7;   // px; above it, a misfit may be a misplacement and not an occlusion
constexpr double largestShift = 6.; // px of a corner from the start; larger than any error of the other stages
constexpr double usualTurn = 0.1, usualMove = 0.1;  // rad, share of the distance; prior for weak directions
constexpr int maskWindow = 7, maskGrowth = 7;       // px
constexpr double misfitCap = 12., misfitLimit = 2.; // squares over variance, of a pixel and on average
constexpr double largestHidden = 0.7;

vpGreyPlane planeOf(const cv::Mat &m)
{
  return {const_cast<float *>(m.ptr<float>()), static_cast<std::ptrdiff_t>(m.step1())};
}

// Buffers grow and never shrink, because targets move. New ones hold zeros, so that all of them is finite.
void enlarge(cv::Mat &buffer, int rows, int cols, int type)
{
  if (buffer.type() != type || buffer.rows < rows || buffer.cols < cols) {
    buffer = cv::Mat::zeros(std::max(buffer.rows, rows), std::max(buffer.cols, cols), type);
  }
}
} // namespace

// Sums over the blocks, see vpGreyLanes::blockSums.
void vpPixelRefiner::sumBlocks(vpGreyWeights::Kind kind)
{
  const double edge = tukey * m_slope * m_fit.camera.gain, noise = tukey * m_fit.sigma;
  const vpGreyWeights weights = {static_cast<float>(m_fit.camera.gain), static_cast<float>(m_fit.camera.bias),
                                 static_cast<float>(noise * noise), static_cast<float>(edge * edge)};
  m_sums.resize(24 * m_blocks.size());
  m_loops.blockSums(planes(), m_blocks.data(), m_blocks.size(), kind, weights, m_sums.data());
}

vpGreyPixels vpPixelRefiner::planes() const
{
  return {planeOf(m_frame),
          planeOf(m_open),
          planeOf(m_residuals),
          planeOf(m_prediction.grey()),
          planeOf(m_prediction.du()),
          planeOf(m_prediction.dv()),
          planeOf(m_prediction.dBlur())};
}

void vpPixelRefiner::takeFrame(const cv::Mat &image, const cv::Rect &area)
{
  enlarge(m_frame, area.height + blockRows, area.width, CV_32F);
  const cv::Rect seen = area & cv::Rect(cv::Point(), m_frameSize);
  const cv::Rect source(m_bin * seen.x, m_bin * seen.y, m_bin * seen.width, m_bin * seen.height);
  cv::Mat target = m_frame(cv::Rect(0, 0, seen.width, seen.height));
  if (m_bin == 1) {
    image(source).convertTo(target, CV_32F);
  }
  else {
    image(source).convertTo(m_mean, CV_32F);
    cv::resize(m_mean, target, target.size(), 0., 0., cv::INTER_AREA); // mean of whole pixels: noise stays white
  }
}

bool vpPixelRefiner::predict(const cv::Mat &image, bool sparse)
{
  if (!m_prediction.predict(m_texture, m_fit.pose, m_binned, m_frameSize, m_fit.camera.blur, sparse)) {
    return false;
  }
  const cv::Rect &area = m_prediction.area();
  takeFrame(image, area);
  enlarge(m_residuals, area.height + blockRows, area.width, CV_32F);
  enlarge(m_open, area.height + blockRows, area.width, CV_32F);
  for (int r = 0; r < (area.height + blockRows - 1) / blockRows * blockRows; ++r) {
    float *const open = m_open.ptr<float>(r);
    std::fill_n(open, area.width, 0.f);
    if (r < area.height) {
      const vpTargetPrediction::Span span = m_prediction.spans()[static_cast<std::size_t>(r)];
      const unsigned char *const hidden = m_hidden.ptr<unsigned char>(area.y + r) + area.x;
      for (int c = span.begin; c < span.end; ++c) {
        open[c] = hidden[c] ? 0.f : 1.f;
      }
    }
  }
  makeBlocks();
  m_change.setZero();
  return true;
}

// The blocks on the target.
void vpPixelRefiner::makeBlocks()
{
  const cv::Rect &area = m_prediction.area();
  m_blocks.clear();
  for (int row = 0; row < area.height; row += blockRows) {
    const int last = std::min(row + blockRows, area.height);
    int begin = area.width, end = 0;
    for (int r = row; r < last; ++r) {
      const vpTargetPrediction::Span span = m_prediction.spans()[static_cast<std::size_t>(r)];
      if (span.begin < span.end) {
        begin = std::min(begin, span.begin);
        end = std::max(end, span.end);
      }
    }
    const double v = area.y + 0.5 * (row + last - 1);
    for (int col = begin / lanes * lanes; col < end; col += lanes) {
      const Motion motion = pixelMotion(m_fit.pose, m_binned, area.x + col + 0.5 * (lanes - 1), v);
      vpGreyBlock block = {row, col, {}};
      for (int k = 0; k < 6; ++k) {
        block.motion[0][k] = motion(0, k);
        block.motion[1][k] = motion(1, k);
      }
      m_blocks.push_back(block);
    }
  }
}

void vpPixelRefiner::updateResiduals()
{
  m_loops.residuals(planes(), m_blocks.data(), m_blocks.size(), m_change.data(), static_cast<float>(m_fit.camera.gain),
                    static_cast<float>(m_fit.camera.bias), static_cast<float>(m_change(8)));
}

// Standard deviation of the unoccluded residuals, from their median.
double vpPixelRefiner::scale()
{
  const int stride = 1 + m_prediction.pixels() / static_cast<int>(enoughForMedian);
  m_median.clear();
  int skip = 0;
  for (int r = 0; r < m_prediction.area().height; ++r) {
    const vpTargetPrediction::Span span = m_prediction.spans()[static_cast<std::size_t>(r)];
    int c = span.begin + skip;
    for (; c < span.end; c += stride) {
      if (m_open.at<float>(r, c) > 0.f) {
        m_median.add(std::abs(m_residuals.at<float>(r, c)));
      }
    }
    skip = std::max(0, c - span.end);
  }
  return std::max(smallestSigma, madToSigma * m_median.value());
}

// Normal equations of the nine parameters.
void vpPixelRefiner::assemble(vpGreyWeights::Kind kind, Normal &N, Params &right)
{
  sumBlocks(kind);
  vpGreyNormal sums;
  m_loops.assemble(m_blocks.data(), m_sums.data(), m_blocks.size(), m_fit.camera.gain, sums);
  for (int i = 0; i < 6; ++i) {
    N.block<1, 6>(i, 0) = Eigen::Map<const Eigen::Matrix<double, 1, 6>>(sums.pose[i]);
    right(i) = sums.right[i];
  }
  constexpr int lightSum[3][3] = {{11, 12, 13}, {12, 15, 16}, {13, 16, 18}}, lightRight[3] = {14, 17, 19};
  for (int i = 0; i < 3; ++i) {
    N.block<6, 1>(0, 6 + i) = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(sums.light[i]);
    for (int j = 0; j < 3; ++j) {
      N(6 + i, 6 + j) = sums.sums[lightSum[i][j]];
    }
    right(6 + i) = sums.sums[lightRight[i]];
  }
  N.bottomLeftCorner<3, 6>() = N.topRightCorner<6, 3>().transpose();
  // The derivative with respect to the blur includes the gain.
  N.row(8) *= m_fit.camera.gain;
  N.col(8) *= m_fit.camera.gain;
  right(8) *= m_fit.camera.gain;
}

// One Gauss-Newton step; its length is in deviations of the pose.
bool vpPixelRefiner::step(double &length)
{
  updateResiduals();
  if (length > longStep) {
    m_fit.sigma = scale();
  }
  Normal N;
  Params right;
  assemble(Kind::Estimate, N, right);
  Normal held = N;
  const double variance = m_fit.sigma * m_fit.sigma, move = usualMove * m_fit.pose.t.norm();
  held.diagonal().head<3>().array() += variance / (move * move);
  held.diagonal().segment<3>(3).array() += variance / (usualTurn * usualTurn);
  held(8, 8) += variance; // px^4: an unobservable blur stays
  const Params d = held.ldlt().solve(right);
  if (!d.allFinite()) {
    return false;
  }
  m_change += d;
  m_fit.camera.gain += d(6);
  m_fit.camera.bias += d(7);
  const auto deviations = [&](const Params &p) {
    return std::sqrt(std::max(0., p.head<6>().dot(N.topLeftCorner<6, 6>() * p.head<6>()))) / m_fit.sigma;
  };
  length = deviations(d);
  m_way = deviations(m_change);
  return m_fit.camera.gain > 0.05 && m_change.segment<3>(3).norm() < 0.5 &&
         m_change.head<3>().norm() < 0.5 * m_fit.pose.t.norm();
}

// Steps with one prediction; approximate when the next prediction will be needed anyway.
bool vpPixelRefiner::descend()
{
  double length = std::numeric_limits<double>::infinity();
  for (unsigned int k = 0; k < mostSteps && length > shortStep; ++k) {
    if (!step(length)) {
      return false;
    }
    if (length < roughStep * m_way && !isLinear()) {
      break;
    }
  }
  return true;
}

// Masks whole areas that do not fit; true if the mask has changed.
bool vpPixelRefiner::maskHidden()
{
  const cv::Rect &area = m_prediction.area();
  enlarge(m_misfit, area.height, area.width + vpGreyMostLanes, CV_32F);
  const double edge = m_slope * m_fit.camera.gain;
  const vpGreyWeights variance = {1.f, 0.f, static_cast<float>(m_fit.sigma * m_fit.sigma),
                                  static_cast<float>(edge * edge)};
  for (int r = 0; r < area.height; ++r) {
    const vpTargetPrediction::Span span = m_prediction.spans()[static_cast<std::size_t>(r)];
    m_loops.misfit(m_residuals.ptr<float>(r), m_prediction.du().ptr<float>(r), m_prediction.dv().ptr<float>(r),
                   span.begin, span.end, area.width, variance, static_cast<float>(misfitCap),
                   static_cast<float>(misfitLimit), m_misfit.ptr<float>(r));
  }
  // The mean over the target's pixels in the window exceeds the limit where the sum of the differences is positive.
  const cv::Mat misfit = m_misfit(cv::Rect(0, 0, area.width, area.height));
  cv::boxFilter(misfit, m_mean, CV_32F, cv::Size(maskWindow, maskWindow), cv::Point(-1, -1), false,
                cv::BORDER_CONSTANT | cv::BORDER_ISOLATED);
  cv::compare(m_mean, 0., m_bad, cv::CMP_GT);
  cv::dilate(m_bad, m_bad, cv::Mat::ones(maskGrowth, maskGrowth, CV_8U));
  bool changed = false;
  for (int r = 0; r < area.height; ++r) {
    const vpTargetPrediction::Span span = m_prediction.spans()[static_cast<std::size_t>(r)];
    const unsigned char *const bad = m_bad.ptr<unsigned char>(r);
    unsigned char *const hidden = m_hidden.ptr<unsigned char>(area.y + r) + area.x;
    float *const open = m_open.ptr<float>(r);
    for (int c = span.begin; c < span.end; ++c) {
      changed |= hidden[c] != bad[c];
      hidden[c] = bad[c];
      open[c] = bad[c] ? 0.f : 1.f;
    }
  }
  return changed;
}

// Displacement of the target in the frame since the prediction, px.
double vpPixelRefiner::largestMove() const
{
  const cv::Rect &area = m_prediction.area();
  double shift = 0.;
  for (const double u : {0., 0.5, 1.}) {
    for (const double v : {0., 0.5, 1.}) {
      const auto motion = pixelMotion(m_fit.pose, m_binned, area.x + u * area.width, area.y + v * area.height);
      shift = std::max(shift, (motion * m_change.head<6>()).norm());
    }
  }
  return shift;
}

// True if the prediction, linear in the change, is valid: a new one would give the same result.
bool vpPixelRefiner::isLinear() const
{
  const double blur = m_fit.camera.blur, shift = largestMove();
  // With a relative error of the blur, the gradient has about twice that error.
  const double share = blurred(m_change(8)) == blur ? 0. : std::abs(m_change(8)) / (blur * blur + 0.1);
  return (m_way < smallWay || shift < tinyShift) && shift < smallShift && m_change.segment<3>(3).norm() < smallTurn &&
         share < smallBlur && m_way * share < smallError;
}

double vpPixelRefiner::blurred(double change) const
{
  return std::clamp(std::sqrt(std::max(0., m_fit.camera.blur * m_fit.camera.blur + 2. * change)),
                    vpTargetPrediction::sharpest, vpTargetPrediction::softest);
}

void vpPixelRefiner::adopt()
{
  m_fit.pose.t += m_change.head<3>();
  m_fit.pose.R = vpSO3::exp(m_change.segment<3>(3)) * m_fit.pose.R;
  m_fit.camera.blur = blurred(m_change(8));
}

// Sum of squares of the score of whole patches, which includes errors correlated between neighbours.
vpPixelRefiner::Normal vpPixelRefiner::patchScores()
{
  const cv::Rect &area = m_prediction.area();
  const double gain = m_fit.camera.gain;
  const int across = area.width / (lanes * patch) + 1, down = area.height / (blockRows * patch) + 1;
  std::vector<Params> scores(static_cast<std::size_t>(across) * static_cast<std::size_t>(down), Params::Zero());
  sumBlocks(Kind::Estimate);
  for (std::size_t k = 0; k < m_blocks.size(); ++k) {
    const vpGreyBlock &block = m_blocks[k];
    const float *const sums = &m_sums[24 * k];
    const int patchRow = block.row / (blockRows * patch), patchCol = block.col / (lanes * patch);
    Params &score = scores[static_cast<std::size_t>(patchRow * across + patchCol)];
    for (int i = 0; i < 6; ++i) {
      score(i) -= gain * (block.motion[0][i] * sums[5] + block.motion[1][i] * sums[10]);
    }
    score(6) += sums[14];
    score(7) += sums[17];
    score(8) += gain * sums[19];
  }
  Normal S = Normal::Zero();
  int used = 0;
  for (const Params &score : scores) {
    S += score * score.transpose();
    used += score.squaredNorm() > 0.;
  }
  return used / std::max(1., used - 9.) * S;
}

// Residual and occluded fraction of the fit; returns the number of unoccluded pixels.
int vpPixelRefiner::judgeResiduals()
{
  double squares = 0.;
  int open = 0;
  for (int r = 0; r < m_prediction.area().height; ++r) {
    const vpTargetPrediction::Span span = m_prediction.spans()[static_cast<std::size_t>(r)];
    for (int c = span.begin; c < span.end; ++c) {
      if (m_open.at<float>(r, c) > 0.f) {
        const double e = m_residuals.at<float>(r, c);
        squares += e * e;
        ++open;
      }
    }
  }
  m_fit.residual = open > 0 ? std::sqrt(squares / open) : 0.;
  m_fit.hidden = 1. - static_cast<double>(open) / m_prediction.pixels();
  return open;
}

void vpPixelRefiner::conclude()
{
  updateResiduals();
  m_fit.sigma = scale();
  Normal A, B;
  Params unused;
  assemble(Kind::Derivative, A, unused);
  assemble(Kind::Score, B, unused);
  const Normal S = patchScores();
  const int open = judgeResiduals();
  const Eigen::LDLT<Normal> factor(A);
  if (factor.info() != Eigen::Success || !factor.isPositive() || open < vpTargetPrediction::fewestPixels) {
    return;
  }
  const Normal inverse = factor.solve(Normal::Identity());
  const Eigen::Matrix<double, 6, 6> C = (inverse * B * inverse.transpose()).topLeftCorner<6, 6>();
  const Eigen::Matrix<double, 6, 6> CS = (inverse * S * inverse.transpose()).topLeftCorner<6, 6>();
  m_fit.kappa = std::max(1., C.ldlt().solve(CS).trace() / 6.);
  m_fit.covariance = m_fit.kappa * C;
  m_fit.converged =
      m_fit.covariance.allFinite() && (m_fit.covariance.diagonal().array() > 0.).all() && m_fit.hidden < largestHidden;
}

void vpPixelRefiner::begin(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &start)
{
  m_fit = vpPixelFit();
  m_fit.pose = pose;
  m_fit.camera = start;
  const double pixels = imageScale(pose, m_camera) * m_plane.width * m_plane.height;
  m_bin = std::clamp(static_cast<int>(std::ceil(std::sqrt(pixels / mostPixels))), 1,
                     std::max(1, std::min(image.cols, image.rows) / 32));
  const double k = m_bin, centre = 0.5 * (k - 1.);
  m_binned = {m_camera.px / k, m_camera.py / k, (m_camera.u0 - centre) / k, (m_camera.v0 - centre) / k, m_camera.kud};
  m_large = pixels >= vpTargetPrediction::enoughToThin * k * k;
  m_frameSize = cv::Size(image.cols / m_bin, image.rows / m_bin);
  m_fit.camera.blur = std::clamp(start.blur / k, vpTargetPrediction::sharpest, vpTargetPrediction::softest);
  enlarge(m_hidden, m_frameSize.height, m_frameSize.width + lanes, CV_8U);
  m_hidden(cv::Rect(0, 0, m_frameSize.width + lanes, m_frameSize.height)).setTo(0);
  m_slope = startSlope;
}

bool vpPixelRefiner::glance(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &start)
{
  begin(image, pose, start);
  if (!predict(image) || !descend()) {
    return false;
  }
  updateResiduals();
  return true;
}

const vpPixelFit &vpPixelRefiner::refine(const cv::Mat &image, const vpRigidPose &pose, const vpCameraState &start)
{
  begin(image, pose, start);
  if (m_large) { // only to come near enough for a prediction that is linear: a third of the pixels will do
    if (!predict(image, true) || !descend()) {
      return m_fit;
    }
    adopt();
  }
  for (unsigned int round = m_large ? 1 : 0; round < mostRounds; ++round) {
    if (!predict(image) || !descend()) {
      return m_fit;
    }
    const double shift = largestMove();
    if (shift < maskShift) { // a misfit is now an occlusion, not a misplacement
      const bool stricter = m_slope > slope;
      m_slope = slope;
      if ((maskHidden() || stricter) && isLinear() && !descend()) {
        return m_fit;
      }
    }
    const bool settled = shift < maskShift && isLinear();
    if (settled) {
      conclude();
    }
    adopt();
    if (settled) {
      break;
    }
  }
  // Products of rotations drift from orthonormality: nearest rotation by one Newton step.
  m_fit.pose.R = 0.5 * m_fit.pose.R * (3. * Eigen::Matrix3d::Identity() - m_fit.pose.R.transpose() * m_fit.pose.R);
  m_fit.camera.blur *= m_bin;
  for (const Eigen::Vector2d &corner : m_plane.corners()) {
    const Eigen::Vector3d P = pose.R.leftCols<2>() * corner + pose.t;
    const Eigen::Vector2d p = m_camera.project(P.head<2>() / P.z());
    m_fit.converged &= pixelShift(pose, m_fit.pose, m_camera, p.x(), p.y()).norm() < largestShift * m_bin;
  }
  return m_fit;
}

double vpPixelRefiner::distance(const vpRigidPose &other)
{
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Eigen::Matrix<double, 6, 6> N = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6 right = Vector6::Zero();
  double squares = 0.;
  const cv::Rect &area = m_prediction.area();
  sumBlocks(Kind::Estimate);
  for (std::size_t k = 0; k < m_blocks.size(); ++k) {
    const vpGreyBlock &block = m_blocks[k];
    const Eigen::Vector2d shift = pixelShift(m_fit.pose, other, m_binned, area.x + block.col + 0.5 * (lanes - 1),
                                             area.y + block.row + 0.5 * (blockRows - 1));
    Motion motion;
    Eigen::Matrix2d slopes;
    for (int i = 0; i < 6; ++i) {
      motion.col(i) << block.motion[0][i], block.motion[1][i];
    }
    const float *const sums = &m_sums[24 * k];
    slopes << sums[0], sums[1], sums[1], sums[6];
    N += motion.transpose() * slopes * motion;
    right += motion.transpose() * slopes * shift;
    squares += shift.dot(slopes * shift);
  }
  const double left = squares - right.dot(N.ldlt().solve(right));
  return m_fit.camera.gain / m_fit.sigma * std::sqrt(std::max(0., left));
}

END_VISP_NAMESPACE
