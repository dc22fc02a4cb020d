/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "options.h"

#include "liveRobot.h"

#include "appMain.h"
#include "commandLine.h"
#include "numberText.h"
#include "plugin.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>

#include <algorithm>
#include <filesystem>

namespace visualServo
{
namespace
{
constexpr const char *ABOUT =
    R"(Servo a robot by its camera: to a pose in front of a flat picture or a tag, or back to where an image was taken. Without
options everything is simulated: the arm, and its camera, which sees rendered images of a photograph. With your camera and robot the
same program moves them.

A real robot moves only when started, by --start or by the space bar in the window of --display, and slowly: 0.05 m/s unless
--max-linear says otherwise. When the target is lost it stops, waits, goes back the way it came, and stops. It stops for good when
images or the robot's state stay away, when the clock jumps, and when it does not move as commanded.)";

constexpr const char *EXAMPLES =
    R"(Examples:
  visp-servo
      simulated arm and camera; open out/servo/report.html
  visp-servo --eye-to-hand
      the same before a fixed camera: the arm brings the target, which it holds, where the camera is to see it
  visp-servo --display --real-time
      the same to watch; keys: space start and stop, l next law, q quit
  visp-servo --camera 0 --camera-xml camera.xml --target poster.jpg --size 0.42,0.297 --dry-run --display
      your camera and poster, without a robot: does it find the poster, which way would it go?
  visp-servo --camera film.mp4 --target postcard.jpg --size 0.148
      the same with a recorded film
  visp-servo --camera 0 --camera-xml camera.xml --target poster.jpg --size 0.42 --robot franka )"
    R"(--robot-arguments 192.168.1.1 --eMc eMc.yaml --teach goal.json
      the robot stands at the goal: remember it
  ... --goal goal.json --start
      from somewhere else: go there
  ... --teach there.png; then, from somewhere else: ... --reference there.png --distance 0.2,1.2 --start
      the same without knowing what the camera sees, its size or its distance
  visp-servo --replay out/servo --law pbvs1 --lambda 2
      the recorded images once more with another law: what would have been different?
  visp-servo --list
      laws, and the robots of ViSP that this program can move

Written into the folder of --out while it runs: log.csv (a row each cycle), images.csv (a row each image), camera.mkv (the images);
at the end, also after Ctrl-C: report.html (read this first), view.mp4, summary.json. data/servo/README.md describes the files.

Exit status: 0 done, 1 a file, the camera or the robot failed, or the goal was not reached, 2 the command line is wrong, 130 ended
by Ctrl-C.)";

constexpr const char *START = "0.06,0.04,0.45,12,-17,23"; // of the rendered object: m, degrees

void addCamera(vpApp::CommandLine &line, CameraOptions &camera)
{
  line.group("Camera");
  line.text("--camera", camera.source, "CAMERA",
            "sim (rendered images), N or /dev/videoN, aravis or aravis:ID (GigE and USB3 Vision), a video file, a "
            "folder of images, "
            "or a pattern such as img%04d.png");
  line.number("--camera-rate", camera.rate, {0., 1000.}, "HZ",
              "Images per second (default: as the camera or the video has it; 25 where nothing is known)");
  line.text("--camera-xml", camera.xml, "FILE.xml",
            "Intrinsics, as ViSP's calibration writes them; a rendered camera has them without distortion (default: a "
            "field of view of 60 degrees is assumed, for dry runs only)");
  line.text("--camera-name", camera.name, "NAME", "Name of the camera in that file (default: the only one that fits)");
  line.number("--latency", camera.latency, {0., 1.}, "S", "Rendered camera: time from capture to result");
  line.number("--noise", camera.noise, {0., 100.}, "GREY", "Rendered camera: standard deviation of grey values");
  line.add("--object-pose", "X,Y,Z,RX,RY,RZ",
           "Rendered camera: pose of the object at the start, m and degrees (theta u)", START,
           [&camera](const auto &values) { camera.pose = poseIn("--object-pose", values[0]); });
  line.flag("--eye-to-hand", camera.isFixed,
            "The camera is fixed and sees the target on the end effector, which moves (default: the camera moves)");
  line.text("--fMc", camera.fMc, "FILE.yaml",
            "Pose of the fixed camera in the robot's base, as ViSP's calibration writes poses; means --eye-to-hand "
            "(default: a rendered camera stands where --object-pose is true)");
}

