/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-plan-compare: avoidance methods for an arm on the same scenes, with a report.
#include "resultFiles.h"

#include "appMain.h"
#include "numberText.h"
#include "outputFolder.h"
#include "report.h"
#include "robot.h"
#include "runData.h"
#include "viewData.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>

namespace
{
using namespace planCompare;

void printList()
{
  std::cout << "Methods (--method):\n";
  for (const std::string &id : vpAvoidanceMethodNames()) {
    std::cout << "  " << id << ": " << methodInfo(id).sentence << "\n";
  }
  std::cout << "Scenes (--scene), seeds by default and with --quick:\n";
  for (const SceneInfo &scene : standardScenes()) {
    std::cout << "  " << scene.id << " (" << scene.seeds << ", " << scene.quick << "): " << scene.sentence << "\n";
  }
  std::cout << "  S5: " << selfMotionSentence() << "\n";
}

void writeTables(vpApp::OutputFolder &out, const Plan &plan, const Results &results, const Extras &extras)
{
  out.write("runs.csv", runsCsv(results));
  if (!extras.selfMotion.empty()) {
    out.write("self-motion.csv", selfMotionCsv(extras.selfMotion));
  }
  vpApp::writeArm(out, *plan.arm);
  std::map<std::string, double> ends; // of the longest run of each scene, s
  for (std::size_t i = 0; i < results.shown.size(); ++i) {
    double &end = ends[results.shownScenes[i]];
    end = std::max(end, results.shown[i].samples.back().time);
    out.write(logName(results.shownScenes[i], results.shown[i].spec.method), vpApp::samplesCsv(results.shown[i]));
  }
  for (const auto &[scene, end] : ends) { // the same for all methods
    const vpAvoidanceRunSpec &spec = results.find(scene, plan.methods.front())->spec;
    const nlohmann::ordered_json data = vpApp::sceneData(out, spec, end, "mesh/" + vpApp::fileName(scene) + "-object-");
    out.write(sceneName(scene), data.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
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
  vpApp::OutputFolder out("visp-plan-compare", options.out);

  const Results results = runAll(plan, ranks, options.jobs);
  Extras extras;
  extras.validators = compareValidators(plan);
  extras.selfMotion = runSelfMotion(plan);
  extras.commandLine = commandLine;
  writeTables(out, plan, results, extras);
  for (const SceneInfo &scene : plan.scenes) {
    out.write("arena/" + vpApp::fileName(scene.id) + ".log", arenaLog(plan, results, scene, startedAt));
  }
  extras.wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const nlohmann::ordered_json summary = summaryOf(plan, results, extras);
  const std::string made = vpApp::finishWithReport(out, summary);
  for (const nlohmann::ordered_json &sentence : summary.at("answer")) {
    std::cout << sentence.get<std::string>() << "\n";
  }
  std::cout << made << std::endl;
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
