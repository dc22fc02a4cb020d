/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The program as run by users: exit status, output streams, written files.
#include "trackPatternRun.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

using namespace trackPatternRun;

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
  double sum = 0., truth = 0.;
  for (std::size_t i = 1; i < motion.lines.size(); ++i) {
    sum += number(motion.lines[i], "dx");
    truth += number(motion.lines[i], "true_dx");
  }
  const std::size_t moved = run.out().find("\nIt moved by +");
  REQUIRE(moved != std::string::npos);
  double meanX = 0., meanY = 0., allX = 0., allY = 0., sigmaX = 0., sigmaY = 0.;
  REQUIRE(std::sscanf(
              run.out().c_str() + moved,
              "\nIt moved by %lf px in x and %lf px in y from image to image (mean of 129), by %lf and %lf px in all "
              "(standard deviations of at most %lf and %lf px).",
              &meanX, &meanY, &allX, &allY, &sigmaX, &sigmaY) == 6);
  CHECK(allX == Approx(sum).margin(0.01));
  CHECK(meanX == Approx(sum / 129.).margin(0.001));
  CHECK(std::abs(allX - truth) < 4. * sigmaX + 0.01);
  CHECK(sigmaX > 0.);
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

TEST_CASE("Videos and colour images are read", "[visp-track-pattern]")
{
  ProgramRun run(TRACK_PATTERN);
  generate(run, "--noise 1 --frames 80 --motion 3 0 --video --out d");
  REQUIRE(run("d/video.mp4 --overlay none --out t") == OK);
  const json summary = summaryIn(run, "t");
  CHECK(summary["images"] == 80);
  CHECK(summary["images_by_status"]["lost"] == 0);
  CHECK(summary["lattice"]["column_pitch_px"].get<double>() == Approx(220. / 4.5).epsilon(0.01));
  CHECK(run.out().find("d/video.mp4 is compressed between images (") != std::string::npos);
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
  CHECK(run.out().find("No pattern was found in the image. The tracker says: No lock: ") == 0);
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
