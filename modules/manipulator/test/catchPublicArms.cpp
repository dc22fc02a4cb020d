/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Public descriptions of arms: all load, move as KDL says, and hide nothing from a collision check.
#include "vpKdlTestKit.h"
#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpSrdf.h>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include <fstream>
#include <iostream>
#include <set>

using namespace vpArmTestKit;

namespace
{
struct Arm {
  const char *file, *base, *tip;
  int joints;
};

const std::string examples = "example-robot-data/robots/";
const Arm arms[] = {
    {"robots/fetch.urdf", "torso_lift_link", "gripper_link", 7},
    {"robots/fetch.urdf", "base_link", "gripper_link", 8},
    {"robots/fr3.urdf", "fr3_link0", "fr3_link8", 7},
    {"robots/franka_panda.urdf", "base_link", "ee_link", 7},
    {"robots/iiwa14_primitive_collision.urdf", "base", "iiwa_link_ee", 7},
    {"robots/irb120_3_58.urdf", "base_link", "tool0", 6},
    {"robots/kinovaGen3.urdf", "base_link", "EndEffector_Link", 7},
    {"robots/kinovaJacoJ2S7S300.urdf", "world", "j2s7s300_end_effector", 7},
    {"robots/kr6r900sixx.urdf", "base_link", "tool0", 6},
    {"robots/lrmate200id.urdf", "base_link", "tool0", 6},
    {"robots/panda.urdf", "panda_link0", "panda_hand_tcp", 7},
    {"robots/panda.urdf", "panda_link0", "panda_leftfinger", 8},
    {"robots/panda.urdf", "panda_link0", "panda_rightfinger", 8}, // mimics the other finger
    {"robots/pr2.urdf", "torso_lift_link", "r_gripper_tool_frame", 7},
    {"robots/pr2.urdf", "base_footprint", "l_gripper_tool_frame", 8},
    {"robots/pr2.urdf", "base_footprint", "l_forearm_cam_optical_frame", 6},
    {"robots/puma560_robot.urdf", "link1", "link7", 6},
    {"example-robot-data/robots/panda_description/urdf/panda.urdf", "", "panda_hand_tcp", 7},
    {"example-robot-data/robots/ur_description/urdf/ur5_robot.urdf", "", "tool0", 6},
    {"example-robot-data/robots/kinova_description/robots/kinova.urdf", "", "j2s6s200_end_effector", 6},
    {"example-robot-data/robots/tiago_description/robots/tiago_no_hand.urdf", "", "wrist_ft_tool_link", 8},
    {"example-robot-data/robots/tiago_description/robots/tiago_no_hand.urdf", "torso_lift_link", "wrist_ft_tool_link",
     7}};

urdf::ModelInterfaceSharedPtr treeOf(const std::string &file)
{
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return urdf::parseURDF(text.str());
}

double differenceFromKdl(const vpArmModel &model, const KDL::Chain &chain, std::mt19937_64 &rng)
{
  KDL::ChainFkSolverPos_recursive fk(chain);
  KDL::ChainJntToJacSolver jac(chain);
  KDL::JntArray q(chain.getNrOfJoints());
  KDL::Jacobian J(chain.getNrOfJoints());
  KDL::Frame pose;
  vpArmData data;
  double worst = 0.;
  for (int problem = 0; problem < 1000; ++problem) {
    const vpJointVector configuration = vpArmTestKit::configuration(model, rng);
    q.data = configuration;
    vpArmKinematics::update(model, configuration, data);
    fk.JntToCart(q, pose);
    jac.JntToJac(q, J);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        worst = std::max(worst, std::fabs(data.tool.R(i, j) - pose.M(i, j)));
      }
      worst = std::max(worst, std::fabs(data.tool.p(i) - pose.p(i)));
    }
    worst = std::max(worst, (data.J - J.data).cwiseAbs().maxCoeff());
  }
  return worst;
}

// Coordinate of a joint beside the chain at home, as documented.
double homeOf(const urdf::ModelInterface &tree, const urdf::Joint &joint)
{
  if (joint.mimic) {
    return joint.mimic->multiplier * homeOf(tree, *tree.getJoint(joint.mimic->joint_name)) + joint.mimic->offset;
  }
  return joint.type == urdf::Joint::CONTINUOUS ? 0. : std::clamp(0., joint.limits->lower, joint.limits->upper);
}

