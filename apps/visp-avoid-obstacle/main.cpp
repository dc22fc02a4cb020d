/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-avoid-obstacle: an arm avoids what its eye-in-hand camera sees, from image to joints, with a report.
#include "film.h"
#include "options.h"
#include "replicas.h"
#include "reportPage.h"
#include "results.h"

#include "appMain.h"
#include "outputFolder.h"
#include "plot.h"
#include "robot.h"

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

std::vector<Figure> drawAll(const PhotoScene &scene, const Options &options, const Episode &episode)
{
  const std::string title = scene.name + ", " + options.method;
  return {drawWay(episode.run, title, believedAt(episode, episode.run.samples.back().time)),
          animate(episode.run, title), drawViews(episode), drawTracks(scene, episode), drawTimes(episode.run)};
}

//! Writes figures, page and summary, and prints the findings.
void finish(vpApp::OutputFolder &out, const std::vector<Figure> &figures, const std::string &page,
            const nlohmann::ordered_json &summary, const std::vector<std::string> &findings)
{
  for (const Figure &figure : figures) {
    if (!figure.svg.empty()) {
      out.write("figure/" + figure.name + ".svg", figure.svg);
    }
  }
  out.write("report.html", page);
  out.writeSummary(summary);
  vpApp::throwIfInterrupted();
  out.commit();
  for (const std::string &sentence : findings) {
    std::cout << sentence << "\n";
  }
  std::cout << "Report: " << (out.path() / "report.html").string() << std::endl;
}

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void repeat(const Options &options, const std::string &commandLine)
{
  const auto start = Clock::now();
  vpApp::requireGnuplot();
  vpApp::OutputFolder out("visp-avoid-obstacle", options.out);
  const Replica replica = playReplica(options);
  for (const auto &[name, content] : replica.tables) {
    out.write(name, content);
  }
  const std::string page = replicaPage(replica, commandLine);
  finish(out, replica.figures, page, summaryOf(replica, options, commandLine, secondsSince(start)), replica.findings);
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
  vpApp::requireGnuplot();
  const auto window = options.display ? std::make_unique<vpApp::PictureWindow>("visp-avoid-obstacle") : nullptr;
  vpApp::OutputFolder out("visp-avoid-obstacle", options.out);

  const Episode episode = play(scene, options);
  out.write("samples.csv", samplesCsv(episode.run));
  out.write("tracks.csv", tracksCsv(episode.sensorLog));
  out.write("frames.csv", framesCsv(episode.sensorLog));
  FilmFile film;
  if (options.record || window) {
    film.name = options.record ? "video.mp4" : "";
    film.forBrowsers = makeFilm(episode, options.record ? out.file(film.name) : "", window.get());
    film.bytes = options.record ? vpApp::readFile(out.file(film.name)) : "";
  }
  const std::vector<Figure> figures = drawAll(scene, options, episode);
  const std::string page = reportPage(scene, options, episode, figures, film, commandLine);
  finish(out, figures, page, summaryOf(scene, options, episode, commandLine, secondsSince(start)),
         findingsOf(scene, options, episode));
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
