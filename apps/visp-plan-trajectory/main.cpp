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
#include "report.h"

#include <filesystem>
#include <iostream>
#include <memory>

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
  {"q1": 0.5, "v_max": 0.5, "a_max": 1, "events": [{"t": 0.6, "q1": 0.8}]}

Examples:
  visp-plan-trajectory
      figure 6.3 of the thesis: half way to its goal, an axis gets another one
  visp-plan-trajectory problems.jsonl --csv motion.csv --out report > answers.jsonl
      with the samples of each control cycle, where there are several problems in files with their line numbers,
      motion-3.csv, and a report: report/report.html
  echo '{"q1": 1, "v_max": 0.5, "a_max": 1}' | visp-plan-trajectory -
      one axis, from standard input

All fields are described in data/trajectory/README.md, with an example for each form of motion.

Exit status: 0 every problem was answered, 1 some line was refused (the others are answered), 2 the command line is wrong.)";

//! \brief User options.
struct Options {
  std::string file; //!< Problems; "-": standard input; empty: figure 6.3 of the thesis.
  std::string csv;  //!< File for the samples; empty: none.
  std::string out;  //!< Folder for data and report; empty: none.
};

/*!
 * Read the command line.
 * \return False when the program has nothing left to do (`--help`, `--version`).
 * \throw vpApp::UsageError naming the option and its value.
 */
bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-plan-trajectory", ABOUT, EXAMPLES);
  line.group("Input and results");
  vpApp::addPluginOption(line, "motion forms");
  line.text("FILE", options.file, " ", "Problems, one JSON object a line; - for standard input");
  line.text("--csv", options.csv, "FILE", "Write t, q, v, a, j of every control cycle");
  line.text("--out", options.out, "DIR",
            "Folder for a report with position, velocity, acceleration, jerk, limits, events");
  return line.parse(argc, argv);
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
    const Problem problem = readProblem(text, name + ":" + std::to_string(line), line, &id);
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

void writeSamples(const Options &options, const std::vector<Planned> &planned, bool several)
{
  for (const Planned &p : planned) {
    requireTime();
    vpApp::writeWholeFile(nameFor(options.csv, p.problem, several), csvOf(p.problem, p.motion));
  }
}

void writeReport(vpApp::OutputFolder &out, const std::vector<Planned> &planned, const Count &count,
                 const std::string &command)
{
  nlohmann::ordered_json motions = nlohmann::ordered_json::array();
  for (const Planned &p : planned) {
    motions.push_back(dataOf(p.problem, p.motion));
  }
  out.write("motions.json", motions.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  vpApp::finishWithReport(out, {{"version", VISP_DIRECT_VERSION},
                                {"command", command},
                                {"problems", count.all},
                                {"refused", count.refused},
                                {"first_refusal", count.firstComplaint}});
}

int plan(Options options, const std::string &command)
{
  const bool isExample = options.file.empty();
  if (isExample) {
    options.file = vpApp::dataFile("trajectory/figure-6.3.jsonl");
    if (options.out.empty()) {
      options.out = "out/plan-trajectory";
    }
  }
  vpApp::LineReader lines(options.file);
  if (!options.csv.empty()) {
    vpApp::requireWritable(options.csv);
  }
  const auto out =
      options.out.empty() ? nullptr : std::make_unique<vpApp::OutputFolder>("visp-plan-trajectory", options.out);
  if (isExample) {
    std::cerr << "visp-plan-trajectory: no problems given, so this is figure 6.3 of the thesis (" << options.file
              << "), with a report in " << options.out << "; --help shows more" << std::endl;
  }
  const bool keep = !options.csv.empty() || out != nullptr;
  std::vector<Planned> planned;
  const Count count = answerAll(lines, keep ? &planned : nullptr);
  if (count.all == 0) {
    throw std::runtime_error(lines.name() + ": has no problem, must have one JSON object a line");
  }
  if (!options.csv.empty()) {
    writeSamples(options, planned, count.all > 1);
  }
  if (out != nullptr) {
    writeReport(*out, planned, count, command);
  }
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
    return readOptions(argc, argv, options) ? plan(options, vpApp::commandLine("visp-plan-trajectory", argc, argv))
                                            : vpApp::ExitOk;
  });
}
