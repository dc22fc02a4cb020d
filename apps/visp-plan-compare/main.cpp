/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-plan-compare: avoidance methods for an arm on the same scenes, with a report.
#include "figures.h"
#include "reportPage.h"
#include "resultFiles.h"

#include "appMain.h"
#include "numberText.h"
#include "outputFolder.h"
#include "plot.h"
#include "robot.h"

#include <chrono>
#include <iostream>

namespace
{
using namespace planCompare;

void printList()
{
  std::cout << "Methods (--method):\n";
  for (const std::string &id : vpAvoidanceMethodNames()) {
    const MethodInfo info = methodInfo(id);
    std::cout << "  " << info.number << " " << id << ": " << info.sentence << "\n";
  }
  std::cout << "Scenes (--scene), seeds by default and with --quick:\n";
  for (const SceneInfo &scene : standardScenes()) {
    std::cout << "  " << scene.id << " (" << scene.seeds << ", " << scene.quick << "): " << scene.sentence << "\n";
  }
  std::cout << "  S5: " << selfMotionSentence() << "\n";
}

void compare(const Options &options, const std::string &commandLine, const vpApp::Ranks &ranks)
{
  const auto start = std::chrono::steady_clock::now();
  const std::string startedAt = timeText();
  const Plan plan = makePlan(options);
  if (!ranks.isFirst()) {
    static_cast<void>(runAll(plan, ranks, options.jobs));
    return;
  }
  vpApp::printWarnings("visp-plan-compare", plan.remarks);
  vpApp::requireGnuplot();
  vpApp::OutputFolder out("visp-plan-compare", options.out);

  const Results results = runAll(plan, ranks, options.jobs);
  Extras extras;
  extras.validators = compareValidators(plan);
  extras.selfMotion = runSelfMotion(plan);
  extras.commandLine = commandLine;
  out.write("runs.csv", runsCsv(results));
  for (std::size_t i = 0; i < results.shown.size(); ++i) {
    out.write(logName(results.shownScenes[i], results.shown[i].spec.method), logCsv(results.shown[i]));
  }
  for (const SceneInfo &scene : plan.scenes) {
    out.write("arena/" + vpApp::fileName(scene.id) + ".log", arenaLog(plan, results, scene, startedAt));
  }
  const std::vector<Figure> figures = drawFigures(plan, results, extras.selfMotion, ranks.threads(options.jobs));
  for (const Figure &figure : figures) {
    if (!figure.svg.empty()) {
      out.write("figure/" + figure.name + ".svg", figure.svg);
    }
  }
  extras.wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.write("report.html", reportPage(plan, results, extras, figures));
  out.writeSummary(summaryOf(plan, results, extras));
  vpApp::throwIfInterrupted();
  out.commit();
  std::cout << "Report: " << (out.path() / "report.html").string() << std::endl;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runRanks("visp-plan-compare", [&](const vpApp::Ranks &ranks) {
    Options options;
    if (!vpApp::readOnFirst(ranks, [&] { return readOptions(argc, argv, options); })) {
      return;
    }
    if (!options.list) {
      compare(options, vpApp::commandLine("visp-plan-compare", argc, argv), ranks);
    }
    else if (ranks.isFirst()) {
      printList();
    }
  });
}
