/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpJointLimitsYaml.h"
#include "vpReading.h"
#include "vpUrdfBodies.h"
#include "vpUrdfGroups.h"

#include <visp3/direct_core/vpLimit.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double unknown = std::numeric_limits<double>::infinity();

using Joints = std::vector<urdf::JointConstSharedPtr>;

class Loader
{
public:
  Loader(const std::string &file, const vpArmUrdfSpec &spec)
    : m_spec(spec), m_tree(vpUrdfTree::read(file, m_warnings)),
      m_srdf(spec.srdf.empty() ? vpSrdf() : vpLoadSrdf(spec.srdf)), m_posture(m_tree, spec.held)
  {
    m_arm.source = file;
    m_arm.name = m_tree.model->getName();
    vpCompleteEnds(m_tree, m_srdf, m_spec, m_warnings);
    m_chain = m_tree.path(m_spec.base, m_spec.tip);
    home();
    readChain();
    readLimits();
    setHome();
    setCamera();
    setAllowedBodies();
    m_arm.warnings = m_warnings.sentences();
  }
  [[nodiscard]] const vpArmSpec &arm() const { return m_arm; }

private:
  [[noreturn]] void fail(const std::string &sentence) const { vpUrdfFail(m_tree.file, sentence); }

  // Finds the home state, and which joints stand there.
  void home()
  {
    std::vector<std::string> moving;
    std::set<std::string> chain;
    for (const urdf::JointConstSharedPtr &joint : m_chain) {
      double ratio = 1., offset = 0.;
      chain.insert({joint->name, m_posture.leader(*joint, ratio, offset).name});
      if (!m_posture.stands(*joint)) {
        moving.push_back(joint->name);
      }
    }
    m_state = vpHomeState(m_tree, m_srdf, m_spec, moving, m_stateName);
    if (m_spec.holdOthers) {
      m_posture.holdOthers(chain, m_state);
    }
  }

  void readChain()
  {
    const vpMeshPath paths(m_tree.file, m_spec.packagePaths);
    std::set<std::string> names;
    for (const urdf::JointConstSharedPtr &joint : m_chain) {
      names.insert(joint->name);
    }
    vpUrdfBodies bodies(m_tree, m_posture, paths, names, m_warnings);
    bodies.addBase(m_spec.base);
    vpRigidTransform fixed; // of the current link in the last moving one
    for (const urdf::JointConstSharedPtr &from : m_chain) {
      const urdf::LinkConstSharedPtr child = m_tree.link(from->child_link_name);
      if (m_posture.stands(*from)) {
        fixed = fixed * m_posture.frame(*from);
      }
      else {
        vpArmJointSpec joint = moving(*from);
        joint.before = fixed * joint.before;
        fixed = {};
        m_arm.joints.push_back(joint);
        bodies.nextLink(child->name);
      }
      bodies.add(*child, fixed);
    }
    m_arm.tool = fixed;
    if (m_arm.joints.size() <= static_cast<std::size_t>(vpArmMaxJoints)) { // else vpArmModel refuses it
      bodies.finish(m_arm);
    }
  }

