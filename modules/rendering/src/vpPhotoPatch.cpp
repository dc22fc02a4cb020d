/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPhotoPatch.h"

#include <visp3/core/vpMatrix.h>
#include <visp3/core/vpMeterPixelConversion.h>
#include <visp3/core/vpUniRand.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double nearPlane = 1e-3; // m
} // namespace

vpPlaneOutline::vpPlaneOutline(const vpHomogeneousMatrix &cMo, double width, double height,
                               const vpCameraParameters &camera)
{
  const Eigen::Vector3d centre(cMo[0][3], cMo[1][3], cMo[2][3]), normal(cMo[0][2], cMo[1][2], cMo[2][2]);
  if (!(centre.dot(normal) > 0.)) {
    return; // seen from behind or from the side
  }
  Eigen::Vector3d corners[4];
  const double signs[4][2] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  for (int i = 0; i < 4; ++i) {
    const double x = signs[i][0] * width, y = signs[i][1] * height;
    for (int r = 0; r < 3; ++r) {
      corners[i](r) = cMo[r][0] * x + cMo[r][1] * y + cMo[r][3];
    }
  }
  const auto add = [&](const Eigen::Vector3d &P) {
    double u = 0., v = 0.;
    vpMeterPixelConversion::convertPoint(camera, P.x() / P.z(), P.y() / P.z(), u, v);
    m_u.push_back(u);
    m_v.push_back(v);
  };
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % 4];
    if (a.z() >= nearPlane) {
      add(a);
    }
    if ((a.z() >= nearPlane) != (b.z() >= nearPlane)) {
      add(a + (b - a) * ((nearPlane - a.z()) / (b.z() - a.z())));
    }
  }
}

double vpPlaneOutline::area() const
{
  double twice = 0.;
  for (std::size_t i = 0; i < m_u.size(); ++i) {
    const std::size_t k = (i + 1) % m_u.size();
    twice += m_u[i] * m_v[k] - m_u[k] * m_v[i];
  }
  return 0.5 * std::fabs(twice);
}

void vpPlaneOutline::box(double &left, double &top, double &right, double &bottom) const
{
  left = *std::min_element(m_u.begin(), m_u.end());
  right = *std::max_element(m_u.begin(), m_u.end());
  top = *std::min_element(m_v.begin(), m_v.end());
  bottom = *std::max_element(m_v.begin(), m_v.end());
}

bool vpPlaneOutline::span(double v, double &left, double &right) const
{
  left = std::numeric_limits<double>::max();
  right = -left;
  for (std::size_t i = 0; i < m_u.size(); ++i) {
    const std::size_t k = (i + 1) % m_u.size();
    // Half open, so that a vertex on the line counts for only one of its two edges.
    if ((m_v[i] <= v) != (m_v[k] <= v)) {
      const double u = m_u[i] + (m_u[k] - m_u[i]) * (v - m_v[i]) / (m_v[k] - m_v[i]);
      left = std::min(left, u);
      right = std::max(right, u);
    }
  }
  return left < right;
}

namespace
{
constexpr unsigned int coarsestSize = 16; // px; smaller copies would only be used for objects of a few pixels
constexpr int margin = 1;                 // texels; bilinear interpolation ends at the centres of the border texels

// Each pixel is the mean of 2x2; an odd last row or column counts twice.
vpImage<unsigned char> halved(const vpImage<unsigned char> &fine)
{
  vpImage<unsigned char> coarse((fine.getHeight() + 1) / 2, (fine.getWidth() + 1) / 2);
  for (unsigned int r = 0; r < coarse.getHeight(); ++r) {
    const unsigned int r0 = 2 * r, r1 = std::min(r0 + 1, fine.getHeight() - 1);
    for (unsigned int c = 0; c < coarse.getWidth(); ++c) {
      const unsigned int c0 = 2 * c, c1 = std::min(c0 + 1, fine.getWidth() - 1);
      coarse[r][c] = static_cast<unsigned char>((fine[r0][c0] + fine[r0][c1] + fine[r1][c0] + fine[r1][c1] + 2) / 4);
    }
  }
  return coarse;
}

vpImage<unsigned char> withMargin(const vpImage<unsigned char> &image)
{
  const int h = static_cast<int>(image.getHeight()), w = static_cast<int>(image.getWidth());
  vpImage<unsigned char> wide(h + 2 * margin, w + 2 * margin);
  for (int r = 0; r < h + 2 * margin; ++r) {
    for (int c = 0; c < w + 2 * margin; ++c) {
      wide[r][c] = image[std::clamp(r - margin, 0, h - 1)][std::clamp(c - margin, 0, w - 1)];
    }
  }
  return wide;
}

// Bit-identical to vpImageTools::warpImage() with linear interpolation and without fixed point (whose 16 bits leave two
// digits for the perspective terms), but faster. H maps pixels of the photo to pixels of the image.
void warp(const vpImage<unsigned char> &photo, const vpMatrix &H, vpImage<unsigned char> &image)
{
  const Eigen::Matrix3d A = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(H.data).inverse();
  const double right = photo.getWidth() - 1., bottom = photo.getHeight() - 1.;
  const std::size_t pitch = photo.getWidth();
  for (unsigned int r = 0; r < image.getHeight(); ++r) {
    const Eigen::Vector3d row = A.col(1) * r + A.col(2);
    unsigned char *const pixels = image[r];
    for (unsigned int c = 0; c < image.getWidth(); ++c) {
      const double scale = 1. / (A(2, 0) * c + row(2));
      const double x = scale * (A(0, 0) * c + row(0)), y = scale * (A(1, 0) * c + row(1));
      if (!(x >= 0. && y >= 0. && x < right && y < bottom)) {
        continue;
      }
      const int u = static_cast<int>(x), v = static_cast<int>(y);
      const double s = x - u, t = y - v;
      const unsigned char *const p = photo.bitmap + static_cast<std::size_t>(v) * pitch + static_cast<std::size_t>(u);
      const double upper = p[0] + s * (p[1] - p[0]), lower = p[pitch] + s * (p[pitch + 1] - p[pitch]);
      pixels[c] = static_cast<unsigned char>(upper + t * (lower - upper) + 0.5);
    }
  }
}
} // namespace

