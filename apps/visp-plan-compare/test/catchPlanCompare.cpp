/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of visp-plan-compare: statistics against published values, the log for Planner Arena.
#include "vpCatch.h"

#include "findings.h"
#include "resultFiles.h"

#include <cmath>
#include <random>
#include <sstream>

using namespace planCompare;
VISP_DIRECT_USING_NAMESPACE

namespace
{
Record record(const std::string &scene, const std::string &method, unsigned int seed, bool success)
{
  Record r;
  r.scene = scene;
  r.method = method;
  r.seed = seed;
  r.lookTimes = {0.001, 0.003};
  r.planTime = 0.01;
  r.metrics.success = success;
  r.metrics.duration_s = seed;
  return r;
}

//! Two methods, (v) and (iii), with given numbers of scenes solved by both, by one of them, by none.
Results counted(Plan &plan, int both, int onlyFirst, int onlySecond, int neither)
{
  plan.methods = {"dtg-via", "planner-dtg"};
  plan.scenes = {{"S2", "random", "Random.", 1, 1}};
  Results results;
  unsigned int seed = 0;
  const auto add = [&](int count, bool first, bool second) {
    for (int i = 0; i < count; ++i) {
      results.records.push_back(record("S2", "dtg-via", ++seed, second));
      results.records.push_back(record("S2", "planner-dtg", seed, first));
    }
  };
  add(both, true, true);
  add(onlyFirst, true, false);
  add(onlySecond, false, true);
  add(neither, false, false);
  return results;
}
} // namespace

TEST_CASE("Wilson's interval is that of Newcombe's table", "[statistics]")
{
  // R. G. Newcombe, Two-sided confidence intervals for the single proportion, Stat. Med. 17 (1998), table I, method 3.
  const struct {
    int successes, total;
    double low, high;
  } table[] = {{81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0.0000, 0.1611}, {1, 29, 0.0061, 0.1718}};
  for (const auto &row : table) {
    const Interval i = wilson(row.successes, row.total);
    CAPTURE(row.successes, row.total);
    CHECK(i.low == Approx(row.low).margin(6e-5));
    CHECK(i.high == Approx(row.high).margin(6e-5));
    const Interval mirrored = wilson(row.total - row.successes, row.total);
    CHECK(mirrored.low == Approx(1. - i.high).margin(1e-12));
  }
  CHECK(wilson(0, 0).low == 0.);
  CHECK(wilson(0, 0).high == 1.);
}

TEST_CASE("McNemar's exact test is a sign test", "[statistics]")
{
  CHECK(mcNemar(0, 0) == 1.);
  CHECK(mcNemar(5, 5) == 1.);
  CHECK(mcNemar(0, 1) == Approx(1.));
  CHECK(mcNemar(0, 5) == Approx(0.0625));                       // 2 / 2^5
  CHECK(mcNemar(1, 9) == Approx(2. * 11. / 1024.));             // 2 (1 + 10) / 2^10
  CHECK(mcNemar(12, 2) == Approx(2. * (1 + 14 + 91) / 16384.)); // 0.01294, as in tables of the sign test
  CHECK(mcNemar(3, 8) == mcNemar(8, 3));
  CHECK(mcNemar(300, 900) < 1e-60); // factorials of 1200 would overflow
}

TEST_CASE("Sentences follow the numbers", "[findings]")
{
  const auto joined = [](const std::vector<std::string> &sentences) {
    std::string text;
    for (const std::string &s : sentences) {
      text += s + "\n";
    }
    return text;
  };
  Plan plan;
  Results results = counted(plan, 80, 12, 2, 6);
  const Pairing p = pairUp(results, "S2", "planner-dtg", "dtg-via");
  CHECK(p.both == 80);
  CHECK(p.onlyFirst == 12);
  CHECK(p.onlySecond == 2);
  CHECK(p.neither == 6);
  std::string text = joined(answerOf(plan, results));
  CAPTURE(text);
  CHECK(text.find(
            "Of 100 runs planner-dtg solves the most, 92 (95 % interval 85.0 to 95.9 %); dtg-via the fewest, 82.") !=
        std::string::npos);
  CHECK(text.find("p = 0.013): planner-dtg does significantly better.") != std::string::npos);
  CHECK(text.find("never touched anything while moving; no other method was compared.") != std::string::npos);
  CHECK(verdictOf(plan, results, "planner-dtg").find("Good for S2, ") == 0);
  CHECK(verdictOf(plan, results, "dtg-via").find("Good for none of these scenes") == 0);

  results = counted(plan, 80, 5, 5, 10);
  CHECK(joined(answerOf(plan, results))
            .find("Of 100 runs dtg-via and planner-dtg solve the most, each 85 (95 % interval 76.7 to 90.7 %).\n") !=
        std::string::npos);
  results = counted(plan, 80, 2, 12, 6); // reversed
  text = joined(answerOf(plan, results));
  CHECK(text.find("p = 0.013): dtg-via does significantly better.") != std::string::npos);
  results = counted(plan, 80, 5, 7, 6);
  CHECK(joined(answerOf(plan, results)).find("no significant difference.") != std::string::npos);
  CHECK(verdictOf(plan, results, "planner-dtg").find("Good for S2, ") == 0);

  for (Record &r : results.records) {
    r.metrics.collisions_moving = r.seed == 3 && r.method == "planner-dtg" ? 1 : 0;
  }
  text = joined(answerOf(plan, results));
  CHECK(text.find("dtg-via never touched anything while moving; all others did.") != std::string::npos);
  CHECK(verdictOf(plan, results, "planner-dtg").find("It touched something while moving in 1 of 98 runs.") !=
        std::string::npos);
  CHECK(verdictOf(plan, results, "planner-dtg").find("Good for none of these scenes") == 0);
}

