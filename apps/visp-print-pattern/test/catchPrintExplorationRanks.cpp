/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-print-pattern --explore under mpirun. Skipped if mpirun is missing; not built if the program has no MPI.
#include "vpCatch.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <algorithm>

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
} // namespace

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
