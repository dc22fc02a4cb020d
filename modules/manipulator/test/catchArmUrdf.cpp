/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What the reader of URDF tolerates, assumes and refuses, each in a sentence; SRDF files and files of limits.
#define VP_URDF_TEST "catchArmUrdf"
#include "vpCatch.h"
#include "vpUrdfTestKit.h"

#include <visp3/manipulator/vpSrdf.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

using namespace vpUrdfTestKit;

namespace
{
namespace fs = std::filesystem;
} // namespace

TEST_CASE("Limits that a URDF does not have are unknown", "[urdf]")
{
  for (const char *fields : {"lower='-1' upper='2' velocity='0' effort='-1'", "lower='-1' upper='2'",
                             "lower='-1' upper='2' velocity='-1' effort='1e20'"}) {
    const vpArmModel model = load(twoLinks(limit(fields)));
    CHECK(std::isinf(model.velocity()(0)));
    CHECK(std::isinf(model.torque()(0)));
    CHECK(model.spec().warnings ==
          Sentences{"the velocity limit of j is missing, not > 0 or beyond 1e9: taken as unknown",
                    "the effort limit of j is missing, not > 0 or beyond 1e9: taken as unknown"});
  }
  const vpArmModel oneSided = load(twoLinks(limit("lower='-1' velocity='1' effort='1'")));
  CHECK(oneSided.lower()(0) == -1.);
  CHECK(oneSided.upper()(0) == 0.);
  CHECK(oneSided.spec().warnings == Sentences{"only one position limit is given of j: the other is 0 in this format"});
  CHECK(errorOf(twoLinks(limit("velocity='1' effort='1'"))).find("limits of joint j are 0 and 0") != std::string::npos);
}

TEST_CASE("Masses and inertias that no body has are unknown, and frames have none", "[urdf]")
{
  const auto inertial = [](const char *m, const char *ixx) {
    return std::string("<inertial><mass value='") + m + "'/><inertia ixx='" + ixx +
           "' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
  };
  const auto linkWith = [&](const std::string &content, const std::string &ofFrame) {
    const std::string urdf = "<robot name='r'>" + link("base") + link("arm", content + ball) + link("frame", ofFrame) +
                             joint("j", "revolute", "base", "arm", good) + joint("f", "fixed", "arm", "frame") +
                             "</robot>";
    return load(urdf, toTip("arm")).spec();
  };
  CHECK(linkWith(mass, inertial("0", "0")).warnings.empty());
  CHECK(linkWith(mass, inertial("0", "0")).links[0].mass == 1.);
  for (const char *m : {"0", "-1"}) {
    const vpArmSpec arm = linkWith(inertial(m, "1"), mass);
    CHECK_FALSE(arm.links[0].hasMass);
    CHECK(arm.warnings == Sentences{"the mass of arm is not > 0: taken as unknown"});
  }
  CHECK_FALSE(linkWith(mass, inertial("-1", "1")).links[0].hasMass);
  const vpArmSpec carried = linkWith(mass, inertial("0", "0") + ball);
  CHECK(carried.links[0].mass == 1.);
  CHECK(carried.warnings == Sentences{"the mass of frame is 0: taken as included in the body that carries it"});
  const vpArmSpec arm = linkWith(inertial("1", "3"), mass);
  CHECK_FALSE(arm.links[0].hasMass);
  CHECK(arm.warnings == Sentences{"the inertia of arm is one that no body has: mass and inertia taken as unknown"});
}

TEST_CASE("Empty shapes are left out, and a link without a shape that weighs something is named", "[urdf]")
{
  const auto shape = [](const std::string &geometry) {
    const vpArmSpec arm = load("<robot name='r'>" + link("base") +
                               link("arm", "<collision><geometry>" + geometry + "</geometry></collision>" + ball) +
                               joint("j", "revolute", "base", "arm", good) + "</robot>")
                              .spec();
    CHECK(arm.shapes.size() == 2);
    CHECK(arm.capsules.size() == 2);
    CHECK(arm.uncovered.empty());
    return arm.warnings;
  };
  for (const char *geometry : {"<sphere radius='0'/>", "<sphere radius='-1'/>", "<box size='1 0 1'/>",
                               "<cylinder radius='0.1' length='0'/>", "<mesh filename='a.stl' scale='0 1 1'/>"}) {
    CHECK(shape(geometry) == Sentences{"a shape of arm has the radius or an edge 0: left out"});
  }
  const auto uncovered = [](const std::string &base, const std::string &arm) {
    return load("<robot name='r'>" + link("base", base) + link("arm", arm) + link("tool", "") +
                joint("j", "revolute", "base", "arm", good) + joint("t", "fixed", "arm", "tool") + "</robot>")
        .spec()
        .uncovered;
  };
  CHECK(uncovered(ball, "").empty());
  CHECK(uncovered(ball, mass) == Sentences{"arm"});
  CHECK(uncovered("", mass) == Sentences{"arm"});
  CHECK(uncovered("", "") == Sentences{"arm"});
}