void readSize(const std::string &text, TargetOptions &target)
{
  const std::vector<double> size = vpApp::numbersIn("--size", text, {0., 100., true});
  if (size.size() > 2) {
    throw vpApp::UsageError("--size is " + text + ", must be WIDTH or WIDTH,HEIGHT in m");
  }
  target.width = size[0];
  target.height = size.size() == 2 ? size[1] : 0.;
}

void readTag(const std::string &text, TargetOptions &target)
{
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) {
    throw vpApp::UsageError("--tag is " + text + ", must be FAMILY:ID, for example 36h11:0");
  }
  target.tagFamily = text.substr(0, colon);
  target.tagId = static_cast<int>(vpApp::wholeIn("--tag", text.substr(colon + 1), {0., 1e6}));
}

void addTarget(vpApp::CommandLine &line, TargetOptions &target)
{
  line.group("Target and goal");
  line.text("--target", target.photo, "PHOTO",
            "Photograph of the flat target, seen straight (default: klimt.jpg of the data folder)");
  line.add("--size", "W[,H]", "Size of the photograph or of the tag, m (height: by its shape)", "",
           [&target](const auto &values) { readSize(values[0], target); });
  line.text("--reference", target.reference, "IMAGE",
            "Instead: an image of something flat of unknown size, taken at the goal, for example by --teach");
  line.add("--distance", "MIN,MAX", "For --reference: range of its distance from the goal, m", "0.2,1.2",
           [&target](const auto &values) {
             const std::vector<double> range = vpApp::numbersIn("--distance", values[0], {0., 100., true});
             if (range.size() != 2 || !(range[0] < range[1])) {
               throw vpApp::UsageError("--distance is " + values[0] + ", must be MIN,MAX with MIN < MAX");
             }
             target.nearest = range[0];
             target.farthest = range[1];
           });
  line.add("--tag", "FAMILY:ID", "Instead: an AprilTag, for example 36h11:0; --size is the side of its black square",
           "", [&target](const auto &values) { readTag(values[0], target); });
  line.text("--goal", target.goalFile, "FILE.json",
            "Goal as --teach wrote it (default: straight in front, half of the view filled)");
  line.add("--goal-pose", "X,Y,Z,RX,RY,RZ", "Goal: pose of the target in the camera, m and degrees (theta u)", "",
           [&target](const auto &values) { target.goalPose = poseIn("--goal-pose", values[0]); });
}

void addRobot(vpApp::CommandLine &line, MotionOptions &motion)
{
  vpApp::addRobotOptions(
      line, motion.robot,
      "camera (flies freely), amor or a .urdf or .json file: simulated, or with --robot-plugin the model of the real "
      "arm; franka, ur and others of --list: robots of ViSP; none (default: amor with the rendered camera, else none)");
  line.group("Real robot");
  line.text("--robot-plugin", motion.plugin, "LIB.so",
            "Library that gives any vpRobot, see visp3/servoing/vpRobotPlugin.h");
  line.text("--robot-arguments", motion.arguments, "TEXT", "Passed to it, such as an address");
  line.text("--eMc", motion.eMc, "FILE.yaml", "Camera in the end effector, as ViSP's hand-eye calibration writes it");
  line.text(
      "--scene", motion.scene, "FILE.json",
      "Obstacles before which the arm stops, see data/scene/README.md; needs its model. Nothing that the end effector "
      "carries is checked unless the model has it");
  line.number("--margin", motion.margin, {0., 1.}, "M",
              "Clearance that the arm keeps from them and from itself, less what its drives lag behind");
  line.flag("--dry-run", motion.dryRun, "Vision and law as usual, but nothing is commanded to the robot");
  line.flag("--start", motion.start, "Move at once; without it the space bar in the window of --display starts");
}

