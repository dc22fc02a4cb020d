/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpEdgeLanes.h"
#include "vpExactQuery.h"
#include "vpLinkHull.h"

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
constexpr int mostExact = 20000;   // the same for distances of exact shapes
constexpr double rounding = 1e-9;  // m, of exact distances

std::size_t at(int i) { return static_cast<std::size_t>(i); }

vpEdgeCapsule edgeCapsule(const vpArmCapsule &capsule)
{
  return {capsule.link, capsule.from, capsule.to, capsule.radius, 0.5 * (capsule.to - capsule.from).norm()};
}

// Bounds of a link's speed and acceleration per unit of s, seen from each link before it. Its own joint first: a joint
// before the others adds R |dq|, and turns all velocities behind it. dJ_j/dq_k is a cross product with the inner axis
// and as long as J of the outer one; a prismatic inner joint rotates nothing.
void boundLink(const vpArmModel &arm, const vpReachBounds &reach, int link, vpEdgeMotion &motion)
{
  vpEdgeBound bound;
  motion.bounds[at(link)][at(link)] = bound;
  for (int j = link - 1; j >= 0; --j) {
    const double dq = std::fabs(motion.change(j)), way = reach.ofChain(link, j) * dq;
    bound.acceleration += arm.chain(j).isPrismatic ? 0. : dq * (2. * bound.speed + way);
    bound.speed += way;
    motion.bounds[at(link)][at(j)] = bound;
  }
}

vpClearance clearanceOf(const vpCollisionScene &scene, const vpEdgePair &pair, const vpJointVector &q,
                        vpCollisionData &data)
{
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

// The pairs of a scene: those of two links or with the ground, those with objects, then the pairs that bounding capsules
// stand for.
struct PairList {
  std::vector<vpEdgeCapsule> capsules; // then the bounding ones of the hulls
  std::vector<vpEdgePair> pairs;
  std::vector<std::uint32_t> objects; // by object and hull
  std::vector<vpExactPair> exact;
  std::size_t withoutObjects = 0; // number of the first pairs

  void make(const vpCollisionScene &scene)
  {
    *this = PairList();
    for (int i = 0; i < scene.capsuleCount(); ++i) {
      capsules.push_back(edgeCapsule(scene.capsule(i)));
    }
    for (const vpLinkHull &hull : scene.hulls()) {
      capsules.push_back(edgeCapsule(hull.bound));
    }
    const int hulls = static_cast<int>(scene.hulls().size());
    for (const vpLinkPair &links : scene.linkPairs()) {
      const std::size_t first = m_fine.size();
      for (int k = links.begin; k < links.end; ++k) {
        const vpSelfPair &pair = scene.selfPairs()[at(k)];
        addFine(scene, vpCollisionKind::Self, pair.second, pair.first, scene.capsule(pair.first).link);
      }
      close(first, scene.capsuleCount() + links.second, scene.capsuleCount() + links.first);
    }
    for (int h = 0; h < hulls; ++h) {
      hullPairs(scene, h, vpCollisionKind::Ground, -1);
    }
    withoutObjects = pairs.size();
    for (int j = 0; j < scene.objectCount(); ++j) {
      for (int h = 0; h < hulls; ++h) {
        const std::size_t before = pairs.size();
        hullPairs(scene, h, vpCollisionKind::Object, j);
        objects.push_back(pairs.size() > before ? static_cast<std::uint32_t>(before) : vpEdgeObjects::unchecked);
      }
    }
    const std::size_t coarse = pairs.size();
    for (vpEdgePair &pair : pairs) {
      const auto shift = static_cast<std::uint32_t>(pair.begin < pair.end ? coarse : 0);
      pair.begin += shift;
      pair.end += shift;
    }
    pairs.insert(pairs.end(), m_fine.begin(), m_fine.end());
    m_fine.clear();
  }

private:
  void hullPairs(const vpCollisionScene &scene, int hull, vpCollisionKind kind, int other)
  {
    const std::size_t first = m_fine.size();
    for (const int i : scene.hulls()[at(hull)].capsules) {
      if (kind == vpCollisionKind::Object ? scene.isChecked(i, other) : scene.isCheckedWithGround(i)) {
        addFine(scene, kind, i, other, 0);
      }
    }
    close(first, scene.capsuleCount() + hull, other);
  }
  void addFine(const vpCollisionScene &scene, vpCollisionKind kind, int capsule, int other, int innerLink)
  {
    vpEdgePair pair;
    pair.kind = kind;
    pair.capsule = capsule;
    pair.other = other;
    pair.innerLink = innerLink;
    pair.exact = exactOf(vpExactQuery::pairOf(scene, kind, capsule, other));
    m_fine.push_back(pair);
  }
  int exactOf(const vpExactPair &pair)
  {
    if (pair.kind == vpCollisionKind::None) {
      return -1;
    }
    const auto known = std::find_if(exact.begin(), exact.end(), [&pair](const vpExactPair &e) {
      return e.kind == pair.kind && e.body == pair.body && e.other == pair.other;
    });
    const int index = static_cast<int>(known - exact.begin());
    if (known == exact.end()) {
      exact.push_back(pair);
    }
    return index;
  }
  // The fine pairs from first on have the same parts: a bounding pair stands for them, unless there is only one.
  void close(std::size_t first, int capsule, int other)
  {
    const std::size_t count = m_fine.size() - first;
    if (count == 0) {
      return;
    }
    vpEdgePair pair = m_fine[first];
    if (count == 1) {
      m_fine.pop_back();
      pairs.push_back(pair);
      return;
    }
    pair.capsule = capsule;
    pair.other = other;
    pair.exact = -1;
    pair.begin = static_cast<std::uint32_t>(first);
    pair.end = static_cast<std::uint32_t>(m_fine.size());
    pairs.push_back(pair);
  }

  std::vector<vpEdgePair> m_fine;
};
} // namespace

