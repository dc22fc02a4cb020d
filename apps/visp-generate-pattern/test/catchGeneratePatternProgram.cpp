/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program as run by users: exit status, output streams, written files.
#include "vpCatch.h"

#include "programRun.h"

#include <visp3/rendering/vpProductPattern.h>

#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <sstream>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using nlohmann::json;

constexpr int OK = 0;
constexpr int DATA = 1;
constexpr int USAGE = 2;

//! Numbers of a table, line by line, without the heading.
std::vector<std::vector<double>> numbersOf(const std::string &csv, std::string &heading)
{
  std::vector<std::vector<double>> lines;
  std::istringstream stream(csv);
  std::getline(stream, heading);
  for (std::string line; std::getline(stream, line);) {
    lines.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) {
      lines.back().push_back(std::stod(field));
    }
  }
  return lines;
}
} // namespace

TEST_CASE("Without arguments it is the display of the thesis", "[visp-generate-pattern]")
{
  ProgramRun run(GENERATE_PATTERN);
  REQUIRE(run("") == OK);
  CHECK(run.out().find("100 frames with ") == 0);
  CHECK(run.out().find(": out/generate-pattern\n") != std::string::npos);
  const json summary = json::parse(vpApp::readFile(run.path("out/generate-pattern/summary.json")));
  CHECK(summary["program"] == "visp-generate-pattern");
  CHECK(summary["frames"] == 100);
  CHECK(summary["spec"]["cells"]["pitch_x"].get<double>() == Approx(220. / 4.5));
  CHECK(summary["files"].size() == 104);
  for (const json &file : summary["files"]) {
    CHECK(std::filesystem::exists(run.path("out/generate-pattern/" + file.get<std::string>())));
  }
}

TEST_CASE("Frames and tables are those of vpProductPattern", "[visp-generate-pattern]")
{
  ProgramRun run(GENERATE_PATTERN);
  for (const std::string format : {"png", "pgm"}) {
    REQUIRE(run("--frames 6 --motion 3.5 -1 --swing 2 1 --swing-period 8 --start 10 20 --noise 4 --dust 7 --rotation 3 "
                "--shape rectangle --width 121 --missing 0.1 --seed 9 --out d --format " +
                format) == OK);
    vpProductPatternSpec spec;
    spec.noise = 4.;
    spec.dust = 7.;
    spec.rotation = 3. * M_PI / 180.;
    spec.shape = vpProductShape::Rectangle;
    spec.width = 121;
    spec.missing = 0.1;
    spec.seed = 9;
    const vpProductPattern product(spec);
    std::string heading;
    const auto motion = numbersOf(vpApp::readFile(run.path("d/motion.csv")), heading);
    CHECK(heading == "frame,x,y,dx,dy");
    const auto truth = numbersOf(vpApp::readFile(run.path("d/truth.csv")), heading);
    CHECK(heading == "frame,row,column,x,y,complete,defective");
    REQUIRE(motion.size() == 6);
    std::size_t line = 0;
    for (unsigned int frame = 0; frame < 6; ++frame) {
      const double phase = 2. * M_PI * frame / 8.;
      const double x = 10. + 3.5 * frame + 2. * std::sin(phase), y = 20. - 1. * frame + std::sin(phase);
      CHECK(motion[frame][0] == frame);
      CHECK(motion[frame][1] == Approx(x).margin(1e-6));
      CHECK(motion[frame][2] == Approx(y).margin(1e-6));
      CHECK(motion[frame][3] == Approx(frame > 0 ? x - motion[frame - 1][1] : 0.).margin(2e-6));
      CHECK(motion[frame][4] == Approx(frame > 0 ? y - motion[frame - 1][2] : 0.).margin(2e-6));
      for (const vpPatternTruthCell &cell : product.cells(x, y)) {
        REQUIRE(line < truth.size());
        const std::vector<double> &row = truth[line++];
        CHECK(row[0] == frame);
        CHECK(row[1] == cell.row);
        CHECK(row[2] == cell.column);
        CHECK(row[3] == Approx(cell.x).margin(1e-6));
        CHECK(row[4] == Approx(cell.y).margin(1e-6));
        CHECK((row[5] != 0.) == cell.complete);
        CHECK((row[6] != 0.) == cell.defective);
      }
      vpImage<unsigned char> expected;
      const double slope = 2. * M_PI / 8. * std::cos(phase);
      product.render(x, y, 3.5 + 2. * slope, -1. + slope, frame, expected);
      const cv::Mat found =
          cv::imread(run.path("d/frames/00000" + std::to_string(frame) + "." + format).string(), cv::IMREAD_UNCHANGED);
      REQUIRE(found.type() == CV_8UC1);
      REQUIRE(found.cols == 121);
      REQUIRE(found.rows == 100);
      CHECK(std::equal(found.begin<unsigned char>(), found.end<unsigned char>(), expected.bitmap));
    }
    CHECK(line == truth.size());
  }
  CHECK_FALSE(std::filesystem::exists(run.path("d/frames/000000.png"))); // file of the earlier run
}

