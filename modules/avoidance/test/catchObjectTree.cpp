/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Among many objects a scene looks at those near the arm only. That changes no answer, whatever was moved before.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"

#include <visp3/avoidance/vpCertifiedMotion.h>

#include <map>

using namespace vpAvoidanceTestKit;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

vpTwist randomTwist(std::mt19937_64 &rng)
{
  const Vector3d v = point(rng, 0.5), w = point(rng, 2.);
  return vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
}

// Primitives, meshes off their origin and maps, a third of them moving.
vpCollisionObject randomObject(std::mt19937_64 &rng, int number)
{
  vpCollisionObject object;
  object.name = "o" + std::to_string(number);
  object.pose = pose(rng, 1.2);
  object.inflation = number % 5 == 0 ? uniform(rng, 0., 0.03) : 0.;
  if (number % 3 == 0) {
    object.velocity = randomTwist(rng);
  }
  if (number % 17 == 0) {
    object.shape = vpCollisionShape::mesh(tetrahedron(uniform(rng, 0.02, 0.1)));
  }
  else if (number % 23 == 0) {
    object.shape = vpCollisionShape::octree(vpOctree({{{0.2, 0., 0.1}, 0.05}, {{0.2, 0.1, 0.1}, 0.05}}));
  }
  else {
    object.shape = primitive(rng, number);
  }
  return object;
}

vpCollisionScene manyObjects(const vpArmModel &arm, std::mt19937_64 &rng, int count)
{
  vpCollisionSceneSpec spec;
  for (int j = 0; j < count; ++j) {
    spec.objects.push_back(randomObject(rng, j));
  }
  spec.allowedContacts = {{"o1", 5}, {"o3", 3}};
  return vpCollisionScene(arm, spec);
}

// One random change of any kind; the first objects stay, since contacts with them are allowed.
void change(vpCollisionScene &scene, std::mt19937_64 &rng, int number)
{
  const int j = std::uniform_int_distribution<int>(0, scene.objectCount() - 1)(rng);
  switch (std::uniform_int_distribution<int>(0, 5)(rng)) {
  case 0:
    scene.add(randomObject(rng, 1000 + number));
    break;
  case 1:
    if (j > 3) {
      scene.remove(j);
    }
    break;
  case 2:
    REQUIRE(scene.moveObject(j, pose(rng, 1.2)));
    break;
  case 3:
    REQUIRE(scene.setVelocity(j, randomTwist(rng)));
    break;
  case 4:
    REQUIRE(scene.setInflation(j, uniform(rng, 0., 0.1)));
    break;
  default:
    REQUIRE(scene.advance(uniform(rng, 0., 0.5)));
    break;
  }
}

// Least clearance of every link and object, pair by pair.
std::map<std::pair<int, int>, double> leastOfAll(const vpCollisionScene &scene, const vpCollisionData &data,
                                                 double time)
{
  std::map<std::pair<int, int>, double> least;
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    for (int j = 0; scene.capsule(i).link > 0 && j < scene.objectCount(); ++j) {
      if (scene.isChecked(i, j)) {
        const double distance = scene.pair(data, i, j, time).distance;
        const auto known = least.emplace(std::pair(scene.capsule(i).link, j), distance).first;
        known->second = std::min(known->second, distance);
      }
    }
  }
  return least;
}
} // namespace

