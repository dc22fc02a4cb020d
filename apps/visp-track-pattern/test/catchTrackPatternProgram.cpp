/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program as run by users: exit status, output streams, written files.
#include "vpCaseFile.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

namespace
{
using nlohmann::json;

constexpr int OK = 0, DATA = 1, USAGE = 2; // exit status

//! Reports are tested with Python; where this file asks for one it sets the variable back.
[[maybe_unused]] const int withoutReports = setenv("VISP_DIRECT_PYTHON", "none", 1);

//! \brief A table with a heading.
struct Table {
  std::vector<std::string> heading;
  std::vector<std::map<std::string, std::string>> lines;
};

std::vector<std::string> split(const std::string &line)
{
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) {
    parts.push_back(part);
  }
  return parts;
}

//! A CSV file in the folder of \e run.
Table tableIn(const ProgramRun &run, const std::string &file)
{
  Table table;
  std::istringstream stream(vpApp::readFile(run.path(file)));
  std::string line;
  std::getline(stream, line);
  table.heading = split(line);
  while (std::getline(stream, line)) {
    const std::vector<std::string> parts = split(line);
    REQUIRE(parts.size() == table.heading.size());
    table.lines.emplace_back();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      table.lines.back()[table.heading[i]] = parts[i];
    }
  }
  return table;
}

double number(const std::map<std::string, std::string> &line, const std::string &name)
{
  return std::stod(line.at(name));
}

json jsonIn(const ProgramRun &run, const std::string &file) { return json::parse(vpApp::readFile(run.path(file))); }
json summaryIn(const ProgramRun &run, const std::string &folder) { return jsonIn(run, folder + "/summary.json"); }

//! Name of an image of visp-generate-pattern.
std::string imageName(int i) { return (i < 10 ? "00000" : "0000") + std::to_string(i) + ".png"; }

//! A sequence of visp-generate-pattern in the folder of \e run.
void generate(const ProgramRun &run, const std::string &arguments)
{
  const std::string command =
      "cd '" + run.path("").string() + "' && '" GENERATE_PATTERN "' " + arguments + " >/dev/null 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
}
} // namespace

TEST_CASE("Without input it tracks its own sequence and says how far it is from the truth", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  REQUIRE(run("--frames 130 --seed 3", "VISP_DIRECT_PYTHON=") == OK);
  CHECK(run.out().find("The product was tracked in ") == 0);
  CHECK(run.out().find("Against the truth, ") != std::string::npos);
  CHECK(run.out().find("/out/track-pattern/report.html\n") != std::string::npos);
  const json summary = summaryIn(run, "out/track-pattern");
  CHECK(summary["program"] == "visp-track-pattern");
  CHECK(summary["images"] == 130);
  CHECK(summary["images_by_status"]["tracking"].get<int>() > 50);
  CHECK(summary["images_by_status"]["lost"] == 0);
  const json &errors = summary["errors"]["tracking"];
  CHECK(errors["x"]["sigma_px"].get<double>() < 0.02);
  CHECK(errors["y"]["sigma_px"].get<double>() < 0.012);
  CHECK(std::abs(errors["x"]["mean_px"].get<double>()) < 0.01);
  CHECK(errors["x"]["rms_over_told_sigma"].get<double>() == Approx(1.).margin(0.3));
  CHECK(errors["other_name"] == 0);
  CHECK(errors["no_cell_there"] == 0);
  for (const json &file : summary["files"]) {
    CHECK(std::filesystem::exists(run.path("out/track-pattern/" + file.get<std::string>())));
  }
  CHECK(std::filesystem::file_size(run.path("out/track-pattern/overlay.mp4")) > 1000);
  const Table motion = tableIn(run, "out/track-pattern/motion.csv");
  CHECK(motion.heading ==
        split("frame,dx,dy,sigma,status,microseconds,sigma_dx,sigma_dy,reason,epoch,valid_cells,sigma_x,"
              "sigma_y,true_dx,true_dy"));
  REQUIRE(motion.lines.size() == 130);
  CHECK(motion.lines[0].at("dx") == "nan");
  CHECK(motion.lines[129].at("status") == "Tracking");
  CHECK(number(motion.lines[129], "sigma") ==
        Approx(std::hypot(number(motion.lines[129], "sigma_dx"), number(motion.lines[129], "sigma_dy"))).margin(2e-5));
  const Table cells = tableIn(run, "out/track-pattern/cells.csv");
  CHECK(cells.heading == split("frame,row,column,x,y,sigma_x,sigma_y,valid,epoch"));
  CHECK(cells.lines.size() > 130 * 6);
}

