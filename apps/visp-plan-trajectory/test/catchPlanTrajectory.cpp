/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Motions against the published values, the answers against the motions, and random problems against their limits.
#include "vpCaseFile.h"

#include "answer.h"
#include "outputFolder.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace
{
using namespace planTrajectory;
using nlohmann::json;

Motion motionOf(const std::string &line) { return execute(readProblem(line, "test:1", 1)); }

json answerOf(const std::string &line)
{
  const Problem problem = readProblem(line, "test:1", 1);
  return json::parse(answerLine(problem, execute(problem)));
}

//! The message with which a line is rejected.
std::string refusalOf(const std::string &line)
{
  try {
    static_cast<void>(motionOf(line));
  }
  catch (const std::exception &error) {
    return error.what();
  }
  return "accepted";
}

//! Derivative of a segment's polynomial, straight from the definition.
double valueOf(const std::vector<double> &c, double t, int derivative)
{
  double sum = 0.;
  for (std::size_t k = static_cast<std::size_t>(derivative); k < c.size(); ++k) {
    double factor = 1.;
    for (int m = 0; m < derivative; ++m) {
      factor *= static_cast<double>(k) - m;
    }
    sum += factor * c[k] * std::pow(t, static_cast<double>(k) - derivative);
  }
  return sum;
}

//! Largest jump of q, v, a from one segment to the next, and at both ends.
double largestJump(const Problem &problem, const Motion &motion)
{
  double jump = 0.;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(problem.axes()); ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    std::array<double, 3> now{problem.input.start.q[k], problem.input.start.v[k], problem.input.start.a[k]};
    for (const vpTrajectoryPiece &piece : motion.pieces) {
      for (int d = 0; d < 3; ++d) {
        jump = std::max(jump, std::abs(valueOf(piece.coefficients[axis], 0., d) - now[static_cast<std::size_t>(d)]));
        now[static_cast<std::size_t>(d)] = valueOf(piece.coefficients[axis], piece.duration, d);
      }
    }
    const Input &last = problem.events.empty() ? problem.input : problem.events.back().input;
    jump = std::max({jump, std::abs(now[0] - last.goal.q[k]), std::abs(now[1] - last.goal.v[k]),
                     std::abs(now[2] - last.goal.a[k])});
  }
  return jump;
}
} // namespace

TEST_CASE("The published motions come out", "[visp-plan-trajectory]")
{
  const Motion fig63 = motionOf(R"({"q0":[0],"q1":[0.5],"v_max":[0.5],"events":[{"t":1.2,"q1":[0.8]}]})");
  CHECK(fig63.duration() == Approx(2.442439077777).margin(1e-9));
  CHECK(fig63.peaks[0].velocity == Approx(0.5).epsilon(1e-12));
  CHECK(fig63.form == vpTrajectoryForm::Direct);
  const vpAxisState atEvent = fig63.at(0, 1.2);
  CHECK(atEvent[0] == Approx(0.3745513472).margin(1e-10));
  CHECK(atEvent[1] == Approx(0.42467328).margin(1e-10));
  CHECK(atEvent[2] == Approx(-0.5505024).margin(1e-10));

  const Motion fig64 =
      motionOf(R"({"q1":0.5,"a_max":1,"duration":1.875,"events":[{"t":1.2,"q1":0.8,"policy":"KeepArrival"}]})");
  CHECK(fig64.duration() == Approx(2.474039801872).margin(1e-9));

  const Motion fig65 = motionOf(
      R"({"q1":0.5,"v_max":0.5,"a_max":10,"duration":1.875,"late":"ExceedLimits","events":[{"t":1.2,"q1":0.8}]})");
  CHECK(fig65.result == vpTrajectoryResult::ArrivalInfeasible);
  CHECK(fig65.duration() == Approx(1.875).margin(1e-12));
  CHECK(fig65.peaks[0].velocity == Approx(1.018928653).margin(1e-9));
  CHECK(fig65.peaks[0].acceleration == Approx(4.321256684).margin(1e-9));

  const Motion printing = motionOf(R"({"q1":48.8889,"v0":4,"v1":4,"duration":9.777778,"v_max":10,"dt":0.1})");
  CHECK(printing.peaks[0].velocity == Approx(5.875).margin(1e-4));
}

