/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What the tests of planar poses share: a photograph on a plane in floating point and the least error that an estimate of
// its pose can have; photographs, random views, chi-square intervals.
#ifndef vpPlanarPoseKit_h
#define vpPlanarPoseKit_h

#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpIoTools.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/rendering/vpPlaneRenderer.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

using vpPoseError = Eigen::Matrix<double, 6, 1>;
using vpErrorCovariance = Eigen::Matrix<double, 6, 6>;

//! The pose after t += v, R = exp(w) R.
inline vpHomogeneousMatrix vpMoved(const vpHomogeneousMatrix &cMo, const vpPoseError &e)
{
  Eigen::Matrix3d R;
  for (int i = 0; i < 9; ++i) {
    R(i / 3, i % 3) = cMo[i / 3][i % 3];
  }
  R = vpSO3::exp(e.tail<3>()) * R;
  vpHomogeneousMatrix moved;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      moved[i][j] = R(i, j);
    }
    moved[i][3] = cMo[i][3] + e(i);
  }
  return moved;
}

//! (v, w) that leads from \e found to \e truth.
inline vpPoseError vpErrorOf(const vpHomogeneousMatrix &found, const vpHomogeneousMatrix &truth)
{
  Eigen::Matrix3d F, T;
  vpPoseError e;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      F(i, j) = found[i][j];
      T(i, j) = truth[i][j];
    }
    e(i) = truth[i][3] - found[i][3];
  }
  e.tail<3>() = vpSO3::log(T * F.transpose());
  return e;
}

/*!
 * The photograph at its full resolution, by Catmull and Rom's cubic interpolation, samples x samples to a pixel; a pixel is their
 * mean over its area, blurred by a Gaussian. A lens blurs before the sensor samples: blurring the pixels instead would leave
 * aliases, which no estimate can use but the bound would count. Nothing is rounded. The estimator samples otherwise.
 */
class vpFineRenderer
{
public:
  vpFineRenderer(const vpImage<unsigned char> &photo, double width, double height, double focal, unsigned int cols,
                 unsigned int rows)
    : m_photo(photo), m_width(width), m_height(height), m_focal(focal), m_cols(static_cast<int>(cols)),
      m_rows(static_cast<int>(rows))
  {}

  //! Grey values row by row; \e background off the target.
  std::vector<double> render(const vpHomogeneousMatrix &cMo, double blur, int samples, double background = 128.) const
  {
    const Eigen::Matrix3d toPlane = planeFromPixel(cMo);
    int left = m_cols, right = -1, top = m_rows, bottom = -1; // pixels that are not background before the blur
    for (int v = 0; v < m_rows; ++v) {
      for (int u = 0; u < m_cols; ++u) {
        if (contains(toPlane * Eigen::Vector3d(u, v, 1.), 3. * cMo[2][3] / m_focal)) {
          left = std::min(left, u);
          right = std::max(right, u);
          top = std::min(top, v);
          bottom = std::max(bottom, v);
        }
      }
    }
    std::vector<double> image(static_cast<std::size_t>(m_cols * m_rows), background);
    if (left > right) {
      return image;
    }
    // Samples of the photograph, then along rows and columns the lens's blur and the pixel's area together.
    const int reach = static_cast<int>(std::ceil(4. * blur));
    const int u0 = left - reach, v0 = top - reach; // of the first sample's pixel; the picture's border cuts nothing off
    const int wide = (right - left + 1 + 2 * reach) * samples, high = (bottom - top + 1 + 2 * reach) * samples;
    std::vector<double> fine(static_cast<std::size_t>(wide) * high);
    for (int r = 0; r < high; ++r) {
      for (int c = 0; c < wide; ++c) {
        const double u = u0 - 0.5 + (c + 0.5) / samples, v = v0 - 0.5 + (r + 0.5) / samples;
        const Eigen::Vector3d q = toPlane * Eigen::Vector3d(u, v, 1.);
        fine[static_cast<std::size_t>(r) * wide + c] = value(q.x() / q.z(), q.y() / q.z(), background);
      }
    }
    const std::vector<double> kernel = pixelKernel(blur, samples);
    const int n = (static_cast<int>(kernel.size()) - samples) / 2; // samples beyond the pixel
    std::vector<double> rows(static_cast<std::size_t>(right - left + 1 + 2 * reach) * high);
    const int cols = wide / samples;
    for (int r = 0; r < high; ++r) {
      for (int c = 0; c < cols; ++c) {
        double sum = 0.;
        for (std::size_t k = 0; k < kernel.size(); ++k) {
          const int at = std::clamp(c * samples - n + static_cast<int>(k), 0, wide - 1);
          sum += kernel[k] * fine[static_cast<std::size_t>(r) * wide + at];
        }
        rows[static_cast<std::size_t>(r) * cols + c] = sum;
      }
    }
    for (int v = std::max(0, v0); v < std::min(m_rows, v0 + high / samples); ++v) {
      for (int u = std::max(0, u0); u < std::min(m_cols, u0 + cols); ++u) {
        double sum = 0.;
        for (std::size_t k = 0; k < kernel.size(); ++k) {
          const int at = std::clamp((v - v0) * samples - n + static_cast<int>(k), 0, high - 1);
          sum += kernel[k] * rows[static_cast<std::size_t>(at) * cols + (u - u0)];
        }
        image[static_cast<std::size_t>(v * m_cols + u)] = sum;
      }
    }
    return image;
  }

