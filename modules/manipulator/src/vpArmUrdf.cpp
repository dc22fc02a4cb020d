/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpReading.h"
#include "vpXmlOutline.h"

#include <visp3/manipulator/vpArmUrdf.h>

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>

BEGIN_VISP_NAMESPACE

namespace
{
[[noreturn]] void fail(const std::string &file, const std::string &sentence)
{
  throw vpFileError(file + ": " + sentence);
}

// urdfdom reports errors to a process-wide handler and returns a null pointer. The first sentence is the error, the
// second its location; further ones repeat it.
class Listener : public console_bridge::OutputHandler
{
public:
  Listener() { console_bridge::useOutputHandler(this); }
  ~Listener() override { console_bridge::restorePreviousOutputHandler(); }
  Listener(const Listener &) = delete;
  Listener &operator=(const Listener &) = delete;
  void log(const std::string &text, console_bridge::LogLevel level, const char *, int) override
  {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && m_count++ < 2) {
      m_text += (m_text.empty() ? "" : "; ") + text;
    }
  }
  [[nodiscard]] const std::string &text() const { return m_text; }

private:
  std::string m_text;
  int m_count = 0;
};

urdf::ModelInterfaceSharedPtr parse(const std::string &file)
{
  const std::string text = vpReadFileText(file);
  vpRequireXmlOutline(text, file);
  static std::mutex mutex; // the handler is process-wide
  const std::lock_guard<std::mutex> lock(mutex);
  const Listener listener;
  urdf::ModelInterfaceSharedPtr tree;
  try {
    tree = urdf::parseURDF(text);
  }
  catch (const std::exception &e) {
    fail(file, e.what());
  }
  // For a malformed element urdfdom reports an error, but may still return the tree without the element.
  if (!tree || !listener.text().empty()) {
    fail(file, listener.text().empty() ? "is no URDF" : listener.text());
  }
  return tree;
}

// urdfdom requires one root, but accepts additional cycles, and links with two parents.
void requireTree(const urdf::ModelInterface &tree, const std::string &file)
{
  std::map<std::string, std::string> above; // the joint above a link
  for (const auto &[name, joint] : tree.joints_) {
    const auto other = above.emplace(joint->child_link_name, name);
    if (!other.second) {
      fail(file,
           "link " + joint->child_link_name + " is the child of two joints, " + other.first->second + " and " + name);
    }
  }
  std::set<std::string> below; // links known to be below the root
  for (const auto &item : tree.links_) {
    std::set<std::string> way;
    for (std::string link = item.first; below.count(link) == 0;) {
      if (!way.insert(link).second) {
        fail(file, "the joints make a cycle through link " + link);
      }
      const auto joint = above.find(link);
      if (joint == above.end()) {
        break;
      }
      link = tree.getJoint(joint->second)->parent_link_name;
    }
    below.insert(way.begin(), way.end());
  }
}

// Links own their children, so those of a cycle would never be freed.
urdf::ModelInterfaceSharedPtr parseTree(const std::string &file)
{
  const urdf::ModelInterfaceSharedPtr tree = parse(file);
  try {
    requireTree(*tree, file);
  }
  catch (...) {
    for (const auto &item : tree->links_) {
      item.second->child_links.clear();
    }
    throw;
  }
  return tree;
}

vpRigidTransform pose(const urdf::Pose &from)
{
  vpRigidTransform T;
  T.R = Eigen::Quaterniond(from.rotation.w, from.rotation.x, from.rotation.y, from.rotation.z)
            .normalized()
            .toRotationMatrix();
  T.p << from.position.x, from.position.y, from.position.z;
  return T;
}

vpArmLinkSpec massOf(const urdf::Link &link)
{
  vpArmLinkSpec spec;
  spec.name = link.name;
  spec.hasMass = link.inertial != nullptr;
  if (spec.hasMass) {
    const urdf::Inertial &from = *link.inertial;
    const vpRigidTransform at = pose(from.origin);
    spec.mass = from.mass;
    spec.com = at.p;
    Eigen::Matrix3d I;
    I << from.ixx, from.ixy, from.ixz, from.ixy, from.iyy, from.iyz, from.ixz, from.iyz, from.izz;
    spec.inertia = at.R * I * at.R.transpose();
  }
  return spec;
}

Eigen::Matrix3d steiner(double mass, const Eigen::Vector3d &r)
{
  return mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
}

// Merges a body fixed to a link at a pose into the link.
void carry(vpArmLinkSpec &link, const vpArmLinkSpec &part, const vpRigidTransform &at)
{
  if (!part.hasMass) {
    return;
  }
  const Eigen::Vector3d com = at.R * part.com + at.p;
  const Eigen::Matrix3d inertia = at.R * part.inertia * at.R.transpose();
  if (!link.hasMass) {
    link.hasMass = true;
    link.mass = part.mass;
    link.com = com;
    link.inertia = inertia;
    return;
  }
  const double mass = link.mass + part.mass;
  const Eigen::Vector3d both = (link.mass * link.com + part.mass * com) / mass;
  link.inertia += steiner(link.mass, link.com - both) + inertia + steiner(part.mass, com - both);
  link.mass = mass;
  link.com = both;
}

