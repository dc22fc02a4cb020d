/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Depth images of known bodies become the right cubes, what goes away is cleared, and the arm does not see itself.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpDepthOctomap.h>
#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>

#include <cstdio>
#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
const vpCameraParameters camera(150., 150., 80., 60.);

// Depth along z of bodies by ray marching: a body's distance is the safe step.
vpImage<float> render(const vpCollisionSceneSpec &bodies, const std::vector<vpPlacedCapsule> &capsules,
                      const vpRigidTransform &fMc)
{
  vpImage<float> depth(120, 160);
  for (unsigned int v = 0; v < depth.getHeight(); ++v) {
    for (unsigned int u = 0; u < depth.getWidth(); ++u) {
      double x = 0., y = 0.;
      vpPixelMeterConversion::convertPoint(camera, u, v, x, y);
      const Vector3d ray = (fMc.R * Vector3d(x, y, 1.)).normalized();
      double range = 0., step = 1.;
      while (step > 1e-5 && range < 5.) {
        const Vector3d p = fMc.p + range * ray;
        step = 5.;
        for (const vpCollisionObject &object : bodies.objects) {
          const vpRigidTransform oMf = object.pose.inverse();
          step = std::min(step, pointDistance(object.shape, oMf.R * p + oMf.p));
        }
        for (const vpPlacedCapsule &c : capsules) {
          step = std::min(step, vpSegmentDistance::point(c.from, c.to, p).distance - c.radius);
        }
        range += step;
      }
      depth[v][u] = range < 5. ? static_cast<float>(range / std::sqrt(x * x + y * y + 1.)) : 0.F;
    }
  }
  return depth;
}

vpCollisionSceneSpec twoBodies()
{
  vpCollisionSceneSpec spec;
  vpCollisionObject ball, block;
  ball.name = "ball";
  ball.shape = vpCollisionShape::sphere(0.12);
  ball.pose.p << 0.15, 0.9, 0.4;
  block.name = "block";
  block.shape = vpCollisionShape::box({0.2, 0.1, 0.3});
  block.pose.p << -0.2, 0.8, 0.35;
  block.pose.R = vpSO3::exp(Vector3d(0.1, 0.2, 0.4));
  spec.objects = {ball, block};
  return spec;
}

// Looks along y of the base.
vpRigidTransform view()
{
  vpRigidTransform fMc;
  fMc.R.col(0) = Vector3d::UnitX();
  fMc.R.col(1) = -Vector3d::UnitZ();
  fMc.R.col(2) = Vector3d::UnitY();
  fMc.p << 0., -0.2, 0.4;
  return fMc;
}
} // namespace

TEST_CASE("What is seen is occupied, and nothing else", "[octomap]")
{
  const vpCollisionSceneSpec bodies = twoBodies();
  const vpImage<float> depth = render(bodies, {}, view());
  for (const bool carve : {true, false}) {
    vpDepthOctomapSpec spec;
    spec.resolution = 0.02;
    spec.carve = carve;
    vpDepthOctomap map(spec);
    const vpDepthReport report = map.insert(depth, camera, view());
    CHECK(report.status == vpDepthStatus::Ok);
    CHECK(report.used > 1000);
    CHECK(report.used + report.invalid == 120 * 160);
    const vpOctree seen = map.snapshot();
    REQUIRE(seen.cells().size() > 100);
    // Every cube touches a body, so it is within half its diagonal of a surface.
    for (const vpOctreeCell &cell : seen.cells()) {
      double nearest = 1e9;
      for (const vpCollisionObject &object : bodies.objects) {
        const vpRigidTransform oMf = object.pose.inverse();
        nearest = std::min(nearest, pointDistance(object.shape, oMf.R * cell.centre + oMf.p));
      }
      CHECK(nearest <= 0.5 * std::sqrt(3.) * cell.size + 1e-4);
    }
    // Every point that was seen is within a cube's diagonal of one.
    int far = 0, points = 0;
    for (unsigned int v = 0; v < depth.getHeight(); v += 3) {
      for (unsigned int u = 0; u < depth.getWidth(); u += 3) {
        if (depth[v][u] > 0.F) {
          double x = 0., y = 0., nearest = 1e9;
          vpPixelMeterConversion::convertPoint(camera, u, v, x, y);
          const vpRigidTransform fMc = view();
          const Vector3d p = fMc.R * (static_cast<double>(depth[v][u]) * Vector3d(x, y, 1.)) + fMc.p;
          for (const vpOctreeCell &cell : seen.cells()) {
            const Vector3d out = ((p - cell.centre).cwiseAbs() - Vector3d::Constant(0.5 * cell.size)).cwiseMax(0.);
            nearest = std::min(nearest, out.norm());
          }
          ++points;
          far += nearest > 1e-3 ? 1 : 0;
        }
      }
    }
    CHECK(points > 100);
    CHECK(far == 0);
  }
}

