/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program as run by users: exit status, output streams, written files.
#include "vpCatch.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <sstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

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
  const json motions = json::parse(vpApp::readFile(run.path("out/plan-trajectory/motions.json")));
  CHECK(motions.at(0).at("duration_s") == list[0]["duration"]);
  CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
}

TEST_CASE("A bad line does not stop the others", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  run.write("p.jsonl", GOOD + "\nnonsense\n\n" + R"({"id": 7, "q1": [1, 2], "v_max": [1, 0]})" + "\n" + GOOD + "\n" +
                           R"({"id": 8, "q1": "a"})");
  CHECK(run("p.jsonl --csv c.csv --out r", "VISP_DIRECT_PYTHON=none") == DATA);
  const std::vector<json> list = answers(run.out());
  REQUIRE(list.size() == 5);
  CHECK(list[0]["status"] == "Finished");
  CHECK(list[1]["status"] == "InvalidInput");
  CHECK(list[1]["line"] == 2);
  CHECK(list[2]["message"] == "p.jsonl:4: velocity limit of axis 1 is 0, must be > 0");
  CHECK(list[2]["id"] == 7);
  CHECK(list[3]["status"] == "Finished");
  CHECK(list[3]["duration"] == list[0]["duration"]);
  CHECK(list[4]["id"] == 8);
  const std::string place = run.path("r").string();
  CHECK(run.err().find("The data is in " + place +
                       ", without a report, which needs Python: none was not found; make it later by: "
                       "python3 -m visp_direct.report " +
                       place + "\nvisp-plan-trajectory: 3 of 5 problems were refused, the first: p.jsonl:2: ") == 0);
  std::vector<std::string> names = run.entries();
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"c-1.csv", "c-5.csv", "p.jsonl", "r"});
  const json summary = json::parse(vpApp::readFile(run.path("r/summary.json")));
  CHECK(summary.at("problems") == 5);
  CHECK(summary.at("refused") == 3);
  CHECK(summary.at("files") == json({"motions.json", "summary.json"}));
}

TEST_CASE("Why there is no report", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  run.write("p.jsonl", GOOD + "\n");
  run.write("killed", "#!/bin/sh\nkill -9 $$\n");
  std::filesystem::permissions(run.path("killed"), std::filesystem::perms::owner_all);
  run.write("locked", "");
  const std::string killed = run.path("killed").string(), locked = run.path("locked").string();
  for (const auto &[python, reason] : {std::pair(killed, killed + " was ended by signal 9"),
                                       {locked, locked + ": Permission denied"},
                                       {"true", "true wrote no report"},
                                       {"none", "none was not found"}}) {
    CHECK(run("p.jsonl --out r", "VISP_DIRECT_PYTHON='" + python + "'") == OK);
    CHECK_THAT(run.err(), Catch::Contains(", which needs Python: " + reason + "; make it later by: "));
    std::filesystem::remove_all(run.path("r"));
  }
}

TEST_CASE("Standard input, one file each for one problem", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  run.write("p.jsonl", GOOD + "\r\n");
  CHECK(run("- --csv c.csv <p.jsonl") == OK);
  CHECK(answers(run.out()).size() == 1);
  CHECK(run.err().empty());
  CHECK(std::filesystem::exists(run.path("c.csv")));
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
      {"p.jsonl --out p.jsonl", DATA, "p.jsonl: exists and is not a folder"},
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

TEST_CASE("Ctrl-C and SIGTERM end the program while it waits for problems", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  for (const int signal : {SIGINT, SIGTERM}) {
    for (const bool byName : {false, true}) {
      CAPTURE(signal, byName);
      const std::string pipe = run.path("pipe").string();
      REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
      const std::string out = run.path("out.txt").string(), err = run.path("err.txt").string();
      const pid_t child = fork();
      if (child == 0) {
        // Both ends of the pipe: it never ends.
        const int both = open(pipe.c_str(), O_RDWR);
        dup2(both, 0);
        dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
        dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
        execl(PLAN_TRAJECTORY, PLAN_TRAJECTORY, byName ? pipe.c_str() : "-", nullptr);
        _exit(99);
      }
      std::ofstream(pipe) << R"({"q1": 1, "v_max": 1})" << std::endl;
      while (!std::filesystem::exists(out) || std::filesystem::file_size(out) == 0) { // it answered and waits again
        usleep(1000);
      }
      kill(child, signal);
      int status = 0;
      waitpid(child, &status, 0);
      CHECK(WIFEXITED(status));
      CHECK(WEXITSTATUS(status) == 130);
      CHECK(vpApp::readFile(err) == "visp-plan-trajectory: interrupted\n");
      std::filesystem::remove(pipe);
      std::filesystem::remove(out);
    }
  }
}

TEST_CASE("What a problem brings does not harm program and terminal", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  const std::string deep(1000000, '[');
  run.write("p.jsonl", "{\"id\": " + deep + "\n{\"q1\": " + deep + "\n" +
                           R"({"id": "\u001b[31m\u009b\u202e", "q1": 1, "v_max": 1})" + "\n" +
                           R"({"id": 1, "id": 2, "q1": 1, "v_max": 1})" + "\n");
  CHECK(run("p.jsonl") == DATA);
  CHECK(run.out().find_first_of("\x1b\x9b") == std::string::npos);
  const std::vector<json> lines = answers(run.out());
  REQUIRE(lines.size() == 4);
  CHECK(lines[0]["message"] == "p.jsonl:1: is nested more than 64 deep");
  CHECK(lines[1]["message"] == "p.jsonl:2: is nested more than 64 deep");
  CHECK(lines[2]["id"] == "\x1b[31m\xc2\x9b\xe2\x80\xae");
  CHECK(lines[3]["message"] == "p.jsonl:4: field \"id\" is given twice");
}

TEST_CASE("Samples are written with all their digits", "[visp-plan-trajectory]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  run.write("p.jsonl", R"({"q0": 0.1, "q1": 0.30000000000000004, "v_max": 0.7, "a_max": 1.3, "dt": 0.01})");
  REQUIRE(run("p.jsonl --csv motion.csv") == 0);
  const std::string csv = vpApp::readFile(run.path("motion.csv"));
  const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
  CHECK(std::stod(last.substr(last.find(',') + 1)) == 0.30000000000000004);
  const json answer = json::parse(run.out());
  CHECK(std::stod(last) == answer["duration"].get<double>());
}

TEST_CASE("A form of a plug-in is used where it keeps the limits", "[visp-plan-trajectory][plugin]")
{
  ProgramRun run(PLAN_TRAJECTORY);
  const std::string rest = R"("q1": [0.5, 0.2], "v_max": [0.5, 1], "a_max": [1, 2]})";
  run.write("p.jsonl", "{" + rest + "\n" + R"({"form": "slow", )" + rest + "\n" + R"({"form": "hasty", )" + rest);
  REQUIRE(run(std::string("p.jsonl --plugin '") + PLUGIN + "'") == OK);
  const std::vector<json> list = answers(run.out());
  REQUIRE(list.size() == 3);
  CHECK(list[1]["form"] == "Own");
  CHECK(list[1]["duration"].get<double>() == Approx(4.));
  CHECK(list[2] == [&] { // ours, as without a form
    json same = list[0];
    same["line"] = list[2]["line"];
    return same;
  }());

  run.write("p.jsonl", R"({"form": "slow", )" + rest);
  CHECK(run("p.jsonl") == DATA);
  CHECK(run.err().find("p.jsonl:1: motion form \"slow\" is unknown, there is none") != std::string::npos);
}
