/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A complete run of the program: presence and correctness of all result files.
#include "vpCatch.h"

#include "jsonReader.h"
#include "programRun.h"

#include <cmath>
#include <map>
#include <sstream>

namespace
{
const bool s_quick = withoutReports();

//! Rows of a CSV file with a header, as numbers; words become NaN.
std::map<std::string, std::vector<double>> readCsv(const std::filesystem::path &file)
{
  std::istringstream text(vpApp::readFile(file));
  std::string line, field;
  std::getline(text, line);
  std::vector<std::string> names;
  for (std::istringstream fields(line); std::getline(fields, field, ',');) {
    names.push_back(field);
  }
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(text, line)) {
    std::istringstream fields(line);
    std::size_t i = 0;
    for (; std::getline(fields, field, ','); ++i) {
      char *end = nullptr;
      const double value = std::strtod(field.c_str(), &end);
      columns[names.at(i)].push_back(*end == '\0' ? value : NAN);
    }
    REQUIRE(i == names.size());
  }
  return columns;
}
} // namespace

TEST_CASE("A small comparison leaves a whole result", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  const int status = run("--law pbvs1,ff-lookat-pi --plant A --measure points --out new/result", WITH_REPORT);
  CAPTURE(run.err());
  REQUIRE(status == 0);
  const std::string place = "Report: " + run.path("new/result/report.html").string() + "\n";
  REQUIRE(run.out().find(place) + place.size() == run.out().size());
  CHECK(run.out().find("ff-lookat-pi") < run.out().find(place)); // the answer of the report
  CHECK(run.out().find("Answer:") == std::string::npos);
  CHECK(run.err().find('\r') == std::string::npos); // no progress bar outside a terminal

  const nlohmann::json summary = vpApp::readJsonFile(run.path("new/result/summary.json"));
  CHECK(summary["program"] == "visp-servo-compare");
  CHECK(summary["command_line"] ==
        "visp-servo-compare --law pbvs1,ff-lookat-pi --plant A --measure points --out new/result");
  CHECK(summary["wall_time_s"].get<double>() > 0.);
  REQUIRE(summary["runs"].size() == 2);
  for (const nlohmann::json &item : summary["runs"]) {
    CAPTURE(item);
    for (const char *field : {"max_image_error_px", "rms_image_error_px", "end_rotation_deg", "end_translation_mm",
                              "expected_end_rotation_deg", "expected_end_translation_mm", "left_end_rotation_deg",
                              "left_end_translation_mm", "yaw_range_deg", "ideal_yaw_range_deg", "out_of_view_s",
                              "settle_s", "path_length_m", "peak_linear_mps", "peak_angular_radps",
                              "peak_linear_acceleration_mps2", "peak_angular_acceleration_radps2", "deadlock_cycles"}) {
      CAPTURE(field);
      REQUIRE(item[field].is_number());
      CHECK(std::isfinite(item[field].get<double>()));
      CHECK(item[field].get<double>() >= 0.);
    }
    CHECK(item["plant"] == "A");
    CHECK(item["measure"] == "points");
    CHECK(item["seed"] == 1);
    CHECK(item["shaped"] == false);
    CHECK(item["status"] == "ok");
    CHECK(item["ideal_yaw_range_deg"].get<double>() == Approx(56.79).margin(0.01));
    CHECK(item["end_rotation_deg"].get<double>() < 0.2);
    CHECK(item["gains"]["lambda"] == 1.);
    CHECK(item["plant_parameters"]["max_linear_mps"] == 1.);

    // The log agrees with the summary.
    auto log = readCsv(run.path("new/result/" + item["log"].get<std::string>()));
    REQUIRE(log["time_s"].size() == 2400);
    double largest = 0.;
    for (std::size_t i = 0; i < log["time_s"].size(); ++i) {
      largest = std::max(largest, std::hypot(log["image_error_u_px"][i], log["image_error_v_px"][i]));
      REQUIRE(
          std::isfinite(log["tx_m"][i] + log["tuy_rad"][i] + log["actual_wy_radps"][i] + log["reference_yaw_rad"][i]));
    }
    CHECK(largest == Approx(item["max_image_error_px"].get<double>()).epsilon(1e-5));
  }
  for (const nlohmann::json &file : summary["files"]) {
    CAPTURE(file);
    CHECK(std::filesystem::file_size(run.path("new/result/" + file.get<std::string>())) > 0);
  }

  CHECK(std::filesystem::exists(run.path("new/result/report.html")));
  CHECK(vpApp::readFile(run.path("new/result/film-strip.jpg")).rfind("\xff\xd8\xff", 0) == 0);
  CHECK(summary["film_strip"]["laws"] == nlohmann::json({"pbvs1", "ff-lookat-pi"}));
  REQUIRE(summary["videos"].size() == 2);
  CHECK(summary["videos"][1]["file"] == "video/ff-lookat-pi-A.mp4");
  CHECK(summary["videos"][1]["speed_up"] == 3.);

  // Again into the same folder: replaced, and the user's file is kept.
  run.write("new/result/notes.txt", "mine");
  REQUIRE(run("--law pbvs1 --plant A --measure points --out new/result") == 0);
  CHECK(vpApp::readJsonFile(run.path("new/result/summary.json"))["runs"].size() == 1);
  CHECK(std::filesystem::exists(run.path("new/result/notes.txt")));
  CHECK_FALSE(std::filesystem::exists(run.path("new/result/video/ff-lookat-pi-A.mp4")));
  CHECK(run.entries() == std::vector<std::string>{"new"});
}

