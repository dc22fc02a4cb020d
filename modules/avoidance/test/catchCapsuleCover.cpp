/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Covers enclose their meshes and are as tight as they say; the proof never accepts one that leaves a point out.
#include "vpCatch.h"
#include "vpCoverTestKit.h"

#include <visp3/avoidance/vpCapsuleCover.h>
#include <visp3/core/vpException.h>

#include <cstdlib>
#include <iomanip>
#include <iostream>

using namespace vpCoverTestKit;

namespace
{
template <class Call> std::string errorOf(Call call)
{
  try {
    static_cast<void>(call());
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}

vpTriangleMesh mesh(int i, std::mt19937_64 &rng)
{
  return i % 3 == 0 ? lump(rng) : i % 3 == 1 ? elbow(uniform(rng, 0.1, 0.4), uniform(rng, 0.02, 0.06), 12) : egg(rng);
}

//! Largest distance of random points of a mesh, of its surface and inside, from capsules.
double largestOutside(const vpTriangleMesh &m, const std::vector<vpArmCapsule> &capsules, int count, int inside,
                      std::mt19937_64 &rng)
{
  double most = -1.;
  for (int i = 0; i < count; ++i) {
    most = std::max(most, outside(surfacePoint(m, rng), capsules));
  }
  const Eigen::AlignedBox3d box = boxOf(m);
  for (int i = 0; i < inside; ++i) {
    const Vector3d p = pointIn(box, rng);
    if (std::fabs(winding(m, p)) > (m.isWatertight() ? 0.5 : 2.)) {
      most = std::max(most, outside(p, capsules));
    }
  }
  return most;
}

//! Distance of a point from a mesh by going through all triangles, with vpSegmentDistance's kernel for one.
double distanceTo(const vpTriangleMesh &m, const Vector3d &p)
{
  double least = 1e9;
  for (const auto &t : m.triangles()) {
    const auto at = [&](std::size_t k) { return m.vertices()[static_cast<std::size_t>(t[k])]; };
    least = std::min(least, vpSegmentDistance::triangle(p, p, at(0), at(1), at(2)).distance);
  }
  return least;
}

//! A random point of a capsule's surface.
Vector3d skinPoint(const vpArmCapsule &c, std::mt19937_64 &rng)
{
  const Vector3d u = point(rng, 1.).normalized(), d = c.to - c.from;
  if (rng() % 2 == 0 || d.norm() < 1e-9) {
    return (u.dot(d) > 0. ? c.to : c.from) + c.radius * u;
  }
  return c.from + uniform(rng, 0., 1.) * d + c.radius * (u - u.dot(d) / d.squaredNorm() * d).normalized();
}

vpArmCapsule capsule(const Vector3d &from, const Vector3d &to, double radius) { return {0, from, to, radius, -1}; }

} // namespace

TEST_CASE("Fitted capsules enclose surface and inside of random solids", "[cover]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator();
  double most = -1.;
  for (int i = 0; i < vpTestSupport::longer(8); ++i) {
    const vpTriangleMesh m = mesh(i, rng);
    REQUIRE(m.isWatertight());
    vpCapsuleCoverSpec spec;
    spec.count = 1 + i % 5;
    spec.enough = 0.;
    spec.seed = static_cast<unsigned int>(rng());
    const vpCapsuleCover cover = vpFitCapsules(m, spec);
    CAPTURE(i, spec.count, spec.seed);
    CHECK(static_cast<int>(cover.capsules.size()) <= spec.count);
    const vpCoverProof proof = vpProveCover(m, cover.capsules);
    CHECK(proof.enclosed);
    CHECK(proof.message.empty());
    const double here = largestOutside(m, cover.capsules, 20000, 2000, rng);
    CHECK(here < 0.);
    most = std::max(most, here);
  }
  std::cout << "covers of random solids: points at least " << -most << " m inside\n";
}

TEST_CASE("Overhang and volumes against random points", "[cover]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator(1);
  for (int i = 0; i < vpTestSupport::longer(6); ++i) {
    const vpTriangleMesh m = mesh(i, rng);
    std::vector<vpArmCapsule> capsules;
    for (int k = 0; k <= i % 3; ++k) { // not enclosing
      capsules.push_back(capsule(pointIn(boxOf(m), rng), pointIn(boxOf(m), rng), uniform(rng, 0.02, 0.1)));
    }
    const vpCapsuleCover cover = vpMeasureCover(m, capsules);
    CAPTURE(i, cover.overhang, cover.volumeRatio, cover.radius);
    double most = 0., gap = 0.;
    Eigen::AlignedBox3d box = boxOf(m);
    for (const vpArmCapsule &c : capsules) {
      gap = std::max({gap, 0.1 * c.radius, 0.125 * (c.to - c.from).norm()});
      for (int k = 0; k < 2000; ++k) {
        const Vector3d p = skinPoint(c, rng);
        box.extend(p + Vector3d::Constant(1e-3)).extend(p - Vector3d::Constant(1e-3));
        if (outside(p, capsules) > -1e-9 && std::fabs(winding(m, p)) < 0.5) {
          most = std::max(most, distanceTo(m, p));
        }
      }
    }
    CHECK(most <= cover.overhang + gap);
    CHECK(cover.overhang <= most + gap);
    int within = 0;
    for (int k = 0; k < 200000; ++k) {
      within += outside(pointIn(box, rng), capsules) <= 0. ? 1 : 0;
    }
    // The hull's volume, from the ratio, lies between that of the mesh and that of its box.
    const double hull = within / 2e5 * box.sizes().prod() / cover.volumeRatio;
    CHECK(hull < 1.02 * boxOf(m).sizes().prod());
    CHECK(2. * cover.radius <= boxOf(m).sizes().minCoeff() * 1.0001);
  }
}

TEST_CASE("Figures of shapes with known ones", "[cover]")
{
  const vpTriangleMesh box(
      {{0, 0, 0}, {0.1, 0, 0}, {0, 0.2, 0}, {0.1, 0.2, 0}, {0, 0, 0.4}, {0.1, 0, 0.4}, {0, 0.2, 0.4}, {0.1, 0.2, 0.4}},
      {{0, 2, 1},
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
  const vpCapsuleCover ball = vpMeasureCover(box, {capsule({0.05, 0.1, 0.2}, {0.05, 0.1, 0.2}, 0.3)});
  CHECK(ball.radius == Approx(0.05));
  CHECK(ball.volumeRatio == Approx(4. / 3. * pi * 0.027 / 0.008).epsilon(0.02));
  CHECK(ball.overhang == Approx(0.25).epsilon(0.02)); // above the middle of the largest face
  // A flat end of a cylinder overhangs by at least (sqrt 2 - 1) of its radius.
  std::vector<Vector3d> corners{{0., 0., 0.}, {0., 0., 0.3}};
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < 40; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % 40);
    corners.emplace_back(0.05 * std::cos(pi * i / 20.), 0.05 * std::sin(pi * i / 20.), 0.);
    corners.emplace_back(corners.back().x(), corners.back().y(), 0.3);
    triangles.insert(triangles.end(), {{0, b, a}, {1, a + 1, b + 1}, {a, b, b + 1}, {a, b + 1, a + 1}});
  }
  vpCapsuleCoverSpec one;
  one.count = 1;
  const vpCapsuleCover cylinder = vpFitCapsules(vpTriangleMesh(corners, triangles), one);
  CHECK(cylinder.radius == Approx(0.05).epsilon(0.01));
  CHECK(cylinder.overhang > 0.95 * (std::sqrt(2.) - 1.) * 0.05);
  CHECK(cylinder.overhang < 0.04);
}

TEST_CASE("Nothing is proven that leaves a point outside", "[cover]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator(2);
  int proven = 0, refused = 0, left = 0;
  for (int i = 0; i < 6; ++i) {
    const vpTriangleMesh m = mesh(i, rng);
    vpCapsuleCoverSpec spec;
    spec.count = 1 + i % 3;
    const vpCapsuleCover cover = vpFitCapsules(m, spec);
    for (int k = 0; k < 40; ++k) {
      std::vector<vpArmCapsule> capsules = cover.capsules;
      const double shift = 0.02 * std::pow(uniform(rng, 0., 1.), 3);
      for (vpArmCapsule &c : capsules) {
        c.from += point(rng, shift);
        c.to += point(rng, shift);
        c.radius = std::max(1e-3, c.radius + uniform(rng, -shift, 3. * shift));
      }
      const vpCoverProof proof = vpProveCover(m, capsules);
      const double out = largestOutside(m, capsules, 2000, 100, rng);
      CAPTURE(i, k, shift, proof.message, out);
      if (proof.enclosed) {
        CHECK(out <= 1e-9);
      }
      else {
        CHECK_FALSE(proof.message.empty());
        CHECK(proof.outside >= 0.);
        CHECK((proof.outside == 0. || outside(proof.point, capsules) == Approx(proof.outside)));
      }
      (proof.enclosed ? proven : out > 0. ? left : refused) += 1;
    }
  }
  std::cout << "edited covers: " << proven << " proven, " << left << " leave a point outside, " << refused
            << " refused without such a point among 2100\n";
  CHECK(proven > 20);
  CHECK(left > 20);
  CHECK(refused < proven);
}

TEST_CASE("A hollow between capsules is not taken as enclosed", "[cover]")
{
  // Four balls about the corners of a tetrahedron: they hold its faces, not its middle.
  const vpTriangleMesh m = tetrahedron(0.1);
  std::vector<vpArmCapsule> balls;
  for (const Vector3d &v : m.vertices()) {
    balls.push_back(capsule(v, v, 0.168));
  }
  std::mt19937_64 rng = vpTestSupport::generator(3);
  CHECK(largestOutside(m, balls, 20000, 0, rng) < 0.);
  CHECK(outside(Vector3d::Zero(), balls) > 0.);
  const vpCoverProof proof = vpProveCover(m, balls);
  CHECK_FALSE(proof.enclosed);
  CHECK(proof.message == "mesh: more than three capsules that all touch one another may enclose a hollow");
  // In a row they cannot.
  const vpTriangleMesh rod = elbow(0.4, 0.01, 8);
  std::vector<vpArmCapsule> row{capsule({-0.1, 0., 0.2}, {0.4, 0., 0.2}, 0.5)};
  for (int i = 0; i < 5; ++i) {
    row.push_back(capsule({1. + i, 0., 0.}, {1. + i, 0., 0.}, 0.6));
  }
  CHECK(vpProveCover(rod, row).enclosed);
}

TEST_CASE("What lies behind a surface with holes is covered, too", "[cover]")
{
  CAPTURE(vpTestSupport::seed());
  std::mt19937_64 rng = vpTestSupport::generator(4);
  const vpTriangleMesh whole = lump(rng);
  std::vector<std::array<int, 3>> triangles = whole.triangles();
  triangles.erase(triangles.begin() + 3);
  const vpTriangleMesh open(whole.vertices(), triangles, "open");
  REQUIRE_FALSE(open.isWatertight());
  const vpCapsuleCover cover = vpFitCapsules(open);
  CHECK(vpProveCover(open, cover.capsules).enclosed);
  int deep = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3d p = pointIn(boxOf(open), rng);
    if (std::fabs(winding(open, p)) > 0.75 && distanceTo(open, p) > 0.0174) {
      ++deep;
      CHECK(outside(p, cover.capsules) < 0.);
    }
    CHECK(outside(surfacePoint(open, rng), cover.capsules) < 0.);
  }
  std::cout << "behind a surface with a hole: " << deep << " points\n";
}

