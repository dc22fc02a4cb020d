/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program as run by users, also with --explore on one process: exit status, messages, and consistency of its results with its tables.
#include "vpCatch.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace
{
using nlohmann::json;

constexpr int OK = 0, DATA = 1, USAGE = 2;

//! Columns of a table by name.
std::map<std::string, std::vector<double>> columnsOf(const std::string &csv)
{
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::string> names;
  std::istringstream stream(csv);
  std::string line, field;
  std::getline(stream, line);
  for (std::istringstream heading(line); std::getline(heading, field, ',');) {
    names.push_back(field);
  }
  while (std::getline(stream, line)) {
    std::istringstream fields(line);
    for (const std::string &name : names) {
      std::getline(fields, field, ',');
      columns[name].push_back(std::stod(field));
    }
  }
  return columns;
}

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

TEST_CASE("The summary follows from the tables", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  const std::string arguments =
      GENERATE(std::string("--sensor tracker --cells 60 --jitter 0.3 --flex 2"),
               std::string("--sensor thesis --controller pid-ff --cells 40 --axis xy --rows 2 --dropped 0.01"),
               std::string("--cells 15 --reference constant"));
  CAPTURE(arguments);
  REQUIRE(run(arguments + " --no-thesis --out d") == OK);
  const json summary = json::parse(vpApp::readFile(run.path("d/summary.json")));
  auto drops = columnsOf(vpApp::readFile(run.path("d/drops.csv")));
  auto motion = columnsOf(vpApp::readFile(run.path("d/motion.csv")));
  // Landing errors.
  std::vector<double> errors;
  std::map<std::pair<double, double>, int> count;
  for (std::size_t i = 0; i < drops["row"].size(); ++i) {
    errors.push_back(std::hypot(drops["error_x_um"][i], drops["error_y_um"][i]));
    ++count[{drops["row"][i], drops["column"][i]}];
  }
  std::sort(errors.begin(), errors.end());
  REQUIRE(!errors.empty());
  CHECK(summary["landing_error_um"]["max"].get<double>() == Approx(errors.back()).epsilon(1e-6));
  const double median = 0.5 * (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]);
  CHECK(summary["landing_error_um"]["p50"].get<double>() == Approx(median).epsilon(1e-6));
  CHECK(summary["printed"] == count.size());
  const auto twice = std::count_if(count.begin(), count.end(), [](const auto &cell) { return cell.second > 1; });
  CHECK(summary["doubled"] == twice);
  const auto cells = summary["spec"]["rows"].get<std::size_t>() * summary["spec"]["cells_per_row"].get<std::size_t>();
  CHECK(summary["complete"] == true);
  CHECK(summary["printed"].get<std::size_t>() + summary["missed"].get<std::size_t>() == cells);
  // Velocity error as measured, against the reference of the step before.
  double sum = 0.;
  std::size_t n = 0;
  for (std::size_t i = 60; i < motion["frame"].size(); ++i, ++n) {
    sum += std::pow(motion["measured_vx"][i] - motion["reference_vx"][i - 1], 2);
  }
  CHECK(summary["rms_velocity_error"].get<double>() == Approx(std::sqrt(sum / static_cast<double>(n))).epsilon(1e-6));
  // Throughput.
  const double time = *std::max_element(drops["land_frame"].begin(), drops["land_frame"].end()) -
                      *std::min_element(drops["land_frame"].begin(), drops["land_frame"].end());
  CHECK(summary["throughput_cells_per_s"].get<double>() ==
        Approx((static_cast<double>(errors.size()) - 1.) / time * 1600.).epsilon(1e-6));
  for (const json &file : summary["files"]) {
    CHECK(std::filesystem::exists(run.path("d/" + file.get<std::string>())));
  }
  CHECK(run.out().find("cells printed, ") != std::string::npos);
  const int within = static_cast<int>(std::count_if(errors.begin(), errors.end(), [](double e) { return e <= 10.; }));
  CHECK(run.out().find("; " + std::to_string(within) + " of " + std::to_string(errors.size()) +
                       " are within the tolerance of 10 um.\n") != std::string::npos);
  CHECK(run.out().find(" drops fall.\nReport: " + run.path("d/report.html").string() + "\n") != std::string::npos);
  std::string said;
  for (const json &sentence : summary["findings"]) {
    said += sentence.get<std::string>() + "\n";
  }
  CHECK(run.out().find(said) == 0);
}