TEST_CASE("A written configuration makes the same sequence again", "[visp-generate-pattern]")
{
  ProgramRun run(GENERATE_PATTERN);
  REQUIRE(run("--config '" VISP_DIRECT_DATA_DIR
              "/pattern/oled.json' --frames 5 --noise 2 --video --width 101 --height 81 --out a") == OK);
  const json config = json::parse(vpApp::readFile(run.path("a/config.json")));
  CHECK(config["frames"] == 5); // the option overrides the file
  CHECK(config["camera"]["noise"] == 2.);
  CHECK(config["cells"]["rotation_deg"].get<double>() == Approx(1.5));
  CHECK(std::filesystem::file_size(run.path("a/video.mp4")) > 500);
  REQUIRE(run("--config a/config.json --out b") == OK);
  for (const char *name : {"truth.csv", "motion.csv", "config.json", "frames/000000.png", "frames/000004.png"}) {
    CHECK(vpApp::readFile(run.path(std::string("a/") + name)) == vpApp::readFile(run.path(std::string("b/") + name)));
  }
}

TEST_CASE("Bad use ends with a sentence and nothing written", "[visp-generate-pattern]")
{
  ProgramRun run(GENERATE_PATTERN);
  run.write("bad.json", R"({"cells": {"opening_x": 60}})");
  run.write("cut.json", R"({"cells": {)");
  std::filesystem::create_directory(run.path("mine"));
  run.write("mine/notes.txt", "precious");
  struct Case {
    std::string arguments;
    int status;
    std::string sentence;
  };
  const std::vector<Case> cases = {
      {"--nonsense", USAGE, "--nonsense"},
      {"extra", USAGE, "extra"},
      {"--pitch-x -5", USAGE, "--pitch-x is -5 px, must be 2..100000"},
      {"--width -5", USAGE, "--width is -5, must be a whole number from 0 to 4294967295"},
      {"--width 7", USAGE, "--width is 7 px, must be 8..16384"},
      {"--dust nan", USAGE, "--dust is nan, must be a number"},
      {"--shape star", USAGE, "--shape is star, must be rectangle, rounded or dot"},
      {"--rotation 300", USAGE, "--rotation is 300, must be a number >= -180 and <= 180"},
      {"--frames 0", USAGE, "--frames is 0, must be a whole number from 1 to 1000000"},
      {"--motion 3", USAGE, "--motion"},
      {"--motion 1e9 0", USAGE, "--motion is 1e+09 0 px/frame, must keep the product within 1e8 px"},
      {"--swing-period 1", USAGE, "--swing-period is 1 frames, must be 2..1e9"},
      {"--format gif", USAGE, "--format is gif, must be png or pgm"},
      {"--video-rate 0", USAGE, "--video-rate is 0"},
      {"--out ''", USAGE, "--out"},
      {"--config none.json", DATA, "none.json: cannot be read"},
      {"--config bad.json", DATA, "bad.json: cells.opening_x is 60 px, must be < 48.88889 px"},
      {"--config cut.json", DATA, "cut.json: line 1, column"},
      {"--out mine", DATA, "mine: is not empty and not a result of visp-generate-pattern"},
      {"--out bad.json", DATA, "bad.json: exists and is not a folder"},
      {"--out /proc/none/out", DATA, "/proc/none/out: cannot be written"},
  };
  for (const Case &bad : cases) {
    CAPTURE(bad.arguments);
    CHECK(run(bad.arguments) == bad.status);
    CAPTURE(run.err());
    CHECK(run.err().find("visp-generate-pattern: ") == 0);
    CHECK(run.err().find(bad.sentence) != std::string::npos);
    CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
    CHECK(run.out().empty());
    CHECK(run.entries().size() == 3);
  }
  CHECK(vpApp::readFile(run.path("mine/notes.txt")) == "precious");
  CHECK(run("--help") == OK);
  CHECK(run.out().find("--flex-amplitude-x") != std::string::npos);
  CHECK(run("--version") == OK);
}