// Adds the capsules of a body. False if it has a shape that they do not cover: a mesh, or one that is only seen.
bool addCapsules(const urdf::Link &link, int number, const vpRigidTransform &at, std::vector<vpArmCapsule> &capsules)
{
  bool covered = !link.collision_array.empty() || link.visual_array.empty();
  for (const urdf::CollisionSharedPtr &collision : link.collision_array) {
    if (!collision->geometry) {
      covered = false;
      continue;
    }
    const vpRigidTransform T = at * pose(collision->origin);
    double half = 0.; // half length of the segment, along z
    Eigen::Vector3d direction = T.R.col(2);
    vpArmCapsule capsule;
    if (const auto *cylinder = dynamic_cast<const urdf::Cylinder *>(collision->geometry.get())) {
      // Encloses the rims, too, so it extends beyond the flat ends.
      capsule.radius = cylinder->radius;
      half = 0.5 * cylinder->length;
    }
    else if (const auto *sphere = dynamic_cast<const urdf::Sphere *>(collision->geometry.get())) {
      capsule.radius = sphere->radius;
    }
    else if (const auto *box = dynamic_cast<const urdf::Box *>(collision->geometry.get())) {
      const double size[3] = {box->dim.x, box->dim.y, box->dim.z};
      const int k = static_cast<int>(std::max_element(size, size + 3) - size);
      capsule.radius = 0.5 * std::hypot(size[(k + 1) % 3], size[(k + 2) % 3]);
      half = 0.5 * size[k];
      direction = T.R.col(k);
    }
    else {
      covered = false;
      continue;
    }
    capsule.link = number;
    capsule.from = T.p - half * direction;
    capsule.to = T.p + half * direction;
    capsules.push_back(capsule);
  }
  return covered;
}

urdf::LinkConstSharedPtr find(const urdf::ModelInterface &tree, const std::string &file, const std::string &name)
{
  const urdf::LinkConstSharedPtr link = tree.getLink(name);
  if (!link) {
    fail(file, "there is no link " + name);
  }
  return link;
}

std::string onlyLeaf(const urdf::ModelInterface &tree, const std::string &file)
{
  std::vector<std::string> leaves;
  for (const auto &item : tree.links_) {
    if (item.second->child_links.empty()) {
      leaves.push_back(item.first);
    }
  }
  if (leaves.size() != 1) {
    std::string names;
    for (const std::string &name : leaves) {
      names += (names.empty() ? "" : ", ") + name;
    }
    fail(file, "the end effector is not unique, name one of the links " + names);
  }
  return leaves.front();
}

