/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpUrdfTree.h"

#include "vpFileText.h"

#include <visp3/direct_core/vpLimit.h>

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <mutex>

BEGIN_VISP_NAMESPACE

namespace
{
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

urdf::ModelInterfaceSharedPtr parse(const std::string &text, const std::string &file)
{
  static std::mutex mutex; // the handler is process-wide
  const std::lock_guard<std::mutex> lock(mutex);
  const Listener listener;
  urdf::ModelInterfaceSharedPtr tree;
  try {
    tree = urdf::parseURDF(text);
  }
  catch (const std::exception &e) {
    vpUrdfFail(file, e.what());
  }
  // For a malformed element urdfdom reports an error, but may still return the tree without the element.
  if (!tree || !listener.text().empty()) {
    vpUrdfFail(file, listener.text().empty() ? "is no URDF" : listener.text());
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
      vpUrdfFail(file, "link " + joint->child_link_name + " is the child of two joints, " + other.first->second +
                           " and " + name);
    }
  }
  std::set<std::string> below; // links known to be below the root
  for (const auto &item : tree.links_) {
    std::set<std::string> way;
    for (std::string link = item.first; below.count(link) == 0;) {
      if (!way.insert(link).second) {
        vpUrdfFail(file, "the joints make a cycle through link " + link);
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

bool isBounded(const urdf::Joint &joint)
{
  return joint.limits && (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC);
}
} // namespace

void vpUrdfFail(const std::string &file, const std::string &sentence) { throw vpFileError(file + ": " + sentence); }

std::string vpListed(const std::vector<std::string> &names)
{
  constexpr std::size_t most = 20;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < most; ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return names.size() > most ? text + ", ..." : text;
}

vpRigidTransform vpUrdfPose(const urdf::Pose &from)
{
  vpRigidTransform T;
  T.R = Eigen::Quaterniond(from.rotation.w, from.rotation.x, from.rotation.y, from.rotation.z)
            .normalized()
            .toRotationMatrix();
  T.p << from.position.x, from.position.y, from.position.z;
  return T;
}

vpUrdfTree vpUrdfTree::read(const std::string &file, vpWarningList &warnings)
{
  vpUrdfText text = vpPrepareUrdf(vpReadFileText(file), file, warnings);
  vpUrdfTree tree;
  tree.file = file;
  tree.joinedRoot = text.joinedRoot;
  tree.given = std::move(text.given);
  tree.model = parse(text.text, file);
  try {
    requireTree(*tree.model, file);
  }
  catch (...) { // links own their children, so those of a cycle would never be freed
    for (const auto &item : tree.model->links_) {
      item.second->child_links.clear();
    }
    throw;
  }
  return tree;
}

void vpUrdfTree::requireLink(const char *field, const std::string &name) const
{
  std::vector<std::string> names;
  for (const auto &item : model->links_) {
    if (item.first == name && name != joinedRoot) {
      return;
    }
    if (item.first != joinedRoot) {
      names.push_back(item.first);
    }
  }
  if (!name.empty()) {
    vpUrdfFail(file, std::string(field) + " is " + name + ", must be one of the links " + vpListed(names));
  }
}

urdf::LinkConstSharedPtr vpUrdfTree::link(const std::string &name) const
{
  urdf::LinkConstSharedPtr link = model->getLink(name);
  if (!link || name == joinedRoot) {
    vpUrdfFail(file, "there is no link " + name);
  }
  return link;
}

urdf::JointConstSharedPtr vpUrdfTree::above(const urdf::Link &link) const
{
  const urdf::JointConstSharedPtr joint = link.parent_joint;
  return joint && joint->parent_link_name == joinedRoot ? nullptr : joint;
}

std::vector<urdf::JointConstSharedPtr> vpUrdfTree::path(const std::string &base, const std::string &tip) const
{
  std::vector<urdf::JointConstSharedPtr> joints;
  static_cast<void>(link(base));
  for (urdf::LinkConstSharedPtr at = link(tip); at->name != base;) {
    const urdf::JointConstSharedPtr joint = above(*at);
    if (!joint) {
      vpUrdfFail(file, "link " + tip + " is not below link " + base);
    }
    joints.push_back(joint);
    at = link(joint->parent_link_name);
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

vpUrdfPosture::vpUrdfPosture(const vpUrdfTree &tree, const std::map<std::string, double> &held)
  : m_tree(tree), m_held(held)
{
  for (const auto &[name, value] : held) {
    const urdf::JointConstSharedPtr joint = tree.model->getJoint(name);
    if (!joint) {
      vpUrdfFail(tree.file, "there is no joint " + name + " to be held");
    }
    if (joint->type != urdf::Joint::REVOLUTE && joint->type != urdf::Joint::CONTINUOUS &&
        joint->type != urdf::Joint::PRISMATIC) {
      vpUrdfFail(tree.file, "held joint " + name + " must be revolute, continuous or prismatic");
    }
    const bool isInside = isBounded(*joint) ? vpLimit::isBetween(joint->limits->lower, value, joint->limits->upper)
                                            : std::fabs(value) <= vpLargestCoordinate;
    if (!isInside) {
      vpUrdfFail(tree.file, "held joint " + name + " at " + std::to_string(value) + " is beyond its limits");
    }
  }
}

void vpUrdfPosture::holdOthers(const std::set<std::string> &chain, const std::map<std::string, double> &state)
{
  m_holdsOthers = true;
  m_chain = chain;
  m_state = state;
}

std::optional<double> vpUrdfPosture::standsAlone(const urdf::Joint &joint) const
{
  const auto held = m_held.find(joint.name);
  if (joint.type == urdf::Joint::FIXED) {
    return 0.;
  }
  if (held != m_held.end()) {
    return held->second;
  }
  const bool isOther = m_holdsOthers && m_chain.count(joint.name) == 0 && joint.type != urdf::Joint::FLOATING &&
                       joint.type != urdf::Joint::PLANAR && !joint.mimic;
  return isOther ? std::optional<double>(home(joint)) : std::nullopt;
}

const urdf::Joint &vpUrdfPosture::leader(const urdf::Joint &joint, double &ratio, double &offset) const
{
  ratio = 1.;
  offset = 0.;
  const urdf::Joint *at = &joint;
  for (std::size_t steps = 0; at->mimic && !standsAlone(*at); ++steps) {
    const urdf::JointConstSharedPtr next = m_tree.model->getJoint(at->mimic->joint_name);
    if (!next) {
      vpUrdfFail(m_tree.file, "joint " + at->name + " mimics joint " + at->mimic->joint_name + ", which is not there");
    }
    if (steps > m_tree.model->joints_.size()) {
      vpUrdfFail(m_tree.file, "joint " + joint.name + " mimics itself");
    }
    offset += ratio * at->mimic->offset;
    ratio *= at->mimic->multiplier;
    at = next.get(); // owned by the tree
  }
  return *at;
}

std::optional<double> vpUrdfPosture::stands(const urdf::Joint &joint) const
{
  double ratio = 1., offset = 0.;
  const std::optional<double> value = standsAlone(leader(joint, ratio, offset));
  if (ratio == 0.) {
    return offset;
  }
  return value ? std::optional<double>(ratio * *value + offset) : std::nullopt;
}

double vpUrdfPosture::home(const urdf::Joint &joint) const
{
  const auto state = m_state.find(joint.name);
  const double q = state == m_state.end() ? 0. : state->second;
  return isBounded(joint) && joint.limits->lower <= joint.limits->upper
             ? std::clamp(q, joint.limits->lower, joint.limits->upper)
             : q;
}

vpRigidTransform vpUrdfPosture::frame(const urdf::Joint &joint) const
{
  const vpRigidTransform origin = vpUrdfPose(joint.parent_to_joint_origin_transform);
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (joint.type == urdf::Joint::FIXED || joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::PLANAR ||
      !(axis.norm() > 1e-9)) {
    return origin;
  }
  double ratio = 1., offset = 0.;
  const urdf::Joint &decides = leader(joint, ratio, offset);
  const double coordinate = ratio * standsAlone(decides).value_or(home(decides)) + offset;
  vpRigidTransform moved;
  if (joint.type == urdf::Joint::PRISMATIC) {
    moved.p = coordinate * axis.normalized();
  }
  else {
    moved.R = Eigen::AngleAxisd(coordinate, axis.normalized()).toRotationMatrix();
  }
  return origin * moved;
}

END_VISP_NAMESPACE
