/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts: truth, calibrations as files, comparison, tables.
#include "vpCatch.h"

#include "calibration.h"
#include "findings.h"
#include "testFolder.h"
#include "truth.h"

#include <cmath>
#include <filesystem>

namespace
{
using namespace trackPattern;
} // namespace

TEST_CASE("a calibration survives its file", "[visp-track-pattern]")
{
  auto rng = vpTestSupport::generator(1);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> unit(-1., 1.);
  vpMicroscopeCalibrationResult result;
  vpMicroscopeCalibration &c = result.calibration;
  c.width = 640;
  c.height = 480;
  c.scaleX = 2e5 + unit(rng);
  c.scaleY = 2e5 + unit(rng);
  c.rotation = unit(rng);
  c.mirrored = true;
  c.tx = 1e-3 * unit(rng);
  c.ty = 1e-3 * unit(rng);
  c.kappa1 = 1e-8 * unit(rng);
  c.u0 = 300.;
  c.v0 = 200.;
  result.covariance.setIdentity();
  result.message = "The scale is so.";
  const TestFolder folder;
  folder.write("c.json", jsonOf(result, 3).dump());
  const vpMicroscopeCalibration again = readCalibration(folder.file("c.json"), "", 640, 480);
  for (const double u : {0., 320., 639.}) {
    CHECK((again.toPlane(u, 0.5 * u) - c.toPlane(u, 0.5 * u)).norm() < 1e-15);
  }
  CHECK(again.mirrored);
  c.saveXml(folder.file("c.xml"));
  CHECK(readCalibration(folder.file("c.xml"), "microscope", 640, 480).kappa1 == Approx(c.kappa1).epsilon(1e-6));

  const auto refused = [&](const std::string &content) {
    folder.write("bad.json", content);
    const std::string sentence =
        complaint([&] { static_cast<void>(readCalibration(folder.file("bad.json"), "", 640, 480)); });
    CHECK(sentence.find(folder.file("bad.json") + ": ") == 0);
    return sentence.substr(std::min(sentence.size(), folder.file("bad.json").size() + 2));
  };
  CHECK(refused("{}") == "scale_x_px_per_m is missing");
  CHECK(refused(R"({"scale_x_px_per_m": -1})") == "scale_x_px_per_m is -1.0, must be a number > 0");
  CHECK(refused(R"({"scale_x_px_per_m": 1, "kappa": 1})").find("unknown field kappa; known are ") == 0);
  CHECK(refused(R"({"scale_x_px_per_m": 1, "width": 160, "height": 100})") ==
        "is for images of 160 x 100 px, these have 640 x 480 px");
  CHECK(refused("{").find("line 1, column ") == 0);
  CHECK(complaint([&] {
          static_cast<void>(readCalibration(folder.file("c.xml"), "telescope", 640, 480));
        }).find("has no camera telescope") != std::string::npos);
}

TEST_CASE("truth files are read, or refused by file and line", "[visp-track-pattern]")
{
  const TestFolder folder;
  CHECK_FALSE(TruthFiles::areIn(folder.file("")));
  const std::string motion = "frame,x,y,dx,dy\n", truth = "frame,row,column,x,y,complete,defective\n";
  folder.write("motion.csv", motion + "7,1.5,-2,0,0\n");
  folder.write("truth.csv", truth + "7,3,-4,10.25,20.5,1,0\n7,3,-3,60,20,0,1\n");
  REQUIRE(TruthFiles::areIn(folder.file("")));
  const TruthFiles files(folder.file(""));
  REQUIRE(files.at(7));
  CHECK_FALSE(files.at(6));
  CHECK(files.at(7)->x == 1.5);
  REQUIRE(files.at(7)->cells.size() == 2);
  CHECK(files.at(7)->cells[0].column == -4);
  CHECK(files.at(7)->cells[0].complete);
  CHECK(files.at(7)->cells[1].defective);
  const auto refused = [&](const char *name, const std::string &content) {
    folder.write(name, content);
    return complaint([&] { const TruthFiles bad(folder.file("")); });
  };
  CHECK(refused("truth.csv", "a,b\n") ==
        folder.file("truth.csv") + ": begins with \"a,b\", must be \"frame,row,column,x,y,complete,defective\"");
  CHECK(refused("truth.csv", truth + "7,1,1,nan,3,1,1\n").find(folder.file("truth.csv") + ":2: is \"7,1,1,nan") == 0);
  CHECK(refused("truth.csv", truth + "7,1,1,2,3,1\n").find("must be 7 numbers") != std::string::npos);
  CHECK(refused("motion.csv", motion + "1,2,3,4,x\n").find("motion.csv:2: is \"1,2,3,4,x\"") != std::string::npos);
}