  //! True if the pixel lies on the target, \e margin px from its edges or more (measured across the line of sight).
  bool isInside(const vpHomogeneousMatrix &cMo, int u, int v, double margin) const
  {
    return contains(planeFromPixel(cMo) * Eigen::Vector3d(u, v, 1.), -margin * cMo[2][3] / m_focal);
  }

  //! Grey values of a view and their derivatives by the pose.
  struct Slopes {
    std::vector<double> grey;
    std::array<std::vector<double>, 6> pose;
  };

  //! By differences of renders that are a twentieth of a pixel apart.
  Slopes slopes(const vpHomogeneousMatrix &cMo, double blur) const
  {
    constexpr int samples = 3; // with two, aliases make the bound 9 % lower
    const double pixel = cMo[2][3] / m_focal, lever = 0.3 * m_width;
    Slopes s;
    s.grey = render(cMo, blur, samples);
    for (int i = 0; i < 6; ++i) {
      const double h = 0.05 * (i < 2 ? pixel : i == 2 ? pixel * cMo[2][3] / lever : pixel / lever);
      const vpPoseError e = vpPoseError::Unit(i) * h;
      std::vector<double> &slope = s.pose[static_cast<std::size_t>(i)];
      slope = render(vpMoved(cMo, e), blur, samples);
      const std::vector<double> other = render(vpMoved(cMo, -e), blur, samples);
      for (std::size_t k = 0; k < other.size(); ++k) {
        slope[k] = (slope[k] - other[k]) / (2. * h);
      }
    }
    return s;
  }

  //! Bound of Cramer and Rao on the covariance of the pose, gain and bias of the camera unknown, from the pixels that \e use
  //! names.
  template <typename Use> vpErrorCovariance bound(const Slopes &slopes, double gain, double noise, Use use) const
  {
    Eigen::Matrix<double, 8, 8> N = Eigen::Matrix<double, 8, 8>::Zero();
    for (int v = 0; v < m_rows; ++v) {
      for (int u = 0; u < m_cols; ++u) {
        if (use(u, v)) {
          const auto k = static_cast<std::size_t>(v * m_cols + u);
          Eigen::Matrix<double, 8, 1> j;
          for (int i = 0; i < 6; ++i) {
            j(i) = gain * slopes.pose[static_cast<std::size_t>(i)][k];
          }
          j(6) = slopes.grey[k];
          j(7) = 1.;
          N += j * j.transpose();
        }
      }
    }
    const double variance = noise * noise + 1. / 12.; // and rounding
    return variance * N.inverse().topLeftCorner<6, 6>();
  }

private:
  Eigen::Matrix3d planeFromPixel(const vpHomogeneousMatrix &cMo) const
  {
    Eigen::Matrix3d K, H;
    K << m_focal, 0., 0.5 * (m_cols - 1), 0., m_focal, 0.5 * (m_rows - 1), 0., 0., 1.;
    for (int r = 0; r < 3; ++r) {
      H.row(r) << cMo[r][0], cMo[r][1], cMo[r][3];
    }
    return (K * H).inverse();
  }

  //! True if a point of the plane is on the target or at most \e more, m, beside it.
  bool contains(const Eigen::Vector3d &q, double more) const
  {
    return std::abs(q.x() / q.z()) < 0.5 * m_width + more && std::abs(q.y() / q.z()) < 0.5 * m_height + more;
  }

  double value(double x, double y, double background) const
  {
    if (std::abs(x) > 0.5 * m_width || std::abs(y) > 0.5 * m_height) {
      return background;
    }
    const int cols = static_cast<int>(m_photo.getWidth()), rows = static_cast<int>(m_photo.getHeight());
    const double u = (x / m_width + 0.5) * cols - 0.5, v = (y / m_height + 0.5) * rows - 0.5;
    const int iu = static_cast<int>(std::floor(u)), iv = static_cast<int>(std::floor(v));
    const std::array<double, 4> wu = cubic(u - iu), wv = cubic(v - iv);
    double sum = 0.;
    for (int r = 0; r < 4; ++r) {
      const unsigned char *const row = m_photo[std::clamp(iv + r - 1, 0, rows - 1)];
      double along = 0.;
      for (int c = 0; c < 4; ++c) {
        along += wu[static_cast<std::size_t>(c)] * row[std::clamp(iu + c - 1, 0, cols - 1)];
      }
      sum += wv[static_cast<std::size_t>(r)] * along;
    }
    return sum;
  }

