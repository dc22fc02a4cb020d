/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Which capsules of an arm, and of its links and bodies, must not touch.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpSelfCollisionStatistics.h>
#include <visp3/core/vpException.h>

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
} // namespace

TEST_CASE("Which pairs are checked", "[scene]")
{
  // Capsules on links 1, 3, 5, 7.
  const vpCollisionScene scene(amor());
  REQUIRE(scene.selfPairs().size() == 3);
  CHECK(scene.selfPairs()[0].first == 0);
  CHECK(scene.selfPairs()[0].second == 2);
  vpCollisionSceneSpec spec;
  spec.allowAdjacent = false;
  CHECK(vpCollisionScene(amor(), spec).selfPairs().size() == 6);
  spec.allowedLinks = {{7, 1}};
  CHECK(vpCollisionScene(amor(), spec).selfPairs().size() == 5);
  // Two capsules on one link never meet; the base's capsule meets the arm but no object.
  spec = vpCollisionSceneSpec();
  spec.objects = {object("a", vpCollisionShape::sphere(0.1))};
  spec.allowedContacts = {{"a", 5}};
  const vpCollisionScene other(mixed(), spec);
  for (const vpSelfPair &pair : other.selfPairs()) {
    CHECK(other.capsule(pair.first).link < other.capsule(pair.second).link);
  }
  CHECK_FALSE(other.isChecked(0, 0));
  CHECK(other.isChecked(1, 0));
  CHECK_FALSE(other.isChecked(4, 0));
  CHECK_FALSE(other.isChecked(5, 0));
}

TEST_CASE("Links with a shape that no capsule covers count between others; bodies may be allowed", "[scene]")
{
  vpArmSpec spec = amor().spec(); // capsules on links 1, 3, 5, 7
  spec.bodies = {{"one", 1}, {"two", 2}, {"three", 3}, {"five", 5}, {"seven", 7}};
  for (std::size_t i = 0; i < 4; ++i) {
    spec.capsules[i].body = i == 0 ? 0 : static_cast<int>(i) + 1;
  }
  vpCollisionSceneSpec scene;
  CHECK(vpCollisionScene(vpArmModel(spec), scene).selfPairs().size() == 3);
  spec.uncovered = {"two"};
  scene.ignoredBodies = {"two"};
  CHECK(vpCollisionScene(vpArmModel(spec), scene).selfPairs().size() == 4); // (1, 3)
  spec.uncovered.clear();
  scene.ignoredBodies.clear();
  vpArmShape shape;
  shape.body = 1;
  shape.kind = vpArmShapeKind::Sphere;
  spec.shapes = {shape};
  CHECK(vpCollisionScene(vpArmModel(spec), scene).selfPairs().size() == 4);
  spec.allowedBodies = {{"seven", "one"}, {"one", "three"}, {"two", "three"}};
  const vpCollisionScene allowed(vpArmModel(spec), scene);
  REQUIRE(allowed.selfPairs().size() == 2);
  CHECK(allowed.capsule(allowed.selfPairs()[0].second).link == 5);
  CHECK(allowed.capsule(allowed.selfPairs()[1].first).link == 3);
}

TEST_CASE("An arm of 128 capsules has one pair for each link and object", "[pairs]")
{
  auto rng = vpTestSupport::generator(41);
  CAPTURE(vpTestSupport::seed());
  vpArmSpec spec = amor().spec();
  spec.capsules.clear();
  for (int k = 0; k < vpArmMaxCapsules; ++k) {
    spec.capsules.push_back({1 + k % 7, point(rng, 0.1), point(rng, 0.1), uniform(rng, 0.01, 0.05)});
  }
  const vpArmModel arm(spec);
  const vpCollisionScene scene(arm, randomScene(rng, 20, 0.9));
  vpCollisionData data;
  vpNearPairs near;
  for (int k = 0; k < 50; ++k) {
    scene.place(configuration(arm, rng), data);
    scene.near(data, 100., near);
    REQUIRE_FALSE(near.dropped);
    REQUIRE(near.count == 20 * 7 + 15); // of 21 pairs of links six are neighbours
    double least = 1e9;
    for (int j = 0; j < 20; ++j) {
      for (int i = 0; i < scene.capsuleCount(); ++i) {
        least = std::min(least, scene.pair(data, i, j).distance);
      }
    }
    for (const vpSelfPair &pair : scene.selfPairs()) {
      least = std::min(least, scene.selfPair(data, pair.first, pair.second).distance);
    }
    REQUIRE(scene.clearance(data).distance == Approx(least).margin(1e-12));
    REQUIRE(scene.inCollision(data, least + 1e-9));
    REQUIRE_FALSE(scene.inCollision(data, least - 1e-9));
  }
  spec.capsules.push_back(spec.capsules.back());
  CHECK_THROWS_WITH(vpCollisionScene(vpArmModel(spec)), Catch::Contains("has 129 capsules, must have 1 to 128"));
}
