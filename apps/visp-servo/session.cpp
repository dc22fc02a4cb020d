/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "session.h"

#include "camera.h"
#include "outcome.h"
#include "picture.h"
#include "servoRun.h"
#include "target.h"
#include "view.h"

#include "appMain.h"
#include "viewData.h"
#include "greyPicture.h"
#include "numberText.h"
#include "outputFile.h"
#include "pictureWindow.h"
#include "reach.h"
#include "report.h"
#include "robot.h"
#include "videoFile.h"

#include <visp3/core/vpPoseVector.h>
#include <visp3/core/vpXmlParserCamera.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <iostream>
#include <limits>
#include <stdexcept>

namespace visualServo
{
namespace
{

Wish wishOf(const std::string &key, bool isOpen)
{
  return !isOpen || key == "q" ? Wish::Quit : key == " " ? Wish::StartStop : key == "l" ? Wish::NextLaw : Wish::None;
}

//! Draws view.mp4 from the recording. \return The last picture.
cv::Mat filmRecording(const Recording &recording, const Eye &eye, const Options &options,
                      const std::vector<vpServoPoint> &goal, vpApp::OutputFolder &out)
{
  View view(eye.intrinsics, eye.width, eye.height, options.law.motion);
  view.setGoal(goal);
  cv::VideoCapture film(out.file(Recording::VIDEO), cv::CAP_FFMPEG);
  std::unique_ptr<vpApp::VideoFile> file;
  const std::vector<ImageRow> &images = recording.images();
  const std::vector<CycleRow> &cycles = recording.cycles();
  cv::Mat picture, grey;
  vpImage<unsigned char> image;
  std::size_t cycle = 0, position = 0;
  for (const ImageRow &row : images) {
    if (!row.isRecorded) {
      continue;
    }
    for (; position <= row.index; ++position) {
      if (!film.read(grey)) {
        return picture;
      }
    }
    cv::Mat single;
    cv::extractChannel(grey, single, 0);
    vpApp::copyGrey(single, image);
    while (cycle + 1 < cycles.size() && cycles[cycle + 1].time <= row.capture) {
      ++cycle;
    }
    Moment moment;
    moment.image = &image;
    moment.seen = &row;
    moment.cycle = cycles.empty() ? nullptr : &cycles[cycle];
    moment.sentence = moment.cycle != nullptr ? recording.sentenceOf(*moment.cycle) : "";
    moment.images = row.index + 1;
    moment.law = options.laws.front();
    picture = view.draw(moment, false);
    if (!file) {
      file = std::make_unique<vpApp::VideoFile>(out.file("view.mp4"), picture.cols, picture.rows, eye.rate);
    }
    file->write(picture);
  }
  if (file) {
    file->close();
  }
  return picture;
}

//! For vpLoadPose().
std::string poseText(const vpRigidTransform &pose)
{
  const vpPoseVector numbers(pose.toHomogeneous());
  std::string text;
  for (unsigned int i = 0; i < 6; ++i) {
    text += vpApp::number(numbers[i], 12) + "\n";
  }
  return text;
}

//! What --replay needs besides the recording.
void keepSettings(Options &options, const Eye &eye, const vpHomogeneousMatrix &cdMo, vpApp::OutputFolder &out)
{
  if (!options.target.reference.empty()) {
    cv::imwrite(out.file("reference.png"), matOf(readReference(options.target)));
  }
  else if (options.target.tagFamily.empty()) {
    const Photo photo = readPhoto(options.target);
    options.target.width = photo.width;
    options.target.height = photo.height;
    cv::imwrite(out.file("target.png"), matOf(photo.image));
  }
  vpXmlParserCamera parser;
  if (parser.save(eye.intrinsics, out.file("camera.xml"), "Camera", eye.width, eye.height) !=
      vpXmlParserCamera::SEQUENCE_OK) {
    throw std::runtime_error((out.path() / "camera.xml").string() + ": cannot be written");
  }
  if (options.camera.isFixed) {
    out.write(FIXED_CAMERA_FILE, poseText(eye.fMc));
  }
  out.write(SETTINGS_FILE, settingsText(settingsOf(options, cdMo)));
}

void writeResult(const Outcome &outcome, const cv::Mat &picture, const std::string &commandLine,
                 vpApp::OutputFolder &out)
{
  if (!picture.empty()) {
    out.write("view.png", pngOf(picture));
  }
  const std::string place = vpApp::finishWithReport(out, summaryOf(outcome, commandLine), true);
  for (const std::string &line : findings(outcome)) {
    std::cout << line << "\n";
  }
  std::cout << place << std::endl;
}

bool isLate(const Outcome &outcome)
{
  const Options &options = *outcome.options;
  return outcome.ending == Ending::Duration && outcome.hasStarted && !options.motion.dryRun && !options.stay;
}

//! Hindrances of the arm that stands where \e row says. None where that or the goal is not known.
std::vector<std::string> hindrancesAt(const CycleRow &row, const Robot &robot, const Outcome &outcome)
{
  if (robot.arm() == nullptr || !row.hasPose || !row.hasCamera || !outcome.options->target.reference.empty()) {
    return {};
  }
  const bool isFixed = outcome.options->camera.isFixed;
  const vpRigidTransform cdMo = vpRigidTransform::fromHomogeneous(outcome.cdMo);
  return hindrances(*robot.arm(), Eigen::Map<const Eigen::VectorXd>(row.q.data(), row.joints),
                    placeAtGoal(isFixed, outcome.eye.fMc, row.fMc, row.cMo, cdMo), isFixed);
}

int statusOf(const Outcome &outcome)
{
  if (outcome.ending == Ending::Failed) {
    throw std::runtime_error(outcome.failure + "; the report shows the run until then");
  }
  if (outcome.ending == Ending::Interrupted) {
    return vpApp::ExitInterrupted;
  }
  if (isLate(outcome)) {
    const Recording &recording = *outcome.recording;
    const std::string obstacle = recording.obstacleOf(recording.last());
    throw std::runtime_error("the goal was not reached in " + vpApp::number(outcome.options->duration, 6) + " s" +
                             (obstacle.empty() ? "" : ", in the way: " + obstacle) +
                             "; the report shows the way (at the end: " + recording.sentenceOf(recording.last()) + ")");
  }
  return vpApp::ExitOk;
}
} // namespace

vpServoController controllerOf(Options &options, const Eye &eye)
{
  vpServoControllerSpec &law = options.law;
  law.view = vpViewConstraintSpec::fromCamera(eye.intrinsics, eye.width, eye.height);
  law.view.period = options.servo.period;
  law.view.maxLinear = law.motion.linearVelocity;
  law.view.maxAngular = law.motion.angularVelocity;
  if (options.camera.isFixed) {
    options.servo.place = vpServoCameraPlace::EyeToHand;
    options.servo.fMc = eye.fMc;
  }
  for (const std::string &id : options.laws) { // all of them must be known before anything moves
    static_cast<void>(vpServoController::create(id, law));
  }
  return vpServoController::create(options.laws.front(), law);
}

int servo(const Options &given, const std::string &commandLine)
{
  Options options = given;
  const std::unique_ptr<Robot> robot = openRobot(options);
  const Camera camera = openCamera(options, *robot);
  const Eye &eye = camera.eye;
  options.servo.assumeExecuted = !robot->tellsState();
  if (options.servo.assumeExecuted && options.camera.isFixed) {
    throw std::runtime_error("--eye-to-hand needs a robot that tells its pose, " + robot->description() +
                             " tells none");
  }
  if (options.motion.dryRun) {
    options.servo.followLength = options.servo.followAngle = std::numeric_limits<double>::infinity();
  }
  const std::unique_ptr<const vpCollisionScene> scene = loadObstacles(options.motion, *robot);
  vpVisualServo servo(controllerOf(options, eye), options.servo, robot->arm());
  if (scene) {
    vpStopSupervisorSpec stop;
    stop.margin = options.motion.margin;
    servo.supervise(*scene, stop);
  }
  servo.setVision(makeVision(options, eye.intrinsics));
  vpHomogeneousMatrix cdMo;
  vpServoGoal goal; // that of a reference image comes with its sights
  if (options.target.reference.empty()) {
    cdMo = goalPose(options, eye);
    goal = servo.vision().goal(cdMo);
    servo.setGoal(goal);
    if (options.camera.source == "sim" && robot->arm() != nullptr) { // where the target is, is known before it is seen
      const bool isFixed = options.camera.isFixed;
      const vpRigidTransform place =
          placeAtGoal(isFixed, eye.fMc, robot->pose(), vpRigidTransform::fromHomogeneous(*options.camera.pose),
                      vpRigidTransform::fromHomogeneous(cdMo));
      vpApp::printWarnings("visp-servo", hindrances(*robot->arm(), robot->read().q, place, isFixed));
    }
  }
  std::unique_ptr<vpApp::PictureWindow> window;
  View view(eye.intrinsics, eye.width, eye.height, options.law.motion);
  view.setGoal(goal.points);
  Screen screen;
  if (options.display) {
    window = std::make_unique<vpApp::PictureWindow>("visp-servo");
    screen = [&window, &view](const Moment &moment) {
      const bool isOpen = window->show(view.draw(moment, true), 0.);
      return wishOf(window->key(), isOpen);
    };
  }
  vpApp::OutputFolder out("visp-servo", options.out);
  keepSettings(options, eye, cdMo, out);
  if (robot->arm() != nullptr) {
    vpApp::writeArm(out, *robot->arm());
  }
  Recording recording(out, robot->arm(), eye.rate, options.camera.isFixed, scene.get());
  ServoRun run(options, *camera.source, *robot, servo, recording, screen);
  Outcome outcome;
  try {
    run.run();
    recording.close();
    outcome.options = &options;
    outcome.recording = &recording;
    outcome.timing = &servo.timing();
    outcome.ending = run.ending();
    outcome.failure = run.failure();
    outcome.camera = camera.source->description();
    outcome.clock = camera.source->clock();
    outcome.robot = robot->description();
    outcome.target = describeTarget(options.target);
    outcome.eye = eye;
    outcome.cdMo = cdMo;
    outcome.hasStarted = run.hasStarted();
    outcome.lostImages = camera.source->lost();
    outcome.lostRows = run.lostRows();
    outcome.unrecorded = run.unrecorded();
    outcome.realTime = run.realTime();
    outcome.laws = run.lawsUsed();
    outcome.remarks = camera.source->remarks();
    if (isLate(outcome) && recording.cycleCount() > 0) {
      outcome.hindrances = hindrancesAt(recording.last(), *robot, outcome);
    }
    writeResult(outcome, filmRecording(recording, eye, options, goal.points, out), commandLine, out);
  }
  catch (const std::exception &error) {
    if (recording.cycleCount() == 0) { // nothing to keep
      throw;
    }
    const std::string sentence = vpApp::sentenceOf(error);
    throw std::runtime_error(sentence + "; " + out.keepUnfinished(sentence));
  }
  return statusOf(outcome);
}
} // namespace visualServo