void addMotion(vpApp::CommandLine &line, Options &options)
{
  vpServoMotionLimits &limits = options.law.motion;
  line.group("Motion");
  vpApp::addPluginOption(line, "laws");
  line.list("--law", options.laws, "LAW,...",
            "Laws; each but those that plan also with +cbf, which keeps the target in view; the first one moves "
            "(default: ff-lookat-pi+cbf, with --eye-to-hand pbvs1+cbf)");
  line.number("--lambda", options.law.gains.lambda, {0., 100., true}, "1/S", "Gain");
  line.number("--max-linear", limits.linearVelocity, {0., 10., true}, "M/S", "Speed of the camera at most");
  line.number("--max-angular", limits.angularVelocity, {0., 10., true}, "RAD/S", "Angular speed at most");
  line.number("--max-acceleration", limits.linearAcceleration, {0., 100., true}, "M/S2",
              "Acceleration at most; angular: in the same ratio");
  line.number("--start-time", options.servo.startTime, {0., 60.}, "S",
              "At each start the speed limits rise from 0 in this time");
  line.number("--image-timeout", options.servo.imageTimeout, {0., 60., true}, "S", "Stop when the last image is older");
  line.number("--control-rate", options.controlRate, {10., 2000.}, "HZ", "Cycles per second");
  line.add("--tolerance", "MM,DEG", "The goal is reached within these", "1,0.3", [&options](const auto &values) {
    const std::vector<double> t = vpApp::numbersIn("--tolerance", values[0], {0., 1000., true});
    if (t.size() != 2) {
      throw vpApp::UsageError("--tolerance is " + values[0] + ", must be MM,DEG");
    }
    options.servo.positionTolerance = 1e-3 * t[0];
    options.servo.rotationTolerance = vpMath::rad(t[1]);
  });
}

void addRun(vpApp::CommandLine &line, Options &options)
{
  line.group("Run");
  line.number("--duration", options.duration, {0., 1e6}, "S",
              "End after this time (default: at the goal or with the images; 60 s where all is simulated)");
  line.flag("--moving-target", options.servo.objectMoves,
            "The target may move: its velocity is estimated and followed");
  line.flag("--stay", options.stay, "Go on at the goal, for a target that may move");
  line.flag("--real-time", options.realTime,
            "Simulation and recorded images by the clock, in threads, as with a camera (default: as fast as the "
            "machine can)");
  line.flag("--display", options.display, "Window; space: start and stop, l: next law, q: quit");
  line.text(
      "--teach", options.teach, "FILE.json|FILE.png",
      "Write the goal, and the mean image beside it, from where the camera stands now; .png: the image alone, for "
      "--reference, of a target of which nothing is known. Nothing moves");
  line.text("--replay", options.replay, "FOLDER",
            "Process again what is recorded in FOLDER; other options replace the recorded ones");
  line.flag("--list", options.list, "Name the laws and the robots of ViSP, and end");
  line.whole("--seed", options.seed, {0, 4294967295.}, "N", "Seed of the rendered camera's noise");
  line.text("--out", options.out, "DIR", "Folder for the result; with --replay out/servo-replay");
}

void checkTarget(const vpApp::CommandLine &line, const TargetOptions &target)
{
  if (line.isGiven("--tag") && line.isGiven("--target")) {
    throw vpApp::UsageError("--tag and --target are both given");
  }
  if (line.isGiven("--tag") && !line.isGiven("--size")) {
    throw vpApp::UsageError("--tag is given without --size, the side of its black square in m");
  }
  if (!target.reference.empty() && (target.goalPose || !target.goalFile.empty() || !target.tagFamily.empty())) {
    throw vpApp::UsageError("--reference is the goal itself, --goal, --goal-pose and --tag do not go with it");
  }
  if (line.isGiven("--goal-pose") && line.isGiven("--goal")) {
    throw vpApp::UsageError("--goal and --goal-pose are both given");
  }
  if (target.goalPose && !((*target.goalPose)[2][3] > 0.)) {
    throw vpApp::UsageError("--goal-pose must have Z > 0: the target is in front of the camera");
  }
}

