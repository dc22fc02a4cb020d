/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCollisionCore.h"
#include "vpLinkHull.h"
#include "vpObjectTree.h"
#include "vpPairVisitors.h"
#include "vpPlausible.h"
#include "vpSceneCheck.h"

#include <visp3/avoidance/vpCollisionScene.h>

#include <algorithm>
#include <atomic>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Unlike an address it is never reused for another scene.
unsigned long nextRevision()
{
  static std::atomic<unsigned long> last{0};
  return ++last;
}

constexpr double longest = 1e6; // s: largest prediction time

// In the moving frame of the joint that carries the link.
std::vector<vpArmCapsule> placedOnJoints(const vpArmModel &arm)
{
  std::vector<vpArmCapsule> capsules = arm.spec().capsules;
  for (vpArmCapsule &capsule : capsules) {
    if (capsule.link > 0) {
      const vpRigidTransform &after = arm.chain(capsule.link - 1).after;
      capsule.from = after.R * capsule.from + after.p;
      capsule.to = after.R * capsule.to + after.p;
    }
  }
  return capsules;
}

vpClearance selfClearance(const vpCollisionData &data, int first, int second, double cutoff)
{
  vpClearance clearance = vpSelfClearance(data.capsules[at(first)], data.capsules[at(second)], cutoff);
  clearance.capsule = first;
  clearance.other = second;
  return clearance;
}

vpClearance unknownClearance() noexcept
{
  vpClearance clearance;
  clearance.distance = -std::numeric_limits<double>::infinity();
  clearance.kind = vpCollisionKind::Unknown;
  return clearance;
}

// True if the input is valid; otherwise every query reports a collision.
bool isKnown(const vpCollisionData &data, double cutoff, double time) noexcept
{
  return data.placed && std::fabs(time) <= longest && cutoff == cutoff;
}

// |a - b| - radii > cutoff, without a square root.
bool areApart(const Eigen::Vector3d &a, const Eigen::Vector3d &b, double radii, double cutoff) noexcept
{
  const double reach = cutoff + radii;
  return reach < 0. || (a - b).squaredNorm() > reach * reach;
}
} // namespace

struct vpCollisionScene::Links {
  std::vector<vpLinkHull> hulls;
  std::vector<vpLinkPair> pairs;
};

vpCollisionScene::vpCollisionScene(const vpArmModel &arm, const vpCollisionSceneSpec &spec)
  : m_arm(arm), m_source(spec.source), m_capsules(placedOnJoints(arm)), m_exact(spec.exact),
    m_contacts(spec.allowedContacts)
{
  m_revision = nextRevision();
  vpCheckArm(arm, spec);
  auto links = std::make_shared<Links>();
  links->hulls = vpFindHulls(m_capsules);
  links->pairs = vpFindPairs(arm, spec, links->hulls, m_selfPairs);
  m_links = links;
  m_ground = spec.ground;
  if (m_ground) {
    m_ground->normal.normalize();
  }
  for (const vpCollisionObject &object : spec.objects) {
    append(object);
  }
  vpBuildObjectTree(m_cores, m_objects, m_tree);
  for (const vpAllowedContact &contact : m_contacts) {
    if (find(contact.object) < 0) {
      vpSceneFail(m_source, "allowed contact with object " + contact.object + ", which does not exist");
    }
  }
}

vpCollisionScene::vpCollisionScene(const vpCollisionScene &other) = default;
vpCollisionScene::vpCollisionScene(vpCollisionScene &&other) noexcept = default;
vpCollisionScene &vpCollisionScene::operator=(const vpCollisionScene &other) = default;
vpCollisionScene &vpCollisionScene::operator=(vpCollisionScene &&other) noexcept = default;
vpCollisionScene::~vpCollisionScene() = default;

const vpCollisionCore &vpCollisionScene::core(int i) const noexcept { return m_cores[at(i)]; }
const std::vector<vpObjectNode> &vpCollisionScene::tree() const noexcept { return m_tree; }
const std::vector<vpLinkHull> &vpCollisionScene::hulls() const noexcept { return m_links->hulls; }
const std::vector<vpLinkPair> &vpCollisionScene::linkPairs() const noexcept { return m_links->pairs; }

