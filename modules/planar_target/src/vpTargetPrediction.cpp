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

// Undistorted normalised coordinates of a pixel.
void toNormalised(const vpPinhole &camera, double u, double v, double &x, double &y)
{
  const double xd = (u - camera.u0) / camera.px, yd = (v - camera.v0) / camera.py;
  x = xd;
  y = yd;
  if (camera.kud != 0.) {
    for (int k = 0; k < vpGreyTextureRow::undistortSteps; ++k) {
      const double scale = 1. / (1. + camera.kud * (x * x + y * y));
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

// Buffers grow and never shrink, because targets move. New ones hold zeros, so that all of them is finite.
void enlarge(cv::Mat &buffer, int rows, int cols)
{
  if (buffer.rows < rows || buffer.cols < cols) {
    buffer = cv::Mat::zeros(std::max(buffer.rows, rows), std::max(buffer.cols, cols), CV_32F);
  }
}
} // namespace

vpTargetTexture::vpTargetTexture(const cv::Mat &reference, const vpTargetPlane &plane) : m_plane(plane)
{
  cv::Mat level;
  reference.convertTo(level, CV_32F);
  const auto add = [this](const cv::Mat &image) {
    m_levels.emplace_back();
    image.convertTo(m_levels.back(), CV_16U, scale);
  };
  add(level);
  while (std::min(level.cols, level.rows) >= 2 * smallestSide) {
    cv::Mat half;
    // Also for odd sizes: the level still covers the target from edge to edge.
    cv::resize(level, half, cv::Size((level.cols + 1) / 2, (level.rows + 1) / 2), 0., 0., cv::INTER_AREA);
    level = half;
    add(level);
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
  [[nodiscard]] std::array<const float *, 3> parts() const { return {mean.data(), slope.data(), curvature.data()}; }
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
    toNormalised(camera, u, v, x, y);
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
void vpTargetPrediction::sampleRow(const vpGreyLanes &loops, vpGreyTextureRow &row, double v, int begin, int end)
{
  const int count = vpGreyPadded(end - begin);
  row.row = static_cast<float>(v);
  row.first = static_cast<float>(m_area.x + begin) - 0.25f;
  loops.sampleTexture(row, count, m_left.data());
  row.first += 0.5f;
  loops.sampleTexture(row, count, m_right.data());
}

// Filters the samples along the row. begin and end as in sampleRow(); row is that of the ring.
void vpTargetPrediction::filterRow(const vpGreyLanes &loops, const Kernel &kernel, int begin, int end, int row)
{
  const int halo = kernel.halo(), first = std::max(0, begin + halo), last = std::min(end - halo, m_area.width);
  float *const out[3] = {m_smooth.ptr<float>(row) + first, m_slope.ptr<float>(row) + first,
                         m_curvature.ptr<float>(row) + first};
  const auto shift = static_cast<std::size_t>(first - begin);
  loops.filterRow(m_left.data() + shift, m_right.data() + shift, kernel.parts().data(), kernel.size, last - first, out);
}

// One row of the prediction from the ring.
void vpTargetPrediction::filterColumns(const vpGreyLanes &loops, const Kernel &kernel, int row)
{
  const Span span = m_spans[static_cast<std::size_t>(row)];
  const int ring = 4 * kernel.halo() + 2, first = 2 * (row + kernel.halo()); // fine row of this row's upper half
  const int begin = span.begin / lanes * lanes;
  std::array<const float *, static_cast<std::size_t>(3 * Kernel::most)> below{}, above{};
  for (int i = 0; i < kernel.size; ++i) {
    const auto k = static_cast<std::size_t>(3 * i);
    const int lower = (first + 1 + i) % ring, upper = (first - i) % ring;
    below[k] = m_smooth.ptr<float>(lower) + begin;
    above[k] = m_smooth.ptr<float>(upper) + begin;
    below[k + 1] = m_slope.ptr<float>(lower) + begin;
    above[k + 1] = m_slope.ptr<float>(upper) + begin;
    below[k + 2] = m_curvature.ptr<float>(lower) + begin;
    above[k + 2] = m_curvature.ptr<float>(upper) + begin;
  }
  float *const out[4] = {m_grey.ptr<float>(row) + begin, m_du.ptr<float>(row) + begin, m_dv.ptr<float>(row) + begin,
                         m_dBlur.ptr<float>(row) + begin};
  loops.filterColumns(below.data(), above.data(), kernel.parts().data(), kernel.size, span.end - begin, out);
}

// Leaves every third row of blocks.
void vpTargetPrediction::thin()
{
  m_pixels = 0;
  for (std::size_t r = 0; r < m_spans.size(); ++r) {
    if (r / lanes % 3 != 1) {
      m_spans[r] = Span();
    }
    m_pixels += m_spans[r].end - m_spans[r].begin;
  }
}

bool vpTargetPrediction::predict(const vpTargetTexture &texture, const vpRigidPose &pose, const vpPinhole &camera,
                                 cv::Size size, double blur, bool sparse)
{
  const Kernel kernel(blur);
  // Beyond the kernel's reach the frame mixes with what is behind the target.
  if (!findArea(pose, camera, size, 1. + edge * blur)) {
    return false;
  }
  if (sparse && m_pixels >= enoughToThin) {
    thin();
  }
  const cv::Mat &level = texture.at(pose, camera);
  Eigen::Matrix3d toTexel;
  toTexel << level.cols / m_plane.width, 0., 0.5 * level.cols - 0.5, 0., level.rows / m_plane.height,
      0.5 * level.rows - 0.5, 0., 0., 1.;
  Eigen::Matrix3d normalisedToTexel = toTexel * planeToCamera(pose).inverse();
  normalisedToTexel *= pose.t.z(); // about 1 in the denominator
  vpGreyTextureRow source = {};
  source.texels = level.ptr<std::uint16_t>();
  source.step = static_cast<int>(level.step1());
  source.lastU = static_cast<float>(level.cols - 1) - 1e-3f;
  source.lastV = static_cast<float>(level.rows - 1) - 1e-3f;
  Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(source.toTexel) = normalisedToTexel.cast<float>();
  source.px = static_cast<float>(camera.px);
  source.py = static_cast<float>(camera.py);
  source.u0 = static_cast<float>(camera.u0);
  source.v0 = static_cast<float>(camera.v0);
  source.kud = static_cast<float>(camera.kud);

  const vpGreyLanes &loops = vpChosenGreyLanes();
  const int halo = kernel.halo(), rows = m_area.height, ring = 4 * halo + 2;
  for (cv::Mat *m : {&m_grey, &m_du, &m_dv, &m_dBlur}) {
    enlarge(*m, rows + lanes, m_area.width + vpGreyMostLanes);
  }
  for (cv::Mat *m : {&m_smooth, &m_slope, &m_curvature}) {
    enlarge(*m, ring, m_area.width + vpGreyMostLanes);
  }
  const std::size_t samples = static_cast<std::size_t>(m_area.width + 4 * halo + 3 * vpGreyMostLanes);
  m_left.resize(std::max(m_left.size(), samples));
  m_right.resize(m_left.size());
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
      sampleRow(loops, source, m_area.y - halo + 0.5 * next - 0.25, begin - halo, end + halo);
      filterRow(loops, kernel, begin - halo, end + halo, next % ring);
    }
    filterColumns(loops, kernel, r);
  }
  return true;
}

Eigen::Matrix<double, 2, 6> pixelMotion(const vpRigidPose &pose, const vpPinhole &camera, double u, double v)
{
  double x, y;
  toNormalised(camera, u, v, x, y);
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
  toNormalised(camera, u, v, x, y);
  const Eigen::Vector3d ray(x, y, 1.), normal = from.R.col(2);
  const Eigen::Vector3d point = from.R.transpose() * (ray * (normal.dot(from.t) / normal.dot(ray)) - from.t);
  const Eigen::Vector3d P = to.R * point + to.t;
  return camera.project(P.head<2>() / P.z()) - Eigen::Vector2d(u, v);
}

END_VISP_NAMESPACE
