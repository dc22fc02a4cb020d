/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTargetPrediction.h"

#include <visp3/direct_core/vpSO3.h>

#include <Eigen/LU>

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int smallestSide = 16;  // of a texture, texels
constexpr double texelSize = 0.6; // px
constexpr double reach = 3.;      // deviations of the blur: of the kernel,
constexpr double edge = 2.;       // and from the edge of the target, beyond half a pixel and another half
constexpr int undistortSteps = 4; // fixed point; each gains a factor of 3 kud r^2

using Lanes = Eigen::Array<float, vpTargetPrediction::lanes, 1>;

// Undistorted normalised coordinates of a pixel.
template <typename T> void toNormalised(const vpPinhole &camera, T u, T v, T &x, T &y)
{
  const T xd = (u - static_cast<T>(camera.u0)) / static_cast<T>(camera.px);
  const T yd = (v - static_cast<T>(camera.v0)) / static_cast<T>(camera.py);
  x = xd;
  y = yd;
  if (camera.kud != 0.) {
    for (int k = 0; k < undistortSteps; ++k) {
      const T scale = T(1) / (T(1) + static_cast<T>(camera.kud) * (x * x + y * y));
      x = xd * scale;
      y = yd * scale;
    }
  }
}

Eigen::Matrix3d planeToCamera(const vpRigidPose &pose)
{
  Eigen::Matrix3d H;
  H << pose.R.col(0), pose.R.col(1), pose.t;
  return H;
}

cv::Mat resized(cv::Mat &buffer, int rows, int cols)
{
  // Buffers grow and never shrink, because targets move.
  if (buffer.rows < rows || buffer.cols < cols) {
    buffer.create(std::max(buffer.rows, rows), std::max(buffer.cols, cols), CV_32F);
  }
  return buffer;
}
} // namespace

vpTargetTexture::vpTargetTexture(const cv::Mat &reference, const vpTargetPlane &plane) : m_plane(plane)
{
  cv::Mat level;
  reference.convertTo(level, CV_32F);
  m_levels.push_back(level);
  while (std::min(level.cols, level.rows) >= 2 * smallestSide) {
    cv::Mat half;
    // Also for odd sizes: the level still covers the target from edge to edge.
    cv::resize(level, half, cv::Size((level.cols + 1) / 2, (level.rows + 1) / 2), 0., 0., cv::INTER_AREA);
    level = half;
    m_levels.push_back(level);
  }
}

const cv::Mat &vpTargetTexture::at(const vpRigidPose &pose, const vpPinhole &camera) const
{
  const double pixels = std::sqrt(imageScale(pose, camera) * m_plane.width * m_plane.height); // side of the target
  std::size_t k = 0;
  while (k + 1 < m_levels.size() && pixels <= texelSize * std::sqrt(static_cast<double>(m_levels[k + 1].total()))) {
    ++k;
  }
  return m_levels[k];
}

/*
 * Pixel box and Gaussian, h(x) = (Phi((x + 1/2) / blur) - Phi((x - 1/2) / blur)) / 2 at the samples x = 1/4, 3/4, ...
 * px and their mirror images. The derivatives are h with fourth-order differences of the samples: valid for any blur.
 */
struct vpTargetPrediction::Kernel {
  static constexpr int stencil = 2;
  static constexpr int most = 2 * static_cast<int>(reach * softest) + 2 + stencil;
  int size = 0;
  std::array<float, most> mean{}, slope{}, curvature{}; // of the samples at x > 0; slope is odd, the others are even

  explicit Kernel(double blur)
  {
    const int n = std::max(1, static_cast<int>(std::ceil(2. * reach * blur + 0.5)));
    size = n + stencil;
    std::array<double, 2 * most + 4 * stencil>
        h{}; // from the left; sample i > 0 to the right of the centre is at middle + i
    const int middle = most + 2 * stencil;
    double sum = 0.;
    for (int i = 0; i < n; ++i) {
      const double x = 0.25 + 0.5 * i, s = 1. / (blur * std::sqrt(2.));
      const double value = std::erf(s * (x + 0.5)) - std::erf(s * (x - 0.5));
      h[static_cast<std::size_t>(middle + i)] = h[static_cast<std::size_t>(middle - 1 - i)] = value;
      sum += 2. * value;
    }
    const auto at = [&](int i) { return h[static_cast<std::size_t>(middle + i)] / sum; };
    for (int i = 0; i < size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      mean[k] = static_cast<float>(at(i));
      slope[k] = static_cast<float>((8. * (at(i - 1) - at(i + 1)) - (at(i - 2) - at(i + 2))) / 6.);
      curvature[k] = static_cast<float>((16. * (at(i - 1) + at(i + 1)) - 30. * at(i) - (at(i - 2) + at(i + 2))) / 3.);
    }
  }
  //! Radius of the kernel, whole pixels.
  [[nodiscard]] int halo() const { return (size + 1) / 2; }
};