TEST_CASE("An arm with too many joints is refused soon", "[urdf][hostile]")
{
  std::string urdf = "<robot name='r'>" + link("l0", mass + ball);
  for (int i = 0; i < 5000; ++i) {
    const std::string now = std::to_string(i), next = std::to_string(i + 1);
    urdf += link("l" + next, mass + ball) +
            joint("j" + now, "revolute", "l" + now, "l" + next, limit("lower='-1' upper='1'"));
  }
  CHECK(errorOf(urdf + "</robot>").find("5000 moving joints, must be 1 to 16") != std::string::npos);
}

TEST_CASE("Soft limits narrow the others", "[urdf]")
{
  const auto limits = [](const std::string &soft, bool use = true) {
    vpArmUrdfSpec spec;
    spec.softLimits = use;
    return load(twoLinks(good + "<safety_controller " + soft + "/>"), spec);
  };
  const std::string both = "k_velocity='1' k_position='1' soft_lower_limit='-0.5' soft_upper_limit='3'";
  CHECK(limits(both).lower()(0) == -0.5);
  CHECK(limits(both).upper()(0) == 2.);
  CHECK(limits(both).spec().warnings == Sentences{"the position limits of j are narrowed by the soft limits"});
  CHECK(limits(both, false).lower()(0) == -1.);
  CHECK(limits("k_velocity='1'").upper()(0) == 2.);          // not narrowed to 0
  CHECK(limits("soft_lower_limit='1.5'").lower()(0) == 1.5); // the other side is not given
  CHECK(limits("soft_lower_limit='0' soft_upper_limit='0'").spec().warnings ==
        Sentences{"the soft limits of j leave no range: not used"});
}

TEST_CASE("A robot without a name and one with several roots are read", "[urdf]")
{
  const std::string links = link("base") + link("arm") + link("world & sky") + link("ground") +
                            joint("j", "revolute", "base", "arm", good) + joint("f", "fixed", "world", "ground");
  std::string urdf = "<robot>" + links + "</robot>";
  urdf.replace(urdf.find("world & sky"), 11, "roots");
  urdf.replace(urdf.find("'world'"), 7, "'roots'");
  const vpArmModel model = load(urdf, toTip("arm"));
  CHECK(model.spec().name == "catchArmUrdf-own");
  CHECK(model.spec().bodies.size() == 2);
  CHECK(model.spec().warnings == Sentences{"the robot has no name, the file's is taken: catchArmUrdf-own",
                                           "links below the roots roots are not connected with the arm: left out"});
  vpArmUrdfSpec spec = toTip("arm");
  spec.base = "roots";
  CHECK(errorOf(urdf, spec).find("link arm is not below link roots") != std::string::npos);
  spec.base = "roots_"; // the link that was added is not there for others
  CHECK(errorOf(urdf, spec).find("base is roots_, must be one of the links arm, base, ground, roots") !=
        std::string::npos);
  CHECK(errorOf(urdf).find("tip must be one of the links arm, ground: the end effector is not unique") !=
        std::string::npos);
}

TEST_CASE("xacro is refused with the command that expands it", "[urdf]")
{
  const File suffix("arm.urdf.xacro", twoLinks(good));
  CHECK(errorOf([&] { static_cast<void>(vpLoadArmUrdf(suffix.name())); }) ==
        "catchArmUrdf-arm.urdf.xacro: is written in xacro, expand it by the command: xacro "
        "catchArmUrdf-arm.urdf.xacro -o robot.urdf");
  for (const char *piece : {"<xacro:include filename='a'/>", "<link name='${a}'/>", "<link name='a' b='$(find a)'/>"}) {
    CHECK(errorOf(twoLinks(good, piece)).find("is written in xacro") != std::string::npos);
  }
  CHECK(errorOf("<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>" + twoLinks(good).substr(16)) == "no error");
  const File left("left.urdf", twoLinks(good, "<xacro:sensors side='left'/>"));
  CHECK(vpLoadArmUrdf(left.name()).spec().warnings.front() ==
        "calls of xacro macros that were never expanded are left out: xacro:sensors");
}

