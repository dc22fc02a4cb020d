/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRayCast.h
 * \brief Intersections of a ray with a body; all in the body's frame.
 */
#ifndef vpRayCast_h
#define vpRayCast_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

BEGIN_VISP_NAMESPACE

/*!
 * Each body has hit(): the first intersection of the ray from + t along, t > 0, where it enters the body. It gives t,
 * infinity for none, and the normal there (of any length and sign).
 */
namespace vpRayCast
{
using Eigen::Vector3d;
constexpr double none = std::numeric_limits<double>::infinity();

//! Lower root of a t^2 + 2 b t + c; infinity if there is none above 0.
inline double enter(double a, double b, double c)
{
  const double under = b * b - a * c;
  if (!(under > 0.) || !(a > 0.)) {
    return none;
  }
  const double t = (-b - std::sqrt(under)) / a;
  return t > 0. ? t : none;
}

struct Sphere {
  double radius;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    const double t = enter(along.squaredNorm(), from.dot(along), from.squaredNorm() - radius * radius);
    normal = from + t * along;
    return t;
  }
};

//! Along z, centred; with round or flat ends.
struct Tube {
  double radius, half;
  bool isRound;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    const double a = along.head<2>().squaredNorm(), b = from.head<2>().dot(along.head<2>());
    const double side = enter(a, b, from.head<2>().squaredNorm() - radius * radius);
    double best = none;
    if (side < none && std::fabs(from.z() + side * along.z()) <= half) {
      best = side;
      normal = Vector3d(from.x() + side * along.x(), from.y() + side * along.y(), 0.);
    }
    for (const double sign : {-1., 1.}) {
      const Vector3d end(0., 0., sign * half);
      Vector3d n = end;
      const double t = isRound ? Sphere{radius}.hit(from - end, along, n) : lid(from, along, sign);
      if (t < best) {
        best = t;
        normal = n;
      }
    }
    // From inside an end sphere or the tube there is no entry.
    return best;
  }

private:
  [[nodiscard]] double lid(const Vector3d &from, const Vector3d &along, double sign) const
  {
    const double t = (sign * half - from.z()) / along.z();
    const bool isEntry = sign * along.z() < 0. && t > 0.;
    return isEntry && (from + t * along).head<2>().squaredNorm() <= radius * radius ? t : none;
  }
};

struct Box {
  Vector3d half;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    // A ray along a face gets an irrelevant slope instead of a division by 0.
    const auto slope = [](double d) { return 1. / (d == 0. ? 1e-300 : d); };
    const Vector3d inverse(slope(along.x()), slope(along.y()), slope(along.z()));
    const Vector3d middle = -from.cwiseProduct(inverse), reach = half.cwiseProduct(inverse).cwiseAbs();
    const Vector3d first = middle - reach, last = middle + reach;
    const double in = std::max({first.x(), first.y(), first.z()}), out = std::min({last.x(), last.y(), last.z()});
    if (!(in > 0.) || in > out) {
      return none;
    }
    normal = Vector3d(first.x() == in ? 1. : 0., first.y() == in ? 1. : 0., first.z() == in ? 1. : 0.);
    return in;
  }
};

//! Visible from both sides.
struct Triangle {
  Vector3d a, b, c;
  [[nodiscard]] double hit(const Vector3d &from, const Vector3d &along, Vector3d &normal) const
  {
    // Side of each edge on which the ray passes.
    const Vector3d p = a - from, q = b - from, r = c - from;
    const double ab = along.dot(p.cross(q)), bc = along.dot(q.cross(r)), ca = along.dot(r.cross(p));
    if (!((ab >= 0. && bc >= 0. && ca >= 0.) || (ab <= 0. && bc <= 0. && ca <= 0.))) {
      return none;
    }
    normal = (b - a).cross(c - a);
    const double t = normal.dot(p) / normal.dot(along);
    return t > 0. ? t : none; // false for NaN: the ray lies in the triangle's plane
  }
};
} // namespace vpRayCast

END_VISP_NAMESPACE
#endif
