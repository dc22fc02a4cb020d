/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// AMOR among random obstacles, and distances computed independently: by search, from points only.
#ifndef vpAvoidanceTestKit_h
#define vpAvoidanceTestKit_h

#include "vpTestArms.h"

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/direct_core/vpSO3.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace vpAvoidanceTestKit
{
using Eigen::Vector3d;
using namespace vpTestArms;

inline std::string dataFile(const std::string &name) { return std::string(VISP_DIRECT_DATA_DIR) + "/" + name; }

//! Revolute, prismatic, revolute, prismatic, in skew frames, with capsules also on the base and two on one link.
inline const vpArmModel &mixed()
{
  static const vpArmModel model = [] {
    vpArmSpec spec;
    spec.name = "mixed";
    for (int i = 0; i < 5; ++i) {
      vpArmJointSpec joint = vpArmJointSpec::standardDH(0.2 - 0.05 * i, 0.7 + 0.4 * i, 0.1 * i, 0.3);
      joint.before.R = Eigen::AngleAxisd(0.4 * i, Vector3d(1., 2., -1.).normalized()).toRotationMatrix();
      joint.name = "m" + std::to_string(i);
      joint.type = i % 2 == 1 ? vpJointType::Prismatic : vpJointType::Revolute;
      joint.lower = -0.8;
      joint.upper = 1.;
      spec.joints.push_back(joint);
    }
    spec.capsules = {{0, {0., 0., -0.1}, {0., 0., 0.05}, 0.06}, {1, {0., 0., 0.}, {-0.2, 0., 0.}, 0.04},
                     {3, {0., 0., 0.}, {0.1, 0.05, 0.1}, 0.03}, {4, {0., 0., 0.}, {0.1, 0., 0.}, 0.03},
                     {5, {0., 0., 0.}, {0., 0.1, 0.}, 0.03},    {5, {0., 0.1, 0.}, {0., 0.1, 0.}, 0.05}};
    return vpArmModel(spec);
  }();
  return model;
}

inline Vector3d point(std::mt19937_64 &rng, double size)
{
  return {uniform(rng, -size, size), uniform(rng, -size, size), uniform(rng, -size, size)};
}

inline vpRigidTransform pose(std::mt19937_64 &rng, double size)
{
  return {vpSO3::exp(3. * point(rng, 1.)), point(rng, size)};
}

//! A sphere, capsule, box or cylinder of a size between 2 cm and 40 cm.
inline vpCollisionShape primitive(std::mt19937_64 &rng, int kind)
{
  const double r = uniform(rng, 0.02, 0.15), l = uniform(rng, 0.02, 0.4);
  switch (kind % 4) {
  case 0:
    return vpCollisionShape::sphere(r);
  case 1:
    return vpCollisionShape::capsule(r, l);
  case 2:
    return vpCollisionShape::box({r, l, uniform(rng, 0.02, 0.4)});
  default:
    return vpCollisionShape::cylinder(r, l);
  }
}

inline vpTriangleMesh tetrahedron(double size)
{
  return vpTriangleMesh({{size, size, size}, {-size, -size, size}, {-size, size, -size}, {size, -size, -size}},
                        {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

//! Distance of a point from a solid that is filled (a capsule's or sphere's radius included), never negative.
inline double pointDistance(const vpCollisionShape &shape, const Vector3d &p)
{
  const auto positive = [](double v) { return std::max(v, 0.); };
  switch (shape.type()) {
  case vpShapeType::Sphere:
    return positive(p.norm() - shape.radius());
  case vpShapeType::Capsule: {
    const double z = positive(std::fabs(p.z()) - 0.5 * shape.length());
    return positive(std::hypot(std::hypot(p.x(), p.y()), z) - shape.radius());
  }
  case vpShapeType::Box: {
    const Vector3d out = (p.cwiseAbs() - 0.5 * shape.size()).cwiseMax(0.);
    return out.norm();
  }
  default:
    return std::hypot(positive(std::hypot(p.x(), p.y()) - shape.radius()),
                      positive(std::fabs(p.z()) - 0.5 * shape.length()));
  }
}

//! Least value of a convex function on [0, 1] by golden sections; the place to 1e-8, the value much better.
template <class Function> double least(Function f)
{
  const double golden = 0.5 * (std::sqrt(5.) - 1.);
  double low = 0., high = 1., a = high - golden, b = low + golden, fa = f(a), fb = f(b);
  for (int i = 0; i < 66; ++i) {
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - golden * (high - low);
      fa = f(a);
    }
    else {
      low = a;
      a = b;
      fa = fb;
      b = low + golden * (high - low);
      fb = f(b);
    }
  }
  return std::min({fa, fb, f(0.), f(1.)});
}

//! Distance of a segment from a solid of pointDistance(), in the solid's frame, by search.
inline double segmentDistance(const vpCollisionShape &shape, const Vector3d &from, const Vector3d &to)
{
  return least([&](double t) { return pointDistance(shape, from + t * (to - from)); });
}

//! Distance of two segments by a search in a search.
inline double segmentDistance(const Vector3d &from, const Vector3d &to, const Vector3d &otherFrom,
                              const Vector3d &otherTo)
{
  return least([&](double t) {
    const Vector3d p = from + t * (to - from);
    return least([&](double u) { return (p - otherFrom - u * (otherTo - otherFrom)).norm(); });
  });
}

//! A capsule of the arm in the base, by the frames of the links, not of the joints.
inline vpPlacedCapsule placed(const vpArmModel &arm, const vpArmData &data, int i)
{
  const vpArmCapsule &c = arm.spec().capsules[static_cast<std::size_t>(i)];
  const vpRigidTransform link = vpArmKinematics::link(arm, data, c.link);
  vpPlacedCapsule result;
  result.from = link.R * c.from + link.p;
  result.to = link.R * c.to + link.p;
  result.radius = c.radius;
  return result;
}

//! A scene of random primitives about an arm.
inline vpCollisionSceneSpec randomScene(std::mt19937_64 &rng, int objects, double size)
{
  vpCollisionSceneSpec spec;
  for (int j = 0; j < objects; ++j) {
    vpCollisionObject object;
    object.name = "o" + std::to_string(j);
    object.shape = primitive(rng, j);
    object.pose = pose(rng, size);
    object.inflation = j % 3 == 0 ? 0.01 : 0.;
    spec.objects.push_back(object);
  }
  return spec;
}
} // namespace vpAvoidanceTestKit
#endif
