/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpEdgeLanes.h"

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

BEGIN_VISP_NAMESPACE

namespace
{
// 8^-14 of the motion: below the resolution of doubles.
constexpr int maxDepth = 14;
constexpr int mostLooks = 8000000; // a motion that needs more is undecided

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Joints first..last - 1 move the capsule: bounds of its speed and acceleration per unit of s.
void bound(const vpCollisionScene &scene, const vpReachBounds &reach, const vpJointVector &change, int first,
           vpEdgePair &pair)
{
  const int last = scene.capsule(pair.capsule).link;
  pair.speed = pair.acceleration = 0.;
  double inner = 0.; // Sum of |dq| of the revolute joints before this one.
  for (int j = first; j < last; ++j) {
    const double R = reach(pair.capsule, j), dq = std::fabs(change(j));
    const bool revolute = !scene.arm().isPrismatic(j);
    pair.speed += R * dq;
    // dJ_j/dq_k is a cross product with the inner axis and as long as J of the outer one; a prismatic inner joint
    // rotates nothing.
    pair.acceleration += R * dq * (2. * inner + (revolute ? dq : 0.));
    inner += revolute ? dq : 0.;
  }
}

vpEdgePair pairOf(vpCollisionKind kind, int capsule, int other)
{
  vpEdgePair pair;
  pair.kind = kind;
  pair.capsule = capsule;
  pair.other = other;
  return pair;
}

// Updates what may have changed since the last motion: objects move.
void refresh(const vpCollisionScene &scene, double margin, vpEdgePair &pair)
{
  const auto halfLength = [&scene](int i) { return 0.5 * (scene.capsule(i).to - scene.capsule(i).from).norm(); };
  pair.radii = scene.capsule(pair.capsule).radius + margin;
  double cores = halfLength(pair.capsule);
  if (pair.kind == vpCollisionKind::Object) {
    pair.core = &scene.core(pair.other);
    pair.radii += pair.core->radius;
    cores += pair.core->bound;
  }
  else if (pair.kind == vpCollisionKind::Self) {
    pair.innerLink = scene.capsule(pair.other).link;
    pair.radii += scene.capsule(pair.other).radius;
    cores += halfLength(pair.other);
  }
  pair.bounds = cores + pair.radii;
}

std::vector<vpEdgePair> pairsOf(const vpCollisionScene &scene)
{
  std::vector<vpEdgePair> pairs;
  for (int j = 0; j < scene.objectCount(); ++j) {
    for (int i = 0; i < scene.capsuleCount(); ++i) {
      if (scene.isChecked(i, j)) {
        pairs.push_back(pairOf(vpCollisionKind::Object, i, j));
      }
    }
  }
  for (const vpSelfPair &pair : scene.selfPairs()) {
    pairs.push_back(pairOf(vpCollisionKind::Self, pair.second, pair.first));
  }
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    if (scene.isCheckedWithGround(i)) {
      pairs.push_back(pairOf(vpCollisionKind::Ground, i, -1));
    }
  }
  return pairs;
}

vpClearance clearanceOf(const vpCollisionScene &scene, const vpEdgePair &pair, const vpJointVector &q)
{
  vpCollisionData data;
  scene.place(q, data);
  switch (pair.kind) {
  case vpCollisionKind::Object:
    return scene.pair(data, pair.capsule, pair.other);
  case vpCollisionKind::Self:
    return scene.selfPair(data, pair.other, pair.capsule);
  default:
    return scene.groundPair(data, pair.capsule);
  }
}
} // namespace

struct vpMotionScratch::Memory {
  const vpCollisionScene *scene = nullptr;
  unsigned long revision = 0;
  std::vector<vpEdgePair> pairs;
  // For every level of splitting: the remaining pairs, and where they are unproven.
  std::array<std::vector<std::uint32_t>, maxDepth + 1> lists;
  std::array<std::vector<std::uint8_t>, maxDepth + 1> unproven;
  vpEdgeMotion motion;
  double resolution = 0.;
  double fastest = 0.; // Maximum of all pairs, per unit of s.
  vpMotionResult result;

