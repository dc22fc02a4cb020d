/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPhotometry.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int border = 3;             // px left out: one for the gradient, two for the smoothing of the frame
constexpr int smallestSide = 24;      // of the coarsest level, px
constexpr double tukey = 4.685;       // 95 % efficiency under Gaussian noise
constexpr double madToSigma = 1.4826; // likewise
constexpr double smallestSigma = 1.5; // grey levels; a smaller one would reject rounding and interpolation as occlusion
constexpr std::size_t enoughForMedian = 2000;

// Step to about enoughForMedian samples.
int everyFor(const vpPhotometricLevel &level)
{
  return static_cast<int>(std::max<std::size_t>(1, level.size() / enoughForMedian));
}

vpPhotometricLevel makeLevel(const cv::Mat &image, const vpTargetPlane &plane, double unit)
{
  vpPhotometricLevel level;
  level.cols = image.cols - 2 * border;
  level.rows = image.rows - 2 * border;
  level.pitchX = plane.width / image.cols / unit;
  level.pitchY = plane.height / image.rows / unit;
  level.firstX = (border + 0.5 - 0.5 * image.cols) * level.pitchX;
  level.firstY = (border + 0.5 - 0.5 * image.rows) * level.pitchY;
  level.stride = vpGreyPadded(level.cols);
  for (std::vector<float> *v : {&level.values, &level.dx, &level.dy, &level.slope2}) {
    v->assign(static_cast<std::size_t>(level.stride) * static_cast<std::size_t>(level.rows), 0.f);
  }
  double sum = 0.;
  for (int r = 0; r < level.rows; ++r) {
    for (int c = 0; c < level.cols; ++c) {
      const int v = r + border, u = c + border;
      const auto i = static_cast<std::size_t>(r * level.stride + c);
      const double gu = 0.5 * (image.at<float>(v, u + 1) - image.at<float>(v, u - 1));
      const double gv = 0.5 * (image.at<float>(v + 1, u) - image.at<float>(v - 1, u));
      level.values[i] = image.at<float>(v, u);
      level.dx[i] = static_cast<float>(gu / level.pitchX);
      level.dy[i] = static_cast<float>(gv / level.pitchY);
      level.slope2[i] = static_cast<float>(gu * gu + gv * gv);
      sum += level.slope2[i];
    }
  }
  level.textured = static_cast<float>(0.25 * sum / static_cast<double>(level.size()));
  return level;
}
} // namespace

vpPhotometricModel::vpPhotometricModel(const cv::Mat &reference, const vpTargetPlane &plane, int finestSize)
  : m_unit(0.5 * std::max(plane.width, plane.height))
{
  cv::Mat source, image, soft;
  reference.convertTo(source, CV_32F);
  double scale = std::min(1., static_cast<double>(finestSize) / std::max(reference.cols, reference.rows));
  do {
    const cv::Size size(static_cast<int>(std::lround(scale * reference.cols)),
                        static_cast<int>(std::lround(scale * reference.rows)));
    cv::resize(source, image, size, 0., 0., cv::INTER_AREA);
    if (m_levels[0].empty()) {
      cv::Scalar mean, deviation;
      cv::meanStdDev(image, mean, deviation);
      m_contrast = deviation[0];
    }
    for (std::size_t i = 0; i < softness.size(); ++i) {
      cv::GaussianBlur(image, soft, cv::Size(), softness[i], 0., cv::BORDER_REPLICATE);
      m_levels[i].push_back(makeLevel(soft, plane, m_unit));
    }
    scale *= 0.5;
  } while (scale * std::min(reference.cols, reference.rows) >= smallestSide);
}

vpPhotometry::vpPhotometry(const vpPhotometricModel &model, const vpPinhole &camera) : m_model(model), m_camera(camera)
{
  m_values.reserve(model.level(0, 0).values.size());
}

double vpPhotometry::pixelsPerSample(std::size_t level, const vpRigidPose &pose) const
{
  return std::sqrt(imageScale(pose, m_camera)) * m_model.unit() * m_model.level(level, 0).pitchX;
}

std::size_t vpPhotometry::sample(const std::vector<cv::Mat> &pyramid, std::size_t index, const vpRigidPose &pose)
{
  const vpPhotometricLevel &level = m_model.level(index, 0);
  // The frame at the resolution of the samples or finer: a coarser one would be softer than any softness of the
  // reference.
  const double pixels = std::max(1., pixelsPerSample(index, pose));
  const int frameLevel = std::min(static_cast<int>(std::log2(pixels)), static_cast<int>(pyramid.size()) - 1);
  const cv::Mat &frame = pyramid[static_cast<std::size_t>(frameLevel)];
  const vpPinhole camera = m_camera.atLevel(frameLevel);
  vpGreyFrameRow row = {};
  row.frame = frame.ptr<unsigned char>();
  row.step = static_cast<int>(frame.step[0]);
  row.lastU = static_cast<float>(frame.cols - 1);
  row.lastV = static_cast<float>(frame.rows - 1);
  row.px = static_cast<float>(camera.px);
  row.py = static_cast<float>(camera.py);
  row.u0 = static_cast<float>(camera.u0);
  row.v0 = static_cast<float>(camera.v0);
  row.kud = static_cast<float>(camera.kud);
  const Eigen::Vector3d a = m_model.unit() * pose.R.col(0), b = m_model.unit() * pose.R.col(1);
  Eigen::Map<Eigen::Vector3f>(row.next) = (level.pitchX * a).cast<float>();
  m_values.resize(level.values.size());
  std::size_t inside = 0;
  for (int r = 0; r < level.rows; ++r) {
    Eigen::Map<Eigen::Vector3f>(row.first) =
        (pose.t + level.firstX * a + (level.firstY + r * level.pitchY) * b).cast<float>();
    inside += static_cast<std::size_t>(
        m_loops.sampleFrame(row, level.cols, &m_values[static_cast<std::size_t>(r * level.stride)]));
  }
  return inside;
}

