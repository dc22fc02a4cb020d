/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCollisionCore.h"
#include "vpPlausible.h"
#include "vpPrintable.h"

#include <visp3/avoidance/vpCollisionScene.h>
#include <visp3/core/vpException.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <sstream>

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

[[noreturn]] void fail(const std::string &source, const std::string &sentence)
{
  // Names may come from a file.
  throw vpException(vpException::badValue, vpPrintable((source.empty() ? "scene" : source) + ": " + sentence));
}

std::string text(double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

constexpr double fastest = 1e3; // m/s or rad/s: largest plausible object velocity
constexpr double longest = 1e6; // s: largest prediction time

// Written such that NaN is rejected, here and below.
bool isPlausible(const vpTwist &velocity)
{
  return std::all_of(velocity.data(), velocity.data() + 6, [](double v) { return std::fabs(v) <= fastest; });
}

bool isLength(double value) { return value >= 0. && value <= vpLargestLength; }

void checkObject(const std::string &source, const vpCollisionObject &object)
{
  if (object.name.empty()) {
    fail(source, "an object has no name");
  }
  if (!vpIsRigid(object.pose)) {
    fail(source, "pose of object " + object.name + " is not a rotation and a finite translation");
  }
  if (!vpIsPlace(object.pose)) {
    fail(source, "object " + object.name + " is " + text(object.pose.p.cwiseAbs().maxCoeff()) +
                     " m away, must be within " + text(vpLargestLength) + " m");
  }
  if (!isPlausible(object.velocity)) {
    fail(source, "velocity of object " + object.name + " is not finite or above " + text(fastest) + " m/s or rad/s");
  }
  if (!isLength(object.inflation)) {
    fail(source, "inflation of object " + object.name + " is " + text(object.inflation) + " m, must be 0 to " +
                     text(vpLargestLength));
  }
}

// In the moving frame of the joint that carries the link.
std::vector<vpArmCapsule> placedOnJoints(const vpArmModel &arm)
{
  std::vector<vpArmCapsule> capsules = arm.spec().capsules;
  for (vpArmCapsule &capsule : capsules) {
    if (capsule.link > 0) {
      const vpRigidTransform &after = arm.spec().joints[at(capsule.link - 1)].after;
      capsule.from = after.R * capsule.from + after.p;
      capsule.to = after.R * capsule.to + after.p;
    }
  }
  return capsules;
}

bool areAdjacent(const std::vector<vpArmCapsule> &capsules, int low, int high)
{
  return std::none_of(capsules.begin(), capsules.end(),
                      [low, high](const vpArmCapsule &c) { return c.link > low && c.link < high; });
}

std::vector<vpSelfPair> findSelfPairs(const std::vector<vpArmCapsule> &capsules, const vpCollisionSceneSpec &spec)
{
  std::vector<vpSelfPair> pairs;
  const int m = static_cast<int>(capsules.size());
  for (int i = 0; i < m; ++i) {
    for (int k = 0; k < m; ++k) {
      const int low = capsules[at(i)].link, high = capsules[at(k)].link;
      const auto isPair = [low, high](const std::pair<int, int> &p) {
        return std::min(p.first, p.second) == low && std::max(p.first, p.second) == high;
      };
      if (low < high && !(spec.allowAdjacent && areAdjacent(capsules, low, high)) &&
          std::none_of(spec.allowedLinks.begin(), spec.allowedLinks.end(), isPair)) {
        pairs.push_back({i, k});
      }
    }
  }
  return pairs;
}

// A body that no check sees must be ignored by name.
void checkBodies(const vpArmModel &arm, const vpCollisionSceneSpec &spec)
{
  const std::vector<std::string> &uncovered = arm.spec().uncovered;
  const auto has = [](const std::vector<std::string> &names, const std::string &name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const std::string &body : uncovered) {
    if (!has(spec.ignoredBodies, body)) {
      fail(spec.source,
           "body " + body + " of " + arm.label() +
               " has a shape that no capsule covers and no check would see; cover it or ignore it by name");
    }
  }
  for (const std::string &body : spec.ignoredBodies) {
    if (!has(uncovered, body)) {
      fail(spec.source, "ignored body " + body + " is not one of the uncovered bodies of " + arm.label());
    }
  }
}

void checkLinks(const vpArmModel &arm, const vpCollisionSceneSpec &spec)
{
  const auto inRange = [&arm](int link, int low) { return link >= low && link <= arm.size(); };
  const std::string range = std::to_string(arm.size());
  for (const auto &pair : spec.allowedLinks) {
    if (!inRange(pair.first, 0) || !inRange(pair.second, 0) || pair.first == pair.second) {
      fail(spec.source, "allowed pair of links " + std::to_string(pair.first) + " and " + std::to_string(pair.second) +
                            ", must be two of 0 to " + range);
    }
  }
  for (const vpAllowedContact &contact : spec.allowedContacts) {
    if (!inRange(contact.link, 1)) {
      fail(spec.source, "allowed contact of object " + contact.object + " with link " + std::to_string(contact.link) +
                            ", must be 1 to " + range);
    }
  }
  if (spec.ground && !inRange(spec.ground->firstLink, 1)) {
    fail(spec.source,
         "first link of the ground is " + std::to_string(spec.ground->firstLink) + ", must be 1 to " + range);
  }
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

// Visitors of a query: they get the pairs below their cutoff and may stop.
struct Any {
  double margin;
  bool found = false;
  // Slightly more, so that a contact exactly at the margin is still found.
  [[nodiscard]] double cutoff() const noexcept { return margin + 1e-12; }
  bool take(const vpClearance &pair) noexcept
  {
    found = !(pair.distance > margin);
    return found;
  }
};

struct Least {
  vpClearance best;
  [[nodiscard]] double cutoff() const noexcept { return best.distance; }
  bool take(const vpClearance &pair) noexcept
  {
    if (pair.distance < best.distance) {
      best = pair;
    }
    return false;
  }
};

struct All {
  vpNearPairs &list;
  double limit;
  [[nodiscard]] double cutoff() const noexcept { return limit; }
  bool take(const vpClearance &pair) noexcept
  {
    if (pair.distance >= limit) {
      return false;
    }
    if (list.count < vpNearPairs::capacity) {
      list.pairs[at(list.count++)] = pair;
      return false;
    }
    list.dropped = true;
    auto farthest =
        std::max_element(list.pairs.begin(), list.pairs.end(),
                         [](const vpClearance &a, const vpClearance &b) { return a.distance < b.distance; });
    if (pair.distance < farthest->distance) {
      *farthest = pair;
    }
    return false;
  }
};
} // namespace

vpCollisionScene::vpCollisionScene(const vpArmModel &arm, const vpCollisionSceneSpec &spec)
  : m_arm(arm), m_source(spec.source), m_capsules(placedOnJoints(arm)), m_contacts(spec.allowedContacts)
{
  if (m_capsules.empty() || m_capsules.size() > at(vpArmMaxCapsules)) {
    fail(m_source, arm.label() + " has " + std::to_string(m_capsules.size()) + " capsules, must have 1 to " +
                       std::to_string(vpArmMaxCapsules));
  }
  m_revision = nextRevision();
  checkBodies(arm, spec);
  checkLinks(arm, spec);
  m_selfPairs = findSelfPairs(m_capsules, spec);
  if (spec.ground) {
    m_ground = spec.ground;
    const double length = m_ground->normal.norm();
    if (!std::isfinite(length) || !(length > 0.)) {
      fail(m_source, "ground has no normal");
    }
    if (!(std::fabs(m_ground->offset) <= vpLargestLength)) {
      fail(m_source,
           "offset of the ground is " + text(m_ground->offset) + " m, must be within " + text(vpLargestLength) + " m");
    }
    m_ground->normal /= length;
  }
  for (const vpCollisionObject &object : spec.objects) {
    add(object);
  }
  for (const vpAllowedContact &contact : m_contacts) {
    if (find(contact.object) < 0) {
      fail(m_source, "allowed contact with object " + contact.object + ", which does not exist");
    }
  }
}

vpCollisionScene::vpCollisionScene(const vpCollisionScene &other) = default;
vpCollisionScene::vpCollisionScene(vpCollisionScene &&other) noexcept = default;
vpCollisionScene &vpCollisionScene::operator=(const vpCollisionScene &other) = default;
vpCollisionScene &vpCollisionScene::operator=(vpCollisionScene &&other) noexcept = default;
vpCollisionScene::~vpCollisionScene() = default;

const vpCollisionCore &vpCollisionScene::core(int i) const noexcept { return m_cores[at(i)]; }

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
  return (m_checked[at(object)] >> capsule & 1U) != 0;
}

