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
constexpr double tukey = 4.685;        // 95 % efficiency under Gaussian noise
constexpr double madToSigma = 1.4826;  // likewise
constexpr double smallestSigma = 1.5;  // grey levels; below, rounding and interpolation would be rejected as occlusion
constexpr double smallestGain = 0.05;  // below, the frame shows nothing of the reference
constexpr double largestShift = 0.3;    // samples; at the start of a level
constexpr double smallestShift = 0.1;   // samples; what blur and interpolation are worth
constexpr double usualMove = 0.1;      // of a step, share of the distance
constexpr double usualTurn = 0.03;      // of a step, rad
constexpr double coarsePixels = 4.;     // per sample; at coarser levels
constexpr double coarseTilt = 1e-4;    // rad, the tilt stays what it was
constexpr double converged = 0.02;     // samples; the last step at the finest level
constexpr double largestStep = 0.5;    // likewise: a longer step is divergence
constexpr std::size_t fewestSamples = 100; // to fit eight numbers
constexpr std::size_t enoughForMedian = 4000;
constexpr float outside = -1.f;
constexpr float rejected = 1e9f;

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

vpPhotometricRefiner::vpPhotometricRefiner(const vpPhotometricModel &model, const vpTargetPlane &plane, const vpPinhole &camera)
  : m_model(model), m_plane(plane), m_camera(camera)
{
  const std::size_t n = model.level(0, 0).samples.size();
  m_values.reserve(n);
  m_residuals.reserve(n);
  m_scratch.reserve(n);
}

double vpPhotometricRefiner::pixelsPerSample(std::size_t level, const vpRigidPose &pose) const
{
  return std::sqrt(imageScale(pose, m_camera)) * m_model.unit() * m_model.level(level, 0).pitchX;
}

std::size_t vpPhotometricRefiner::finestUseful(const vpRigidPose &pose) const
{
  std::size_t level = 0;
  // More than two samples a pixel each way only cost time.
  while (level + 1 < m_model.levels() && pixelsPerSample(level, pose) < 0.5) {
    ++level;
  }
  return level;
}

// Grey values of the frame at the samples; returns how many are in the image.
std::size_t vpPhotometricRefiner::sample(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpRigidPose &pose)
{
  const vpPhotometricLevel &level = m_model.level(index, 0);
  // The frame at the resolution of the samples or finer: a coarser one would be softer than the reference can be made.
  const double pixels = std::max(1., pixelsPerSample(index, pose));
  const int frameLevel = std::min(static_cast<int>(std::log2(pixels)), static_cast<int>(pyramid.size()) - 1);
  const cv::Mat &frame = pyramid[static_cast<std::size_t>(frameLevel)];
  const vpPinhole camera = m_camera.atLevel(frameLevel);
  const float px = static_cast<float>(camera.px), py = static_cast<float>(camera.py);
  const float u0 = static_cast<float>(camera.u0), v0 = static_cast<float>(camera.v0), kud = static_cast<float>(camera.kud);
  const float lastU = static_cast<float>(frame.cols - 1), lastV = static_cast<float>(frame.rows - 1);
  const Eigen::Vector3d a = m_model.unit() * pose.R.col(0), b = m_model.unit() * pose.R.col(1);
  const Eigen::Vector3f next = (level.pitchX * a).cast<float>();
  m_values.resize(level.samples.size());
  std::size_t i = 0, inside = 0;
  for (int r = 0; r < level.rows; ++r) {
    const Eigen::Vector3f first = (pose.t + level.firstX * a + (level.firstY + r * level.pitchY) * b).cast<float>();
    for (int c = 0; c < level.cols; ++c, ++i) {
      const float k = static_cast<float>(c);
      const float invZ = 1.f / (first.z() + k * next.z());
      const float x = invZ * (first.x() + k * next.x()), y = invZ * (first.y() + k * next.y());
      const float distortion = 1.f + kud * (x * x + y * y);
      const float u = u0 + px * distortion * x, v = v0 + py * distortion * y;
      if (!(invZ > 0.f && u >= 0.f && v >= 0.f && u < lastU && v < lastV)) {
        m_values[i] = outside;
        continue;
      }
      const int iu = static_cast<int>(u), iv = static_cast<int>(v);
      const float fu = u - static_cast<float>(iu), fv = v - static_cast<float>(iv);
      const unsigned char *p = frame.ptr<unsigned char>(iv) + iu, *q = p + frame.step[0];
      const float top = static_cast<float>(p[0]) + fu * static_cast<float>(p[1] - p[0]);
      const float bottom = static_cast<float>(q[0]) + fu * static_cast<float>(q[1] - q[0]);
      m_values[i] = top + fv * (bottom - top);
      ++inside;
    }
  }
  return inside;
}

