/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program as its users run it: exit status, what is on which stream, what is written.
#include "vpCatch.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace
{
using nlohmann::json;

constexpr int OK = 0;
constexpr int DATA = 1;
constexpr int USAGE = 2;

const std::string GOOD = R"({"q1": [0.5], "v_max": [0.5]})";

std::vector<json> answers(const std::string &out)
{
  std::vector<json> list;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    list.push_back(json::parse(line));
  }
  return list;
}
} // namespace

TEST_CASE("Without a file it is figure 6.3", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  REQUIRE(run("") == OK);
  const std::vector<json> list = answers(run.out());
  REQUIRE(list.size() == 1);
  CHECK(list[0]["duration"].get<double>() == Approx(2.442439077777).margin(1e-9));
  CHECK(std::filesystem::exists(run.path("out/plan-trajectory/figure-6.3.svg")));
  CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
}

TEST_CASE("A bad line does not stop the others", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  run.write("p.jsonl", GOOD + "\nnonsense\n\n" + R"({"id": 7, "q1": [1, 2], "v_max": [1, 0]})" + "\n" + GOOD);
  CHECK(run("p.jsonl --csv c.csv --plot p.svg") == DATA);
  const std::vector<json> list = answers(run.out());
  REQUIRE(list.size() == 4);
  CHECK(list[0]["status"] == "Finished");
  CHECK(list[1]["status"] == "InvalidInput");
  CHECK(list[1]["line"] == 2);
  CHECK(list[2]["message"] == "p.jsonl:4: velocity limit of axis 1 is 0, must be > 0");
  CHECK(list[2]["id"] == 7);
  CHECK(list[3]["status"] == "Finished");
  CHECK(list[3]["duration"] == list[0]["duration"]);
  CHECK(run.err().find("visp-plan-trajectory: 2 of 4 problems were refused, the first: p.jsonl:2: ") == 0);
  std::vector<std::string> names = run.entries();
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"c-1.csv", "c-5.csv", "p-1.svg", "p-5.svg", "p.jsonl"});
}

TEST_CASE("Standard input, one file each for one problem", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  run.write("p.jsonl", GOOD + "\r\n");
  CHECK(run("- --csv c.csv --plot p.png <p.jsonl") == OK);
  CHECK(answers(run.out()).size() == 1);
  CHECK(run.err().empty());
  CHECK(std::filesystem::exists(run.path("c.csv")));
  CHECK(vpApp::readFile(run.path("p.png")).substr(1, 3) == "PNG");
}

TEST_CASE("Bad use ends with a sentence and nothing written", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  run.write("p.jsonl", GOOD);
  run.write("empty.jsonl", "\n \n");
  struct Case {
    std::string arguments;
    int status;
    std::string sentence;
  };
  const std::vector<Case> cases = {
      {"--nonsense", USAGE, "--nonsense"},
      {"p.jsonl --plot p.pdf", USAGE, "--plot is p.pdf, must end in .svg or .png"},
      {"none.jsonl", DATA, "none.jsonl: cannot be read"},
      {". ", DATA, ".: cannot be read"},
      {"empty.jsonl", DATA, "empty.jsonl: has no problem"},
      {"p.jsonl --csv none/c.csv", DATA, "none/c.csv: the folder "},
      {"p.jsonl --csv .", DATA, ".: is a folder, must be a file"},
  };
  for (const Case &bad : cases) {
    CAPTURE(bad.arguments);
    CHECK(run(bad.arguments) == bad.status);
    CAPTURE(run.err());
    CHECK(run.err().find("visp-plan-trajectory: ") == 0);
    CHECK(run.err().find(bad.sentence) != std::string::npos);
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
    CHECK(run.out().empty());
    CHECK(run.entries().size() == 2);
  }
  if (std::filesystem::exists("/dev/full")) { // a device is written to, not replaced
    CHECK(run("p.jsonl --csv /dev/full") == DATA);
    CHECK(run.err().find("/dev/full: cannot be written") != std::string::npos);
    CHECK(std::filesystem::is_character_file("/dev/full"));
  }
}
