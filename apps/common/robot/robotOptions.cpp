/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "robotOptions.h"

#include "appMain.h"

#include <cctype>
#include <sstream>

namespace vpApp
{
namespace
{
constexpr Range POSITIVE = {0., 1e6, true};

bool beginsNumber(const std::string &text)
{
  return std::isdigit(static_cast<unsigned char>(text[0])) != 0 || text[0] == '-' || text[0] == '+' || text[0] == '.';
}

void readHome(const std::string &text, RobotOptions &options)
{
  options.homeState = beginsNumber(text) ? "" : text;
  options.home = beginsNumber(text) ? numbersIn("--home", text) : std::vector<double>();
}

void readHeld(const std::string &text, RobotOptions &options)
{
  if (text == "all") {
    options.holdOthers = true;
    return;
  }
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) {
    throw UsageError("--hold is " + text + ", must be JOINT=VALUE, in rad or m, or all");
  }
  const std::string joint = text.substr(0, equals);
  if (!options.held.emplace(joint, numberIn("--hold " + joint, text.substr(equals + 1), {-1e6, 1e6})).second) {
    throw UsageError("--hold names joint " + joint + " twice");
  }
}

//! The files beside the robot's, and the parts of a URDF.
void addFiles(CommandLine &line, RobotOptions &options)
{
  line.text("--robot-base", options.base, "LINK", "First link of a URDF's chain (default: the root)");
  line.text("--robot-tip", options.tip, "LINK", "Its last link (default: the only leaf)");
  line.text("--camera-link,--robot-camera", options.camera, "LINK",
            "Link that is the camera, on any link of the chain (default: the tool)");
  line.text("--tool-link", options.tool, "LINK", "Link that is the tool, on any link of the chain (default: the tip)");
  line.text("--srdf", options.srdf, "FILE.srdf", "Pairs of links that need no check, and states for --home");
  line.list("--package-path", options.packagePaths, "FOLDER,...",
            "Folders that hold the packages of package:// (the folders above the URDF are searched, too)");
  line.add("--home", "Q,...|STATE", "Home configuration, rad or m, or the name of a state of the SRDF", "",
           [&options](const auto &values) { readHome(values[0], options); });
}

//! What is checked for collisions.
void addChecks(CommandLine &line, RobotOptions &options)
{
  line.list("--ignore-link", options.ignored, "LINK,...", "Links that are never checked for collisions");
  line.add(
      "--hold", "JOINT=VALUE,...|all",
      "Joints beside the chain that never move, such as fingers, rad or m; all: all of them", "",
      [&options](const auto &values) {
        for (const std::string &value : values) {
          std::istringstream parts(value);
          for (std::string part; std::getline(parts, part, ',');) {
            readHeld(part, options);
          }
        }
      },
      0);
  line.text("--allowed-pairs", options.allowedPairs, "FILE.json",
            "Pairs of links that need no check, as visp-arm --write-pairs found");
  line.whole("--covers", options.covers, {1, 8}, "N", "Cover the mesh of each link with at most N capsules");
  line.text("--cover-file", options.coverFile, "FILE.json",
            "Where fitted capsules are kept (default: ~/.cache/visp-direct/NAME.covers.json)");
}

void addLimits(CommandLine &line, RobotOptions &options)
{
  const auto limits = [&line](const char *name, std::vector<double> &values, const std::string &sentence) {
    const std::string option = std::string(name).substr(0, std::string(name).find(','));
    line.add(name, "X,...", sentence, "",
             [&values, option](const auto &texts) { values = numbersIn(option, texts[0], POSITIVE); });
  };
  line.text("--joint-limits", options.jointLimits, "FILE.yaml",
            "Limits of a URDF's joints, as MoveIt's joint_limits.yaml");
  limits("--velocity-limits", options.velocity, "One velocity limit for all joints or one for each, rad/s or m/s");
  limits("--acceleration-limits,--robot-acceleration", options.acceleration,
         "The same of acceleration, rad/s^2 or m/s^2; a URDF has none (default: 10)");
}
} // namespace

void addRobotOptions(CommandLine &line, RobotOptions &options, const std::string &sentence)
{
  line.group("Robot");
  if (!sentence.empty()) {
    options.option = "--robot";
    line.text("--robot,--arm", options.robot, "ROBOT", sentence);
  }
  addFiles(line, options);
  addChecks(line, options);
  addLimits(line, options);
  line.group("");
}
} // namespace vpApp