TEST_CASE("An answer says what the motion is", "[visp-plan-trajectory]")
{
  const std::string line = R"({"id":"mine","q0":[0,1],"q1":[0.5,0.2],"v_max":0.5,"a_max":[1,2],)"
                           R"("events":[{"t":0.8,"q1":[0.8,0.4]},{"t":1.1,"v_max":[0.4,0.3]}]})";
  const Problem problem = readProblem(line, "test:1", 1);
  const Motion motion = execute(problem);
  const json answer = json::parse(answerLine(problem, motion));
  CHECK(answer["line"] == 1);
  CHECK(answer["id"] == "mine");
  CHECK(answer["duration"] == motion.duration());
  CHECK(answer["plans"].size() == 3);
  CHECK(answer["plans"][1]["t"] == 0.8);
  CHECK(answer["form"] == vpToString(motion.form));
  REQUIRE(answer["segments"].size() == motion.pieces.size());
  CHECK(answer["segments"].front()["t0"] == 0.);
  CHECK(answer["segments"].back()["t1"].get<double>() == Approx(motion.duration()).epsilon(1e-14));
  double v = 0.;
  double a = 0.;
  for (const json &segment : answer["segments"]) {
    const auto c = segment["coefficients"][1].get<std::vector<double>>();
    const double length = segment["t1"].get<double>() - segment["t0"].get<double>();
    for (int k = 0; k <= 2000; ++k) { // dense sampling, the reference for the exact peaks
      v = std::max(v, std::abs(valueOf(c, length * k / 2000., 1)));
      a = std::max(a, std::abs(valueOf(c, length * k / 2000., 2)));
    }
  }
  CHECK(answer["peak_velocity"][1].get<double>() == Approx(v).epsilon(1e-5));
  CHECK(answer["peak_acceleration"][1].get<double>() == Approx(a).epsilon(1e-5));
  CHECK(answer["peak_velocity"][1].get<double>() >= v * (1. - 1e-14));
}

TEST_CASE("Random problems with events: continuous to the end and within the limits", "[visp-plan-trajectory]")
{
  const unsigned int seed = vpTestSupport::seed();
  std::mt19937_64 random = vpTestSupport::generator();
  const auto in = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  double worst = 0.;
  double jump = 0.;
  for (int trial = 0; trial < 400; ++trial) {
    const int axes = 1 + trial % 4;
    json line;
    const auto list = [&](double low, double high) {
      json values = json::array();
      for (int i = 0; i < axes; ++i) {
        values.push_back(in(low, high));
      }
      return values;
    };
    line["q0"] = list(-1., 1.);
    line["q1"] = list(-1., 1.);
    line["v0"] = list(-0.2, 0.2);
    line["v_max"] = list(0.3, 1.);
    line["a_max"] = list(0.5, 3.);
    line["dt"] = in(0.001, 0.05);
    double t = 0.;
    for (int k = trial % 3; k > 0; --k) {
      t += in(0.05, 1.5);
      line["events"].push_back({{"t", t}, {"q1", list(-1., 1.)}});
    }
    CAPTURE(seed, trial, line.dump());
    const Problem problem = readProblem(line.dump(), "test:1", 1);
    const Motion motion = execute(problem);
    CHECK(motion.result == vpTrajectoryResult::Finished);
    for (int i = 0; i < axes; ++i) {
      const vpTrajectoryPeaks &peaks = motion.peaks[static_cast<std::size_t>(i)];
      worst = std::max({worst, peaks.velocity / problem.input.maxVelocity[i] - 1.,
                        peaks.acceleration / problem.input.maxAcceleration[i] - 1.});
    }
    jump = std::max(jump, largestJump(problem, motion));
  }
  CHECK(worst < 1e-11); // coefficients in t - t0 lose a digit
  CHECK(jump < 1e-10);
}

