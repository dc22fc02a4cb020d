/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// visp-plan-trajectory: problems in, motions out, one line each.
#include "answer.h"

#include "appMain.h"
#include "commandLine.h"
#include "dataFile.h"
#include "lineReader.h"
#include "outputFile.h"
#include "plugin.h"

#include <filesystem>
#include <iostream>

namespace
{
using namespace planTrajectory;
namespace fs = std::filesystem;

constexpr const char *ABOUT =
    R"(Plan motions by direct trajectory generation: from any moving state to any goal within limits on velocity,
acceleration, jerk and position, as minimum-jerk polynomials of the smallest duration, with vias, and with goals and
limits that change on the way. Reads one problem a line (JSON), writes one answer a line (JSON) as soon as it is known.)";

constexpr const char *EXAMPLES =
    R"(A problem; all numbers but q1 and a limit on velocity or acceleration may be left out:
  {"q0": [0, 0], "q1": [0.5, 0.2], "v_max": [0.5, 1], "a_max": [1, 2], "events": [{"t": 0.6, "q1": [0.8, 0.1]}]}

Examples:
  visp-plan-trajectory
      figure 6.3 of the thesis: half way to its goal, an axis gets another one
  visp-plan-trajectory problems.jsonl --csv motion.csv --plot motion.svg > answers.jsonl
      with the samples of each control cycle, and a picture; where there are several problems, their line numbers are
      put into the names: motion-3.svg
  echo '{"q1": 1, "v_max": 0.5, "a_max": 1}' | visp-plan-trajectory -
      one axis, from standard input

All fields are described in data/trajectory/README.md, with an example for each form of motion.
Exit status: 0 every problem was answered, 1 some line was refused (the others are answered), 2 the command line is wrong.)";

//! \brief User options.
struct Options {
  std::string file; //!< Problems; "-": standard input; empty: figure 6.3 of the thesis.
  std::string csv;  //!< File for the samples; empty: none.
  std::string plot; //!< File for the plot, ends in .svg or .png; empty: none.

  //! File format of #plot.
  [[nodiscard]] vpApp::PlotFormat plotFormat() const
  {
    return fs::path(plot).extension() == ".png" ? vpApp::PlotFormat::Png : vpApp::PlotFormat::Svg;
  }
};

/*!
 * Read the command line.
 * \return False when the program has nothing left to do (`--help`, `--version`).
 * \throw vpApp::UsageError naming the option and its value.
 */
bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-plan-trajectory", ABOUT, EXAMPLES);
  vpApp::addPluginOption(line, "motion forms");
  line.text("FILE", options.file, " ", "Problems, one JSON object a line; - for standard input");
  line.text("--csv", options.csv, "FILE", "Write t, q, v, a, j of every control cycle");
  line.text("--plot", options.plot, "FILE.svg|png",
            "Draw position, velocity, acceleration, jerk, with limits and events");
  if (!line.parse(argc, argv)) {
    return false;
  }
  const std::string extension = fs::path(options.plot).extension().string();
  if (!options.plot.empty() && extension != ".svg" && extension != ".png") {
    throw vpApp::UsageError("--plot is " + options.plot + ", must end in .svg or .png");
  }
  return true;
}

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