double vpPhotometricRefiner::median()
{
  if (m_scratch.empty()) {
    return 0.;
  }
  const auto middle = m_scratch.begin() + static_cast<std::ptrdiff_t>(m_scratch.size() / 2);
  std::nth_element(m_scratch.begin(), middle, m_scratch.end());
  return *middle;
}

// Gain and bias of the last frame or from medians, whichever fits better: whatever hides a part of the target must not
// decide on them, for what is wrong with them is taken for misalignment.
void vpPhotometricRefiner::startPhotometry(const vpPhotometricLevel &level)
{
  const std::size_t stride = std::max<std::size_t>(1, level.samples.size() / enoughForMedian);
  const auto medianOf = [&](auto value) {
    m_scratch.clear();
    for (std::size_t i = 0; i < level.samples.size(); i += stride) {
      if (m_values[i] >= 0.f) {
        m_scratch.push_back(value(i));
      }
    }
    return static_cast<float>(median());
  };
  const float reference = medianOf([&](std::size_t i) { return level.samples[i].value; });
  const float frame = medianOf([&](std::size_t i) { return m_values[i]; });
  const float referenceSpread = medianOf([&](std::size_t i) { return std::abs(level.samples[i].value - reference); });
  const float frameSpread = medianOf([&](std::size_t i) { return std::abs(m_values[i] - frame); });
  const double lastGain = m_gain, lastBias = m_bias, last = residuals(level);
  m_gain = std::clamp(static_cast<double>(frameSpread / std::max(1.f, referenceSpread)), 0.2, 5.);
  m_bias = frame - m_gain * reference;
  if (last < residuals(level)) {
    m_gain = lastGain;
    m_bias = lastBias;
  }
  fitPhotometry(level);
}

// Residuals of the samples; returns their robust deviation.
double vpPhotometricRefiner::residuals(const vpPhotometricLevel &level)
{
  const std::size_t n = level.samples.size(), stride = std::max<std::size_t>(1, n / enoughForMedian);
  const float gain = static_cast<float>(m_gain), bias = static_cast<float>(m_bias);
  m_residuals.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    m_residuals[i] = m_values[i] >= 0.f ? m_values[i] - gain * level.samples[i].value - bias : rejected;
  }
  m_scratch.clear();
  for (std::size_t i = 0; i < n; i += stride) {
    if (m_residuals[i] != rejected) {
      m_scratch.push_back(std::abs(m_residuals[i]));
    }
  }
  return std::max(smallestSigma, madToSigma * median());
}

/*
 * Sum of w row row^T with the residual in column 10; float within a row of samples, double beyond.
 * The residual that a sample may have is sigma from noise and its gradient times shift from misalignment, blur and
 * interpolation: with sigma alone, which the flat parts of a picture dominate, every edge that is off would pass for
 * an occlusion, and edges are what the pose is found from.
 */
