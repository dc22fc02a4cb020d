/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "part.h"

#include "appMain.h"
#include "jobs.h"
#include "numberText.h"

#include <CLI/CLI.hpp>

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
  visp-thesis-report --list
      what can be asked for

Exit status: 0 done (whatever the verdicts are), 1 the data or the disk do not allow it, 2 the command line is wrong.
Nothing is written unless all succeeded.)";

constexpr std::size_t NAME_COLUMN = 22; // width, characters

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
  CLI::App app(ABOUT, "visp-thesis-report");
  app.get_formatter()->column_width(NAME_COLUMN);
  app.footer(EXAMPLES);
  std::vector<std::string> only;
  options.jobs = vpApp::coreCount();
  app.add_option("--only", only, "Only these figures, tables and chapters (default: all)")
      ->delimiter(',')
      ->option_text("ID,...");
  app.add_option("--out", options.out, "Result folder (default: out/thesis-report)")->option_text("DIR");
  app.add_option("--jobs", options.jobs, "Parts at a time (default: one for each core)")->option_text("N");
  app.add_option("--seed", options.seed, "Of everything random (default: 1)")->option_text("S");
  app.add_flag("--list", options.list, "Name all figures and tables, and end");
  if (!vpApp::parseCommandLine(app, argc, argv)) {
    return false;
  }
  if (options.jobs < 1 || options.jobs > 256) {
    throw vpApp::UsageError("--jobs is " + std::to_string(options.jobs) + ", must be 1..256");
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