// Joints from a link down to another one, in this order.
std::vector<urdf::JointSharedPtr> path(const urdf::ModelInterface &tree, const std::string &file,
                                       const std::string &base, const std::string &tip)
{
  std::vector<urdf::JointSharedPtr> joints;
  urdf::LinkConstSharedPtr link = find(tree, file, tip);
  static_cast<void>(find(tree, file, base));
  while (link->name != base) {
    if (!link->parent_joint) {
      fail(file, "link " + tip + " is not below link " + base);
    }
    joints.push_back(link->parent_joint);
    link = find(tree, file, link->parent_joint->parent_link_name);
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

vpArmJointSpec moving(const urdf::Joint &from, const std::string &file, const vpArmUrdfSpec &spec)
{
  vpArmJointSpec joint;
  joint.name = from.name;
  if (from.mimic) {
    fail(file, "joint " + from.name + " mimics joint " + from.mimic->joint_name + ", which this model cannot express");
  }
  switch (from.type) {
  case urdf::Joint::REVOLUTE:
    joint.type = vpJointType::Revolute;
    break;
  case urdf::Joint::CONTINUOUS:
    joint.type = vpJointType::Continuous;
    break;
  case urdf::Joint::PRISMATIC:
    joint.type = vpJointType::Prismatic;
    break;
  default:
    fail(file, "joint " + from.name + " is floating or planar, must be revolute, continuous, prismatic or fixed");
  }
  const Eigen::Vector3d axis(from.axis.x, from.axis.y, from.axis.z);
  if (!(axis.norm() > 1e-9)) {
    fail(file, "axis of joint " + from.name + " is zero");
  }
  // Joints of vpArmModel move about z: rotate z to the axis, and back after the motion.
  const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
  joint.before = pose(from.parent_to_joint_origin_transform) * vpRigidTransform{turn, Eigen::Vector3d::Zero()};
  joint.after.R = turn.transpose();
  if (from.limits) {
    joint.lower = from.limits->lower;
    joint.upper = from.limits->upper;
    joint.velocity = from.limits->velocity;
    joint.torque = from.limits->effort;
  }
  joint.acceleration = spec.acceleration;
  if (from.dynamics) {
    joint.viscous = from.dynamics->damping;
    joint.coulomb = from.dynamics->friction;
  }
  return joint;
}
// Makes the arm from the links of a chain and what is fixed to them.
class ArmBuilder
{
public:
  ArmBuilder(const std::string &file, const std::string &name, const std::vector<urdf::JointSharedPtr> &chain)
    : m_file(file)
  {
    m_arm.source = file;
    m_arm.name = name;
    for (const urdf::JointSharedPtr &joint : chain) {
      m_chain.insert(joint->name);
    }
  }
  //! Adds a link of the chain, with what is fixed to it beside the chain. \param at : Link in the last moving one.
  void add(const urdf::Link &link, const vpRigidTransform &at)
  {
    if (!addCapsules(link, static_cast<int>(m_arm.joints.size()), at, m_arm.capsules)) {
      m_arm.uncovered.push_back(link.name);
    }
    for (const urdf::JointSharedPtr &joint : link.child_joints) {
      const urdf::LinkConstSharedPtr child = childOf(link, *joint);
      if (m_chain.count(joint->name) == 0 && child) {
        const vpRigidTransform there = at * pose(joint->parent_to_joint_origin_transform);
        if (joint->type == urdf::Joint::FIXED) {
          const vpArmLinkSpec part = massOf(*child);
          if (part.mass > 0.) { // frames may have none
            addMass(part, there);
          }
          add(*child, there);
        }
        else {
          leaveOut(*child);
        }
      }
    }
  }
  void addJoint(const vpArmJointSpec &joint, const urdf::Link &link)
  {
    m_arm.joints.push_back(joint);
    m_arm.links.push_back(massOf(link));
  }
  //! Adds a body that is fixed to the last moving link.
  void addMass(const vpArmLinkSpec &part, const vpRigidTransform &at)
  {
    if (part.hasMass && !(part.mass > 0.)) {
      fail(m_file, "mass of link " + part.name + " is " + std::to_string(part.mass) + ", must be > 0");
    }
    if (!m_arm.links.empty()) { // else it is fixed to the base
      carry(m_arm.links.back(), part, at);
    }
  }
  vpArmSpec &arm() { return m_arm; }

private:
  static urdf::LinkConstSharedPtr childOf(const urdf::Link &link, const urdf::Joint &joint)
  {
    for (const urdf::LinkSharedPtr &child : link.child_links) {
      if (child->name == joint.child_link_name) {
        return child;
      }
    }
    return nullptr;
  }
  // Everything below a joint that moves beside the chain.
  void leaveOut(const urdf::Link &link)
  {
    if (!link.collision_array.empty() || !link.visual_array.empty()) {
      m_arm.uncovered.push_back(link.name);
    }
    for (const urdf::LinkSharedPtr &child : link.child_links) {
      leaveOut(*child);
    }
  }

  std::string m_file;
  std::set<std::string> m_chain; // names of its joints
  vpArmSpec m_arm;
};

vpArmModel load(const std::string &file, const vpArmUrdfSpec &spec)
{
  const urdf::ModelInterfaceSharedPtr tree = parseTree(file);
  const std::string base = spec.base.empty() ? tree->getRoot()->name : spec.base;
  const std::string tip = spec.tip.empty() ? onlyLeaf(*tree, file) : spec.tip;
  const std::vector<urdf::JointSharedPtr> chain = path(*tree, file, base, tip);
  ArmBuilder builder(file, tree->getName(), chain);
  builder.add(*find(*tree, file, base), {});
  vpRigidTransform fixed; // from the last moving link to the current one
  for (const urdf::JointSharedPtr &from : chain) {
    const urdf::LinkConstSharedPtr child = find(*tree, file, from->child_link_name);
    if (from->type == urdf::Joint::FIXED) {
      fixed = fixed * pose(from->parent_to_joint_origin_transform);
      if (!builder.arm().links.empty()) {
        builder.addMass(massOf(*child), fixed);
      }
    }
    else {
      vpArmJointSpec joint = moving(*from, file, spec);
      joint.before = fixed * joint.before;
      fixed = {};
      builder.addJoint(joint, *child);
    }
    builder.add(*child, fixed);
  }
  vpArmSpec &arm = builder.arm();
  arm.tool = fixed;
  if (!spec.camera.empty()) {
    // Up or down from the end effector through fixed joints only.
    const auto toCommon = [&](const std::string &from) {
      vpRigidTransform T;
      for (const urdf::JointSharedPtr &joint :
           path(*tree, file, arm.joints.empty() ? base : tree->getJoint(arm.joints.back().name)->child_link_name,
                from)) {
        if (joint->type != urdf::Joint::FIXED) {
          fail(file, "joint " + joint->name + " between the end effector and the camera is not fixed");
        }
        T = T * pose(joint->parent_to_joint_origin_transform);
      }
      return T;
    };
    arm.camera = toCommon(tip).inverse() * toCommon(spec.camera);
  }
  return vpArmModel(arm);
}
} // namespace

vpArmModel vpLoadArmUrdf(const std::string &file, const vpArmUrdfSpec &spec)
{
  return vpReading([&] { return load(file, spec); });
}

END_VISP_NAMESPACE