// Largest difference of the shapes of an arm whose other joints are held at home from those of the tree by KDL, m.
double differenceOfShapes(const vpArmModel &model, const urdf::ModelInterface &tree, const std::string &base,
                          std::mt19937_64 &rng)
{
  const vpJointVector q = vpArmTestKit::configuration(model, rng);
  std::map<std::string, double> coordinates;
  for (int i = 0; i < model.size(); ++i) {
    coordinates[model.spec().joints[static_cast<std::size_t>(i)].name] = q(i);
  }
  vpArmData data;
  vpArmKinematics::update(model, q, data);
  std::map<int, std::size_t> count; // shapes of each body so far
  double worst = 0.;
  for (const vpArmShape &shape : model.spec().shapes) {
    const vpArmBody &body = model.spec().bodies[static_cast<std::size_t>(shape.body)];
    std::vector<double> along;
    urdf::LinkConstSharedPtr link = tree.getLink(body.name);
    for (; link->name != base && link->parent_joint; link = link->getParent()) {
      const urdf::Joint &joint = *link->parent_joint;
      if (joint.type != urdf::Joint::FIXED) {
        const auto known = coordinates.find(joint.name);
        along.push_back(known != coordinates.end() ? known->second : homeOf(tree, joint));
      }
    }
    if (link->name != base) { // above the base
      continue;
    }
    const KDL::Chain chain = kdlChain(tree, base, body.name);
    KDL::JntArray coordinate(chain.getNrOfJoints());
    std::copy(along.rbegin(), along.rend(), coordinate.data.data());
    KDL::Frame pose;
    KDL::ChainFkSolverPos_recursive(chain).JntToCart(coordinate, pose);
    const urdf::LinkConstSharedPtr of = tree.getLink(body.name);
    pose = pose * kdlFrame(of->collision_array[count[shape.body]++]->origin);
    const vpRigidTransform ours = vpArmKinematics::link(model, data, body.link) * shape.pose;
    for (int i = 0; i < 3; ++i) {
      worst = std::max({worst, std::fabs(ours.p(i) - pose.p(i)), std::fabs(ours.R(i, 0) - pose.M(i, 0))});
    }
  }
  return worst;
}

// Every link of the tree with a shape has one that a check sees, or is named.
void requireNothingHidden(const vpArmSpec &arm, const urdf::ModelInterface &tree)
{
  const std::set<std::string> uncovered(arm.uncovered.begin(), arm.uncovered.end());
  std::set<std::string> covered;
  for (const vpArmCapsule &capsule : arm.capsules) {
    covered.insert(arm.bodies[static_cast<std::size_t>(capsule.body)].name);
  }
  CHECK(arm.bodies.size() == tree.links_.size());
  for (const auto &[name, link] : tree.links_) {
    if (!link->collision_array.empty() || !link->visual_array.empty()) {
      CAPTURE(name);
      CHECK(uncovered.count(name) + covered.count(name) > 0);
    }
  }
}
} // namespace

TEST_CASE("Public arms are KDL's, and nothing of them is hidden", "[public]")
{
  unsigned int stream = 0;
  for (const Arm &arm : arms) {
    const std::string file = vpTestSupport::caseFile(arm.file);
    auto rng = vpTestSupport::generator(stream++);
    if (file.empty()) {
      continue;
    }
    CAPTURE(vpTestSupport::seed(), arm.file, arm.tip);
    const urdf::ModelInterfaceSharedPtr tree = treeOf(file);
    REQUIRE(tree);
    vpArmUrdfSpec spec;
    spec.base = arm.base;
    spec.tip = arm.tip;
    const vpArmModel model = vpLoadArmUrdf(file, spec);
    REQUIRE(model.size() == arm.joints);
    const std::string base = spec.base.empty() ? tree->getRoot()->name : spec.base;
    const double worst = differenceFromKdl(model, kdlChain(*tree, base, arm.tip), rng);
    CHECK(worst < 1e-12);
    spec.holdOthers = true;
    const double worstShape = differenceOfShapes(vpLoadArmUrdf(file, spec), *tree, base, rng);
    CHECK(worstShape < 1e-12);
    requireNothingHidden(model.spec(), *tree);
    std::cout << arm.file << " to " << arm.tip << ": " << model.size() << " joints, difference from KDL " << worst
              << ", of shapes " << worstShape << ", " << model.spec().bodies.size() << " bodies, "
              << model.spec().shapes.size() << " shapes, " << model.spec().uncovered.size() << " uncovered, "
              << model.spec().warnings.size() << " warnings\n";
    for (const std::string &warning : model.spec().warnings) {
      CHECK(warning.find('\n') == std::string::npos);
    }
  }
}

TEST_CASE("An arm of which a joint is held is KDL's with the joint there", "[public]")
{
  unsigned int stream = 100;
  for (const Arm &arm : arms) {
    const std::string file = vpTestSupport::caseFile(arm.file);
    auto rng = vpTestSupport::generator(stream++);
    if (file.empty()) {
      continue;
    }
    vpArmUrdfSpec spec;
    spec.base = arm.base;
    spec.tip = arm.tip;
    const vpArmModel whole = vpLoadArmUrdf(file, spec);
    const int k = std::uniform_int_distribution<int>(0, whole.size() - 1)(rng);
    vpArmData data, heldData;
    for (int problem = 0; problem < 10; ++problem) {
      const vpJointVector q = vpArmTestKit::configuration(whole, rng);
      vpJointVector others(whole.size() - 1);
      others << q.head(k), q.tail(whole.size() - 1 - k);
      spec.held = {{whole.spec().joints[static_cast<std::size_t>(k)].name, q(k)}};
      const vpArmModel held = vpLoadArmUrdf(file, spec);
      CAPTURE(vpTestSupport::seed(), arm.file, arm.tip, k);
      REQUIRE(held.size() == whole.size() - 1);
      vpArmKinematics::update(whole, q, data);
      vpArmKinematics::update(held, others, heldData);
      CHECK(difference(data.tool, heldData.tool) < 1e-12);
    }
  }
}

