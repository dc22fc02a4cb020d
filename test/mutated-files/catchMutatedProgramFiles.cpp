/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Damaged files of every format that the programs read are refused in a sentence, or read, in a bounded time.
#include "vpCatch.h"

#include "fileMutator.h"
#include "testFolder.h"

#include "appMain.h"
#include "calibration.h"
#include "design.h"
#include "greyPicture.h"
#include "lineReader.h"
#include "outputFolder.h"
#include "problemLine.h"
#include "goal.h"
#include "recorded.h"
#include "quietLibraries.h"
#include "scenario.h"
#include "task.h"
#include "truth.h"

#include <nlohmann/json.hpp>

#include <opencv2/imgcodecs.hpp>

#include <iostream>

namespace
{
const std::string data = VISP_DIRECT_DATA_DIR;

void tell(const char *format, const MutationCount &count)
{
  std::cout << format << ": " << count.accepted << " damaged files accepted, " << count.refused << " refused\n";
  CHECK(count.accepted > 0);
  CHECK(count.refused > count.accepted / 10);
}

//! The sentence as the programs print it.
MutationCount readMutatedAsPrinted(const std::vector<std::string> &files, const std::string &extension,
                                   const std::function<void(const std::string &)> &read)
{
  return readMutated(files, extension, mutationCount(400), [&](const std::string &file) {
    try {
      read(file);
    }
    catch (const std::bad_alloc &) {
      throw;
    }
    catch (const std::exception &error) {
      throw std::runtime_error(vpApp::sentenceOf(error));
    }
  });
}
} // namespace

TEST_CASE("Damaged lines of problems", "[files][mutated]")
{
  tell("problems.jsonl",
       readMutatedAsPrinted({data + "/trajectory/examples.jsonl", data + "/trajectory/figure-6.3.jsonl"}, ".jsonl",
                            [](const std::string &file) {
                              vpApp::LineReader lines(file);
                              std::size_t number = 0;
                              for (std::string line; lines.next(line);) {
                                ++number;
                                static_cast<void>(
                                    planTrajectory::readProblem(line, file + ":" + std::to_string(number), number));
                              }
                            }));
}

TEST_CASE("Damaged descriptions of products, tasks and explorations", "[files][mutated]")
{
  tell("pattern.json", readMutatedAsPrinted({data + "/pattern/oled.json"}, ".json", [](const std::string &file) {
         static_cast<void>(generatePattern::readTask(file));
       }));
  tell("scenario.json",
       readMutatedAsPrinted({data + "/scenario/thesis-5.4.json", data + "/scenario/inspection.json"}, ".json",
                            [](const std::string &file) { static_cast<void>(servoCompare::readScenario(file)); }));
  tell("explore.json", readMutatedAsPrinted({data + "/explore/camera.json", data + "/explore/wide.json"}, ".json",
                                            [](const std::string &file) {
                                              static_cast<void>(printExplore::readSetup(vpApp::readFile(file), file));
                                            }));
}

TEST_CASE("Damaged goals and recordings of visp-servo", "[files][mutated]")
{
  const TestFolder folder, damaged;
  const std::string goal = folder.write(
      "goal.json",
      "{\"position_m\": [0.01, 0, 0.3], \"rotation_deg\": [1, 2, 3], \"position_spread_m\": 1e-6, \"images\": 25}");
  tell("goal.json", readMutatedAsPrinted({goal}, ".json", [](const std::string &file) {
         static_cast<void>(visualServo::readGoal(file));
       }));
  // The readers take folders.
  const auto tellOf = [&](const std::string &name, const std::string &content, const std::function<void()> &read) {
    tell(name.c_str(),
         readMutatedAsPrinted({folder.write(name, content)}, std::filesystem::path(name).extension().string(),
                              [&](const std::string &file) {
                                std::filesystem::copy_file(file, damaged.path / name,
                                                           std::filesystem::copy_options::overwrite_existing);
                                try {
                                  read();
                                }
                                catch (const std::exception &error) { // the folder's file, not the copy
                                  std::string sentence = error.what();
                                  const std::string place = damaged.file(name);
                                  const std::size_t at = sentence.find(place);
                                  throw std::runtime_error(
                                      at == std::string::npos ? sentence : sentence.replace(at, place.size(), file));
                                }
                              }));
  };
  tellOf("recording.json", "{\"settings\": [\"--law\", \"pbvs1\", \"--lambda\", \"2\"]}",
         [&] { static_cast<void>(visualServo::readSettings(damaged.path)); });
  std::string heading = "time_s,status,position_error_m,rotation_error_rad";
  for (const char *name :
       {"fMc_tx", "fMc_ty", "fMc_tz", "fMc_tux", "fMc_tuy", "fMc_tuz", "v_x", "v_y", "v_z", "v_wx", "v_wy", "v_wz"}) {
    heading += std::string(",") + name;
  }
  tellOf("log.csv",
         heading + "\n0,Idle,,,1,2,3,0.1,0.2,0.3,0,0,0,0,0,0\n0.01,Servoing,0.1,0.2,1,2,3,0.1,0.2,0.3,1,0,0,0,0,0\n",
         [&] { visualServo::readCycles(damaged.path, [](const visualServo::RecordedCycle &) {}); });
  tellOf("images.csv",
         "image,number,capture_s,seen_s,found,cMo_tx,cMo_ty,cMo_tz,cMo_tux,cMo_tuy,cMo_tuz,message\n0,0,0.1,0.2,1,1,2,"
         "3,0.1,0.2,0.3,\"a\"\n",
         [&] { static_cast<void>(visualServo::readImages(damaged.path)); });
}