void checkTeach(const Options &options)
{
  if (!options.teachesGoal() && std::filesystem::path(options.teach).extension() != ".png") {
    throw vpApp::UsageError("--teach is " + options.teach +
                            ", must be a .json file, for the goal and its image, or a .png file, for the image alone");
  }
  if (!options.target.reference.empty()) {
    throw vpApp::UsageError("--teach and --reference are both given: a goal is taught by a known target");
  }
}

void checkRobot(const vpApp::CommandLine &line, const Options &options)
{
  const MotionOptions &motion = options.motion;
  const bool isReal = !options.isSimulated() && (motion.robot.robot != "none" || !motion.plugin.empty());
  if (motion.start && motion.dryRun) {
    throw vpApp::UsageError("--start and --dry-run are both given");
  }
  if (!isReal && line.isGiven("--robot-arguments")) {
    throw vpApp::UsageError("--robot-arguments are for a real robot, and there is none");
  }
  if (isReal && motion.plugin.empty() && options.task != Task::Replay) {
    requireVispRobot(motion.robot.robot);
  }
  if (isReal && !motion.dryRun && options.task == Task::Servo && options.camera.xml.empty() &&
      options.camera.source != "sim") {
    throw vpApp::UsageError("a robot that moves needs --camera-xml, the calibration of its camera");
  }
  const bool isFixed = options.camera.isFixed;
  if (isFixed && !motion.eMc.empty()) {
    throw vpApp::UsageError("--eMc is for a camera on the end effector, with --eye-to-hand the target is there");
  }
  if (isFixed && options.servo.objectMoves) {
    throw vpApp::UsageError("--moving-target needs a camera on the robot, with --eye-to-hand the target is there");
  }
  if (isFixed && options.camera.fMc.empty() && options.camera.source != "sim" &&
      motion.robot.robot + motion.plugin != "none") {
    throw vpApp::UsageError("--eye-to-hand needs --fMc, the pose of the camera in the robot's base");
  }
  if (isReal && motion.plugin.empty() && motion.eMc.empty() && options.task == Task::Servo && !motion.dryRun &&
      !isFixed) {
    throw vpApp::UsageError("--robot " + motion.robot.robot + " needs --eMc, the camera in its end effector");
  }
  if (!motion.scene.empty() && !(options.hasModel() && options.task == Task::Servo)) {
    throw vpApp::UsageError(options.hasModel()
                                ? "--scene is for a robot that moves, not for --teach and --replay"
                                : "--scene needs the model of the arm, --robot is " + motion.robot.robot);
  }
  if (line.isGiven("--margin") && motion.scene.empty()) {
    throw vpApp::UsageError("--margin is given without --scene");
  }
  if (options.camera.source == "sim" && !options.target.tagFamily.empty() && options.task != Task::Replay) {
    throw vpApp::UsageError("--tag needs a camera or recorded images, and --camera is sim, which shows a photograph");
  }
  if (options.camera.source == "sim" && motion.robot.robot == "none" && motion.plugin.empty()) {
    throw vpApp::UsageError("--camera sim needs a robot that carries it, --robot is none");
  }
}

