/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Certified motions by the version for each kind of processor, of which a machine uses only one: all prove the same.
#include "../src/vpEdgeLanes.cpp" // not exported

#include "vpArmsOfTests.h"
#include "vpCatch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

// Of meshes and octrees, which all versions hand on.
vpNearestPoints vpCollisionCore::nearest(const Eigen::Vector3d &, const Eigen::Vector3d &, double) const noexcept
{
  std::abort();
}

namespace
{
using vpTestSupport::uniform;

std::vector<std::pair<const char *, Entry>> otherVersions()
{
  std::vector<std::pair<const char *, Entry>> versions = {{"chosen", chooseEntry()}};
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    versions.emplace_back("AVX2", evaluateAvx2);
  }
#endif
  return versions;
}

Eigen::Vector3d point(std::mt19937_64 &rng, double size)
{
  return {uniform(rng, -size, size), uniform(rng, -size, size), uniform(rng, -size, size)};
}

vpEdgeCapsule capsule(std::mt19937_64 &rng, int link)
{
  const Eigen::Vector3d from = point(rng, 0.2), to = point(rng, 0.2);
  return {link, from, to, uniform(rng, 0.01, 0.1), 0.5 * (to - from).norm()};
}

vpCollisionCore core(std::mt19937_64 &rng, vpShapeType type)
{
  vpCollisionCore c;
  c.type = type;
  c.radius = type == vpShapeType::Sphere || type == vpShapeType::Capsule ? uniform(rng, 0.01, 0.2) : 0.;
  if (type != vpShapeType::Sphere) {
    c.half = point(rng, 0.3).cwiseAbs();
  }
  c.bound = 1.5 * c.half.norm();
  vpRigidTransform pose;
  pose.R = Eigen::AngleAxisd(uniform(rng, -3., 3.), point(rng, 1.).normalized()).toRotationMatrix();
  pose.p = point(rng, 1.2);
  c.move(pose);
  return c;
}

struct Answer {
  double slack[8];
  unsigned int unproven, touched;
};

Answer answer(Entry entry, const vpEdgeMotion &motion, const vpEdgePair &pair, double start, double piece)
{
  std::uint32_t open = 0, list = 0;
  std::uint8_t unproven = 0, touched = 0;
  vpEdgeBatch batch;
  batch.open = &open;
  batch.unproven = &unproven;
  batch.touched = &touched;
  entry(motion, &pair, &list, 1, start, piece, batch);
  Answer a{{}, unproven, touched};
  std::copy_n(batch.slack, 8, a.slack);
  return a;
}
} // namespace