// The rectangle of the frame that contains the target, and its spans.
bool vpTargetPrediction::findArea(const vpRigidPose &pose, const vpPinhole &camera, cv::Size size, double margin)
{
  // Pixels per metre along each side, at the corner where it is smallest: the margin is valid everywhere.
  double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9, scaleX = 1e9, scaleY = 1e9;
  const auto corners = m_plane.corners();
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < 4; ++k) { // edges are bent by distortion
      const Eigen::Vector2d c = corners[i] + 0.25 * k * (corners[(i + 1) % 4] - corners[i]);
      const Eigen::Vector3d P = pose.R.leftCols<2>() * c + pose.t;
      if (!(P.z() > 0.)) {
        return false;
      }
      const Eigen::Vector2d x = P.head<2>() / P.z(), p = camera.project(x);
      left = std::min(left, p.x());
      right = std::max(right, p.x());
      top = std::min(top, p.y());
      bottom = std::max(bottom, p.y());
      for (int j = 0; j < 2; ++j) {
        const Eigen::Vector2d d = (pose.R.col(j).head<2>() - x * pose.R(2, j)) / P.z();
        double &scale = j == 0 ? scaleX : scaleY;
        scale = std::min(scale, std::hypot(camera.px * d.x(), camera.py * d.y()));
      }
    }
  }
  if (!std::isfinite(left + top + right + bottom)) {
    return false;
  }
  const int u0 = static_cast<int>(std::clamp(std::floor(left), 0., static_cast<double>(size.width)));
  const int u1 = static_cast<int>(std::clamp(std::ceil(right) + 1., 0., static_cast<double>(size.width)));
  const int v0 = static_cast<int>(std::clamp(std::floor(top), 0., static_cast<double>(size.height)));
  const int v1 = static_cast<int>(std::clamp(std::ceil(bottom) + 1., 0., static_cast<double>(size.height)));
  const int cols = (u1 - u0 + lanes - 1) / lanes * lanes;
  m_area = cv::Rect(u0, v0, cols, v1 - v0);
  m_spans.assign(static_cast<std::size_t>(std::max(0, v1 - v0)), Span());
  m_pixels = 0;
  const double halfX = 0.5 * m_plane.width - margin / scaleX, halfY = 0.5 * m_plane.height - margin / scaleY;
  const Eigen::Matrix3d toPlane = planeToCamera(pose).inverse();
  const auto inside = [&](int u, int v) {
    double x, y;
    toNormalised<double>(camera, u, v, x, y);
    const Eigen::Vector3d q = toPlane * Eigen::Vector3d(x, y, 1.);
    return std::abs(q.x()) <= halfX * q.z() && std::abs(q.y()) <= halfY * q.z();
  };
  for (int r = 0; r < v1 - v0; ++r) {
    int begin = 0, end = u1 - u0;
    while (begin < end && !inside(u0 + begin, v0 + r)) {
      ++begin;
    }
    while (end > begin && !inside(u0 + end - 1, v0 + r)) {
      --end;
    }
    m_spans[static_cast<std::size_t>(r)] = {begin, end};
    m_pixels += end - begin;
  }
  return m_pixels >= fewestPixels;
}

