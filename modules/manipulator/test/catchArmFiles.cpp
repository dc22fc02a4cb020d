/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// File contents are read correctly, and errors are reported in one sentence with the file and the element.
#include "vpArmTestKit.h"
#include "vpCaseFile.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>

#include <cstdio>
#include <fstream>
#include <iomanip>
#include <sstream>

using namespace vpArmTestKit;

namespace
{
std::string contentOf(const std::string &file)
{
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// A copy of a file with one piece replaced, in the working folder; removed again.
class Broken
{
public:
  Broken(const std::string &original, const std::string &from, const std::string &to)
    : m_name("catchArmFiles-broken" + original.substr(original.rfind('.')))
  {
    std::string text = contentOf(dataFile(original));
    const std::size_t place = text.find(from);
    REQUIRE(place != std::string::npos);
    text.replace(place, from.size(), to);
    std::ofstream(m_name) << text;
  }
  ~Broken() { std::remove(m_name.c_str()); }
  Broken(const Broken &) = delete;
  Broken &operator=(const Broken &) = delete;
  [[nodiscard]] const std::string &name() const { return m_name; }

private:
  std::string m_name;
};

std::string jsonError(const std::string &from, const std::string &to)
{
  const Broken file("amor.json", from, to);
  try {
    static_cast<void>(vpLoadArmJson(file.name()));
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}

std::string urdfError(const std::string &from, const std::string &to, const std::string &tip = "tool")
{
  const Broken file("generic-6r.urdf", from, to);
  vpArmUrdfSpec spec;
  spec.tip = tip;
  try {
    static_cast<void>(vpLoadArmUrdf(file.name(), spec));
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}

std::string specError(const vpArmSpec &spec)
{
  try {
    static_cast<void>(vpArmModel(spec));
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}
} // namespace

TEST_CASE("AMOR's file holds the ranges that data/robot says", "[files]")
{
  const vpArmModel &model = amor();
  CHECK(model.size() == 7);
  for (const int i : {0, 4, 6}) {
    CHECK(model.isContinuous(i));
    CHECK(std::isinf(model.upper()(i)));
  }
  const double degree = pi / 180.;
  CHECK(model.lower()(1) == Approx(-15. * degree));
  CHECK(model.upper()(1) == Approx(135. * degree));
  CHECK(model.lower()(2) == Approx(-120. * degree));
  CHECK(model.lower()(3) == Approx(-165. * degree));
  CHECK(model.upper()(3) == 0.);
  CHECK(model.upper()(5) == Approx(87.5 * degree));
  CHECK(model.chain(1).offset == Approx(pi));
  CHECK(model.spec().capsules.size() == 4);
  CHECK_NOTHROW(model.requireMotionLimits("the test"));
  CHECK(model.hasMasses());
  CHECK((model.home() - home()).norm() == 0.);
  CHECK(model.spec().joints[4].kp == 120.);
  CHECK(model.spec().joints[6].kd == 3.);
  CHECK(sixAxes().spec().home.size() == 0);
  for (int i = 0; i < 6; ++i) {
    const double middle = 0.5 * (sixAxes().lower()(i) + sixAxes().upper()(i));
    CHECK(sixAxes().home()(i) == Approx(sixAxes().isContinuous(i) ? 0. : middle));
  }
}

TEST_CASE("The URDF's chain is read with limits, masses, capsules and camera", "[files]")
{
  const vpArmModel &model = sixAxes();
  CHECK(model.size() == 6);
  CHECK(model.isContinuous(0));
  CHECK(model.lower()(1) == -1.9);
  CHECK(model.velocity()(5) == 5.);
  CHECK(model.acceleration()(5) == 12.);
  CHECK(model.torque()(5) == 15.);
  CHECK(model.spec().joints[2].viscous == 2.);
  CHECK(model.spec().links[5].mass == Approx(0.8)); // flange and tool
  CHECK(model.spec().capsules.size() == 6);
  CHECK(model.spec().uncovered.empty());
  CHECK(model.spec().warnings.empty());
  vpArmUrdfSpec spec;
  spec.tip = "camera";
  const vpArmModel camera = vpLoadArmUrdf(dataFile("generic-6r.urdf"), spec);
  vpArmData a, b;
  const vpJointVector q = vector({0.3, 0.2, -0.4, 0.5, 0.6, 0.7});
  vpArmKinematics::forward(model, q, a);
  vpArmKinematics::forward(camera, q, b);
  CHECK(difference(vpArmKinematics::camera(model, a), b.tool) < 1e-12);
  CHECK_THROWS_WITH(camera.requireMotionLimits("the redundancy solver"),
                    Catch::Contains("generic-6r.urdf: acceleration limit of joint base_yaw is infinite, the redundancy "
                                    "solver needs one"));
}

TEST_CASE("Errors in JSON name the file and the field", "[files]")
{
  const std::string file = "catchArmFiles-broken.json: ";
  CHECK(jsonError("\"joints\": [", "\"joints\": ").find(file + "line ") == 0);
  CHECK(jsonError("\"a_m\": 0.0623, ", "") == file + "joints[0].a_m is missing");
  CHECK(jsonError("\"a_m\": 0.0623", "\"a_m\": \"long\"") == file + "joints[0].a_m is \"long\", must be a number");
  CHECK(jsonError("\"a_m\": 0.0623", "\"a_m\": 0.0623, \"colour\": 3")
            .find(file + "unknown field joints[0].colour; known are a_m, acceleration, ") == 0);
  CHECK(jsonError("[0.246, ", "[") == file + "home has 6 numbers, must have one for each of 7 joints");
  CHECK(jsonError("0.246, 0.868", "0.246, 2.868") == file + "home of joint q2 is 2.868, must be within its limits");
  CHECK(jsonError("[0.246, ", "[\"none\", ") ==
        file + "home is [\"none\",0.868,-1.237,-2.39,-2.591,-1.099,0.324], must be a list of numbers");
  CHECK(jsonError("\"kp\": 400", "\"kp\": -4") == file + "kp of joint q1 is -4, must be >= 0 and finite");
  CHECK(jsonError("\"continuous\"", "\"rolling\"") ==
        file + "joints[0].type is \"rolling\", must be revolute, continuous or prismatic");
  CHECK(jsonError("\"mass_kg\": 2.4", "\"mass_kg\": -2.4") == file + "mass of link link2 is -2.4, must be > 0");
  CHECK(jsonError("\"mass_kg\": 2.4", "\"mass_kg\": 0") == file + "mass of link link2 is 0, must be > 0");
  CHECK(jsonError("\"upper_deg\": 135", "\"upper_deg\": -135")
            .find(file + "limits of joint q2 are -0.261799 and -2.35619") == 0);
  CHECK(jsonError("\"lower_deg\": -15, ", "") == file + "joints[1].lower_deg is missing");
  CHECK(jsonError("\"velocity\": 1.5", "\"velocity\": -1.5") ==
        file + "velocity limit of joint q1 is -1.5, must be > 0");
  CHECK(jsonError("\"name\": \"q2\"", "\"name\": \"q1\"") == file + "duplicate joint name q1");
  CHECK(jsonError("\"link\": 3", "\"link\": 9") == file + "a capsule belongs to link 9, must be 0 to 7");
  CHECK(jsonError("[0, 0, 0.1755]", "[0, 0.1755]") ==
        file + "tool.translation_m is [0,0.1755], must be a list of 3 numbers");
  CHECK(jsonError("\"inertia_kg_m2\": [0.013, 0.013, 0.013", "\"inertia_kg_m2\": [0.013, 0.013, 0.13")
            .find(file + "inertia of link link1 has the principal moments") == 0);
  CHECK_THROWS_WITH(vpLoadArmJson("nowhere.json"), Catch::Contains("nowhere.json: cannot be read"));
}

TEST_CASE("Errors in URDF name the file and the element", "[files]")
{
  const std::string file = "catchArmFiles-broken.urdf: ";
  const auto says = [&file](const std::string &message, const std::string &element) {
    CAPTURE(message);
    CHECK(message.find(file) == 0);
    CHECK(message.find(element) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  };
  says(urdfError("</robot>", ""), "ends within the element robot");
  says(urdfError("<robot name", "<arm name"), "</robot does not end element arm");
  says(urdfError("<dynamics damping=\"2.0\" friction=\"3.0\"/>", "<mimic joint=\"knee\"/>"),
       "joint elbow mimics joint knee, which is not there");
  says(urdfError("<child link=\"forearm\"/>", "<child link=\"missing\"/>"), "missing");
  says(urdfError("<parent link=\"forearm\"/>", "<parent link=\"nobody\"/>"), "nobody");
  says(urdfError("<limit lower=\"-1.9\" upper=\"2.2\" effort=\"200\" velocity=\"2.4\"/>", ""), "shoulder");
  says(urdfError("<mass value=\"7.2\"/>", "<mass value=\"heavy\"/>"), "upper_arm");
  says(urdfError("<axis xyz=\"0 -1 0\"/>", "<axis xyz=\"0 0 0\"/>"), "axis of joint elbow is zero");
  says(urdfError("name=\"elbow\" type=\"revolute\"", "name=\"elbow\" type=\"floating\""),
       "joint elbow is floating or planar");
  says(urdfError("tool_mount", "tool_mount", ""),
       "tip must be one of the links camera, tool: the end effector is not unique");
  says(urdfError("tool_mount", "tool_mount", "hand"), "tip is hand, must be one of the links ");
  says(urdfError("lower=\"-1.9\"", "lower=\"2.9\""), "limits of joint shoulder are 2.9 and 2.2");
  CHECK_THROWS_WITH(vpLoadArmUrdf("nowhere.urdf"), Catch::Contains("nowhere.urdf: cannot be read"));
  vpArmUrdfSpec spec;
  spec.base = "tool";
  spec.tip = "forearm";
  CHECK_THROWS_WITH(vpLoadArmUrdf(dataFile("generic-6r.urdf"), spec),
                    Catch::Contains("link forearm is not below link tool"));
}

TEST_CASE("Bodies beside the chain belong to the arm, and what no capsule covers is named", "[files]")
{
  const std::string name = "catchArmFiles-bodies.urdf";
  std::ofstream(name) << R"(<robot name="r">
  <link name="base"><collision><geometry><mesh filename="base.stl"/></geometry></collision></link>
  <link name="arm"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="cover"><visual><geometry><sphere radius="0.1"/></geometry></visual></link>
  <link name="hand"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.2 0.4"/></geometry></collision></link>
  <link name="frame"><inertial><mass value="0"/><inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="finger"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
  <link name="tip"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" velocity="1" effort="1"/></joint>
  <joint name="j1" type="fixed"><parent link="arm"/><child link="tip"/><origin xyz="0 0 1"/></joint>
  <joint name="j2" type="fixed"><parent link="arm"/><child link="cover"/></joint>
  <joint name="j3" type="fixed"><parent link="tip"/><child link="hand"/><origin xyz="0 0.5 0"/></joint>
  <joint name="j4" type="fixed"><parent link="hand"/><child link="frame"/></joint>
  <joint name="grip" type="prismatic"><parent link="hand"/><child link="finger"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.2" velocity="1" effort="1"/></joint>
</robot>)";
  vpArmUrdfSpec spec;
  spec.tip = "tip";
  const vpArmModel model = vpLoadArmUrdf(name, spec);
  std::remove(name.c_str());
  const vpArmSpec &arm = model.spec();
  CHECK(arm.uncovered == std::vector<std::string>{"base", "cover", "finger"});
  std::string bodies;
  for (const vpArmBody &body : arm.bodies) {
    bodies += body.name + std::to_string(body.link) + " ";
  }
  CHECK(bodies == "base0 arm1 cover1 tip1 hand1 finger1 frame1 ");
  REQUIRE(arm.shapes.size() == 2); // not the mesh, which is not there, and not the finger
  CHECK(arm.bodies[static_cast<std::size_t>(arm.shapes[0].body)].name == "arm");
  CHECK(arm.shapes[1].kind == vpArmShapeKind::Box);
  CHECK(arm.shapes[1].size == Eigen::Vector3d(0.1, 0.2, 0.4));
  CHECK((arm.shapes[1].pose.p - Eigen::Vector3d(0., 0.5, 1.)).norm() < 1e-12);
  CHECK(arm.capsules[1].body == arm.shapes[1].body);
  REQUIRE(arm.warnings.size() == 2);
  CHECK(arm.warnings[1] == "joints beside the chain are not moved with the arm: grip");
  CHECK(arm.warnings[0].find("a mesh is not found in ") == 0);
  CHECK(arm.warnings[0].find(" and the folders above it: base.stl of base") != std::string::npos);
  REQUIRE(arm.capsules.size() == 2); // the sphere, and the box at (0, 0.5, 1) along z
  CHECK(arm.capsules[1].link == 1);
  CHECK((arm.capsules[1].from - Eigen::Vector3d(0., 0.5, 0.8)).norm() < 1e-12);
  CHECK((arm.capsules[1].to - Eigen::Vector3d(0., 0.5, 1.2)).norm() < 1e-12);
  REQUIRE(arm.links.size() == 1);
  CHECK(arm.links[0].mass == Approx(3.));
  CHECK((arm.links[0].com - Eigen::Vector3d(0., 0.5, 1.) / 3.).norm() < 1e-12);
}

namespace
{
std::string errorOfUrdf(const std::string &content)
{
  const std::string name = "catchArmFiles-own.urdf";
  std::ofstream(name) << content;
  std::string error = "no error";
  try {
    static_cast<void>(vpLoadArmUrdf(name));
  }
  catch (const vpException &e) {
    error = e.getStringMessage();
  }
  std::remove(name.c_str());
  return error;
}

std::string repeated(const std::string &piece, int count)
{
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += piece;
  }
  return text;
}
} // namespace

TEST_CASE("URDF that would harm its parser is refused before it gets there", "[files][hostile]")
{
  const std::string file = "catchArmFiles-own.urdf: ";
  // Such texts were passed to printf as a format.
  CHECK(urdfError("lower=\"-1.9\"", "lower=\"%s%n\"").find("attribute lower is %s%n, must be without %") !=
        std::string::npos);
  CHECK(urdfError("lower=\"-1.9\"", "lower=\"&#37;n\"").find("attribute lower is &#37;n, must be without &#") !=
        std::string::npos);
  // The parser recurses into elements.
  CHECK(errorOfUrdf(repeated("<a>", 200000)) == file + "line 1, column 193: is nested more than 64 deep");
  CHECK(errorOfUrdf("<robot name=\"r\">" + repeated("<a b='/>'>", 64)).find("nested more than 64") !=
        std::string::npos);
  CHECK(errorOfUrdf("<robot name=\"r\">" + repeated("<a>", 63) + repeated("</a>", 63) + "</robot>").find("nested") ==
        std::string::npos);
  CHECK(errorOfUrdf("<robot><!-- " + repeated("<a>", 200) + " --><link name='%'/></robot>") ==
        file + "line 1, column 628: attribute name is %, must be without %");
  // It continues after some errors.
  for (const auto &[content, sentence] : std::vector<std::pair<std::string, std::string>>{
           {"", "line 1, column 1: has no element"},
           {"robot", "line 1, column 1: is no XML, which begins with <"},
           {std::string("<robot>\0</robot>", 17), "line 1, column 8: has a zero byte"},
           {"<robot/><robot/>", "line 1, column 9: goes on after the end of its only element"},
           {"<robot/>\ntext", "line 2, column 1: goes on after the end of its only element"},
           {"<robot><a></b></robot>", "line 1, column 11: </b does not end element a"},
           {"</robot>", "line 1, column 1: </robot does not end an element"},
           {"<robot a=1/>", "line 1, column 10: the value of attribute a is not in quotes"},
           {"<robot a='1' a='2'/>", "line 1, column 14: attribute a is given twice"},
           {"<robot a='<'/>", "line 1, column 10: attribute a has a < in its value"},
           {"<robot a/>", "line 1, column 9: attribute a has no value"},
           {"<robot /a>", "line 1, column 9: the tag of element robot does not end in >"},
           {"<>", "line 1, column 2: there is no name where one must be"},
           {"<robot><!-- </robot>", "line 1, column 8: <!-- has no -->"},
           {"<robot><?xml version='1.0'?></robot>",
            "line 1, column 8: has a declaration <? that is not at its beginning"},
           {"<!DOCTYPE robot [<!ENTITY a 'b'>]><robot/>", "line 1, column 1: has a DOCTYPE with more than a name"}}) {
    CHECK(errorOfUrdf(content) == file + sentence);
  }
  // Contents of real files are accepted.
  CHECK(errorOfUrdf("\xef\xbb\xbf<?xml version=\"1.0\"?>\r\n<?xml-stylesheet href='a'?><!DOCTYPE robot>\r\n"
                    "<robot name='r' xmlns:xacro='b'><!-- 100 % --><link name='a'><visual><geometry>"
                    "<mesh filename='a%20b.stl'/></geometry></visual></link><material>5 %</material></robot>\n")
            .find("line ") == std::string::npos);
}

TEST_CASE("Links that are no tree are refused", "[files][hostile]")
{
  const std::string file = "catchArmFiles-own.urdf: ";
  const auto joint = [](const std::string &name, const std::string &parent, const std::string &child) {
    return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child +
           "'/></joint>";
  };
  const std::string links = "<robot name='r'><link name='base'/><link name='a'/><link name='b'/><link name='c'/>";
  CHECK(errorOfUrdf(links + joint("1", "a", "b") + joint("2", "b", "c") + joint("3", "c", "a") + "</robot>") ==
        file + "the joints make a cycle through link a");
  CHECK(errorOfUrdf(links + joint("1", "base", "a") + joint("2", "base", "b") + joint("3", "b", "c") +
                    joint("4", "a", "c") + "</robot>") == file + "link c is the child of two joints, 3 and 4");
  CHECK(errorOfUrdf(links + joint("1", "a", "a") + joint("2", "base", "b") + joint("3", "b", "c") + "</robot>") ==
        file + "the joints make a cycle through link a");
}

TEST_CASE("The public broken URDF files are refused in a sentence, the sound ones get to their meaning",
          "[files][hostile]")
{
  const auto errorOf = [](const std::string &name, const std::string &tip) {
    vpArmUrdfSpec spec;
    spec.tip = tip;
    try {
      static_cast<void>(vpLoadArmUrdf(name, spec));
    }
    catch (const vpException &e) {
      return e.getStringMessage();
    }
    return std::string("no error");
  };
  const std::string cycle = vpTestSupport::caseFile("broken/cycle.urdf");
  const std::string format = vpTestSupport::caseFile("broken/format-string.urdf");
  if (!cycle.empty() && !format.empty()) {
    CHECK(errorOf(cycle, "").find(": link l1 is the child of two joints, a and c") != std::string::npos);
    CHECK(errorOf(format, "tool").find(", must be without %") != std::string::npos);
  }
  for (const char *name : {"fetch", "fr3", "franka_panda", "iiwa14_primitive_collision", "irb120_3_58", "kinovaGen3",
                           "kinovaJacoJ2S7S300", "kr6r900sixx", "lrmate200id", "panda", "pr2", "puma560_robot"}) {
    const std::string robot = vpTestSupport::caseFile(std::string("robots/") + name + ".urdf");
    if (!robot.empty()) {
      CAPTURE(name, errorOf(robot, ""));
      CHECK(errorOf(robot, "").find(".urdf: line ") == std::string::npos);
    }
  }
}

TEST_CASE("JSON of an arm is read as strictly as that of a task", "[files][hostile]")
{
  const std::string file = "catchArmFiles-broken.json: ";
  CHECK(jsonError("\"kp\": 400", "\"kp\": 400, \"kp\": 4") == file + "field \"kp\" is given twice");
  CHECK(jsonError("\"kp\": 400", "\"kp\": 1e999").find("number overflow parsing '1e999'") != std::string::npos);
  CHECK(jsonError("\"kp\": 400", "\"kp\": " + repeated("[", 1000000)) == file + "is nested more than 64 deep");
  CHECK(jsonError("\"kp\": 400", "\"kp\": \"\\u001b[31m\\u202e\"") ==
        file + "joints[0].kp is \"\\u001b[31m\\u202e\", must be a number");
  CHECK(jsonError("\"name\": \"q2\"", "\"name\": \"\\u001b]0;q1\\u0007\"").find('\x1b') == std::string::npos);
}

TEST_CASE("A table of modified DH gives Franka's published poses", "[files]")
{
  // Denavit-Hartenberg parameters of the Franka Emika Robot, from its documentation; flange at d = 0.107.
  const std::string name = "catchArmFiles-franka.json";
  std::string rows;
  const double a[] = {0., 0., 0., .0825, -.0825, 0., .088}, d[] = {.333, 0., .316, 0., .384, 0., 0.};
  const double alpha[] = {0., -90., 90., 90., -90., 90., 90.};
  for (int i = 0; i < 7; ++i) {
    std::ostringstream row;
    row << R"({"name": "q)" << i << R"(", "type": "revolute", "a_m": )" << a[i] << R"(, "alpha_deg": )" << alpha[i]
        << R"(, "d_m": )" << d[i] << R"(, "lower_deg": -170, "upper_deg": 170})";
    rows += (i > 0 ? ", " : "") + row.str();
  }
  const std::string rest = R"(], "tool": {"translation_m": [0, 0, 0.107]}, "uncovered": ["hand"]})";
  std::ofstream(name) << R"({"name": "franka", "dh": "modified", "joints": [)" << rows << rest;
  const vpArmModel franka = vpLoadArmJson(name);
  vpArmData data;
  vpArmKinematics::update(franka, vector({.1, .2, .3, -.4, .5, .6, .7}), data);
  CHECK((data.tool.p - Eigen::Vector3d(.322468068, .167418242, .897969511)).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(franka.spec().uncovered == std::vector<std::string>{"hand"});
  std::ofstream(name) << R"({"name": "franka", "dh": "Craig", "joints": [)" << rows << rest;
  CHECK_THROWS_WITH(vpLoadArmJson(name), "catchArmFiles-franka.json: dh is \"Craig\", must be standard or modified");
  // A prismatic joint: Rx(alpha) Tx(a) Rz(theta) Tz(d).
  std::ofstream(name) << R"({"name": "slide", "dh": "modified", "joints": [{"name": "s", "type": "prismatic", "a_m": 2,
    "alpha_deg": 90, "theta_deg": 90, "lower_m": 0, "upper_m": 5}]})";
  vpArmKinematics::update(vpLoadArmJson(name), vector({3.}), data);
  std::remove(name.c_str());
  CHECK((data.tool.p - Eigen::Vector3d(2., -3., 0.)).norm() < 1e-12);
  CHECK((data.tool.R.col(0) - Eigen::Vector3d(0., 0., 1.)).norm() < 1e-12);
}

