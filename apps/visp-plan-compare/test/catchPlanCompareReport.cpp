/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program visp-plan-compare with good and bad input.
#include "vpCatch.h"

#include "jsonReader.h"
#include "programRun.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace
{
//! Reports are tested with Python; where this file asks for one it sets the variable back.
[[maybe_unused]] const int withoutReports = setenv("VISP_DIRECT_PYTHON", "none", 1);
} // namespace

TEST_CASE("Wrong options end with a sentence that names them", "[visp-plan-compare]")
{
  ProgramRun run(PLAN_COMPARE);
  const auto says = [&](const std::string &arguments, int status, const std::string &sentence) {
    CAPTURE(arguments);
    CHECK(run(arguments) == status);
    CAPTURE(run.err());
    CHECK(run.err().find(sentence) != std::string::npos);
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
    CHECK(run.entries().empty());
  };
  says("--scene S9", 2, "--scene: unknown scene \"S9\"; known are S1, S2, S3, S4 (S4a, S4b), S5");
  says("--method dtg,best", 2, "--method: unknown method \"best\"; known are potential");
  says("--seeds 0", 2, "--seeds is 0, must be a whole number from 1 to 100000");
  says("--seeds 3x", 2, "--seeds is 3x, must be a whole number");
  says("--jobs -1", 2, "--jobs is -1, must be a whole number");
  says("--quick --seeds 3", 2, "--quick has its own number of seeds");
  says("--friction -1", 2, "--friction is -1, must be a number >= 0 and <= 10");
  says("--compensate-friction", 2, "--compensate-friction is for drives with friction, --friction is 0");
  says("--out ''", 2, "--out is given without a value");
  says("--bogus", 2, "--bogus");
  says("--scene missing.json", 1, "missing.json");
  says("--arm missing.json", 1, "missing.json: cannot be read (there is no such file)");
  run.write("other.txt", "mine");
  CHECK(run("--scene S7 --seeds 1 --method dtg --out .") == 1);
}

TEST_CASE("Help, version and list are printed", "[visp-plan-compare]")
{
  ProgramRun run(PLAN_COMPARE);
  CHECK(run("--help") == 0);
  for (const char *piece : {"Examples:", "--scene SCENE,...", "--quick", "Exit status: 0", "S6 a trap"}) {
    CAPTURE(piece);
    CHECK(run.out().find(piece) != std::string::npos);
  }
  CHECK(run("--version") == 0);
  CHECK(run.out().find("visp-plan-compare 0.") == 0);
  CHECK(run("--list") == 0);
  for (const char *piece : {"\n  planner-dtg: ", "S2 (200, 6): ", "S5: "}) {
    CAPTURE(piece);
    CHECK(run.out().find(piece) != std::string::npos);
  }
  CHECK(run.entries().empty());
}