// Two samples per pixel of [begin, end) of the rectangle's columns, at row v of the frame.
void vpTargetPrediction::sampleRow(const cv::Mat &texture, const Eigen::Matrix3f &toTexel, const vpPinhole &camera,
                                   double v, int begin, int end)
{
  const int n = 2 * (end - begin), stride = static_cast<int>(texture.step1());
  const float lastU = static_cast<float>(texture.cols - 1) - 1e-3f,
              lastV = static_cast<float>(texture.rows - 1) - 1e-3f;
  const float first = static_cast<float>(m_area.x + begin) - 0.25f, line = static_cast<float>(v);
  float *const texelU = m_texelU.data(), *const texelV = m_texelV.data();
  int *const texel = m_texel.data();
  // Separate loops with one kind of work each, which compilers vectorise.
  if (camera.kud == 0.) {
    float x, y;
    toNormalised<float>(camera, first, line, x, y);
    const float step = static_cast<float>(0.5 / camera.px);
    for (int i = 0; i < n; ++i) {
      texelU[i] = x + step * static_cast<float>(i);
      texelV[i] = y;
    }
  }
  else {
    for (int i = 0; i < n; ++i) {
      toNormalised<float>(camera, first + 0.5f * static_cast<float>(i), line, texelU[i], texelV[i]);
    }
  }
  for (int i = 0; i < n; ++i) {
    const float x = texelU[i], y = texelV[i];
    const float scale = 1.f / (toTexel(2, 0) * x + toTexel(2, 1) * y + toTexel(2, 2));
    const float a = scale * (toTexel(0, 0) * x + toTexel(0, 1) * y + toTexel(0, 2));
    const float b = scale * (toTexel(1, 0) * x + toTexel(1, 1) * y + toTexel(1, 2));
    const float u = std::min(lastU, std::max(0.f, a)), w = std::min(lastV, std::max(0.f, b)); // also removes NaN
    const int iu = static_cast<int>(u), iv = static_cast<int>(w);
    texelU[i] = u - static_cast<float>(iu);
    texelV[i] = w - static_cast<float>(iv);
    texel[i] = iv * stride + iu;
  }
  const float *const upperRow = texture.ptr<float>(), *const lowerRow = upperRow + stride;
  const auto sample = [&](int i) {
    const float *const p = upperRow + texel[i], *const q = lowerRow + texel[i];
    const float upper = p[0] + texelU[i] * (p[1] - p[0]), lower = q[0] + texelU[i] * (q[1] - q[0]);
    return upper + texelV[i] * (lower - upper);
  };
  float *const left = m_left.data(), *const right = m_right.data();
  for (int i = 0; i < n / 2; ++i) {
    left[i] = sample(2 * i);
    right[i] = sample(2 * i + 1);
  }
}

// Filters the samples along the row. begin and end as in sampleRow(); row is that of the ring.
void vpTargetPrediction::filterRow(const Kernel &kernel, int begin, int end, int row)
{
  const int halo = kernel.halo();
  float *const mean = m_smooth.ptr<float>(row), *const slope = m_slope.ptr<float>(row),
               *const curvature = m_curvature.ptr<float>(row);
  const int last = std::min(end - halo, m_area.width);
  for (int c = std::max(0, begin + halo); c < last; c += lanes) {
    Lanes h = Lanes::Zero(), d = Lanes::Zero(), l = Lanes::Zero();
    for (int i = 0; i < kernel.size; ++i) {
      // Sample 1/4 + i/2 to the right is in the right half when i is even; its mirror image in the left half.
      const int step = (i + 1) / 2, k = c - begin;
      const float *const above =
          i % 2 == 0 ? &m_right[static_cast<std::size_t>(k + step)] : &m_left[static_cast<std::size_t>(k + step)];
      const float *const below =
          i % 2 == 0 ? &m_left[static_cast<std::size_t>(k - step)] : &m_right[static_cast<std::size_t>(k - step)];
      const Lanes a = Eigen::Map<const Lanes>(above), b = Eigen::Map<const Lanes>(below), sum = a + b;
      h += kernel.mean[static_cast<std::size_t>(i)] * sum;
      d += kernel.slope[static_cast<std::size_t>(i)] * (a - b);
      l += kernel.curvature[static_cast<std::size_t>(i)] * sum;
    }
    Eigen::Map<Lanes>(mean + c) = h;
    Eigen::Map<Lanes>(slope + c) = d;
    Eigen::Map<Lanes>(curvature + c) = l;
  }
}

// One row of the prediction from the ring.
void vpTargetPrediction::filterColumns(const Kernel &kernel, int row)
{
  const Span span = m_spans[static_cast<std::size_t>(row)];
  const int ring = 4 * kernel.halo() + 2, first = 2 * (row + kernel.halo()); // fine row of this row's upper half
  for (int c = span.begin / lanes * lanes; c < span.end; c += lanes) {
    Lanes grey = Lanes::Zero(), du = Lanes::Zero(), dv = Lanes::Zero(), dBlur = Lanes::Zero();
    for (int i = 0; i < kernel.size; ++i) {
      const int lower = (first + 1 + i) % ring, upper = (first - i) % ring;
      const auto at = [c](const cv::Mat &m, int r) -> Lanes { return Eigen::Map<const Lanes>(m.ptr<float>(r) + c); };
      const Lanes a = at(m_smooth, lower), b = at(m_smooth, upper), sum = a + b;
      const float h = kernel.mean[static_cast<std::size_t>(i)];
      grey += h * sum;
      du += h * (at(m_slope, lower) + at(m_slope, upper));
      dv += kernel.slope[static_cast<std::size_t>(i)] * (a - b);
      dBlur +=
          h * (at(m_curvature, lower) + at(m_curvature, upper)) + kernel.curvature[static_cast<std::size_t>(i)] * sum;
    }
    Eigen::Map<Lanes>(m_grey.ptr<float>(row) + c) = grey;
    Eigen::Map<Lanes>(m_du.ptr<float>(row) + c) = du;
    Eigen::Map<Lanes>(m_dv.ptr<float>(row) + c) = dv;
    Eigen::Map<Lanes>(m_dBlur.ptr<float>(row) + c) = dBlur;
  }
}