TEST_CASE("The folder of visp-generate-pattern brings its truth, a region keeps the places", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  generate(run, "--noise 4 --frames 90 --motion 3.3 0.4 --width 200 --height 120 --out d");
  for (const auto &[arguments, images] : std::vector<std::pair<std::string, std::size_t>>{
           {"d", 90}, {"d/frames --roi 20,10,160,100", 90}, {"d/ --frames 80", 80}}) {
    CAPTURE(arguments);
    REQUIRE(run(arguments + " --overlay none --out t") == OK);
    const json summary = summaryIn(run, "t");
    CHECK(summary["images"] == images);
    const json &errors = summary["errors"]["tracking"];
    CHECK(errors["x"]["number"].get<int>() > 100);
    CHECK(std::abs(errors["x"]["mean_px"].get<double>()) < 0.01);
    CHECK(errors["x"]["sigma_px"].get<double>() < 0.02);
    CHECK(errors["dx"]["sigma_px"].get<double>() < 0.02);
    CHECK_FALSE(std::filesystem::exists(run.path("t/overlay.mp4")));
    // Checks the table itself, not only the program's comparison.
    const Table truth = tableIn(run, "d/truth.csv");
    const Table cells = tableIn(run, "t/cells.csv");
    const std::string last = cells.lines.back().at("frame");
    int compared = 0;
    for (const auto &cell : cells.lines) {
      if (cell.at("frame") != last || cell.at("valid") != "1") {
        continue;
      }
      double nearest = HUGE_VAL;
      for (const auto &place : truth.lines) {
        if (place.at("frame") == last) {
          nearest = std::min(
              nearest, std::hypot(number(place, "x") - number(cell, "x"), number(place, "y") - number(cell, "y")));
        }
      }
      CHECK(nearest < 0.2);
      ++compared;
    }
    CHECK(compared >= 6);
  }
  // The same images by pattern or by name come without ground truth.
  REQUIRE(run("'d/frames/%06d.png' --overlay none --frames 5 --out t") == OK);
  CHECK_FALSE(summaryIn(run, "t").contains("errors"));
  REQUIRE(run("d/frames/000003.png d/frames/000004.png --overlay png --out t") == OK);
  CHECK(summaryIn(run, "t")["images"] == 2);
  const cv::Mat overlay = cv::imread(run.path("t/overlay/000004.png").string(), cv::IMREAD_UNCHANGED);
  CHECK(overlay.cols == 800);
  CHECK(overlay.rows % 2 == 0);
}

TEST_CASE("Methods, thresholds and derivatives are selectable; the printed algorithm has its bias",
          "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  generate(run, "--noise 4 --frames 40 --motion 3.37 0.21 --out d");
  const auto biasOf = [&](const std::string &arguments) {
    CAPTURE(arguments);
    REQUIRE(run("d --overlay none --out t " + arguments) == OK);
    const json summary = summaryIn(run, "t");
    const json &x = summary["errors"][summary["errors"]["tracking"]["x"].is_null() ? "acquiring" : "tracking"]["x"];
    return x["mean_px"].get<double>();
  };
  CHECK(biasOf("--method thesis --derivative sobel") == Approx(0.5).margin(0.05));
  CHECK(std::abs(biasOf("--method thesis-fixed --derivative roberts")) < 0.03);
  CHECK(std::abs(biasOf("--method half-maximum --threshold isodata")) < 0.03);
  CHECK(std::abs(biasOf("--threshold minimum-error --polarity bright")) < 0.03);
  CHECK(summaryIn(run, "t")["threshold"] == "MinimumError");
}