TEST_CASE("Damaged calibrations and truth", "[files][mutated]")
{
  const TestFolder folder;
  const std::string calibration = folder.write(
      "calibration.json", R"({"comment": "x", "width": 640, "height": 480, "scale_x_px_per_m": 2e5, "rotation_deg": 3,
                              "mirrored": false, "tx_m": 0.1, "kappa1_per_px2": 1e-9, "u0_px": 320, "quality": {"a": [1]}})");
  tell("calibration.json", readMutatedAsPrinted({calibration}, ".json", [](const std::string &file) {
         static_cast<void>(trackPattern::readCalibration(file, "microscope", 640, 480));
       }));
  const std::string truth = folder.write(
      "truth.csv",
      "frame,row,column,x,y,complete,defective\n0,0,0,10.5,11,1,0\n0,0,1,60,11.25,1,0\n1,0,0,15.5,11,1,1\n");
  const TestFolder damaged;
  damaged.write("motion.csv", "frame,x,y,dx,dy\n0,0,0,0,0\n1,5,0,5,0\n");
  tell("truth.csv", readMutatedAsPrinted({truth}, ".csv", [&](const std::string &file) {
         std::filesystem::copy_file(file, damaged.path / "truth.csv",
                                    std::filesystem::copy_options::overwrite_existing);
         try {
           static_cast<void>(trackPattern::TruthFiles(damaged.path));
         }
         catch (const std::exception &error) {
           throw std::runtime_error(file + " as " + error.what());
         }
       }));
}

TEST_CASE("Damaged motions beside the truth", "[files][mutated]")
{
  const TestFolder folder, damaged;
  const std::string motion =
      folder.write("motion.csv", "frame,x,y,dx,dy\n0,0,0,0,0\n1,5,0,5,0\n2,10.5,0.25,5.5,0.25\n");
  damaged.write("truth.csv", "frame,row,column,x,y,complete,defective\n0,0,0,10.5,11,1,0\n");
  tell("motion.csv", readMutatedAsPrinted({motion}, ".csv", [&](const std::string &file) {
         std::filesystem::copy_file(file, damaged.path / "motion.csv",
                                    std::filesystem::copy_options::overwrite_existing);
         try {
           static_cast<void>(trackPattern::TruthFiles(damaged.path));
         }
         catch (const std::exception &error) {
           throw std::runtime_error(file + " as " + error.what());
         }
       }));
}

TEST_CASE("Damaged pictures", "[files][mutated]")
{
  const TestFolder folder;
  cv::Mat picture(24, 40, CV_8UC3);
  cv::randu(picture, 0, 255);
  for (const char *extension : {".png", ".pgm", ".ppm", ".bmp", ".jpg", ".tif", ".webp"}) {
    const std::string file = folder.file(std::string("good") + extension);
    if (!cv::haveImageWriter(file)) {
      std::cout << extension << ": not known to this OpenCV\n";
      continue;
    }
    cv::Mat one;
    cv::extractChannel(picture, one, 0);
    REQUIRE(cv::imwrite(file, std::string(extension) == ".pgm" ? one : picture));
    const vpApp::QuietLibraries quiet;
    const MutationCount count = readMutatedAsPrinted({file}, extension, [](const std::string &name) {
      vpPictures::GreyScale scale;
      vpPictures::File pictures(name);
      for (std::size_t page = 0; page < pictures.pages(); ++page) {
        static_cast<void>(scale.toGrey(pictures.read(page), pictures.white(), name));
      }
    });
    std::cout << extension << ": " << count.accepted << " damaged files accepted, " << count.refused << " refused\n";
    CHECK(count.refused > 0); // checksums of PNG refuse nearly all
  }
}

TEST_CASE("Damaged summaries of the result before", "[files][mutated]")
{
  const TestFolder folder;
  const std::string good = folder.write(
      "good.json", R"({"program": "visp-x", "status": "complete", "files": ["a.txt", "b/c.txt", "summary.json"]})");
  folder.write("mine.txt", "mine");
  tell("summary.json", readMutatedAsPrinted({good}, ".json", [&](const std::string &file) {
         std::filesystem::remove_all(folder.path / "out");
         folder.write("out/a.txt", "old");
         folder.write("out/b/c.txt", "old");
         std::filesystem::copy_file(file, folder.path / "out/summary.json");
         try {
           vpApp::OutputFolder out("visp-x", folder.file("out"));
           out.write("new.txt", "new");
           out.writeSummary(nlohmann::ordered_json::object());
           out.commit();
         }
         catch (const std::exception &error) {
           throw std::runtime_error(file + " as " + error.what());
         }
         if (vpApp::readFile(folder.path / "mine.txt") != "mine" || !std::filesystem::exists(good)) {
           throw std::runtime_error("a file outside of the result folder is gone");
         }
       }));
}
