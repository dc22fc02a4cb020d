/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPossibleInertia.h"
#include "vpPrintable.h"

#include <visp3/manipulator/vpArmModel.h>

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpLimit.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

BEGIN_VISP_NAMESPACE

vpHomogeneousMatrix vpRigidTransform::toHomogeneous() const
{
  vpHomogeneousMatrix M;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      M[i][j] = R(i, j);
    }
    M[i][3] = p(i);
  }
  return M;
}

vpRigidTransform vpRigidTransform::fromHomogeneous(const vpHomogeneousMatrix &M)
{
  vpRigidTransform T;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 3; ++j) {
      T.R(i, j) = M[i][j];
    }
    T.p(i) = M[i][3];
  }
  return T;
}

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void fail(const vpArmSpec &spec, const std::string &sentence)
{
  const std::string where =
      spec.source.empty() ? "arm " + (spec.name.empty() ? "without a name" : spec.name) : spec.source;
  throw vpException(vpException::badValue, vpPrintable(where + ": " + sentence)); // names may come from a file
}

std::string text(double value, int digits = 6)
{
  std::ostringstream out;
  out.precision(digits);
  out << value;
  return out.str();
}

//! As many digits as needed to distinguish the number from others.
int digitsOf(double value, std::initializer_list<double> others)
{
  int digits = 6;
  for (const double other : others) {
    while (digits < 17 && value != other && text(value, digits) == text(other, digits)) {
      ++digits;
    }
  }
  return digits;
}

void positive(const vpArmSpec &spec, const std::string &what, double value)
{
  if (!(value > 0.)) {
    fail(spec, what + " is " + text(value) + ", must be > 0");
  }
  if (value < 1e-12 || (value > vpArmLargest && std::isfinite(value))) { // infinite: none
    fail(spec, what + " is " + text(value) + ", must be from 1e-12 to 1e9");
  }
}

void notNegative(const vpArmSpec &spec, const std::string &what, double value)
{
  if (!(value >= 0.) || !std::isfinite(value)) {
    fail(spec, what + " is " + text(value) + ", must be >= 0 and finite");
  }
  if (value > vpArmLargest) {
    fail(spec, what + " is " + text(value) + ", must be at most 1e9");
  }
}

// NaN is rejected too.
void length(const vpArmSpec &spec, const std::string &what, double value)
{
  if (!(std::fabs(value) <= vpLargestLength)) {
    fail(spec, what + " is " + text(value) + " m, must be within " + text(vpLargestLength) + " m");
  }
}

void lengths(const vpArmSpec &spec, const std::string &what, const Eigen::Vector3d &p)
{
  for (int k = 0; k < 3; ++k) {
    length(spec, what, p(k));
  }
}