// Occluders must not affect gain and bias: their errors would be taken for misalignment.
void vpPhotometry::start(const vpPhotometricLevel &level)
{
  const auto medianOf = [&](auto value) {
    m_median.clear();
    level.everyFew(everyFor(level), [&](std::size_t i) {
      if (m_values[i] >= 0.f) {
        m_median.add(value(i));
      }
    });
    return static_cast<float>(m_median.value());
  };
  const float reference = medianOf([&](std::size_t i) { return level.values[i]; });
  const float frame = medianOf([&](std::size_t i) { return m_values[i]; });
  const float referenceSpread = medianOf([&](std::size_t i) { return std::abs(level.values[i] - reference); });
  const float frameSpread = medianOf([&](std::size_t i) { return std::abs(m_values[i] - frame); });
  const double lastGain = m_gain, lastBias = m_bias, last = deviation(level);
  m_gain = std::clamp(static_cast<double>(frameSpread / std::max(1.f, referenceSpread)), 0.2, 5.);
  m_bias = frame - m_gain * reference;
  if (last < deviation(level)) {
    m_gain = lastGain;
    m_bias = lastBias;
  }
  fit(level);
}

double vpPhotometry::textureDeviation(const vpPhotometricLevel &level) { return deviation(level, level.textured); }

double vpPhotometry::deviation(const vpPhotometricLevel &level, float slope2)
{
  const float gain = static_cast<float>(m_gain), bias = static_cast<float>(m_bias);
  m_median.clear();
  level.everyFew(everyFor(level), [&](std::size_t i) {
    if (m_values[i] >= 0.f && level.slope2[i] >= slope2) {
      m_median.add(std::abs(m_values[i] - gain * level.values[i] - bias));
    }
  });
  return std::max(smallestSigma, madToSigma * m_median.value());
}

vpGreySamples vpPhotometry::samples(const vpPhotometricLevel &level, double sigma, double shift) const
{
  const vpPhotometricBound limit = bound(sigma, shift);
  return {m_values.data(),
          level.values.data(),
          level.dx.data(),
          level.dy.data(),
          level.slope2.data(),
          static_cast<float>(m_gain),
          static_cast<float>(m_bias),
          limit.noise2,
          limit.shift2};
}

double vpPhotometry::fit(const vpPhotometricLevel &level)
{
  double sigma = deviation(level);
  for (int k = 0; k < 4; ++k) {
    double sums[5] = {};
    m_loops.lightSums(samples(level, sigma, smallestShift), static_cast<int>(level.values.size()), sums);
    Eigen::Matrix3d N;
    N << sums[0], sums[1], sums[3], sums[1], sums[2], sums[4], 0., 0., 0.;
    const double det = N(0, 0) * N(1, 1) - N(0, 1) * N(0, 1);
    if (!(det > 1e-9 * N(0, 0) * N(1, 1))) {
      break; // the remaining samples have one grey value
    }
    const double gain = (N(1, 1) * N(0, 2) - N(0, 1) * N(1, 2)) / det;
    const double bias = (N(0, 0) * N(1, 2) - N(0, 1) * N(0, 2)) / det;
    addToLight(gain, bias);
    sigma = deviation(level);
    if (std::abs(gain) < 1e-3 * std::abs(m_gain) && std::abs(bias) < 0.1) {
      break;
    }
  }
  return sigma;
}

void vpPhotometry::addToLight(double gain, double bias)
{
  m_gain += gain;
  m_bias += bias;
}

vpPhotometricBound vpPhotometry::bound(double sigma, double shift) const
{
  const double noise = tukey * sigma, slope = tukey * m_gain * shift;
  return {static_cast<float>(noise * noise), static_cast<float>(slope * slope)};
}

vpPhotometricFit vpPhotometry::judge(const vpPhotometricLevel &level, double sigma) const
{
  constexpr int block =
      vpGreyMostLanes; // samples; in larger blocks, light and dark halves would pass for a match of detail
  vpGreySamples part = samples(level, sigma, smallestShift);
  double inside = 0., accepted = 0., varR = 0., varI = 0., cov = 0.;
  for (int top = 0; top < level.rows; top += block) {
    for (int left = 0; left < level.cols; left += block) {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(top) * level.stride + left;
      part.values = m_values.data() + at;
      part.reference = level.values.data() + at;
      part.slope2 = level.slope2.data() + at;
      vpGreyMoments m;
      m_loops.moments(part, std::min(block, level.rows - top), level.stride, m);
      inside += m.inside;
      if (m.count > 0.f) {
        const double count = m.count, R = m.R, I = m.I;
        accepted += count;
        varR += m.RR - R * R / count;
        varI += m.II - I * I / count;
        cov += m.RI - R * I / count;
      }
    }
  }
  const double n = static_cast<double>(level.size());
  vpPhotometricFit result;
  result.inImage = inside / n;
  result.visible = accepted / n;
  if (varR > 0. && varI > 0.) {
    result.correlation = cov / std::sqrt(varR * varI);
  }
  return result;
}

END_VISP_NAMESPACE
