/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What the queries of a scene do with the pairs that they visit.
#ifndef vpPairVisitors_h
#define vpPairVisitors_h

#include <visp3/avoidance/vpCollisionData.h>

#include <algorithm>
#include <array>

BEGIN_VISP_NAMESPACE

//! Largest motions of parts of a scene, m.
struct vpPartMotions {
  std::array<double, vpArmMaxJoints + 1> links{}; // By link, 0..n.
  double objects = 0.;                            // Of any object.
};

// Visitors of a query: they get the pairs below their cutoff and may stop. select() begins the pairs of a link with
// objects or the ground, or of two links; close() ends those of two parts.
struct vpAnyPair {
  double margin;
  static void select(int /*link*/, int /*other*/ = -1) noexcept {}
  static void close() noexcept {}
  bool found = false;
  // Slightly more, so that a contact exactly at the margin is still found.
  [[nodiscard]] double cutoff() const noexcept { return margin + 1e-12; }
  bool take(const vpClearance &pair) noexcept
  {
    found = !(pair.distance > margin);
    return found;
  }
};

struct vpLeastPair {
  vpClearance best;
  static void select(int /*link*/, int /*other*/ = -1) noexcept {}
  static void close() noexcept {}
  [[nodiscard]] double cutoff() const noexcept { return best.distance; }
  bool take(const vpClearance &pair) noexcept
  {
    if (pair.distance < best.distance) {
      best = pair;
    }
    return false;
  }
};

// Of the pairs between two calls of close() the least.
struct vpNearestPairs {
  vpNearPairs &list;
  double limit;
  double least;                         // limit of parts that do not move
  const vpPartMotions *moves = nullptr; // if given, added to it
  vpClearance best;
  vpNearestPairs(vpNearPairs &into, double cutoff, const vpPartMotions *motions = nullptr) noexcept
    : list(into), limit(cutoff), least(cutoff), moves(motions)
  {
    best.distance = cutoff;
  }
  void select(int link, int other = -1) noexcept
  {
    if (moves != nullptr) {
      limit = least + moves->links[static_cast<std::size_t>(link)] +
              (other < 0 ? moves->objects : moves->links[static_cast<std::size_t>(other)]);
      best.distance = limit;
    }
  }
  [[nodiscard]] double cutoff() const noexcept { return best.distance; }
  bool take(const vpClearance &pair) noexcept
  {
    if (pair.distance < best.distance) {
      best = pair;
    }
    return false;
  }
  void close() noexcept
  {
    if (best.kind != vpCollisionKind::None) {
      add();
      best = vpClearance();
      best.distance = limit;
    }
  }

private:
  void add() noexcept
  {
    if (list.count < vpNearPairs::capacity) {
      list.pairs[static_cast<std::size_t>(list.count++)] = best;
      return;
    }
    list.dropped = true;
    auto farthest =
        std::max_element(list.pairs.begin(), list.pairs.end(),
                         [](const vpClearance &a, const vpClearance &b) { return a.distance < b.distance; });
    if (best.distance < farthest->distance) {
      *farthest = best;
    }
  }
};

END_VISP_NAMESPACE
#endif
