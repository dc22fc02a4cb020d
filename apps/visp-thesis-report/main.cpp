/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-thesis-report: reproduces every result of the thesis, beside its value.
#include "results.h"

#include "report.h"
#include "appMain.h"
#include "commandLine.h"
#include "numberText.h"
#include "outputFolder.h"

#include <algorithm>
#include <chrono>
#include <iostream>

namespace
{
using namespace thesisReport;

constexpr const char *ABOUT =
    R"(Repeat the results of the thesis "Direct Methods for Vision-Based Robot Control" (R. Pieters, 2013) by simulation: every
figure and table with results of chapters 4 to 8 and appendix A. Each value of the thesis stands beside the median and spread
of ours over several seeds, with the tolerance, a verdict, and the reason where they differ. The result is a folder with
report.html (open it in a browser), results.json, and the curves of every figure as CSV.)";

constexpr const char *EXAMPLES = R"(Examples:
  visp-thesis-report
      everything with ten seeds, some ten minutes on 2 cores
  visp-thesis-report --seeds 1
      quicker, without the spread
  visp-thesis-report --only fig6.3,table4.3
      two of them
  visp-thesis-report --only chapter7
      a chapter
  mpirun -n 4 visp-thesis-report
      on 4 processes, on a cluster too
  visp-thesis-report --list
      what can be asked for

Exit status: 0 done (whatever the verdicts are), 1 the data or the disk do not allow it, 2 the command line is wrong.
Nothing is written unless all succeeded.)";

//! Ids of a user's choice: an id, "chapter6", or "appendixA".
std::vector<std::string> idsOf(const std::string &name)
{
  std::vector<std::string> ids, chapters;
  for (const Part &part : catalogue()) {
    for (const Entry &entry : part.entries) {
      if (entry.id == name || chapterName(part) == name) {
        ids.push_back(entry.id);
      }
    }
    if (std::find(chapters.begin(), chapters.end(), chapterName(part)) == chapters.end()) {
      chapters.push_back(chapterName(part));
    }
  }
  if (ids.empty()) {
    throw vpApp::UsageError("--only: there is no " + name + ", only " + vpApp::enumerate(allIds()) + "; and " +
                            vpApp::enumerate(chapters));
  }
  return ids;
}

/*!
 * Read the command line.
 * \return False when `--help` or `--version` was requested and printed.
 * \throw vpApp::UsageError naming the option and its value.
 */
bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-thesis-report", ABOUT, EXAMPLES);
  std::vector<std::string> only;
  line.group("Run");
  line.list("--only", only, "ID,...", "Only these figures, tables and chapters (default: all)");
  line.text("--out", options.out, "DIR", "Result folder");
  line.whole("--jobs", options.jobs, {1, 256}, "N", "Parts at a time (default: one for each core)");
  line.whole("--seed", options.seed, {0, 4e9}, "S", "First seed of everything random");
  line.whole("--seeds", options.seeds, {1, 200}, "N", "Seeds, for the spread of each value");
  line.flag("--list", options.list, "Name all figures and tables, and end");
  if (!line.parse(argc, argv)) {
    return false;
  }
  for (const std::string &name : only) {
    const std::vector<std::string> ids = idsOf(name);
    options.only.insert(options.only.end(), ids.begin(), ids.end());
  }
  if (options.only.empty()) {
    options.only = allIds();
  }
  return true;
}

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

void report(const Options &options, const std::string &commandLine, const vpApp::Ranks &ranks)
{
  const auto start = std::chrono::steady_clock::now();
  if (!ranks.isFirst()) {
    static_cast<void>(playAll(options, ranks));
    return;
  }
  vpApp::OutputFolder out("visp-thesis-report", options.out);
  const std::vector<Played> all = playAll(options, ranks);
  for (const Played &played : all) {
    for (const Item &item : played.items) {
      for (const Figure &figure : item.figures) {
        if (!figure.picture.empty()) {
          out.write(pictureFile(item, figure), figure.picture);
        }
      }
      for (const DataFile &file : item.data) {
        out.write("data/" + item.id + "-" + file.name, file.content);
      }
    }
  }
  const double wallTime = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.write("results.json", resultsJson(all).dump(2) + "\n");
  out.write("items.json", itemsJson(all).dump(2) + "\n");
  out.write("curves.csv", curvesCsv(all));
  const std::string where = vpApp::finishWithReport(out, summaryJson(all, options, commandLine, wallTime));
  for (const auto &count : countRows(all)) {
    std::cout << count.second << " " << vpToString(count.first) << ", ";
  }
  std::cout << "rows\n" << where << std::endl;
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