TEST_CASE("A table of DH may hold joints that follow others", "[files]")
{
  const std::string name = "catchArmFiles-linkage.json";
  const auto load = [&name](const std::string &follower) {
    const auto joint = [](const std::string &joint, double length, const std::string &rest) {
      std::ostringstream row;
      row << std::setprecision(17) << R"({"name": ")" << joint << R"(", "a_m": )" << length
          << R"(, "alpha_deg": 0, "d_m": 0, "type": )" << rest << "}";
      return row.str();
    };
    const std::string limits = R"("revolute", "lower_deg": -90, "upper_deg": 90)";
    std::ofstream(name) << R"({"name": "palletizer", "joints": [)" << joint("first", 0.4, limits) << ", "
                        << joint("level", 0.1, R"("revolute", "theta_offset_deg": 20, )" + follower) << ", "
                        << joint("second", 0.3, limits) << "]}";
    const vpArmModel arm = vpLoadArmJson(name);
    std::remove(name.c_str());
    return arm;
  };
  // The plane arm by hand: angles add up, whether they are free or follow. The follower names a joint behind it.
  std::mt19937_64 rng = vpTestSupport::generator(0);
  for (int i = 0; i < vpTestSupport::longer(50); ++i) {
    const double ratio = vpTestSupport::uniform(rng, 0.1, 2.) * (rng() % 2 == 0 ? 1. : -1.);
    std::ostringstream follows;
    follows << std::setprecision(17) << R"("follows": "second", "ratio": )" << ratio;
    const vpArmModel arm = load(follows.str());
    REQUIRE(arm.size() == 2);
    const vpJointVector q = vector({vpTestSupport::uniform(rng, -1.5, 1.5), vpTestSupport::uniform(rng, -1.5, 1.5)});
    vpArmData data;
    vpArmKinematics::forward(arm, q, data);
    Eigen::Vector3d tip = Eigen::Vector3d::Zero();
    double angle = 0.;
    for (const auto &[turn, length] :
         {std::make_pair(q(0), 0.4), std::make_pair(ratio * q(1) + pi / 9., 0.1), std::make_pair(q(1), 0.3)}) {
      angle += turn;
      tip += length * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.);
    }
    CHECK((data.tool.p - tip).norm() < 1e-14);
  }
  CHECK(load(R"("follows": "first")").spec().followers[0].ratio == 1.);

  const auto error = [&](const std::string &follower, const std::string &sentence) {
    CHECK_THROWS_WITH(load(follower), Catch::Contains(name + ": " + sentence));
  };
  error(R"("follows": "third")", "joints[1].follows is \"third\", must be the name of a joint that follows none");
  error(R"("follows": "level")", "joints[1].follows is \"level\", must be the name of a joint that follows none");
  error(R"("follows": 2)", "joints[1].follows is 2, must be a text");
  error(R"("follows": "first", "ratio": 0)", "ratio of follower level is 0, must not be 0 and be within 100");
  error(R"("follows": "first", "lower_deg": 0)", "unknown field joints[1].lower_deg; known are ");
  std::remove(name.c_str());
}

