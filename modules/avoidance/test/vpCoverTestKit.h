/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Random points of meshes and of covers, judged without the code under test; bodies of public arms.
#ifndef vpCoverTestKit_h
#define vpCoverTestKit_h

#include "vpAvoidanceTestKit.h"
#include "vpCaseFile.h"

#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/avoidance/vpTriangleMesh.h>

#include <filesystem>
#include <iostream>
#include <limits>

namespace vpCoverTestKit
{
using namespace vpAvoidanceTestKit;

//! Distance of a point from a union of capsules, negative inside.
inline double outside(const Vector3d &p, const std::vector<vpArmCapsule> &capsules)
{
  double least = std::numeric_limits<double>::infinity();
  for (const vpArmCapsule &c : capsules) {
    const Vector3d d = c.to - c.from;
    const double s = d.squaredNorm() > 0. ? std::min(1., std::max(0., (p - c.from).dot(d) / d.squaredNorm())) : 0.;
    least = std::min(least, (p - c.from - s * d).norm() - c.radius);
  }
  return least;
}

//! A random point of a random triangle; small triangles are as likely as large ones.
inline Vector3d surfacePoint(const vpTriangleMesh &mesh, std::mt19937_64 &rng)
{
  const auto &t = mesh.triangles()[rng() % mesh.triangles().size()];
  const auto at = [&](std::size_t k) { return mesh.vertices()[static_cast<std::size_t>(t[k])]; };
  double a = uniform(rng, 0., 1.), b = uniform(rng, 0., 1.);
  if (a + b > 1.) {
    a = 1. - a;
    b = 1. - b;
  }
  return at(0) + a * (at(1) - at(0)) + b * (at(2) - at(0));
}

//! Number of times the mesh winds around a point, by its solid angles (van Oosterom and Strackee, 1983).
inline double winding(const vpTriangleMesh &mesh, const Vector3d &p)
{
  double sum = 0.;
  for (const auto &t : mesh.triangles()) {
    const auto at = [&](std::size_t k) { return (mesh.vertices()[static_cast<std::size_t>(t[k])] - p).eval(); };
    const Vector3d a = at(0), b = at(1), c = at(2);
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2. * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4. * pi);
}

inline Eigen::AlignedBox3d boxOf(const vpTriangleMesh &mesh)
{
  Eigen::AlignedBox3d box;
  for (const Vector3d &v : mesh.vertices()) {
    box.extend(v);
  }
  return box;
}

inline Vector3d pointIn(const Eigen::AlignedBox3d &box, std::mt19937_64 &rng)
{
  return box.min() +
         box.sizes().cwiseProduct(Vector3d(uniform(rng, 0., 1.), uniform(rng, 0., 1.), uniform(rng, 0., 1.)));
}

//! A box, distorted by random corners: closed, not convex in general.
inline vpTriangleMesh lump(std::mt19937_64 &rng)
{
  const Vector3d size(uniform(rng, 0.03, 0.1), uniform(rng, 0.03, 0.1), uniform(rng, 0.05, 0.4));
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(size.cwiseProduct(Vector3d(i & 1, (i >> 1) & 1, i >> 2) + point(rng, 0.3)));
  }
  return vpTriangleMesh(corners, {{0, 2, 1},
                                  {1, 2, 3},
                                  {4, 5, 6},
                                  {5, 7, 6},
                                  {0, 1, 4},
                                  {1, 5, 4},
                                  {2, 6, 3},
                                  {3, 6, 7},
                                  {0, 4, 2},
                                  {2, 4, 6},
                                  {1, 3, 5},
                                  {3, 7, 5}});
}

