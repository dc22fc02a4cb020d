/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Three public robots from their URDFs in the three programs that move arms: each reaches its goals.
#include "vpCaseFile.h"
#include "vpCatch.h"

#include "jsonReader.h"
#include "programRun.h"

namespace
{
using nlohmann::json;

//! \brief A public description with the options that make it an arm.
struct PublicArm {
  const char *folder, *urdf, *srdf, *options;
};

// The cases have no meshes of Tiago's head and base; what is ignored of it is out of reach or only seen.
const PublicArm arms[] = {
    {"panda_description", "urdf/panda.urdf", "srdf/panda.srdf", "--robot-tip panda_link8 --hold all"},
    {"ur_description", "urdf/ur5_robot.urdf", "srdf/ur5.srdf", "--robot-tip tool0"},
    {"tiago_description", "robots/tiago_no_hand.urdf", "",
     "--robot-base torso_lift_link --robot-tip wrist_ft_tool_link --hold all --ignore-link head_1_link,head_2_link,"
     "base_link,base_cover_link,caster_back_left_1_link,caster_back_right_1_link,caster_front_left_1_link,"
     "caster_front_right_1_link"}};

//! Options that name the robot; empty when its files are missing.
std::string filesOf(const PublicArm &arm)
{
  const std::string folder = "example-robot-data/robots/" + std::string(arm.folder) + "/";
  const std::string urdf = vpTestSupport::caseFile(folder + arm.urdf);
  const std::string srdf = *arm.srdf == '\0' || urdf.empty() ? "" : vpTestSupport::caseFile(folder + arm.srdf);
  return urdf.empty() ? "" : "'" + urdf + "' " + (srdf.empty() ? "" : "--srdf '" + srdf + "' ") + arm.options;
}

std::string cacheFolder()
{
  static const TestFolder folder;
  return folder.path.string();
}

//! Runs a program on a robot and hands its summary over. The covers of the meshes are fitted once for all.
template <class Check>
void on(const PublicArm &arm, const std::string &program, const std::string &arguments, const Check &check)
{
  const std::string robot = filesOf(arm);
  if (robot.empty()) {
    return;
  }
  CAPTURE(arm.folder);
  ProgramRun run(program);
  const int status = run(arguments + " --out result --robot " + robot, "XDG_CACHE_HOME='" + cacheFolder() + "'");
  CAPTURE(run.err(), run.out());
  REQUIRE(status == 0);
  check(vpApp::readJsonFile(run.path("result/summary.json").string()), run.err());
}

template <class Check> void onEach(const std::string &program, const std::string &arguments, const Check &check)
{
  for (const PublicArm &arm : arms) {
    on(arm, program, arguments, [&check](const json &summary, const std::string &) { check(summary); });
  }
}
} // namespace

TEST_CASE("visp-servo-compare reaches its goals on public arms", "[programs]")
{
  onEach(SERVO_COMPARE, "--law pbvs1,ff-lookat-pi --plant A --measure points", [](const json &summary) {
    REQUIRE(summary["runs"].size() == 2);
    for (const json &run : summary["runs"]) {
      CAPTURE(run["law"]);
      CHECK(run["arm"]["status"] == "ok");
      CHECK(run["end_rotation_deg"] < 0.5);
    }
  });
}

TEST_CASE("What does not move the camera is named once", "[programs]")
{
  const PublicArm panda = {"panda_description", "urdf/panda.urdf", "",
                           "--robot-tip panda_link8 --camera-link panda_link6"};
  on(panda, SERVO_COMPARE, "--law pbvs1 --plant A --measure points", [](const json &, const std::string &warnings) {
    CHECK_THAT(warnings, Catch::Contains("the camera is on link 6, not moved by panda_joint7\n"));
    for (const char *name : {"panda_joint7", "panda_finger_joint1", "panda_finger_joint2"}) {
      const std::size_t first = warnings.find(name);
      CHECK(first != std::string::npos);
      CHECK(warnings.find(name, first + 1) == std::string::npos);
    }
  });
}

TEST_CASE("visp-plan-compare reaches its goals on public arms", "[programs]")
{
  onEach(PLAN_COMPARE, "--scene S1,S2,S7 --method planner-dtg --seeds 2", [](const json &summary) {
    REQUIRE(summary["results"].size() == 3);
    for (const json &cell : summary["results"]) {
      CAPTURE(cell);
      CHECK(cell["success"] == 1.);
    }
  });
}

TEST_CASE("visp-avoid-obstacle reaches its goal on public arms", "[programs]")
{
  onEach(AVOID_OBSTACLE, "--method planner-dtg", [](const json &summary) {
    CHECK(summary["metrics"]["success"] == true);
    CHECK(summary["metrics"]["collisions_moving"] == 0);
  });
}

TEST_CASE("visp-avoid-obstacle needs no SRDF for the panda", "[programs]")
{
  const PublicArm alone = {"panda_description", "urdf/panda.urdf", "", "--robot-tip panda_link8 --hold all"};
  on(alone, AVOID_OBSTACLE, "--method planner-dtg", [](const json &summary, const std::string &warnings) {
    CHECK(summary["metrics"]["success"] == true);
    CHECK(summary["metrics"]["collisions_moving"] == 0);
    CHECK_THAT(warnings,
               Catch::Contains("which is taken as meant") && Catch::Contains("panda_link5 - panda_link7 (in "));
  });
}

TEST_CASE("An arm of which two links are always too near is refused with their names", "[programs]")
{
  ProgramRun run(AVOID_OBSTACLE);
  const auto link = [](const std::string &name) {
    return "<link name='" + name + "'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>";
  };
  const auto joint = [](const std::string &parent, const std::string &child) {
    return "<joint name='of " + child + "' type='revolute'><origin xyz='0.105 0 0'/><parent link='" + parent +
           "'/><child link='" + child +
           "'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' velocity='1' effort='1'/></joint>";
  };
  run.write("near.urdf", "<robot name='near'>" + link("base") + link("middle") + link("end") + joint("base", "middle") +
                             joint("middle", "end") + "</robot>");
  run.write("none.json", R"({"arm": "near.urdf", "samples": 1, "pairs": []})");
  CHECK(run("--robot near.urdf --allowed-pairs none.json") == 1);
  CHECK(run.err().find("near.urdf: the capsules of base and end are nearer than 30 mm in all of 1000 random "
                       "configurations, where nothing is planned; --covers 6") != std::string::npos);
}
