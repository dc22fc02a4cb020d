/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpExactQuery.h"

#include <visp3/avoidance/vpExactChecker.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

vpExactPair vpExactQuery::pairOf(const vpCollisionScene &scene, vpCollisionKind kind, int capsule, int other)
{
  vpExactPair pair;
  const auto has = [&scene](int i) { return scene.exact() && scene.exact()->has(scene.capsule(i).body); };
  const bool self = kind == vpCollisionKind::Self;
  if (!has(capsule) || (self && !has(other))) {
    return pair;
  }
  pair.kind = kind;
  pair.body = scene.capsule(capsule).body;
  pair.other = self ? scene.capsule(other).body : other;
  pair.capsule = capsule;
  pair.inner = self ? other : -1;
  return pair;
}

vpExactChecker::vpExactChecker(const vpCollisionScene &scene)
  : m_scene(&scene), m_query(std::make_unique<vpExactQuery>())
{}

vpExactChecker::~vpExactChecker() = default;

// The least clearance below the cutoff of all pairs: of exact shapes where both parts have one, else of capsules.
vpClearance vpExactChecker::exactClearance(double cutoff)
{
  vpClearance best;
  best.distance = cutoff;
  const auto take = [&](vpCollisionKind kind, int capsule, int other, const vpClearance &covers) {
    if (!(covers.distance < best.distance)) {
      return;
    }
    const vpExactPair pair = vpExactQuery::pairOf(*m_scene, kind, capsule, other);
    const vpClearance now =
        pair.kind == vpCollisionKind::None ? covers : m_query->clearance(*m_scene, m_data, pair, best.distance, true);
    best = now.distance < best.distance ? now : best;
  };
  for (int i = 0; i < m_scene->capsuleCount(); ++i) {
    for (int j = 0; j < m_scene->objectCount(); ++j) {
      if (m_scene->isChecked(i, j)) {
        take(vpCollisionKind::Object, i, j, m_scene->pair(m_data, i, j));
      }
    }
    if (m_scene->isCheckedWithGround(i)) {
      take(vpCollisionKind::Ground, i, -1, m_scene->groundPair(m_data, i));
    }
  }
  for (const vpSelfPair &pair : m_scene->selfPairs()) {
    take(vpCollisionKind::Self, pair.second, pair.first, m_scene->selfPair(m_data, pair.first, pair.second));
  }
  if (best.kind == vpCollisionKind::None) {
    best.distance = std::numeric_limits<double>::infinity();
  }
  return best;
}

bool vpExactChecker::inCollision(const vpJointVector &q, double margin)
{
  m_scene->place(q, m_data);
  if (!m_scene->inCollision(m_data, margin)) {
    return false;
  }
  // A little above the margin: a pair exactly at it is in collision.
  return !m_scene->exact() || !m_data.placed || !std::isfinite(margin) ||
         !(exactClearance(std::nextafter(margin + 1e-12, HUGE_VAL)).distance > margin);
}

vpClearance vpExactChecker::clearance(const vpJointVector &q, double cutoff)
{
  m_scene->place(q, m_data);
  const vpClearance covers = m_scene->clearance(m_data, cutoff);
  return covers.kind == vpCollisionKind::None || covers.kind == vpCollisionKind::Unknown ? covers
                                                                                         : exactClearance(cutoff);
}

END_VISP_NAMESPACE
