/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// "Free" must be a proof: random motions in random scenes, checked at 10,000 positions by independent code.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/avoidance/vpDiscreteMotion.h>
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/core/vpException.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
struct Motion {
  vpJointVector from, to;
};

Motion motion(const vpArmModel &arm, std::mt19937_64 &rng)
{
  Motion m{configuration(arm, rng), configuration(arm, rng)};
  m.to = m.from + uniform(rng, 0.05, 1.) * (m.to - m.from);
  return m;
}

constexpr int recheckPoints = 10000;

// Least clearance along a motion, by a march that cannot miss anything at the step of 1/points but skips where the
// clearance, bounded by a crude speed in m per unit of sum |dq|, makes a collision impossible.
double recheck(const IndependentClearance &independent, const std::vector<vpSelfPair> &pairs, const Motion &m,
               double crude = 2.5)
{
  double least = 1.;
  const vpJointVector change = m.to - m.from;
  const double speed = crude * change.cwiseAbs().sum() + 1e-9;
  for (int k = 0; k <= recheckPoints;) {
    const vpJointVector q = m.from + static_cast<double>(k) / recheckPoints * change;
    const double clearance = independent.clearance(q, pairs, 0.2);
    least = std::min(least, clearance);
    k += std::max(1, static_cast<int>(0.5 * std::max(0., clearance) / speed * recheckPoints));
  }
  return least;
}
} // namespace

TEST_CASE("No point of a capsule is ever farther from an axis than the bound, and the bound is tight", "[reach]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel *arm : {&amor(), &mixed()}) {
    const vpReachBounds reach(*arm);
    const int m = static_cast<int>(arm->spec().capsules.size());
    std::vector<double> most(static_cast<std::size_t>(m * arm->size()), 0.);
    vpArmData data;
    for (int k = 0; k < 60000; ++k) {
      vpJointVector q = configuration(*arm, rng);
      for (int i = 0; i < arm->size(); ++i) {
        // Any angle: the bounds leave out limits of revolute joints. Straight and bent arms often.
        q(i) = arm->isPrismatic(i) ? (uniform(rng, 0., 1.) < 0.5 ? arm->lower()(i) : arm->upper()(i))
               : k % 2 == 0
                   ? uniform(rng, -pi, pi)
                   : 0.5 * pi * std::floor(uniform(rng, -2., 3.)) + 0.02 * uniform(rng, -1., 1.) - arm->chain(i).offset;
      }
      vpArmKinematics::forward(*arm, q, data);
      for (int i = 0; i < m; ++i) {
        const vpPlacedCapsule c = placed(*arm, data, i);
        for (int j = 0; j < arm->spec().capsules[static_cast<std::size_t>(i)].link; ++j) {
          const vpRigidTransform &joint = data.joint[static_cast<std::size_t>(j)];
          double &now = most[static_cast<std::size_t>(i * arm->size() + j)];
          for (const Vector3d &p : {c.from, c.to}) {
            now = std::max(now, arm->isPrismatic(j) ? 1. : joint.R.col(2).cross(p - joint.p).norm());
          }
        }
      }
    }
    double loosest = 0.;
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j < arm->size(); ++j) {
        CAPTURE(arm->label(), i, j);
        const double seen = most[static_cast<std::size_t>(i * arm->size() + j)];
        CHECK(seen <= reach(i, j) + 1e-12);
        if (j >= arm->spec().capsules[static_cast<std::size_t>(i)].link) {
          CHECK(reach(i, j) == 0.);
        }
        if (seen > 1e-9) {
          loosest = std::max(loosest, reach(i, j) / seen);
        }
      }
    }
    std::cout << arm->label() << ": reach bounds at most " << 100. * (loosest - 1.) << " % above what was seen\n";
    CHECK(loosest < (arm == &amor() ? 1.01 : 1.1));
  }
}

