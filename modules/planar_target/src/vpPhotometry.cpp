/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPhotometry.h"

#include <visp3/direct_core/vpQuantile.h>

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
constexpr float outside = -1.f;
constexpr float rejected = 1e9f;

vpPhotometricLevel makeLevel(const cv::Mat &image, const vpTargetPlane &plane, double unit)
{
  vpPhotometricLevel level;
  level.cols = image.cols - 2 * border;
  level.rows = image.rows - 2 * border;
  level.pitchX = plane.width / image.cols / unit;
  level.pitchY = plane.height / image.rows / unit;
  level.firstX = (border + 0.5 - 0.5 * image.cols) * level.pitchX;
  level.firstY = (border + 0.5 - 0.5 * image.rows) * level.pitchY;
  level.samples.reserve(static_cast<std::size_t>(level.cols) * static_cast<std::size_t>(level.rows));
  for (int v = border; v < image.rows - border; ++v) {
    for (int u = border; u < image.cols - border; ++u) {
      const double gu = 0.5 * (image.at<float>(v, u + 1) - image.at<float>(v, u - 1));
      const double gv = 0.5 * (image.at<float>(v + 1, u) - image.at<float>(v - 1, u));
      level.samples.push_back({image.at<float>(v, u), static_cast<float>(gu / level.pitchX),
                               static_cast<float>(gv / level.pitchY), static_cast<float>(gu * gu + gv * gv)});
    }
  }
  double sum = 0.;
  for (const vpPhotometricSample &s : level.samples) {
    sum += s.slope2;
  }
  level.textured = static_cast<float>(0.25 * sum / static_cast<double>(level.samples.size()));
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
  const std::size_t n = model.level(0, 0).samples.size();
  m_values.reserve(n);
  m_residuals.reserve(n);
  m_scratch.reserve(n);
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
  const float px = static_cast<float>(camera.px), py = static_cast<float>(camera.py);
  const float u0 = static_cast<float>(camera.u0), v0 = static_cast<float>(camera.v0),
              kud = static_cast<float>(camera.kud);
  const float lastU = static_cast<float>(frame.cols - 1), lastV = static_cast<float>(frame.rows - 1);
  const Eigen::Vector3d a = m_model.unit() * pose.R.col(0), b = m_model.unit() * pose.R.col(1);
  const Eigen::Vector3f next = (level.pitchX * a).cast<float>();
  m_values.resize(level.samples.size());
  for (std::vector<float> *row : {&m_u, &m_v}) {
    row->resize(static_cast<std::size_t>(level.cols));
  }
  std::size_t inside = 0;
  for (int r = 0; r < level.rows; ++r) {
    const Eigen::Vector3f first = (pose.t + level.firstX * a + (level.firstY + r * level.pitchY) * b).cast<float>();
    float *const us = m_u.data(), *const vs = m_v.data();
    for (int c = 0; c < level.cols; ++c) { // a separate loop: compilers vectorise it
      const float k = static_cast<float>(c);
      const float invZ = 1.f / (first.z() + k * next.z());
      const float x = invZ * (first.x() + k * next.x()), y = invZ * (first.y() + k * next.y());
      const float distortion = 1.f + kud * (x * x + y * y);
      us[c] = invZ > 0.f ? u0 + px * distortion * x : outside;
      vs[c] = v0 + py * distortion * y;
    }
    float *const values = &m_values[static_cast<std::size_t>(r) * static_cast<std::size_t>(level.cols)];
    for (int c = 0; c < level.cols; ++c) {
      const float u = us[c], v = vs[c];
      if (!(u >= 0.f && v >= 0.f && u < lastU && v < lastV)) {
        values[c] = outside;
        continue;
      }
      const int iu = static_cast<int>(u), iv = static_cast<int>(v);
      const float fu = u - static_cast<float>(iu), fv = v - static_cast<float>(iv);
      const unsigned char *p = frame.ptr<unsigned char>(iv) + iu, *q = p + frame.step[0];
      const float top = static_cast<float>(p[0]) + fu * static_cast<float>(p[1] - p[0]);
      const float bottom = static_cast<float>(q[0]) + fu * static_cast<float>(q[1] - q[0]);
      values[c] = top + fv * (bottom - top);
      ++inside;
    }
  }
  return inside;
}