TEST_CASE("The product calibrates the microscope, and then places are micrometres too", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  generate(run, "--noise 4 --frames 100 --motion 3.3 0.4 --out d");
  REQUIRE(run("d --calibrate --pitch-um 220 80 --overlay none --out scale") == OK);
  CHECK(run.out().find("The distortion kappa1 is unobservable and taken as 0") != std::string::npos);
  const json calibration = jsonIn(run, "scale/calibration.json");
  CHECK(1e6 / calibration["scale_x_px_per_m"].get<double>() == Approx(4.5).epsilon(2e-3));
  CHECK(calibration["quality"]["kappa1_status"] == "Unobservable");
  for (const std::string file : {"scale/calibration.json", "scale/calibration.xml"}) {
    CAPTURE(file);
    REQUIRE(run("d --overlay none --out um --calibration " + file) == OK);
    CHECK(run.out().find("In micrometres: 4.5") != std::string::npos);
    CHECK(vpApp::readFile(run.path("um/motion.csv")).find("-nan") == std::string::npos);
    const Table motion = tableIn(run, "um/motion.csv");
    CHECK(number(motion.lines.back(), "dx_um") == Approx(4.5 * number(motion.lines.back(), "dx")).epsilon(5e-3));
    const Table cells = tableIn(run, "um/cells.csv");
    const auto &a = cells.lines[cells.lines.size() - 2], &b = cells.lines.back();
    CHECK(number(b, "x_um") - number(a, "x_um") ==
          Approx(4.5 * (number(b, "x") - number(a, "x"))).epsilon(0.01).margin(0.5));
  }
  CHECK(run("d --frames 3 --overlay none --out um --roi 5,5,150,90 --calibration scale/calibration.json") == OK);
}

TEST_CASE("A still grid of dots calibrates by single images", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  generate(run,
           "--shape dot --pitch-x 30 --pitch-y 30 --opening-x 14 --opening-y 14 --width 320 --height 240 --noise 2 "
           "--frames 3 --motion 0 0 --rotation 3 --out d");
  REQUIRE(run("d --calibrate --dot-grid --pitch-um 90 90 --overlay none --out scale") == OK);
  const json calibration = jsonIn(run, "scale/calibration.json");
  CHECK(1e6 / calibration["scale_x_px_per_m"].get<double>() == Approx(3.).epsilon(1e-3));
  CHECK(calibration["rotation_deg"].get<double>() == Approx(3.).margin(0.05));
  CHECK(calibration["quality"]["views"] == 3);
}

TEST_CASE("A hexagonal grid is calibrated as one, and never as a square one", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  cv::Mat grid(480, 640, CV_8UC1, cv::Scalar(40));
  const double pitch = 24., angle = 0.6; // px; beyond the tracker's range
  for (int row = -40; row <= 40; ++row) {
    for (int column = -60; column <= 60; ++column) {
      const double x = pitch * (column + 0.5 * row), y = pitch * 0.5 * std::sqrt(3.) * row;
      const double u = 320. + std::cos(angle) * x - std::sin(angle) * y,
                   v = 240. + std::sin(angle) * x + std::cos(angle) * y;
      constexpr double fine = 16.; // of cv::circle's shift
      cv::circle(grid, cv::Point(cvRound(fine * u), cvRound(fine * v)), cvRound(fine * 6.), cv::Scalar(200), cv::FILLED,
                 cv::LINE_AA, 4);
    }
  }
  cv::imwrite(run.path("hexagonal.png").string(), grid);
  REQUIRE(run("hexagonal.png --calibrate --dot-grid --pitch-um 24 24 --overlay none --out scale") == OK);
  CHECK(run.out().find("are on a hexagonal lattice") != std::string::npos);
  CHECK(run.out().find("whose axes are at ") != std::string::npos);
  const json calibration = jsonIn(run, "scale/calibration.json");
  CHECK(calibration["scale_x_px_per_m"].get<double>() == Approx(1e6).epsilon(1e-3));
  CHECK(summaryIn(run, "scale")["calibrated"]["reliable"] == calibration["quality"]["reliable"]);
  CHECK(run("hexagonal.png --calibrate --dot-grid --pitch-um 24 24 --axes-deg 60 --overlay none --out same") == OK);
  CHECK(run("hexagonal.png --calibrate --dot-grid --pitch-um 24 24 --axes-deg 90 --overlay none --out square") == DATA);
  CHECK(run.err().find("--calibrate: the points do not fit, no calibration is written. ") != std::string::npos);
  CHECK(run.err().find("the cells are on another lattice than specified") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(run.path("square/calibration.json")));
  CHECK(run("hexagonal.png --calibrate --dot-grid --pitch-um 24 24 --axes-deg 9 --out square") == USAGE);
}

