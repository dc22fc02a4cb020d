/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-thesis-report as a user runs it.
#include "programRun.h"

#include "vpCatch.h"

#include <nlohmann/json.hpp>

using Json = nlohmann::json;

TEST_CASE("Two figures: rows, data, page, and nothing else", "[program]")
{
  ProgramRun run(THESIS_REPORT);
  REQUIRE(run("--only fig6.3,tableA.1,fig6.3 --out out --jobs 2") == 0);
  CHECK(run.out().find("out/report.html") != std::string::npos);
  const Json rows = Json::parse(vpApp::readFile(run.path("out/results.json")));
  int velocity = 0;
  for (const Json &row : rows) {
    CHECK((row["id"] == "fig6.3" || row["id"] == "tableA.1"));
    CHECK(row["note"].get<std::string>().find("Not explained") == std::string::npos);
    if (row["id"] == "fig6.3" && row["quantity"] == "largest velocity") {
      ++velocity;
      CHECK(row["ours"].get<double>() == Approx(0.5).margin(1e-6));
      CHECK(row["verdict"] == "agrees");
    }
    if (row["id"] == "fig6.3" && row["quantity"] == "final time after the change") {
      CHECK(row["ours"].get<double>() == Approx(2.442439077777).margin(1e-6)); // derived independently
      CHECK(row["thesis"].is_null());
    }
  }
  CHECK(velocity == 1);
  const Json summary = Json::parse(vpApp::readFile(run.path("out/summary.json")));
  CHECK(summary["verdicts"].size() == 2);
  CHECK(std::filesystem::exists(run.path("out/data/fig6.3-motion.csv")));
  CHECK(std::filesystem::exists(run.path("out/figure/tableA.1-velocity.svg")));
  const std::string page = vpApp::readFile(run.path("out/report.html"));
  CHECK(page.find("Figure 6.3") != std::string::npos);
  CHECK(page.find("Figure 6.4") == std::string::npos);

  REQUIRE(run("--only fig6.3,tableA.1 --out again --jobs 1") == 0);
  CHECK(Json::parse(vpApp::readFile(run.path("again/results.json"))) == rows);
}

TEST_CASE("Help, list, and what is wrong", "[program]")
{
  ProgramRun run(THESIS_REPORT);
  CHECK(run("--help") == 0);
  CHECK(run.out().find("--only") != std::string::npos);
  CHECK(run("--list") == 0);
  CHECK(run.out().find("fig8.13") != std::string::npos);
  const std::vector<std::pair<std::string, std::string>> wrong = {{"--only fig9.9", "--only: there is no fig9.9"},
                                                                  {"--jobs 0", "--jobs is 0"},
                                                                  {"--out ''", "--out is empty"},
                                                                  {"--seed x", "--seed"},
                                                                  {"--frobnicate", "--frobnicate"},
                                                                  {"surplus", "surplus"}};
  for (const auto &bad : wrong) {
    CAPTURE(bad.first);
    CHECK(run(bad.first) == 2);
    CHECK(run.err().find(bad.second) != std::string::npos);
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
  }
  CHECK(run.entries().empty());
  run.write("file", "mine");
  CHECK(run("--only fig6.3 --out file") == 1);
  CHECK(vpApp::readFile(run.path("file")) == "mine");
}
