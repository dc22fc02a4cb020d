/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-print-pattern: prints drops on a moving, flexible product, in a closed loop with the camera.
#include "explore/explorationProgram.h"
#include "ranks.h"
#include "options.h"
#include "pictures.h"
#include "reportPage.h"
#include "tables.h"

#include "appMain.h"
#include "outputFolder.h"
#include "plot.h"

#include <chrono>
#include <iostream>

namespace
{
using namespace printPattern;

void print(const Options &options, const std::string &commandLine)
{
  const auto start = std::chrono::steady_clock::now();
  vpApp::requireGnuplot();
  vpApp::OutputFolder out("visp-print-pattern", options.out);
  const Results results = runAll(options);
  const vpPrintRun &run = results.runs.front();
  ReportParts parts;
  parts.commandLine = commandLine;
  parts.own = ownFigures(results);
  parts.printed = pngOf(printedProduct(run));
  out.write("product.png", parts.printed);
  if (options.replicas) {
    parts.thesis = thesisFigures(results);
    parts.thesis.insert(parts.thesis.begin(), distortionFigure());
    parts.detection = pngOf(detection(vpPrintExperimentSpec::thesisPid()));
    out.write("figure/figure-7.11.png", parts.detection);
  }
  for (const auto *figures : {&parts.own, &parts.thesis}) {
    for (const Figure &figure : *figures) {
      out.write("figure/" + figure.name + ".svg", figure.svg);
    }
  }
  if (options.video) {
    parts.video = "camera.mp4";
    writeVideo(run, out.file(parts.video));
  }
  out.write("motion.csv", motionCsv(run));
  out.write("drops.csv", dropsCsv(run));
  out.write("report.html", reportPage(options, results, parts));
  const double wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.writeSummary(summaryOf(options, results, commandLine, wallTime));
  vpApp::throwIfInterrupted();
  out.commit();
  std::cout << sumOf(results.runs, &vpPrintMetrics::printed) << " cells printed, "
            << sumOf(results.runs, &vpPrintMetrics::missed) << " missed, "
            << sumOf(results.runs, &vpPrintMetrics::doubled) << " doubled: " << (out.path() / "report.html").string()
            << std::endl;
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