TEST_CASE("A micrograph of a grid with dots of three levels is a grid", "[visp-track-pattern]")
{
  const std::string image = vpTestSupport::caseFile("images/three-level-dots.png");
  if (image.empty()) {
    return;
  }
  ProgramRun run(TRACK_PATTERN);
  REQUIRE(run("'" + image + "' --calibrate --dot-grid --pitch-um 16 16 --overlay none --out scale") == OK);
  CHECK(run.out().find("of 796 bright dots are on a square lattice of 15.98 and 15.97 px") != std::string::npos);
}

TEST_CASE("Videos and colour images are read", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  generate(run, "--noise 1 --frames 80 --motion 3 0 --video --out d");
  REQUIRE(run("d/video.mp4 --overlay none --out t") == OK);
  const json summary = summaryIn(run, "t");
  CHECK(summary["images"] == 80);
  CHECK(summary["images_by_status"]["lost"] == 0);
  CHECK(summary["lattice"]["column_pitch_px"].get<double>() == Approx(220. / 4.5).epsilon(0.01));
  std::filesystem::create_directory(run.path("colour"));
  for (int i = 0; i < 3; ++i) {
    cv::Mat grey = cv::imread(run.path("d/frames/" + imageName(i)).string(), cv::IMREAD_COLOR);
    cv::imwrite(run.path("colour/" + imageName(i)).string(), grey);
  }
  REQUIRE(run("colour --overlay none --out t") == OK);
  CHECK(run.out().find("The images are in colour; they were made grey.") != std::string::npos);
}

TEST_CASE("Images without a pattern end with status 1 and a whole result", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  cv::imwrite(run.path("black.png").string(), cv::Mat(100, 160, CV_8UC1, cv::Scalar(7)));
  CHECK(run("black.png --out t") == DATA);
  CHECK(run.out().find("No pattern was found in any of the 1 image. The tracker says: No lock: ") == 0);
  CHECK(run.err().find("visp-track-pattern: no pattern was found; the report shows the images as they were read") !=
        std::string::npos);
  CHECK(std::filesystem::exists(run.path("t/picture.png")));
  CHECK(tableIn(run, "t/motion.csv").lines.size() == 1);
}

TEST_CASE("Across a gap in the numbers there is no displacement, a new epoch begins, and it is said",
          "[visp-track-pattern][gap]")
{
  // 5 px an image, pitch 48.89 px: across ten images the product seems to have moved by 1.1 px.
  ProgramRun run(TRACK_PATTERN);
  generate(run, "--noise 4 --frames 100 --motion 5 0 --out d");
  std::filesystem::create_directory(run.path("gap"));
  for (int i = 0; i < 100; ++i) {
    if (i < 70 || i >= 79) {
      std::filesystem::copy_file(run.path("d/frames/" + imageName(i)), run.path("gap/" + imageName(i)));
    }
  }
  REQUIRE(run("gap --overlay none --out t") == OK);
  const std::string remark = "1 gap: images are missing (after 000069.png comes 000079.png).";
  const std::string meaning =
      "How far the product moved across a gap is not known: no displacement is given there, and "
      "a new epoch begins.";
  CHECK(run.out().find(remark + "\n" + meaning) != std::string::npos);
  CHECK(summaryIn(run, "t")["remarks"] == json::array({remark, meaning}));
  const Table motion = tableIn(run, "t/motion.csv");
  REQUIRE(motion.lines.size() == 91);
  for (std::size_t i = 1; i < motion.lines.size(); ++i) {
    const auto &line = motion.lines[i];
    CAPTURE(line.at("frame"));
    if (line.at("frame") == "79") {
      CHECK(line.at("dx") == "nan");
      CHECK(line.at("sigma") == "nan");
      CHECK(line.at("status") == "Degraded");
      CHECK(line.at("reason") == "ImagesMissing");
    }
    else {
      CHECK(number(line, "dx") == Approx(5.).margin(0.15));
    }
    CHECK(line.at("epoch") == (i < 70 ? "0" : "1"));
  }
  CHECK(motion.lines.back().at("status") == "Tracking"); // the learned template is kept
}