TEST_CASE("After an arrival with velocity the motion coasts until the next event", "[visp-plan-trajectory]")
{
  const std::string line = R"({"q1":1,"v1":0.2,"a1":0.3,"v_max":1,"a_max":2,"events":[{"t":6,"q1":3,"v1":0,"a1":0}]})";
  const Problem problem = readProblem(line, "test:1", 1);
  const Motion motion = execute(problem);
  CHECK(largestJump(problem, motion) < 1e-10);
  CHECK(motion.pieces.back().end == Approx(motion.duration()));
  for (std::size_t i = 1; i < motion.pieces.size(); ++i) {
    CHECK(motion.pieces[i].begin == Approx(motion.pieces[i - 1].end).epsilon(1e-14));
  }
  CHECK(motion.at(0, 5.)[1] > 0.2);
  CHECK(motion.at(0, 5.)[2] == 0.);
}

TEST_CASE("The control cycle does not decide on the motion", "[visp-plan-trajectory]")
{
  const auto line = [](const std::string &dt) {
    return R"({"q1":0.5,"v_max":0.5,"events":[{"t":1.2,"q1":0.8}],"dt":)" + dt + "}";
  };
  const double T = motionOf(line("0.001")).duration();
  for (const char *dt : {"0.007", "0.1", "5"}) {
    CHECK(motionOf(line(dt)).duration() == Approx(T).epsilon(1e-13));
  }
  CHECK(refusalOf(line("1e-9")).find("test:1: the motion of ") == 0);
}

TEST_CASE("Numbers, lists, null", "[visp-plan-trajectory]")
{
  const json scalar = answerOf(R"({"q1":[1,2],"v_max":0.5,"a_max":null,"j_max":[null,4]})");
  const json list = answerOf(R"({"q1":[1,2],"v_max":[0.5,0.5],"j_max":[null,4.0]})");
  CHECK(scalar == list);
  CHECK(answerOf(R"({"q1":1,"v_max":1})")["segments"].size() == 1);
  CHECK(answerOf(R"({"q1":0,"v_max":1})")["form"] == "Hold");
  CHECK(answerOf(R"({"q1":0,"v_max":1})")["duration"] == 0.);
}

TEST_CASE("Samples are those of the motion", "[visp-plan-trajectory]")
{
  const Problem problem = readProblem(R"({"q1":[0.5,-1],"v_max":0.5,"dt":0.3})", "test:1", 1);
  const Motion motion = execute(problem);
  std::istringstream csv(csvOf(problem, motion));
  std::string row;
  std::getline(csv, row);
  CHECK(row == "t,q0,v0,a0,j0,q1,v1,a1,j1");
  int rows = 0;
  double last = 0.;
  while (std::getline(csv, row)) {
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream numbers(row);
    double q = 0.;
    double v = 0.;
    numbers >> last >> q >> v;
    CHECK(q == Approx(motion.at(0, last)[0]).margin(1e-12));
    CHECK(v == Approx(motion.at(0, last)[1]).margin(1e-12));
    ++rows;
  }
  CHECK(last == Approx(motion.duration()).epsilon(1e-14));
  CHECK(rows == static_cast<int>(std::floor(motion.duration() / 0.3)) + 2);
  const Problem fine = readProblem(R"({"q1":1,"v_max":1,"dt":1e-9})", "test:1", 1);
  CHECK_THROWS_WITH(csvOf(fine, execute(fine)), Catch::Contains("test:1: dt is 1e-09 s"));
}

