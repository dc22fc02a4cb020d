/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/avoidance/vpCertifiedTrajectory.h>

#include "vpLinkHull.h"
#include "vpObjectTree.h"
#include "vpPairVisitors.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr int deepest = 40;        // halvings; the resolution ends the search long before
constexpr double rounding = 1e-9;  // m, of distances
constexpr double longest = 1e6;    // s: largest time of a plan
constexpr double largestWay = 1e9; // rad or m, of a joint in an interval: implausible beyond

} // namespace

vpCertifiedTrajectory::vpCertifiedTrajectory(const vpCollisionScene &scene, const vpCertifiedMotionSpec &spec)
  : m_scene(&scene), m_spec(spec), m_reach(scene.reach())
{
  if (!(spec.margin >= 0.) || !std::isfinite(spec.margin)) {
    throw vpException(vpException::badValue, "margin of the certified trajectory is %g m, must be >= 0 and finite",
                      spec.margin);
  }
  if (!(spec.resolution > 0.) || !std::isfinite(spec.resolution)) {
    throw vpException(vpException::badValue, "resolution of the certified trajectory is %g m, must be > 0 and finite",
                      spec.resolution);
  }
  m_acceleration.setZero(scene.arm().size());
  m_speed = m_kink = m_jump = m_acceleration;
}

void vpCertifiedTrajectory::setMargin(double margin) noexcept
{
  m_spec.margin = margin >= 0. && std::isfinite(margin) ? margin : 0.;
}

// Computes the motion bounds between evaluations; false if a number is not finite.
bool vpCertifiedTrajectory::study(const vpTrajectoryPlan &plan) noexcept
{
  for (int j = 0; j < plan.axes(); ++j) {
    const vpAxisState goal = plan.at(j, plan.duration(j));
    m_acceleration(j) = std::fabs(goal[2]);
    m_speed(j) = std::max(std::fabs(goal[1]), std::fabs(plan.at(j, 2. * longest)[1]));
    m_kink(j) = m_jump(j) = 0.;
    double next = goal[1], x = goal[0]; // velocity and position at the start of the next segment
    for (int i = plan.segments(j) - 1; i >= 0; --i) {
      const vpTrajectorySegment &s = plan.segment(j, i);
      double sum = s.begin + s.duration; // not finite if any term is not
      for (int k = 0; k <= s.p.degree(); ++k) {
        sum += std::fabs(s.p[k]);
      }
      if (!std::isfinite(sum) || !(s.duration > 0.)) {
        return false;
      }
      const auto begin = s.p.jet(0.), end = s.p.jet(1.);
      const double rate = 1. / s.duration;
      if (s.p.degree() <= 2) { // both are largest at an end
        m_speed(j) = std::max({m_speed(j), rate * std::fabs(begin[1]), rate * std::fabs(end[1])});
        m_acceleration(j) = std::max(m_acceleration(j), rate * rate * std::fabs(end[2]));
      }
      else {
        const vpPolynomial v = s.p.derivative();
        m_speed(j) = std::max(m_speed(j), rate * v.range().peak());
        m_acceleration(j) = std::max(m_acceleration(j), rate * rate * v.derivative().range().peak());
      }
      m_kink(j) += std::fabs(next - end[1] * rate);
      m_jump(j) += std::fabs(x - end[0]);
      next = begin[1] * rate;
      x = begin[0];
    }
    if (!std::isfinite(m_acceleration(j) + m_speed(j) + m_kink(j) + m_jump(j) + std::fabs(goal[0]))) {
      return false;
    }
  }
  return true;
}

