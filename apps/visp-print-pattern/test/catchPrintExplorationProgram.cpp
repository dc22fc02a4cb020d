/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-print-pattern --explore as run by users, on one process.
#include "vpCatch.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace
{
using nlohmann::json;

constexpr int OK = 0, DATA = 1, USAGE = 2;

// 2 feasible cameras, one without time for its readout, one that sees no cell, one too slow for the motion.
const std::string SPEC =
    R"({"seed": 4, "design": {"frame_rate_hz": [300, 1600, 2400], "image_px": [[96, 72], [160, 100]],
  "um_per_px": [2, 6], "drop_velocity_mm_s": 40, "controller": ["observer", "pid"]}, "task": {"cells": 8, "runs": 1},
  "require": {"landing_worst_um": 10}})";

std::size_t lines(const std::string &text)
{
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

json summaryOf(const ProgramRun &run, const std::string &folder)
{
  json summary = json::parse(vpApp::readFile(run.path(folder + "/summary.json")));
  for (const char *field : {"wall_time_s", "command"}) {
    CHECK(summary.contains(field));
    summary.erase(field);
  }
  return summary;
}
} // namespace

TEST_CASE("An exploration is the same on one thread and on three, and says what it found", "[explore]")
{
  ProgramRun run(PRINT_PATTERN);
  run.write("spec.json", SPEC);
  REQUIRE(run("--explore spec.json --jobs 1 --out a") == OK);
  CHECK(run.out().find("keep what is required (landing_worst_um <= 10)") != std::string::npos);
  REQUIRE(run("--explore spec.json --jobs 3 --out b") == OK);
  for (const char *file : {"explore.csv", "front.csv", "front.json"}) {
    CAPTURE(file);
    CHECK(vpApp::readFile(run.path(std::string("a/") + file)) == vpApp::readFile(run.path(std::string("b/") + file)));
  }
  const json summary = summaryOf(run, "a");
  CHECK(summary == summaryOf(run, "b"));
  CHECK(summary["designs"] == 3 * 2 * 2 * 2 + 2); // plus the thesis's camera with both controllers
  CHECK(lines(vpApp::readFile(run.path("a/explore.csv"))) == 27);
  CHECK(lines(vpApp::readFile(run.path("a/front.csv"))) == summary["front"].size() + 1);
  CHECK(summary["feasible"].get<int>() >= 4);
  int infeasible = 0;
  for (const auto &reason : summary["infeasible"].items()) {
    infeasible += reason.value().get<int>();
  }
  CHECK(infeasible + summary["feasible"].get<int>() == 26);
  CHECK(summary["infeasible"]["camera"] == 4); // 160 x 100 px at 2400 Hz
  CHECK(summary["infeasible"]["view"].get<int>() >= 8);
  CHECK(summary["best"]["figures"]["landing_worst_um"].get<double>() <= 10.);
  for (const json &thesis : summary["thesis"]) {
    CHECK(thesis["figures"]["frame_rate_hz"] == 1600);
  }
  for (const json &file : summary["files"]) {
    CHECK(std::filesystem::exists(run.path("a/" + file.get<std::string>())));
  }
  run.write("other.json",
            json::parse(SPEC).patch(json::parse(R"([{"op": "replace", "path": "/seed", "value": 5}])")).dump());
  REQUIRE(run("--explore other.json --out c") == OK);
  CHECK(vpApp::readFile(run.path("a/explore.csv")) != vpApp::readFile(run.path("c/explore.csv")));
}

TEST_CASE("Where nothing works the program says so", "[explore]")
{
  ProgramRun run(PRINT_PATTERN);
  run.write("spec.json", R"({"thesis": false, "design": {"frame_rate_hz": 9000}})");
  REQUIRE(run("--explore spec.json --out d") == OK);
  CHECK(run.out().find("Of 1 design 0 work, and 0 are on the Pareto front.") != std::string::npos);
  CHECK(run.out().find("None works, so there is nothing to choose.") != std::string::npos);
  CHECK(vpApp::readFile(run.path("d/report.html")).find("do not fit into the 111.1 us of a frame") !=
        std::string::npos);
}

TEST_CASE("Wrong files and options end in a sentence and leave nothing behind", "[explore]")
{
  ProgramRun run(PRINT_PATTERN);
  CHECK(run("--explore none.json") == DATA);
  CHECK(run.err().find("none.json") != std::string::npos);
  CHECK(lines(run.err()) == 1);
  run.write("bad.json", R"({"design": {"fps": 3}})");
  CHECK(run("--explore bad.json") == DATA);
  CHECK(run.err().find("visp-print-pattern: bad.json: unknown field design.fps; known are ") == 0);
  CHECK(lines(run.err()) == 1);
  CHECK(run("--explore bad.json --cells 4") == USAGE);
  CHECK(run.err().find("--cells is given beside --explore, which takes --out and --jobs only") != std::string::npos);
  CHECK(run("--explore ''") == USAGE);
  CHECK(run("--explore bad.json --jobs 300") == USAGE);
  CHECK(run.entries() == std::vector<std::string>{"bad.json"});
}
