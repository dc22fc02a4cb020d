/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Depth images of known bodies become the right cubes, what goes away is cleared, and the arm does not see itself;
// unknown objects enter the scene, known ones do not.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpDepthObstacles.h>
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

struct Ball {
  Vector3d centre;
  double radius;
};

// Nearest intersection of each pixel's ray with the balls, and with the plane z = floor of the base if there is one.
vpImage<float> render(const std::vector<Ball> &balls, const vpRigidTransform &fMc, double floor = -1e9)
{
  vpImage<float> depth(120, 160, 0.F);
  for (unsigned int v = 0; v < depth.getHeight(); ++v) {
    for (unsigned int u = 0; u < depth.getWidth(); ++u) {
      double x = 0., y = 0.;
      vpPixelMeterConversion::convertPoint(camera, u, v, x, y);
      const Vector3d d = fMc.R * Vector3d(x, y, 1.);
      double best = d.z() < 0. ? (floor - fMc.p.z()) / d.z() : 1e9;
      for (const Ball &ball : balls) {
        const Vector3d o = fMc.p - ball.centre;
        const double b = o.dot(d), under = b * b - d.squaredNorm() * (o.squaredNorm() - ball.radius * ball.radius);
        const double t = under > 0. ? (-b - std::sqrt(under)) / d.squaredNorm() : -1.;
        best = t > 0. ? std::min(best, t) : best;
      }
      depth[v][u] = best < 5. ? static_cast<float>(best) : 0.F;
    }
  }
  return depth;
}

vpCollisionObject object(const char *name, const Ball &ball)
{
  vpCollisionObject result;
  result.name = name;
  result.shape = vpCollisionShape::sphere(ball.radius);
  result.pose.p = ball.centre;
  return result;
}

int cellsNear(const vpCollisionScene &scene, const Ball &ball, double within)
{
  const int i = scene.find("depth");
  int count = 0;
  if (i >= 0) {
    for (const vpOctreeCell &cell : scene.object(i).shape.octree().cells()) {
      count += std::fabs((cell.centre - ball.centre).norm() - ball.radius) < within ? 1 : 0;
    }
  }
  return count;
}

vpDepthObstaclesSpec everyPixel()
{
  vpDepthObstaclesSpec spec;
  spec.map.stride = 1;
  return spec;
}
} // namespace

TEST_CASE("What is seen is occupied, and nothing else", "[octomap][needs-OCTOMAP]")
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

TEST_CASE("What has gone is cleared by carving, and only by carving", "[octomap][needs-OCTOMAP]")
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

TEST_CASE("The arm in view is left out", "[octomap][needs-OCTOMAP]")
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

TEST_CASE("Images without use say so; files; bad parameters", "[octomap][needs-OCTOMAP]")
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
  CHECK_THROWS_WITH(vpDepthOctomap(spec), Catch::Contains("resolution of the depth octomap is 0 m, must be > 0"));
  spec = vpDepthOctomapSpec();
  spec.maxRange = 0.05;
  CHECK_THROWS_WITH(vpDepthOctomap(spec), Catch::Contains("maxRange of the depth octomap is 0.05"));
  spec = vpDepthOctomapSpec();
  spec.stride = 0;
  CHECK_THROWS_WITH(vpDepthOctomap(spec), Catch::Contains("stride of the depth octomap is 0, must be >= 1"));
  CHECK_THROWS_WITH(map.save("/nowhere/x.bt"), Catch::Contains("/nowhere/x.bt: cannot be written"));
}

