/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpLinkHull.h"

#include "vpSegmentNearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

BEGIN_VISP_NAMESPACE

namespace
{
std::size_t at(int i) { return static_cast<std::size_t>(i); }

using Capsules = std::vector<vpArmCapsule>;
using Links = std::array<bool, vpArmMaxJoints + 1>;

// Radius about the segment that encloses the capsules: a point's distance from it is largest at an end of an axis.
double radiusAbout(const Eigen::Vector3d &from, const Eigen::Vector3d &to, const Capsules &all, const vpLinkHull &hull)
{
  double most = 0.;
  for (const int i : hull.capsules) {
    for (const Eigen::Vector3d &p : {all[at(i)].from, all[at(i)].to}) {
      most = std::max(most, vpSegmentNearest::point(from, to, p).distance + all[at(i)].radius);
    }
  }
  return most;
}

// The one of least volume whose ends are ends or centres of the given ones: reach bounds of their axes hold for its
// axis.
void boundCapsules(const Capsules &all, vpLinkHull &hull)
{
  std::vector<Eigen::Vector3d> ends;
  for (const int i : hull.capsules) {
    const vpArmCapsule &c = all[at(i)];
    ends.insert(ends.end(), {c.from, c.to, 0.5 * (c.from + c.to)});
  }
  double least = std::numeric_limits<double>::infinity();
  const std::size_t step = 1 + ends.size() / 48; // of many capsules some ends
  for (std::size_t i = 0; i < ends.size(); i += step) {
    for (std::size_t k = i; k < ends.size(); k += step) {
      const double r = radiusAbout(ends[i], ends[k], all, hull);
      const double volume = r * r * ((ends[i] - ends[k]).norm() + 4. / 3. * r);
      if (volume < least) {
        least = volume;
        hull.bound.from = ends[i];
        hull.bound.to = ends[k];
        hull.bound.radius = r;
      }
    }
  }
  hull.bound.link = hull.link;
  hull.bound.radius *= 1. + 1e-12; // of the distances' rounding
  hull.centre = 0.5 * (hull.bound.from + hull.bound.to);
  hull.radius = (1. + 1e-12) * radiusAbout(hull.centre, hull.centre, all, hull);
}

// Links that have a shape, whether capsules cover it or not.
Links linksWithShape(const vpArmModel &arm)
{
  Links has{};
  const vpArmSpec &spec = arm.spec();
  for (const vpArmCapsule &capsule : spec.capsules) {
    has[at(capsule.link)] = true;
  }
  for (const vpArmShape &shape : spec.shapes) {
    has[at(spec.bodies[at(shape.body)].link)] = true;
  }
  for (const vpArmBody &body : spec.bodies) {
    const auto found = std::find(spec.uncovered.begin(), spec.uncovered.end(), body.name);
    has[at(body.link)] = has[at(body.link)] || found != spec.uncovered.end();
  }
  return has;
}

// Pairs of bodies that need no check, each in both orders.
std::set<std::pair<int, int>> allowedBodies(const vpArmSpec &spec)
{
  std::set<std::pair<int, int>> allowed;
  const auto index = [&spec](const std::string &name) {
    const auto found = std::find_if(spec.bodies.begin(), spec.bodies.end(),
                                    [&name](const vpArmBody &body) { return body.name == name; });
    return static_cast<int>(found - spec.bodies.begin());
  };
  for (const auto &pair : spec.allowedBodies) {
    const int a = index(pair.first), b = index(pair.second);
    allowed.insert({a, b});
    allowed.insert({b, a});
  }
  return allowed;
}
} // namespace

std::vector<vpLinkHull> vpFindHulls(const std::vector<vpArmCapsule> &capsules)
{
  std::vector<vpLinkHull> hulls;
  for (int link = 0; link <= vpArmMaxJoints; ++link) {
    vpLinkHull hull;
    hull.link = link;
    for (std::size_t i = 0; i < capsules.size(); ++i) {
      if (capsules[i].link == link) {
        hull.capsules.push_back(static_cast<int>(i));
      }
    }
    if (!hull.capsules.empty()) {
      boundCapsules(capsules, hull);
      hulls.push_back(hull);
    }
  }
  return hulls;
}

std::vector<vpLinkPair> vpFindPairs(const vpArmModel &arm, const vpCollisionSceneSpec &spec,
                                    const std::vector<vpLinkHull> &hulls, std::vector<vpSelfPair> &pairs)
{
  const Links shaped = linksWithShape(arm);
  const std::set<std::pair<int, int>> allowed = allowedBodies(arm.spec());
  const Capsules &capsules = arm.spec().capsules;
  const auto mayTouch = [&](int low, int high) {
    const auto isPair = [low, high](const std::pair<int, int> &p) {
      return std::min(p.first, p.second) == low && std::max(p.first, p.second) == high;
    };
    const bool neighbours = std::none_of(shaped.begin() + low + 1, shaped.begin() + high, [](bool has) { return has; });
    return (spec.allowAdjacent && neighbours) ||
           std::any_of(spec.allowedLinks.begin(), spec.allowedLinks.end(), isPair);
  };
  std::vector<vpLinkPair> links;
  for (int a = 0; a < static_cast<int>(hulls.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(hulls.size()); ++b) {
      if (mayTouch(hulls[at(a)].link, hulls[at(b)].link)) {
        continue;
      }
      vpLinkPair link{a, b, static_cast<int>(pairs.size()), 0};
      for (const int i : hulls[at(a)].capsules) {
        for (const int k : hulls[at(b)].capsules) {
          if (allowed.count({capsules[at(i)].body, capsules[at(k)].body}) == 0) {
            pairs.push_back({i, k});
          }
        }
      }
      link.end = static_cast<int>(pairs.size());
      if (link.end > link.begin) {
        links.push_back(link);
      }
    }
  }
  return links;
}

END_VISP_NAMESPACE
