/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-plan-trajectory: problems in, motions out, one line each.
#include "answer.h"
#include "figure.h"
#include "options.h"

#include "appMain.h"
#include "dataFile.h"
#include "lineReader.h"
#include "outputFile.h"

#include <iostream>

namespace
{
using namespace planTrajectory;
namespace fs = std::filesystem;

//! \brief A problem and its motion, kept until the files are written.
struct Planned {
  Problem problem;
  Motion motion;
};

//! \brief Number of problems, and the error of the first bad one.
struct Count {
  std::size_t all = 0;
  std::size_t refused = 0;
  std::string firstComplaint;
};

bool isBlank(const std::string &line) { return line.find_first_not_of(" \t\r") == std::string::npos; }

//! Writes each answer to standard output at once, so that another program may wait for it.
void answer(const std::string &text, const std::string &name, std::size_t line, Count &count,
            std::vector<Planned> *planned)
{
  ++count.all;
  nlohmann::ordered_json id;
  std::string reply;
  try {
    const Problem problem = readProblem(text, name + ":" + std::to_string(line), line);
    id = problem.id;
    const Motion motion = execute(problem);
    reply = answerLine(problem, motion);
    if (planned != nullptr) {
      planned->push_back({problem, motion});
    }
  }
  catch (const std::exception &error) {
    const std::string sentence = vpApp::sentenceOf(error);
    count.firstComplaint = count.refused++ == 0 ? sentence : count.firstComplaint;
    reply = refusalLine(line, id, sentence);
  }
  if (!(std::cout << reply << std::endl)) {
    throw std::runtime_error("standard output: cannot be written");
  }
}

//! Throws after Ctrl-C; earlier answers remain valid.
void requireTime()
{
  if (vpApp::interrupted()) {
    throw vpApp::Interrupted("interrupted");
  }
}

Count answerAll(vpApp::LineReader &lines, std::vector<Planned> *planned)
{
  Count count;
  std::size_t line = 0;
  for (std::string text; lines.next(text);) {
    requireTime();
    ++line;
    if (!isBlank(text)) {
      answer(text, lines.name(), line, count, planned);
    }
  }
  return count;
}

//! "motion.svg" becomes "motion-3.svg" when there are several problems.
fs::path nameFor(const std::string &file, const Problem &problem, bool several)
{
  const fs::path path = file;
  return several ? path.parent_path() /
                       (path.stem().string() + "-" + std::to_string(problem.line) + path.extension().string())
                 : path;
}

std::string titleOf(const Problem &problem)
{
  if (problem.id.is_null()) {
    return problem.place;
  }
  return problem.id.is_string() ? problem.id.get<std::string>() : problem.id.dump();
}

void writeFiles(const Options &options, const std::vector<Planned> &planned, bool several)
{
  for (const Planned &p : planned) {
    requireTime();
    if (!options.csv.empty()) {
      vpApp::writeWholeFile(nameFor(options.csv, p.problem, several), csvOf(p.problem, p.motion));
    }
    if (!options.plot.empty()) {
      vpApp::writeWholeFile(nameFor(options.plot, p.problem, several),
                            drawMotion(p.problem, p.motion, titleOf(p.problem), options.plotFormat()));
    }
  }
}

int plan(Options options)
{
  if (options.file.empty()) {
    options.file = vpApp::dataFile("trajectory/figure-6.3.jsonl");
    if (options.plot.empty()) {
      options.plot = "out/plan-trajectory/figure-6.3.svg";
      fs::create_directories(fs::path(options.plot).parent_path());
    }
    std::cerr << "visp-plan-trajectory: no problems given, so this is figure 6.3 of the thesis (" << options.file
              << "), drawn in " << options.plot << "; --help shows more" << std::endl;
  }
  vpApp::LineReader lines(options.file);
  for (const std::string &output : {options.csv, options.plot}) {
    if (!output.empty()) {
      vpApp::requireWritable(output);
    }
  }
  if (!options.plot.empty()) {
    vpApp::requireGnuplot();
  }
  const bool keep = !options.csv.empty() || !options.plot.empty();
  std::vector<Planned> planned;
  const Count count = answerAll(lines, keep ? &planned : nullptr);
  if (count.all == 0) {
    throw std::runtime_error(lines.name() + ": has no problem, must have one JSON object a line");
  }
  writeFiles(options, planned, count.all > 1);
  if (count.refused > 0) {
    throw std::runtime_error(std::to_string(count.refused) + " of " + std::to_string(count.all) +
                             (count.all == 1 ? " problem was refused: " : " problems were refused, the first: ") +
                             count.firstComplaint);
  }
  return vpApp::ExitOk;
}
} // namespace

int main(int argc, char **argv)
{
  return vpApp::runMain("visp-plan-trajectory", [&]() -> int {
    Options options;
    return readOptions(argc, argv, options) ? plan(options) : vpApp::ExitOk;
  });
}
