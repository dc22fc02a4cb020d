/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-arm on public robots: what it says of them, where it puts the tool (KDL from the same file), what touches.
#include "vpCaseFile.h"
#include "vpCatch.h"

#include "jsonReader.h"
#include "programRun.h"

#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>
#include <sstream>

namespace
{
using Catch::Contains;
using nlohmann::json;

//! \brief A public description, and which part of it is the arm.
struct PublicArm {
  const char *file, *base, *tip;
  bool usable;       //!< Its meshes are there, or it has none.
  const char *other; //!< Further options.
};

const std::string ROBOTS = "example-robot-data/robots/";

const PublicArm arms[] = {
    {"example-robot-data/robots/panda_description/urdf/panda.urdf", "panda_link0", "panda_link8", true,
     "--hold all --covers 1"},
    {"example-robot-data/robots/ur_description/urdf/ur5_robot.urdf", "world", "tool0", true, "--covers 3"},
    {"example-robot-data/robots/kinova_description/robots/kinova.urdf", "base", "j2s6s200_end_effector", false,
     "--hold all"},
    {"example-robot-data/robots/tiago_description/robots/tiago_no_hand.urdf", "torso_lift_link", "arm_tool_link", true,
     "--hold all --ignore-link head_1_link,head_2_link,base_link,base_cover_link,caster_back_left_1_link,"
     "caster_back_right_1_link,caster_front_left_1_link,caster_front_right_1_link --covers 1"},
    {"robots/fetch.urdf", "torso_lift_link", "gripper_link", false, ""},
    {"robots/fr3.urdf", "fr3_link0", "fr3_link8", false, ""},
    {"robots/franka_panda.urdf", "base_link", "ee_link", false, ""},
    {"robots/iiwa14_primitive_collision.urdf", "base", "iiwa_link_ee", false, ""},
    {"robots/irb120_3_58.urdf", "base_link", "tool0", false, ""},
    {"robots/kinovaGen3.urdf", "base_link", "EndEffector_Link", false, ""},
    {"robots/kinovaJacoJ2S7S300.urdf", "world", "j2s7s300_end_effector", false, ""},
    {"robots/kr6r900sixx.urdf", "base_link", "tool0", false, ""},
    {"robots/lrmate200id.urdf", "base_link", "tool0", false, ""},
    {"robots/panda.urdf", "panda_link0", "panda_link8", true, "--covers 1"}, // with the meshes of example-robot-data
    {"robots/pr2.urdf", "torso_lift_link", "r_gripper_palm_link", false, ""},
    {"robots/puma560_robot.urdf", "link1", "link7", false, ""}};

KDL::Frame kdlFrame(const urdf::Pose &pose)
{
  return {KDL::Rotation::Quaternion(pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

//! The chain as urdfdom reads it, joint by joint.
KDL::Chain kdlChain(const std::string &file, const std::string &base, const std::string &tip)
{
  const urdf::ModelInterfaceSharedPtr tree = urdf::parseURDFFile(file);
  REQUIRE(tree);
  std::vector<urdf::JointConstSharedPtr> joints;
  for (std::string link = tip; link != base; link = joints.back()->parent_link_name) {
    REQUIRE(tree->getLink(link));
    REQUIRE(tree->getLink(link)->parent_joint);
    joints.push_back(tree->getLink(link)->parent_joint);
  }
  std::reverse(joints.begin(), joints.end());
  KDL::Chain chain;
  for (const urdf::JointConstSharedPtr &joint : joints) {
    const KDL::Frame at = kdlFrame(joint->parent_to_joint_origin_transform);
    const KDL::Vector axis = at.M * KDL::Vector(joint->axis.x, joint->axis.y, joint->axis.z);
    KDL::Joint moving(joint->name, KDL::Joint::None);
    if (joint->type == urdf::Joint::PRISMATIC) {
      moving = KDL::Joint(joint->name, at.p, axis, KDL::Joint::TransAxis);
    }
    else if (joint->type != urdf::Joint::FIXED) {
      moving = KDL::Joint(joint->name, at.p, axis, KDL::Joint::RotAxis);
    }
    chain.addSegment(KDL::Segment(joint->name, moving, at));
  }
  return chain;
}

std::vector<std::string> namesOf(const KDL::Chain &chain)
{
  std::vector<std::string> names;
  for (unsigned int i = 0; i < chain.getNrOfSegments(); ++i) {
    if (chain.getSegment(i).getJoint().getType() != KDL::Joint::None) {
      names.push_back(chain.getSegment(i).getJoint().getName());
    }
  }
  return names;
}

//! Random angles of a few rad, beyond limits too: kinematics does not know them.
std::vector<double> randomPose(std::size_t n, std::mt19937_64 &rng)
{
  std::vector<double> q(n);
  std::generate(q.begin(), q.end(), [&] { return std::uniform_real_distribution<double>(-3., 3.)(rng); });
  return q;
}

std::string listOf(const std::vector<double> &q)
{
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < q.size(); ++i) {
    text << (i > 0 ? "," : "") << q[i];
  }
  return text.str();
}

void checkPose(const KDL::Chain &chain, const std::vector<double> &q, const json &rows)
{
  KDL::JntArray joints(static_cast<unsigned int>(q.size()));
  for (unsigned int i = 0; i < q.size(); ++i) {
    joints(i) = q[i];
  }
  KDL::Frame tool;
  REQUIRE(KDL::ChainFkSolverPos_recursive(chain).JntToCart(joints, tool) >= 0);
  REQUIRE(rows.size() == 4);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      CHECK(std::fabs(rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].get<double>() - tool(i, j)) <
            1e-12);
    }
  }
}