TEST_CASE("errors against the truth are those that were put in", "[visp-track-pattern]")
{
  auto rng = vpTestSupport::generator(2);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> normal;
  Comparison comparison;
  RunResults results;
  constexpr int frames = 400;
  for (int k = 0; k < frames; ++k) {
    FrameTruth truth;
    vpPatternFrame frame;
    frame.status = vpPatternStatus::Tracking;
    frame.lattice.columnPitchX = 40.;
    frame.lattice.rowPitchY = 20.;
    truth.x = 3. * k;
    truth.y = -k;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        vpPatternTruthCell place;
        place.row = row + 5;
        place.column = column - 9;
        place.x = 40. * column + 20.;
        place.y = 20. * row + 10.;
        truth.cells.push_back(place);
        vpPatternCell cell;
        cell.row = row;
        cell.column = column;
        cell.valid = true;
        cell.sigmaX = 0.02;
        cell.sigmaY = 0.01;
        cell.x = place.x - 7. + 0.1 + 0.02 * normal(rng); // 7, 3: corner of the region
        cell.y = place.y - 3. - 0.2 + 0.03 * normal(rng);
        frame.cells.push_back(cell);
      }
    }
    if (k == 10) {
      frame.cells[0].x += 3.;
      std::swap(frame.cells[3].row, frame.cells[4].column);
    }
    frame.hasMotion = true;
    frame.dx = 3. + 0.5;
    frame.dy = -1.;
    frame.sigmaDx = frame.sigmaDy = 0.1;
    FrameRecord record;
    comparison.add(frame, truth, 7., 3., record, results);
    CHECK((k == 0) == std::isnan(record.trueDx));
  }
  const TruthErrors &e = results.tracking;
  CHECK(results.hasTruth);
  CHECK(results.acquiring.x.n == 0);
  CHECK(e.x.n == frames * 9 - 1);
  CHECK(e.far == 1);
  CHECK(e.slips == 0); // a row and a column of the same number were swapped
  CHECK(e.x.mean() == Approx(0.1).margin(0.003));
  CHECK(e.y.mean() == Approx(-0.2).margin(0.003));
  CHECK(e.x.sigma() == Approx(0.02).epsilon(0.05));
  CHECK(e.y.sigma() == Approx(0.03).epsilon(0.05));
  CHECK(e.dx.n == frames - 1);
  CHECK(e.dx.mean() == Approx(0.5));
  CHECK(e.dx.normalisedRms() == Approx(5.));
}

TEST_CASE("views for a calibration are kept evenly, whatever the length", "[visp-track-pattern]")
{
  Options options;
  options.pitch = {220e-6, 80e-6, 0.};
  CalibrationRun run(options);
  vpPatternFrame frame;
  frame.status = vpPatternStatus::Tracking;
  for (int i = 0; i < 9; ++i) {
    vpPatternCell cell;
    cell.row = i / 3;
    cell.column = i % 3;
    cell.x = 48.8889 * cell.column;
    cell.y = 17.7778 * cell.row;
    cell.sigmaX = cell.sigmaY = 0.01;
    cell.valid = true;
    frame.cells.push_back(cell);
  }
  for (int k = 0; k < 5000; ++k) {
    run.add(vpImage<unsigned char>(), frame, 10., 20.);
    REQUIRE(run.viewCount() <= 200);
  }
  CHECK(run.viewCount() >= 100);
  const vpMicroscopeCalibrationResult result = run.compute(160, 100);
  CHECK(result.calibration.pixelSizeUm() == Approx(4.5).epsilon(1e-5));
  CHECK(result.calibration.toImage(0., 0.).x() == Approx(10.).margin(1e-4));
  CHECK(complaint([&] {
          static_cast<void>(CalibrationRun(options).compute(160, 100));
        }).find("--calibrate: in no image the product was tracked with at least 6 cells") == 0);
}

TEST_CASE("quantiles, and the table of deviations", "[visp-track-pattern]")
{
  CHECK(quantile({3., NAN, 1., 2.}, 0.5) == 2.);
  CHECK(quantile({3., 1., 2.}, 1.) == 3.);
  CHECK(quantile({10., 9., 8., 7., 6., 5., 4., 3., 2., 1.}, 0.5) == 5.5); // was 6
  CHECK(std::isnan(quantile({NAN}, 0.5)));
  RunResults results;
  results.deviations[{1U, -2, 3}] = {0.3, -0.4};
  results.deviations[{0U, 0, 0}] = {9., 9.};
  CHECK(deviationsCsv(results) == "epoch,row,column,x_px,y_px\n0,0,0,9.0000,9.0000\n1,-2,3,0.3000,-0.4000\n");
}
