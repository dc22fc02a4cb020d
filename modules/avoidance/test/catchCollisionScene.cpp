/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Clearances of the arm against searches and FCL, the bookkeeping of scenes, and the cost in allocations.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/core/vpException.h>

#include <iostream>
#include <map>

using namespace vpAvoidanceTestKit;

namespace
{
vpCollisionObject object(const std::string &name, const vpCollisionShape &shape, const vpRigidTransform &pose = {})
{
  vpCollisionObject result;
  result.name = name;
  result.shape = shape;
  result.pose = pose;
  return result;
}

// Clearance of a capsule from an object by search; capsules by their axis, computed independently.
double searched(const vpPlacedCapsule &c, const vpCollisionObject &object)
{
  const vpRigidTransform oMf = object.pose.inverse();
  return segmentDistance(object.shape, oMf.R * c.from + oMf.p, oMf.R * c.to + oMf.p) - c.radius - object.inflation;
}

// One capsule of the given ends on a joint that does not move.
vpArmModel oneCapsule(const Vector3d &from, const Vector3d &to, double radius)
{
  vpArmSpec spec;
  spec.name = "one";
  vpArmJointSpec joint;
  joint.name = "j";
  joint.lower = -1.;
  joint.upper = 1.;
  spec.joints = {joint};
  spec.capsules = {{1, from, to, radius}};
  return vpArmModel(spec);
}

vpClearance alone(const vpArmModel &arm, const vpCollisionObject &obstacle)
{
  vpCollisionSceneSpec spec;
  spec.objects = {obstacle};
  const vpCollisionScene scene(arm, spec);
  vpCollisionData data;
  scene.place(vpJointVector::Zero(1), data);
  return scene.pair(data, 0, 0);
}

std::string errorOf(const vpCollisionSceneSpec &spec, const vpArmModel &arm = amor())
{
  try {
    const vpCollisionScene scene(arm, spec);
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}
} // namespace

TEST_CASE("Clearances of capsules from primitives agree with a search; FCL beside", "[scene][needs-FCL]")
{
  const char *const names[] = {"sphere", "capsule", "box", "cylinder"};
  CAPTURE(vpTestSupport::seed());
  for (int kind = 0; kind < 4; ++kind) {
    auto rng = vpTestSupport::generator(static_cast<unsigned int>(kind));
    double worst = 0., worstFcl = 0.;
    int apart = 0, compared = 0, offFcl = 0;
    for (int k = 0; k < 10000; ++k) {
      CAPTURE(kind, k);
      const Vector3d from = point(rng, 0.4), to = k % 7 == 0 ? from : point(rng, 0.4);
      const vpArmModel arm = oneCapsule(from, to, uniform(rng, 0.02, 0.1));
      vpCollisionObject obstacle = object("o", primitive(rng, kind), pose(rng, 0.4));
      obstacle.inflation = k % 3 == 0 ? 0.02 : 0.;
      const vpClearance pair = alone(arm, obstacle);
      vpPlacedCapsule c;
      c.from = from;
      c.to = to;
      c.radius = arm.spec().capsules[0].radius;
      const double truth = searched(c, obstacle);
      // With the core's radius, distances of spheres and capsules continue to negative values: the search ends there.
      const double exact = truth + c.radius + obstacle.inflation > 1e-9 ? truth : std::min(pair.distance, truth);
      // Both belong to existing points: the smaller one is more accurate, and a search may end early in a kink.
      worst = std::max(worst, pair.distance - exact);
      CHECK(pair.distance > exact - 1e-6);
      CHECK((pair.onArm - pair.onOther - pair.distance * pair.normal).norm() < 1e-9);
      if (truth + c.radius + obstacle.inflation > 1e-6) {
        CHECK(std::fabs(segmentDistance(from, to, pair.onArm, pair.onArm) - c.radius) < 1e-7);
      }
      if (pair.distance > 0.) {
        ++apart;
        const vpRigidTransform oMf = obstacle.pose.inverse();
        CHECK(pointDistance(obstacle.shape, oMf.R * pair.onOther + oMf.p) == Approx(obstacle.inflation).margin(1e-9));
        vpCollisionSceneSpec spec;
        spec.objects = {obstacle};
        const vpCollisionScene scene(arm, spec);
        vpFclChecker fcl(scene);
        if (k % 5 == 0) {
          const vpClearance other = fcl.clearance(vpJointVector::Zero(1), 10.);
          const double off = std::fabs(other.distance - pair.distance);
          worstFcl = std::max(worstFcl, off);
          offFcl += off > 1e-3 ? 1 : 0;
          ++compared;
        }
      }
    }
    std::cout << names[kind] << ": 10000 pairs, " << apart << " apart; largest difference from the search " << worst
              << " m, of FCL from the fast path (every fifth) " << worstFcl << " m" << std::endl;
    CHECK(apart > 3000);
    CHECK(apart < 9900);
    CHECK(worst < 1e-9);
    // The search is the reference, not FCL: its iteration is far off in single pairs (0.14 m was observed) without a
    // known bound; but nearly all of its results are independent confirmations.
    CHECK(offFcl <= compared / 100);
  }
}

TEST_CASE("Signed distances where they are exact", "[scene]")
{
  const vpArmModel arm = oneCapsule({0., 0., -0.2}, {0., 0., 0.2}, 0.05);
  const auto at = [](double x) { return vpRigidTransform{Eigen::Matrix3d::Identity(), Vector3d(x, 0., 0.)}; };
  CHECK(alone(arm, object("o", vpCollisionShape::sphere(0.1), at(0.1))).distance == Approx(-0.05));
  CHECK(alone(arm, object("o", vpCollisionShape::sphere(0.1), at(0.))).distance == Approx(-0.15));
  CHECK(alone(arm, object("o", vpCollisionShape::capsule(0.1, 0.3), at(-0.12))).distance == Approx(-0.03));
  // Boxes and cylinders: exact until the axis is inside, then the radius.
  CHECK(alone(arm, object("o", vpCollisionShape::box({0.2, 0.2, 0.2}), at(0.12))).distance == Approx(-0.03));
  CHECK(alone(arm, object("o", vpCollisionShape::box({0.2, 0.2, 0.2}), at(0.05))).distance == Approx(-0.05));
  CHECK(alone(arm, object("o", vpCollisionShape::cylinder(0.1, 0.2), at(0.13))).distance == Approx(-0.02));
  CHECK(alone(arm, object("o", vpCollisionShape::cylinder(0.1, 0.2), at(0.))).distance == Approx(-0.05));
  const vpClearance pair = alone(arm, object("o", vpCollisionShape::sphere(0.1), at(0.1)));
  CHECK((pair.normal - Vector3d(-1., 0., 0.)).norm() < 1e-12);
  CHECK((pair.onArm - Vector3d(0.05, 0., 0.)).norm() < 1e-12);
  CHECK((pair.onOther - Vector3d(0., 0., 0.)).norm() < 1e-12);
}

TEST_CASE("Meshes: every triangle by search, and the sign by the winding number", "[scene]")
{
  auto rng = vpTestSupport::generator(11);
  CAPTURE(vpTestSupport::seed());
  const vpTriangleMesh solid = tetrahedron(0.2);
  CHECK(solid.isWatertight());
  CHECK(solid.message().empty());
  auto sheetTriangles = solid.triangles();
  sheetTriangles.pop_back();
  const vpTriangleMesh sheet(solid.vertices(), sheetTriangles, "torn");
  CHECK_FALSE(sheet.isWatertight());
  CHECK(sheet.message() ==
        "torn: the surface has holes (3 edges with one triangle), it is a surface without an inside");
  auto turnedTriangles = solid.triangles();
  std::swap(turnedTriangles[0][0], turnedTriangles[0][1]);
  const vpTriangleMesh turned(solid.vertices(), turnedTriangles, "turned");
  CHECK(turned.isWatertight());
  int inside = 0;
  for (int k = 0; k < 5000; ++k) {
    CAPTURE(k);
    const double size = k % 2 == 0 ? 0.1 : 0.5;
    const Vector3d from = point(rng, size), to = from + point(rng, 0.5 * size);
    const double radius = uniform(rng, 0.01, 0.05);
    const vpRigidTransform there = pose(rng, 0.1), oMf = there.inverse();
    const vpArmModel arm = oneCapsule(there.R * from + there.p, there.R * to + there.p, radius);
    double nearest = 1e9, winding = 0.;
    for (const auto &t : solid.triangles()) {
      const auto corner = [&](std::size_t i) { return solid.vertices()[static_cast<std::size_t>(t[i])]; };
      nearest = std::min(nearest, vpSegmentDistance::triangle(from, to, corner(0), corner(1), corner(2)).distance);
      // Solid angle of a triangle seen from a point (Van Oosterom and Strackee).
      const Vector3d a = corner(0) - from, b = corner(1) - from, c = corner(2) - from;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      winding += 2. * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    const bool within = std::fabs(winding) > 2. * pi && nearest > 0.;
    inside += within ? 1 : 0;
    const double truth = (within ? -nearest : nearest) - radius;
    const vpTriangleMesh &either = k % 3 == 0 ? turned : solid;
    CHECK(alone(arm, object("o", vpCollisionShape::mesh(either), there)).distance == Approx(truth).margin(1e-9));
    double torn = 1e9;
    for (const auto &t : sheet.triangles()) {
      const auto corner = [&](std::size_t i) { return sheet.vertices()[static_cast<std::size_t>(t[i])]; };
      torn = std::min(torn, vpSegmentDistance::triangle(from, to, corner(0), corner(1), corner(2)).distance);
    }
    CHECK(alone(arm, object("o", vpCollisionShape::mesh(sheet, vpMeshUse::Surface), there)).distance ==
          Approx(torn - radius).margin(1e-9));
    static_cast<void>(oMf);
  }
  CHECK(inside > 200);
}

namespace
{
// Cubes that are hard for a tree over a Z-order curve: at one place, ever nearer to a corner, of all sizes, on a line.
std::vector<std::vector<vpOctreeCell>> hardCubes(std::mt19937_64 &rng)
{
  std::vector<std::vector<vpOctreeCell>> all(4);
  for (int k = 0; k < 1000; ++k) {
    all[0].push_back({Vector3d(0.5, 0., 0.2), 0.05});
    const double shrinking = std::ldexp(1., -(k % 60));
    all[1].push_back({shrinking * Vector3d(k % 3 == 0 ? 0.7 : 0., k % 3 == 1 ? 0.7 : 0., 0.3), 0.01});
    all[2].push_back({point(rng, 0.8), std::pow(10., uniform(rng, -4., -0.7))});
    all[3].push_back({Vector3d(0.4, 0.001 * k - 0.5, 0.3), 0.001});
  }
  all[0].push_back({Vector3d(vpLargestLength, -vpLargestLength, 0.), 1.});
  return all;
}
} // namespace

TEST_CASE("A tree of boxes finds the nearest of all cubes", "[scene]")
{
  auto rng = vpTestSupport::generator(13);
  CAPTURE(vpTestSupport::seed());
  for (const std::vector<vpOctreeCell> &cells : hardCubes(rng)) {
    vpCollisionSceneSpec spec;
    spec.objects = {object("map", vpCollisionShape::octree(vpOctree(cells)), pose(rng, 0.1))};
    const vpCollisionScene scene(amor(), spec);
    vpCollisionData data;
    for (int k = 0; k < 30; ++k) {
      scene.place(configuration(amor(), rng), data);
      for (int i = 0; i < scene.capsuleCount(); ++i) {
        const vpPlacedCapsule c = placed(amor(), data.arm, i);
        const vpRigidTransform oMf = spec.objects[0].pose.inverse();
        const Vector3d from = oMf.R * c.from + oMf.p, to = oMf.R * c.to + oMf.p;
        double nearest = 1e9;
        for (const vpOctreeCell &cell : cells) {
          nearest = std::min(
              nearest, vpSegmentDistance::box(from - cell.centre, to - cell.centre, Vector3d::Constant(0.5 * cell.size))
                           .distance);
        }
        REQUIRE(scene.pair(data, i, 0).distance == Approx(nearest - c.radius).margin(1e-9));
      }
    }
  }
}

TEST_CASE("Octrees are the nearest of their cubes; FCL beside", "[scene][needs-FCL]")
{
  auto rng = vpTestSupport::generator(12);
  CAPTURE(vpTestSupport::seed());
  std::vector<vpOctreeCell> cells;
  for (int k = 0; k < 60; ++k) {
    const Vector3d p = (0.45 + 0.2 * uniform(rng, 0., 1.)) * point(rng, 1.).normalized() / 0.04;
    cells.push_back({0.04 * (p.array().floor().matrix() + Vector3d::Constant(0.5)), 0.04});
  }
  const vpCollisionObject map = object("map", vpCollisionShape::octree(vpOctree(cells)), pose(rng, 0.1));
  vpCollisionSceneSpec spec;
  spec.objects = {map};
  const vpCollisionScene scene(amor(), spec);
  vpCollisionData data;
  vpFclChecker fcl(scene);
  double worstFcl = 0.;
  int free = 0;
  for (int k = 0; k < 500; ++k) {
    const vpJointVector q = configuration(amor(), rng);
    scene.place(q, data);
    double truth = 1e9;
    for (int i = 0; i < scene.capsuleCount(); ++i) {
      const vpPlacedCapsule c = placed(amor(), data.arm, i);
      double nearest = 1e9;
      for (const vpOctreeCell &cell : cells) {
        vpCollisionObject cube = object("c", vpCollisionShape::box(Vector3d::Constant(cell.size)), map.pose);
        cube.pose.p += cube.pose.R * cell.centre;
        const vpRigidTransform oMf = cube.pose.inverse();
        const Vector3d from = oMf.R * c.from + oMf.p, to = oMf.R * c.to + oMf.p;
        nearest = std::min(nearest, vpSegmentDistance::box(from, to, Vector3d::Constant(0.5 * cell.size)).distance);
      }
      CHECK(scene.pair(data, i, 0).distance == Approx(nearest - c.radius).margin(1e-9));
      truth = std::min(truth, nearest - c.radius);
    }
    const vpClearance all = scene.clearance(data);
    CHECK(all.distance <= truth + 1e-9);
    CHECK(scene.inCollision(data) == (all.distance <= 0.));
    if (all.distance > 0.) {
      ++free;
      worstFcl = std::max(worstFcl, std::fabs(fcl.clearance(q, 10.).distance - all.distance));
    }
  }
  CHECK(free > 50);
  CHECK(free < 450);
  std::cout << "octree: " << free << " free configurations, largest difference of FCL " << worstFcl << " m\n";
  const vpCollisionObject nothing = object("map", vpCollisionShape::octree(vpOctree(std::vector<vpOctreeCell>{})));
  CHECK(std::isinf(alone(oneCapsule({0., 0., 0.}, {0., 0., 1.}, 0.1), nothing).distance));
}

TEST_CASE("Whole-arm queries are those of their pairs, now and later, for moved objects and copies", "[scene]")
{
  auto rng = vpTestSupport::generator(13);
  CAPTURE(vpTestSupport::seed());
  int collisions = 0;
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const vpArmModel &arm = trial % 2 == 0 ? amor() : mixed();
    vpCollisionSceneSpec spec = randomScene(rng, 8, 0.9);
    spec.objects.push_back(object("mesh", vpCollisionShape::mesh(tetrahedron(0.1)), pose(rng, 0.8)));
    for (vpCollisionObject &one : spec.objects) {
      const Vector3d v = point(rng, 0.3), w = point(rng, 1.);
      one.velocity = vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
    }
    spec.ground = vpHalfSpace{{0.1, 0., 2.}, -0.3, 2};
    vpCollisionScene scene(arm, spec);
    const double time = trial % 3 == 0 ? 0. : 0.7;
    vpCollisionScene later(scene);
    later.advance(time);
    REQUIRE(later.moveObject(2, pose(rng, 0.8)));
    REQUIRE(scene.setVelocity(2, vpTwist()));
    REQUIRE(scene.moveObject(2, later.object(2).pose));
    vpCollisionData data;
    for (int k = 0; k < 20; ++k) {
      scene.place(configuration(arm, rng), data);
      std::vector<vpClearance> all;
      for (int i = 0; i < scene.capsuleCount(); ++i) {
        const vpPlacedCapsule c = placed(arm, data.arm, i);
        CHECK((c.from - data.capsules[static_cast<std::size_t>(i)].from).norm() < 1e-12);
        CHECK((c.to - data.capsules[static_cast<std::size_t>(i)].to).norm() < 1e-12);
        for (int j = 0; j < scene.objectCount(); ++j) {
          if (scene.isChecked(i, j)) {
            all.push_back(later.pair(data, i, j));
            CHECK(scene.pair(data, i, j, time).distance == Approx(all.back().distance).margin(1e-12));
          }
        }
        if (scene.isCheckedWithGround(i)) {
          all.push_back(scene.groundPair(data, i));
          const double height =
              std::min(Vector3d(0.1, 0., 2.).normalized().dot(c.from), Vector3d(0.1, 0., 2.).normalized().dot(c.to));
          CHECK(all.back().distance == Approx(height + 0.3 - c.radius).margin(1e-12));
        }
      }
      for (const vpSelfPair &pair : scene.selfPairs()) {
        all.push_back(scene.selfPair(data, pair.first, pair.second));
      }
      const double truth = std::min_element(all.begin(), all.end(), [](const vpClearance &a, const vpClearance &b) {
                             return a.distance < b.distance;
                           })->distance;
      CHECK(scene.clearance(data, 10., time).distance == Approx(truth).margin(1e-12));
      CHECK(scene.inCollision(data, 0., time) == (truth <= 0.));
      CHECK(scene.inCollision(data, 0.05, time) == (truth <= 0.05));
      CHECK(scene.inCollision(data, truth + 1e-9, time));
      CHECK_FALSE(scene.inCollision(data, truth - 1e-9, time));
      CHECK(std::isinf(scene.clearance(data, truth - 1e-9, time).distance));
      collisions += truth <= 0. ? 1 : 0;
      vpNearPairs near;
      scene.near(data, 0.2, near, time);
      // Of each link and object, two links, or link and ground the least.
      std::map<std::array<int, 3>, double> least;
      for (const vpClearance &pair : all) {
        const bool self = pair.kind == vpCollisionKind::Self;
        const std::array<int, 3> key = {static_cast<int>(pair.kind), scene.capsule(pair.capsule).link,
                                        self ? scene.capsule(pair.other).link : pair.other};
        const auto known = least.emplace(key, pair.distance).first;
        known->second = std::min(known->second, pair.distance);
      }
      const auto count = std::count_if(least.begin(), least.end(), [](const auto &one) { return one.second < 0.2; });
      CHECK(near.count == count);
      for (int n = 0; n < near.count; ++n) {
        const vpClearance &pair = near.pairs[static_cast<std::size_t>(n)];
        const bool self = pair.kind == vpCollisionKind::Self;
        const std::array<int, 3> key = {static_cast<int>(pair.kind), scene.capsule(pair.capsule).link,
                                        self ? scene.capsule(pair.other).link : pair.other};
        CHECK(pair.distance == Approx(least.at(key)).margin(1e-12));
        const vpClearance alone = self ? scene.selfPair(data, pair.capsule, pair.other)
                                  : pair.kind == vpCollisionKind::Ground
                                      ? scene.groundPair(data, pair.capsule)
                                      : scene.pair(data, pair.capsule, pair.other, time);
        CHECK((pair.onArm - alone.onArm).norm() + (pair.onOther - alone.onOther).norm() +
                  (pair.normal - alone.normal).norm() <
              1e-12);
      }
      CHECK_FALSE(near.dropped);
    }
  }
  CHECK(collisions > 500);
  CHECK(collisions < 5500);
}

TEST_CASE("FCL and the fast path agree on collisions that are not grazing", "[scene][needs-FCL]")
{
  auto rng = vpTestSupport::generator(14);
  CAPTURE(vpTestSupport::seed());
  int wrong = 0, clear = 0, touching = 0;
  for (int trial = 0; trial < 100; ++trial) {
    vpCollisionSceneSpec spec = randomScene(rng, 10, 0.9);
    for (vpCollisionObject &one : spec.objects) { // none, the same, or each its own
      one.inflation = trial % 3 == 0 ? 0. : trial % 3 == 1 ? 0.03 : one.inflation;
    }
    vpCollisionScene scene(amor(), spec);
    vpFclChecker fcl(scene);
    vpSceneChecker own(scene);
    for (int k = 0; k < 20; ++k) {
      const vpJointVector q = configuration(amor(), rng);
      const double margin = k % 2 == 0 ? 0. : uniform(rng, 0., 0.1);
      REQUIRE(scene.moveObject(k % scene.objectCount(), pose(rng, 0.9))); // the checker reads the poses
      const double clearance = own.clearance(q, 10.).distance;
      if (std::fabs(clearance - margin) > 2e-3) {
        ++clear;
        touching += clearance < margin ? 1 : 0;
        wrong += fcl.inCollision(q, margin) != own.inCollision(q, margin) ? 1 : 0;
      }
      CHECK(fcl.inCollision(q, HUGE_VAL));
    }
  }
  CHECK(touching > 300);
  CHECK(clear - touching > 300);
  std::cout << "FCL and the fast path disagree on " << wrong << " of " << clear << " configurations\n";
  CHECK(wrong == 0);
}

TEST_CASE("Objects come, go and are known by name", "[scene]")
{
  vpCollisionScene scene(amor());
  const unsigned long revision = scene.revision();
  CHECK(scene.add(object("a", vpCollisionShape::sphere(0.1))) == 0);
  CHECK(scene.add(object("b", vpCollisionShape::cylinder(0.1, 0.2))) == 1);
  CHECK(scene.revision() != revision);
  CHECK(scene.find("b") == 1);
  REQUIRE(scene.setInflation(1, 0.03));
  vpCollisionData data;
  scene.place(vpJointVector::Zero(7), data);
  const double before = scene.pair(data, 3, 1).distance;
  REQUIRE(scene.setInflation(1, 0.01));
  CHECK(scene.pair(data, 3, 1).distance == Approx(before + 0.02));
  scene.remove(0);
  CHECK(scene.find("b") == 0);
  CHECK(scene.pair(data, 3, 0).distance == Approx(before + 0.02));
  vpNearPairs near;
  for (int k = 0; k < 80; ++k) {
    scene.add(object("c" + std::to_string(k), vpCollisionShape::sphere(0.1 + 0.001 * k)));
  }
  scene.near(data, 100., near);
  CHECK(near.count == vpNearPairs::capacity);
  CHECK(near.dropped);
  const double farthest =
      std::max_element(near.pairs.begin(), near.pairs.end(), [](const vpClearance &a, const vpClearance &b) {
        return a.distance < b.distance;
      })->distance;
  int nearer = 0;
  for (int j = 0; j < scene.objectCount(); ++j) {
    for (int i = 0; i < 4; ++i) {
      nearer += scene.pair(data, i, j).distance < farthest ? 1 : 0;
    }
  }
  CHECK(nearer < vpNearPairs::capacity);
}

TEST_CASE("Mistakes in a scene are named", "[scene]")
{
  vpCollisionSceneSpec spec;
  spec.source = "here";
  spec.objects = {object("a", vpCollisionShape::sphere(0.1)), object("a", vpCollisionShape::sphere(0.1))};
  CHECK(errorOf(spec) == "here: object a: duplicate name");
  spec.objects[0].name = spec.objects[1].name = "\x1b[2J";
  CHECK(errorOf(spec) == "here: object \\u001b[2J: duplicate name"); // a terminal would be cleared
  spec.objects[0].name = spec.objects[1].name = "a";
  spec.objects.pop_back();
  spec.objects[0].inflation = -0.1;
  CHECK(errorOf(spec) == "here: inflation of object a is -0.1 m, must be 0 to 10000");
  spec.objects[0].inflation = 0.;
  spec.objects[0].pose.R *= 2.;
  CHECK(errorOf(spec) == "here: pose of object a is not a rotation and a finite translation");
  spec.objects[0].pose = vpRigidTransform();
  spec.objects[0].velocity[4] = std::nan("");
  CHECK(errorOf(spec) == "here: velocity of object a is not finite or above 1000 m/s or rad/s");
  spec.objects[0].velocity = vpTwist();
  spec.objects[0].name.clear();
  CHECK(errorOf(spec) == "here: an object has no name");
  spec.objects.clear();
  spec.allowedLinks = {{1, 9}};
  CHECK(errorOf(spec) == "here: allowed pair of links 1 and 9, must be two of 0 to 7");
  spec.allowedLinks.clear();
  spec.allowedContacts = {{"b", 3}};
  CHECK(errorOf(spec) == "here: allowed contact with object b, which does not exist");
  spec.allowedContacts.clear();
  spec.ground = vpHalfSpace{Vector3d::Zero(), 0., 2};
  CHECK(errorOf(spec) == "here: ground has no normal");
  spec.ground.reset();
  vpArmSpec handed = amor().spec();
  handed.uncovered = {"hand", "finger"};
  spec.ignoredBodies = {"hand"};
  CHECK_THROWS_WITH(vpCollisionScene(vpArmModel(handed), spec),
                    Catch::Contains("here: body finger of ") && Catch::Contains("no capsule covers"));
  spec.ignoredBodies = {"finger", "hand"};
  CHECK_NOTHROW(vpCollisionScene(vpArmModel(handed), spec));
  spec.ignoredBodies = {"finger", "hand", "thumb"};
  CHECK_THROWS_WITH(vpCollisionScene(vpArmModel(handed), spec), Catch::Contains("ignored body thumb is not one of"));
  spec.ignoredBodies.clear();
  vpArmSpec bare = amor().spec();
  bare.capsules.clear();
  CHECK(errorOf(spec, vpArmModel(bare)).find("has 0 capsules, must have 1 to 128") != std::string::npos);
  vpCollisionScene scene(amor());
  CHECK_THROWS_WITH(scene.remove(0), Catch::Contains("there is no object 0 to remove, there are 0"));
  CHECK_FALSE(scene.moveObject(0, {}));
  CHECK_FALSE(scene.setVelocity(0, {}));
  CHECK_FALSE(scene.setInflation(-1, 0.));
  scene.add(object("a", vpCollisionShape::sphere(0.1)));
  vpRigidTransform nowhere;
  nowhere.p.x() = std::nan("");
  CHECK_FALSE(scene.moveObject(0, nowhere));
  CHECK_FALSE(scene.setInflation(0, -1.));
  CHECK(scene.object(0).pose.p.x() == 0.);
  CHECK_THROWS_WITH(vpCollisionShape::sphere(-1.), Catch::Contains("radius of the sphere is -1 m, must be > 0"));
  CHECK_THROWS_WITH(vpCollisionShape::box({1., 0., 1.}), Catch::Contains("size of the box along y is 0 m"));
  CHECK_THROWS_WITH(vpCollisionShape::cylinder(1., std::nan("")), Catch::Contains("length of the cylinder is"));
  CHECK_THROWS_WITH(vpCollisionShape::capsule(0., 1.), Catch::Contains("radius of the capsule is 0 m"));
  CHECK_THROWS_WITH(vpTriangleMesh({{0., 0., 0.}}, {{0, 0, 1}}, "m"),
                    Catch::Contains("m: triangle 0 uses vertex 1 of 1"));
  CHECK_THROWS_WITH(vpOctree({{{0., 0., 0.}, 0.}}, "t"), Catch::Contains("t: cell 0 has the size 0 m"));
}

TEST_CASE("Queries and moved objects do not allocate", "[scene]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("this build cannot count allocations");
    return;
  }
  auto rng = vpTestSupport::generator(15);
  vpCollisionSceneSpec spec = randomScene(rng, 8, 0.8);
  spec.objects.push_back(object("mesh", vpCollisionShape::mesh(tetrahedron(0.1)), pose(rng, 0.5)));
  spec.objects.push_back(object("map", vpCollisionShape::octree(vpOctree({{{0., 0.4, 0.2}, 0.1}}))));
  spec.ground = vpHalfSpace();
  vpCollisionScene scene(amor(), spec);
  vpCollisionData data;
  vpNearPairs near;
  const vpJointVector q = configuration(amor(), rng);
  const vpRigidTransform there = pose(rng, 0.5);
  double sum = 0.;
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 10; ++k) {
    scene.advance(0.01);
    sum += scene.moveObject(k, there) ? 1. : 0.;
    scene.place(q, data);
    sum += scene.clearance(data).distance + scene.clearance(data, 1., 0.5).distance;
    sum += scene.inCollision(data) ? 1. : 0.;
    scene.near(data, 0.5, near, 0.1);
    sum += near.count;
  }
  CHECK(vpTestSupport::allocationCount() == before);
  CHECK(std::isfinite(sum));
}
