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

// A moving joint of the chain: it follows one of these, or decides itself (leader: its own index).
struct Moving {
  vpArmJointSpec joint;
  std::size_t leader = 0;
  double ratio = 1., offset = 0.;
};

class Loader
{
public:
  Loader(const std::string &file, const vpArmUrdfSpec &spec)
    : m_spec(spec), m_tree(vpUrdfTree::read(file, m_warnings)),
      m_srdf(spec.srdf.empty() ? vpSrdf() : vpLoadSrdf(spec.srdf)), m_posture(m_tree, spec.held)
  {
    m_arm.source = file;
    m_arm.name = m_tree.model->getName();
    m_tree.requireLink("camera", m_spec.camera);
    m_tree.requireLink("tool", m_spec.tool);
    vpCompleteEnds(m_tree, m_srdf, m_spec, m_warnings);
    m_chain = m_tree.path(m_spec.base, m_spec.tip);
    home();
    readChain();
    readLimits();
    follow();
    setVelocity();
    setHome();
    setTool();
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
      if (!m_posture.stands(*joint) && &deciding(*joint) == joint.get()) {
        moving.push_back(joint->name);
      }
    }
    m_state = vpHomeState(m_tree, m_srdf, m_spec, moving, m_stateName);
    if (m_spec.holdOthers) {
      m_posture.holdOthers(chain, m_state);
    }
  }

  // The joint of the chain that decides on the coordinate of this one: the one that it mimics, else the first that
  // mimics the same one beside the chain.
  [[nodiscard]] const urdf::Joint &deciding(const urdf::Joint &joint) const
  {
    double ratio = 1., offset = 0.;
    const std::string leader = m_posture.leader(joint, ratio, offset).name;
    const urdf::Joint *first = nullptr;
    for (const urdf::JointConstSharedPtr &other : m_chain) {
      if (other->name == leader) {
        return *other;
      }
      if (!first && !m_posture.stands(*other) && m_posture.leader(*other, ratio, offset).name == leader) {
        first = other.get();
      }
    }
    return *first;
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
        m_moving.push_back({moving(*from), m_moving.size()});
        vpArmJointSpec &joint = m_moving.back().joint;
        joint.before = fixed * joint.before;
        fixed = {};
        bodies.nextLink(child->name);
      }
      bodies.add(*child, fixed);
    }
    m_arm.tool = fixed;
    if (m_moving.size() <= static_cast<std::size_t>(vpArmMaxJoints)) { // else vpArmModel refuses it
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
    if (&deciding(from) == &from) {
      narrowToLeader(from, joint);
    }
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
  void narrowToLeader(const urdf::Joint &from, vpArmJointSpec &joint)
  {
    double ratio = 1., offset = 0.;
    const urdf::Joint &leader = m_posture.leader(from, ratio, offset);
    if (leader.name == from.name) {
      return;
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
      for (Moving &moved : m_moving) {
        vpArmJointSpec &joint = moved.joint;
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
  }

  // Splits the moving joints into those that decide and those that follow one of them.
  void follow()
  {
    for (Moving &moved : m_moving) {
      const urdf::Joint &own = *m_tree.model->getJoint(moved.joint.name), &leader = deciding(own);
      const auto found = std::find_if(m_moving.begin(), m_moving.end(),
                                      [&leader](const Moving &other) { return other.joint.name == leader.name; });
      double ratio = 1., offset = 0.; // of the leader to what both mimic
      static_cast<void>(m_posture.leader(own, moved.ratio, moved.offset));
      static_cast<void>(m_posture.leader(leader, ratio, offset));
      moved.leader = static_cast<std::size_t>(found - m_moving.begin());
      moved.ratio /= ratio;
      moved.offset -= moved.ratio * offset;
    }
    std::vector<int> index(m_moving.size());
    for (std::size_t k = 0; k < m_moving.size(); ++k) {
      if (m_moving[k].leader != k) {
        allowFor(m_moving[k], m_moving[m_moving[k].leader].joint);
      }
    }
    for (std::size_t k = 0; k < m_moving.size(); ++k) {
      if (m_moving[k].leader == k) {
        index[k] = static_cast<int>(m_arm.joints.size());
        m_arm.joints.push_back(m_moving[k].joint);
      }
    }
    int place = 0;
    for (std::size_t k = 0; k < m_moving.size(); ++k) {
      const Moving &moved = m_moving[k];
      if (moved.leader == k) {
        ++place;
        continue;
      }
      m_arm.followers.push_back({moved.joint.name, moved.joint.type, moved.joint.before, moved.joint.after,
                                 index[moved.leader], moved.ratio, moved.offset, place});
      m_warnings.add("joints of the chain that follow another one by a fixed ratio: ",
                     moved.joint.name + " follows " + m_moving[moved.leader].joint.name, "");
    }
  }

  // Limits and friction of a follower count for the joint that it follows.
  void allowFor(const Moving &moved, vpArmJointSpec &leader)
  {
    const vpArmJointSpec &joint = moved.joint;
    const double ratio = std::fabs(moved.ratio);
    if (joint.type != vpJointType::Continuous) {
      const double a = (joint.lower - moved.offset) / moved.ratio, b = (joint.upper - moved.offset) / moved.ratio;
      if (leader.type == vpJointType::Continuous) {
        leader.type = vpJointType::Revolute;
        leader.lower = -vpLargestCoordinate;
        leader.upper = vpLargestCoordinate;
      }
      narrow(leader, std::min(a, b), std::max(a, b), "limits of " + joint.name + ", which follows it");
    }
    leader.velocity = std::min(leader.velocity, joint.velocity / ratio);
    leader.acceleration = std::min(leader.acceleration, joint.acceleration / ratio);
    leader.viscous += ratio * ratio * joint.viscous;
    leader.coulomb += ratio * joint.coulomb;
  }

  void setVelocity()
  {
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

  // The link of the arm that carries a link of the file, through joints that stand still only, and where.
  int carrierOf(const std::string &what, const std::string &name, vpRigidTransform &at) const
  {
    at = {};
    for (urdf::LinkConstSharedPtr link = m_tree.link(name);;) {
      const urdf::JointConstSharedPtr joint = m_tree.above(*link);
      if (!joint) {
        fail(what + " link " + name + " is not below a moving joint of the arm");
      }
      for (std::size_t k = 0; k < m_moving.size(); ++k) {
        if (m_moving[k].joint.name == joint->name) {
          return static_cast<int>(k) + 1;
        }
      }
      if (!m_posture.stands(*joint)) {
        fail("joint " + joint->name + " between the arm and the " + what + " link " + name + " is not fixed");
      }
      at = m_posture.frame(*joint) * at;
      link = m_tree.link(joint->parent_link_name);
    }
  }

  void setTool()
  {
    if (!m_spec.tool.empty()) {
      const int link = carrierOf("tool", m_spec.tool, m_arm.tool);
      m_arm.toolLink = link == static_cast<int>(m_moving.size()) ? -1 : link;
    }
  }

  void setCamera()
  {
    if (m_spec.camera.empty()) {
      return;
    }
    m_arm.cameraLink = carrierOf("camera", m_spec.camera, m_arm.camera);
    if (m_arm.cameraLink == (m_arm.toolLink < 0 ? static_cast<int>(m_moving.size()) : m_arm.toolLink)) {
      m_arm.cameraLink = -1;
      m_arm.camera = m_arm.tool.inverse() * m_arm.camera;
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
  std::vector<Moving> m_moving;
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
