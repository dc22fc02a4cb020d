/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-print-pattern: prints drops on a moving, flexible product, in a closed loop with the camera.
#include "explore/explorationProgram.h"
#include "ranks.h"
#include "options.h"
#include "pictures.h"
#include "tables.h"

#include "appMain.h"
#include "outputFolder.h"
#include "report.h"

#include <chrono>
#include <iostream>

namespace
{
using namespace printPattern;

//! The first run of each experiment, and figures 7.10 and 7.11.
void writeThesis(vpApp::OutputFolder &out, const Results &results)
{
  std::size_t number = 0;
  for (const auto *list : {&results.replicas, &results.observers}) {
    for (const Replica &replica : *list) {
      out.write(fileOf(replica, number++), motionCsv(replica.runs.front()));
    }
  }
  out.write("thesis/figure-7.10.csv", distortionCsv());
  out.write("thesis/figure-7.11.png", pngOf(detection(vpPrintExperimentSpec::thesisPid())));
}

void print(const Options &options, const std::string &commandLine)
{
  const auto start = std::chrono::steady_clock::now();
  vpApp::OutputFolder out("visp-print-pattern", options.out);
  const Results results = runAll(options);
  const vpPrintRun &run = results.runs.front();
  out.write("product.png", pngOf(printedProduct(run)));
  if (options.replicas) {
    writeThesis(out, results);
  }
  if (options.video) {
    writeVideo(run, out.file("camera.mp4"));
  }
  out.write("motion.csv", motionCsv(run));
  out.write("drops.csv", dropsCsv(run));
  out.write("landing.csv", landingCsv(results.landing));
  const double wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string made = vpApp::finishWithReport(out, summaryOf(options, results, commandLine, wallTime));
  for (const std::string &line : findings(results)) {
    std::cout << line << "\n";
  }
  std::cout << made << std::endl;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runRanks("visp-print-pattern", [&](const vpApp::Ranks &ranks) {
    Options options;
    const std::string command = vpApp::commandLine("visp-print-pattern", argc, argv);
    if (!vpApp::readOnFirst(ranks, [&] { return readOptions(argc, argv, options); })) {
      return;
    }
    if (options.explore.empty()) {
      if (ranks.size() > 1) {
        throw vpApp::UsageError("mpirun started " + std::to_string(ranks.size()) +
                                " processes, which only --explore can use");
      }
      print(options, command);
      return;
    }
    printExplore::exploreFile(options.explore, options.out, options.jobs, command, ranks);
  });
}
