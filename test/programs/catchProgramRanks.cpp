/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Sweeps of the programs under mpirun. Skipped if mpirun is missing; not built without MPI.
#include "vpCatch.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace
{
using nlohmann::json;

//! False and skipped without mpirun.
bool haveMpirun()
{
  if (std::system("command -v mpirun >/dev/null 2>&1") == 0) {
    return true;
  }
  vpTestSupport::skip("mpirun is missing (Debian: openmpi-bin)");
  return false;
}

//! Command prefix of the program. Open MPI requires two confirmations to run as root, as in a container.
std::string mpirun(int ranks)
{
  return "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n " + std::to_string(ranks);
}

const std::string SPEC = R"({"design": {"frame_rate_hz": [800, 1600, 2400], "image_px": [[96, 72], [160, 100]],
  "um_per_px": [4.5, 6], "controller": ["observer", "pid"]}, "task": {"cells": 6, "runs": 1}})";

std::size_t occurrences(const std::string &text, const std::string &part)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

// Without the wall times, which are those of this run, and what names the run.
json comparable(json value)
{
  if (value.is_object()) {
    for (const char *name : {"wall_time_s", "command", "seconds", "computing_time_s"}) {
      value.erase(name);
    }
    for (auto &item : value.items()) {
      item.value() = comparable(item.value());
    }
  }
  else if (value.is_array()) {
    for (json &item : value) {
      item = comparable(item);
    }
  }
  return value;
}

// The columns of a CSV file without those whose name has "_ms".
std::string withoutTimes(const std::string &csv)
{
  std::string result;
  std::vector<bool> drop;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      if (result.empty() || column >= drop.size()) {
        drop.resize(column + 1, cell.find("_ms") != std::string::npos);
      }
      result += drop[column] ? "" : cell + ",";
    }
    result += "\n";
  }
  return result;
}
} // namespace

#ifdef PLAN_COMPARE
TEST_CASE("visp-plan-compare runs its problems on all ranks", "[ranks]")
{
  if (!haveMpirun()) {
    return;
  }
  ProgramRun run(PLAN_COMPARE);
  const std::string arguments = "--scene S2,S6 --method potential-corrected,dtg --seeds 4 ";
  REQUIRE(run(arguments + "--jobs 2 --out one") == 0);
  REQUIRE(run(arguments + "--out three", mpirun(3)) == 0);
  CAPTURE(run.err());
  CHECK(occurrences(run.out(), "Report: ") == 1);
  const std::string one = withoutTimes(vpApp::readFile(run.path("one/runs.csv")));
  CHECK(occurrences(one, "\n") == 1 + 2 * 2 * 4);
  CHECK(withoutTimes(vpApp::readFile(run.path("three/runs.csv"))) == one);
}
#endif

#ifdef SERVO_COMPARE
TEST_CASE("visp-servo-compare runs its seeds on all ranks", "[ranks]")
{
  if (!haveMpirun()) {
    return;
  }
  ProgramRun run(SERVO_COMPARE);
  const std::string arguments = "--law pbvs1,ff-lookat-pi --plant B --measure points --robot amor --monte-carlo 5 ";
  REQUIRE(run(arguments + "--jobs 2 --out one") == 0);
  REQUIRE(run(arguments + "--out three", mpirun(3)) == 0);
  CAPTURE(run.err());
  CHECK(occurrences(run.out(), "Report: ") == 1);
  const json one = json::parse(vpApp::readFile(run.path("one/summary.json")))["runs"];
  CHECK(one.size() == 10);
  CHECK((one == json::parse(vpApp::readFile(run.path("three/summary.json")))["runs"])); // no dump of both
  CHECK(run.entries().size() == 2);
}
#endif

#ifdef THESIS_REPORT
TEST_CASE("visp-thesis-report runs its parts on all ranks", "[ranks]")
{
  if (!haveMpirun()) {
    return;
  }
  ProgramRun run(THESIS_REPORT);
  const std::string arguments = "--only fig6.3,fig6.4,tableA.1,fig8.14 ";
  REQUIRE(run(arguments + "--jobs 2 --out one") == 0);
  REQUIRE(run(arguments + "--out two", mpirun(2)) == 0);
  CAPTURE(run.err());
  CHECK(occurrences(run.out(), "Report: ") == 1);
  const json one = json::parse(vpApp::readFile(run.path("one/results.json")));
  CHECK((comparable(one) == comparable(json::parse(vpApp::readFile(run.path("two/results.json"))))));
  CHECK(vpApp::readFile(run.path("one/curves.csv")) == vpApp::readFile(run.path("two/curves.csv")));
}
#endif

#ifdef PRINT_PATTERN
TEST_CASE("Any number of ranks gives the files of one process", "[explore]")
{
  if (!haveMpirun()) {
    return;
  }
  ProgramRun run(PRINT_PATTERN);
  run.write("spec.json", SPEC);
  REQUIRE(run("--explore spec.json --jobs 2 --out one") == 0);
  json one = json::parse(vpApp::readFile(run.path("one/summary.json")));
  for (const int ranks : {2, 3}) {
    CAPTURE(ranks);
    REQUIRE(run("--explore spec.json --out many", mpirun(ranks)) == 0);
    CAPTURE(run.err());
    CHECK(occurrences(run.out(), "are on the Pareto front") == 1); // only the first rank prints
    for (const char *file : {"explore.csv", "front.csv", "front.json"}) {
      CAPTURE(file);
      CHECK(vpApp::readFile(run.path(std::string("one/") + file)) ==
            vpApp::readFile(run.path(std::string("many/") + file)));
    }
    json many = json::parse(vpApp::readFile(run.path("many/summary.json")));
    for (json *summary : {&one, &many}) {
      summary->erase("wall_time_s");
      summary->erase("command");
    }
    CHECK(one == many);
  }
}

TEST_CASE("What is wrong is told once and ends all ranks with its status", "[explore]")
{
  if (!haveMpirun()) {
    return;
  }
  ProgramRun run(PRINT_PATTERN);
  run.write("bad.json", R"({"design": {"fps": 3}})");
  CHECK(run("--explore bad.json", mpirun(3)) == 1);
  CAPTURE(run.err());
  CHECK(occurrences(run.err(), "visp-print-pattern: bad.json: unknown field design.fps; known are ") == 1);
  CHECK(run("--explore none.json", mpirun(2)) == 1);
  CHECK(occurrences(run.err(), "none.json") == 1);
  CHECK(run("--explore bad.json --runs 3", mpirun(2)) == 2);
  CHECK(occurrences(run.err(), "--runs is given beside --explore") == 1);
  CHECK(run("--no-thesis", mpirun(2)) == 2);
  CHECK(run.err().find("mpirun started 2 processes, which only --explore can use") != std::string::npos);
  CHECK(run.entries() == std::vector<std::string>{"bad.json"});
  CHECK(run("--help", mpirun(2)) == 0);
  CHECK(occurrences(run.out(), "Examples:") == 1);
}
#endif
