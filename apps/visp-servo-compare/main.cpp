/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-servo-compare: all servo laws on one task, with a report.
#include "catalogue.h"
#include "options.h"
#include "replay.h"
#include "runLog.h"

#include "appMain.h"
#include "viewData.h"
#include "report.h"
#include "robot.h"

#include <visp3/feedforward/vpServoLaw.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include <unistd.h>

namespace
{
using namespace servoCompare;

void printList()
{
  std::cout
      << "Laws (--law), each but those that plan also with +cbf for the filter that keeps the object in the view:\n";
  for (const std::string &id : vpServoLaw::ids()) {
    std::cout << "  " << id << std::string(id.size() < 17 ? 17 - id.size() : 1, ' ') << sentenceOf(id) << "\n";
  }
  std::cout << "Plants (--plant):\n";
  for (const std::string &name : standardPlants()) {
    std::cout << "  " << name << "  " << sentenceOf(vpServoPlant::byName(name)) << "\n";
  }
}

//! The photo as a file readable by ViSP, whatever its original format.
std::string writeTarget(const Target &target, vpApp::OutputFolder &out)
{
  std::string file = out.file("target.png");
  const cv::Mat photo(target.photo.getHeight(), target.photo.getWidth(), CV_8UC1, target.photo.bitmap);
  if (!cv::imwrite(file, photo)) {
    throw std::runtime_error(file + ": cannot be written");
  }
  return file;
}

//! The share of a rank that does not write: its folder is gone with it.
void help(const Plan &plan, unsigned int jobs, const vpApp::Ranks &ranks)
{
  const auto name = "visp-servo-compare-" + std::to_string(ranks.rank()) + "-" + std::to_string(getpid());
  vpApp::OutputFolder out("visp-servo-compare", (std::filesystem::temp_directory_path() / name).string());
  static_cast<void>(runAll(plan, writeTarget(plan.target, out), ranks, jobs, [](const vpServoRun &) {}));
}

void compare(const Options &options, const std::string &commandLine, const vpApp::Ranks &ranks)
{
  const auto start = std::chrono::steady_clock::now();
  const Plan plan = makePlan(options);
  if (!ranks.isFirst()) {
    help(plan, options.jobs, ranks);
    return;
  }
  vpApp::printWarnings("visp-servo-compare", plan.remarks);
  const unsigned int threads = ranks.threads(options.jobs);
  std::unique_ptr<vpApp::PictureWindow> window;
  if (options.display) {
    window = std::make_unique<vpApp::PictureWindow>("visp-servo-compare: the camera's view");
  }
  vpApp::OutputFolder out("visp-servo-compare", options.out);

  const Results results = runAll(plan, writeTarget(plan.target, out), ranks, options.jobs,
                                 [&](const vpServoRun &run) { out.write(logName(run.spec), csvOf(run)); });
  if (plan.arm) {
    vpApp::writeArm(out, plan.arm->model);
  }
  const std::vector<ReplayVideo> videos = writeVideos(plan, results, out, threads, window.get());
  const FilmStrip strip = drawFilmStrip(plan, results);
  out.write("film-strip.jpg", strip.jpeg);
  const double wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string place =
      vpApp::finishWithReport(out, summaryOf(plan, results, {commandLine, wallTime, videos, strip}), false, true);
  if (!plan.target.remark.empty()) {
    std::cout << plan.target.file << ": " << plan.target.remark << "\n";
  }
  std::cout << place << std::endl;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runRanks("visp-servo-compare", [&](const vpApp::Ranks &ranks) {
    Options options;
    if (!vpApp::readOnFirst(ranks, [&] { return readOptions(argc, argv, options); })) {
      return;
    }
    if (!options.list) {
      compare(options, vpApp::commandLine("visp-servo-compare", argc, argv), ranks);
    }
    else if (ranks.isFirst()) {
      printList();
    }
  });
}
