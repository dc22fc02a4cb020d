/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What --teach writes: the goal, or a reference image alone, from where the camera stands.
#include "camera.h"
#include "goal.h"
#include "picture.h"
#include "session.h"
#include "target.h"

#include "appMain.h"
#include "numberText.h"
#include "outputFile.h"

#include <visp3/core/vpMath.h>
#include <visp3/servoing/vpReferenceTeacher.h>

#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <iostream>
#include <stdexcept>

namespace visualServo
{
namespace
{
constexpr unsigned int TAUGHT = 25, MOST_TAUGHT = 150; // images

void teachReference(const Options &options, vpApp::ImageSource &source)
{
  vpReferenceTeacher teacher(TAUGHT);
  vpImage<unsigned char> image;
  std::string moved;
  for (unsigned int i = 0; i < MOST_TAUGHT && !teacher.isComplete() && source.next(image); ++i) {
    try {
      moved = teacher.add(image) ? moved : " " + teacher.message();
    }
    catch (const vpException &error) {
      throw std::runtime_error(source.name() + ": " + vpApp::sentenceOf(error));
    }
  }
  vpApp::throwIfInterrupted();
  if (!teacher.isComplete()) {
    throw std::runtime_error(source.description() + " gave no " + std::to_string(TAUGHT) +
                             " images in succession of a camera and a scene at rest." + moved);
  }
  vpApp::writeWholeFile(options.teach, pngOf(matOf(teacher.image())));
  std::cout << "Reference image: mean of " << TAUGHT << " images, noise of a corner "
            << vpApp::number(teacher.pointNoise(), 2) << " px in one of them, "
            << vpApp::number(teacher.averageNoise(), 2) << " px in their mean.\nWritten: " << options.teach
            << " for --reference." << std::endl;
}

void teachGoal(const Options &options, const Camera &camera)
{
  const std::unique_ptr<vpServoVision> vision = makeVision(options, camera.eye.intrinsics);
  const std::filesystem::path file = options.teach;
  vpImage<unsigned char> image;
  vpServoSight sight;
  std::vector<vpHomogeneousMatrix> poses;
  cv::Mat sum = cv::Mat::zeros(static_cast<int>(camera.eye.height), static_cast<int>(camera.eye.width), CV_64FC1);
  for (std::size_t i = 0; i < MOST_TAUGHT && poses.size() < TAUGHT && camera.source->next(image); ++i) {
    vision->see(image, camera.source->time(), nullptr, sight);
    if (sight.measurement.valid) {
      poses.push_back(sight.measurement.cMo);
      cv::accumulate(matOf(image), sum);
    }
  }
  vpApp::throwIfInterrupted();
  const Goal goal = [&] {
    try {
      return meanGoal(poses);
    }
    catch (const std::runtime_error &error) {
      throw std::runtime_error(std::string(error.what()) +
                               (poses.size() < 2 ? "; the last: " + vision->message() : ""));
    }
  }();
  cv::Mat mean;
  sum.convertTo(mean, CV_8UC1, 1. / static_cast<double>(poses.size()));
  const std::filesystem::path picture = std::filesystem::path(file).replace_extension(".png");
  vpApp::writeWholeFile(picture, pngOf(mean));
  vpApp::writeWholeFile(file, goalText(goal));
  std::cout << "Goal: the target is at (" << vpApp::fixed(goal.cdMo[0][3], 4) << ", "
            << vpApp::fixed(goal.cdMo[1][3], 4) << ", " << vpApp::fixed(goal.cdMo[2][3], 4)
            << ") m in the camera, mean of " << goal.images << " images that scatter by "
            << vpApp::number(1e3 * goal.positionSpread, 2) << " mm and "
            << vpApp::number(vpMath::deg(goal.rotationSpread), 2) << " degrees.\n"
            << "Written: " << file.string() << " for --goal, " << picture.string() << " for --reference." << std::endl;
}
} // namespace

int teach(const Options &given)
{
  Options options = given;
  options.motion.dryRun = true;
  const std::unique_ptr<Robot> robot = openRobot(options);
  const Camera camera = openCamera(options, *robot);
  vpApp::requireWritable(options.teach);
  if (options.teachesGoal()) {
    teachGoal(options, camera);
  }
  else {
    teachReference(options, *camera.source);
  }
  return vpApp::ExitOk;
}
} // namespace visualServo