TEST_CASE("Bad lines are refused with axis and value", "[visp-plan-trajectory]")
{
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{\"q1\": [1,", "test:1: column 11: "},
      {"[1]", "test:1: the content is [1], must be an object { }"},
      {R"({"v_max":1})", "test:1: q1 is missing"},
      {R"({"q1":[],"v_max":1})", "test:1: q1 is [], must be a list of at least one number"},
      {R"({"q1":[1,NaN],"v_max":1})", "test:1: column 10: "},
      {R"({"q1":[1,1e999],"v_max":1})", "test:1: "},
      {R"({"q1":[1,"two"],"v_max":1})", "test:1: q1[1] is \"two\", must be a number"},
      {R"({"q1":[1,2],"q0":[1],"v_max":1})", "test:1: q0 has 1 numbers, must have 2, one for each axis"},
      {R"({"q1":[1,null],"v_max":1})", "test:1: q1[1] is null, must be a number"},
      {R"({"q1":1})", "test:1: axis 0 has neither a velocity nor an acceleration limit"},
      {R"({"q1":[1,2],"v_max":[1,-3]})", "test:1: velocity limit of axis 1 is -3, must be > 0"},
      {R"({"q1":[1,2],"v_max":1,"a_max":[0,1]})", "test:1: acceleration limit of axis 0 is 0, must be > 0"},
      {R"({"q1":[1,2],"v_max":1,"j_max":[1,0]})", "test:1: jerk limit of axis 1 is 0, must be > 0"},
      {R"({"q1":1,"v1":2,"v_max":1})", "test:1: goal velocity of axis 0 is 2, above its velocity limit"},
      {R"({"q1":1,"v_max":1,"via":[{"tau":1.5,"q":0}]})", "test:1: tau of via 0 is 1.5, must be in (0, 1)"},
      {R"({"q1":1,"v_max":1,"via":[{"tau":0.6,"q":0},{"tau":0.4,"q":1}]})",
       "test:1: tau of via 1 is 0.4, must be above"},
      {R"({"q1":1,"v_max":1,"via":[{"tau":0.6}]})", "test:1: via[0].q is missing"},
      {R"({"q1":1,"v_max":1,"via":[{"tau":0.6,"q":0,"a":1}]})", "test:1: via[0]: has an acceleration"},
      {R"({"q1":1,"v_max":1,"policy":"Fast"})", "test:1: policy is \"Fast\", must be one of EventMinTime, "},
      {R"({"q1":1,"v_max":1,"duration":-1})", "test:1: arrival time is -1 s, must be > 0"},
      {R"({"q1":1,"v_max":1,"dt":0})", "test:1: dt is 0, must be > 0"},
      {R"({"q1":1,"v_max":1,"cruise":1})", "test:1: cruise is 1, must be true or false"},
      {R"({"q1":1,"v_max":1,"vmax":1})", "test:1: unknown field vmax; known are "},
      {R"({"q1":1,"v_max":1,"v_max":2})", "test:1: field \"v_max\" is given twice"},
      {R"({"q1":1,"v_max":1,"events":[{"t":1,"q1":2},{"t":1,"q1":3}]})", "test:1: events[1].t is 1, must be above 1.0"},
      {R"({"q1":1,"v_max":1,"events":[{"t":1,"v_max":-2}]})",
       "test:1: event 0 (t = 1 s): velocity limit of axis 0 is -2, must be > 0"},
      {R"({"q1":1,"v_max":1,"events":[{"t":1,"q0":2}]})", "test:1: unknown field events[0].q0"},
      {R"({"q1":1,"v_max":1,"groups":[{"axes":[0,3],"v_max":1}]})", "test:1: axis group 0 names axis 3"},
      {R"({"q1":1,"v_max":1,"groups":[{"axes":[-1],"v_max":1}]})", "test:1: groups[0].axes is [-1], must be"},
      {R"({"q1":1,"v_max":1,"method":"ThesisIteration","thesis_steps_per_cycle":0})", "test:1: steps per cycle"},
  };
  for (const auto &bad : cases) {
    CAPTURE(bad.first);
    CHECK_THAT(refusalOf(bad.first), Catch::StartsWith(bad.second));
  }
}