vpPhotometricRefiner::Design vpPhotometricRefiner::accumulate(const vpPhotometricLevel &level, double sigma, double shift) const
{
  using Row = Eigen::Matrix<float, 12, 1>;
  const float noise2 = static_cast<float>(tukey * tukey * sigma * sigma);
  const float slope2 = static_cast<float>(tukey * tukey * m_gain * m_gain * shift * shift);
  Design sum = Design::Zero();
  std::size_t i = 0;
  for (int r = 0; r < level.rows; ++r) {
    const float y = static_cast<float>(level.firstY + r * level.pitchY);
    Eigen::Matrix<float, 12, 12> rowSum = Eigen::Matrix<float, 12, 12>::Zero();
    for (int c = 0; c < level.cols; ++c, ++i) {
      const vpPhotometricSample &s = level.samples[i];
      const float e = m_residuals[i], fit = 1.f - e * e / (noise2 + slope2 * s.slope2);
      if (fit > 0.f) {
        const float x = static_cast<float>(level.firstX) + static_cast<float>(c) * static_cast<float>(level.pitchX);
        const float g = s.dx * x + s.dy * y;
        Row row;
        row << s.dx * x, s.dx * y, s.dx, s.dy * x, s.dy * y, s.dy, -g * x, -g * y, s.value, 1.f, e, 0.f;
        const Row weighted = fit * fit * row;
        rowSum.noalias() += row * weighted.transpose();
      }
    }
    sum += rowSum.cast<double>();
  }
  return sum;
}

/*
 * One Gauss-Newton step at one level. shift, in samples, is how far off the pose may be, before and after. sigma never
 * grows within a level: it would let a step that makes things worse look like a noisier image.
 */
bool vpPhotometricRefiner::iterate(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpPhotometricLevel &level,
                                   vpRigidPose &pose, double &shift, double &sigma)
{
  sigma = std::min(sigma, residuals(level));
  const Design N = accumulate(level, sigma, shift);
  const double gain = std::max(m_gain, smallestGain);
  const Eigen::Matrix<double, 10, 8> P = poseToDesign(pose, m_model.unit(), gain);
  Eigen::Matrix<double, 8, 8> normal = P.transpose() * N.topLeftCorner<10, 10>() * P;
  // Steps have usual sizes: this holds back what a level hardly shows, the tilt above all, and moves no fixed point.
  const double tilt = pixelsPerSample(index, pose) > coarsePixels ? coarseTilt : usualTurn;
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
  m_gain += step(6);
  m_bias += step(7);
  // Each of the eight parameters moves the points of the plane by itself at most.
  shift = (P.topLeftCorner<8, 6>() * step.head<6>()).lpNorm<Eigen::Infinity>() / (gain * level.pitchX);
  return nearestCornerDepth(m_plane, pose) > 0. && sample(pyramid, index, pose) >= fewestSamples;
}

bool vpPhotometricRefiner::start(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpRigidPose &pose)
{
  if (sample(pyramid, index, pose) < fewestSamples) {
    return false;
  }
  startPhotometry(m_model.level(index, 0));
  return true;
}

