/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-thesis-report: reproduces every result of the thesis, beside its value.
#include "options.h"
#include "reportPage.h"
#include "results.h"
#include "run.h"

#include "appMain.h"
#include "outputFolder.h"
#include "plot.h"

#include <chrono>
#include <iostream>

namespace
{
using namespace thesisReport;

void printList()
{
  std::string chapter;
  for (const Part &part : catalogue()) {
    if (part.chapter != chapter) {
      chapter = part.chapter;
      std::cout << part.chapter << " (--only " << chapterName(part) << ")\n";
    }
    for (const Entry &entry : part.entries) {
      std::cout << "  " << entry.id << ": " << entry.title << "\n";
    }
  }
}

std::string suffixOf(const std::string &mime)
{
  return mime == "image/png" ? ".png" : mime == "image/jpeg" ? ".jpg" : ".svg";
}

void report(const Options &options, const std::string &commandLine, const vpApp::Ranks &ranks)
{
  const auto start = std::chrono::steady_clock::now();
  vpApp::requireGnuplot();
  if (!ranks.isFirst()) {
    static_cast<void>(playAll(options, ranks));
    return;
  }
  vpApp::OutputFolder out("visp-thesis-report", options.out);
  const std::vector<Played> all = playAll(options, ranks);
  for (const Played &played : all) {
    for (const Item &item : played.items) {
      for (const Figure &figure : item.figures) {
        out.write("figure/" + item.id + "-" + figure.name + suffixOf(figure.mime), figure.picture);
      }
      for (const DataFile &file : item.data) {
        out.write("data/" + item.id + "-" + file.name, file.content);
      }
    }
  }
  const double wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.write("results.json", resultsJson(all).dump(2) + "\n");
  out.write("report.html", reportPage(all, commandLine, wallTime));
  out.writeSummary(summaryJson(all, options, commandLine, wallTime));
  vpApp::throwIfInterrupted();
  out.commit();
  for (const auto &count : countVerdicts(all)) {
    std::cout << count.second << " " << vpToString(count.first) << ", ";
  }
  std::cout << "report: " << (out.path() / "report.html").string() << std::endl;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runRanks("visp-thesis-report", [&](const vpApp::Ranks &ranks) {
    Options options;
    if (!vpApp::readOnFirst(ranks, [&] { return readOptions(argc, argv, options); })) {
      return;
    }
    if (!options.list) {
      report(options, vpApp::commandLine("visp-thesis-report", argc, argv), ranks);
    }
    else if (ranks.isFirst()) {
      printList();
    }
  });
}