TEST_CASE("What depth images show beside what is known becomes one object", "[depth][needs-OCTOMAP]")
{
  const Ball known{{0.15, 0.9, 0.4}, 0.12}, other{{-0.25, 0.8, 0.45}, 0.1};
  vpCollisionSceneSpec spec;
  spec.objects = {object("known", known)};
  vpCollisionScene scene(amor(), spec);
  vpCollisionData data;
  scene.place(vpJointVector::Zero(7), data);
  vpDepthObstacles depth(everyPixel());
  CHECK_FALSE(depth.applyTo(scene)); // nothing was seen yet
  const vpImage<float> image = render({known, other}, view());
  const vpDepthReport report = depth.insert(image, camera, view(), scene, data);
  CHECK(report.status == vpDepthStatus::Ok);
  CHECK(report.known > 300);
  CHECK(report.used > 300);
  CHECK(report.used + report.known + report.invalid + report.body + report.beyond == 120 * 160);
  CHECK(depth.applyTo(scene));
  REQUIRE(scene.find("depth") >= 0);
  CHECK(cellsNear(scene, other, 0.03) > 50);
  CHECK(cellsNear(scene, known, 0.03) == 0);
  CHECK(scene.find("known") >= 0);
  // The distance of a capsule from the map is that from the ball, but for the cubes' size.
  const vpClearance toMap = scene.pair(data, 3, scene.find("depth"));
  vpCollisionSceneSpec truth;
  truth.objects = {object("other", other)};
  const vpCollisionScene real(amor(), truth);
  CHECK(std::fabs(toMap.distance - real.pair(data, 3, 0).distance) < 0.06);

  // The same again changes nothing; own cubes are not known objects.
  static_cast<void>(depth.insert(image, camera, view(), scene, data));
  CHECK_FALSE(depth.applyTo(scene));
  CHECK(depth.insert(image, camera, view(), scene, data).known == report.known);
  depth.clear();
  CHECK(depth.applyTo(scene));
  CHECK(scene.find("depth") < 0);
}

TEST_CASE("A tracked object that moves leaves nothing behind; one that is elsewhere than thought is seen",
          "[depth][needs-OCTOMAP]")
{
  Ball ball{{-0.2, 0.9, 0.4}, 0.12};
  vpCollisionSceneSpec spec;
  spec.objects = {object("ball", ball)};
  vpCollisionScene scene(amor(), spec);
  vpCollisionData data;
  scene.place(vpJointVector::Zero(7), data);
  vpDepthObstacles depth(everyPixel());
  for (int k = 0; k < 10; ++k) {
    ball.centre.x() += 0.03;
    REQUIRE(scene.moveObject(0, {Eigen::Matrix3d::Identity(), ball.centre + Vector3d(0., 0.01, 0.)})); // nearly right
    static_cast<void>(depth.insert(render({ball}, view()), camera, view(), scene, data));
    depth.applyTo(scene);
    CHECK(scene.find("depth") < 0);
  }
  REQUIRE(scene.moveObject(0, {Eigen::Matrix3d::Identity(), ball.centre + Vector3d(0.5, 0., 0.)}));
  static_cast<void>(depth.insert(render({ball}, view()), camera, view(), scene, data));
  CHECK(depth.applyTo(scene));
  CHECK(cellsNear(scene, ball, 0.03) > 50);
}

TEST_CASE("The ground is known; a camera that is nowhere and names that are taken are refused",
          "[depth][needs-OCTOMAP]")
{
  vpCollisionSceneSpec spec;
  spec.ground = vpHalfSpace();
  vpCollisionScene scene(amor(), spec);
  vpCollisionData data;
  scene.place(vpJointVector::Zero(7), data);
  vpRigidTransform down = view();
  down.R = vpSO3::exp(Vector3d(-0.6, 0., 0.)) * down.R;
  const vpImage<float> image = render({}, down, 0.);
  vpDepthObstacles depth;
  const vpDepthReport report = depth.insert(image, camera, down, scene, data);
  CHECK(report.known > 300);
  CHECK(report.used == 0);
  CHECK_FALSE(depth.applyTo(scene));
  vpRigidTransform nowhere;
  nowhere.p.z() = std::nan("");
  CHECK(depth.insert(image, camera, nowhere, scene, data).status == vpDepthStatus::BadInput);

  scene.add(object("depth", {{1., 0., 0.}, 0.1}));
  CHECK_THROWS_WITH(depth.applyTo(scene),
                    Catch::Contains("the scene has an object depth that does not come from depth images"));
  vpDepthObstaclesSpec bad;
  bad.knownMargin = -1.;
  CHECK_THROWS_WITH(vpDepthObstacles(bad), Catch::Contains("knownMargin of the depth obstacles is -1 m, must be >= 0"));
  bad = vpDepthObstaclesSpec();
  bad.name.clear();
  CHECK_THROWS_WITH(vpDepthObstacles(bad), Catch::Contains("name of the depth obstacles is empty"));
  bad = vpDepthObstaclesSpec();
  bad.map.stride = 0;
  CHECK_THROWS_WITH(vpDepthObstacles(bad), Catch::Contains("stride of the depth octomap is 0"));
}