// Steps at one level until they are small or their number is used up; shift is the length of the last one, samples.
bool vpPhotometricRefiner::descend(const std::vector<cv::Mat> &pyramid, std::size_t index, std::size_t soft, vpRigidPose &pose,
                                   unsigned int iterations, unsigned int &budget, double &shift)
{
  constexpr double enough = 0.002;
  double sigma = std::numeric_limits<double>::infinity();
  shift = largestShift;
  if (sample(pyramid, index, pose) < fewestSamples) {
    return false;
  }
  while (iterations > 0 && shift > enough) {
    --iterations;
    --budget;
    shift = std::clamp(shift, smallestShift, largestShift);
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
  while (coarsest + 1 < m_model.levels() && pixelsPerSample(coarsest, pose) < reach) {
    ++coarsest;
  }
  unsigned int budget = maxIterations;
  for (std::size_t index = coarsest; index > finest; --index) {
    if (index == coarsest && !start(pyramid, index, pose)) {
      return false;
    }
    const unsigned int share = budget / static_cast<unsigned int>(index - finest + 1);
    double shift = 0.;
    // A coarse level of the frame is sharp, whatever blurred the frame.
    if (!descend(pyramid, index, 0, pose, share, budget, shift)) {
      return false;
    }
  }
  if (coarsest == finest && !start(pyramid, finest, pose)) {
    return false;
  }
  // Blur can be told only where the pose is right, and the pose is right only with the blur told.
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

// Gain and bias alone at the present samples, reweighted until they stand; returns the robust deviation of the residuals.
double vpPhotometricRefiner::fitPhotometry(const vpPhotometricLevel &level)
{
  double sigma = residuals(level);
  for (int k = 0; k < 4; ++k) {
    const float noise2 = static_cast<float>(tukey * tukey * sigma * sigma);
    const float slope2 = static_cast<float>(tukey * tukey * m_gain * m_gain * smallestShift * smallestShift);
    Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
    std::size_t i = 0;
    for (int r = 0; r < level.rows; ++r) {
      float w1 = 0.f, wr = 0.f, wrr = 0.f, we = 0.f, wre = 0.f;
      for (int c = 0; c < level.cols; ++c, ++i) {
        const float e = m_residuals[i], value = level.samples[i].value;
        const float fit = std::max(0.f, 1.f - e * e / (noise2 + slope2 * level.samples[i].slope2));
        const float w = fit * fit;
        w1 += w;
        wr += w * value;
        wrr += w * value * value;
        we += w * e;
        wre += w * value * e;
      }
      N(0, 0) += wrr;
      N(0, 1) += wr;
      N(1, 1) += w1;
      N(0, 2) += wre;
      N(1, 2) += we;
    }
    const double det = N(0, 0) * N(1, 1) - N(0, 1) * N(0, 1);
    if (!(det > 1e-9 * N(0, 0) * N(1, 1))) {
      break; // what is left is of one grey value
    }
    m_gain += (N(1, 1) * N(0, 2) - N(0, 1) * N(1, 2)) / det;
    m_bias += (N(0, 0) * N(1, 2) - N(0, 1) * N(0, 2)) / det;
    sigma = residuals(level);
  }
  return sigma;
}

// Take the softness whose residuals are smallest for their gain, by descent from the present one; true if it is another.
bool vpPhotometricRefiner::matchBlur(std::size_t index)
{
  const std::size_t before = m_soft;
  const auto misfit = [&](std::size_t soft) {
    const double sigma = fitPhotometry(m_model.level(index, soft));
    return m_gain > smallestGain ? sigma / m_gain : rejected;
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
  constexpr int block = 16; // samples; a larger zero-mean area lets light and dark halves pass for a match of detail
  vpPhotometricFit fit;
  const std::size_t index = finestUseful(pose);
  const vpPhotometricLevel &level = m_model.level(index, m_soft);
  const double n = static_cast<double>(level.samples.size());
  const std::size_t inside = sample(pyramid, index, pose);
  fit.inImage = static_cast<double>(inside) / n;
  if (inside < fewestSamples) {
    return fit;
  }
  startPhotometry(level);
  const double sigma = fitPhotometry(level);
  const double noise2 = tukey * tukey * sigma * sigma;
  const double slope2 = tukey * tukey * m_gain * m_gain * smallestShift * smallestShift;
  double accepted = 0., varR = 0., varI = 0., cov = 0.;
  for (int top = 0; top < level.rows; top += block) {
    for (int left = 0; left < level.cols; left += block) {
      double count = 0., sumR = 0., sumI = 0., sumRR = 0., sumII = 0., sumRI = 0.;
      for (int r = top; r < std::min(top + block, level.rows); ++r) {
        for (int c = left; c < std::min(left + block, level.cols); ++c) {
          const std::size_t i = static_cast<std::size_t>(r) * static_cast<std::size_t>(level.cols) + static_cast<std::size_t>(c);
          const double e = m_residuals[i], R = level.samples[i].value, I = m_values[i];
          if (e * e < noise2 + slope2 * level.samples[i].slope2) {
            count += 1.;
            sumR += R;
            sumI += I;
            sumRR += R * R;
            sumII += I * I;
            sumRI += R * I;
          }
        }
      }
      if (count > 0.) {
        accepted += count;
        varR += sumRR - sumR * sumR / count;
        varI += sumII - sumI * sumI / count;
        cov += sumRI - sumR * sumI / count;
      }
    }
  }
  fit.visible = accepted / n;
  if (varR > 0. && varI > 0.) {
    fit.correlation = cov / std::sqrt(varR * varI);
  }
  return fit;
}

END_VISP_NAMESPACE
