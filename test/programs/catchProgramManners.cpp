/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What a newcomer tries first is the same in all programs: help, version, mistakes, a full device, a folder of others.
#include "vpCatch.h"

#include "programRun.h"

#include <algorithm>

namespace
{
const std::vector<std::string> programs = {PROGRAMS};

std::string nameOf(const std::string &program) { return std::filesystem::path(program).filename().string(); }

bool has(const std::string &text, const std::string &piece) { return text.find(piece) != std::string::npos; }

//! Status 2 or 1, one sentence that begins with the program's name, nothing on standard output and nothing written.
void complains(ProgramRun &run, const std::string &program, const std::string &arguments, int status,
               const std::string &sentence)
{
  CAPTURE(program, arguments);
  CHECK(run(arguments) == status);
  CAPTURE(run.err());
  CHECK(has(run.err(), nameOf(program) + ": "));
  CHECK(has(run.err(), sentence));
  CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
  CHECK(run.out().empty());
  CHECK(run.entries().empty());
}
} // namespace

TEST_CASE("Help and version", "[programs]")
{
  for (const std::string &program : programs) {
    CAPTURE(program);
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    CHECK(run.err().empty());
    for (const char *piece : {"Usage: ", "Examples:", "Exit status: 0 ", "--version"}) {
      CHECK(has(run.out(), piece));
    }
    CHECK(has(run.out(), nameOf(program)));
    REQUIRE(run("--version") == 0);
    CHECK(run.out().find(nameOf(program) + " " + VISP_DIRECT_VERSION + " (ViSP ") == 0);
    CHECK(std::count(run.out().begin(), run.out().end(), '\n') == 1);
    CHECK(run.entries().empty());
  }
}

TEST_CASE("What standard output does not take is told", "[programs]")
{
  if (!std::filesystem::exists("/dev/full")) {
    vpTestSupport::skip("there is no /dev/full");
    return;
  }
  for (const std::string &program : programs) {
    CAPTURE(program);
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    const bool lists = has(run.out(), "--list");
    for (const char *arguments : {"--help", "--version", "--list"}) {
      if (arguments != std::string("--list") || lists) {
        CAPTURE(arguments);
        CHECK(run.intoFullDevice(arguments) == 1);
        CHECK(run.err() == nameOf(program) + ": standard output: cannot be written\n");
      }
    }
  }
}

TEST_CASE("Mistakes on the command line", "[programs]")
{
  for (const std::string &program : programs) {
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    const std::string help = run.out();
    complains(run, program, "--nonsense", 2, "--nonsense");
    complains(run, program, "--nonsense", 2, "(see " + nameOf(program) + " --help)");
    if (has(help, "--jobs")) {
      for (const char *jobs : {"0", "-1", "many", "1.5", "99999999999999999999"}) {
        complains(run, program, std::string("--jobs ") + jobs, 2, "--jobs is " + std::string(jobs));
      }
    }
    if (has(help, "--frames")) {
      complains(run, program, "--frames -5", 2, " is -5, must be ");
    }
    if (has(help, "--seed ")) {
      complains(run, program, "--seed luck", 2, "--seed is luck, must be ");
    }
    if (has(help, "--out")) {
      complains(run, program, "--out ''", 2, "--out is empty, must name a folder");
      complains(run, program, "--out", 2, "--out");
    }
  }
}

TEST_CASE("A result folder that cannot be used ends the program at once", "[programs]")
{
  for (const std::string &program : programs) {
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    if (!has(run.out(), "--out")) {
      continue;
    }
    complains(run, program, "--out /proc/none", 1, "/proc/none: cannot be written");
    complains(run, program, "--out /dev/null", 1, "/dev/null: exists and is not a folder");
    std::filesystem::create_directory(run.path("mine"));
    run.write("mine/thesis.txt", "years of work");
    CAPTURE(program);
    CHECK(run("--out mine") == 1);
    CHECK(has(run.err(), "mine: is not empty and not a result of " + nameOf(program) + ", so it is left alone"));
    CHECK(vpApp::readFile(run.path("mine/thesis.txt")) == "years of work");
  }
}