  vpArmJointSpec moving(const urdf::Joint &from)
  {
    vpArmJointSpec joint;
    joint.name = from.name;
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
      fail("joint " + from.name + " is floating or planar, must be revolute, continuous, prismatic or fixed");
    }
    const Eigen::Vector3d axis(from.axis.x, from.axis.y, from.axis.z);
    if (!(axis.norm() > 1e-9)) {
      fail("axis of joint " + from.name + " is zero");
    }
    // Joints of vpArmModel move about z: rotate z to the axis, and back after the motion.
    const Eigen::Matrix3d turn = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis).toRotationMatrix();
    joint.before = vpUrdfPose(from.parent_to_joint_origin_transform) * vpRigidTransform{turn, Eigen::Vector3d::Zero()};
    joint.after.R = turn.transpose();
    joint.acceleration = m_spec.acceleration;
    if (from.dynamics) {
      joint.viscous = from.dynamics->damping;
      joint.coulomb = from.dynamics->friction;
    }
    setLimits(from, joint);
    followLeader(from, joint);
    return joint;
  }

  // The limit, or infinity with a warning if the file has none.
  double known(const std::string &what, const std::string &joint, double limit)
  {
    if (limit > 0. && limit <= vpArmLargest) {
      return limit;
    }
    m_warnings.add("the " + what + " limit of ", joint, " is missing, not > 0 or beyond 1e9: taken as unknown");
    return unknown;
  }

  void setLimits(const urdf::Joint &from, vpArmJointSpec &joint)
  {
    if (!from.limits) {
      return;
    }
    joint.lower = from.limits->lower;
    joint.upper = from.limits->upper;
    joint.velocity = known("velocity", from.name, from.limits->velocity);
    joint.torque = known("effort", from.name, from.limits->effort);
    const auto given = m_tree.given.find(from.name);
    if (joint.type == vpJointType::Continuous || given == m_tree.given.end()) {
      return;
    }
    if (given->second.lower != given->second.upper) {
      m_warnings.add("only one position limit is given of ", from.name, ": the other is 0 in this format");
    }
    if (m_spec.softLimits && from.safety) {
      narrow(joint, given->second.softLower ? from.safety->soft_lower_limit : -unknown,
             given->second.softUpper ? from.safety->soft_upper_limit : unknown, "soft limits");
    }
  }

  void narrow(vpArmJointSpec &joint, double lower, double upper, const std::string &by)
  {
    lower = std::max(joint.lower, lower);
    upper = std::min(joint.upper, upper);
    if (!(lower < upper)) {
      m_warnings.add("the " + by + " of ", joint.name, " leave no range: not used");
    }
    else if (lower > joint.lower || upper < joint.upper) {
      joint.lower = lower;
      joint.upper = upper;
      m_warnings.add("the position limits of ", joint.name, " are narrowed by the " + by);
    }
  }

  // A joint that mimics one beside the chain moves on its own, as far as the other can go with it.
  void followLeader(const urdf::Joint &from, vpArmJointSpec &joint)
  {
    double ratio = 1., offset = 0.;
    const urdf::Joint &leader = m_posture.leader(from, ratio, offset);
    if (leader.name == from.name) {
      return;
    }
    if (std::any_of(m_chain.begin(), m_chain.end(), [&](const auto &other) {
          double otherRatio = 1., otherOffset = 0.;
          return other->name != from.name && m_posture.leader(*other, otherRatio, otherOffset).name == leader.name;
        })) {
      fail("joint " + from.name + " mimics joint " + leader.name +
           " and both move the tip, which this model cannot express; hold one of them or end the chain before");
    }
    m_warnings.add("joints of the chain that mimic one beside it move on their own: ", from.name, "");
    if (leader.limits && leader.type != urdf::Joint::CONTINUOUS && joint.type != vpJointType::Continuous &&
        leader.limits->lower < leader.limits->upper) {
      const double a = ratio * leader.limits->lower + offset, b = ratio * leader.limits->upper + offset;
      narrow(joint, std::min(a, b), std::max(a, b), "limits of " + leader.name);
    }
  }

  void readLimits()
  {
    if (!m_spec.limits.empty()) {
      std::map<std::string, vpJointLimits> limits = vpReadJointLimits(m_spec.limits);
      for (vpArmJointSpec &joint : m_arm.joints) {
        const vpJointLimits &own = limits[joint.name];
        joint.velocity = own.velocity.value_or(joint.velocity);
        joint.acceleration = own.acceleration.value_or(joint.acceleration);
        joint.torque = own.torque.value_or(joint.torque);
        if (joint.type != vpJointType::Continuous && own.lower) {
          if (!(std::max(joint.lower, *own.lower) < std::min(joint.upper, *own.upper))) {
            vpUrdfFail(m_spec.limits, "leaves joint " + joint.name + " no range of positions");
          }
          narrow(joint, *own.lower, *own.upper, "limits of " + m_spec.limits);
        }
      }
      for (const auto &item : limits) {
        if (!m_tree.model->getJoint(item.first)) {
          m_warnings.add(m_spec.limits + " has joints that the URDF does not have: ", item.first, "");
        }
      }
    }
    if (m_spec.velocity.size() > 0) {
      if (m_spec.velocity.size() != static_cast<Eigen::Index>(m_arm.joints.size())) {
        fail(std::to_string(m_spec.velocity.size()) + " velocity limits for " + std::to_string(m_arm.joints.size()) +
             " joints, must be as many");
      }
      for (std::size_t i = 0; i < m_arm.joints.size(); ++i) {
        m_arm.joints[i].velocity = m_spec.velocity(static_cast<Eigen::Index>(i));
      }
    }
  }

  void setHome()
  {
    m_arm.home = m_spec.home;
    if (m_spec.home.size() > 0 || m_state.empty() || m_arm.joints.size() > static_cast<std::size_t>(vpArmMaxJoints)) {
      return;
    }
    vpJointVector home(static_cast<Eigen::Index>(m_arm.joints.size()));
    for (std::size_t i = 0; i < m_arm.joints.size(); ++i) {
      const vpArmJointSpec &joint = m_arm.joints[i];
      const double q = m_state.at(joint.name);
      const bool isInside = joint.type == vpJointType::Continuous ? std::fabs(q) <= vpArmLargest
                                                                  : vpLimit::isBetween(joint.lower, q, joint.upper);
      if (m_spec.homeState.empty() && !isInside) {
        m_warnings.add("state " + m_stateName + " of the SRDF is not taken as home: it is beyond the limits of ",
                       joint.name, "");
        return;
      }
      home(static_cast<Eigen::Index>(i)) = q;
    }
    m_arm.home = home;
    if (m_spec.homeState.empty()) {
      m_warnings.add("home is the state ", m_stateName, " of the SRDF");
    }
  }

  void setCamera()
  {
    if (m_spec.camera.empty()) {
      return;
    }
    const std::string last =
        m_arm.joints.empty() ? m_spec.base : m_tree.model->getJoint(m_arm.joints.back().name)->child_link_name;
    // Up or down from the end effector through joints that stand still only.
    const auto fixedTo = [&](const std::string &link) {
      vpRigidTransform T;
      for (const urdf::JointConstSharedPtr &joint : m_tree.path(last, link)) {
        if (!m_posture.stands(*joint)) {
          fail("joint " + joint->name + " between the end effector and the camera is not fixed");
        }
        T = T * m_posture.frame(*joint);
      }
      return T;
    };
    requireBelow(m_spec.camera, last);
    m_arm.camera = fixedTo(m_spec.tip).inverse() * fixedTo(m_spec.camera);
  }

  void requireBelow(const std::string &camera, const std::string &last) const
  {
    for (urdf::LinkConstSharedPtr link = m_tree.link(camera); link->name != last;) {
      const urdf::JointConstSharedPtr joint = m_tree.above(*link);
      if (!joint) {
        fail("camera link " + camera + " is not below link " + last + ", to which the end effector " + m_spec.tip +
             " is fixed; for a camera on an earlier link give that as the tip");
      }
      link = m_tree.link(joint->parent_link_name);
    }
  }

  void setAllowedBodies()
  {
    std::set<std::string> bodies;
    for (const vpArmBody &body : m_arm.bodies) {
      bodies.insert(body.name);
    }
    for (const vpSrdfPair &pair : m_srdf.disabled) {
      for (const std::string &name : {pair.first, pair.second}) {
        if (!m_tree.model->getLink(name)) {
          m_warnings.add("the SRDF has links that the URDF does not have: ", name, "");
        }
      }
      if (bodies.count(pair.first) > 0 && bodies.count(pair.second) > 0 && pair.first != pair.second) {
        m_arm.allowedBodies.emplace_back(pair.first, pair.second);
      }
    }
    if (!m_srdf.robot.empty() && m_srdf.robot != m_arm.name) {
      m_warnings.add("the SRDF is of the robot ", m_srdf.robot, ", the URDF of " + m_arm.name);
    }
  }

  vpArmUrdfSpec m_spec; // completed
  vpWarningList m_warnings;
  vpUrdfTree m_tree;
  vpSrdf m_srdf;
  vpUrdfPosture m_posture;
  Joints m_chain; // from base to tip
  std::string m_stateName;
  std::map<std::string, double> m_state; // home, by joint
  vpArmSpec m_arm;
};
} // namespace

vpArmModel vpLoadArmUrdf(const std::string &file, const vpArmUrdfSpec &spec)
{
  return vpReading([&] { return vpArmModel(Loader(file, spec).arm()); });
}

END_VISP_NAMESPACE
