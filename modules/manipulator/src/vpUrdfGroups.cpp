/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpUrdfGroups.h"

#include <algorithm>

BEGIN_VISP_NAMESPACE

namespace
{
struct Ends {
  std::string base, tip;
  int moving = 0; // joints between them
};

// Joints from a link up to its root.
std::vector<urdf::JointConstSharedPtr> upwards(const vpUrdfTree &tree, const std::string &link)
{
  std::vector<urdf::JointConstSharedPtr> joints;
  for (urdf::JointConstSharedPtr joint = tree.above(*tree.link(link)); joint;
       joint = tree.above(*tree.link(joint->parent_link_name))) {
    joints.push_back(joint);
  }
  return joints;
}

// The joint above a link, if there are both.
urdf::JointConstSharedPtr jointAbove(const vpUrdfTree &tree, const std::string &link)
{
  const urdf::LinkConstSharedPtr found = tree.model->getLink(link);
  return found ? tree.above(*found) : nullptr;
}

// The shortest chain with the given joints; empty ends if they do not lie in one.
Ends endsOf(const vpUrdfTree &tree, const std::vector<urdf::JointConstSharedPtr> &joints)
{
  std::vector<urdf::JointConstSharedPtr> longest;
  for (const urdf::JointConstSharedPtr &joint : joints) {
    if (!joint) {
      return {};
    }
    std::vector<urdf::JointConstSharedPtr> way = upwards(tree, joint->child_link_name);
    longest = way.size() > longest.size() ? way : longest;
  }
  Ends ends;
  std::size_t last = 0; // the uppermost of the joints
  for (const urdf::JointConstSharedPtr &joint : joints) {
    const auto found = std::find(longest.begin(), longest.end(), joint);
    if (found == longest.end()) {
      return {};
    }
    last = std::max(last, static_cast<std::size_t>(found - longest.begin()));
  }
  for (std::size_t i = 0; !longest.empty() && i <= last; ++i) {
    ends.moving += longest[i]->type != urdf::Joint::FIXED ? 1 : 0;
    ends.base = longest[i]->parent_link_name;
  }
  ends.tip = longest.empty() ? "" : longest.front()->child_link_name;
  return ends;
}

// Ends of a group that is one chain, else empty.
Ends endsOf(const vpUrdfTree &tree, const vpSrdfGroup &group)
{
  if (!group.groups.empty() || group.chains.size() > 1) {
    return {};
  }
  if (group.chains.size() == 1) {
    Ends ends{group.chains.front().first, group.chains.front().second, 0};
    if (jointAbove(tree, ends.tip)) {
      for (const urdf::JointConstSharedPtr &joint : upwards(tree, ends.tip)) {
        ends.moving += joint->type != urdf::Joint::FIXED ? 1 : 0;
        if (joint->parent_link_name == ends.base) {
          return ends;
        }
      }
    }
    return {};
  }
  std::vector<urdf::JointConstSharedPtr> joints;
  for (const std::string &name : group.joints) {
    joints.push_back(tree.model->getJoint(name));
  }
  for (const std::string &link : group.links) {
    if (const urdf::JointConstSharedPtr joint = jointAbove(tree, link)) { // none above the root
      joints.push_back(joint);
    }
  }
  return endsOf(tree, joints);
}

std::string groupOf(const vpUrdfTree &tree, const vpSrdf &srdf, const std::string &name, Ends &ends)
{
  std::string best;
  bool isUnique = true;
  for (const vpSrdfGroup &group : srdf.groups) {
    const Ends here = endsOf(tree, group);
    if (!name.empty() ? group.name == name : here.moving > ends.moving) {
      ends = here;
      best = group.name;
      isUnique = true;
    }
    else if (name.empty() && here.moving == ends.moving && (here.base != ends.base || here.tip != ends.tip)) {
      isUnique = false;
    }
  }
  if (!name.empty() && ends.tip.empty()) {
    vpUrdfFail(tree.file, "group " + name + (best.empty() ? " is not in the SRDF" : " is not one chain"));
  }
  ends = isUnique ? ends : Ends();
  return isUnique ? best : "";
}

std::string onlyLeaf(const vpUrdfTree &tree)
{
  std::vector<std::string> leaves;
  for (const auto &item : tree.model->links_) {
    if (item.second->child_links.empty()) {
      leaves.push_back(item.first);
    }
  }
  if (leaves.size() != 1) {
    vpUrdfFail(tree.file, "tip must be one of the links " + vpListed(leaves) + ": the end effector is not unique");
  }
  return leaves.front();
}

// All states of a name together; a name may be used once per group.
std::map<std::string, double> stateOf(const vpSrdf &srdf, const std::string &name)
{
  std::map<std::string, double> joints;
  for (const vpSrdfState &state : srdf.states) {
    if (state.name == name) {
      joints.insert(state.joints.begin(), state.joints.end());
    }
  }
  return joints;
}
} // namespace

void vpCompleteEnds(const vpUrdfTree &tree, const vpSrdf &srdf, vpArmUrdfSpec &spec, vpWarningList &warnings)
{
  tree.requireLink("base", spec.base);
  tree.requireLink("tip", spec.tip);
  if (spec.base.empty() && spec.tip.empty()) {
    Ends ends;
    const std::string group = groupOf(tree, srdf, spec.group, ends);
    if (!group.empty()) {
      spec.base = ends.base;
      spec.tip = ends.tip;
      warnings.add("base " + ends.base + " and tip " + ends.tip + " are those of the group ", group, " of the SRDF");
    }
  }
  if (spec.tip.empty()) {
    spec.tip = onlyLeaf(tree);
  }
  const std::vector<urdf::JointConstSharedPtr> way = upwards(tree, spec.tip);
  const std::string root = way.empty() ? spec.tip : way.back()->parent_link_name;
  spec.base = spec.base.empty() ? root : spec.base;
  if (!tree.joinedRoot.empty()) {
    for (const urdf::JointSharedPtr &joint : tree.model->getRoot()->child_joints) {
      if (joint->child_link_name != root) {
        warnings.add("links below the roots ", joint->child_link_name, " are not connected with the arm: left out");
      }
    }
  }
}

std::map<std::string, double> vpHomeState(const vpUrdfTree &tree, const vpSrdf &srdf, const vpArmUrdfSpec &spec,
                                          const std::vector<std::string> &chain, std::string &name)
{
  std::vector<std::string> names;
  for (const vpSrdfState &state : srdf.states) {
    names.push_back(state.name);
  }
  const auto missing = [&](const std::string &state) {
    const std::map<std::string, double> joints = stateOf(srdf, state);
    const auto joint =
        std::find_if(chain.begin(), chain.end(), [&](const std::string &j) { return joints.count(j) == 0; });
    return joint == chain.end() ? "" : *joint;
  };
  name = spec.homeState;
  if (!name.empty()) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      vpUrdfFail(tree.file, "home state " + name + " is not in the SRDF" +
                                (names.empty() ? "" : ", which has " + vpListed(names)));
    }
    if (!missing(name).empty()) {
      vpUrdfFail(tree.file, "home state " + name + " of the SRDF does not give joint " + missing(name));
    }
    return stateOf(srdf, name);
  }
  std::vector<std::string> candidates{"home", "ready", "default"};
  candidates.insert(candidates.end(), names.begin(), names.end());
  for (const std::string &candidate : candidates) {
    if (std::find(names.begin(), names.end(), candidate) != names.end() && missing(candidate).empty()) {
      name = candidate;
      return stateOf(srdf, candidate);
    }
  }
  return {};
}

END_VISP_NAMESPACE
