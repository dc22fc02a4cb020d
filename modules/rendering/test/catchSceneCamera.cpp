/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Images and depths of scenes against ray marching by distances, and against the renderer of a single photograph.
#include "vpCatch.h"
#include "vpTestArms.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/rendering/vpSceneCamera.h>

#include <Eigen/Geometry>

using namespace vpTestArms;
using Eigen::Vector3d;

namespace
{
vpCameraParameters someCamera() { return vpCameraParameters(300., 310., 161., 118.); }

vpSceneCameraSpec small()
{
  vpSceneCameraSpec spec;
  spec.camera = someCamera();
  spec.width = 320;
  spec.height = 240;
  return spec;
}

Vector3d point(std::mt19937_64 &rng, double size)
{
  return {uniform(rng, -size, size), uniform(rng, -size, size), uniform(rng, -size, size)};
}

vpCollisionObject object(const std::string &name, const vpCollisionShape &shape, const vpRigidTransform &pose)
{
  vpCollisionObject result;
  result.name = name;
  result.shape = shape;
  result.pose = pose;
  return result;
}

vpTriangleMesh tetrahedron(double s)
{
  return vpTriangleMesh({{s, s, s}, {-s, -s, s}, {-s, s, -s}, {s, -s, -s}},
                        {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

//! Distance of a point from a body's surface from outside, 0 inside: from the bodies' definitions.
double outside(const vpCollisionShape &shape, const Vector3d &p)
{
  const auto positive = [](double v) { return std::max(v, 0.); };
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return positive(p.norm() - shape.radius());
  case vpShapeType::Capsule:
    return positive(std::hypot(p.head<2>().norm(), positive(std::fabs(p.z()) - 0.5 * shape.length())) - shape.radius());
  case vpShapeType::Box:
    return (p.cwiseAbs() - 0.5 * shape.size()).cwiseMax(0.).norm();
  case vpShapeType::Cylinder:
    return std::hypot(positive(p.head<2>().norm() - shape.radius()), positive(std::fabs(p.z()) - 0.5 * shape.length()));
  case vpShapeType::Octree: {
    double least = 1e9;
    for (const vpOctreeCell &cell : shape.octree().cells()) {
      least = std::min(least, ((p - cell.centre).cwiseAbs().array() - 0.5 * cell.size).max(0.).matrix().norm());
    }
    return least;
  }
  default: {
    // A convex mesh: the farthest of its faces' planes bounds the distance from below, and says when a point is inside.
    double farthest = 0.;
    for (const std::array<int, 3> &t : shape.mesh().triangles()) {
      const auto vertex = [&](int k) {
        return shape.mesh().vertices()[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
      };
      const Vector3d n = (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0)).normalized();
      farthest = std::max(farthest, n.dot(p - vertex(0)));
    }
    return farthest;
  }
  }
}

//! Depth of the first hit of a ray by marching: the least distance is a safe step.
double march(const vpCollisionScene &scene, const vpRigidTransform &fMc, double u, double v, double far)
{
  const Vector3d d = Vector3d((u - someCamera().get_u0()) / someCamera().get_px(),
                              (v - someCamera().get_v0()) / someCamera().get_py(), 1.);
  const Vector3d along = fMc.R * d.normalized();
  double t = 0.;
  for (int k = 0; k < 2000 && t < far; ++k) {
    double step = far;
    for (int i = 0; i < scene.objectCount(); ++i) {
      const vpRigidTransform oMf = scene.object(i).pose.inverse();
      step = std::min(step, outside(scene.object(i).shape, oMf.R * (fMc.p + t * along) + oMf.p));
    }
    if (scene.ground()) {
      step = std::min(step, scene.ground()->normal.dot(fMc.p + t * along) - scene.ground()->offset);
    }
    if (step < 1e-7) {
      return t / d.norm();
    }
    t += step;
  }
  return 0.;
}

template <class Pixel> bool same(const vpImage<Pixel> &a, vpImage<Pixel> b) { return b == a; } // == is not const

vpCollisionShape shapeOf(int kind, std::mt19937_64 &rng)
{
  const double r = uniform(rng, 0.04, 0.15), l = uniform(rng, 0.05, 0.4);
  switch (kind % 6) {
  case 0:
    return vpCollisionShape::sphere(r);
  case 1:
    return vpCollisionShape::capsule(r, l);
  case 2:
    return vpCollisionShape::box({r, l, uniform(rng, 0.02, 0.4)});
  case 3:
    return vpCollisionShape::cylinder(r, l);
  case 4:
    return vpCollisionShape::mesh(tetrahedron(r));
  default:
    return vpCollisionShape::octree(
        vpOctree({{{0., 0., 0.}, r}, {{r, 0., 0.2 * r}, 0.7 * r}, {{0., -r, 0.}, 0.5 * r}}));
  }
}

vpImage<unsigned char> photo(const char *name)
{
  vpImage<unsigned char> image;
  vpImageIo::read(image, std::string(VISP_DIRECT_DATA_DIR) + "/target/" + name);
  return image;
}

//! A box whose front shows klimt, in front of the camera.
struct Fronted {
  vpSceneCameraSpec spec = small();
  vpCollisionObject box;
  vpRigidTransform cMface;

  explicit Fronted(std::mt19937_64 &rng)
  {
    spec.photos = {{"picture", photo("klimt.jpg"), {0.16, 0.16}}};
    cMface = {vpSO3::exp(Vector3d(uniform(rng, -0.6, 0.6), uniform(rng, -0.6, 0.6), uniform(rng, -1., 1.))),
              Vector3d(uniform(rng, -0.05, 0.05), uniform(rng, -0.05, 0.05), 0.5)};
    box = object("picture", vpCollisionShape::box({0.16, 0.16, 0.06}),
                 cMface * vpRigidTransform{Eigen::Matrix3d::Identity(), Vector3d(0., 0., 0.03)});
  }
};
} // namespace

TEST_CASE("Depths are those of rays that know distances only, for all shapes and from anywhere", "[scene]")
{
  auto rng = vpTestSupport::generator(731);
  CAPTURE(vpTestSupport::seed());
  vpSceneCamera camera(small());
  int seen = 0, empty = 0;
  for (int problem = 0; problem < 12; ++problem) {
    const vpRigidTransform fMc{vpSO3::exp(3. * point(rng, 1.)), point(rng, 1.)};
    vpCollisionSceneSpec spec;
    for (int j = 0; j < 8; ++j) {
      // In view, at the edge of it, and some behind the camera.
      const vpRigidTransform cMo{vpSO3::exp(3. * point(rng, 1.)),
                                 Vector3d(uniform(rng, -0.6, 0.6), uniform(rng, -0.5, 0.5), uniform(rng, -0.3, 1.5))};
      if (cMo.p.norm() > 0.5) {
        spec.objects.push_back(object("o" + std::to_string(j), shapeOf(j + problem, rng), fMc * cMo));
      }
    }
    if (problem % 3 == 0) {
      spec.ground = vpHalfSpace();
      spec.ground->offset = fMc.p.z() - 0.8;
    }
    const vpCollisionScene scene(amor(), spec);
    vpImage<float> depth;
    camera.depth(scene, fMc, {}, 1, depth);
    REQUIRE(depth.getWidth() == 320);
    int wrong = 0;
    for (unsigned int v = 0; v < 240; v += 7) {
      for (unsigned int u = 0; u < 320; u += 7) {
        const double truth = march(scene, fMc, u, v, 20.);
        const double found = depth[v][u];
        // Beyond the range of the camera there is nothing; rays that graze an edge may go either way.
        const bool isSame = std::fabs(found - (truth <= 4. ? truth : 0.)) < 1e-4;
        wrong += isSame ? 0 : 1;
        seen += found > 0. ? 1 : 0;
        empty += found > 0. ? 0 : 1;
      }
    }
    CAPTURE(problem);
    CHECK(wrong <= 1);
  }
  CHECK(seen > 1000);
  CHECK(empty > 1000);
}

TEST_CASE("A photograph on a box is drawn as on its own", "[scene]")
{
  auto rng = vpTestSupport::generator(732);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 5; ++problem) {
    Fronted fronted(rng);
    vpSceneCamera camera(fronted.spec);
    vpPlaneRenderer peer(fronted.spec.photos[0].image, 0.16, 0.16, someCamera(), 320, 240);
    vpCollisionSceneSpec spec;
    spec.objects = {fronted.box};
    vpImage<unsigned char> picture, alone;
    camera.picture(vpCollisionScene(amor(), spec), vpRigidTransform(), {}, 1, picture);
    peer.render(fronted.cMface.toHomogeneous(), {}, 1, alone);
    vpImage<float> depth;
    camera.depth(vpCollisionScene(amor(), spec), vpRigidTransform(), {}, 1, depth);
    int same = 0, face = 0, beside = 0;
    for (unsigned int v = 0; v < 240; ++v) {
      for (unsigned int u = 0; u < 320; ++u) {
        const Vector3d d((u - someCamera().get_u0()) / someCamera().get_px(),
                         (v - someCamera().get_v0()) / someCamera().get_py(), 1.);
        const Vector3d n = fronted.cMface.R.col(2);
        const Vector3d p = fronted.cMface.inverse().R * (n.dot(fronted.cMface.p) / n.dot(d) * d - fronted.cMface.p);
        if (p.cwiseAbs().head<2>().maxCoeff() < 0.077) { // on the face, away from its edge
          ++face;
          same += picture[v][u] == alone[v][u] ? 1 : 0;
          CHECK(static_cast<double>(depth[v][u]) == Approx(n.dot(fronted.cMface.p) / n.dot(d)).margin(1e-5));
        }
        else if (!(depth[v][u] > 0.F)) {
          beside += std::abs(picture[v][u] - alone[v][u]) > 60 ? 1 : 0;
        }
      }
    }
    CAPTURE(problem);
    CHECK(face > 3000);
    CHECK(same == face);
    CHECK(beside < 20); // pixels that the edge of the face cuts
  }
}

TEST_CASE("What is in front hides a photograph, what is behind does not", "[scene]")
{
  auto rng = vpTestSupport::generator(733);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 5; ++problem) {
    Fronted fronted(rng);
    vpSceneCamera camera(fronted.spec);
    const vpCollisionShape ball = vpCollisionShape::sphere(0.03);
    // On the ray through the centre of the face.
    const auto put = [&fronted](double z) {
      return vpRigidTransform{Eigen::Matrix3d::Identity(), z / fronted.cMface.p.z() * fronted.cMface.p};
    };
    vpImage<unsigned char> alone, front, back;
    vpCollisionSceneSpec spec;
    spec.objects = {fronted.box};
    camera.picture(vpCollisionScene(amor(), spec), vpRigidTransform(), {}, 1, alone);
    spec.objects = {fronted.box, object("ball", ball, put(0.3))};
    camera.picture(vpCollisionScene(amor(), spec), vpRigidTransform(), {}, 1, front);
    spec.objects = {fronted.box, object("ball", ball, put(0.9))};
    camera.picture(vpCollisionScene(amor(), spec), vpRigidTransform(), {}, 1, back);
    CHECK(same(back, alone));
    int changed = 0;
    for (unsigned int i = 0; i < alone.getSize(); ++i) {
      changed += alone.bitmap[i] != front.bitmap[i] ? 1 : 0;
    }
    const double disc = pi * std::pow(300. * 0.03 / 0.3, 2); // px, about
    CHECK(changed > 0.9 * disc);
    CHECK(changed < 1.1 * disc);
    // From behind the box there is no photograph: its back is plain.
    vpCollisionObject turned = fronted.box;
    turned.pose.R = turned.pose.R * vpSO3::exp(Vector3d(0., pi, 0.));
    spec.objects = {turned};
    camera.picture(vpCollisionScene(amor(), spec), vpRigidTransform(), {}, 1, back);
    CHECK(std::abs(back[118][161] - back[122][165]) <= 1);
  }
}