TEST_CASE("The result has all its parts, and the same seed the same numbers", "[visp-plan-compare]")
{
  ProgramRun run(PLAN_COMPARE);
  const std::string arguments = "--scene S3,S5,S7 --method potential-corrected,dtg,planner --seeds 3 --seed 2 ";
  const int status = run(arguments + "--jobs 2 --out result");
  CAPTURE(run.err());
  REQUIRE(status == 0);
  const nlohmann::json summary = vpApp::readJsonFile(run.path("result/summary.json"));
  CHECK(summary["program"] == "visp-plan-compare");
  REQUIRE(summary["results"].size() == 6); // two scenes with three methods
  for (const nlohmann::json &cell : summary["results"]) {
    CAPTURE(cell["scene"], cell["method"]);
    CHECK(cell["runs"] == 3);
    CHECK(cell["success"].get<double>() == Approx(cell["successes"].get<double>() / 3.));
    CHECK(cell["success_wilson_95"][0] <= cell["success"]);
    CHECK(cell["success_wilson_95"][1] >= cell["success"]);
    for (const char *field : {"min_clearance_m", "goal_error_m", "duration_s", "peak_v", "peak_a", "peak_jerk",
                              "jerk_integral", "path_length", "replan_ms", "plan_ms", "false_stops", "stops"}) {
      CAPTURE(field);
      CHECK(cell.contains(field));
    }
    for (const char *field : {"p50", "p95", "p99"}) {
      CHECK(cell["replan_ms"][field] >= 0.);
    }
    if (cell["method"] != "potential-corrected") { // methods with guaranteed bounds respect them
      CHECK(cell["runs_over_joint_acceleration"] == 0);
      CHECK(cell["runs_over_joint_velocity"] == 0);
    }
  }
  CHECK(summary["self_motion"].size() == 15);
  for (const nlohmann::json &row : summary["self_motion"]) {
    CHECK(row["tcp_drift_m"] < 1e-4);
  }
  CHECK(summary["validators"].empty());

  const std::string csv = vpApp::readFile(run.path("result/runs.csv"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 19);
  for (const char *file :
       {"log/S3-dtg.csv", "log/S7-planner.csv", "arena/S3.log", "scene/S3.json", "arm.json", "self-motion.csv"}) {
    CAPTURE(file);
    CHECK(std::filesystem::exists(run.path("result").append(file)));
  }
  CHECK(summary["scenes"][0]["shown"].get<std::string>().find("0.3 m/s at 30 Hz") == 0);
  const nlohmann::json scene = vpApp::readJsonFile(run.path("result/scene/S3.json"));
  REQUIRE(scene["objects"].size() == 2); // that cross, so each has places over time
  for (const nlohmann::json &object : scene["objects"]) {
    CHECK(object["known"] == false);
    const auto times = object["track"]["t"].get<std::vector<double>>();
    const auto places = object["track"]["p"].get<std::vector<std::array<double, 3>>>();
    REQUIRE(times.size() == places.size());
    REQUIRE(times.size() > 20);
    for (std::size_t i = 1; i < 20; ++i) { // at the speed of the variant
      const auto &a = places[i - 1], &b = places[i];
      const double way = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      CHECK(way == Approx(0.3 * (times[i] - times[i - 1])).epsilon(1e-6));
    }
  }

  // One job, different order of work: the same numbers, except measured times.
  REQUIRE(run(arguments + "--jobs 1 --out again") == 0);
  const auto figures = [&](const char *file) {
    std::istringstream lines(vpApp::readFile(run.path(file)));
    std::vector<std::string> rows;
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) {
        cells.push_back(cell);
      }
      cells.erase(cells.begin() + 13, cells.begin() + 17); // replan and plan times
      std::string kept;
      for (const std::string &cell : cells) {
        kept += cell + ",";
      }
      rows.push_back(kept);
    }
    return rows;
  };
  CHECK(figures("result/runs.csv") == figures("again/runs.csv"));
}

TEST_CASE("A scene of one's own, on drives with friction", "[visp-plan-compare]")
{
  ProgramRun run(PLAN_COMPARE);
  run.write("mine.json", R"({"name": "my <b> scene", "objects": [
    {"name": "ball", "shape": "sphere", "radius_m": 0.05, "pose": {"translation_m": [0.3, 0.6, 0.5]}}],
  "tasks": [{"name": "over there", "start_rad": [0.246, 0.868, -1.237, -2.39, -2.591, -1.099, 0.324],
             "goal_rad": [0.6, 0.868, -1.237, -2.2, -2.591, -1.099, 0.324]}]})");
  const int status = run("--scene mine.json --method dtg --seeds 1 --friction 1 --out result");
  CAPTURE(run.err());
  REQUIRE(status == 0);
  const nlohmann::json cell = vpApp::readJsonFile(run.path("result/summary.json"))["results"][0];
  CHECK(cell["scene"] == "my <b> scene");
  CHECK(cell["goal_error_m"]["median"] > 1e-6); // the drives do not reach 1 um
  CHECK(cell["successes"] == 1);
  run.write("empty.json", R"({"name": "empty", "objects": []})");
  CHECK(run("--scene empty.json --out none") == 1);
  CHECK(run.err().find("empty.json: tasks is empty, there is nothing to compare") != std::string::npos);
}

TEST_CASE("A method of a plug-in runs beside ours", "[visp-plan-compare][plugin]")
{
  ProgramRun run(PLAN_COMPARE);
  const std::string plugin = std::string("--plugin '") + PLUGIN + "' ";
  REQUIRE(run(plugin + "--list") == 0);
  CHECK(run.out().find("  again: does what dtg does, from a plug-in\n") != std::string::npos);
  const int status = run(plugin + "--scene S1 --seeds 1 --method again,dtg --out result");
  CAPTURE(run.err());
  REQUIRE(status == 0);
  const auto logOf = [&run](const std::string &method) { // without the last column, the time of a look
    std::istringstream lines(vpApp::readFile(run.path("result/log/S1-" + method + ".csv")));
    std::string all;
    for (std::string line; std::getline(lines, line);) {
      all += line.substr(0, line.rfind(',')) + '\n';
    }
    return all;
  };
  CHECK(logOf("again").size() > 10000);
  CHECK((logOf("again") == logOf("dtg")));
  const nlohmann::json methods = vpApp::readJsonFile(run.path("result/summary.json"))["methods"];
  CHECK(methods.dump().find("does what dtg does, from a plug-in") != std::string::npos);
  CHECK(run("--method again") == 2);
}