TEST_CASE("The same seed gives the same cover", "[cover]")
{
  std::mt19937_64 rng = vpTestSupport::generator(5);
  const vpTriangleMesh m = lump(rng);
  const vpCapsuleCover a = vpFitCapsules(m), b = vpFitCapsules(m);
  REQUIRE(a.capsules.size() == b.capsules.size());
  for (std::size_t i = 0; i < a.capsules.size(); ++i) {
    CHECK(a.capsules[i].from == b.capsules[i].from);
    CHECK(a.capsules[i].to == b.capsules[i].to);
    CHECK(a.capsules[i].radius == b.capsules[i].radius);
  }
  CHECK(a.overhang == b.overhang);
}

TEST_CASE("Wrong fields of a cover are named", "[cover]")
{
  const vpTriangleMesh m = tetrahedron(0.1);
  vpCapsuleCoverSpec spec;
  spec.count = 9;
  CHECK(errorOf([&] { return vpFitCapsules(m, spec); }) == "count of the cover by capsules is 9, must be 1 to 8");
  spec.count = 1;
  spec.enough = NAN;
  CHECK(errorOf([&] { return vpFitCapsules(m, spec); }) ==
        "enough of the cover by capsules is nan m, must be >= 0 and finite");
  CHECK(errorOf([&] { return vpMeasureCover(m, {}); }) == "a cover has no capsule");
  CHECK(errorOf([&] {
          return vpProveCover(m, {capsule({0., 0., 0.}, {0., NAN, 0.}, 1.)});
        }).find("capsule 0 of a cover") == 0);
  CHECK(errorOf([&] {
          return vpProveCover(m, {capsule({0., 0., 0.}, {0., 0., 0.}, 1e300)});
        }).find("capsule 0 of a cover has the radius 1e+300 m") == 0);
  // Extreme but valid: very small, very large, flat.
  for (const double size : {1e-4, 5e3}) {
    const vpTriangleMesh extreme = tetrahedron(size);
    const vpCapsuleCover cover = vpFitCapsules(extreme);
    std::mt19937_64 rng = vpTestSupport::generator(6);
    CHECK(largestOutside(extreme, cover.capsules, 1000, 0, rng) < 0.);
  }
  const vpTriangleMesh flat({{0., 0., 0.}, {0.1, 0., 0.}, {0., 0.1, 0.}}, {{0, 1, 2}});
  const vpCapsuleCover sheet = vpFitCapsules(flat);
  CHECK(vpProveCover(flat, sheet.capsules).enclosed);
  CHECK(sheet.volumeRatio == 0.);
}