TEST_CASE("Faults of a depth camera are as large as asked for, and repeat", "[scene]")
{
  vpSceneCamera camera(small());
  vpCollisionSceneSpec spec;
  vpRigidTransform far;
  far.p.z() = 2.05;
  spec.objects = {object("wall", vpCollisionShape::box({9., 9., 0.1}), far)};
  const vpCollisionScene scene(amor(), spec);
  vpDepthFaults faults;
  faults.noise = 0.003;
  faults.dropout = 0.2;
  vpImage<float> depth, again;
  camera.depth(scene, vpRigidTransform(), faults, 7, depth);
  camera.depth(scene, vpRigidTransform(), faults, 7, again);
  CHECK(same(depth, again));
  double sum = 0., squares = 0., count = 0.;
  for (unsigned int i = 0; i < depth.getSize(); ++i) {
    if (depth.bitmap[i] > 0.F) {
      const double error = static_cast<double>(depth.bitmap[i]) - 2.;
      sum += error;
      squares += error * error;
      ++count;
    }
  }
  const double size = depth.getSize();
  CHECK(count / size == Approx(0.8).margin(5. * std::sqrt(0.16 / size)));
  CHECK(sum / count == Approx(0.).margin(5. * 0.012 / std::sqrt(count)));
  CHECK(std::sqrt(squares / count) == Approx(0.012).epsilon(0.02));
  faults.maxDepth = 1.9;
  camera.depth(scene, vpRigidTransform(), faults, 7, depth);
  CHECK(same(depth, vpImage<float>(240, 320, 0.F)));
}