TEST_CASE("The meshes of the examples are found, and held fingers belong to the hand", "[public]")
{
  const std::string file = vpTestSupport::caseFile(examples + "panda_description/urdf/panda.urdf");
  if (file.empty()) {
    return;
  }
  vpArmUrdfSpec spec;
  spec.srdf = vpTestSupport::caseFile(examples + "panda_description/srdf/panda.srdf");
  spec.held = {{"panda_finger_joint1", 0.03}};
  const vpArmModel model = vpLoadArmUrdf(file, spec);
  const vpArmSpec &arm = model.spec();
  CHECK(model.size() == 7); // the group arm ends at link 7
  CHECK(arm.bodies.back().link == 7);
  CHECK(arm.allowedBodies.size() == 35);
  CHECK(arm.uncovered.size() == 9); // links 0 to 7 and the hand: meshes
  const vpJointVector home = vector({0., -0.785398, 0., -2.35619, 0., 1.5707, 0.785398});
  CHECK((model.home() - home).norm() == 0.);
  for (const vpArmShape &shape : arm.shapes) {
    CHECK(shape.file.empty() == (shape.kind != vpArmShapeKind::Mesh));
    CHECK((shape.file.empty() || std::ifstream(shape.file).good()));
  }
  REQUIRE(arm.shapes.size() == 17); // with four boxes for each finger
  REQUIRE(arm.capsules.size() == 8);
  CHECK(arm.links[6].mass > 0.7);

  spec.held.clear(); // the fingers move by 0.04 m: their capsules enclose that
  const vpArmSpec moving = vpLoadArmUrdf(file, spec).spec();
  CHECK(moving.uncovered == arm.uncovered);
  CHECK(moving.shapes.size() == 9);
  CHECK(moving.links[6].mass == Approx(arm.links[6].mass));
  REQUIRE(moving.capsules.size() == 8);
  spec.holdOthers = true; // at home, which the SRDF's state gives as 0.001
  const vpArmSpec closed = vpLoadArmUrdf(file, spec).spec();
  REQUIRE(closed.shapes.size() == 17);
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(moving.capsules[i].radius == Approx(arm.capsules[i].radius + 0.02));
    CHECK((closed.capsules[i].from - arm.capsules[i].from).norm() == Approx(0.029));
  }
}

TEST_CASE("SRDF files of the examples give groups, pairs and states", "[public]")
{
  const std::string panda = vpTestSupport::caseFile(examples + "panda_description/srdf/panda.srdf");
  const std::string ur5 = vpTestSupport::caseFile(examples + "ur_description/srdf/ur5.srdf");
  const std::string kinova = vpTestSupport::caseFile(examples + "kinova_description/srdf/kinova.srdf");
  if (panda.empty() || ur5.empty() || kinova.empty()) {
    return;
  }
  const vpSrdf srdf = vpLoadSrdf(panda);
  CHECK(srdf.robot == "panda");
  CHECK(srdf.disabled.size() == 35);
  CHECK(srdf.disabled[3].second == "panda_link5");
  CHECK(srdf.disabled[3].reason == "Default");
  REQUIRE(srdf.groups.size() == 3);
  CHECK(srdf.groups[0].joints.size() == 7);
  CHECK(srdf.groups[2].groups == std::vector<std::string>{"arm", "hand"});
  REQUIRE(srdf.states.size() == 1);
  CHECK(srdf.states[0].joints.at("panda_joint6") == 1.5707);
  CHECK(vpLoadSrdf(ur5).disabled.size() == 10);
  CHECK(vpLoadSrdf(kinova).groups[0].chains ==
        std::vector<std::pair<std::string, std::string>>{{"base", "j2s6s200_end_effector"}});

  vpArmUrdfSpec spec;
  spec.srdf = kinova;
  const std::string robot = vpTestSupport::caseFile(examples + "kinova_description/robots/kinova.urdf");
  const vpArmModel arm = vpLoadArmUrdf(robot, spec);
  CHECK(arm.size() == 6);
  CHECK(arm.spec().bodies[0].name == "base");
  // Its state has joint 3 at -1.5707, where the URDF allows 0.33 to 5.95 rad.
  CHECK(arm.spec().home.size() == 0);
  CHECK(std::any_of(arm.spec().warnings.begin(), arm.spec().warnings.end(), [](const std::string &warning) {
    return warning == "state arm_up of the SRDF is not taken as home: it is beyond the limits of j2s6s200_joint_3";
  }));
  spec.homeState = "arm_up";
  CHECK_THROWS_WITH(vpLoadArmUrdf(robot, spec), Catch::Contains("home of joint j2s6s200_joint_3 is -1.5707"));
  spec.homeState = "arm_down";
  CHECK_THROWS_WITH(vpLoadArmUrdf(robot, spec),
                    Catch::Contains("home state arm_down is not in the SRDF, which has arm_up"));
}
