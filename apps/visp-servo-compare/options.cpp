/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "appMain.h"
#include "commandLine.h"
#include "format.h"
#include "plugin.h"
#include "scenario.h"

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
      with rendered views of your own photograph, measured by the vision of visp-direct
  visp-servo-compare --monte-carlo 20 --measure points
      20 seeds of every run; the report shows median and range; also under mpirun
  visp-servo-compare --law pbvs1,ff-lookat-pi --plant A --shape
      what it takes to start without a step in velocity, and what that costs
  visp-servo-compare --law dtg,ff-dtg,pbvs1,ff-lookat-pi --measure points --bounded --lambda 3
      planned motion against laws behind a shaper, within the same limits
  visp-servo-compare --robot amor --measure points
      a seven-joint arm carries the camera; the report shows its joints
  visp-servo-compare --robot amor --drive measured --plant D --measure points
      the same arm with drives that let friction through to the law: the order of the thesis's figures 5.9 and 5.10
  visp-servo-compare --robot my-arm.urdf --robot-tip tool0 --camera-link camera_link --plant A
      your own arm
  visp-servo-compare --robot data/robot/five-axis.json --free rz --plant A --measure points
      an arm of five joints, which leaves the rotation about the optical axis as it comes
  visp-servo-compare --plugin ./libmine.so --law mine,mine+cbf,ff-lookat-pi --measure points
      a law of your own, from a library that registers it (tutorial "Your own
      law"), beside ours
  visp-servo-compare --task my-task.json
      your own poses, camera, gains and robots; start from data/scenario/thesis-5.4.json

Exit status: 0 done, 1 the data do not allow it, 2 the command line is wrong. Nothing is written unless all succeeded.)";

constexpr const char *ROBOT = "What carries the camera: camera (flies freely), amor (the arm of the thesis), or an arm "
                              "as .urdf or .json file, see "
                              "data/robot/README.md; visp-arm tells more. On an arm plant A is ideal; B and D are "
                              "driven by torques against joint "
                              "friction, on D twice that of the file. Collisions are not checked here";

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

} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  vpApp::CommandLine line("visp-servo-compare", ABOUT, EXAMPLES);
  RobotOptions &robot = options.robot;
  line.group("Comparison");
  vpApp::addPluginOption(line, "laws");
  line.list("--law", options.laws, "LAW,...",
            "Laws to compare; append +cbf for the view filter, not to laws that plan (default: all)");
  line.list("--plant", options.plants, "NAME,...", "Robots to compare on (default: A,B,D, or those of the task file)");
  line.list("--measure", options.measures, "KIND,...",
            "points: noisy feature points; image: rendered views through the vision (default: all by points, and "
            "pbvs1, kyrki, ff-lookat-pi also by image where there is friction)");
  line.flag("--full", options.full, "Everything: all laws, all plants, points and image (takes long)");
  line.flag("--shape", options.shape, shapeHelp());
  line.flag(
      "--bounded", options.bounded,
      "Every law within the same limits of the camera's speed, acceleration and jerk (\"motion\" of the task file), "
      "the object's pose "
      "averaged over images for all of them: laws that plan (dtg, ff-dtg) by themselves, the others behind a shaper");
  line.number("--lambda", options.lambda, {0., 1e6}, "L", "Gain of every law, 1/s (default: 0, that of the task)");
  line.text("--task", options.taskFile, "FILE.json",
            "Task file instead of the thesis' task; see data/scenario/README.md");
  line.text(
      "--target", options.target, "IMAGE",
      "Photograph of the flat object, 8 or 16 bits, rotated by its EXIF orientation (default: klimt.jpg of the data "
      "folder)");
  line.group("Arm that carries the camera");
  line.list(
      "--self-motion", robot.selfMotion, "WISH,...",
      "What redundant joints do: limits (away from joint limits), manipulability, posture (stay near the start), or "
      "none");
  line.list(
      "--free", robot.free, "AXIS,...",
      "Axes of the camera that the arm need not follow: x, y, z, rx, ry, rz; for arms with fewer than six joints. They "
      "are not commanded, and the errors in the report are without them");
  line.choice("--limits", robot.limits, {{"stop", std::string("stop")}, {"scale", std::string("scale")}},
              "At a position limit stop only that joint, or scale the whole motion");
  line.choice("--drive", robot.drive,
              {{"integrated", std::string("integrated")}, {"measured", std::string("measured")}},
              "What the drives of plants with friction add the commanded joint velocity to: the last desired position "
              "(open loop; friction delays the joints), or the measured one, (3.18) of the thesis (friction suppresses "
              "small velocities, which the law must overcome)");
  line.group("Run");
  line.whole("--monte-carlo", options.repetitions, {1, 100000}, "N", "Repeat each run with N seeds");
  line.whole("--seed", options.seed, {0, 4294967295.}, "S", "First seed of noise and feature points");
  line.text("--out", options.out, "DIR", "Result folder");
  line.flag("--display", options.display, "Show the camera's view of each law in a window; click to skip to the next");
  line.whole("--jobs", options.jobs, {1, 256}, "N", "Runs at a time (default: one for each core)");
  line.flag("--list", options.list, "Name the laws and plants, a sentence each, and end");
  vpApp::addRobotOptions(line, robot, ROBOT);
  if (!line.parse(argc, argv)) {
    return false;
  }
  if (options.full && !(options.laws.empty() && options.plants.empty() && options.measures.empty())) {
    throw vpApp::UsageError("--full means all laws, plants and measures, it cannot be combined with a choice of them");
  }
  if (options.bounded && options.shape) {
    throw vpApp::UsageError("--bounded shapes every run by itself, it cannot be combined with --shape");
  }
  return true;
}
} // namespace servoCompare
