/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpUrdfBodies.h"

#include "vpPossibleInertia.h"

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// A mass below is none: that of a frame.
constexpr double smallestMass = 1e-12;
// Travel of a prismatic joint beside the chain that capsules may enclose as a whole, m: a gripper's.
constexpr double longestTravel = 0.1;

vpArmLinkSpec massOf(const urdf::Link &link)
{
  vpArmLinkSpec spec;
  spec.name = link.name;
  spec.hasMass = link.inertial != nullptr;
  if (spec.hasMass) {
    const urdf::Inertial &from = *link.inertial;
    const vpRigidTransform at = vpUrdfPose(from.origin);
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

// Merges a body with a mass, fixed to a link at a pose, into the link.
void carry(vpArmLinkSpec &link, const vpArmLinkSpec &part, const vpRigidTransform &at)
{
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

// False for a kind that is not known. The names of other kinds than meshes are empty.
bool kindAndSize(const urdf::Geometry &geometry, vpArmShape &shape)
{
  if (const auto *cylinder = dynamic_cast<const urdf::Cylinder *>(&geometry)) {
    shape.kind = vpArmShapeKind::Cylinder;
    shape.size << cylinder->radius, cylinder->length, 1.;
  }
  else if (const auto *sphere = dynamic_cast<const urdf::Sphere *>(&geometry)) {
    shape.kind = vpArmShapeKind::Sphere;
    shape.size << sphere->radius, 1., 1.;
  }
  else if (const auto *box = dynamic_cast<const urdf::Box *>(&geometry)) {
    shape.kind = vpArmShapeKind::Box;
    shape.size << box->dim.x, box->dim.y, box->dim.z;
  }
  else if (const auto *mesh = dynamic_cast<const urdf::Mesh *>(&geometry)) {
    shape.kind = vpArmShapeKind::Mesh;
    shape.size << mesh->scale.x, mesh->scale.y, mesh->scale.z;
    shape.file = mesh->filename;
  }
  else {
    return false;
  }
  return true;
}

bool isEmpty(const vpArmShape &shape)
{
  return shape.kind == vpArmShapeKind::Mesh ? (shape.size.array() == 0.).any() : !(shape.size.array() > 0.).all();
}

// Encloses a sphere, cylinder or box; the rims of a cylinder, too, so it extends beyond the flat ends.
vpArmCapsule capsuleAround(const vpArmShape &shape, int link)
{
  vpArmCapsule capsule;
  int along = 2;
  double half = 0.;
  capsule.radius = shape.size(0);
  if (shape.kind == vpArmShapeKind::Cylinder) {
    half = 0.5 * shape.size(1);
  }
  else if (shape.kind == vpArmShapeKind::Box) {
    half = 0.5 * shape.size.maxCoeff(&along);
    capsule.radius = 0.5 * std::hypot(shape.size((along + 1) % 3), shape.size((along + 2) % 3));
  }
  capsule.link = link;
  capsule.body = shape.body;
  capsule.from = shape.pose.p - half * shape.pose.R.col(along);
  capsule.to = shape.pose.p + half * shape.pose.R.col(along);
  return capsule;
}
} // namespace

void vpUrdfBodies::nextLink(const std::string &name)
{
  m_links.emplace_back();
  m_links.back().name = name;
  m_massUnknown.push_back(false);
}

void vpUrdfBodies::addBase(const std::string &base)
{
  // What is below the base's neighbour above, beside the base, is found from there.
  std::vector<Part> parts(1);
  parts[0].link = m_tree.link(base);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part part = parts[i];
    if (const urdf::JointConstSharedPtr joint = m_tree.above(*part.link)) {
      Part above;
      above.link = m_tree.link(joint->parent_link_name);
      above.at = part.at * m_posture.frame(*joint).inverse();
      above.moves = part.moves || !m_posture.stands(*joint);
      warnOfMoving(*joint);
      parts.push_back(above);
    }
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    addWithBranches({parts[i]}, i == 0 ? "" : parts[i - 1].link->name);
  }
}

void vpUrdfBodies::add(const urdf::Link &link, const vpRigidTransform &at)
{
  Part part;
  part.link = m_tree.link(link.name);
  part.at = at;
  addWithBranches({part}, "");
}

// Adds parts, and what is below them, without the branch to the link `from` and without the chain.
void vpUrdfBodies::addWithBranches(std::vector<Part> parts, const std::string &from)
{
  while (!parts.empty()) { // no recursion: a file may have any number of links
    const Part part = parts.back();
    parts.pop_back();
    addBody(part);
    addMass(part);
    for (auto joint = part.link->child_joints.rbegin(); joint != part.link->child_joints.rend(); ++joint) {
      if (m_chain.count((*joint)->name) == 0 && (*joint)->child_link_name != from) {
        parts.push_back(below(part, **joint));
      }
    }
  }
}

vpUrdfBodies::Part vpUrdfBodies::below(const Part &part, const urdf::Joint &joint) const
{
  Part child = part;
  child.link = m_tree.link(joint.child_link_name);
  child.at = part.at * m_posture.frame(joint);
  if (m_posture.stands(joint)) {
    return child;
  }
  warnOfMoving(joint);
  child.moves = true;
  child.isShort = false;
  double ratio = 1., offset = 0.;
  const urdf::Joint &leader = m_posture.leader(joint, ratio, offset);
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (!part.moves && joint.type == urdf::Joint::PRISMATIC && leader.limits && leader.type != urdf::Joint::CONTINUOUS &&
      axis.norm() > 1e-9) {
    const double travel = ratio * (leader.limits->upper - leader.limits->lower);
    const double middle = 0.5 * ratio * (leader.limits->upper + leader.limits->lower) - ratio * m_posture.home(leader);
    child.isShort = std::fabs(travel) <= longestTravel;
    child.half = 0.5 * std::fabs(travel);
    child.middle = middle * (part.at.R * (vpUrdfPose(joint.parent_to_joint_origin_transform).R * axis.normalized()));
  }
  return child;
}

// A joint beside the chain that neither stands still nor follows one of the chain.
void vpUrdfBodies::warnOfMoving(const urdf::Joint &joint) const
{
  double ratio = 1., offset = 0.;
  if (!m_posture.stands(joint) && m_chain.count(m_posture.leader(joint, ratio, offset).name) == 0) {
    m_warnings.add("joints beside the chain are not moved with the arm: ", joint.name, "");
  }
}

// False if the shape is not known.
bool vpUrdfBodies::addShape(const urdf::Collision &collision, const Part &part, std::vector<vpArmShape> &shapes)
{
  vpArmShape shape;
  if (!collision.geometry || !kindAndSize(*collision.geometry, shape)) {
    return false;
  }
  const std::string &body = part.link->name;
  if (isEmpty(shape)) {
    m_warnings.add("a shape of ", body, " has the radius or an edge 0: left out");
    return true;
  }
  if (shape.kind == vpArmShapeKind::Mesh) {
    const std::string name = shape.file;
    shape.file = m_paths.find(name);
    if (shape.file.empty()) {
      m_warnings.add("a mesh is not found in " + m_paths.searched() + ": ", name + " of " + body, "");
      return false;
    }
  }
  shape.body = static_cast<int>(m_bodies.size()) - 1;
  shape.pose = part.at * vpUrdfPose(collision.origin);
  shapes.push_back(shape);
  return true;
}

void vpUrdfBodies::addBody(const Part &part)
{
  m_bodies.push_back({part.link->name, static_cast<int>(m_links.size())});
  std::vector<vpArmShape> shapes;
  bool isComplete = true;
  for (const urdf::CollisionSharedPtr &collision : part.link->collision_array) {
    isComplete = addShape(*collision, part, shapes) && isComplete;
  }
  const bool isOnlySeen = isComplete && shapes.empty() && !part.link->visual_array.empty();
  m_hasShape.push_back(!shapes.empty() || !isComplete || isOnlySeen);
  const bool hasMesh = std::any_of(shapes.begin(), shapes.end(),
                                   [](const vpArmShape &shape) { return shape.kind == vpArmShapeKind::Mesh; });
  const bool isCovered = isComplete && !hasMesh && !isOnlySeen && (!part.moves || part.isShort);
  if (m_hasShape.back() && !isCovered) {
    m_uncovered.push_back(part.link->name);
  }
  addCapsules(part, shapes);
  if (isComplete && !part.moves) {
    m_shapes.insert(m_shapes.end(), shapes.begin(), shapes.end());
  }
}

void vpUrdfBodies::addCapsules(const Part &part, const std::vector<vpArmShape> &shapes)
{
  if (part.moves && !part.isShort) {
    return;
  }
  for (const vpArmShape &shape : shapes) {
    if (shape.kind != vpArmShapeKind::Mesh) {
      vpArmCapsule capsule = capsuleAround(shape, static_cast<int>(m_links.size()));
      if (part.moves) { // anywhere on its way
        capsule.from += part.middle;
        capsule.to += part.middle;
        capsule.radius += part.half;
      }
      m_capsules.push_back(capsule);
    }
  }
}

void vpUrdfBodies::addMass(const Part &part)
{
  const vpArmLinkSpec mass = massOf(*part.link);
  if (!mass.hasMass || m_links.empty()) { // the base stands still
    return;
  }
  Eigen::Vector3d moments;
  const bool isFirst = m_bodies.size() < 2 || m_bodies[m_bodies.size() - 2].link != m_bodies.back().link;
  if (!(mass.mass >= 0.) || (mass.mass < smallestMass && isFirst && m_hasShape.back())) {
    m_warnings.add("the mass of ", part.link->name, " is not > 0: taken as unknown");
    m_massUnknown.back() = true;
  }
  else if (mass.mass < smallestMass) {
    if (m_hasShape.back()) { // else a frame
      m_warnings.add("the mass of ", part.link->name, " is 0: taken as included in the body that carries it");
    }
  }
  else if (!vpIsPossibleInertia(mass.inertia, moments)) {
    m_warnings.add("the inertia of ", part.link->name, " is one that no body has: mass and inertia taken as unknown");
    m_massUnknown.back() = true;
  }
  else {
    carry(m_links.back(), mass, part.at);
  }
}

void vpUrdfBodies::finish(vpArmSpec &arm)
{
  // A link that weighs something is there, although nothing says where; so is an arm of which no link has a shape.
  const bool isBlind = std::none_of(m_hasShape.begin(), m_hasShape.end(), [](bool has) { return has; });
  for (std::size_t i = 0; i < m_links.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    bool hasShape = false;
    std::string first;
    for (std::size_t b = 0; b < m_bodies.size(); ++b) {
      hasShape = hasShape || (m_bodies[b].link == number && m_hasShape[b]);
      first = first.empty() && m_bodies[b].link == number ? m_bodies[b].name : first;
    }
    if (!hasShape && (isBlind || m_links[i].hasMass || m_massUnknown[i])) {
      m_uncovered.push_back(first);
      m_warnings.add(isBlind ? "no link of the arm has a shape: " : "links have a mass but no shape: ", first, "");
    }
    if (m_massUnknown[i]) {
      vpArmLinkSpec unknown;
      unknown.name = m_links[i].name;
      m_links[i] = unknown;
    }
  }
  arm.links = std::move(m_links);
  arm.bodies = std::move(m_bodies);
  arm.shapes = std::move(m_shapes);
  arm.capsules = std::move(m_capsules);
  arm.uncovered = std::move(m_uncovered);
}

END_VISP_NAMESPACE