struct vpMotionScratch::Memory {
  const vpCollisionScene *scene = nullptr;
  unsigned long revision = 0;
  PairList all;
  // For every level of splitting: the pairs to evaluate, those of them that are open, and by pair where they are.
  struct Level {
    std::vector<std::uint32_t> list, open;
    std::vector<std::uint8_t> unproven, touched;
  };
  std::array<Level, maxDepth + 1> levels;
  std::vector<unsigned long> decided; // by exact pair: the last lane in which it decided
  unsigned long lanes = 0;
  vpEdgeObjects objects;
  vpEdgeMotion motion;
  vpJointVector jointsFrom, jointsChange; // of the joints; those of the motion include their followers
  const vpReachBounds *reach = nullptr;
  double resolution = 0.;
  double fastest = 0.; // Maximum of all links, per unit of s.
  int exactLooks = 0;
  bool describes = true; // the result has the pair
  vpExactQuery query;
  vpCollisionData data;
  vpMotionResult result;

  void fit(const vpCollisionScene &now)
  {
    scene = &now;
    if (revision == now.revision()) {
      return;
    }
    all.make(now);
    for (Level &level : levels) {
      level.list.resize(all.pairs.size());
      level.open.resize(all.pairs.size());
      level.unproven.assign(all.pairs.size(), 0);
      level.touched.assign(all.pairs.size(), 0);
    }
    decided.assign(all.exact.size(), 0);
    revision = now.revision();
  }

  void prepare(const vpCertifiedMotionSpec &spec, const vpReachBounds &bounds, const vpJointVector &from,
               const vpJointVector &to)
  {
    motion.arm = &scene->arm();
    motion.ground = scene->ground() ? &*scene->ground() : nullptr;
    motion.capsules = all.capsules.data();
    motion.cores = scene->objectCount() > 0 ? &scene->core(0) : nullptr;
    objects = {&scene->tree(), all.objects.data(), scene->capsuleCount(), static_cast<int>(scene->hulls().size())};
    motion.margin = spec.margin;
    jointsFrom = from;
    jointsChange = to - from;
    motion.from = scene->arm().coordinates(from);
    motion.change = scene->arm().changes(jointsChange);
    resolution = spec.resolution;
    reach = &bounds;
    exactLooks = 0;
    fastest = 0.;
    for (const vpLinkHull &hull : scene->hulls()) {
      boundLink(scene->arm(), bounds, hull.link, motion);
      fastest = std::max(fastest, motion.bounds[at(hull.link)][0].speed);
    }
  }

  bool stop(vpMotionStatus status, double s, const vpClearance &pair)
  {
    result.status = status;
    result.s = s;
    result.pair = pair;
    return false;
  }
  bool stop(vpMotionStatus status, double s, const vpEdgePair &pair)
  {
    return stop(status, s, describes ? clearanceOf(*scene, pair, jointsFrom + s * jointsChange, data) : vpClearance());
  }

  // Largest motion of the pair's exact shapes per unit of s, seen from the inner one.
  [[nodiscard]] double speedOf(const vpExactPair &pair) const
  {
    const int inner = pair.kind == vpCollisionKind::Self ? scene->capsule(pair.inner).link : 0;
    const double thickness = scene->exact()->thickness(pair.body);
    double speed = 0.;
    for (int j = inner; j < scene->capsule(pair.capsule).link; ++j) {
      const double R = reach->ofChain(scene->capsule(pair.capsule).link, j);
      speed += std::fabs(motion.change(j)) * (scene->arm().chain(j).isPrismatic ? R : R + thickness);
    }
    return speed;
  }

