/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "commandLine.h"

#include <filesystem>

namespace planTrajectory
{
namespace
{
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
} // namespace

vpApp::PlotFormat Options::plotFormat() const
{
  return std::filesystem::path(plot).extension() == ".png" ? vpApp::PlotFormat::Png : vpApp::PlotFormat::Svg;
}

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-plan-trajectory", ABOUT, EXAMPLES);
  line.text("FILE", options.file, " ", "Problems, one JSON object a line; - for standard input");
  line.text("--csv", options.csv, "FILE", "Write t, q, v, a, j of every control cycle");
  line.text("--plot", options.plot, "FILE.svg|png",
            "Draw position, velocity, acceleration, jerk, with limits and events");
  if (!line.parse(argc, argv)) {
    return false;
  }
  const std::string extension = std::filesystem::path(options.plot).extension().string();
  if (!options.plot.empty() && extension != ".svg" && extension != ".png") {
    throw vpApp::UsageError("--plot is " + options.plot + ", must end in .svg or .png");
  }
  return true;
}
} // namespace planTrajectory
