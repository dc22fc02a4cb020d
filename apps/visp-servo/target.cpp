/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "target.h"

#include "goal.h"

#include "appMain.h"
#include "dataFile.h"
#include "greyPicture.h"
#include "numberText.h"

#include <visp3/servoing/vpReferenceVision.h>

#include <algorithm>
#include <stdexcept>

namespace visualServo
{
namespace
{
constexpr double FILLED = 0.5;        // share of the view that the target fills at the goal where none is given
constexpr double DEFAULT_SIZE = 0.12; // m
} // namespace

Photo readPhoto(const TargetOptions &options)
{
  Photo photo;
  const bool isDefault = options.photo.empty();
  photo.file = isDefault ? vpApp::dataFile("target/klimt.jpg") : options.photo;
  vpPictures::GreyScale depth;
  vpApp::copyGrey(vpApp::readGreyPicture(photo.file, depth), photo.image);
  photo.width = options.width;
  if (!(photo.width > 0.)) {
    if (!isDefault) {
      throw vpApp::UsageError("--target is given without --size, its width or width,height in m");
    }
    photo.width = DEFAULT_SIZE;
  }
  photo.height = options.height > 0. ? options.height : photo.width * photo.image.getHeight() / photo.image.getWidth();
  return photo;
}

vpImage<unsigned char> readReference(const TargetOptions &options)
{
  vpPictures::GreyScale depth;
  vpImage<unsigned char> image;
  vpApp::copyGrey(vpApp::readGreyPicture(options.reference, depth), image);
  return image;
}

std::unique_ptr<vpServoVision> makeVision(const Options &options, const vpCameraParameters &camera)
{
  const TargetOptions &target = options.target;
  if (!target.tagFamily.empty()) {
    return vpServoVision::tag(target.tagFamily, target.tagId, target.width, camera);
  }
  if (!target.reference.empty()) {
    vpReferenceVisionSpec spec;
    spec.pose.nearest = target.nearest;
    spec.pose.farthest = target.farthest;
    return std::make_unique<vpReferenceVision>(readReference(target), camera, spec);
  }
  const Photo photo = readPhoto(target);
  try {
    return vpServoVision::photograph(photo.image, photo.width, photo.height, camera);
  }
  catch (const vpException &error) {
    throw std::runtime_error(photo.file + ": " + vpApp::sentenceOf(error));
  }
}

std::string describeTarget(const TargetOptions &options)
{
  if (!options.reference.empty()) {
    return "what " + std::filesystem::path(options.reference).filename().string() + " shows, of unknown size";
  }
  if (!options.tagFamily.empty()) {
    return "the AprilTag " + std::to_string(options.tagId) + " of " + options.tagFamily + ", " +
           vpApp::number(options.width, 4) + " m wide";
  }
  const Photo photo = readPhoto(options);
  return std::filesystem::path(photo.file).filename().string() + ", " + vpApp::number(photo.width, 4) + " m x " +
         vpApp::number(photo.height, 4) + " m";
}

vpHomogeneousMatrix goalPose(const Options &options, const Eye &eye)
{
  const TargetOptions &target = options.target;
  if (target.goalPose) {
    return *target.goalPose;
  }
  if (!target.goalFile.empty()) {
    return readGoal(target.goalFile).cdMo;
  }
  double targetWidth = target.width, targetHeight = target.width;
  if (target.tagFamily.empty()) {
    const Photo photo = readPhoto(target);
    targetWidth = photo.width;
    targetHeight = photo.height;
  }
  const double distance =
      std::max(eye.intrinsics.get_px() * targetWidth / eye.width, eye.intrinsics.get_py() * targetHeight / eye.height) /
      FILLED;
  return vpHomogeneousMatrix(0., 0., distance, 0., 0., 0.);
}
} // namespace visualServo