TEST_CASE("A continuous joint without a limit of velocity is refused where one is needed", "[files]")
{
  const Broken file("generic-6r.urdf", "<limit effort=\"200\" velocity=\"2.6\"/>", "");
  vpArmUrdfSpec spec;
  spec.tip = "tool";
  spec.acceleration = 5.;
  const vpArmModel model = vpLoadArmUrdf(file.name(), spec);
  CHECK_THROWS_WITH(model.requireMotionLimits("the redundancy solver"),
                    Catch::Contains("velocity limit of joint base_yaw is infinite, the redundancy solver needs one"));
}

TEST_CASE("A model by hand is checked as one from a file", "[files]")
{
  const auto says = [](const vpArmSpec &spec, const std::string &sentence) {
    CHECK(specError(spec) == "arm mixed: " + sentence);
  };
  vpArmSpec spec = mixed().spec();
  spec.joints.clear();
  spec.links.clear();
  says(spec, "0 moving joints, must be 1 to 16");
  spec = mixed().spec();
  spec.links.pop_back();
  says(spec, "3 links for 4 joints, must be as many");
  spec = mixed().spec();
  spec.joints[1].before.R(0, 0) += 0.1;
  says(spec, "frame before of joint m1 is not a rotation and a finite translation");
  spec = mixed().spec();
  spec.joints[1].offset = NAN;
  says(spec, "offset of joint m1 is nan, must be within 10000");
  spec = mixed().spec();
  spec.joints[3].acceleration = 0.;
  says(spec, "acceleration limit of joint m3 is 0, must be > 0");
  spec = mixed().spec();
  spec.joints[2].coulomb = -1.;
  says(spec, "Coulomb friction of joint m2 is -1, must be >= 0 and finite");
  spec = mixed().spec();
  spec.tool.R *= 2.;
  says(spec, "tool is not a rotation and a finite translation");
}