TEST_CASE("Through rendered pictures every cell gets one drop, within the tolerance", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  REQUIRE(run("--no-thesis --axis xy --rows 2 --cells 12 --flex 1.5 --jitter 0.2 --defects --out d") == OK);
  const json summary = json::parse(vpApp::readFile(run.path("d/summary.json")));
  CHECK(summary["printed"] == 24);
  CHECK(summary["missed"] == 0);
  CHECK(summary["doubled"] == 0);
  CHECK(summary["landed_within_10um"] == 1.);
  CHECK(!cv::imread(run.path("d/product.png").string()).empty());
}

TEST_CASE("Friction that the camera identified serves as well as the known one", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  const std::string seed = GENERATE(std::string("1"), std::string("2"), std::string("3"));
  REQUIRE(run("--no-thesis --sensor tracker --identify --seed " + seed + " --out d") == OK);
  const json summary = json::parse(vpApp::readFile(run.path("d/summary.json")));
  const json &found = summary["identification"];
  CAPTURE(found.dump());
  for (const char *name : {"mass", "viscous", "coulomb"}) {
    CHECK(found[name]["found"].get<double>() == Approx(found[name]["true"].get<double>()).epsilon(0.1));
    CHECK(found[name]["sigma"].get<double>() < 0.1 * found[name]["true"].get<double>());
  }
  CHECK(summary["centre_velocity_error"].get<double>() < 0.03);
  CHECK(summary["missed"] == 0);
}

TEST_CASE("Rows that are bent and off their regular place are hit in the middle", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  REQUIRE(run("--no-thesis --sensor tracker --axis xy --rows 4 --cells 25 --flex 2 --out d") == OK);
  const json summary = json::parse(vpApp::readFile(run.path("d/summary.json")));
  CHECK(summary["printed"] == 100);
  // The rows are off by 2 px = 9 um.
  CHECK(summary["landing_error_um"]["max"].get<double>() < 1.5);
}

TEST_CASE("The reference between the centres is faster than constant velocity", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  REQUIRE(run("--no-thesis --sensor tracker --out centres") == OK);
  REQUIRE(run("--no-thesis --sensor tracker --reference constant --out constant") == OK);
  const json centres = json::parse(vpApp::readFile(run.path("centres/summary.json")));
  const json constant = json::parse(vpApp::readFile(run.path("constant/summary.json")));
  CHECK(centres["gain_over_constant"].get<double>() == Approx(0.25).margin(0.02));
  CHECK(std::abs(constant["gain_over_constant"].get<double>()) < 0.01);
  CHECK(centres["throughput_cells_per_s"].get<double>() > 1.2 * constant["throughput_cells_per_s"].get<double>());
}

TEST_CASE("The experiments of the thesis come out within a tenth", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  REQUIRE(run("--sensor tracker --cells 5 --out d") == OK);
  const json summary = json::parse(vpApp::readFile(run.path("d/summary.json")));
  std::map<std::string, json> figures;
  for (const json &replica : summary["thesis"]) {
    figures[replica["figure"].get<std::string>()] = replica;
  }
  for (const std::string figure : {"7.13", "7.14", "7.15"}) {
    REQUIRE(figures.count(figure) == 1);
    CHECK(figures[figure]["ratio"].get<double>() == Approx(1.).margin(0.1));
    CHECK(figures[figure]["seeds"] == 8);
  }
  for (const json &replica : summary["thesis"]) { // the drawn run is the first of them
    auto motion = columnsOf(vpApp::readFile(run.path("d/" + replica["file"].get<std::string>())));
    CHECK(motion["measured_vx"].size() > replica["evaluate_from_frame"].get<std::size_t>());
  }
  // (7.10): the mismatch grows with the cube of the distance, 1 % at 200 px is 2 px.
  auto distortion = columnsOf(vpApp::readFile(run.path("d/thesis/figure-7.10.csv")));
  CHECK(distortion["mismatch_1_px"].back() == Approx(2.));
  CHECK(distortion["mismatch_1_px"][25] == Approx(0.25));
  CHECK(!cv::imread(run.path("d/thesis/figure-7.11.png").string()).empty());
}