TEST_CASE("Several seeds and a task of one's own", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  run.write("task.json", R"({
  "name": "a <b> & c",
  "camera": {"px": 400, "py": 400, "u0": 159.5, "v0": 119.5, "width": 320, "height": 240},
  "object": {"width_m": 0.15, "height_m": 0.1},
  "start": {"position_m": [0.05, 0, 0.5], "rotation_deg": [0, 0, 0]},
  "segments": [{"name": "near, \"left\"", "position_m": [0, 0, 0.4], "rotation_deg": [0, -15, 10], "duration_s": 1.5}],
  "plants": [{"name": "slow one", "like": "B", "vision_rate_hz": 20}]
})");
  const int status =
      run("--task task.json --law ibvs,pbvs1+cbf --monte-carlo 3 --seed 7 --measure points --jobs 2 --out result");
  CAPTURE(run.err());
  REQUIRE(status == 0);
  const nlohmann::json summary = vpApp::readJsonFile(run.path("result/summary.json"));
  REQUIRE(summary["runs"].size() == 6);
  std::map<std::string, std::vector<int>> seeds;
  for (const nlohmann::json &item : summary["runs"]) {
    CHECK(item["plant"] == "slow one");
    seeds[item["law"]].push_back(item["seed"]);
    CHECK(item.contains("log") == (item["seed"] == 7));
  }
  CHECK(seeds["ibvs"] == std::vector<int>{7, 8, 9});
  CHECK(seeds["pbvs1+cbf"] == std::vector<int>{7, 8, 9});
  // Noise differs from seed to seed, and depends only on the seed.
  CHECK(summary["runs"][0]["rms_image_error_px"] != summary["runs"][1]["rms_image_error_px"]);
  REQUIRE(run("--task task.json --law ibvs --seed 8 --measure points --jobs 1 --out again") == 0);
  nlohmann::json again = vpApp::readJsonFile(run.path("again/summary.json"))["runs"][0];
  CHECK(again["rms_image_error_px"] == summary["runs"][1]["rms_image_error_px"]);

  CHECK(summary["task"]["name"] == "a <b> & c");
  CHECK(summary["repetitions"] == 3);
  CHECK(summary["seed"] == 7);
}

