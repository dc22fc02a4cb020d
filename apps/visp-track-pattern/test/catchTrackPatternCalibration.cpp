/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Calibrations by the program: of the product itself and of grids of dots.
#include "vpCaseFile.h"

#include "trackPatternRun.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <filesystem>

using namespace trackPatternRun;

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
