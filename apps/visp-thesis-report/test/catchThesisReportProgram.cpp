/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-thesis-report as run by users.
#include "programRun.h"

#include "vpCatch.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <map>
#include <thread>

using Json = nlohmann::json;

namespace
{
//! Pages are tested in python/test.
const int withoutReport = setenv("VISP_DIRECT_PYTHON", "/bin/false", 1);

//! What is no agreement has a reason, and a run or test that shows it.
bool isExplained(const Json &row)
{
  const bool owed = row["verdict"] != "agrees" && !row["thesis"].is_null();
  const auto reason = row["reason"].get<std::string>();
  return !owed || (!reason.empty() && reason != "Not explained." && !row["support"].get<std::string>().empty());
}
double valueOf(const Json &rows, const std::string &id, const std::string &quantity)
{
  for (const Json &row : rows) {
    if (row["id"] == id && row["quantity"] == quantity) {
      return row["ours"].get<double>();
    }
  }
  FAIL("there is no row " << quantity << " of " << id);
  return 0.;
}

//! Keeps every core busy while it lives.
class BusyCores
{
public:
  BusyCores()
  {
    for (unsigned int i = 0; i < 2 * std::max(1u, std::thread::hardware_concurrency()); ++i) {
      m_threads.emplace_back([this] {
        while (!m_stop) {
        }
      });
    }
  }
  BusyCores(const BusyCores &) = delete;
  BusyCores &operator=(const BusyCores &) = delete;
  ~BusyCores()
  {
    m_stop = true;
    for (std::thread &thread : m_threads) {
      thread.join();
    }
  }

private:
  std::atomic<bool> m_stop{false};
  std::vector<std::thread> m_threads;
};

//! Verdict of each row, by id and name.
std::map<std::string, std::string> verdictsIn(const std::string &file)
{
  std::map<std::string, std::string> verdicts;
  for (const Json &row : Json::parse(vpApp::readFile(file))) {
    verdicts[row["id"].get<std::string>() + ": " + row["quantity"].get<std::string>()] = row["verdict"];
  }
  return verdicts;
}
} // namespace

TEST_CASE("Times are compared: the verdicts are the same beside busy programs", "[program]")
{
  ProgramRun run(THESIS_REPORT);
  const std::string timed = "--only eq7.2,table7.1,table7.3 --seeds 1 --jobs 1 --out ";
  REQUIRE(run(timed + "alone") == 0);
  {
    const BusyCores load;
    REQUIRE(run(timed + "beside") == 0);
  }
  const auto alone = verdictsIn(run.path("alone/results.json"));
  CHECK(alone.size() > 15);
  CHECK(verdictsIn(run.path("beside/results.json")) == alone);
}