void rigid(const vpArmSpec &spec, const std::string &what, const vpRigidTransform &T)
{
  if (!T.p.allFinite() || !T.R.allFinite() ||
      (T.R * T.R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 1e-9 || T.R.determinant() < 0.) {
    fail(spec, what + " is not a rotation and a finite translation");
  }
  lengths(spec, "translation of the " + what, T.p);
}

bool isInside(const vpArmJointSpec &joint, double q)
{
  return joint.type == vpJointType::Continuous ? std::fabs(q) <= vpArmLargest
                                               : vpLimit::isBetween(joint.lower, q, joint.upper);
}

double largestLimit(vpJointType type) { return type == vpJointType::Prismatic ? vpLargestLength : vpLargestCoordinate; }

void checkJoint(const vpArmSpec &spec, const vpArmJointSpec &joint, std::set<std::string> &names)
{
  if (joint.name.empty()) {
    fail(spec, "a joint has no name");
  }
  if (!names.insert(joint.name).second) {
    fail(spec, "duplicate joint name " + joint.name);
  }
  const std::string of = " of joint " + joint.name;
  rigid(spec, "frame before" + of, joint.before);
  rigid(spec, "frame after" + of, joint.after);
  if (!(std::fabs(joint.offset) <= largestLimit(joint.type))) {
    fail(spec, "offset" + of + " is " + text(joint.offset) + ", must be within " + text(largestLimit(joint.type)));
  }
  if (joint.type != vpJointType::Continuous &&
      (!std::isfinite(joint.lower) || !std::isfinite(joint.upper) || !(joint.lower < joint.upper))) {
    fail(spec, "limits" + of + " are " + text(joint.lower) + " and " + text(joint.upper) +
                   ", must be finite and lower < upper");
  }
  if (joint.type != vpJointType::Continuous &&
      std::max(std::fabs(joint.lower), std::fabs(joint.upper)) > largestLimit(joint.type)) {
    fail(spec, "limits" + of + " are " + text(joint.lower) + " and " + text(joint.upper) + ", must be within " +
                   text(largestLimit(joint.type)));
  }
  positive(spec, "velocity limit" + of, joint.velocity);
  positive(spec, "acceleration limit" + of, joint.acceleration);
  positive(spec, "torque limit" + of, joint.torque);
  notNegative(spec, "rotor inertia" + of, joint.rotorInertia);
  notNegative(spec, "viscous friction" + of, joint.viscous);
  notNegative(spec, "Coulomb friction" + of, joint.coulomb);
  notNegative(spec, "kp" + of, joint.kp);
  notNegative(spec, "kd" + of, joint.kd);
}

constexpr double largestRatio = 100.; // of a follower to its joint

void checkFollower(const vpArmSpec &spec, const vpArmFollower &follower, std::set<std::string> &names)
{
  const int n = static_cast<int>(spec.joints.size());
  if (follower.name.empty() || !names.insert(follower.name).second) {
    fail(spec, follower.name.empty() ? "a follower has no name" : "duplicate joint name " + follower.name);
  }
  const std::string of = " of follower " + follower.name;
  rigid(spec, "frame before" + of, follower.before);
  rigid(spec, "frame after" + of, follower.after);
  if (follower.joint < 0 || follower.joint >= n || follower.place < 0 || follower.place > n) {
    fail(spec, "joint and place" + of + " are " + std::to_string(follower.joint) + " and " +
                   std::to_string(follower.place) + ", must be 0 to " + std::to_string(n - 1) + " and 0 to " +
                   std::to_string(n));
  }
  const double ratio = std::fabs(follower.ratio), most = largestLimit(follower.type);
  if (!(ratio >= 1e-9) || !(ratio <= largestRatio)) {
    fail(spec, "ratio" + of + " is " + text(follower.ratio) + ", must not be 0 and be within " + text(largestRatio));
  }
  const vpArmJointSpec &joint = spec.joints[static_cast<std::size_t>(follower.joint)];
  if (follower.type == vpJointType::Prismatic && joint.type == vpJointType::Continuous) {
    fail(spec, "follower " + follower.name + " is prismatic and follows the continuous joint " + joint.name +
                   ", must follow one with limits");
  }
  const double far = joint.type == vpJointType::Continuous
                         ? std::fabs(follower.offset)
                         : std::max(std::fabs(follower.ratio * joint.lower + follower.offset),
                                    std::fabs(follower.ratio * joint.upper + follower.offset));
  if (!(far <= most)) {
    fail(spec, "follower " + follower.name + " reaches " + text(far) + ", must stay within " + text(most));
  }
}

void checkCarrier(const vpArmSpec &spec, const std::string &what, int link)
{
  const int links = static_cast<int>(spec.joints.size() + spec.followers.size());
  if (link != -1 && (link < 1 || link > links)) {
    fail(spec,
         "link of the " + what + " is " + std::to_string(link) + ", must be 1 to " + std::to_string(links) + ", or -1");
  }
}

void checkHome(const vpArmSpec &spec)
{
  if (spec.home.size() == 0) {
    return;
  }
  if (spec.home.size() != static_cast<Eigen::Index>(spec.joints.size())) {
    fail(spec, "home has " + std::to_string(spec.home.size()) + " numbers, must have one for each of " +
                   std::to_string(spec.joints.size()) + " joints");
  }
  for (std::size_t i = 0; i < spec.joints.size(); ++i) {
    const vpArmJointSpec &joint = spec.joints[i];
    const double q = spec.home(static_cast<Eigen::Index>(i));
    if (!isInside(joint, q)) {
      fail(spec, "home of joint " + joint.name + " is " + text(q, digitsOf(q, {joint.lower, joint.upper})) +
                     ", must be within its limits");
    }
  }
}

void checkLink(const vpArmSpec &spec, const vpArmLinkSpec &link)
{
  if (!link.hasMass) {
    return;
  }
  const std::string of = " of link " + link.name;
  positive(spec, "mass" + of, link.mass);
  if (!std::isfinite(link.mass) || !vpIsPlausibleForArm(link.com) || !vpIsPlausibleForArm(link.inertia)) {
    fail(spec, "mass, centre of mass or inertia" + of + " is not finite or beyond 1e9");
  }
  Eigen::Vector3d moments;
  if (!vpIsPossibleInertia(link.inertia, moments)) {
    fail(spec, "inertia" + of + " has the principal moments " + text(moments(0)) + ", " + text(moments(1)) + ", " +
                   text(moments(2)) + " kg m^2, which no body has");
  }
}

void checkCapsule(const vpArmSpec &spec, const vpArmCapsule &capsule)
{
  const int n = static_cast<int>(spec.joints.size() + spec.followers.size());
  const int bodies = static_cast<int>(spec.bodies.size());
  const std::string link = std::to_string(capsule.link), of = " of a capsule of link " + link;
  if (capsule.link < 0 || capsule.link > n) {
    fail(spec, "a capsule belongs to link " + link + ", must be 0 to " + std::to_string(n));
  }
  positive(spec, "capsule radius of link " + link, capsule.radius);
  if (!capsule.from.allFinite() || !capsule.to.allFinite() || !std::isfinite(capsule.radius)) {
    fail(spec, "a capsule of link " + link + " is not finite");
  }
  length(spec, "radius" + of, capsule.radius);
  lengths(spec, "end" + of, capsule.from);
  lengths(spec, "end" + of, capsule.to);
  if (capsule.body < -1 || capsule.body >= bodies) {
    fail(spec, "body" + of + " is " + std::to_string(capsule.body) + ", must be -1 to " + std::to_string(bodies - 1));
  }
  if (capsule.body >= 0 && spec.bodies[static_cast<std::size_t>(capsule.body)].link != capsule.link) {
    fail(spec, "body " + spec.bodies[static_cast<std::size_t>(capsule.body)].name + of + " belongs to another link");
  }
}

void checkShape(const vpArmSpec &spec, const vpArmShape &shape)
{
  const int bodies = static_cast<int>(spec.bodies.size());
  if (shape.body < 0 || shape.body >= bodies) {
    fail(spec,
         "a shape belongs to body " + std::to_string(shape.body) + ", must be 0 to " + std::to_string(bodies - 1));
  }
  const std::string of = "shape of body " + spec.bodies[static_cast<std::size_t>(shape.body)].name;
  const bool isMesh = shape.kind == vpArmShapeKind::Mesh;
  const int sizes = shape.kind == vpArmShapeKind::Sphere ? 1 : shape.kind == vpArmShapeKind::Cylinder ? 2 : 3;
  for (int k = 0; k < sizes; ++k) {
    positive(spec, "size of a " + of, isMesh ? std::fabs(shape.size(k)) : shape.size(k));
    length(spec, "size of a " + of, shape.size(k));
  }
  if (shape.file.empty() == isMesh) {
    fail(spec, "a " + of + (isMesh ? " is a mesh without a file" : " has the file " + shape.file + ", but is no mesh"));
  }
  rigid(spec, "pose of a " + of, shape.pose);
}

// Bodies, and what names them.
void checkBodies(const vpArmSpec &spec)
{
  const int n = static_cast<int>(spec.joints.size() + spec.followers.size());
  std::set<std::string> names;
  for (const vpArmBody &body : spec.bodies) {
    if (body.name.empty() || !names.insert(body.name).second) {
      fail(spec, body.name.empty() ? "a body has no name" : "duplicate body name " + body.name);
    }
    if (body.link < 0 || body.link > n) {
      fail(spec, "body " + body.name + " belongs to link " + std::to_string(body.link) + ", must be 0 to " +
                     std::to_string(n));
    }
  }
  for (const vpArmShape &shape : spec.shapes) {
    checkShape(spec, shape);
  }
  for (const auto &[first, second] : spec.allowedBodies) {
    for (const std::string &name : {first, second}) {
      if (names.count(name) == 0) {
        fail(spec, "pair of bodies " + first + ", " + second + ": there is no body " + name);
      }
    }
    if (first == second) {
      fail(spec, "pair of bodies " + first + ", " + second + ": must be different ones");
    }
  }
  std::set<std::string> uncovered;
  for (const std::string &name : spec.uncovered) {
    if (name.empty() || !uncovered.insert(name).second) {
      fail(spec, name.empty() ? "an uncovered body has no name" : "uncovered body " + name + " is given twice");
    }
  }
}
} // namespace

