/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What the tests of planar poses share: photographs, random views, chi-square intervals.
#ifndef vpPlanarPoseKit_h
#define vpPlanarPoseKit_h

#include "vpCatch.h"
#include "vpFineRenderer.h"

#include <visp3/core/vpIoTools.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/planar_target/vpPlanarTarget.h>
#include <visp3/rendering/vpPlaneRenderer.h>

#include <cstdlib>
#include <string>

namespace vpPlanarPoseKit
{
using Image = vpImage<unsigned char>;

constexpr unsigned int cols = 640, rows = 480;

//! Number of random views: \e few in ctest; VISP_DIRECT_LONG_TESTS=50 makes them 50 times as many.
inline int views(int few)
{
  const char *factor = std::getenv("VISP_DIRECT_LONG_TESTS");
  return few * std::max(1, factor == nullptr ? 1 : std::atoi(factor));
}

struct Photo {
  std::string name, file;
};

//! Rich, medium and poor in texture; those that are not installed are left out.
inline std::vector<Photo> photos()
{
  std::vector<Photo> all = {{"klimt", std::string(VISP_DIRECT_DATA_DIR) + "/target/klimt.jpg"},
                            {"home", std::string(VISP_DIRECT_OPENCV_SAMPLES) + "/home.jpg"},
                            {"cube", vpIoTools::getViSPImagesDataPath() + "/mbt/cube/image0000.pgm"}};
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

inline double uniform(std::mt19937_64 &rng, double from, double to)
{
  return std::uniform_real_distribution<double>(from, to)(rng);
}

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
