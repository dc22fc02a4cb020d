/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "format.h"
#include "jobs.h"
#include "scenario.h"

#include <CLI/CLI.hpp>

#include <sstream>

namespace servoCompare
{
namespace
{
constexpr const char *ABOUT =
    R"(Compare visual servoing laws on one task: a camera looks at a flat object, moves 0.2 m to its left, back, and to
its right (section 5.4 of the thesis "Direct Methods for Vision-Based Robot Control"). Every law gets the same task,
gains, limits and noise. The robots ("plants") are simulated: A is perfect, B and D have a slow camera, latency, noise
and friction. The result is a folder with report.html (open it in a browser), summary.json, one CSV file for each run
(with --monte-carlo: for each run of the first seed), and videos.)";

constexpr const char *EXAMPLES = R"(Examples:
  visp-servo-compare
      the default comparison, below 3 minutes on 2 cores
  visp-servo-compare --law pbvs1,ff-lookat-pi --plant D --measure points
      two laws on the robot with the most friction, in seconds
  visp-servo-compare --law kyrki-decoupled,kyrki-decoupled+cbf --plant A
      the same law without and with the filter that keeps the object in the view
  visp-servo-compare --target my-photo.jpg --measure image --law ff-lookat-pi --plant B
      with rendered views of your own photo, measured by the vision of visp-direct
  visp-servo-compare --monte-carlo 20 --measure points
      20 seeds of every run; the report shows median and range
  visp-servo-compare --law pbvs1,ff-lookat-pi --plant A --shape
      what it takes to start without a step in velocity, and what that costs
  visp-servo-compare --robot amor --measure points
      a seven-joint arm carries the camera; the report shows its joints
  visp-servo-compare --robot my-arm.urdf --robot-tip tool0 --robot-camera camera_link --plant A
      your own arm
  visp-servo-compare --task my-task.json
      your own poses, camera, gains and robots; start from data/scenario/thesis-5.4.json

Exit status: 0 done, 1 the data do not allow it, 2 the command line is wrong. Nothing is written unless all succeeded.)";

constexpr std::size_t NAME_COLUMN = 22; // width, characters
constexpr std::size_t HELP_COLUMN = 96; // width, characters

//! Breaks the help of an option into aligned lines.
class HelpFormatter : public CLI::Formatter
{
public:
  HelpFormatter() { column_width(NAME_COLUMN); }
  std::string make_option_desc(const CLI::Option *option) const override
  {
    std::string lines;
    std::size_t column = 0;
    std::istringstream words(option->get_description());
    for (std::string word; words >> word;) {
      if (column > 0 && column + 1 + word.size() > HELP_COLUMN) {
        lines += '\n'; // CLI11 indents what follows
        column = 0;
      }
      lines += (column > 0 ? " " : "") + word;
      column += (column > 0 ? 1 : 0) + word.size();
    }
    return lines;
  }
};

std::string shapeHelp()
{
  const vpTwistShaperLimits limits = Scenario().shape;
  return "Run all a second time with the commanded twist shaped: no step at the start or at a new goal, acceleration "
         "at "
         "most " +
         number(limits.linearAcceleration, 3) + " m/s^2 and " + number(limits.angularAcceleration, 3) +
         " rad/s^2, jerk at most " + number(limits.linearJerk, 3) + " m/s^3 and " + number(limits.angularJerk, 3) +
         " rad/s^3, or as \"shape\" of the task file says; the report shows both";
}

