/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What SRDF files and files of joint limits add to a URDF, and what is refused of them.
#include "vpArmTestKit.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpSrdf.h>

#include <cstdio>
#include <fstream>

using namespace vpArmTestKit;

namespace
{
using Sentences = std::vector<std::string>;

std::string write(const std::string &name, const std::string &content)
{
  const std::string file = "catchArmSettings-" + name;
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

std::string errorOf(const std::function<void()> &action)
{
  try {
    action();
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}

std::string srdfError(const std::string &content)
{
  const std::string file = write("own.srdf", content);
  const std::string error = errorOf([&] { static_cast<void>(vpLoadSrdf(file)); });
  std::remove(file.c_str());
  return error;
}

// The six axes of data/robot with an SRDF and a file of limits.
vpArmSpec sixAxesWith(const std::string &srdf, const std::string &limits, vpArmUrdfSpec spec = {})
{
  if (!srdf.empty()) {
    spec.srdf = write("own.srdf", "<robot name='generic-6r'>" + srdf + "</robot>");
  }
  if (!limits.empty()) {
    spec.limits = write("own.yaml", limits);
  }
  if (srdf.find("<group ") == std::string::npos && spec.tip.empty()) {
    spec.tip = "tool";
  }
  try {
    vpArmSpec arm = vpLoadArmUrdf(dataFile("generic-6r.urdf"), spec).spec();
    std::remove(spec.srdf.c_str());
    std::remove(spec.limits.c_str());
    return arm;
  }
  catch (...) {
    std::remove(spec.srdf.c_str());
    std::remove(spec.limits.c_str());
    throw;
  }
}

std::string errorWith(const std::string &srdf, const std::string &limits, const vpArmUrdfSpec &spec = {})
{
  return errorOf([&] { static_cast<void>(sixAxesWith(srdf, limits, spec)); });
}

std::string state(const std::string &name, double shoulder)
{
  std::string text = "<group_state name='" + name + "' group='g'>";
  for (const char *joint : {"base_yaw", "elbow", "forearm_roll", "wrist_bend", "flange_roll"}) {
    text += std::string("<joint name='") + joint + "' value='0.1'/>";
  }
  return text + "<joint name='shoulder' value='" + std::to_string(shoulder) + "'/></group_state>";
}
} // namespace

TEST_CASE("Broken SRDF files are refused with file and line", "[srdf]")
{
  const std::string file = "catchArmSettings-own.srdf: ";
  CHECK(srdfError("<robot name='r'/>") == "no error");
  CHECK(srdfError("<model/>") == file + "line 1, column 1: is element model, must be robot");
  CHECK(srdfError("<robot>\n<disable_collisions link1='a'/></robot>") ==
        file + "line 2, column 1: element disable_collisions has no link2");
  CHECK(srdfError("<robot><group/></robot>") == file + "line 1, column 8: element group has no name");
  CHECK(srdfError("<robot><group name='g'><chain base_link='a'/></group></robot>") ==
        file + "line 1, column 24: element chain has no tip_link");
  CHECK(srdfError("<robot><group_state name='s'><joint name='j' value='much'/></group_state></robot>") ==
        file + "line 1, column 30: value of joint j is much, must be a finite number");
  CHECK(srdfError("<robot><group_state name='s'><joint name='j' value='nan'/></group_state></robot>") != "no error");
  CHECK(srdfError("<robot><group_state name='s'><joint name='j' value='1e999'/></group_state></robot>") != "no error");
  CHECK(srdfError("<robot><group_state name='s'><joint name='j' value='1 2 3'/></group_state></robot>") == "no error");
  CHECK(srdfError("<robot><group></robot>") == file + "line 1, column 15: </robot does not end element group");
  CHECK(errorOf([] { static_cast<void>(vpLoadSrdf("nowhere.srdf")); }).find("nowhere.srdf: cannot be read") == 0);
}

TEST_CASE("An SRDF gives pairs, ends and the home of an arm", "[srdf]")
{
  const vpArmSpec pairs = sixAxesWith("<disable_collisions link1='turret' link2='forearm' reason='Never'/>"
                                      "<disable_collisions link1='turret' link2='hat'/>"
                                      "<disable_collisions link1='turret' link2='turret'/>",
                                      "");
  CHECK(pairs.allowedBodies == std::vector<std::pair<std::string, std::string>>{{"turret", "forearm"}});
  CHECK(pairs.warnings == Sentences{"the SRDF has links that the URDF does not have: hat"});

  const std::string all = "<group name='g'><chain base_link='turret' tip_link='camera'/></group>";
  const std::string some = "<group name='h'><joint name='elbow'/><joint name='shoulder'/></group>";
  const std::string links = "<group name='l'><link name='forearm'/><link name='wrist_roll'/></group>";
  const std::string none = "<group name='n'><joint name='tool_mount'/><joint name='camera_mount'/></group>";
  const vpArmSpec ends = sixAxesWith(some + all + none + "<group name='b'><group name='g'/></group>", "");
  CHECK(ends.joints.size() == 5);
  CHECK(ends.warnings == Sentences{"base turret and tip camera are those of the group g of the SRDF",
                                   "joints beside the chain are not moved with the arm: base_yaw"});
  vpArmUrdfSpec spec;
  spec.group = "h";
  CHECK(sixAxesWith(some + all, "", spec).joints.size() == 2);
  spec.group = "l";
  CHECK(sixAxesWith(links, "", spec).joints.size() == 2);
  CHECK(sixAxesWith(links, "", spec).joints[0].name == "elbow");
  spec.group = "n";
  CHECK(errorWith(none, "", spec).find("group n is not one chain") != std::string::npos);
  spec.group = "x";
  CHECK(errorWith(all, "", spec).find("group x is not in the SRDF") != std::string::npos);
  // Two of equal length: none is preferred.
  CHECK(errorWith(some + links, "").find("the end effector is not unique") != std::string::npos);

  const vpArmSpec home = sixAxesWith(state("first", 0.5) + state("ready", 0.6), "");
  REQUIRE(home.home.size() == 6);
  CHECK(home.home(1) == 0.6);
  CHECK(home.warnings == Sentences{"home is the state ready of the SRDF"});
  vpArmUrdfSpec named;
  named.homeState = "first";
  CHECK(sixAxesWith(state("first", 0.5) + state("ready", 0.6), "", named).home(1) == 0.5);
  CHECK(errorWith("<group_state name='first'><joint name='elbow' value='0'/></group_state>", "", named)
            .find("home state first of the SRDF does not give joint base_yaw") != std::string::npos);
  CHECK(errorWith("", "", named).find("home state first is not in the SRDF") != std::string::npos);
  named.home = vector({0.1, 0.2, 0.3, 0.4, 0.5, 0.6});
  CHECK(sixAxesWith(state("first", 0.5), "", named).home(5) == 0.6);
  CHECK(sixAxesWith(state("beyond", 5.), "").home.size() == 0);
}

TEST_CASE("A file of joint limits supplies what the URDF lacks", "[limits]")
{
  vpArmUrdfSpec spec;
  spec.acceleration = 7.;
  const vpArmSpec arm = sixAxesWith("", R"(# of MoveIt
default_velocity_scaling_factor: 0.1
joint_limits:
  shoulder:
    has_velocity_limits: true  # rad/s
    max_velocity: 1.5
    has_acceleration_limits: true
    max_acceleration: 3.75
    has_jerk_limits: false
    max_jerk: 0
  "elbow":
    has_velocity_limits: false
    max_velocity: 0.0
    has_position_limits: true
    min_position: -1
    max_position: 9
    has_effort_limits: true
    max_effort: 11
  knee:
    has_velocity_limits: true
    max_velocity: 1
)",
                                    spec);
  CHECK(arm.joints[1].velocity == 1.5);
  CHECK(arm.joints[1].acceleration == 3.75);
  CHECK(arm.joints[2].velocity == 2.6);
  CHECK(arm.joints[2].acceleration == 7.);
  CHECK(arm.joints[2].lower == -1.);
  CHECK(arm.joints[2].upper == 1.1);
  CHECK(arm.joints[2].torque == 11.);
  CHECK(arm.warnings ==
        Sentences{"the position limits of elbow are narrowed by the limits of catchArmSettings-own.yaml",
                  "catchArmSettings-own.yaml has joints that the URDF does not have: knee"});
  spec.velocity = vector({1., 2., 3., 4., 5., 6.});
  CHECK(sixAxesWith("", "joint_limits:\n", spec).joints[2].velocity == 3.);
  spec.velocity = vector({1., 2.});
  CHECK(errorWith("", "", spec).find("2 velocity limits for 6 joints, must be as many") != std::string::npos);
  spec.velocity = vector({1., 2., -3., 4., 5., 6.});
  CHECK(errorWith("", "", spec).find("velocity limit of joint elbow is -3, must be > 0") != std::string::npos);
}

TEST_CASE("Broken files of joint limits are refused with the line or the field", "[limits]")
{
  const std::string file = "catchArmSettings-own.yaml: ", head = "joint_limits:\n  j:\n";
  for (const auto &[content, sentence] : std::vector<std::pair<std::string, std::string>>{
           {"limits:\n", "has no joint_limits"},
           {"joint_limits: {j: {max_velocity: 1}}\n",
            "line 1: joint_limits is given twice or has a value, must be a map of joints"},
           {"joint_limits:\n  - j\n", "line 2 is - j, must be name: value"},
           {"joint_limits:\n\tj:\n", "line 2 has a tab, must be indented by blanks"},
           {head + "  j:\n    max_jerk: 0\n  j:\n",
            "line 5: joint j is given twice, has a value or is indented differently"},
           {head + "    has_velocity_limits: true\n    has_velocity_limits: false\n",
            "line 4: has_velocity_limits of joint j is given twice"},
           {head + "    has_velocity_limits: yes\n",
            "joint_limits.j.has_velocity_limits is yes, must be true or false"},
           {head + "    has_velocity_limits: true\n",
            "joint_limits.j.max_velocity is missing, must be a finite number"},
           {head + "    has_velocity_limits: true\n    max_velocity: .inf\n",
            "joint_limits.j.max_velocity is .inf, must be a finite number"},
           {head + "    has_velocity_limits: true\n    max_velocity: -2\n",
            "joint_limits.j.max_velocity is -2.000000, must be from 1e-12 to 1e9"},
           {head + "    max_velocity: 2\n", "joint_limits.j.max_velocity counts only with has_velocity_limits"},
           {"joint_limits:\n  elbow:\n    has_position_limits: true\n    min_position: 2\n    max_position: 3\n",
            "leaves joint elbow no range of positions"},
           {head + "    max_speed: 2\n", "joint_limits.j.max_speed is not known"}}) {
    CHECK(errorWith("", content) == file + sentence);
  }
}