vpArmJointSpec vpArmJointSpec::modifiedDH(double a, double alpha, double d, double offset)
{
  vpArmJointSpec joint;
  joint.offset = offset;
  joint.before.R = Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitX()).toRotationMatrix();
  joint.before.p = Eigen::Vector3d(a, 0., 0.) + d * joint.before.R.col(2);
  return joint;
}

vpArmJointSpec vpArmJointSpec::standardDH(double a, double alpha, double d, double offset)
{
  vpArmJointSpec joint;
  joint.offset = offset;
  joint.after.R = Eigen::AngleAxisd(alpha, Eigen::Vector3d::UnitX()).toRotationMatrix();
  joint.after.p << a, 0., d;
  return joint;
}

vpArmModel::vpArmModel(const vpArmSpec &spec)
  : m_spec(spec), m_size(static_cast<int>(spec.joints.size())),
    m_links(m_size + static_cast<int>(spec.followers.size()))
{
  if (m_size < 1 || m_links > vpArmMaxJoints) {
    fail(spec, std::to_string(m_links) + " moving joints, must be 1 to " + std::to_string(vpArmMaxJoints));
  }
  if (!spec.links.empty() && spec.links.size() != static_cast<std::size_t>(m_links)) {
    fail(spec,
         std::to_string(spec.links.size()) + " links for " + std::to_string(m_links) + " joints, must be as many");
  }
  std::set<std::string> names;
  for (const vpArmJointSpec &joint : spec.joints) {
    checkJoint(spec, joint, names);
  }
  for (const vpArmFollower &follower : spec.followers) {
    checkFollower(spec, follower, names);
  }
  m_hasMasses = !spec.links.empty();
  for (const vpArmLinkSpec &link : spec.links) {
    checkLink(spec, link);
    m_hasMasses = m_hasMasses && link.hasMass;
  }
  checkHome(spec);
  rigid(spec, "tool", spec.tool);
  rigid(spec, "camera", spec.camera);
  checkCarrier(spec, "end effector", spec.toolLink);
  checkCarrier(spec, "camera", spec.cameraLink);
  checkBodies(spec);
  for (const vpArmCapsule &capsule : spec.capsules) {
    checkCapsule(spec, capsule);
  }

  for (vpJointVector *vector : {&m_lower, &m_upper, &m_velocity, &m_acceleration, &m_torque}) {
    vector->resize(m_size);
  }
  for (int i = 0; i < m_size; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    const vpArmJointSpec &joint = spec.joints[k];
    m_continuous[k] = joint.type == vpJointType::Continuous;
    m_prismatic[k] = joint.type == vpJointType::Prismatic;
    m_lower(i) = m_continuous[k] ? -infinity : joint.lower;
    m_upper(i) = m_continuous[k] ? infinity : joint.upper;
    m_velocity(i) = joint.velocity;
    m_acceleration(i) = joint.acceleration;
    m_torque(i) = joint.torque;
  }
  makeChain();
  m_home = spec.home;
  if (m_home.size() == 0) {
    m_home.setZero(m_size);
    for (int i = 0; i < m_size; ++i) {
      m_home(i) = isContinuous(i) ? 0. : 0.5 * (m_lower(i) + m_upper(i));
    }
  }
}