TEST_CASE("Bodies, shapes and pairs by hand are checked", "[files]")
{
  const vpArmSpec good = [] {
    vpArmSpec spec = mixed().spec();
    spec.bodies = {{"foot", 0}, {"hand", 4}};
    vpArmShape mesh, ball;
    mesh.body = 1;
    mesh.file = "hand.stl";
    mesh.size << 1e-3, -1e-3, 1e-3;
    ball.kind = vpArmShapeKind::Sphere;
    ball.size << 0.1, 0., 0.;
    spec.shapes = {mesh, ball};
    spec.capsules = {{4, {0., 0., 0.}, {0., 0., 1.}, 0.1, 1}};
    spec.allowedBodies = {{"foot", "hand"}};
    spec.uncovered = {"hand"};
    return spec;
  }();
  CHECK(specError(good) == "no error");
  const auto says = [&good](const std::function<void(vpArmSpec &)> &spoil, const std::string &sentence) {
    vpArmSpec spec = good;
    spoil(spec);
    CHECK(specError(spec) == "arm mixed: " + sentence);
  };
  says([](vpArmSpec &s) { s.bodies[1].name = "foot"; }, "duplicate body name foot");
  says([](vpArmSpec &s) { s.bodies[1].name = ""; }, "a body has no name");
  says([](vpArmSpec &s) { s.bodies[0].link = 5; }, "body foot belongs to link 5, must be 0 to 4");
  says([](vpArmSpec &s) { s.shapes[0].body = 2; }, "a shape belongs to body 2, must be 0 to 1");
  says([](vpArmSpec &s) { s.shapes[0].file = ""; }, "a shape of body hand is a mesh without a file");
  says([](vpArmSpec &s) { s.shapes[1].file = "a.stl"; }, "a shape of body foot has the file a.stl, but is no mesh");
  says([](vpArmSpec &s) { s.shapes[0].size(1) = 0.; }, "size of a shape of body hand is 0, must be > 0");
  says([](vpArmSpec &s) { s.shapes[1].size(0) = NAN; }, "size of a shape of body foot is nan, must be > 0");
  says([](vpArmSpec &s) { s.shapes[1].pose.R *= 2.; },
       "pose of a shape of body foot is not a rotation and a finite translation");
  says([](vpArmSpec &s) { s.capsules[0].body = 2; }, "body of a capsule of link 4 is 2, must be -1 to 1");
  says([](vpArmSpec &s) { s.capsules[0].body = 0; }, "body foot of a capsule of link 4 belongs to another link");
  says([](vpArmSpec &s) { s.allowedBodies[0].second = "head"; }, "pair of bodies foot, head: there is no body head");
  says([](vpArmSpec &s) { s.allowedBodies[0].second = "foot"; }, "pair of bodies foot, foot: must be different ones");
  says([](vpArmSpec &s) { s.uncovered.push_back("hand"); }, "uncovered body hand is given twice");
  says([](vpArmSpec &s) { s.uncovered[0] = ""; }, "an uncovered body has no name");
}