TEST_CASE("Meshes are found in packages, above the file and beside it", "[urdf]")
{
  const fs::path root = fs::path("catchArmUrdf-folder");
  fs::create_directories(root / "given" / "my_arm" / "meshes");
  fs::create_directories(root / "renamed" / "urdf");
  fs::create_directories(root / "renamed" / "meshes");
  for (const fs::path &file :
       {root / "given/my_arm/meshes/a.STL", root / "renamed/meshes/b.stl", root / "renamed/urdf/c.dae"}) {
    std::ofstream(file.string()) << "mesh";
  }
  std::ofstream((root / "renamed/package.xml").string()) << "<package><name>other_arm</name></package>";
  const auto found = [&](const std::string &name, const std::vector<std::string> &paths) {
    const std::string file = (root / "renamed/urdf/arm.urdf").string();
    const std::string mesh =
        "<collision><geometry><mesh filename='" + name + "' scale='1 -1 2'/></geometry></collision>";
    std::ofstream(file) << "<robot name='r'>" + link("base") + link("arm", mesh) +
                               joint("j", "revolute", "base", "arm", good) + "</robot>";
    vpArmUrdfSpec spec;
    spec.packagePaths = paths;
    const vpArmSpec arm = vpLoadArmUrdf(file, spec).spec();
    CHECK(arm.uncovered == Sentences{"arm"});
    CHECK(arm.shapes.size() + arm.warnings.size() == 2);
    if (arm.shapes.size() == 2) {
      CHECK(fs::is_regular_file(arm.shapes[1].file));
      CHECK(arm.shapes[1].size == Eigen::Vector3d(1., -1., 2.));
    }
    return arm.warnings.empty() ? fs::path(arm.shapes[1].file).filename().string() : arm.warnings[0];
  };
  const std::string given = (root / "given").string();
  CHECK(found("package://my_arm/meshes/a.STL", {given}) == "a.STL");
  CHECK(found("package://my_arm/meshes/a.stl", {given}) == "a.STL");
  CHECK(found("package://my_arm/meshes/a.stl", {given + "/my_arm"}) == "a.STL");
  CHECK(found("model://my_arm/meshes/a.stl", {"nowhere", given}) == "a.STL");
  CHECK(found("package://other_arm/meshes/b.stl", {}) == "b.stl"); // by package.xml
  CHECK(found("package://renamed/meshes/b.STL", {}) == "b.stl");   // by its folder
  CHECK(found("c.dae", {}) == "c.dae");
  CHECK(found("file://c.dae", {}) == "c.dae");
  CHECK(found("file://" + fs::absolute(root / "renamed/urdf/c.dae").string(), {}) == "c.dae");
  CHECK(found("../meshes/b.stl", {}) == "b.stl");
  const std::string lost = found("package://my_arm/meshes/a.stl", {"nowhere"});
  CHECK(lost.find("a mesh is not found in nowhere, ") == 0);
  CHECK(lost.find("renamed/urdf and the folders above it: package://my_arm/meshes/a.stl of arm") != std::string::npos);
  for (const char *name : {"package://my_arm", "package://", "", "c.stl", "."}) {
    CHECK(found(name, {}).find("a mesh is not found") == 0);
  }
  fs::remove_all(root);
}

TEST_CASE("What is connected with the base belongs to the arm, above it as well", "[urdf]")
{
  const std::string urdf = "<robot name='r'>" + link("cart") + link("wheel") + link("torso") + link("head") +
                           link("base", "") + link("arm", mass + ball) +
                           joint("w", "continuous", "cart", "wheel", "<axis xyz='0 0 1'/>") +
                           joint("lift", "prismatic", "cart", "torso", "<origin xyz='0 0 1'/>" + good) +
                           joint("h", "fixed", "torso", "head", "<origin xyz='0 0 0.5'/>") +
                           joint("b", "fixed", "torso", "base", "<origin xyz='0.2 0 0'/>") +
                           joint("j", "revolute", "base", "arm", good) + "</robot>";
  vpArmUrdfSpec spec = toTip("arm");
  spec.base = "base";
  const vpArmSpec arm = load(urdf, spec).spec();
  CHECK(arm.bodies.size() == 6);
  CHECK(arm.uncovered == Sentences{"cart", "wheel"}); // they move relative to the base
  REQUIRE(arm.capsules.size() == 3);
  CHECK((arm.capsules[0].from - Eigen::Vector3d(-0.2, 0., 0.)).norm() < 1e-12);  // torso
  CHECK((arm.capsules[1].from - Eigen::Vector3d(-0.2, 0., 0.5)).norm() < 1e-12); // head
  spec.held = {{"lift", 0.25}};
  CHECK(load(urdf, spec).spec().uncovered == Sentences{"wheel"});
  CHECK((load(urdf, spec).spec().capsules[2].from - Eigen::Vector3d(-0.2, 0., -1.25)).norm() < 1e-12); // cart
  spec.base.clear(); // a held joint within the chain
  CHECK(load(urdf, spec).size() == 1);
  CHECK((load(urdf, spec).spec().joints[0].before.p - Eigen::Vector3d(0.2, 0., 1.25)).norm() < 1e-12);
  spec.holdOthers = true;
  CHECK(load(urdf, spec).spec().uncovered.empty());
  spec.held = {{"lift", 2.5}};
  CHECK(errorOf(urdf, spec).find("held joint lift at 2.5") != std::string::npos);
  spec.held = {{"lift", NAN}};
  CHECK(errorOf(urdf, spec).find("held joint lift at nan") != std::string::npos);
  spec.held = {{"h", 0.}};
  CHECK(errorOf(urdf, spec).find("held joint h must be revolute, continuous or prismatic") != std::string::npos);
  spec.held = {{"elbow", 0.}};
  CHECK(errorOf(urdf, spec).find("there is no joint elbow to be held") != std::string::npos);
}

