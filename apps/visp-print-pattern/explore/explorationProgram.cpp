/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "explorationProgram.h"

#include "explorationPage.h"
#include "explorationPlots.h"
#include "findings.h"
#include "outcomeText.h"
#include "setupReader.h"

#include "appMain.h"
#include "outputFolder.h"
#include "plot.h"

#include "vpFileText.h"

#include <chrono>
#include <iostream>
#include <memory>

namespace printExplore
{
namespace
{
nlohmann::ordered_json frontOf(const Setup &setup, const Exploration &result)
{
  nlohmann::ordered_json designs = nlohmann::ordered_json::array();
  for (const std::size_t index : result.front) {
    nlohmann::ordered_json design = {{"design", index}};
    design.update(jsonOf(result.outcomes[index]));
    designs.push_back(design);
  }
  return {{"name", setup.name}, {"objectives", setup.objectives}, {"front", designs}};
}

void writeResult(vpApp::OutputFolder &out, const Setup &setup, const Exploration &result,
                 const std::string &commandLine, double wallTime)
{
  const std::vector<Plotted> plots = explorationPlots(setup, result);
  for (const Plotted &plot : plots) {
    out.write("figure/" + plot.name + ".svg", plot.svg);
  }
  out.write("explore.csv", exploreCsv(result, false));
  out.write("front.csv", exploreCsv(result, true));
  out.write("front.json", frontOf(setup, result).dump(2) + "\n");
  out.write("report.html", explorationPage(setup, result, plots, commandLine));
  out.writeSummary(summaryOf(setup, result, commandLine, wallTime));
  vpApp::throwIfInterrupted();
  out.commit();
  for (const std::string &sentence : findingsOf(setup, result)) {
    std::cout << sentence << "\n";
  }
  std::cout << (out.path() / "report.html").string() << std::endl;
}
} // namespace

void exploreFile(const std::string &file, const std::string &out, unsigned int jobs, const std::string &commandLine,
                 const vpApp::Ranks &ranks)
{
  const auto start = std::chrono::steady_clock::now();
  std::string text;
  std::unique_ptr<vpApp::OutputFolder> folder;
  if (ranks.isFirst()) {
    vpApp::requireGnuplot();
    text = vpReadFileText(file);
    static_cast<void>(readSetup(text, file)); // complains before the others wait for work
    folder = std::make_unique<vpApp::OutputFolder>("visp-print-pattern", out);
  }
  const Setup setup = readSetup(ranks.broadcast(text), file);
  const Exploration result = explore(setup, ranks, jobs);
  if (folder) {
    const double wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    writeResult(*folder, setup, result, commandLine, wallTime);
  }
}
} // namespace printExplore