TEST_CASE("Ctrl-C ends a run with a report of what was seen", "[visp-track-pattern][unfinished]")
{
  ProgramRun run(TRACK_PATTERN);
  // The shell interrupts as soon as there are rows, which are written during the run.
  const std::string script =
      "--frames 5000000 --overlay none --out t >out.txt 2>err.txt & pid=$!; "
      "for i in $(seq 1000); do "
      "test \"$(cat t/unfinished-run/motion.csv 2>/dev/null | wc -l)\" -gt 70 && break; sleep 0.05; "
      "done; kill -INT $pid; wait $pid";
  // A background job of a non-interactive shell ignores the interrupt by default.
  CHECK(run(script, "exec 3>&1; VISP_DIRECT_PYTHON= env --default-signal=INT") == 130);
  const json summary = summaryIn(run, "t");
  CHECK(summary["status"] == "interrupted");
  const auto images = summary["images"].get<std::size_t>();
  CHECK(images >= 70);
  CHECK(tableIn(run, "t/motion.csv").lines.size() == images);
  const std::string sentence =
      "The run was interrupted after " + std::to_string(images) + " of 5000000 images; all below holds for these.";
  CHECK(summary["findings"][0] == sentence);
  CHECK(vpApp::readFile(run.path("out.txt")).find(sentence) == 0);
  CHECK(vpApp::readFile(run.path("t/report.html")).find(sentence) != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(run.path("t/unfinished-run")));
}

TEST_CASE("After a failure what was measured stays, marked as incomplete", "[visp-track-pattern][unfinished]")
{
  ProgramRun run(TRACK_PATTERN);
  std::filesystem::create_directory(run.path("sizes"));
  for (int i = 0; i < 6; ++i) {
    cv::Mat picture(100, i == 5 ? 161 : 160, CV_8UC1);
    cv::randu(picture, 0, 255);
    cv::imwrite(run.path("sizes/" + std::to_string(i) + ".png").string(), picture);
  }
  CHECK(run("sizes --overlay none --out t") == DATA);
  CHECK(run.err().find("sizes/5.png: has 161 x 100 px, sizes/0.png has 160 x 100 px; ") != std::string::npos);
  CHECK(run.err().find("unfinished-run") != std::string::npos);
  const json unfinished = summaryIn(run, "t/unfinished-run");
  CHECK(unfinished["status"] == "unfinished");
  CHECK(unfinished["reason"] == "sizes/5.png: has 161 x 100 px, sizes/0.png has 160 x 100 px");
  CHECK(tableIn(run, "t/unfinished-run/motion.csv").lines.size() == 5);

  // A failed calibration does not discard the measurement.
  for (const auto &[arguments, reason] : std::vector<std::pair<std::string, std::string>>{
           {"--frames 5 --calibrate --pitch-um 220 80", "--calibrate: in no image the product was tracked"},
           {"sizes/1.png --calibrate --dot-grid --pitch-um 1 1",
            "--calibrate: in no image a grid of dots was found"}}) {
    CAPTURE(arguments);
    CHECK(run(arguments + " --out u --overlay none") == DATA);
    CHECK(run.err().find(reason) != std::string::npos);
    CHECK(run.err().find("; the report shows what was seen") != std::string::npos);
    CHECK(run.out().find("Incomplete: " + reason) == 0);
    const json summary = summaryIn(run, "u");
    CHECK(summary["status"] == "incomplete");
    CHECK(tableIn(run, "u/motion.csv").lines.size() == summary["images"].get<std::size_t>());
    CHECK_FALSE(std::filesystem::exists(run.path("u/calibration.json")));
  }
}