  // True if the exact pair is proven free from s = begin to end: at the middle, as far as its clearance reaches, then
  // on both sides of that.
  bool proveExact(const vpExactPair &pair, double speed, double begin, double end, bool inside)
  {
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin), need = half * speed;
    ++result.evaluated;
    ++exactLooks;
    scene->place(jointsFrom + middle * jointsChange, data);
    const double cutoff = motion.margin + need + 2. * rounding;
    const vpClearance now = query.clearance(*scene, data, pair, cutoff, inside);
    const double free = std::min(now.distance, cutoff) - motion.margin - rounding;
    if (!(now.distance > motion.margin)) {
      return stop(vpMotionStatus::Collision, middle, now);
    }
    if (free > need) {
      return true;
    }
    if (!(need >= resolution) || exactLooks >= mostExact) {
      return stop(vpMotionStatus::Undecided, middle, now);
    }
    const double reached = free > 0. ? 0.999 * half * free / need : 0.;
    return proveExact(pair, speed, begin, middle - reached, false) &&
           proveExact(pair, speed, middle + reached, end, false);
  }

  // True if all open pairs are proven free in a lane of an evaluation.
  bool proveLane(int depth, int lane, double start, double piece, int count)
  {
    Level &level = levels[at(depth)];
    const bool last = depth == maxDepth || !(0.5 * piece * fastest >= resolution) || result.evaluated >= mostLooks;
    const unsigned long now = ++lanes;
    int left = 0;
    for (int k = 0; k < count; ++k) {
      const std::uint32_t index = level.open[at(k)];
      const vpEdgePair &pair = all.pairs[index];
      if ((level.unproven[index] >> lane & 1) == 0) {
        continue;
      }
      if (pair.exact < 0 && last) {
        return stop(vpMotionStatus::Undecided, start + 0.5 * piece, pair);
      }
      if (pair.exact >= 0 && (last || (level.touched[index] >> lane & 1) != 0) && decided[at(pair.exact)] != now) {
        const vpExactPair &exact = all.exact[at(pair.exact)];
        if (!proveExact(exact, speedOf(exact), start, start + piece, true)) {
          return false;
        }
        decided[at(pair.exact)] = now;
      }
    }
    if (last) {
      return true;
    }
    for (int k = 0; k < count; ++k) {
      const std::uint32_t index = level.open[at(k)];
      const int exact = all.pairs[index].exact;
      if ((level.unproven[index] >> lane & 1) != 0 && (exact < 0 || decided[at(exact)] != now)) {
        levels[at(depth + 1)].list[at(left++)] = index;
      }
    }
    return left == 0 || prove(depth + 1, start, piece, left);
  }

  // True if the whole interval is proven free for the first count pairs of the list of this depth.
  bool prove(int depth, double start, double width, int count)
  {
    Level &level = levels[at(depth)];
    vpEdgeBatch batch;
    batch.objects = depth == 0 ? &objects : nullptr;
    batch.open = level.open.data();
    batch.unproven = level.unproven.data();
    batch.touched = level.touched.data();
    vpEvaluateEdge(motion, all.pairs.data(), level.list.data(), count, start, width, batch);
    result.evaluated += 8;
    const double piece = width / 8.;
    bool free = batch.hitPair < 0;
    if (!free) {
      stop(vpMotionStatus::Collision, start + (batch.hitLane + 0.5) * piece, all.pairs[at(batch.hitPair)]);
    }
    // The tightest first: a collision is most likely there.
    std::array<int, 8> order{0, 1, 2, 3, 4, 5, 6, 7};
    if (batch.count > 0 && free) {
      std::sort(order.begin(), order.end(), [&batch](int a, int b) { return batch.slack[a] < batch.slack[b]; });
    }
    for (std::size_t k = 0; k < order.size() && batch.count > 0 && free; ++k) {
      free = proveLane(depth, order[k], start + order[k] * piece, piece, batch.count);
    }
    for (int k = 0; k < batch.count; ++k) {
      level.unproven[level.open[at(k)]] = 0;
    }
    return free;
  }
};

vpMotionScratch::vpMotionScratch() : m_memory(std::make_unique<Memory>()) {}
vpMotionScratch::~vpMotionScratch() = default;
vpMotionScratch::vpMotionScratch(vpMotionScratch &&other) noexcept = default;
vpMotionScratch &vpMotionScratch::operator=(vpMotionScratch &&other) noexcept = default;

vpCertifiedMotion::vpCertifiedMotion(const vpCollisionScene &scene, const vpCertifiedMotionSpec &spec)
  : m_scene(&scene), m_spec(spec), m_reach(scene.reach())
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
  scratch.m_memory->describes = true;
  return prove(from, to, scratch);
}

bool vpCertifiedMotion::isFree(const vpJointVector &from, const vpJointVector &to, vpMotionScratch &scratch) const
{
  scratch.m_memory->describes = false;
  return prove(from, to, scratch).isFree();
}

const vpMotionResult &vpCertifiedMotion::prove(const vpJointVector &from, const vpJointVector &to,
                                               vpMotionScratch &scratch) const
{
  vpMotionScratch::Memory &memory = *scratch.m_memory;
  memory.result = vpMotionResult();
  if (!m_reach->holds(from) || !m_reach->holds(to)) {
    return memory.result;
  }
  memory.fit(*m_scene);
  memory.prepare(m_spec, *m_reach, from, to);
  const auto count = static_cast<long>(memory.all.withoutObjects);
  std::iota(memory.levels[0].list.begin(), memory.levels[0].list.begin() + count, std::uint32_t{0});
  if (memory.prove(0, 0., 1., static_cast<int>(count))) {
    memory.result.status = vpMotionStatus::Free;
  }
  return memory.result;
}

END_VISP_NAMESPACE