void checkLinks(const json &links)
{
  const std::vector<std::string> kinds = {"cover", "mesh", "ignored", "none"};
  CHECK(!links.empty());
  for (const json &link : links) {
    CAPTURE(link);
    CHECK(!link["name"].get<std::string>().empty());
    CHECK(std::count(kinds.begin(), kinds.end(), link["geometry"].get<std::string>()) == 1);
    CHECK((link["covers"] > 0) == (link["geometry"] == "cover"));
  }
}

//! The folder in which the fits are kept during the tests.
std::string cache(const ProgramRun &run) { return "XDG_CACHE_HOME='" + run.path("cache").string() + "'"; }
} // namespace

TEST_CASE("What is said of public robots", "[visp-arm]")
{
  std::mt19937_64 rng = vpTestSupport::generator(1);
  for (const PublicArm &arm : arms) {
    const std::string file = vpTestSupport::caseFile(arm.file);
    if (file.empty()) {
      continue;
    }
    CAPTURE(arm.file);
    const KDL::Chain chain = kdlChain(file, arm.base, arm.tip);
    const std::vector<double> q = randomPose(chain.getNrOfJoints(), rng);
    ProgramRun run(ARM);
    const int status = run("'" + file + "' --robot-base " + arm.base + " --robot-tip " + arm.tip + " " + arm.other +
                               " --json --out result --fk " + listOf(q),
                           cache(run));
    CAPTURE(run.err(), status);
    REQUIRE(!run.out().empty());
    const json answer = vpApp::parseJson(run.out(), "visp-arm");
    CHECK(status == (arm.usable ? 0 : 1));
    CHECK(answer["problems"].empty() == arm.usable);
    std::vector<std::string> names;
    for (const json &joint : answer["joints"]) {
      names.push_back(joint["name"]);
      CHECK((joint["type"] == "continuous") == joint["lower"].is_null());
      CHECK((joint["velocity"].is_null() || joint["velocity"] > 0.));
    }
    CHECK(names == namesOf(chain));
    checkLinks(answer["links"]);
    REQUIRE(answer.contains("pose"));
    checkPose(chain, q, answer["pose"]);
    const json shown = vpApp::readJsonFile(run.path("result/arm.json").string());
    CHECK(shown["joints"].size() == names.size());
    for (const json &shape : shown["shapes"]) {
      CHECK((shape["kind"] == "mesh") == shape["file"].is_string());
      CHECK(
          (shape["file"].is_null() || std::filesystem::exists(run.path("result") / shape["file"].get<std::string>())));
    }
    CHECK(vpApp::readJsonFile(run.path("result/robot.json").string())["links"] == answer["links"]);
  }
}

TEST_CASE("The pillar in the forearm of the UR5 is seen", "[visp-arm]")
{
  const std::string file = vpTestSupport::caseFile(ROBOTS + "ur_description/urdf/ur5_robot.urdf");
  const std::string scene = vpTestSupport::caseFile("scenes/ur5-pillar.json");
  if (file.empty() || scene.empty()) {
    return;
  }
  ProgramRun run(ARM);
  const auto touches = [&](const std::string &at) {
    const int status = run("'" + file + "' --robot-tip tool0 --json --touches '" + scene + "' --at " + at, cache(run));
    CAPTURE(run.err());
    REQUIRE(status == 0);
    std::vector<std::string> touching;
    const json answer = vpApp::parseJson(run.out(), "visp-arm");
    for (const json &pair : answer["touches"]) {
      if (pair[1] == "pillar") {
        touching.push_back(pair[0]);
      }
    }
    return touching;
  };
  const std::vector<std::string> middle = touches("1.5,-1.2,0.6,-1.0,-1.57,0.0");
  CHECK(std::count(middle.begin(), middle.end(), "forearm_link") == 1);
  CHECK(touches("2.4,-1.2,0.6,-1.0,-1.57,0.0").empty()); // the goal
}