TEST_CASE("No point of an arm with followers moves farther than its bounds", "[reach]")
{
  auto rng = vpTestSupport::generator(6);
  CAPTURE(vpTestSupport::seed());
  double tightest = 1e9;
  for (int problem = 0; problem < vpTestSupport::longer(300); ++problem) {
    CAPTURE(problem);
    const vpArmModel arm = randomLinkedArm(rng);
    const vpReachBounds reach(arm);
    vpArmData a, b;
    for (int k = 0; k < 50; ++k) {
      const Motion m = motion(arm, rng);
      vpArmKinematics::forward(arm, m.from, a);
      vpArmKinematics::forward(arm, m.from + 0.01 * (m.to - m.from), b);
      for (int i = 0; i < arm.links(); ++i) {
        double bound = 0., byChain = 0.;
        for (int j = 0; j < arm.size(); ++j) {
          bound += reach(i, j) * std::fabs(0.01 * (m.to(j) - m.from(j)));
        }
        const vpJointVector all = arm.changes(0.01 * (m.to - m.from));
        for (int j = 0; j < arm.links(); ++j) {
          byChain += reach.ofChain(i + 1, j) * std::fabs(all(j));
        }
        REQUIRE(bound == Approx(byChain).margin(1e-12));
        const double way = (placed(arm, a, i).from - placed(arm, b, i).from).norm();
        REQUIRE(way <= bound + 1e-12);
        tightest = way > 0. ? std::min(tightest, bound / way) : tightest;
      }
      REQUIRE(reach.holds(m.from));
    }
    vpJointVector beyond = configuration(arm, rng);
    for (int k = 0; k < arm.links(); ++k) {
      if (arm.chain(k).isPrismatic) {
        const int j = arm.chain(k).joint;
        beyond(j) = arm.upper()(j) + 0.06 * (arm.upper()(j) - arm.lower()(j));
        CHECK_FALSE(reach.holds(beyond));
      }
    }
  }
  CHECK(tightest < 1.1);
}

TEST_CASE("Free motions of arms with followers stay free when rechecked", "[motion]")
{
  auto rng = vpTestSupport::generator(7);
  CAPTURE(vpTestSupport::seed());
  int free = 0, colliding = 0, undecided = 0, wrong = 0;
  vpMotionScratch scratch;
  for (int trial = 0; trial < vpTestSupport::longer(30); ++trial) {
    CAPTURE(trial);
    const vpArmModel arm = randomLinkedArm(rng);
    const vpCollisionSceneSpec spec = randomScene(rng, 8, 1.2);
    const vpCollisionScene scene(arm, spec);
    const vpCertifiedMotion certified(scene);
    const IndependentClearance independent(arm, spec);
    for (int k = 0; k < 20; ++k) {
      CAPTURE(k);
      const Motion m = motion(arm, rng);
      const vpMotionResult result = certified.check(m.from, m.to, scratch);
      if (result.isFree()) {
        ++free;
        wrong += recheck(independent, scene.selfPairs(), m, 30.) <= 0. ? 1 : 0;
      }
      else if (result.status == vpMotionStatus::Collision) {
        ++colliding;
        const vpJointVector q = m.from + result.s * (m.to - m.from);
        CHECK(independent.clearance(q, scene.selfPairs(), 0.1) <= 1e-8);
      }
      else {
        ++undecided;
      }
    }
  }
  std::cout << "with followers: " << free << " free, of which " << wrong << " collide when rechecked at 10,000 points, "
            << colliding << " collide, " << undecided << " undecided" << std::endl;
  CHECK(wrong == 0);
  CHECK(free > vpTestSupport::longer(30));
  CHECK(colliding > vpTestSupport::longer(30));
  CHECK(undecided < 20);
}

TEST_CASE("Free motions stay free when rechecked, and discrete checks do not", "[motion]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  int free = 0, colliding = 0, undecided = 0, wrong = 0, discreteFree = 0, discreteWrong = 0, missed = 0;
  long evaluated = 0;
  vpMotionScratch scratch;
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const vpArmModel &arm = trial % 3 == 2 ? mixed() : amor();
    vpCollisionSceneSpec spec = randomScene(rng, 12, 0.8);
    const vpCollisionScene scene(arm, spec);
    const vpCertifiedMotion certified(scene);
    vpSceneChecker checker(scene);
    vpDiscreteMotion discrete(checker, 0.1);
    const IndependentClearance independent(arm, spec);
    for (int k = 0; k < 50; ++k) {
      CAPTURE(k);
      const Motion m = motion(arm, rng);
      const vpMotionResult result = certified.check(m.from, m.to, scratch);
      REQUIRE(certified.isFree(m.from, m.to, scratch) == result.isFree());
      const vpMotionResult sampled = discrete.check(m.from, m.to);
      evaluated += result.evaluated;
      if (result.status == vpMotionStatus::Free) {
        ++free;
        wrong += recheck(independent, scene.selfPairs(), m) <= 0. ? 1 : 0;
        CHECK(sampled.isFree());
      }
      else if (result.status == vpMotionStatus::Collision) {
        ++colliding;
        const vpJointVector q = m.from + result.s * (m.to - m.from);
        CHECK(result.pair.distance <= 1e-9);
        CHECK(independent.clearance(q, scene.selfPairs(), 0.1) <= 1e-8);
      }
      else {
        ++undecided;
      }
      discreteFree += sampled.isFree() ? 1 : 0;
      discreteWrong += sampled.isFree() && !result.isFree() ? 1 : 0;
      missed += !sampled.isFree() && result.isFree() ? 1 : 0;
    }
  }
  std::cout << "certified: " << free << " free, of which " << wrong << " collide when rechecked at 10,000 points, "
            << colliding << " collide, " << undecided << " undecided, " << evaluated / 2000
            << " configurations a motion; discrete (0.1 rad): " << discreteFree << " free, of which " << discreteWrong
            << " are not" << std::endl;
  CHECK(wrong == 0);
  CHECK(missed == 0);
  CHECK(free > 500);
  CHECK(colliding > 500);
  CHECK(undecided < 10);
  CHECK(discreteWrong > 0);
}