TEST_CASE("Images of 16 bits are scaled by the range of their data, and it is said", "[visp-track-pattern][depth]")
{
  // 12 bits in files of 16, as cameras write them.
  ProgramRun run(TRACK_PATTERN);
  generate(run, "--noise 4 --frames 70 --motion 3.3 0.4 --out d");
  std::vector<cv::Mat> pages;
  for (int i = 0; i < 70; ++i) {
    const cv::Mat grey = cv::imread(run.path("d/frames/" + imageName(i)).string(), cv::IMREAD_GRAYSCALE);
    grey.convertTo(pages.emplace_back(), CV_16U, 4095. / 255.);
  }
  cv::imwrite(run.path("stack.tif").string(), pages);
  REQUIRE(run("stack.tif --overlay none --out t") == OK);
  CHECK(run.out().find("The images have 16 bits a value; the values 0 to 4095 became the grey values 0 to 255.") !=
        std::string::npos);
  const json summary = summaryIn(run, "t");
  CHECK(summary["images"] == 70);
  CHECK(summary["images_by_status"]["lost"] == 0);
  CHECK(summary["lattice"]["column_pitch_px"].get<double>() == Approx(220. / 4.5).epsilon(0.002));
}

TEST_CASE("Bad use ends with a sentence and nothing written", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  std::filesystem::create_directory(run.path("mine"));
  run.write("mine/notes.txt", "precious");
  cv::Mat small(100, 160, CV_8UC1);
  cv::randu(small, 0, 255);
  cv::imwrite(run.path("good.png").string(), small);
  cv::imwrite(run.path("tiny.png").string(), small(cv::Rect(0, 0, 8, 8)));
  run.write("cut.png", vpApp::readFile(run.path("good.png")).substr(0, 3000));
  run.write("film.mp4", "no film");
  run.write("bad.json", R"({"scale_x_px_per_m": 2e5, "width": 640, "height": 480})");
  const std::size_t entries = run.entries().size();
  struct Case {
    std::string arguments;
    int status;
    std::string sentence;
  };
  const std::vector<Case> cases = {
      {"--nonsense", USAGE, "--nonsense"},
      {"--frames 0", USAGE, "--frames is 0, must be a whole number from 1 to 10000000"},
      {"--frames few", USAGE, "--frames"},
      {"--roi 1,2,3", USAGE, "--roi is 1,2,3, must be X,Y,WIDTH,HEIGHT in whole pixels, at least 16 x 16"},
      {"--roi 0,0,8,8", USAGE, "--roi is 0,0,8,8"},
      {"--roi ' 0,0,20,20'", USAGE, "--roi is 0,0,20,20, must be"},
      {"--roi -1,0,20,20", USAGE, "--roi"},
      {"--method best", USAGE, "--method is best, must be gauss-newton, half-maximum, thesis or thesis-fixed"},
      {"--threshold 128", USAGE, "--threshold is 128, must be otsu, isodata or minimum-error"},
      {"--derivative scharr", USAGE, "--derivative is scharr, must be symmetric, roberts, prewitt or sobel"},
      {"--polarity grey", USAGE, "--polarity is grey, must be automatic, bright or dark"},
      {"--overlay gif", USAGE, "--overlay is gif, must be none, png or mp4"},
      {"--video-rate 0", USAGE, "--video-rate is 0"},
      {"--out ''", USAGE, "--out"},
      {"--calibrate", USAGE, "--calibrate needs --pitch-um X Y"},
      {"--calibrate --pitch-um 220 -80", USAGE, "--pitch-um is -80, must be a number > 0"},
      {"--calibrate --pitch-um 220 80 --pitch-sigma-um -1", USAGE, "--pitch-sigma-um is -1, must be a number >= 0"},
      {"--pitch-um 220 80", USAGE, "--pitch-um is given without --calibrate"},
      {"--calibrate --pitch-um 1 1 --calibration x.json", USAGE, "not both in one run"},
      {"--camera 0 good.png", USAGE, "--camera and the input good.png are both given"},
      {"/dev/videofront", USAGE, "--camera is /dev/videofront, must be a number or /dev/videoN"},
      {"--camera front", USAGE, "--camera is front, must be a number or /dev/videoN"},
      {"--camera 9999", DATA, "/dev/video9999: the camera cannot be opened"},
      {"/dev/video9999", DATA, "/dev/video9999: the camera cannot be opened"},
      {"none", DATA, "none: there is no such file or folder"},
      {"none.png", DATA, "none.png: there is no such file or folder"},
      {"good.png none.png", DATA, "none.png: cannot be read (there is no such file)"},
      {"mine", DATA, "mine: the folder holds no images"},
      {"'x%04d.png'", DATA, "x%04d.png: no file has such a name"},
      {"'x%s.png'", DATA, "x%s.png: is no pattern"},
      {"cut.png", DATA, "cut.png: is not an image that can be read, or is cut short"},
      {"film.mp4", DATA, "film.mp4: is not a video that can be read"},
      {"tiny.png", DATA, "width of the pattern tracker's image is 8 px, must be 16..16384"},
      {"good.png --roi 100,0,100,50", DATA, "--roi 100,0,100,50 does not lie in good.png of 160 x 100 px"},
      {"good.png --calibration none.json", DATA, "none.json: cannot be read"},
      {"good.png --calibration none.xml", DATA, "none.xml: cannot be read"},
      {"good.png --calibration bad.json", DATA, "bad.json: is for images of 640 x 480 px, these have 160 x 100 px"},
      {"good.png --out mine", DATA, "mine: is not empty and not a result of visp-track-pattern"},
      {"good.png --out bad.json", DATA, "bad.json: exists and is not a folder"},
      {"good.png --out /proc/none/out", DATA, "/proc/none/out: cannot be written"},
  };
  for (const Case &bad : cases) {
    CAPTURE(bad.arguments);
    CHECK(run(bad.arguments) == bad.status);
    CAPTURE(run.err());
    const std::size_t sentence = run.err().rfind("visp-track-pattern: ");
    CHECK((sentence == 0 || (sentence != std::string::npos && run.err()[sentence - 1] == '\n')));
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') <= 5); // the message, and progress at every quarter
    CHECK(run.err().find(bad.sentence) != std::string::npos);
    CHECK(run.out().empty());
    CHECK(run.entries().size() == entries);
  }
  CHECK(run("good.png --display", "DISPLAY=") == DATA);
  CHECK(run.err().find("--display needs") != std::string::npos);
  CHECK(vpApp::readFile(run.path("mine/notes.txt")) == "precious");
  CHECK(run("--help") == OK);
  CHECK(run.out().find("--pitch-um") != std::string::npos);
  CHECK(run("--version") == OK);
}

TEST_CASE("What is written is described", "[visp-track-pattern]")
{
  const std::string readme = vpApp::readFile(VISP_DIRECT_DATA_DIR "/pattern/README.md");
  for (const char *word :
       {"visp-track-pattern", "cells.csv", "frame,row,column,x,y,sigma_x,sigma_y,valid,epoch",
        "frame,dx,dy,sigma,status,microseconds,sigma_dx,sigma_dy,reason,epoch,valid_cells", "x_um,y_um", "dx_um,dy_um",
        "calibration.json", "scale_x_px_per_m", "kappa1_per_px2", "calibration.xml", "overlay.mp4"}) {
    CAPTURE(word);
    CHECK(readme.find(word) != std::string::npos);
  }
}