TEST_CASE("Two figures: rows, data, and nothing else", "[program]")
{
  ProgramRun run(THESIS_REPORT);
  REQUIRE(run("--only fig6.3,tableA.1,fig6.3 --out out --jobs 2") == 0);
  CHECK(run.out().find("rows\n") != std::string::npos);
  const Json rows = Json::parse(vpApp::readFile(run.path("out/results.json")));
  int velocity = 0;
  for (const Json &row : rows) {
    CHECK((row["id"] == "fig6.3" || row["id"] == "tableA.1"));
    CHECK(isExplained(row));
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
  const std::string curves = vpApp::readFile(run.path("out/curves.csv"));
  CHECK(curves.find("\nfig6.3,motion,3,0,") != std::string::npos);
  CHECK(curves.find("\ntableA.1,velocity,0,2,") != std::string::npos);

  REQUIRE(run("--only fig6.3,tableA.1 --out again --jobs 1") == 0);
  CHECK(Json::parse(vpApp::readFile(run.path("again/results.json"))) == rows);
}

TEST_CASE("The constants of (6.10), and where (5.31) holds", "[program]")
{
  ProgramRun run(THESIS_REPORT);
  REQUIRE(run("--only eq6.10,eq5.31 --out out --jobs 2") == 0);
  const Json rows = Json::parse(vpApp::readFile(run.path("out/results.json")));
  CHECK(std::all_of(rows.begin(), rows.end(), isExplained));
  CHECK(valueOf(rows, "eq6.10", "v_8") == Approx(35. / 18.).epsilon(1e-6));
  const double alpha = valueOf(rows, "eq6.10", "alpha_8, way of 1");
  CHECK(valueOf(rows, "eq6.10", "alpha_8, way of 2") == Approx(alpha / std::sqrt(2.)).epsilon(1e-6));
  CHECK(valueOf(rows, "eq6.10", "largest acceleration over the limit by (6.10), way of 0.3 rad") ==
        Approx(alpha * alpha / (0.3 * 2.6925 * 2.6925)).epsilon(1e-6));
  CHECK(valueOf(rows, "eq5.31", "least margin, bearing up to 84 deg and rotation up to 179 deg") < 0.);
  CHECK(valueOf(rows, "eq5.31", "share of the starts without a positive margin that arrive") < 1.);
  CHECK(valueOf(rows, "eq5.31", "the same, of those whose object stays in front of the camera") == 1.);
}

TEST_CASE("Chapter 7 up to figure 7.11: what is arithmetic, and what follows from it", "[program]")
{
  ProgramRun run(THESIS_REPORT);
  REQUIRE(run("--only fig7.3,table7.3,fig7.10,table7.4 --seeds 1 --out out --jobs 2") == 0);
  const Json rows = Json::parse(vpApp::readFile(run.path("out/results.json")));
  for (const Json &row : rows) {
    CAPTURE(row.dump());
    CHECK(isExplained(row));
  }
  // kappa1 of table 7.4 at 80 px of 4.5 um, by hand: 3.84e-10 * 360^3 um.
  CHECK(valueOf(rows, "fig7.10", "mismatch of the thesis's lens at 80 px") == Approx(0.01791590).epsilon(1e-5));
  CHECK(valueOf(rows, "fig7.10", "mismatch of 0.1 % distortion at 200 px") == Approx(0.2));
  CHECK(valueOf(rows, "fig7.3", "highest velocity at which a drop released at the centre lands within 10 um") ==
        Approx(10e-6 / 0.2e-3 / (4.5e-6 * 1600.)));
  CHECK(valueOf(rows, "fig7.3", "time of a row of 480 cells") == Approx(2.933333).epsilon(1e-6));
  // The delay is the thesis's exposure and readout plus the time measured in the same run.
  CHECK(valueOf(rows, "table7.3", "start-to-end delay") ==
        Approx(550. + valueOf(rows, "table7.3", "visual processing")));
  CHECK(valueOf(rows, "table7.4", "kappa1, product, edges at half height") == Approx(-6.72e-10).epsilon(0.1));
  CHECK(valueOf(rows, "table7.4", "kappa1, industrial grid, edges at half height") == Approx(-3.84e-10).epsilon(0.1));
  CHECK(valueOf(rows, "table7.4", "magnification, product, Algorithm 7.4") == Approx(4.26).epsilon(0.002));

  CHECK(valueOf(rows, "table7.4", "pixel by the calibration of the thesis, industrial grid") == 4.03); // not 4.5

  REQUIRE(run("--only table7.4 --seeds 1 --out again --jobs 1") == 0); // except for times, parallel jobs change nothing
  const Json again = Json::parse(vpApp::readFile(run.path("again/results.json")));
  REQUIRE_FALSE(again.empty());
  CHECK(std::all_of(again.begin(), again.end(),
                    [&](const Json &row) { return std::find(rows.begin(), rows.end(), row) != rows.end(); }));
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
                                                                  {"--out ''", "--out is given without a value"},
                                                                  {"--seed x", "--seed"},
                                                                  {"--seeds 0", "--seeds is 0"},
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