TEST_CASE("Shaped runs stand beside the raw ones", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  run.write("task.json", R"({
  "camera": {"px": 800, "py": 800, "u0": 320, "v0": 240},
  "object": {"width_m": 0.18, "height_m": 0.18},
  "start": {"position_m": [0, 0, 0.5], "rotation_deg": [0, 0, 0]},
  "segments": [{"position_m": [0.02, 0, 0.4], "rotation_deg": [0, -20, 0], "duration_s": 2},
               {"position_m": [0, 0, 0.5], "rotation_deg": [0, 0, 0], "duration_s": 2}],
  "shape": {"linear_acceleration_mps2": 0.8, "linear_jerk_mps3": 5, "angular_jerk_radps3": 30},
  "plants": [{"name": "P"}]
})");
  const std::string arguments = "--task task.json --law pbvs1,ff-lookat+cbf --measure points ";
  const int status = run(arguments + "--shape --out result");
  CAPTURE(run.err());
  REQUIRE(status == 0);
  const nlohmann::json runs = vpApp::readJsonFile(run.path("result/summary.json"))["runs"];
  REQUIRE(runs.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const nlohmann::json &item = runs[i];
    CAPTURE(item);
    const bool shaped = i % 2 == 1;
    CHECK(item["law"] == (i < 2 ? "pbvs1" : "ff-lookat+cbf"));
    CHECK(item["shaped"] == shaped);
    CHECK(item.contains("shape") == shaped);
    if (shaped) {
      CHECK(item["shape"]["linear_acceleration_mps2"] == 0.8);
      CHECK(item["shape"]["linear_jerk_mps3"] == 5.);
      CHECK(item["shape"]["angular_acceleration_radps2"] == 2.5);
      CHECK(item["shape"]["angular_jerk_radps3"] == 30.);
    }
    CHECK((item["peak_linear_acceleration_mps2"] <= 0.8 * (1. + 1e-9)) == shaped);
    CHECK((item["peak_angular_acceleration_radps2"] <= 2.5 * (1. + 1e-9)) == shaped);

    // The log holds the commands to the robot with 7 digits.
    auto log = readCsv(run.path("result/" + item["log"].get<std::string>()));
    REQUIRE(log["time_s"].size() == 400);
    double peak = 0., before[3] = {0., 0., 0.};
    for (std::size_t k = 0; k < 400; ++k) {
      double sum = 0.;
      for (int axis = 0; axis < 3; ++axis) {
        const double v = log[std::string("commanded_v") + "xyz"[axis] + "_mps"][k];
        sum += std::pow((v - before[axis]) / 0.01, 2);
        before[axis] = v;
      }
      peak = std::max(peak, std::sqrt(sum));
    }
    CHECK(peak == Approx(item["peak_linear_acceleration_mps2"].get<double>()).epsilon(1e-4));
  }
  CHECK(vpApp::readJsonFile(run.path("result/summary.json"))["shape"] == runs[1]["shape"]);

  // Without --shape the limits of the file change nothing, and the raw runs are the same.
  REQUIRE(run(arguments + "--out plain") == 0);
  const nlohmann::json plain = vpApp::readJsonFile(run.path("plain/summary.json"))["runs"];
  REQUIRE(plain.size() == 2);
  CHECK(plain[0] == runs[0]);
  CHECK(plain[1] == runs[2]);
  CHECK_FALSE(vpApp::readJsonFile(run.path("plain/summary.json")).contains("shape"));
}

TEST_CASE("The photo gives the object its height", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  const std::string photo = VISP_DIRECT_DATA_DIR "/target/box.png"; // 324x223 px
  REQUIRE(run("--target '" + photo + "' --law pbvs1 --plant A --measure points --out result") == 0);
  const nlohmann::json task = vpApp::readJsonFile(run.path("result/summary.json"))["task"];
  CHECK(task["object"]["height_m"].get<double>() ==
        Approx(task["object"]["width_m"].get<double>() * 223. / 324.).epsilon(1e-9));
}

TEST_CASE("Help, version and list are printed", "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  CHECK(run("--help") == 0);
  for (const char *piece : {"Examples:", "--monte-carlo N", "--law LAW,...", "Exit status: 0", "--display", "--shape",
                            "1 m/s^2 and 2.5 rad/s^2"}) {
    CAPTURE(piece);
    CHECK(run.out().find(piece) != std::string::npos);
  }
  std::istringstream lines(run.out());
  for (std::string line; std::getline(lines, line);) {
    CAPTURE(line);
    CHECK(line.size() <= 120);
  }
  CHECK(run("--version") == 0);
  CHECK(run.out().find("visp-servo-compare 0.") == 0);
  CHECK(run("--list") == 0);
  for (const char *piece : {"  ff-lookat-pi ", "  kyrki-decoupled ", "  D  ", "+cbf"}) {
    CAPTURE(piece);
    CHECK(run.out().find(piece) != std::string::npos);
  }
  CHECK(run.entries().empty());
}