std::shared_ptr<const vpReachBounds> vpCollisionScene::reach() const { return m_arm.derived<vpReachBounds>(); }

int vpCollisionScene::find(const std::string &name) const noexcept
{
  for (std::size_t i = 0; i < m_objects.size(); ++i) {
    if (m_objects[i].name == name) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

bool vpCollisionScene::isChecked(int capsule, int object) const noexcept
{
  return (m_checked[at(object)] >> m_capsules[at(capsule)].link & 1U) != 0;
}

bool vpCollisionScene::isCheckedWithGround(int capsule) const noexcept
{
  return m_ground && m_capsules[at(capsule)].link >= m_ground->firstLink;
}

int vpCollisionScene::add(const vpCollisionObject &object)
{
  append(object);
  vpBuildObjectTree(m_cores, m_objects, m_tree);
  m_revision = nextRevision();
  return objectCount() - 1;
}

void vpCollisionScene::append(const vpCollisionObject &object)
{
  vpCheckObject(m_source, object);
  if (find(object.name) >= 0) {
    vpSceneFail(m_source, "object " + object.name + ": duplicate name");
  }
  std::uint32_t checked = 0;
  for (int link = 1; link <= m_arm.links(); ++link) {
    const bool allowed = std::any_of(m_contacts.begin(), m_contacts.end(), [&](const vpAllowedContact &contact) {
      return contact.object == object.name && contact.link == link;
    });
    checked |= allowed ? 0U : 1U << link;
  }
  m_objects.push_back(object);
  m_cores.emplace_back(object);
  m_checked.push_back(checked);
}

void vpCollisionScene::remove(int i)
{
  if (i < 0 || i >= objectCount()) {
    vpSceneFail(m_source,
                "there is no object " + std::to_string(i) + " to remove, there are " + std::to_string(objectCount()));
  }
  m_objects.erase(m_objects.begin() + i);
  m_cores.erase(m_cores.begin() + i);
  m_checked.erase(m_checked.begin() + i);
  vpBuildObjectTree(m_cores, m_objects, m_tree);
  m_revision = nextRevision();
}

bool vpCollisionScene::moveObject(int i, const vpRigidTransform &pose) noexcept
{
  if (i < 0 || i >= objectCount() || !vpIsPlace(pose)) {
    return false;
  }
  m_objects[at(i)].pose = pose;
  m_cores[at(i)].move(pose);
  vpFitObject(i, m_cores[at(i)], m_objects[at(i)].velocity, m_tree);
  return true;
}

bool vpCollisionScene::setVelocity(int i, const vpTwist &velocity) noexcept
{
  if (i < 0 || i >= objectCount() || !vpIsPlausible(velocity)) {
    return false;
  }
  m_objects[at(i)].velocity = velocity;
  vpFitObject(i, m_cores[at(i)], velocity, m_tree);
  return true;
}

bool vpCollisionScene::setInflation(int i, double inflation) noexcept
{
  if (i < 0 || i >= objectCount() || !vpIsLength(inflation)) {
    return false;
  }
  m_cores[at(i)].radius += inflation - m_objects[at(i)].inflation;
  m_objects[at(i)].inflation = inflation;
  vpFitObject(i, m_cores[at(i)], m_objects[at(i)].velocity, m_tree);
  return true;
}

bool vpCollisionScene::advance(double dt) noexcept
{
  bool all = true;
  for (int i = 0; i < objectCount(); ++i) {
    all = moveObject(i, m_objects[at(i)].poseAt(dt)) && all;
  }
  return all;
}

void vpCollisionScene::place(const vpJointVector &q, vpCollisionData &data) const noexcept
{
  data.placed = q.size() == m_arm.size() && (m_arm.coordinates(q).cwiseAbs().array() <= vpLargestCoordinate).all();
  if (!data.placed) {
    return;
  }
  vpArmKinematics::forward(m_arm, q, data.arm);
  for (std::size_t i = 0; i < m_capsules.size(); ++i) {
    const vpArmCapsule &from = m_capsules[i];
    vpPlacedCapsule &to = data.capsules[i];
    to.from = from.from;
    to.to = from.to;
    if (from.link > 0) {
      const vpRigidTransform &joint = data.arm.joint[at(from.link - 1)];
      to.from = joint.R * from.from + joint.p;
      to.to = joint.R * from.to + joint.p;
    }
    to.centre = 0.5 * (to.from + to.to);
    to.halfLength = 0.5 * (from.to - from.from).norm();
    to.radius = from.radius;
  }
  for (const vpLinkHull &hull : m_links->hulls) {
    Eigen::Vector3d &centre = data.centres[at(hull.link)];
    centre = hull.centre;
    if (hull.link > 0) {
      const vpRigidTransform &joint = data.arm.joint[at(hull.link - 1)];
      centre = joint.R * hull.centre + joint.p;
    }
  }
}

// Visits every pair that must not touch and is not surely farther apart than the visitor's cutoff; close() ends those
// of a link and an object, of two links, or of a link and the ground.
template <class Visit>
void vpCollisionScene::visit(const vpCollisionData &data, double time, Visit &visitor) const noexcept
{
  for (const vpLinkHull &hull : m_links->hulls) {
    visitor.select(hull.link);
    if (hull.link > 0 && visitObjects(data, hull, time, visitor)) {
      return;
    }
  }
  for (const vpLinkPair &links : m_links->pairs) {
    const vpLinkHull &first = m_links->hulls[at(links.first)], &second = m_links->hulls[at(links.second)];
    visitor.select(first.link, second.link);
    if (areApart(data.centres[at(first.link)], data.centres[at(second.link)], first.radius + second.radius,
                 visitor.cutoff())) {
      continue;
    }
    for (int k = links.begin; k < links.end; ++k) {
      const vpSelfPair &pair = m_selfPairs[at(k)];
      const vpPlacedCapsule &a = data.capsules[at(pair.first)], &b = data.capsules[at(pair.second)];
      const double radii = a.halfLength + a.radius + b.halfLength + b.radius;
      if (!areApart(a.centre, b.centre, radii, visitor.cutoff()) &&
          visitor.take(selfClearance(data, pair.first, pair.second, visitor.cutoff()))) {
        return;
      }
    }
    visitor.close();
  }
  for (const vpLinkHull &hull : m_links->hulls) {
    visitor.select(hull.link);
    for (const int i : hull.capsules) {
      if (isCheckedWithGround(i) && visitor.take(groundPair(data, i))) {
        return;
      }
    }
    visitor.close();
  }
}

template <class Visit>
bool vpCollisionScene::visitObjects(const vpCollisionData &data, const vpLinkHull &hull, double time,
                                    Visit &visitor) const noexcept
{
  Eigen::AlignedBox3d box;
  for (const int i : hull.capsules) {
    const vpPlacedCapsule &c = data.capsules[at(i)];
    const Eigen::Vector3d radius = Eigen::Vector3d::Constant(c.radius);
    box.extend(c.from.cwiseMin(c.to) - radius).extend(c.from.cwiseMax(c.to) + radius);
  }
  vpObjectSearch search(m_tree, box, time);
  for (int j = search.next(visitor.cutoff()); j >= 0; j = search.next(visitor.cutoff())) {
    if ((m_checked[at(j)] >> hull.link & 1U) == 0) {
      continue;
    }
    if (time == 0.) {
      if (visitObject(data, hull, j, m_cores[at(j)], visitor)) {
        return true;
      }
      continue;
    }
    vpCollisionCore moved = m_cores[at(j)];
    moved.move(m_objects[at(j)].poseAt(time));
    if (visitObject(data, hull, j, moved, visitor)) {
      return true;
    }
  }
  return false;
}

template <class Visit>
bool vpCollisionScene::visitObject(const vpCollisionData &data, const vpLinkHull &hull, int j,
                                   const vpCollisionCore &core, Visit &visitor) const noexcept
{
  if (areApart(data.centres[at(hull.link)], core.centre, hull.radius + core.bound + core.radius, visitor.cutoff())) {
    return false;
  }
  // The one with the nearest centre first: it rules out most others.
  const std::size_t count = hull.capsules.size();
  std::size_t first = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; count > 1 && k < count; ++k) {
    const double square = (data.capsules[at(hull.capsules[k])].centre - core.centre).squaredNorm();
    first = square < least ? k : first;
    least = std::min(least, square);
  }
  for (std::size_t k = 0; k < count; ++k) {
    const int i = hull.capsules[first + k < count ? first + k : first + k - count];
    const vpPlacedCapsule &c = data.capsules[at(i)];
    const double radii = c.halfLength + c.radius + core.bound + core.radius;
    if (areApart(c.centre, core.centre, radii, visitor.cutoff())) {
      continue;
    }
    vpClearance pair = core.clearance(c, visitor.cutoff());
    pair.capsule = i;
    pair.other = j;
    if (visitor.take(pair)) {
      return true;
    }
  }
  visitor.close();
  return false;
}

bool vpCollisionScene::inCollision(const vpCollisionData &data, double margin, double time) const noexcept
{
  if (!isKnown(data, margin, time)) {
    return true;
  }
  vpAnyPair any{margin};
  visit(data, time, any);
  return any.found;
}

vpClearance vpCollisionScene::clearance(const vpCollisionData &data, double cutoff, double time) const noexcept
{
  if (!isKnown(data, cutoff, time)) {
    return unknownClearance();
  }
  vpLeastPair least;
  least.best.distance = cutoff;
  visit(data, time, least);
  if (least.best.kind == vpCollisionKind::None) {
    least.best.distance = std::numeric_limits<double>::infinity();
  }
  return least.best;
}

void vpCollisionScene::near(const vpCollisionData &data, double cutoff, vpNearPairs &result, double time) const noexcept
{
  near(data, cutoff, nullptr, result, time);
}

void vpCollisionScene::near(const vpCollisionData &data, double cutoff, const vpPartMotions *motions,
                            vpNearPairs &result, double time) const noexcept
{
  result.count = 0;
  result.dropped = !isKnown(data, cutoff, time);
  if (!result.dropped) {
    vpNearestPairs nearest(result, cutoff, motions);
    visit(data, time, nearest);
  }
}

vpClearance vpCollisionScene::pair(const vpCollisionData &data, int capsule, int object, double time) const noexcept
{
  if (!isKnown(data, 0., time)) {
    return unknownClearance();
  }
  vpCollisionCore core = m_cores[at(object)];
  core.move(m_objects[at(object)].poseAt(time));
  vpClearance clearance = core.clearance(data.capsules[at(capsule)], std::numeric_limits<double>::infinity());
  clearance.capsule = capsule;
  clearance.other = object;
  return clearance;
}

vpClearance vpCollisionScene::selfPair(const vpCollisionData &data, int first, int second) const noexcept
{
  return data.placed ? selfClearance(data, first, second, std::numeric_limits<double>::infinity()) : unknownClearance();
}

vpClearance vpCollisionScene::groundPair(const vpCollisionData &data, int capsule) const noexcept
{
  if (!data.placed) {
    return unknownClearance();
  }
  vpClearance clearance = vpGroundClearance(*m_ground, data.capsules[at(capsule)]);
  clearance.capsule = capsule;
  return clearance;
}

std::string vpCollisionScene::describe(const vpClearance &pair) const
{
  if (pair.kind == vpCollisionKind::None) {
    return "nothing near";
  }
  if (pair.kind == vpCollisionKind::Unknown) {
    return "numbers that are not finite or out of all range";
  }
  const auto link = [this](int capsule) {
    const vpArmCapsule &of = m_capsules[at(capsule)];
    return of.body < 0 ? "link " + std::to_string(of.link) : m_arm.spec().bodies[at(of.body)].name;
  };
  const std::string first = link(pair.capsule) + " and ";
  if (pair.kind == vpCollisionKind::Ground) {
    return first + "the ground";
  }
  return first + (pair.kind == vpCollisionKind::Self ? link(pair.other) : "object " + m_objects[at(pair.other)].name);
}

END_VISP_NAMESPACE