bool vpCollisionScene::isCheckedWithGround(int capsule) const noexcept
{
  return m_ground && m_capsules[at(capsule)].link >= m_ground->firstLink;
}

int vpCollisionScene::add(const vpCollisionObject &object)
{
  checkObject(m_source, object);
  if (find(object.name) >= 0) {
    fail(m_source, "object " + object.name + ": duplicate name");
  }
  std::uint32_t checked = 0;
  for (std::size_t i = 0; i < m_capsules.size(); ++i) {
    const int link = m_capsules[i].link;
    const bool allowed = std::any_of(m_contacts.begin(), m_contacts.end(), [&](const vpAllowedContact &contact) {
      return contact.object == object.name && contact.link == link;
    });
    checked |= link > 0 && !allowed ? 1U << i : 0U;
  }
  m_objects.push_back(object);
  m_cores.emplace_back(object);
  m_checked.push_back(checked);
  m_revision = nextRevision();
  return objectCount() - 1;
}

void vpCollisionScene::remove(int i)
{
  if (i < 0 || i >= objectCount()) {
    fail(m_source,
         "there is no object " + std::to_string(i) + " to remove, there are " + std::to_string(objectCount()));
  }
  m_objects.erase(m_objects.begin() + i);
  m_cores.erase(m_cores.begin() + i);
  m_checked.erase(m_checked.begin() + i);
  m_revision = nextRevision();
}