//! Tubes along a bent line, as separate shells: the shape of a link.
inline vpTriangleMesh elbow(double length, double radius, int sides)
{
  std::vector<Vector3d> v;
  std::vector<std::array<int, 3>> t;
  for (const bool bent : {false, true}) {
    const int first = static_cast<int>(v.size());
    for (const double h : {0., length}) {
      for (int i = 0; i < sides; ++i) {
        const Vector3d p(radius * std::cos(2. * pi * i / sides), radius * std::sin(2. * pi * i / sides), h);
        v.push_back(bent ? Vector3d(p.z() - radius, p.y(), length - p.x()) : p);
      }
    }
    for (int i = 0; i < sides; ++i) {
      const int a = first + i, b = first + (i + 1) % sides;
      t.insert(t.end(), {{a, b, a + sides}, {b, b + sides, a + sides}});
      if (i > 1) {
        t.insert(t.end(), {{first, a, a - 1}, {first + sides, a - 1 + sides, a + sides}});
      }
    }
  }
  return vpTriangleMesh(v, t, "elbow");
}

//! An ellipsoid with many corners.
inline vpTriangleMesh egg(std::mt19937_64 &rng)
{
  const Vector3d size(uniform(rng, 0.03, 0.1), uniform(rng, 0.03, 0.1), uniform(rng, 0.05, 0.3));
  const int around = 40, rings = 20;
  std::vector<Vector3d> v{{0., 0., -size.z()}, {0., 0., size.z()}};
  std::vector<std::array<int, 3>> t;
  for (int i = 0; i < rings; ++i) {
    const double b = pi * ((i + 1.) / (rings + 1.) - 0.5);
    for (int k = 0; k < around; ++k) {
      const double a = 2. * pi * k / around;
      v.push_back(size.cwiseProduct(Vector3d(std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b))));
      const int here = 2 + i * around + k, next = 2 + i * around + (k + 1) % around;
      if (i == 0) {
        t.push_back({0, next, here});
      }
      if (i + 1 < rings) {
        t.insert(t.end(), {{here, next, here + around}, {next, next + around, here + around}});
      }
      else {
        t.push_back({1, here, next});
      }
    }
  }
  return vpTriangleMesh(v, t, "egg");
}

//! Collision meshes of the moving links of public arms, of those that are there.
struct CaseArm {
  std::string name;
  std::vector<std::string> files;
};

inline std::vector<CaseArm> caseArms()
{
  const std::string folder = "example-robot-data/robots/";
  CaseArm panda{"panda", {}}, ur5{"ur5", {}}, tiago{"tiago", {}}, kinova{"kinova", {}};
  for (int i = 1; i <= 7; ++i) {
    panda.files.push_back(folder + "panda_description/meshes/collision/link" + std::to_string(i) + ".stl");
  }
  for (const char *link : {"shoulder", "upperarm", "forearm", "wrist1", "wrist2", "wrist3"}) {
    ur5.files.push_back(folder + "ur_description/meshes/ur5/collision/" + link + ".stl");
  }
  for (int i = 1; i <= 6; ++i) {
    tiago.files.push_back(folder + "tiago_description/meshes/arm/arm_" + std::to_string(i) + "_collision.dae");
  }
  for (const char *link : {"shoulder", "arm", "forearm", "wrist_spherical_1", "wrist_spherical_2", "hand_2finger"}) {
    kinova.files.push_back(folder + "kinova_description/meshes/" + link + ".dae");
  }
  std::vector<CaseArm> arms{panda, ur5, tiago, kinova};
  const std::string cases = vpTestSupport::caseFile("example-robot-data/LICENSE");
  for (CaseArm &arm : arms) { // the descriptions do not have all meshes
    for (std::string &file : arm.files) {
      file = cases.substr(0, cases.rfind("example-robot-data")) + file;
    }
    arm.files.erase(std::remove_if(arm.files.begin(), arm.files.end(),
                                   [](const std::string &file) { return !std::filesystem::exists(file); }),
                    arm.files.end());
    if (!cases.empty() && arm.files.empty()) {
      std::cout << arm.name << ": its meshes are not there\n";
    }
  }
  return arms;
}
} // namespace vpCoverTestKit
#endif