  static std::array<double, 4> cubic(double t)
  {
    return {t * (-0.5 + t * (1. - 0.5 * t)), 1. + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2. - 1.5 * t)),
            t * t * (-0.5 + 0.5 * t)};
  }

  // Weights of the samples of one line that a pixel collects: its own width, blurred by the lens over four deviations.
  static std::vector<double> pixelKernel(double blur, int samples)
  {
    const int n = static_cast<int>(std::ceil(4. * blur)) * samples;
    std::vector<double> kernel;
    double total = 0.;
    for (int k = -n; k < samples + n; ++k) {
      const double x = (k + 0.5) / samples - 0.5; // of the sample from the middle of the pixel, px
      const double s = 1. / (std::max(blur, 1e-6) * std::sqrt(2.));
      kernel.push_back(std::erf(s * (x + 0.5)) - std::erf(s * (x - 0.5)));
      total += kernel.back();
    }
    for (double &weight : kernel) {
      weight /= total;
    }
    return kernel;
  }

  vpImage<unsigned char> m_photo;
  double m_width, m_height, m_focal;
  int m_cols, m_rows;
};

namespace vpPlanarPoseKit
{
using Image = vpImage<unsigned char>;

constexpr unsigned int cols = 640, rows = 480;

struct Photo {
  std::string name, file;
};

//! Rich, medium and poor in texture; those that are not installed are left out.
inline std::vector<Photo> photos()
{
  std::vector<Photo> all = {{"klimt", std::string(VISP_DIRECT_DATA_DIR) + "/target/klimt.jpg"},
                            {"home", std::string(VISP_DIRECT_OPENCV_SAMPLES) + "/home.jpg"},
                            {"cube", vpTestSupport::vispImage("mbt/cube/image0000.pgm")}};
  std::vector<Photo> there;
  for (const Photo &photo : all) {
    if (vpIoTools::checkFilename(photo.file)) {
      there.push_back(photo);
    }
    else {
      vpTestSupport::skip(photo.name + " is not installed (Debian packages opencv-doc, visp-images-data)");
    }
  }
  return there;
}

using vpTestSupport::uniform;

//! Within a quantile of the normal distribution that is exceeded once in 100,000 times.
constexpr double deviations = 4.26;
//! Mean of \e n chi-square variables of \e dof degrees of freedom, over dof: largest and least, by Wilson and Hilferty.
inline double mostChi2(double dof, double sign = 1.)
{
  const double a = 2. / (9. * dof);
  return std::pow(1. - a + sign * deviations * std::sqrt(a), 3);
}

//! A target of 0.18 m at about 0.5 m, tilted by up to 30 degrees, any direction.
inline vpHomogeneousMatrix randomPose(std::mt19937_64 &rng)
{
  const double azimuth = uniform(rng, -M_PI, M_PI), tilt = uniform(rng, 0., M_PI / 6.), roll = uniform(rng, -0.5, 0.5);
  vpPoseError turn = vpPoseError::Zero(), tilted = vpPoseError::Zero();
  turn(5) = roll;
  tilted << 0., 0., 0., tilt * std::cos(azimuth), tilt * std::sin(azimuth), 0.;
  vpHomogeneousMatrix cMo = vpMoved(vpMoved(vpHomogeneousMatrix(), turn), tilted);
  cMo[0][3] = uniform(rng, -0.04, 0.04);
  cMo[1][3] = uniform(rng, -0.03, 0.03);
  cMo[2][3] = uniform(rng, 0.45, 0.55);
  return cMo;
}

//! As a tracker knows it from the frame before: off by about a pixel at the corners.
inline vpHomogeneousMatrix guess(const vpHomogeneousMatrix &cMo, std::mt19937_64 &rng)
{
  vpPoseError e;
  for (int i = 0; i < 6; ++i) {
    e(i) = uniform(rng, -1., 1.) * (i < 2 ? 5e-4 : i == 2 ? 2e-3 : 4e-3);
  }
  return vpMoved(cMo, e);
}

inline vpErrorCovariance matrixOf(const vpPoseCovariance &covariance)
{
  vpErrorCovariance C;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      C(static_cast<int>(i), static_cast<int>(j)) = covariance(i, j);
    }
  }
  return C;
}

//! Squared error over its covariance.
inline double squares(const vpPoseError &e, const vpErrorCovariance &C) { return e.dot(C.ldlt().solve(e)); }
} // namespace vpPlanarPoseKit

#endif
