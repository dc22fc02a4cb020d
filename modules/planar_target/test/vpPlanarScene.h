/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPlanarScene.h
 * \brief For tests and benchmarks: photographs on planes, seen by a camera, with image degradations.
 *
 * A photograph of W x H pixels covers width x height metres from outer edge to outer edge: the centre of its pixel
 * (u,v) is at X = ((u + 0.5) / W - 0.5) width, likewise Y, in the plane z = 0. vpImageSimulator maps the given
 * corners to the centres of the corner pixels, so these are passed; the photograph's outer half pixel is not drawn.
 */
#ifndef vpPlanarScene_h
#define vpPlanarScene_h

#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpImageFilter.h>
#include <visp3/core/vpThetaUVector.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/robot/vpImageSimulator.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace vpPlanarScene
{
using Image = vpImage<unsigned char>;

//! A photograph of data/target by its file name.
inline Image photo(const std::string &file)
{
  Image I;
  vpImageIo::read(I, std::string(VISP_DIRECT_DATA_DIR) + "/target/" + file);
  return I;
}

inline vpCameraParameters camera() { return vpCameraParameters(800., 800., 319.5, 239.5); }

//! A photograph on the plane z = 0 of its object frame, centred at the origin, x right, y down.
struct Target {
  Image image;
  double width;
  double height;
};

inline Target klimt() { return {photo("klimt.jpg"), 0.2, 0.2 * 560. / 558.}; }

//! Smooth random grey values, so that the background gives keypoints too.
inline Image background(std::mt19937_64 &rng, unsigned int rows = 480, unsigned int cols = 640)
{
  const unsigned int cell = 16;
  std::uniform_int_distribution<int> grey(40, 200);
  vpImage<double> grid(rows / cell + 2, cols / cell + 2);
  for (unsigned int i = 0; i < grid.getSize(); ++i) {
    grid.bitmap[i] = grey(rng);
  }
  Image I(rows, cols);
  for (unsigned int i = 0; i < rows; ++i) {
    for (unsigned int j = 0; j < cols; ++j) {
      I[i][j] = static_cast<unsigned char>(
          std::lround(grid.getValue(static_cast<double>(i) / cell, static_cast<double>(j) / cell)));
    }
  }
  return I;
}

/*!
 * Draw a target over \e I. Rendered at \e supersample times the resolution and averaged: otherwise the nearest-texel
 * sampling of vpImageSimulator would alias and shift edges.
 */
inline void draw(Image &I, const Target &target, const vpCameraParameters &cam, const vpHomogeneousMatrix &cMo,
                 unsigned int supersample = 2)
{
  const double x = 0.5 * target.width * (1. - 1. / target.image.getWidth());
  const double y = 0.5 * target.height * (1. - 1. / target.image.getHeight());
  const double corner[4][2] = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
  vpColVector X[4];
  for (int i = 0; i < 4; ++i) {
    X[i].resize(3);
    X[i][0] = corner[i][0];
    X[i][1] = corner[i][1];
  }
  vpImageSimulator simulator(vpImageSimulator::GRAY_SCALED);
  simulator.setInterpolationType(vpImageSimulator::BILINEAR_INTERPOLATION);
  simulator.init(target.image, X);
  simulator.setCameraPosition(cMo);

  const unsigned int s = supersample;
  vpCameraParameters fine;
  const double shift = 0.5 * (s - 1.);
  if (cam.get_projModel() == vpCameraParameters::perspectiveProjWithDistortion) {
    fine.initPersProjWithDistortion(s * cam.get_px(), s * cam.get_py(), s * cam.get_u0() + shift,
                                    s * cam.get_v0() + shift, cam.get_kud(), cam.get_kdu());
  }
  else {
    fine.initPersProjWithoutDistortion(s * cam.get_px(), s * cam.get_py(), s * cam.get_u0() + shift,
                                       s * cam.get_v0() + shift);
  }
  Image large(s * I.getHeight(), s * I.getWidth());
  for (unsigned int i = 0; i < large.getHeight(); ++i) {
    for (unsigned int j = 0; j < large.getWidth(); ++j) {
      large[i][j] = I[i / s][j / s];
    }
  }
  simulator.getImage(large, fine);
  for (unsigned int i = 0; i < I.getHeight(); ++i) {
    for (unsigned int j = 0; j < I.getWidth(); ++j) {
      unsigned int sum = s * s / 2;
      for (unsigned int k = 0; k < s * s; ++k) {
        sum += large[s * i + k / s][s * j + k % s];
      }
      I[i][j] = static_cast<unsigned char>(sum / (s * s));
    }
  }
}

//! Blur (sigma in px), then gain, then Gaussian noise.
inline void spoil(Image &I, double blur, double gain, double noise, std::mt19937_64 &rng)
{
  vpImage<double> smooth;
  if (blur > 0.) {
    const unsigned int size = 2 * static_cast<unsigned int>(std::ceil(3. * blur)) + 1;
    vpImageFilter::gaussianBlur(I, smooth, size, blur, true);
  }
  std::normal_distribution<double> gauss(0., 1.);
  for (unsigned int i = 0; i < I.getSize(); ++i) {
    const double v = gain * (blur > 0. ? smooth.bitmap[i] : I.bitmap[i]) + (noise > 0. ? noise * gauss(rng) : 0.);
    I.bitmap[i] = static_cast<unsigned char>(std::clamp(std::lround(v), 0L, 255L));
  }
}

//! Occlude a rectangle of \e share of the target, at a random position, with a piece of another photograph.
inline void occlude(Image &target, const Image &occluder, double share, std::mt19937_64 &rng)
{
  std::uniform_real_distribution<double> uniform(0., 1.);
  const double aspect = std::sqrt(share) * std::exp(uniform(rng) - 0.5); // share of the width
  const double w = std::min(1., aspect), h = std::min(1., share / w);
  const unsigned int cols = static_cast<unsigned int>(w * target.getWidth()),
                     rows = static_cast<unsigned int>(h * target.getHeight());
  const unsigned int left = static_cast<unsigned int>(uniform(rng) * (target.getWidth() - cols));
  const unsigned int top = static_cast<unsigned int>(uniform(rng) * (target.getHeight() - rows));
  for (unsigned int i = 0; i < rows; ++i) {
    for (unsigned int j = 0; j < cols; ++j) {
      target[top + i][left + j] = occluder[i % occluder.getHeight()][j % occluder.getWidth()];
    }
  }
}

//! Pose from roll, pitch and yaw (rad, about the camera's z, x and y axes) and a position (m).
inline vpHomogeneousMatrix pose(double x, double y, double z, double roll, double pitch, double yaw)
{
  const vpHomogeneousMatrix Rx(0., 0., 0., pitch, 0., 0.), Ry(0., 0., 0., 0., yaw, 0.), Rz(0., 0., 0., 0., 0., roll);
  return vpHomogeneousMatrix(x, y, z, 0., 0., 0.) * Ry * Rx * Rz;
}

//! Random pose with every angle within +-\e angle (rad), the whole target in the view of camera().
inline vpHomogeneousMatrix randomPose(std::mt19937_64 &rng, double angle)
{
  std::uniform_real_distribution<double> u(-1., 1.);
  const double z = 0.52 + 0.07 * u(rng);
  return pose(0.04 * u(rng), 0.02 * u(rng), z, angle * u(rng), angle * u(rng), angle * u(rng));
}

//! Rotation error about the camera's x (pitch), y (yaw) and z (roll) axes, deg.
inline vpColVector rotationError(const vpHomogeneousMatrix &truth, const vpHomogeneousMatrix &found)
{
  const vpThetaUVector e(found.getRotationMatrix() * truth.getRotationMatrix().t());
  vpColVector d(3);
  for (unsigned int i = 0; i < 3; ++i) {
    d[i] = e[i] * 180. / M_PI;
  }
  return d;
}

//! Distance between two positions, m.
inline double positionError(const vpHomogeneousMatrix &truth, const vpHomogeneousMatrix &found)
{
  return std::sqrt((truth.getTranslationVector() - found.getTranslationVector()).sumSquare());
}
} // namespace vpPlanarScene

#endif
