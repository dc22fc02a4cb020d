/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Random images of dots on lattices of all kinds, with gaps, outliers, uneven light and perspective.
#ifndef vpDotScene_h
#define vpDotScene_h

#include <visp3/core/vpImage.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace vpPatternTest
{
enum class DotShape { Row, Rectangular, Hexagonal, Quincunx, Honeycomb, TwoShapes, Random };

struct DotKind {
  const char *name;
  DotShape shape;
  bool vignetting, levels, perspective;
  double missing, strangers; // shares
};

struct DotScene {
  vpImage<unsigned char> image;
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero(); // at the middle, px; b 0 for a row
  std::vector<Eigen::Vector2d> dots;                                        // all that belong to the lattice
};

inline double between(std::mt19937_64 &rng, double from, double to)
{
  return std::uniform_real_distribution<double>(from, to)(rng);
}

inline void addDisc(std::vector<double> &picture, int width, int height, const Eigen::Vector2d &at, double radius,
                    double amplitude)
{
  for (int v = std::max(0, int(at.y() - radius - 4)); v <= std::min(height - 1, int(at.y() + radius + 4)); ++v) {
    for (int u = std::max(0, int(at.x() - radius - 4)); u <= std::min(width - 1, int(at.x() + radius + 4)); ++u) {
      const double e = std::hypot(u - at.x(), v - at.y()) - radius;
      double &value = picture[static_cast<std::size_t>(v * width + u)];
      value = std::max(value, amplitude / (1. + std::exp(2. * e / 0.9)));
    }
  }
}

inline DotScene makeDots(const DotKind &kind, std::mt19937_64 &rng, int width = 320, int height = 240)
{
  const double p = between(rng, 22., 34.), phi = between(rng, 0., M_PI);
  Eigen::Vector2d a(p, 0.), b(0., p * between(rng, 0.8, 1.6));
  std::vector<Eigen::Vector2d> motif = {{0., 0.}};
  switch (kind.shape) {
  case DotShape::Row:
    b.setZero();
    break;
  case DotShape::Hexagonal:
    b << 0.5 * p, 0.5 * std::sqrt(3.) * p;
    break;
  case DotShape::Quincunx:
    a *= 1.35;
    b << 0.5 * a.x(), 0.675 * p * between(rng, 1.05, 1.5);
    break;
  case DotShape::Honeycomb: // two dots in a period
    a *= 1.8;
    b << 0.5 * a.x(), 0.5 * std::sqrt(3.) * a.x();
    motif.emplace_back((a + b) / 3.);
    break;
  case DotShape::TwoShapes: // the second smaller
    a *= 1.9;
    b << 0., 1.15 * p;
    motif.emplace_back(0.41 * a);
    break;
  case DotShape::Rectangular:
  case DotShape::Random:
    break;
  }
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(phi).toRotationMatrix();
  a = R * a;
  b = R * b;
  Eigen::Vector2d bend(0., 0.);
  if (kind.perspective) {
    bend = Eigen::Rotation2Dd(between(rng, -M_PI, M_PI)) * Eigen::Vector2d(between(rng, 0.1, 0.45) / width, 0.);
  }
  const Eigen::Vector2d middle(0.5 * width, 0.5 * height);
  const Eigen::Vector2d origin = middle + 0.5 * Eigen::Vector2d(between(rng, -p, p), between(rng, -p, p));
  const double radius = p * between(rng, 0.26, 0.34);
  const bool dark = between(rng, 0., 1.) < 0.5;
  std::vector<double> picture(static_cast<std::size_t>(width * height), 0.);
  DotScene scene;
  scene.a = a;
  scene.b = b;
  for (int i = -40; i <= 40 && kind.shape != DotShape::Random; ++i) {
    for (int j = b.norm() == 0. ? 0 : -40; j <= (b.norm() == 0. ? 0 : 40); ++j) {
      for (std::size_t m = 0; m < motif.size(); ++m) {
        const bool missing = between(rng, 0., 1.) < kind.missing;
        Eigen::Vector2d q = origin + i * a + j * b + R * motif[m] - middle;
        const double depth = 1. + bend.dot(q);
        if (missing || depth < 0.3) {
          continue;
        }
        q = middle + q / depth;
        if (q.x() > -20. && q.y() > -20. && q.x() < width + 20. && q.y() < height + 20.) {
          const bool small = kind.shape == DotShape::TwoShapes && m > 0;
          const bool faint = kind.levels && std::abs(i + 3 * j) % 2 == 1;
          addDisc(picture, width, height, q, radius / depth * (small ? 0.7 : 1.), faint ? 0.55 : 1.);
          scene.dots.push_back(q);
        }
      }
    }
  }
  const double cells = b.norm() == 0. ? 12. : width * height / (p * p);
  for (int i = 0; i < kind.strangers * cells; ++i) {
    const Eigen::Vector2d at(between(rng, 0., width), between(rng, 0., height));
    addDisc(picture, width, height, at, between(rng, 0.5, 1.) * radius, between(rng, 0.5, 1.));
  }
  std::normal_distribution<double> noise(0., 4.);
  const double cx = between(rng, 0.35, 0.65) * width, cy = between(rng, 0.35, 0.65) * height;
  scene.image.resize(static_cast<unsigned int>(height), static_cast<unsigned int>(width));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double l = picture[static_cast<std::size_t>(v * width + u)];
      double value = 55. + 120. * (dark ? 1. - l : l);
      if (kind.vignetting) {
        const double r2 = ((u - cx) * (u - cx) + (v - cy) * (v - cy)) / (0.25 * width * width);
        value *= std::max(0.18, 1. - 0.62 * r2);
      }
      scene.image[static_cast<unsigned int>(v)][static_cast<unsigned int>(u)] =
          static_cast<unsigned char>(std::clamp(value + noise(rng), 0., 255.));
    }
  }
  return scene;
}

// Whether two bases are of the same lattice, to a share of its steps.
inline bool sameLattice(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &trueA,
                        const Eigen::Vector2d &trueB)
{
  if (trueB.norm() == 0.) {
    return b.norm() == 0. && std::min((a - trueA).norm(), (a + trueA).norm()) < 0.06 * trueA.norm();
  }
  if (b.norm() == 0.) {
    return false;
  }
  Eigen::Matrix2d truth, found;
  truth << trueA, trueB;
  found << a, b;
  const Eigen::Matrix2d steps = truth.inverse() * found, whole = steps.array().round();
  return std::abs(std::abs(whole.determinant()) - 1.) < 1e-9 && (steps - whole).cwiseAbs().maxCoeff() < 0.12;
}
} // namespace vpPatternTest

#endif