// Per link and number of capsules: overhang, its share of the link's radius, volume over that of the hull.
TEST_CASE("Links of public arms: how tight their covers are", "[cover][cases][needs-ASSIMP]")
{
  std::mt19937_64 rng(7); // the fits do not depend on the seed of the day and are not worth repeating
  std::vector<double> shares, volumes;
  double most = -1.;
  const bool longer = std::getenv("VISP_DIRECT_LONG_TESTS") != nullptr;
  for (const CaseArm &arm : caseArms()) {
    for (const std::string &file : arm.files) {
      const vpTriangleMesh m = vpTriangleMesh::load(file);
      std::cout << std::left << std::setw(7) << arm.name << std::setw(26) << file.substr(file.rfind('/') + 1);
      for (int k = longer ? 1 : 3; k <= 3; ++k) {
        vpCapsuleCoverSpec spec;
        spec.count = k;
        const vpCapsuleCover cover = vpFitCapsules(m, spec);
        std::cout << std::fixed << " | " << cover.capsules.size() << ": " << std::setprecision(1)
                  << 1e3 * cover.overhang << " mm = " << std::setprecision(2) << cover.overhang / cover.radius << " r, "
                  << cover.volumeRatio << std::defaultfloat << std::setprecision(6) << std::flush;
        if (k == 3) {
          shares.push_back(cover.overhang / cover.radius);
          volumes.push_back(cover.volumeRatio);
          most = std::max(most, largestOutside(m, cover.capsules, 100000, 2000, rng));
          CHECK(vpProveCover(m, cover.capsules).enclosed);
        }
      }
      std::cout << "\n";
    }
  }
  if (!shares.empty()) {
    std::sort(shares.begin(), shares.end());
    std::sort(volumes.begin(), volumes.end());
    const double share = shares[shares.size() / 2], volume = volumes[volumes.size() / 2];
    std::cout << shares.size() << " links, up to 3 capsules: median overhang " << share
              << " of the link's radius, median volume " << volume << " of the hull; points at least " << -most
              << " m inside\n";
    CHECK(most < 0.);
    CHECK(share <= 0.6);
    CHECK(volume <= 1.45);
  }
}