TEST_CASE("A scene camera that cannot work is refused", "[scene]")
{
  auto rng = vpTestSupport::generator(734);
  const Fronted fronted(rng);
  const auto message = [](const vpSceneCameraSpec &spec) {
    try {
      static_cast<void>(vpSceneCamera(spec));
    }
    catch (const vpException &error) {
      return error.getStringMessage();
    }
    return std::string();
  };
  vpSceneCameraSpec spec = fronted.spec;
  spec.camera.initPersProjWithDistortion(300., 300., 160., 120., 0.1, -0.1);
  CHECK(message(spec) == "camera of the scene has a distortion model, must have none");
  spec = fronted.spec;
  spec.height = 7;
  CHECK(message(spec) == "picture of the scene is 320x7 px, must be at least 8x8 px");
  spec = fronted.spec;
  spec.photos.push_back(spec.photos[0]);
  CHECK(message(spec) == "object picture has two photographs");
  spec = fronted.spec;
  spec.photos[0].size.x() = 0.;
  CHECK(message(spec) == "photograph of object picture has no size");

  vpSceneCamera camera(fronted.spec);
  vpImage<unsigned char> picture;
  vpCollisionSceneSpec scene;
  scene.objects = {object("picture", vpCollisionShape::sphere(0.1), fronted.box.pose)};
  CHECK_THROWS_WITH(camera.picture(vpCollisionScene(amor(), scene), vpRigidTransform(), {}, 1, picture),
                    Catch::Contains("object picture is no box of 0.16 x 0.16 m, the size of its photograph"));
  vpImage<float> depth;
  vpDepthFaults faults;
  faults.dropout = 2.;
  CHECK_THROWS_WITH(camera.depth(vpCollisionScene(amor(), scene), vpRigidTransform(), faults, 1, depth),
                    Catch::Contains("dropout of the depth camera's faults is 2, must be 0..1"));
}