bool vpCollisionScene::moveObject(int i, const vpRigidTransform &pose) noexcept
{
  if (i < 0 || i >= objectCount() || !vpIsPlace(pose)) {
    return false;
  }
  m_objects[at(i)].pose = pose;
  m_cores[at(i)].move(pose);
  return true;
}

bool vpCollisionScene::setVelocity(int i, const vpTwist &velocity) noexcept
{
  if (i < 0 || i >= objectCount() || !isPlausible(velocity)) {
    return false;
  }
  m_objects[at(i)].velocity = velocity;
  return true;
}

bool vpCollisionScene::setInflation(int i, double inflation) noexcept
{
  if (i < 0 || i >= objectCount() || !isLength(inflation)) {
    return false;
  }
  m_cores[at(i)].radius += inflation - m_objects[at(i)].inflation;
  m_objects[at(i)].inflation = inflation;
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
  data.placed = q.size() == m_arm.size() && (q.cwiseAbs().array() <= vpLargestCoordinate).all();
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
}

// Visits every pair that must not touch and whose bounding spheres are nearer than the visitor's cutoff.
template <class Visit>
void vpCollisionScene::visit(const vpCollisionData &data, double time, Visit &visitor) const noexcept
{
  for (int j = 0; j < objectCount(); ++j) {
    if (time == 0.) {
      if (visitObject(data, j, m_cores[at(j)], visitor)) {
        return;
      }
      continue;
    }
    vpCollisionCore moved = m_cores[at(j)];
    moved.move(m_objects[at(j)].poseAt(time));
    if (visitObject(data, j, moved, visitor)) {
      return;
    }
  }
  for (const vpSelfPair &pair : m_selfPairs) {
    const vpPlacedCapsule &a = data.capsules[at(pair.first)], &b = data.capsules[at(pair.second)];
    const double radii = a.halfLength + a.radius + b.halfLength + b.radius;
    if (!areApart(a.centre, b.centre, radii, visitor.cutoff()) &&
        visitor.take(selfPair(data, pair.first, pair.second))) {
      return;
    }
  }
  for (int i = 0; m_ground && i < capsuleCount(); ++i) {
    if (isCheckedWithGround(i) && visitor.take(groundPair(data, i))) {
      return;
    }
  }
}

template <class Visit>
bool vpCollisionScene::visitObject(const vpCollisionData &data, int j, const vpCollisionCore &core,
                                   Visit &visitor) const noexcept
{
  for (int i = 0; i < capsuleCount(); ++i) {
    const vpPlacedCapsule &c = data.capsules[at(i)];
    const double radii = c.halfLength + c.radius + core.bound + core.radius;
    if (!isChecked(i, j) || areApart(c.centre, core.centre, radii, visitor.cutoff())) {
      continue;
    }
    vpClearance pair = core.clearance(c, visitor.cutoff());
    pair.capsule = i;
    pair.other = j;
    if (visitor.take(pair)) {
      return true;
    }
  }
  return false;
}

bool vpCollisionScene::inCollision(const vpCollisionData &data, double margin, double time) const noexcept
{
  if (!isKnown(data, margin, time)) {
    return true;
  }
  Any any{margin};
  visit(data, time, any);
  return any.found;
}

vpClearance vpCollisionScene::clearance(const vpCollisionData &data, double cutoff, double time) const noexcept
{
  if (!isKnown(data, cutoff, time)) {
    return unknownClearance();
  }
  Least least;
  least.best.distance = cutoff;
  visit(data, time, least);
  if (least.best.kind == vpCollisionKind::None) {
    least.best.distance = std::numeric_limits<double>::infinity();
  }
  return least.best;
}

void vpCollisionScene::near(const vpCollisionData &data, double cutoff, vpNearPairs &result, double time) const noexcept
{
  result.count = 0;
  result.dropped = !isKnown(data, cutoff, time);
  if (result.dropped) {
    return;
  }
  All all{result, cutoff};
  visit(data, time, all);
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
  if (!data.placed) {
    return unknownClearance();
  }
  vpClearance clearance = vpSelfClearance(data.capsules[at(first)], data.capsules[at(second)]);
  clearance.capsule = first;
  clearance.other = second;
  return clearance;
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
  const auto link = [this](int capsule) { return "link " + std::to_string(m_capsules[at(capsule)].link); };
  const std::string first = link(pair.capsule) + " and ";
  if (pair.kind == vpCollisionKind::Ground) {
    return first + "the ground";
  }
  return first + (pair.kind == vpCollisionKind::Self ? link(pair.other) : "object " + m_objects[at(pair.other)].name);
}

END_VISP_NAMESPACE