  void fit(const vpCollisionScene &now)
  {
    scene = &now;
    if (revision == now.revision()) {
      return;
    }
    pairs = pairsOf(now);
    for (std::size_t depth = 0; depth <= maxDepth; ++depth) {
      lists[depth].resize(pairs.size());
      unproven[depth].resize(pairs.size());
    }
    revision = now.revision();
  }

  void stop(vpMotionStatus status, const vpEdgePair &pair, double s)
  {
    result.status = status;
    result.s = s;
    const vpJointVector q = motion.from + s * motion.change;
    result.pair = clearanceOf(*scene, pair, q);
  }

  // True if the whole interval is proven free for the first count pairs of the list of this depth.
  bool prove(int depth, double start, double width, int count)
  {
    const std::uint32_t *list = lists[at(depth)].data();
    std::uint8_t *open = unproven[at(depth)].data();
    vpEdgeBatch batch;
    vpEvaluateEdge(motion, pairs.data(), list, count, start, width, open, batch);
    result.evaluated += 8;
    const double piece = width / 8.;
    if (batch.hitPair >= 0) {
      stop(vpMotionStatus::Collision, pairs[list[batch.hitPair]], start + (batch.hitLane + 0.5) * piece);
      return false;
    }
    // The tightest first: a collision is most likely there.
    std::array<int, 8> order;
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&batch](int a, int b) { return batch.slack[a] < batch.slack[b]; });
    for (const int lane : order) {
      std::uint32_t *next = depth < maxDepth ? lists[at(depth + 1)].data() : nullptr;
      int left = 0;
      for (int k = 0; k < count; ++k) {
        if ((open[k] >> lane & 1) == 0) {
          continue;
        }
        if (!next || !(0.5 * piece * fastest >= resolution) || result.evaluated >= mostLooks) {
          stop(vpMotionStatus::Undecided, pairs[list[k]], start + (lane + 0.5) * piece);
          return false;
        }
        next[left++] = list[k];
      }
      if (left > 0 && !prove(depth + 1, start + lane * piece, piece, left)) {
        return false;
      }
    }
    return true;
  }
};

vpMotionScratch::vpMotionScratch() : m_memory(std::make_unique<Memory>()) {}
vpMotionScratch::~vpMotionScratch() = default;
vpMotionScratch::vpMotionScratch(vpMotionScratch &&other) noexcept = default;
vpMotionScratch &vpMotionScratch::operator=(vpMotionScratch &&other) noexcept = default;

vpCertifiedMotion::vpCertifiedMotion(const vpCollisionScene &scene, const vpCertifiedMotionSpec &spec)
  : m_scene(&scene), m_spec(spec), m_reach(scene.arm())
{
  if (!std::isfinite(spec.margin) || !(spec.margin >= 0.)) {
    throw vpException(vpException::badValue, "margin of the certified motion is %g m, must be >= 0 and finite",
                      spec.margin);
  }
  if (!std::isfinite(spec.resolution) || !(spec.resolution > 0.)) {
    throw vpException(vpException::badValue, "resolution of the certified motion is %g m, must be > 0 and finite",
                      spec.resolution);
  }
}

vpMotionResult vpCertifiedMotion::check(const vpJointVector &from, const vpJointVector &to,
                                        vpMotionScratch &scratch) const
{
  vpMotionScratch::Memory &memory = *scratch.m_memory;
  memory.result = vpMotionResult();
  if (!m_reach.holds(from) || !m_reach.holds(to)) {
    return memory.result;
  }
  memory.fit(*m_scene);
  memory.motion.scene = m_scene;
  memory.motion.ground = m_scene->ground() ? &*m_scene->ground() : nullptr;
  memory.motion.from = from;
  memory.motion.change = to - from;
  memory.resolution = m_spec.resolution;
  memory.fastest = 0.;
  for (vpEdgePair &pair : memory.pairs) {
    refresh(*m_scene, m_spec.margin, pair);
    bound(*m_scene, m_reach, memory.motion.change, pair.innerLink, pair);
    memory.fastest = std::max(memory.fastest, pair.speed);
  }
  std::iota(memory.lists[0].begin(), memory.lists[0].end(), std::uint32_t{0});
  if (memory.prove(0, 0., 1., static_cast<int>(memory.pairs.size()))) {
    memory.result.status = vpMotionStatus::Free;
  }
  return memory.result;
}

END_VISP_NAMESPACE