//! What follows from the options together.
void complete(const vpApp::CommandLine &line, Options &options)
{
  MotionOptions &motion = options.motion;
  options.camera.isFixed = options.camera.isFixed || !options.camera.fMc.empty();
  if (options.camera.isFixed && !line.isGiven("--law")) { // laws that turn to the object hunt about friction there
    options.laws = {"pbvs1+cbf"};
  }
  if (!options.replay.empty() && !line.isGiven("--out")) {
    options.out = "out/servo-replay";
  }
  if (!line.isGiven("--robot")) {
    motion.robot.robot = motion.plugin.empty() && options.camera.source == "sim" ? "amor" : "none";
  }
  options.task = options.list              ? Task::List
                 : !options.replay.empty() ? Task::Replay
                 : !options.teach.empty()  ? Task::Teach
                                           : Task::Servo;
  checkTarget(line, options.target);
  if (options.task == Task::Teach) {
    checkTeach(options);
  }
  checkRobot(line, options);
  motion.dryRun = motion.dryRun || (motion.robot.robot == "none" && motion.plugin.empty());
  options.servo.period = 1. / options.controlRate;
  const double ratio = options.law.motion.linearAcceleration / vpServoMotionLimits().linearAcceleration;
  options.law.motion.angularAcceleration *= ratio;
  options.law.motion.linearJerk *= ratio;
  options.law.motion.angularJerk *= ratio;
  const bool isFile = options.camera.source != "sim" && options.camera.source.rfind("aravis", 0) != 0 &&
                      options.camera.source.rfind("/dev/video", 0) != 0 &&
                      options.camera.source.find_first_not_of("0123456789") != std::string::npos;
  const bool needsClock = (!options.isSimulated() && !motion.dryRun) || !(isFile || options.camera.source == "sim");
  options.realTime = options.realTime || needsClock || options.display;
  if (options.camera.source == "sim" && options.camera.rate == 0.) {
    options.camera.rate = 25.;
  }
  if (options.isSimulated() && options.duration == 0. && !options.display) {
    options.duration = 60.;
  }
}
} // namespace

vpHomogeneousMatrix poseIn(const std::string &option, const std::string &text)
{
  const std::vector<double> p = vpApp::numbersIn(option, text, {-1000., 1000.});
  if (p.size() != 6) {
    throw vpApp::UsageError(option + " is " + text + ", must be six numbers X,Y,Z,RX,RY,RZ in m and degrees");
  }
  return vpHomogeneousMatrix(vpTranslationVector(p[0], p[1], p[2]),
                             vpThetaUVector(vpMath::rad(p[3]), vpMath::rad(p[4]), vpMath::rad(p[5])));
}

bool Options::isSimulated() const { return motion.plugin.empty() && (motion.robot.robot == "camera" || hasModel()); }

bool Options::teachesGoal() const { return std::filesystem::path(teach).extension() == ".json"; }

bool Options::hasModel() const
{
  const std::string suffix = std::filesystem::path(motion.robot.robot).extension().string();
  return motion.robot.robot == "amor" || suffix == ".urdf" || suffix == ".json" || suffix == ".xacro";
}

namespace
{
bool parse(const std::vector<std::string> &arguments, Options &options)
{
  options = Options();
  vpServoMotionLimits &limits = options.law.motion;
  limits.linearVelocity = options.law.recovery.maxLinear = 0.05;
  limits.angularVelocity = options.law.recovery.maxAngular = 0.15;
  limits.linearAcceleration = 0.25;
  options.servo.rotationTolerance = vpMath::rad(0.3);
  options.camera.pose = poseIn("--object-pose", START);
  vpApp::CommandLine line("visp-servo", ABOUT, EXAMPLES);
  addCamera(line, options.camera);
  addTarget(line, options.target);
  addRobot(line, options.motion);
  addMotion(line, options);
  addRun(line, options);
  std::vector<const char *> argv{"visp-servo"};
  for (const std::string &argument : arguments) {
    argv.push_back(argument.c_str());
  }
  if (!line.parse(static_cast<int>(argv.size()), argv.data())) {
    return false;
  }
  complete(line, options);
  try {
    for (const std::string &law : options.laws) {
      static_cast<void>(vpServoController::create(law, options.law));
    }
  }
  catch (const vpException &error) {
    throw vpApp::UsageError(std::string("--law: ") + error.getStringMessage());
  }
  return true;
}

} // namespace

bool readOptions(int argc, const char *const *argv, Options &options)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::string name = "--replay";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == name && i + 1 < arguments.size()) {
      return parse(withRecorded(arguments[i + 1], arguments), options);
    }
    if (arguments[i].rfind(name + "=", 0) == 0) {
      return parse(withRecorded(arguments[i].substr(name.size() + 1), arguments), options);
    }
  }
  return parse(arguments, options);
}
} // namespace visualServo