TEST_CASE("the versions for all processors prove the same", "[certified]")
{
  int proven = 0, unproven = 0;
  for (int problem = 0; problem < vpTestSupport::longer(400); ++problem) {
    std::mt19937_64 rng = vpTestSupport::generator(static_cast<unsigned int>(problem));
    const vpArmModel &arm = problem % 2 == 0 ? vpTestArms::amor() : vpTestArms::sixAxes();
    const int outer = std::uniform_int_distribution<int>(1, arm.size())(rng);
    const vpEdgeCapsule capsules[2] = {capsule(rng, outer),
                                       capsule(rng, std::uniform_int_distribution<int>(0, outer - 1)(rng))};
    const vpShapeType types[4] = {vpShapeType::Sphere, vpShapeType::Capsule, vpShapeType::Box, vpShapeType::Cylinder};
    const vpCollisionCore cores[1] = {core(rng, types[problem / 2 % 4])};
    vpHalfSpace ground;
    ground.normal = Eigen::Vector3d::UnitZ();
    ground.offset = uniform(rng, -0.5, 0.5);
    vpEdgeMotion motion;
    motion.arm = &arm;
    motion.ground = &ground;
    motion.capsules = capsules;
    motion.cores = cores;
    motion.margin = uniform(rng, 0., 0.05);
    motion.from = vpTestArms::configuration(arm, rng);
    motion.change = vpTestArms::randomVector(arm.size(), rng);
    motion.change *= std::pow(10., uniform(rng, -2., 0.));
    for (auto &row : motion.bounds) {
      std::generate(row.begin(), row.end(), [&rng] { return vpEdgeBound{uniform(rng, 0., 3.), uniform(rng, 0., 3.)}; });
    }
    const double piece = std::pow(10., uniform(rng, -3., -1.)), start = uniform(rng, 0., 1. - 8. * piece);
    for (const vpCollisionKind kind : {vpCollisionKind::Object, vpCollisionKind::Self, vpCollisionKind::Ground}) {
      vpEdgePair pair;
      pair.kind = kind;
      pair.other = kind == vpCollisionKind::Self ? 1 : 0;
      pair.innerLink = kind == vpCollisionKind::Self ? capsules[1].link : 0;
      pair.exact = 0; // all lanes are evaluated
      const double radii = motion.margin + capsules[0].radius +
                           (kind == vpCollisionKind::Self     ? capsules[1].radius
                            : kind == vpCollisionKind::Object ? cores[0].radius
                                                              : 0.);
      const Answer base = answer(evaluateBaseline, motion, pair, start, piece);
      for (const auto &[name, entry] : otherVersions()) {
        const Answer other = answer(entry, motion, pair, start, piece);
        for (unsigned int l = 0; l < 8; ++l) {
          CAPTURE(problem, static_cast<int>(kind), name, l, base.slack[l], other.slack[l]);
          const bool free = (base.unproven >> l & 1U) == 0;
          (free ? proven : unproven) += 1;
          REQUIRE(free == (base.slack[l] > rounding));
          // Lanes that are proven together by bounding spheres have less slack than the pair. Where the axis is inside the
          // core there is no normal, and the slack is any number below -radii.
          const bool same = kind == vpCollisionKind::Ground || base.slack[l] <= rounding;
          const bool inside = std::fmax(base.slack[l], other.slack[l]) < -0.9 * radii;
          REQUIRE((!same || inside || std::fabs(base.slack[l] - other.slack[l]) < 1e-10));
          if (std::fabs(base.slack[l] - rounding) > 1e-10) {
            REQUIRE((other.unproven >> l & 1U) == (base.unproven >> l & 1U));
            REQUIRE((other.touched >> l & 1U) == (base.touched >> l & 1U));
          }
        }
      }
    }
  }
  CHECK(proven > unproven / 10);
  CHECK(unproven > proven / 10);
}

TEST_CASE("an object is found by its box, and where a number is NaN it is not called free", "[certified]")
{
  const vpArmModel &arm = vpTestArms::amor();
  const vpEdgeCapsule capsules[1] = {{1, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), 0.05, 0.5}};
  std::vector<vpEdgePair> pairs(1);
  pairs[0].kind = vpCollisionKind::Object;
  const std::uint32_t index = 0;
  for (const bool isNear : {true, false}) {
    for (const double joint : {0.1, std::nan("")}) {
      std::vector<vpCollisionCore> cores(1);
      cores[0].radius = isNear ? 3. : 0.1;
      vpRigidTransform pose;
      pose.p.x() = isNear ? 0. : 5.;
      cores[0].move(pose);
      std::vector<vpObjectNode> tree(1);
      tree[0].box =
          Eigen::AlignedBox3d(cores[0].centre.array() - cores[0].radius, cores[0].centre.array() + cores[0].radius);
      const vpEdgeObjects objects = {&tree, &index, 0, 1};
      vpEdgeMotion motion;
      motion.arm = &arm;
      motion.capsules = capsules;
      motion.cores = cores.data();
      motion.from = vpJointVector::Constant(arm.size(), joint);
      motion.change = vpJointVector::Constant(arm.size(), 0.01);
      std::vector<std::pair<const char *, Entry>> versions = otherVersions();
      versions.emplace_back("baseline", evaluateBaseline);
      for (const auto &[name, entry] : versions) {
        CAPTURE(isNear, joint, name);
        std::uint32_t open = 0;
        std::uint8_t unproven = 0, touched = 0;
        vpEdgeBatch batch;
        batch.objects = &objects;
        batch.open = &open;
        batch.unproven = &unproven;
        batch.touched = &touched;
        entry(motion, pairs.data(), nullptr, 0, 0., 0.125, batch);
        CHECK((batch.count > 0) == (isNear || std::isnan(joint)));
      }
    }
  }
}