vpCertifiedTrajectory::Verdict vpCertifiedTrajectory::look(const vpTrajectoryPlan &plan, double middle, double half,
                                                           double objectTime, vpTrajectoryClearance &result) noexcept
{
  const int n = m_scene->arm().size();
  vpJointVector q(n), way(n);
  for (int j = 0; j < n; ++j) {
    const vpAxisState x = plan.at(j, middle);
    q(j) = x[0];
    const double braked = std::fabs(x[1]) + m_kink(j) + 0.5 * m_acceleration(j) * half;
    way(j) = std::min(braked, m_speed(j)) * half + m_jump(j);
  }
  const bool inRange = m_reach->holds(q, way);
  if ((!inRange && !m_reach->holds(q)) || !(way.array() <= largestWay).all()) {
    return Verdict::Bad;
  }
  vpPartMotions motions;
  motions.objects = half * vpFastestObject(m_scene->tree());
  double farthest = 0.;
  for (const vpLinkHull &hull : m_scene->hulls()) {
    double sum = 0.;
    for (int j = 0; j < n; ++j) {
      sum += m_reach->ofLink(hull.link, j) * way(j);
    }
    motions.links[static_cast<std::size_t>(hull.link)] = sum;
    farthest = std::max(farthest, sum);
  }
  m_largest = farthest + std::max(farthest, motions.objects);
  m_scene->place(q, m_data);
  m_scene->near(m_data, m_spec.margin + 2. * rounding, &motions, m_near, objectTime);
  ++result.evaluated;
  Verdict verdict = m_near.dropped || !inRange ? Verdict::Split : Verdict::Free;
  for (int k = 0; k < m_near.count; ++k) {
    const vpClearance &pair = m_near.pairs[static_cast<std::size_t>(k)];
    // Of a link and an object, or of two links, it is the least: it proves the others, too.
    const auto motionOfLink = [this, &motions](int i) {
      return motions.links[static_cast<std::size_t>(m_scene->capsule(i).link)];
    };
    double moves = motionOfLink(pair.capsule);
    moves += pair.kind == vpCollisionKind::Self ? motionOfLink(pair.other)
             : pair.kind == vpCollisionKind::Object
                 ? half * m_scene->tree()[static_cast<std::size_t>(pair.other)].fastest
                 : 0.;
    result.least = std::min(result.least, pair.distance);
    if (!(pair.distance > m_spec.margin)) {
      result.pair = pair;
      return Verdict::Collision;
    }
    if (!(pair.distance > m_spec.margin + moves + rounding)) {
      result.pair = pair;
      verdict = Verdict::Split;
    }
  }
  return verdict;
}

vpTrajectoryClearance vpCertifiedTrajectory::check(const vpTrajectoryPlan &plan, double from, double to,
                                                   double age) noexcept
{
  return search(plan, from, to, age, true, mostLooks);
}

vpTrajectoryClearance vpCertifiedTrajectory::verdict(const vpTrajectoryPlan &plan, double from, double to, double age,
                                                     int looks) noexcept
{
  return search(plan, from, to, age, false, looks);
}

vpTrajectoryClearance vpCertifiedTrajectory::search(const vpTrajectoryPlan &plan, double from, double to, double age,
                                                    bool first, int looks) noexcept
{
  vpTrajectoryClearance result;
  result.least = std::numeric_limits<double>::infinity();
  if (plan.axes() != m_scene->arm().size() || !(std::fabs(from) <= longest) || !(std::fabs(to) <= longest) ||
      !(std::fabs(age) <= longest) || from > to || !study(plan)) {
    return result;
  }
  // Depth first from the start on: everything before the reported time is proven free.
  struct Part {
    double middle, half;
  };
  std::array<Part, deepest + 2> open; // one pending half per halving
  open[0] = {0.5 * (from + to), 0.5 * (to - from)};
  int count = 1;
  bool collides = false;
  while (count > 0) {
    const Part part = open[static_cast<std::size_t>(--count)];
    if (result.evaluated >= looks) {
      result.status = collides ? vpMotionStatus::Collision : vpMotionStatus::Undecided;
      result.time = part.middle - part.half;
      return result;
    }
    const Verdict verdict = look(plan, part.middle, part.half, part.middle - from + age, result);
    if (verdict == Verdict::Free) {
      continue;
    }
    if (verdict == Verdict::Bad) {
      result.status = vpMotionStatus::BadInput;
      result.time = part.middle;
      return result;
    }
    collides = collides || verdict == Verdict::Collision;
    if (collides && !first) {
      result.status = vpMotionStatus::Collision;
      result.time = part.middle;
      return result;
    }
    if (m_largest < m_spec.resolution || count + 2 > deepest) {
      result.status = collides ? vpMotionStatus::Collision : vpMotionStatus::Undecided;
      result.time = part.middle - part.half;
      return result;
    }
    const double half = 0.5 * part.half;
    if (verdict == Verdict::Collision) {
      count = 0; // later intervals are irrelevant
    }
    else {
      open[static_cast<std::size_t>(count++)] = {part.middle + half, half};
    }
    open[static_cast<std::size_t>(count++)] = {part.middle - half, half};
  }
  result.status = vpMotionStatus::Free;
  return result;
}

END_VISP_NAMESPACE
