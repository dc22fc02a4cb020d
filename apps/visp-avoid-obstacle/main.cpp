/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-avoid-obstacle: an arm avoids what its eye-in-hand camera sees, from image to joints, with a report.
#include "film.h"
#include "options.h"
#include "replicas.h"
#include "results.h"

#include "appMain.h"
#include "outputFolder.h"
#include "report.h"
#include "robot.h"
#include "viewData.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>

#include <chrono>
#include <iostream>
#include <memory>

namespace
{
using namespace avoidObstacle;
using Clock = std::chrono::steady_clock;

void printList()
{
  std::cout << "Methods (--method):\n";
  for (const std::string &name : vpAvoidanceMethodNames()) {
    std::cout << "  " << name << ": " << vpAvoidanceMethodMessage(name) << "\n";
  }
  std::cout << "Replicas (--replica):\n";
  for (const std::string &name : replicaNames()) {
    std::cout << "  " << name << ": " << replicaTitle(name) << "\n";
  }
}

//! Lets the report be made, and prints the findings.
void finish(vpApp::OutputFolder &out, const nlohmann::ordered_json &summary)
{
  const std::string made = vpApp::finishWithReport(out, summary);
  for (const nlohmann::ordered_json &sentence : summary.at("findings")) {
    std::cout << sentence.get<std::string>() << "\n";
  }
  std::cout << made << std::endl;
}

void writeJson(vpApp::OutputFolder &out, const std::string &name, const nlohmann::ordered_json &json)
{
  out.write(name, json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

//! The obstacles as they were, and as the track table had them in the end.
void writeScene(vpApp::OutputFolder &out, const Episode &episode)
{
  nlohmann::ordered_json scene =
      vpApp::sceneData(out, episode.run.spec, episode.run.samples.back().time, "mesh/object-");
  scene["believed"] = nlohmann::ordered_json::array();
  for (const vpCollisionObject &object : believedAt(episode, episode.run.samples.back().time)) {
    scene["believed"].push_back(
        vpApp::objectData(out, object, "mesh/believed-" + std::to_string(scene["believed"].size())));
  }
  writeJson(out, "scene.json", scene);
}

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void repeat(const Options &options, const std::string &commandLine)
{
  const auto start = Clock::now();
  vpApp::OutputFolder out("visp-avoid-obstacle", options.out);
  const Replica replica = playReplica(options);
  for (const auto &[name, content] : replica.tables) {
    out.write(name, content);
  }
  if (replica.run) {
    vpApp::writeArm(out, *replica.run->spec.arm);
    const double end = replica.run->samples.back().time;
    writeJson(out, "scene.json", vpApp::sceneData(out, replica.run->spec, end, "mesh/object-"));
  }
  finish(out, summaryOf(replica, options, commandLine, secondsSince(start)));
}

//! An arm without masses has ideal drives. \throw std::runtime_error if the user wants others.
void chooseDrives(Options &options, PhotoScene &scene)
{
  if (options.friction <= 0. || scene.arm->hasMasses()) {
    return;
  }
  const std::string unknown = scene.arm->label() + ": masses are unknown, ";
  if (options.frictionGiven) {
    throw std::runtime_error(unknown + "drives against friction need them, ideal ones (--friction 0) do not");
  }
  options.friction = 0.;
  scene.warnings.push_back(unknown + "the drives are ideal");
}

//! \return False when the moving arm hit something.
bool avoid(Options options, const std::string &commandLine)
{
  const auto start = Clock::now();
  PhotoScene scene = loadPhotoScene(options);
  chooseDrives(options, scene);
  vpApp::printWarnings("visp-avoid-obstacle", scene.warnings);
  const auto window = options.display ? std::make_unique<vpApp::PictureWindow>("visp-avoid-obstacle") : nullptr;
  vpApp::OutputFolder out("visp-avoid-obstacle", options.out);

  const Episode episode = play(scene, options);
  vpApp::writeArm(out, *scene.arm);
  writeScene(out, episode);
  out.write("samples.csv", vpApp::samplesCsv(episode.run));
  out.write("tracks.csv", tracksCsv(episode.sensorLog));
  out.write("frames.csv", framesCsv(episode.sensorLog));
  writeViews(out, episode.sensorLog.frames);
  nlohmann::ordered_json summary = summaryOf(scene, options, episode, commandLine);
  if (options.record || window) {
    const bool forBrowsers = makeFilm(episode, options.record ? out.file("video.mp4") : "", window.get());
    if (options.record) {
      summary["video"] = {{"file", "video.mp4"}, {"for_browsers", forBrowsers}};
    }
  }
  summary["wall_time_s"] = secondsSince(start);
  finish(out, summary);
  return episode.run.metrics.collisions_moving == 0;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runMain("visp-avoid-obstacle", [&]() -> int {
    Options options;
    if (!readOptions(argc, argv, options)) {
      return vpApp::ExitOk;
    }
    if (options.list) {
      printList();
      return vpApp::ExitOk;
    }
    const std::string commandLine = vpApp::commandLine("visp-avoid-obstacle", argc, argv);
    if (!options.replica.empty()) {
      repeat(options, commandLine);
      return vpApp::ExitOk;
    }
    return avoid(options, commandLine) ? vpApp::ExitOk : ExitHit;
  });
}