void requireAtLeastOne(const char *option, const std::string &text, unsigned int &value)
{
  std::size_t used = 0;
  long long number = 0;
  try {
    number = std::stoll(text, &used);
  }
  catch (const std::exception &) {
    used = 0;
  }
  if (used != text.size() || number < 1 || number > 100000) {
    throw vpApp::UsageError(std::string(option) + " is " + text + ", must be a whole number from 1 to 100000");
  }
  value = static_cast<unsigned int>(number);
}
} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  CLI::App app(ABOUT, "visp-servo-compare");
  app.formatter(std::make_shared<HelpFormatter>());
  app.footer(EXAMPLES);

  app.add_option("--law", options.laws,
                 "Laws to compare, as LAW,LAW,...; append +cbf for the view filter (default: all)")
      ->delimiter(',')
      ->option_text("LAW,...");
  app.add_option("--plant", options.plants, "Robots to compare on (default: A,B,D, or those of the task file)")
      ->delimiter(',')
      ->option_text("NAME,...");
  app.add_option("--measure", options.measures,
                 "points: noisy feature points; image: rendered views through the vision (default: all by points, and "
                 "pbvs1, kyrki, ff-lookat-pi also by image where there is friction)")
      ->delimiter(',')
      ->option_text("KIND,...");
  app.add_flag("--full", options.full, "Everything: all laws, all plants, points and image (takes long)");
  app.add_flag("--shape", options.shape, shapeHelp());
  app.add_option("--task", options.taskFile, "Task file instead of the thesis' task; see data/scenario/README.md")
      ->option_text("FILE.json");
  app.add_option("--robot", options.robot.robot,
                 "What carries the camera: camera (flies freely), amor (the arm of the thesis), or an arm as .urdf or "
                 ".json file, see data/robot/README.md. On an arm plant A is ideal; B and D are driven by torques "
                 "against joint friction, on D twice that of the file (default: camera)")
      ->option_text("ROBOT");
  app.add_option("--robot-base", options.robot.base, "First link of the URDF's chain (default: the root)")
      ->option_text("LINK");
  app.add_option("--robot-tip", options.robot.tip, "Its last link (default: the only leaf)")->option_text("LINK");
  app.add_option("--robot-camera", options.robot.camera, "Link that is the camera (default: the tip)")
      ->option_text("LINK");
  app.add_option("--robot-acceleration", options.robot.acceleration,
                 "Acceleration limit of all joints of the URDF, which has none, rad/s^2 or m/s^2 (default: 10)")
      ->check(CLI::PositiveNumber)
      ->option_text("A");
  app.add_option("--self-motion", options.robot.selfMotion,
                 "What spare joints do: limits (away from joint limits), manipulability, posture (stay near the "
                 "start), or none (default: limits,manipulability)")
      ->delimiter(',')
      ->option_text("WISH,...");
  app.add_option("--limits", options.robot.limits,
                 "At a position limit stop only that joint, or scale the whole motion (default: stop)")
      ->option_text("stop|scale");
  app.add_option("--target", options.target,
                 "Photo of the flat object, 8 or 16 bits, turned as its EXIF orientation says (default: klimt.jpg of "
                 "the data folder)")
      ->option_text("IMAGE");
  std::string repetitions = "1";
  std::string jobs = std::to_string(vpApp::coreCount());
  app.add_option("--monte-carlo", repetitions, "Repeat each run with N seeds")->option_text("N");
  app.add_option("--seed", options.seed, "First seed of noise and feature points (default: 1)")->option_text("S");
  app.add_option("--out", options.out, "Result folder (default: out/servo-compare)")->option_text("DIR");
  app.add_flag("--display", options.display,
               "Show the camera's view of each law in a window; click to skip to the next");
  app.add_option("--jobs", jobs, "Runs at a time (default: one for each core)")->option_text("N");
  app.add_flag("--list", options.list, "Name the laws and plants, a sentence each, and end");

  if (!vpApp::parseCommandLine(app, argc, argv)) {
    return false;
  }
  requireAtLeastOne("--monte-carlo", repetitions, options.repetitions);
  requireAtLeastOne("--jobs", jobs, options.jobs);
  if (options.full && !(options.laws.empty() && options.plants.empty() && options.measures.empty())) {
    throw vpApp::UsageError("--full means all laws, plants and measures, it cannot be combined with a choice of them");
  }
  return true;
}
} // namespace servoCompare