TEST_CASE("With a free axis an arm of five joints reaches the poses, and the result says what is free",
          "[visp-servo-compare]")
{
  ProgramRun run(SERVO_COMPARE);
  const std::string robot = "--robot " + std::string(VISP_DIRECT_DATA_DIR) + "/robot/five-axis.json";
  for (const bool free : {true, false}) {
    const int status = run(robot + (free ? " --free rz" : "") + " --law pbvs1 --plant A --measure points --out " +
                           (free ? "free" : "all"));
    CAPTURE(run.err());
    REQUIRE(status == 0);
    const std::string folder = free ? "free" : "all";
    const nlohmann::json summary = vpApp::readJsonFile(run.path(folder + "/summary.json"));
    const nlohmann::json &result = summary["runs"][0];
    const std::string arm = result["arm"]["status"], sentence = summary["robot"]["sentence"];
    const bool isSaid =
        sentence.find("Free axes of the camera: rotation about z. They are not commanded, and errors of the "
                      "pose are without them.") != std::string::npos;
    CAPTURE(free, result);
    CHECK(summary["robot"]["free_axes"] == (free ? "rotation about z" : ""));
    CHECK((free ? arm == "ok" : arm.find("of the camera cannot be commanded") != std::string::npos));
    CHECK(isSaid == free);
    if (free) {
      CHECK(result["end_rotation_deg"] < 0.1);
      CHECK(result["end_translation_mm"] < 1.);
    }
  }
}

TEST_CASE("On an arm the result has the joints", "[visp-servo-compare]")
{
  const std::string sixAxes = std::string(VISP_DIRECT_DATA_DIR) + "/robot/generic-6r.urdf";
  for (const std::string &robot : {std::string("amor"), sixAxes + " --robot-tip tool --camera-link camera"}) {
    ProgramRun run(SERVO_COMPARE);
    const int status = run("--robot " + robot + " --law pbvs1,ff-lookat-pi --plant A,B --measure points --out result");
    CAPTURE(robot, run.err());
    REQUIRE(status == 0);
    const nlohmann::json summary = vpApp::readJsonFile(run.path("result/summary.json"));
    const std::size_t joints = robot == "amor" ? 7 : 6;
    REQUIRE(summary["robot"]["joints"].size() == joints);
    REQUIRE(summary["robot"]["start"].size() == joints);
    REQUIRE(summary["runs"].size() == 4);
    for (const nlohmann::json &item : summary["runs"]) {
      const nlohmann::json &arm = item["arm"];
      CAPTURE(item["law"], item["plant"], arm);
      CHECK(arm["status"] == "ok");
      CHECK(arm["peak_velocity_share"] <= 1.);
      CHECK(item["end_rotation_deg"] < 0.6);
      const bool perfect = item["plant"] == "A";
      for (const double rms : arm["joint_rms"]) {
        CHECK((perfect ? rms == 0. : rms > 1e-4 && rms < 0.006));
      }
      CHECK((arm["self_motion_rad"] > 0.) == (joints == 7));
      auto columns = readCsv(run.path("result").append(item["log"].get<std::string>()));
      const std::string first = summary["robot"]["joints"][0];
      REQUIRE(columns.count("q_" + first) == 1);
      // The joint data agree with the table.
      double squares = 0.;
      const std::vector<double> &q = columns["q_" + first], &wanted = columns["wanted_" + first];
      for (std::size_t i = 0; i < q.size(); ++i) {
        squares += (q[i] - wanted[i]) * (q[i] - wanted[i]);
      }
      CHECK(std::sqrt(squares / static_cast<double>(q.size())) ==
            Approx(arm["joint_rms"][0].get<double>()).margin(1e-6));
    }
    CHECK(vpApp::readJsonFile(run.path("result/arm.json"))["joints"].size() == joints);
    CHECK(summary["robot"]["camera_at_start"].size() == 4);
  }
}