TEST_CASE("Without any option the program tells of AMOR", "[visp-arm]")
{
  ProgramRun run(ARM);
  REQUIRE(run("") == 0);
  for (const char *piece : {"AMOR: 7 joints", "continuous", "cover", "neighbours"}) {
    CHECK_THAT(run.out(), Contains(piece));
  }
  CHECK(run.err().empty());
  CHECK(run.entries().empty());
  REQUIRE(run("--json --fk 0,0,0,0,0,0,0 --acceleration-limits 3 --home 0.1,0.9,-1.2,-2.4,-2.6,-1.1,0.3") == 0);
  const json answer = vpApp::parseJson(run.out(), "visp-arm");
  for (const json &joint : answer["joints"]) {
    CHECK(joint["acceleration"] == 3.);
    CHECK(joint["from"]["acceleration"] == "--acceleration-limits");
    CHECK(joint["from"]["velocity"] == "file");
  }
  CHECK(answer["joints"][6]["home"] == 0.3);
}

TEST_CASE("A robot that is not usable ends with the reason", "[visp-arm]")
{
  const std::string two = "<robot name='two'><link name='a'/><link name='b'>GEOMETRY</link>"
                          "<joint name='j' type='revolute'><parent link='a'/><child link='b'/>"
                          "<limit lower='-1' upper='1' velocity='0' effort='1'/></joint></robot>";
  const auto with = [&](const std::string &geometry) {
    std::string text = two;
    return text.replace(text.find("GEOMETRY"), 8, geometry);
  };
  ProgramRun run(ARM);
  run.write("mesh.urdf", with("<collision><geometry><mesh filename='package://none/b.stl'/></geometry></collision>"));
  CHECK(run("mesh.urdf --json", cache(run)) == 1);
  CHECK_THAT(run.err(), Contains("visp-arm: mesh.urdf: collision checks would not see link b;"));
  CHECK_THAT(run.err(), Contains("--package-path") && Contains("--ignore-link"));
  CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
  const json answer = vpApp::parseJson(run.out(), "visp-arm");
  REQUIRE(answer["problems"].size() == 1);
  CHECK(run.err() == "visp-arm: " + answer["problems"][0].get<std::string>() + "\n");
  CHECK(run("mesh.urdf --json --ignore-link b", cache(run)) == 1); // then nothing of it is checked
  CHECK_THAT(run.err(), Contains("no link has a shape"));
  CHECK(run("mesh.urdf --ignore-link c", cache(run)) == 2);
  CHECK_THAT(run.err(), Contains("--ignore-link: unknown link \"c\"; known are a and b"));

  run.write("ball.urdf", with("<collision><geometry><sphere radius='0.1'/></geometry></collision>"));
  CHECK(run("ball.urdf", cache(run)) == 0);
  CHECK_THAT(run.out(), Contains("joint j has no velocity limit, --velocity-limits"));
  CHECK(run("ball.urdf --velocity-limits 2", cache(run)) == 0);
  CHECK_THAT(run.out(), !Contains("has no velocity limit"));

  CHECK(run("none.urdf --json") == 1);
  CHECK_THAT(run.err(), Contains("none.urdf"));
  CHECK(vpApp::parseJson(run.out(), "visp-arm")["problems"].size() == 1);
}

TEST_CASE("Mistakes on the command line of visp-arm", "[visp-arm]")
{
  ProgramRun run(ARM);
  const std::pair<const char *, const char *> mistakes[] = {
      {"--fk 1,2", "--fk has 2 numbers, must have 7"},
      {"--fk 1,,2", "--fk is , must be a number"},
      {"--at 1,2,3,4,5,6,7", "--at needs the scene, --touches FILE.json"},
      {"--touches x.json", "--touches needs the configuration, --at Q,..."},
      {"arm.step", "FILE is arm.step, must be amor, a .urdf or a .json file"},
      {"--robot-tip hand", "--robot-tip is for a .urdf file, the robot is amor"},
      {"--home ready", "--home with the name of a state is for a .urdf file"},
      {"--home 1,2", "--home has 2 numbers, must have 7"},
      {"--velocity-limits 1,2", "--velocity-limits has 2 numbers, must have one or 7"},
      {"--velocity-limits 0", "--velocity-limits is 0, must be a number > 0"},
      {"--hold finger", "--hold is finger, must be JOINT=VALUE"},
      {"--hold f=1,g=x", "--hold g is x, must be a number"},
      {"--hold f=1,f=2", "--hold names joint f twice"},
      {"--covers 0", "--covers is 0, must be a whole number from 1 to 8"}};
  for (const auto &[arguments, sentence] : mistakes) {
    CAPTURE(arguments);
    CHECK(run(arguments) == 2);
    CHECK_THAT(run.err(), Contains(sentence));
    CHECK(run.out().empty());
  }
}