TEST_CASE("What has gone is cleared by carving, and only by carving", "[octomap]")
{
  vpCollisionSceneSpec bodies = twoBodies();
  const vpImage<float> before = render(bodies, {}, view());
  // The ball moves back along the line of sight: rays through its old place end on its new one.
  bodies.objects[0].pose.p = view().p + 1.5 * (bodies.objects[0].pose.p - view().p);
  const vpImage<float> after = render(bodies, {}, view());
  std::size_t left[2] = {};
  for (const bool carve : {true, false}) {
    vpDepthOctomapSpec spec;
    spec.carve = carve;
    vpDepthOctomap map(spec);
    static_cast<void>(map.insert(before, camera, view()));
    for (int k = 0; k < 6; ++k) {
      static_cast<void>(map.insert(after, camera, view()));
    }
    for (const vpOctreeCell &cell : map.snapshot().cells()) {
      // In the middle of the ball's old face.
      left[carve ? 1 : 0] += (cell.centre - Vector3d(0.15, 0.78, 0.4)).norm() < 0.05 ? 1 : 0;
    }
  }
  CHECK(left[1] == 0);
  CHECK(left[0] > 5);
}

TEST_CASE("The arm in view is left out", "[octomap]")
{
  vpCollisionSceneSpec bodies = twoBodies();
  const vpCollisionScene scene(amor(), bodies);
  vpCollisionData data;
  vpJointVector q(7);
  q << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
  scene.place(q, data);
  std::vector<vpPlacedCapsule> capsules;
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    capsules.push_back(placed(amor(), data.arm, i));
  }
  const vpRigidTransform fMc = [] {
    vpRigidTransform T = view();
    T.p.y() = -0.6;
    return T;
  }();
  const vpImage<float> depth = render(bodies, capsules, fMc);
  vpDepthOctomap with, without;
  const vpDepthReport all = with.insert(depth, camera, fMc);
  const vpDepthReport some = without.insert(depth, camera, fMc, scene, data);
  CHECK(all.body == 0);
  CHECK(some.body > 300);
  CHECK(some.used + some.body == all.used);
  vpCollisionObject map;
  map.name = "map";
  for (const vpDepthOctomap *octomap : {&with, &without}) {
    map.shape = vpCollisionShape::octree(octomap->snapshot());
    vpCollisionSceneSpec spec;
    spec.objects = {map};
    vpCollisionData now;
    const vpCollisionScene seen(amor(), spec);
    seen.place(q, now);
    CHECK(seen.inCollision(now) == (octomap == &with));
  }
}

TEST_CASE("Images without use say so; files; bad parameters", "[octomap]")
{
  vpDepthOctomap map;
  vpImage<float> depth;
  CHECK(map.insert(depth, camera, view()).status == vpDepthStatus::NoPoint);
  depth.resize(120, 160, 0.F);
  depth[3][4] = std::numeric_limits<float>::quiet_NaN();
  depth[3][5] = std::numeric_limits<float>::infinity();
  depth[3][6] = -1.F;
  depth[3][7] = 0.05F;
  const vpDepthReport nothing = map.insert(depth, camera, view());
  CHECK(nothing.status == vpDepthStatus::NoPoint);
  CHECK(nothing.invalid == 120 * 160);
  CHECK(std::string(nothing.message()) == "the depth image has no depth in range that is not the arm");
  depth = 10.F;
  CHECK(map.insert(depth, camera, view()).beyond == 120 * 160);
  CHECK(map.snapshot().cells().empty());
  vpRigidTransform nowhere;
  nowhere.p.x() = std::nan("");
  CHECK(map.insert(depth, camera, nowhere).status == vpDepthStatus::BadInput);
  depth = 1.F;
  CHECK(map.insert(depth, camera, view()).status == vpDepthStatus::Ok);
  map.save("catchDepthOctomap.bt");
  const vpOctree read = vpOctree::load("catchDepthOctomap.bt");
  double volume = 0., saved = 0.;
  for (const vpOctreeCell &cell : map.snapshot().cells()) {
    volume += std::pow(cell.size, 3);
  }
  for (const vpOctreeCell &cell : read.cells()) {
    saved += std::pow(cell.size, 3);
  }
  CHECK(volume > 0.);
  CHECK(saved == Approx(volume).epsilon(0.01)); // octomap's own rounding to free and occupied.
  std::remove("catchDepthOctomap.bt");
  map.clear();
  CHECK(map.snapshot().cells().empty());
  vpDepthOctomapSpec spec;
  spec.resolution = 0.;
  CHECK_THROWS_WITH(vpDepthOctomap(spec), Catch::Contains("resolution of the depth octomap is 0, must be > 0 m"));
  spec = vpDepthOctomapSpec();
  spec.maxRange = 0.05;
  CHECK_THROWS_WITH(vpDepthOctomap(spec), Catch::Contains("maxRange of the depth octomap is 0.05"));
  spec = vpDepthOctomapSpec();
  spec.stride = 0;
  CHECK_THROWS_WITH(vpDepthOctomap(spec), Catch::Contains("stride of the depth octomap is 0, must be >= 1"));
  CHECK_THROWS_WITH(map.save("/nowhere/x.bt"), Catch::Contains("/nowhere/x.bt: cannot be written"));
}