TEST_CASE("The example files are answered, and the data of their report is the motion", "[visp-plan-trajectory]")
{
  for (const char *name : {"figure-6.3.jsonl", "examples.jsonl"}) {
    std::istringstream file(vpApp::readFile(std::string(VISP_DIRECT_DATA_DIR) + "/trajectory/" + name));
    std::size_t line = 0;
    for (std::string text; std::getline(file, text);) {
      ++line;
      CAPTURE(name, line, text);
      const Problem problem = readProblem(text, name, line);
      const Motion motion = execute(problem);
      // The thesis's iteration does not guarantee the limits, which is reported.
      const bool exact = problem.input.spec.method == vpDurationMethod::Exact;
      CHECK((!exact || motion.result != vpTrajectoryResult::NoFeasibleDuration));
      CHECK(motion.duration() > 0.);
      const nlohmann::ordered_json data = dataOf(problem, motion);
      for (const auto &segment : data.at("segments")) { // at its middle
        const double t = 0.5 * segment.at("duration_s").get<double>();
        for (int axis = 0; axis < problem.axes(); ++axis) {
          const auto c = segment.at("coefficients").at(static_cast<std::size_t>(axis)).get<std::vector<double>>();
          double q = 0.;
          for (std::size_t i = c.size(); i-- > 0;) {
            q = q * t + c[i];
          }
          CHECK(q == Approx(motion.at(axis, segment.at("t0_s").get<double>() + t)[0]).margin(1e-9));
        }
      }
      CHECK(data.at("inputs").size() == problem.events.size() + 1);
      CHECK(data.at("former").size() + 1 == motion.plans.size());
    }
    CHECK(line > 0);
  }
}

namespace
{
//! Lines of a file with problems from public reports; none where the file is missing, and the test is then skipped.
std::vector<std::string> publicProblems(const std::string &name)
{
  std::vector<std::string> lines;
  std::ifstream file(vpTestSupport::caseFile("trajectory/" + name));
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
  }
  return lines;
}
} // namespace

TEST_CASE("Public problems: every line is refused or reports its excess, and all numbers are finite",
          "[visp-plan-trajectory]")
{
  for (const char *name : {"limit-broken.jsonl", "limit-sweep.jsonl", "not-finite.jsonl", "public.jsonl"}) {
    std::size_t number = 0;
    for (const std::string &text : publicProblems(name)) {
      ++number;
      CAPTURE(name, number, text);
      if (text.find_first_not_of(" \r\t") == std::string::npos) {
        continue;
      }
      Problem problem;
      Motion motion;
      try {
        problem = readProblem(text, name, number);
        motion = execute(problem);
      }
      catch (const std::runtime_error &error) {
        CHECK(std::string(error.what()).find(name) == 0); // rejected with a message
        continue;
      }
      const std::string answer = answerLine(problem, motion);
      CHECK(answer.find("null") == std::string::npos);
      if (motion.excess.limit == vpTrajectoryLimit::None && problem.events.empty()) {
        for (int i = 0; i < problem.axes(); ++i) {
          const vpTrajectoryPeaks &peaks = motion.peaks[static_cast<std::size_t>(i)];
          const double place = std::max(std::abs(problem.input.start.q[i]), std::abs(problem.input.goal.q[i]));
          CHECK(peaks.velocity <= problem.input.maxVelocity[i] * (1. + 1e-9));
          CHECK(peaks.acceleration <= problem.input.maxAcceleration[i] * (1. + 1e-9));
          // A goal within the tolerance beyond its limit counts as on it.
          CHECK(peaks.maxPosition <= std::max(problem.input.maxPosition[i], problem.input.goal.q[i]) + 1e-9 * place);
          CHECK(peaks.minPosition >= std::min(problem.input.minPosition[i], problem.input.goal.q[i]) - 1e-9 * place);
        }
      }
    }
  }
}