TEST_CASE("Algorithm 7.5 misses or doubles cells, the horizon does not", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  const std::string task = "--no-thesis --sensor thesis --cells 200 --runs 4 ";
  REQUIRE(run(task + "--trigger thesis --out thesis") == OK);
  REQUIRE(run(task + "--out horizon") == OK);
  const json thesis = json::parse(vpApp::readFile(run.path("thesis/summary.json")));
  const json horizon = json::parse(vpApp::readFile(run.path("horizon/summary.json")));
  CHECK(thesis["missed"].get<int>() + thesis["doubled"].get<int>() > 0);
  CHECK(horizon["missed"] == 0);
  CHECK(horizon["doubled"] == 0);
  CHECK(horizon["printed"] == 800);
}

TEST_CASE("The same command gives the same result, another seed another", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  const std::string task = "--no-thesis --sensor thesis --cells 10 --runs 3 ";
  REQUIRE(run(task + "--jobs 1 --out a") == OK);
  REQUIRE(run(task + "--jobs 3 --out b") == OK);
  REQUIRE(run(task + "--seed 2 --out c") == OK);
  CHECK(vpApp::readFile(run.path("a/drops.csv")) == vpApp::readFile(run.path("b/drops.csv")));
  CHECK(vpApp::readFile(run.path("a/drops.csv")) != vpApp::readFile(run.path("c/drops.csv")));
}

TEST_CASE("A wrong command line ends with one sentence", "[visp-print-pattern]")
{
  ProgramRun run(PRINT_PATTERN);
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"--controller lqr", "--controller is lqr, must be observer, pid or pid-ff"},
      {"--sensor eye", "--sensor is eye, must be image, tracker or thesis"},
      {"--reference best", "--reference is best, must be centres, arrival, limited or constant"},
      {"--trigger later", "--trigger is later, must be horizon or thesis"},
      {"--axis z", "--axis is z, must be x or xy"},
      {"--rows 3", "--rows is 3, more than one row needs --axis xy"},
      {"--runs 0", "--runs is 0, must be a whole number from 1 to 10000"},
      {"--cells 0", "--cells is 0, must be a whole number from 1 to 10000"},
      {"--flex 30", "flex"},
      {"--drop-velocity -5", "--drop-velocity is -5, must be a number > 0"},
      {"--drop-velocity 40",
       "--drop-velocity is 40 px/frame, must be below 24.4, half the pitch of the cells: from image to image a larger "
       "motion looks like a smaller one"},
      {"--drop-velocity 5 --mean-velocity 30", "--mean-velocity is 30 px/frame, must be below 24.4"},
      {"--reference limited --max-velocity 24.5", "--max-velocity is 24.5 px/frame, must be below 24.4"},
      {"--vision-delay 9", "--vision-delay is 9, must be a number >= 0 and <= 8"},
      {"--travel-time -1", "--travel-time is -1, must be a number >= 0"},
      {"--filter 0.5 4", "beta"},
      {"--dropped 0.9", "dropped"},
      {"--out ''", "--out is given without a value"},
      {"--colour red", "--colour"},
  };
  for (const auto &[arguments, sentence] : wrong) {
    CAPTURE(arguments);
    CHECK(run(arguments) == USAGE);
    CAPTURE(run.err());
    CHECK(run.err().find(sentence) != std::string::npos);
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') <= 2);
    CHECK(run.entries().empty());
  }
  CHECK(run("--help") == OK);
  CHECK(run.out().find("Examples:") != std::string::npos);
  CHECK(run("--version") == OK);
}

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
  CHECK(vpApp::readFile(run.path("d/explore.csv")).find("do not fit into the 111.1 us of a frame") !=
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