TEST_CASE("Motions that graze: the margin is kept, and what collides by a hair is never free", "[motion]")
{
  auto rng = vpTestSupport::generator(3);
  CAPTURE(vpTestSupport::seed());
  vpMotionScratch scratch;
  int grazed = 0;
  for (int trial = 0; trial < 240; ++trial) {
    CAPTURE(trial);
    const vpArmModel &arm = trial % 3 == 2 ? mixed() : amor();
    const Motion m = motion(arm, rng);
    const int kind = trial < 60 ? trial % 6 : trial % 4; // Meshes and octrees take long here.
    // An obstacle placed such that the arm just touches it somewhere on the path: nearest approach by a fine search.
    const std::vector<vpOctreeCell> cells = {{{0., 0., 0.}, 0.1}, {{0.1, 0., 0.}, 0.1}};
    vpCollisionSceneSpec spec;
    vpCollisionObject one;
    one.name = "o";
    one.shape = kind < 4    ? primitive(rng, kind)
                : kind == 4 ? vpCollisionShape::mesh(tetrahedron(0.1))
                            : vpCollisionShape::octree(vpOctree(cells));
    one.pose = pose(rng, 0.8);
    one.pose.p.x() += trial % 4 == 1 ? 9. : 0.; // Then the arm grazes itself.
    spec.objects = {one};
    vpCollisionScene scene(arm, spec);
    vpCollisionData data;
    const auto clearanceAt = [&](double s) {
      scene.place(m.from + s * (m.to - m.from), data);
      double least = 1e9;
      for (int i = 0; i < scene.capsuleCount(); ++i) {
        least = scene.isChecked(i, 0) ? std::min(least, scene.pair(data, i, 0).distance) : least;
      }
      for (const vpSelfPair &pair : scene.selfPairs()) {
        least = std::min(least, scene.selfPair(data, pair.first, pair.second).distance);
      }
      return least;
    };
    double least = 1e9, place = 0.;
    for (int k = 0; k <= 2000; ++k) {
      const double now = clearanceAt(k / 2000.);
      if (now < least) {
        least = now;
        place = k / 2000.;
      }
    }
    if (least < 1e-3) {
      continue;
    }
    ++grazed;
    // Finer about the nearest place: the least clearance to 1e-9 or so.
    const double low = std::max(0., place - 1e-3), high = std::min(1., place + 1e-3);
    for (int k = 0; k <= 2000; ++k) {
      least = std::min(least, clearanceAt(low + k / 2000. * (high - low)));
    }
    for (const double excess : {1e-7, 1e-4, 1e-2}) {
      vpCertifiedMotionSpec margin;
      margin.margin = least + excess;
      CHECK_FALSE(vpCertifiedMotion(scene, margin).check(m.from, m.to, scratch).isFree());
    }
    // And the proof is not far from the truth.
    vpCertifiedMotionSpec margin;
    margin.margin = least - 1e-3;
    margin.resolution = 1e-6;
    CHECK(vpCertifiedMotion(scene, margin).check(m.from, m.to, scratch).isFree());
  }
  CHECK(grazed > 60);
}

