/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A whole run of the program: is everything in the result folder, and is it what it should be?
#include "vpCatch.h"

#include "jsonReader.h"
#include "programRun.h"

#include <cmath>
#include <map>
#include <sstream>

namespace
{
std::size_t countOf(const std::string &text, const std::string &piece)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) {
    ++count;
  }
  return count;
}

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
  ProgramRun run;
  const int status = run("--law pbvs1,ff-lookat-pi --plant A --measure points --out new/result");
  CAPTURE(run.err());
  REQUIRE(status == 0);
  CHECK(run.out() == "Report: " + run.path("new/result/report.html").string() + "\n");
  CHECK(run.err().find('\r') == std::string::npos); // no bar outside of a terminal

  const nlohmann::json summary = vpApp::readJsonFile(run.path("new/result/summary.json"));
  CHECK(summary["program"] == "visp-servo-compare");
  CHECK(summary["command_line"] ==
        "visp-servo-compare --law pbvs1,ff-lookat-pi --plant A --measure points --out new/result");
  CHECK(summary["wall_time_s"].get<double>() > 0.);
  REQUIRE(summary["runs"].size() == 2);
  for (const nlohmann::json &item : summary["runs"]) {
    CAPTURE(item);
    for (const char *field : {"max_image_error_px", "rms_image_error_px", "end_rotation_deg", "end_translation_mm",
                              "yaw_range_deg", "ideal_yaw_range_deg", "out_of_view_s", "settle_s", "path_length_m",
                              "peak_linear_mps", "peak_angular_radps", "deadlock_cycles"}) {
      CAPTURE(field);
      REQUIRE(item[field].is_number());
      CHECK(std::isfinite(item[field].get<double>()));
      CHECK(item[field].get<double>() >= 0.);
    }
    CHECK(item["plant"] == "A");
    CHECK(item["measure"] == "points");
    CHECK(item["seed"] == 1);
    CHECK(item["status"] == "ok");
    CHECK(item["ideal_yaw_range_deg"].get<double>() == Approx(56.79).margin(0.01));
    CHECK(item["end_rotation_deg"].get<double>() < 0.2);
    CHECK(item["gains"]["lambda"] == 1.);
    CHECK(item["plant_parameters"]["max_linear_mps"] == 1.);

    // The log says the same as the summary.
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

  const std::string page = vpApp::readFile(run.path("new/result/report.html"));
  CHECK(countOf(page, "<h2 ") == 5);
  for (const char *figure : {"5.6", "5.7", "5.8", "5.9", "5.10"}) {
    CAPTURE(figure);
    CHECK(page.find("Figure " + std::string(figure) + " again") != std::string::npos);
    CHECK(vpApp::readFile(run.path("new/result/figure/figure-" + std::string(figure) + ".svg")).find("</svg>") !=
          std::string::npos);
  }
  CHECK(page.find("Figure 5.11 again") != std::string::npos);
  // Every picture and video is inside, none is empty or refers to a file.
  CHECK(countOf(page, "src=\"") == countOf(page, "src=\"data:"));
  CHECK(countOf(page, "src=\"data:image/svg+xml;base64,PD94") == 6); // "<?x"
  CHECK(countOf(page, "src=\"data:image/jpeg;base64,/9j/") == 1);
  CHECK(countOf(page, "src=\"data:video/mp4;base64,AAAA") == 2);
  CHECK(page.find("http://") == std::string::npos);
  CHECK(page.find("all 2 laws end within 0.2 deg of every goal") != std::string::npos);
  CHECK(page.find("rendered from that photograph") != std::string::npos);

  // Again into the same folder: replaced, and the user's own file stays.
  run.write("new/result/notes.txt", "mine");
  REQUIRE(run("--law pbvs1 --plant A --measure points --out new/result") == 0);
  CHECK(vpApp::readJsonFile(run.path("new/result/summary.json"))["runs"].size() == 1);
  CHECK(std::filesystem::exists(run.path("new/result/notes.txt")));
  CHECK_FALSE(std::filesystem::exists(run.path("new/result/video/ff-lookat-pi-A.mp4")));
  CHECK(run.entries() == std::vector<std::string>{"new"});
}

TEST_CASE("Several seeds and a task of one's own", "[visp-servo-compare]")
{
  ProgramRun run;
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
  // Noise differs from seed to seed, and nothing but the seed matters.
  CHECK(summary["runs"][0]["rms_image_error_px"] != summary["runs"][1]["rms_image_error_px"]);
  REQUIRE(run("--task task.json --law ibvs --seed 8 --measure points --jobs 1 --out again") == 0);
  nlohmann::json again = vpApp::readJsonFile(run.path("again/summary.json"))["runs"][0];
  CHECK(again["rms_image_error_px"] == summary["runs"][1]["rms_image_error_px"]);

  const std::string page = vpApp::readFile(run.path("result/report.html"));
  CHECK(page.find("a &lt;b&gt; &amp; c") != std::string::npos);
  CHECK(page.find("a <b>") == std::string::npos);
  CHECK(page.find("3 seeds") != std::string::npos);
  CHECK(std::filesystem::exists(run.path("result/figure/seeds-rotation.svg")));
}

TEST_CASE("The photo gives the object its height", "[visp-servo-compare]")
{
  ProgramRun run;
  const std::string photo = VISP_DIRECT_DATA_DIR "/target/box.png"; // 324x223 px
  REQUIRE(run("--target '" + photo + "' --law pbvs1 --plant A --measure points --out result") == 0);
  const nlohmann::json task = vpApp::readJsonFile(run.path("result/summary.json"))["task"];
  CHECK(task["object"]["height_m"].get<double>() ==
        Approx(task["object"]["width_m"].get<double>() * 223. / 324.).epsilon(1e-9));
}

TEST_CASE("Help, version and list are printed", "[visp-servo-compare]")
{
  ProgramRun run;
  CHECK(run("--help") == 0);
  for (const char *piece : {"Examples:", "--monte-carlo N", "--law LAW,...", "Exit status: 0", "--display"}) {
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
