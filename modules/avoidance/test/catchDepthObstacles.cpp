/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Depth images of spheres, computed in closed form: unknown objects enter the scene, known ones do not.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpDepthObstacles.h>
#include <visp3/core/vpException.h>
#include <visp3/core/vpPixelMeterConversion.h>

using namespace vpAvoidanceTestKit;

namespace
{
const vpCameraParameters camera(150., 150., 80., 60.);

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

TEST_CASE("What depth images show beside what is known becomes one object", "[depth]")
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

TEST_CASE("A tracked object that moves leaves nothing behind; one that is elsewhere than thought is seen", "[depth]")
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

TEST_CASE("The ground is known; a camera that is nowhere and names that are taken are refused", "[depth]")
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
  CHECK_THROWS_WITH(vpDepthObstacles(bad), Catch::Contains("knownMargin of the depth obstacles is -1, must be >= 0 m"));
  bad = vpDepthObstaclesSpec();
  bad.name.clear();
  CHECK_THROWS_WITH(vpDepthObstacles(bad), Catch::Contains("name of the depth obstacles is empty"));
  bad = vpDepthObstaclesSpec();
  bad.map.stride = 0;
  CHECK_THROWS_WITH(vpDepthObstacles(bad), Catch::Contains("stride of the depth octomap is 0"));
}