TEST_CASE("Ground, self collisions and allowed pairs count along a motion", "[motion]")
{
  auto rng = vpTestSupport::generator(4);
  CAPTURE(vpTestSupport::seed());
  vpMotionScratch scratch;
  vpCollisionSceneSpec spec;
  spec.ground = vpHalfSpace{{0.2, 0.1, 1.}, -0.1, 2};
  int kinds[4] = {};
  for (const vpArmModel *arm : {&amor(), &mixed()}) {
    const vpCollisionScene scene(*arm, spec);
    const vpCertifiedMotion certified(scene);
    vpSceneChecker checker(scene);
    vpDiscreteMotion fine(checker, 1e-3);
    for (int k = 0; k < 300; ++k) {
      const Motion m = motion(*arm, rng);
      const vpMotionResult result = certified.check(m.from, m.to, scratch);
      if (result.isFree()) {
        CHECK(fine.check(m.from, m.to).isFree());
      }
      else if (result.status == vpMotionStatus::Collision) {
        vpSceneChecker at(scene);
        CHECK(at.inCollision(m.from + result.s * (m.to - m.from), 1e-9));
      }
      ++kinds[static_cast<int>(result.pair.kind)];
    }
  }
  const vpCollisionScene alone(amor());
  const vpCertifiedMotion certified(alone);
  vpSceneChecker checker(alone);
  vpDiscreteMotion fine(checker, 1e-3);
  for (int k = 0; k < 20000; ++k) { // one motion in 300 touches the arm itself
    const Motion m = motion(amor(), rng);
    const vpMotionResult result = certified.check(m.from, m.to, scratch);
    REQUIRE((result.isFree() || result.pair.kind == vpCollisionKind::Self));
    if (result.status == vpMotionStatus::Collision) {
      REQUIRE(checker.inCollision(m.from + result.s * (m.to - m.from), 1e-9));
    }
    else if (k % 20 == 0) {
      REQUIRE((!result.isFree() || fine.check(m.from, m.to).isFree()));
    }
    ++kinds[static_cast<int>(result.pair.kind)];
  }
  CHECK(kinds[static_cast<int>(vpCollisionKind::None)] > 20);
  CHECK(kinds[static_cast<int>(vpCollisionKind::Ground)] > 20);
  CHECK(kinds[static_cast<int>(vpCollisionKind::Self)] > 30); // 75 expected, less five deviations
}

TEST_CASE("Bad inputs, empty scenes, motions of length zero, scenes that change", "[motion]")
{
  vpCollisionScene scene(amor());
  const vpCertifiedMotion certified(scene);
  vpMotionScratch scratch;
  vpJointVector home(7);
  home << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
  CHECK(certified.check(home, home, scratch).isFree());
  vpJointVector broken = home;
  broken(3) = std::nan("");
  CHECK(certified.check(home, broken, scratch).status == vpMotionStatus::BadInput);
  CHECK(certified.check(home, vpJointVector::Zero(6), scratch).status == vpMotionStatus::BadInput);
  CHECK(std::string(certified.check(home, broken, scratch).message()) ==
        "a configuration has the wrong size, is not finite or is out of all range");
  vpJointVector away = home;
  away(0) += 1.;
  const bool before = certified.check(home, away, scratch).isFree();
  CHECK(before);
  vpCollisionObject wall;
  wall.name = "wall";
  wall.shape = vpCollisionShape::box({3., 3., 3.});
  scene.add(wall);
  const vpMotionResult inside = certified.check(home, away, scratch);
  CHECK(inside.status == vpMotionStatus::Collision);
  CHECK(scene.describe(inside.pair).find("object wall") != std::string::npos);
  REQUIRE(scene.moveObject(0, {Eigen::Matrix3d::Identity(), Vector3d(9., 0., 0.)}));
  CHECK(certified.check(home, away, scratch).isFree());
  vpCertifiedMotionSpec spec;
  spec.margin = -1.;
  CHECK_THROWS_WITH(vpCertifiedMotion(scene, spec), Catch::Contains("margin of the certified motion is -1 m"));
  spec.margin = 0.;
  spec.resolution = 0.;
  CHECK_THROWS_WITH(vpCertifiedMotion(scene, spec), Catch::Contains("resolution of the certified motion is 0 m"));
  vpSceneChecker checker(scene);
  CHECK_THROWS_WITH(vpDiscreteMotion(checker, 0.), Catch::Contains("step of the discrete motion is 0"));
  vpDiscreteMotion discrete(checker);
  CHECK(discrete.check(home, broken).status == vpMotionStatus::BadInput);
  CHECK(discrete.check(home, away).evaluated == 21);
}

TEST_CASE("A check does not allocate once its scratch fits", "[motion]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("this build cannot count allocations");
    return;
  }
  auto rng = vpTestSupport::generator(5);
  const vpCollisionScene scene(amor(), randomScene(rng, 6, 0.9));
  const vpCertifiedMotion certified(scene);
  vpMotionScratch scratch;
  Motion m = motion(amor(), rng);
  static_cast<void>(certified.check(m.from, m.to, scratch));
  for (int k = 0; k < 20; ++k) {
    m = motion(amor(), rng);
    const unsigned long before = vpTestSupport::allocationCount();
    static_cast<void>(certified.check(m.from, m.to, scratch));
    CHECK(vpTestSupport::allocationCount() == before);
  }
}