TEST_CASE("Drives are ideal, or have friction that is compensated on demand only", "[plan]")
{
  Options options;
  options.scenes = {"S4a"};
  const auto drives = [&options] { return makePlan(options).problems.at(0).make().run.drives; };
  CHECK(drives().ideal);
  options.friction = 0.5;
  CHECK_FALSE(drives().ideal);
  CHECK(drives().frictionScale == 0.5);
  CHECK_FALSE(drives().compensateFriction);
  options.compensateFriction = true;
  CHECK(drives().compensateFriction);
}

TEST_CASE("The log is as OMPL's own reader wants it", "[arena]")
{
  Plan plan;
  const Results results = counted(plan, 3, 2, 1, 1);
  std::istringstream log(arenaLog(plan, results, plan.scenes[0], "2024-05-17 08:30:00"));
  std::string line;
  const auto next = [&]() -> const std::string & {
    REQUIRE(std::getline(log, line));
    return line;
  };
  const auto count = [&](const std::string &what) { // "7 runs per planner": the number
    const std::string text = next();
    std::size_t used = 0;
    const int number = static_cast<int>(std::stod(text, &used));
    CHECK(text.substr(used) == what);
    return number;
  };
  CHECK(next() == "OMPL version 1.5.2");
  CHECK(next() == "Experiment visp-plan-compare-S2");
  CHECK(count(" experiment properties") == 0);
  CHECK(next().find("Running on ") == 0);
  CHECK(next() == "Starting at 2024-05-17 08:30:00");
  CHECK(next() == "<<<|");
  while (next() != "|>>>") {
  }
  CHECK(count(" is the random seed") == 1);
  CHECK(count(" seconds per run") == 20);
  CHECK(count(" MB per run") == 0);
  CHECK(count(" runs per planner") == 7);
  CHECK(count(" seconds spent to collect the data") == 0);
  CHECK(count(" enum types") == 0);
  REQUIRE(count(" planners") == 2);
  for (const char *name : {"dtg-via", "planner-dtg"}) {
    CHECK(next() == name);
    CHECK(count(" common properties") == 0);
    const int properties = count(" properties for each run");
    int solved = -1, time = -1;
    for (int i = 0; i < properties; ++i) {
      const std::string property = next(), type = property.substr(property.rfind(' ') + 1);
      CHECK((type == "REAL" || type == "INTEGER" || type == "BOOLEAN"));
      solved = property == "solved BOOLEAN" ? i : solved;
      time = property == "time REAL" ? i : time;
    }
    REQUIRE(solved >= 0);
    REQUIRE(time >= 0);
    int successes = 0;
    const int runs = count(" runs");
    CHECK(runs == 7);
    for (int r = 0; r < runs; ++r) {
      std::vector<double> values;
      std::string text = next();
      for (std::size_t end = text.find("; "); end != std::string::npos; end = text.find("; ")) {
        values.push_back(std::stod(text.substr(0, end)));
        text.erase(0, end + 2);
      }
      CHECK(text.empty());
      REQUIRE(static_cast<int>(values.size()) == properties);
      successes += static_cast<int>(values[static_cast<std::size_t>(solved)]);
      CHECK(values[static_cast<std::size_t>(time)] == Approx(0.014));
    }
    CHECK(successes == (name == std::string("dtg-via") ? 4 : 5));
    CHECK(next() == ".");
  }
  CHECK_FALSE(std::getline(log, line));
}