void vpArmModel::makeChain()
{
  std::size_t count = 0;
  const auto add = [this, &count](const vpRigidTransform &before, const vpRigidTransform &after, vpJointType type,
                                  int joint, double ratio, double offset) {
    m_chain[count] = {count == 0 ? before : m_chain[count - 1].after * before,
                      after,
                      type == vpJointType::Prismatic,
                      joint,
                      ratio,
                      offset};
    ++count;
  };
  for (int i = 0; i <= m_size; ++i) {
    for (const vpArmFollower &f : m_spec.followers) {
      if (f.place == i) {
        add(f.before, f.after, f.type, f.joint, f.ratio, f.offset);
      }
    }
    if (i < m_size) {
      const vpArmJointSpec &joint = m_spec.joints[static_cast<std::size_t>(i)];
      add(joint.before, joint.after, joint.type, i, 1., joint.offset);
    }
  }
  m_toolStep = chain(toolLink() - 1).after * m_spec.tool;
}

vpJointVector vpArmModel::coordinates(const vpJointVector &q) const noexcept
{
  vpJointVector all = changes(q);
  for (int k = 0; k < m_links; ++k) {
    all(k) += chain(k).offset;
  }
  return all;
}

vpJointVector vpArmModel::changes(const vpJointVector &change) const noexcept
{
  vpJointVector all(m_links);
  for (int k = 0; k < m_links; ++k) {
    all(k) = chain(k).ratio * change(chain(k).joint);
  }
  return all;
}

std::string vpArmModel::outsideLimits(const vpJointVector &q) const
{
  if (q.size() != m_size) {
    return std::to_string(q.size()) + " joints, the arm has " + std::to_string(m_size);
  }
  for (int i = 0; i < m_size; ++i) {
    const vpArmJointSpec &joint = m_spec.joints[static_cast<std::size_t>(i)];
    if (!isInside(joint, q(i))) {
      const int digits = digitsOf(q(i), {m_lower(i), m_upper(i)});
      return "joint " + joint.name + " at " + text(q(i), digits) + ", outside its limits " + text(m_lower(i), digits) +
             " and " + text(m_upper(i), digits);
    }
  }
  return "";
}

void vpArmModel::requireMotionLimits(const char *user) const
{
  for (const vpArmJointSpec &joint : m_spec.joints) {
    if (!std::isfinite(joint.velocity)) {
      fail(m_spec, "velocity limit of joint " + joint.name + " is infinite, " + user + " needs one");
    }
    if (!std::isfinite(joint.acceleration)) {
      fail(m_spec, "acceleration limit of joint " + joint.name + " is infinite, " + user + " needs one");
    }
  }
}

END_VISP_NAMESPACE
