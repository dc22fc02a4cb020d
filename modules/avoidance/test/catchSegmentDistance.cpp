/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Segment distances of the fast path against searches that use only point distances.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/avoidance/vpSegmentDistance.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
struct Segment {
  Vector3d from, to;
};

// Anywhere, short, a point, along an axis, through the middle.
Segment segment(std::mt19937_64 &rng, int kind)
{
  Segment s{point(rng, 0.5), point(rng, 0.5)};
  switch (kind % 6) {
  case 1:
    s.to = s.from + point(rng, 1e-3);
    break;
  case 2:
    s.to = s.from;
    break;
  case 3:
    s.to = s.from + uniform(rng, -0.5, 0.5) * Vector3d::Unit(kind / 6 % 3);
    break;
  case 4:
    s.to = -s.from + point(rng, 0.1);
    break;
  default:
    break;
  }
  return s;
}

void checkPoints(const vpNearestPoints &near, const Segment &s)
{
  CHECK((near.onSegment - near.onOther).norm() == Approx(near.distance).margin(1e-12));
  CHECK(segmentDistance(s.from, s.to, near.onSegment, near.onSegment) < 1e-8);
}

double checkSolid(const vpCollisionShape &shape, const Segment &s, const vpNearestPoints &near)
{
  checkPoints(near, s);
  CHECK(pointDistance(shape, near.onOther) < 1e-12);
  return std::fabs(near.distance - segmentDistance(shape, s.from, s.to));
}
} // namespace

TEST_CASE("Segments and points, segments, boxes, cylinders", "[kernel]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  double worst[4] = {};
  for (int k = 0; k < 10000; ++k) {
    CAPTURE(k);
    const Segment s = segment(rng, k);
    const Vector3d p = point(rng, 0.5);
    const vpNearestPoints toPoint = vpSegmentDistance::point(s.from, s.to, p);
    checkPoints(toPoint, s);
    worst[0] = std::max(worst[0], std::fabs(toPoint.distance - segmentDistance(s.from, s.to, p, p)));

    const Segment other = segment(rng, k / 6);
    const vpNearestPoints toSegment = vpSegmentDistance::segment(s.from, s.to, other.from, other.to);
    checkPoints(toSegment, s);
    worst[1] = std::max(worst[1], std::fabs(toSegment.distance - segmentDistance(s.from, s.to, other.from, other.to)));

    const Vector3d size = point(rng, 0.4).cwiseAbs() + Vector3d::Constant(1e-4);
    worst[2] = std::max(worst[2],
                        checkSolid(vpCollisionShape::box(size), s, vpSegmentDistance::box(s.from, s.to, 0.5 * size)));
    worst[3] = std::max(worst[3], checkSolid(vpCollisionShape::cylinder(size.x(), size.y()), s,
                                             vpSegmentDistance::cylinder(s.from, s.to, size.x(), 0.5 * size.y())));
  }
  std::cout << "largest difference from the search, m: point " << worst[0] << ", segment " << worst[1] << ", box "
            << worst[2] << ", cylinder " << worst[3] << std::endl;
  for (const double error : worst) {
    CHECK(error < 1e-9);
  }
}

TEST_CASE("Nearly parallel segments keep their accuracy", "[kernel]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  double worst = 0.;
  for (int k = 0; k < 2000; ++k) {
    const Segment a = segment(rng, 0);
    const double angle = std::pow(10., uniform(rng, -12., -2.));
    const Vector3d shift = uniform(rng, 0., 0.2) * (a.to - a.from).cross(point(rng, 1.)).normalized();
    const Vector3d middle = 0.5 * (a.from + a.to) + shift, d = a.to - a.from;
    const Vector3d turned = d + angle * d.cross(point(rng, 1.));
    const double distance = vpSegmentDistance::segment(a.from, a.to, middle - turned, middle + turned).distance;
    worst = std::max(worst, std::fabs(distance - segmentDistance(a.from, a.to, middle - turned, middle + turned)));
  }
  CHECK(worst < 1e-9);
}

TEST_CASE("Triangles, by a search over all of their points", "[kernel]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  double worst = 0.;
  int through = 0;
  for (int k = 0; k < 1000; ++k) {
    const Segment s = segment(rng, k % 10 == 0 ? 4 : k % 4);
    const Vector3d a = point(rng, 0.4), b = point(rng, 0.4), c = k % 50 == 7 ? a + 0.3 * (b - a) : point(rng, 0.4);
    const vpNearestPoints near = vpSegmentDistance::triangle(s.from, s.to, a, b, c);
    checkPoints(near, s);
    through += near.distance < 1e-12 ? 1 : 0;
    // Coarse to fine over the two coordinates of the triangle: the distance from the segment is convex there.
    const double search = least([&](double u) {
      return least([&](double v) {
        const Vector3d p = a + u * ((1. - v) * (b - a) + v * (c - a));
        return vpSegmentDistance::point(s.from, s.to, p).distance;
      });
    });
    worst = std::max(worst, std::fabs(near.distance - search));
  }
  CHECK(through > 20);
  CHECK(worst < 1e-9);
  std::cout << "triangles: largest difference from the search " << worst << " m, " << through << " pierced\n";
}

// The rotation from z to the axis of a capsule that points nearly along -z is hard to compute.
TEST_CASE("capsules along -z stand where they are, to the last digits", "[fcl][needs-FCL]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 400; ++k) {
    const double tilt = k == 0 ? 0. : std::pow(10., uniform(rng, -9., -2.));
    const double azimuth = uniform(rng, -pi, pi);
    vpArmSpec spec;
    spec.name = "post";
    spec.joints.push_back(vpArmJointSpec::standardDH(0., 0., 0., 0.));
    spec.joints[0].name = "j";
    spec.joints[0].lower = -1.;
    spec.joints[0].upper = 1.;
    const Vector3d from(0., 0., 1.), to(tilt * std::cos(azimuth), tilt * std::sin(azimuth), 0.);
    spec.capsules = {{1, from, to, 0.05}};
    const vpArmModel arm(spec);

    vpCollisionObject ball;
    ball.name = "ball";
    ball.shape = vpCollisionShape::sphere(0.03);
    ball.pose.p = from + uniform(rng, 0., 1.) * (to - from) + Vector3d(0.2, uniform(rng, -0.1, 0.1), 0.);
    vpCollisionSceneSpec around;
    around.objects = {ball};
    const vpCollisionScene scene(arm, around);

    // Distance of a point from a segment.
    const Vector3d axis = to - from;
    const double share = std::clamp((ball.pose.p - from).dot(axis) / axis.squaredNorm(), 0., 1.);
    const double truth = (ball.pose.p - from - share * axis).norm() - 0.08;
    vpJointVector q(1);
    q(0) = 0.;
    CAPTURE(k, tilt, azimuth, truth);
    REQUIRE(std::abs(vpFclChecker(scene).clearance(q, 10.).distance - truth) < 1e-12);
  }
}