TEST_CASE("Among many objects queries are those of all pairs, after any change", "[tree]")
{
  auto rng = vpTestSupport::generator(31);
  CAPTURE(vpTestSupport::seed());
  int near = 0, collisions = 0, objects = 0;
  for (int trial = 0; trial < vpTestSupport::longer(40); ++trial) {
    const vpArmModel &arm = trial % 2 == 0 ? amor() : mixed();
    vpCollisionScene scene = manyObjects(arm, rng, 4 + 3 * trial % 150);
    for (int number = 0; number < 20; ++number) {
      CAPTURE(trial, number);
      change(scene, rng, number);
      const vpCollisionScene copy(scene);
      vpCollisionData data;
      scene.place(configuration(arm, rng), data);
      const double time = number % 2 == 0 ? 0. : uniform(rng, -0.7, 0.7), cutoff = uniform(rng, -0.05, 0.3);
      const auto all = leastOfAll(scene, data, time);
      double truth = infinity, self = infinity;
      for (const auto &[parts, distance] : all) {
        truth = std::min(truth, distance);
      }
      for (const vpSelfPair &pair : scene.selfPairs()) {
        self = std::min(self, scene.selfPair(data, pair.first, pair.second).distance);
      }
      const double both = std::min(truth, self);
      CHECK(copy.clearance(data, infinity, time).distance == Approx(both).margin(1e-12));
      CHECK(scene.inCollision(data, both + 1e-9, time));
      CHECK_FALSE(scene.inCollision(data, both - 1e-9, time));
      vpNearPairs list;
      copy.near(data, cutoff, list, time);
      int found = 0;
      for (int k = 0; k < list.count; ++k) {
        const vpClearance &pair = list.pairs[static_cast<std::size_t>(k)];
        if (pair.kind == vpCollisionKind::Object) {
          ++found;
          CHECK(pair.distance == Approx(all.at({scene.capsule(pair.capsule).link, pair.other})).margin(1e-12));
        }
      }
      const auto count =
          std::count_if(all.begin(), all.end(), [cutoff](const auto &one) { return one.second < cutoff; });
      CHECK((list.dropped || found == count));
      near += found;
      collisions += truth <= 0. ? 1 : 0;
      objects += scene.objectCount();
    }
  }
  CHECK(near > objects / 40);
  CHECK(collisions > vpTestSupport::longer(40));
}

TEST_CASE("A motion among many objects is free exactly if it is free among each of them", "[tree]")
{
  auto rng = vpTestSupport::generator(32);
  CAPTURE(vpTestSupport::seed());
  int free = 0, colliding = 0;
  for (int trial = 0; trial < vpTestSupport::longer(12); ++trial) {
    const vpArmModel &arm = trial % 2 == 0 ? amor() : mixed();
    vpCollisionScene scene = manyObjects(arm, rng, 5 + 6 * trial % 60);
    vpMotionScratch scratch;
    for (int number = 0; number < 12; ++number) {
      CAPTURE(trial, number);
      change(scene, rng, number);
      const vpJointVector from = configuration(arm, rng);
      const vpJointVector to = from + std::pow(10., uniform(rng, -2., 0.)) * (configuration(arm, rng) - from);
      const double margin = uniform(rng, 0., 0.02);
      const vpMotionStatus status = vpCertifiedMotion(scene, {margin}).check(from, to, scratch).status;
      bool each = true;
      for (int j = 0; j < scene.objectCount(); ++j) {
        vpCollisionSceneSpec spec;
        spec.objects = {scene.object(j)};
        for (int link = 1; link <= arm.links(); ++link) { // as in the scene
          for (int i = 0; i < scene.capsuleCount(); ++i) {
            if (scene.capsule(i).link == link && !scene.isChecked(i, j)) {
              spec.allowedContacts.push_back({scene.object(j).name, link});
              break;
            }
          }
        }
        vpMotionScratch own;
        each = vpCertifiedMotion(vpCollisionScene(arm, spec), {margin}).check(from, to, own).isFree() && each;
      }
      CHECK((status == vpMotionStatus::Free) == each);
      free += each ? 1 : 0;
      colliding += status == vpMotionStatus::Collision ? 1 : 0;
      // A box that is too small would be so among one object, too.
      vpCollisionData data;
      for (int k = 0; each && k <= 200; ++k) {
        scene.place(from + k / 200. * (to - from), data);
        for (const auto &[parts, distance] : leastOfAll(scene, data, 0.)) {
          REQUIRE(distance > margin);
        }
      }
    }
  }
  CHECK(free > vpTestSupport::longer(12));
  CHECK(2 * colliding > vpTestSupport::longer(12));
}