TEST_CASE("Capsules of short fingers enclose them wherever they are", "[urdf]")
{
  for (unsigned int problem = 0; problem < 50; ++problem) {
    auto rng = vpTestSupport::generator(problem);
    CAPTURE(vpTestSupport::seed(), problem);
    const auto three = [&rng](double from, double to) {
      std::ostringstream text;
      text.precision(17);
      text << uniform(rng, from, to) << ' ' << uniform(rng, from, to) << ' ' << uniform(rng, from, to);
      return text.str();
    };
    const double lower = uniform(rng, -1., 1.), upper = lower + uniform(rng, 0., 0.05), ratio = uniform(rng, -2., 2.);
    std::ostringstream range, mimic;
    range.precision(17);
    mimic.precision(17);
    range << "lower='" << lower << "' upper='" << upper << "' velocity='1' effort='1'";
    mimic << "<mimic joint='l' multiplier='" << ratio << "' offset='0.3'/>";
    const std::string geometry[] = {"<box size='" + three(0.01, 0.1) + "'/>", "<sphere radius='0.03'/>",
                                    "<cylinder radius='0.02' length='0.1'/>"};
    const std::string finger = "<collision><origin xyz='" + three(-1., 1.) + "' rpy='" + three(-3., 3.) +
                               "'/><geometry>" + geometry[problem % 3] + "</geometry></collision>";
    const std::string place =
        "<origin xyz='" + three(-1., 1.) + "' rpy='" + three(-3., 3.) + "'/><axis xyz='" + three(0.1, 1.) + "'/>";
    const std::string urdf =
        "<robot name='r'>" + link("base") + link("arm") + link("left", "") + link("right", "") + link("nail", finger) +
        joint("j", "revolute", "base", "arm", good) +
        joint("l", "prismatic", "arm", "left", "<axis xyz='1 0 0'/><limit " + range.str() + "/>") +
        joint("r", "prismatic", "arm", "right",
              place + "<limit lower='-9' upper='9' velocity='1' effort='1'/>" + mimic.str()) +
        joint("f", "fixed", "right", "nail", "<origin xyz='" + three(-1., 1.) + "' rpy='" + three(-3., 3.) + "'/>") +
        "</robot>";
    vpArmUrdfSpec spec = toTip("arm");
    const vpArmSpec moving = load(urdf, spec).spec();
    CHECK(moving.uncovered.empty());
    CHECK(moving.shapes.size() == 2);
    REQUIRE(moving.capsules.size() == 3);
    const vpArmCapsule &around = moving.capsules[2];
    for (int sample = 0; sample < 3; ++sample) {
      spec.held = {{"l", sample == 0 ? lower : sample == 1 ? upper : uniform(rng, lower, upper)}};
      const vpArmSpec held = load(urdf, spec).spec();
      REQUIRE(held.capsules.size() == 3);
      // The capsule there lies within: its ends do, with its radius.
      for (const Eigen::Vector3d &end : {held.capsules[2].from, held.capsules[2].to}) {
        const Eigen::Vector3d axis = around.to - around.from;
        const double length = std::max(axis.squaredNorm(), 1e-300);
        const double t = std::clamp((end - around.from).dot(axis) / length, 0., 1.);
        CHECK((end - around.from - t * axis).norm() + held.capsules[2].radius <= around.radius + 1e-12);
      }
    }
  }
}