vpPhotoPyramid::vpPhotoPyramid(const vpImage<unsigned char> &photo, double width, double height)
  : m_width(width), m_height(height), m_photoWidth(photo.getWidth()), m_photoHeight(photo.getHeight())
{
  vpImage<unsigned char> level = photo;
  m_levels.push_back(withMargin(level));
  while (std::min(level.getWidth(), level.getHeight()) >= 2 * coarsestSize) {
    level = halved(level);
    m_levels.push_back(withMargin(level));
  }
}

void vpPhotoPyramid::draw(const vpHomogeneousMatrix &cMo, const vpCameraParameters &camera, double area,
                          vpImage<unsigned char> &image) const
{
  // Photograph pixels per pixel along one axis, on average.
  const double step = std::sqrt(static_cast<double>(m_photoWidth) * m_photoHeight / std::max(area, 1e-3));
  const long level = std::clamp<long>(std::lround(std::log2(step)), 0, static_cast<long>(m_levels.size()) - 1);
  const double texel = std::ldexp(1., static_cast<int>(level));
  // Texel i of the level, margin counted, is centred i - margin + 1/2 texels from the photograph's left edge.
  const double xScale = texel * m_width / m_photoWidth, yScale = texel * m_height / m_photoHeight;
  const double x0 = (0.5 - margin) * xScale - 0.5 * m_width, y0 = (0.5 - margin) * yScale - 0.5 * m_height;
  vpMatrix H(3, 3); // texels to pixels: K [r1 r2 t] (x, y, 1) with x = x0 + xScale i, y likewise
  for (unsigned int r = 0; r < 3; ++r) {
    H[r][0] = cMo[r][0] * xScale;
    H[r][1] = cMo[r][1] * yScale;
    H[r][2] = cMo[r][0] * x0 + cMo[r][1] * y0 + cMo[r][3];
  }
  for (unsigned int c = 0; c < 3; ++c) {
    H[0][c] = camera.get_px() * H[0][c] + camera.get_u0() * H[2][c];
    H[1][c] = camera.get_py() * H[1][c] + camera.get_v0() * H[2][c];
  }
  warp(m_levels[level], H, image);
}

vpImage<unsigned char> vpFaintWall(unsigned int width, unsigned int height)
{
  constexpr int waves = 6;
  constexpr double amplitude = 8., grey = 128.;
  vpUniRand random(3);
  double du[waves], dv[waves], phase[waves];
  for (int k = 0; k < waves; ++k) {
    const double direction = random.uniform(0., 2. * M_PI), wavelength = random.uniform(80., 250.);
    du[k] = 2. * M_PI / wavelength * std::cos(direction);
    dv[k] = 2. * M_PI / wavelength * std::sin(direction);
    phase[k] = random.uniform(0., 2. * M_PI);
  }
  vpImage<unsigned char> image(height, width);
  for (unsigned int r = 0; r < height; ++r) {
    for (unsigned int c = 0; c < width; ++c) {
      double value = grey;
      for (int k = 0; k < waves; ++k) {
        value += amplitude * std::sin(du[k] * c + dv[k] * r + phase[k]);
      }
      image[r][c] = static_cast<unsigned char>(std::lround(value));
    }
  }
  return image;
}

END_VISP_NAMESPACE
