/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "part.h"

#include "appMain.h"
#include "commandLine.h"
#include "numberText.h"

#include <algorithm>

namespace thesisReport
{
namespace
{
constexpr const char *ABOUT =
    R"(Repeat the results of the thesis "Direct Methods for Vision-Based Robot Control" (R. Pieters, 2013) by simulation: every
figure and table with results of chapters 4 to 8 and appendix A. Each value of the thesis stands beside ours, with the
tolerance, a verdict, and the reason where they differ. The result is a folder with report.html (open it in a browser),
results.json, and the data behind every picture as CSV.)";

constexpr const char *EXAMPLES = R"(Examples:
  visp-thesis-report
      everything, some minutes on 2 cores
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
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-thesis-report", ABOUT, EXAMPLES);
  std::vector<std::string> only;
  line.list("--only", only, "ID,...", "Only these figures, tables and chapters (default: all)");
  line.text("--out", options.out, "DIR", "Result folder");
  line.whole("--jobs", options.jobs, {1, 256}, "N", "Parts at a time (default: one for each core)");
  line.whole("--seed", options.seed, {0, 4294967295.}, "S", "Seed of everything random");
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
} // namespace thesisReport