double vpPhotometry::median() { return vpQuantileInPlace(m_scratch.data(), m_scratch.data() + m_scratch.size(), 0.5); }

// Occluders must not affect gain and bias: their errors would be taken for misalignment.
void vpPhotometry::start(const vpPhotometricLevel &level)
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
  const double lastGain = m_gain, lastBias = m_bias, last = update(level);
  m_gain = std::clamp(static_cast<double>(frameSpread / std::max(1.f, referenceSpread)), 0.2, 5.);
  m_bias = frame - m_gain * reference;
  if (last < update(level)) {
    m_gain = lastGain;
    m_bias = lastBias;
  }
  fit(level);
}

double vpPhotometry::update(const vpPhotometricLevel &level)
{
  const std::size_t n = level.samples.size();
  const float gain = static_cast<float>(m_gain), bias = static_cast<float>(m_bias);
  m_residuals.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    m_residuals[i] = m_values[i] >= 0.f ? m_values[i] - gain * level.samples[i].value - bias : rejected;
  }
  return deviation(level, 0.f);
}

double vpPhotometry::textureDeviation(const vpPhotometricLevel &level) { return deviation(level, level.textured); }

double vpPhotometry::deviation(const vpPhotometricLevel &level, float slope2)
{
  const std::size_t n = level.samples.size(), stride = std::max<std::size_t>(1, n / enoughForMedian);
  m_scratch.clear();
  for (std::size_t i = 0; i < n; i += stride) {
    if (m_residuals[i] != rejected && level.samples[i].slope2 >= slope2) {
      m_scratch.push_back(std::abs(m_residuals[i]));
    }
  }
  return m_scratch.empty() ? smallestSigma : std::max(smallestSigma, madToSigma * median());
}

double vpPhotometry::fit(const vpPhotometricLevel &level)
{
  double sigma = update(level);
  for (int k = 0; k < 4; ++k) {
    const vpPhotometricBound limit = bound(sigma, smallestShift);
    Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
    std::size_t i = 0;
    for (int r = 0; r < level.rows; ++r) {
      float w1 = 0.f, wr = 0.f, wrr = 0.f, we = 0.f, wre = 0.f;
      for (int c = 0; c < level.cols; ++c, ++i) {
        const float e = m_residuals[i], value = level.samples[i].value;
        const float w = limit.weight(e, level.samples[i]);
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
      break; // the remaining samples have one grey value
    }
    const double gain = (N(1, 1) * N(0, 2) - N(0, 1) * N(1, 2)) / det;
    const double bias = (N(0, 0) * N(1, 2) - N(0, 1) * N(0, 2)) / det;
    addToLight(gain, bias);
    sigma = update(level);
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
  constexpr int block = 16; // samples; in larger blocks, light and dark halves would pass for a match of detail
  const vpPhotometricBound limit = bound(sigma, smallestShift);
  double inside = 0., accepted = 0., varR = 0., varI = 0., cov = 0.;
  for (int top = 0; top < level.rows; top += block) {
    for (int left = 0; left < level.cols; left += block) {
      double count = 0., sumR = 0., sumI = 0., sumRR = 0., sumII = 0., sumRI = 0.;
      for (int r = top; r < std::min(top + block, level.rows); ++r) {
        for (int c = left; c < std::min(left + block, level.cols); ++c) {
          const std::size_t i =
              static_cast<std::size_t>(r) * static_cast<std::size_t>(level.cols) + static_cast<std::size_t>(c);
          const double R = level.samples[i].value, I = m_values[i];
          inside += I >= 0. ? 1. : 0.;
          if (limit.weight(m_residuals[i], level.samples[i]) > 0.f) {
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
  const double n = static_cast<double>(level.samples.size());
  vpPhotometricFit result;
  result.inImage = inside / n;
  result.visible = accepted / n;
  if (varR > 0. && varI > 0.) {
    result.correlation = cov / std::sqrt(varR * varI);
  }
  return result;
}

END_VISP_NAMESPACE