bool vpTargetPrediction::predict(const vpTargetTexture &texture, const vpRigidPose &pose, const vpPinhole &camera,
                                 cv::Size size, double blur)
{
  const Kernel kernel(blur);
  // Beyond the kernel's reach the frame mixes with what is behind the target.
  if (!findArea(pose, camera, size, 1. + edge * blur)) {
    return false;
  }
  const cv::Mat &level = texture.at(pose, camera);
  Eigen::Matrix3d toTexel;
  toTexel << level.cols / m_plane.width, 0., 0.5 * level.cols - 0.5, 0., level.rows / m_plane.height,
      0.5 * level.rows - 0.5, 0., 0., 1.;
  Eigen::Matrix3d normalisedToTexel = toTexel * planeToCamera(pose).inverse();
  normalisedToTexel *= pose.t.z(); // about 1 in the denominator
  const Eigen::Matrix3f projection = normalisedToTexel.cast<float>();

  const int halo = kernel.halo(), rows = m_area.height, ring = 4 * halo + 2;
  for (cv::Mat *m : {&m_grey, &m_du, &m_dv, &m_dBlur}) {
    resized(*m, rows, m_area.width).setTo(0.f);
  }
  for (cv::Mat *m : {&m_smooth, &m_slope, &m_curvature}) {
    resized(*m, ring, m_area.width + lanes);
  }
  const std::size_t samples = 2 * static_cast<std::size_t>(m_area.width + 2 * halo + 2 * lanes);
  for (std::vector<float> *v : {&m_texelU, &m_texelV, &m_left, &m_right}) {
    v->resize(samples);
  }
  m_texel.resize(samples);
  int next = 0; // row of samples, 0 is the upper one of row -halo
  for (int r = 0; r < rows; ++r) {
    if (m_spans[static_cast<std::size_t>(r)].begin >= m_spans[static_cast<std::size_t>(r)].end) {
      continue;
    }
    next = std::max(next, 2 * r);
    for (; next < 2 * (r + 2 * halo + 1); ++next) {
      // All columns needed by a row within reach.
      int begin = m_area.width, end = 0;
      for (int k = std::max(0, next / 2 - 2 * halo); k <= std::min(rows - 1, next / 2); ++k) {
        const Span span = m_spans[static_cast<std::size_t>(k)];
        if (span.begin < span.end) {
          begin = std::min(begin, span.begin / lanes * lanes);
          end = std::max(end, (span.end + lanes - 1) / lanes * lanes);
        }
      }
      if (begin >= end) {
        continue;
      }
      sampleRow(level, projection, camera, m_area.y - halo + 0.5 * next - 0.25, begin - halo, end + halo);
      filterRow(kernel, begin - halo, end + halo, next % ring);
    }
    filterColumns(kernel, r);
  }
  return true;
}

Eigen::Matrix<double, 2, 6> pixelMotion(const vpRigidPose &pose, const vpPinhole &camera, double u, double v)
{
  double x, y;
  toNormalised<double>(camera, u, v, x, y);
  const Eigen::Vector3d ray(x, y, 1.), normal = pose.R.col(2);
  const double Z = normal.dot(pose.t) / normal.dot(ray);
  Eigen::Matrix<double, 2, 3> projection;
  projection << 1. / Z, 0., -x / Z, 0., 1. / Z, -y / Z;
  const Eigen::Vector2d xy(x, y);
  Eigen::Matrix2d lens =
      (1. + camera.kud * xy.squaredNorm()) * Eigen::Matrix2d::Identity() + 2. * camera.kud * xy * xy.transpose();
  lens.row(0) *= camera.px;
  lens.row(1) *= camera.py;
  Eigen::Matrix<double, 2, 6> J;
  J.leftCols<3>() = lens * projection;
  J.rightCols<3>() = -J.leftCols<3>() * vpSO3::skew(Z * ray - pose.t);
  return J;
}

Eigen::Vector2d pixelShift(const vpRigidPose &from, const vpRigidPose &to, const vpPinhole &camera, double u, double v)
{
  double x, y;
  toNormalised<double>(camera, u, v, x, y);
  const Eigen::Vector3d ray(x, y, 1.), normal = from.R.col(2);
  const Eigen::Vector3d point = from.R.transpose() * (ray * (normal.dot(from.t) / normal.dot(ray)) - from.t);
  const Eigen::Vector3d P = to.R * point + to.t;
  return camera.project(P.head<2>() / P.z()) - Eigen::Vector2d(u, v);
}

END_VISP_NAMESPACE
