/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpSegmentKernel.h"

#include "vpSegmentNearest.h"

#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/Geometry>

#include <limits>

BEGIN_VISP_NAMESPACE

namespace
{
namespace kernel = vpSegmentKernel;
using V3 = kernel::V3<double>;

// True if no number is NaN or so large that squares or products of squares overflow.
template <class... Vectors> bool arePlausible(const Vectors &...vectors)
{
  constexpr double largest = 100. * vpLargestLength;
  return (... && (vectors.cwiseAbs().array() <= largest).all());
}

vpNearestPoints unknown()
{
  return {-std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
}

V3 in(const Eigen::Vector3d &v) { return {v.x(), v.y(), v.z()}; }

vpNearestPoints out(const kernel::Nearest<double> &n)
{
  return {n.distance, {n.a.x, n.a.y, n.a.z}, {n.b.x, n.b.y, n.b.z}};
}

void keepNearer(const vpNearestPoints &candidate, vpNearestPoints &best)
{
  if (candidate.distance < best.distance) {
    best = candidate;
  }
}

// Projection of p onto the triangle's plane, if it lies inside the triangle.
void offerFace(const Eigen::Vector3d &p, const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &c,
               const Eigen::Vector3d &n, vpNearestPoints &best)
{
  const double nn = n.squaredNorm();
  if (!(nn > 0.)) {
    return;
  }
  const Eigen::Vector3d foot = p - (p - a).dot(n) / nn * n;
  if ((b - a).cross(foot - a).dot(n) >= 0. && (c - b).cross(foot - b).dot(n) >= 0. &&
      (a - c).cross(foot - c).dot(n) >= 0.) {
    keepNearer({(p - foot).norm(), p, foot}, best);
  }
}
} // namespace

namespace vpSegmentNearest
{
vpNearestPoints point(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &other) noexcept
{
  return out(kernel::toPoint(in(from), in(to), in(other)));
}

vpNearestPoints segment(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &otherFrom,
                        const Eigen::Vector3d &otherTo) noexcept
{
  return out(kernel::toSegment(in(from), in(to), in(otherFrom), in(otherTo)));
}

vpNearestPoints box(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &half) noexcept
{
  return out(kernel::toBox(in(from), in(to), in(half)));
}

vpNearestPoints cylinder(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double radius, double half) noexcept
{
  return out(kernel::toCylinder(in(from), in(to), radius, half));
}

vpNearestPoints triangle(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &a,
                         const Eigen::Vector3d &b, const Eigen::Vector3d &c) noexcept
{
  vpNearestPoints best = segment(from, to, a, b);
  keepNearer(segment(from, to, b, c), best);
  keepNearer(segment(from, to, c, a), best);
  const Eigen::Vector3d n = (b - a).cross(c - a);
  offerFace(from, a, b, c, n, best);
  offerFace(to, a, b, c, n, best);
  const double before = (from - a).dot(n), after = (to - a).dot(n);
  if (before * after < 0.) {
    // The segment crosses the plane: the intersection is inside the triangle, or an edge is nearest.
    offerFace(from + before / (before - after) * (to - from), a, b, c, n, best);
  }
  return best;
}
} // namespace vpSegmentNearest

namespace vpSegmentDistance
{
vpNearestPoints point(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &other) noexcept
{
  return arePlausible(from, to, other) ? vpSegmentNearest::point(from, to, other) : unknown();
}

vpNearestPoints segment(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &otherFrom,
                        const Eigen::Vector3d &otherTo) noexcept
{
  return arePlausible(from, to, otherFrom, otherTo) ? vpSegmentNearest::segment(from, to, otherFrom, otherTo)
                                                    : unknown();
}

vpNearestPoints box(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &half) noexcept
{
  return arePlausible(from, to, half) ? vpSegmentNearest::box(from, to, half) : unknown();
}

vpNearestPoints cylinder(const Eigen::Vector3d &from, const Eigen::Vector3d &to, double radius, double half) noexcept
{
  return arePlausible(from, to, Eigen::Vector2d(radius, half)) ? vpSegmentNearest::cylinder(from, to, radius, half)
                                                               : unknown();
}

vpNearestPoints triangle(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Eigen::Vector3d &a,
                         const Eigen::Vector3d &b, const Eigen::Vector3d &c) noexcept
{
  return arePlausible(from, to, a, b, c) ? vpSegmentNearest::triangle(from, to, a, b, c) : unknown();
}
} // namespace vpSegmentDistance

END_VISP_NAMESPACE
