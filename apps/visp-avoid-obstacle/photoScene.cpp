/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "photoScene.h"

#include "dataFile.h"
#include "greyPicture.h"
#include "jsonReader.h"
#include "numberText.h"
#include "otherArm.h"
#include "robot.h"

#include "lab/avoidance/vpSceneFrame.h"

#include <visp3/avoidance/vpObstacleDetector.h>
#include <visp3/manipulator/vpArmJson.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace avoidObstacle
{
namespace
{
constexpr double SAME_SIZE = 0.01; // relative

//! Image file of a target; the database has validated targets.json.
std::string imageOf(const std::string &folder, const std::string &target)
{
  const nlohmann::json list = vpApp::readJsonFile((std::filesystem::path(folder) / "targets.json").string());
  for (const nlohmann::json &entry : list.at("targets")) {
    if (entry.at("name") == target) {
      return (std::filesystem::path(folder) / entry.at("image").get<std::string>()).string();
    }
  }
  return {};
}

const vpPlanarTargetSighting &targetNamed(const std::vector<vpPlanarTargetSighting> &targets,
                                          const vpObjectPhoto &photo, const PhotoScene &scene)
{
  const auto found =
      std::find_if(targets.begin(), targets.end(), [&](const auto &target) { return target.name == photo.target; });
  if (found == targets.end()) {
    std::vector<std::string> names;
    for (const vpPlanarTargetSighting &target : targets) {
      names.push_back(target.name);
    }
    throw std::runtime_error(scene.known.source + ": photo of object " + photo.object + " is " + photo.target +
                             ", must be a target of " + scene.targets + ": " + vpApp::enumerate(names));
  }
  return *found;
}

//! The box must have the size of its photograph, which sets the metric scale.
void requireSize(const PhotoScene &scene, const vpObjectPhoto &photo, const Eigen::Vector3d &size,
                 const vpPlanarTargetSighting &target)
{
  if (std::fabs(size.x() / target.width - 1.) > SAME_SIZE || std::fabs(size.y() / target.height - 1.) > SAME_SIZE) {
    throw std::runtime_error(scene.known.source + ": size_m of object " + photo.object + " is " +
                             vpApp::number(size.x(), 4) + " x " + vpApp::number(size.y(), 4) + ", its photo " +
                             photo.target + " is " + vpApp::number(target.width, 4) + " x " +
                             vpApp::number(target.height, 4) + " m");
  }
}

void addObstacle(PhotoScene &scene, const vpCollisionObject &object)
{
  vpMovingObstacle obstacle;
  obstacle.object = object;
  scene.obstacles.push_back(obstacle);
}

void dress(PhotoScene &scene, const vpObjectPhoto &photo, const vpCollisionObject &box,
           const std::vector<vpPlanarTargetSighting> &targets)
{
  const vpPlanarTargetSighting &target = targetNamed(targets, photo, scene);
  const Eigen::Vector3d size = box.shape.size();
  requireSize(scene, photo, size, target);
  const double depth = target.depth > 0. ? target.depth : vpObstacleDetectorSpec().thickness;
  if (size.z() > depth * (1. + SAME_SIZE)) {
    scene.remarks.push_back("Object " + photo.object + " reaches " + vpApp::number(1000. * size.z(), 3) +
                            " mm behind its photograph, of which the database knows " +
                            vpApp::number(1000. * depth, 3) + " mm: the rest of it cannot be seen.");
  }
  vpScenePhoto dressed;
  dressed.object = photo.object;
  dressed.size = size.head<2>();
  vpPictures::GreyScale scale;
  vpApp::copyGrey(vpApp::readGreyPicture(imageOf(scene.targets, photo.target), scale), dressed.image);
  if (!scale.depthRemark().empty()) {
    scene.remarks.push_back("Photograph of object " + photo.object + ": " + scale.depthRemark());
  }
  scene.camera.photos.push_back(dressed);
  addObstacle(scene, box);
}

/*
 * For an object without a photograph. Sensors that need no photographs see all objects if none in the scene has one; if
 * some have, the others are known from the start, unless they move.
 */
bool mustBeSeen(const PhotoScene &scene, SensorKind sensor, const vpCollisionObject &object)
{
  const bool moves = object.velocity.linearNorm() > 0. || object.velocity.angularNorm() > 0.;
  if (sensor == SensorKind::Image && moves) {
    throw std::runtime_error(scene.known.source + ": object " + object.name +
                             " moves but has no photo, only what is seen may move");
  }
  return sensor != SensorKind::Image && (moves || scene.carriers.empty());
}

void requireTask(const PhotoScene &scene, const vpCollisionSceneFile &file)
{
  if (file.tasks.empty()) {
    throw std::runtime_error(scene.known.source + ": tasks is empty, there is nowhere to go");
  }
  if (file.tasks.front().start.size() != scene.arm->size()) {
    throw std::runtime_error(scene.known.source + ": task " + file.tasks.front().name + " is for " +
                             std::to_string(file.tasks.front().start.size()) + " joints, arm " + scene.arm->label() +
                             " has " + std::to_string(scene.arm->size()));
  }
}
} // namespace

std::string PhotoScene::carrierOf(const std::string &target) const
{
  for (const vpObjectPhoto &photo : carriers) {
    if (photo.target == target) {
      return photo.object;
    }
  }
  return target;
}

vpPlanarTargetDatabase loadTargets(const PhotoScene &scene)
{
  return vpPlanarTargetDatabase::fromFolder(scene.targets, scene.camera.camera, vpObstacleDetector::fastTargets());
}

PhotoScene loadPhotoScene(const Options &options)
{
  PhotoScene scene;
  const std::string file = options.scene.empty() ? vpApp::dataFile("scene/photo-box.json") : options.scene;
  const vpApp::Robot robot = vpApp::loadUsableRobot(options.robot);
  scene.arm = robot.arm;
  vpCollisionSceneFile content = vpLoadCollisionScene(file);
  scene.moved = options.scene.empty() && options.robot.robot != "amor";
  if (scene.moved) {
    moveToArm(vpLoadArmJson(vpApp::dataFile("robot/amor.json")), *scene.arm, content);
  }
  content.spec = vpIgnoreUncovered(*scene.arm, content.spec);
  scene.name = content.name;
  scene.known = content.spec;
  scene.carriers = content.photos;
  scene.remarks = content.warnings;
  scene.warnings = robot.warnings;
  vpApp::warnOfJointsBehind(*scene.arm, "end effector", scene.arm->toolLink(), scene.warnings);
  scene.targets = options.targets.empty()
                      ? std::filesystem::path(vpApp::dataFile("target/targets.json")).parent_path().string()
                      : options.targets;
  requireTask(scene, content);
  scene.task = content.tasks.front();
  if (content.spec.objects.empty()) {
    throw std::runtime_error(file + ": objects is empty, there is nothing to see");
  }
  if (options.sensor == SensorKind::Image && scene.carriers.empty()) {
    throw std::runtime_error(file + ": no object has a photo, --sensor image sees nothing; depth and poses need none");
  }
  const std::vector<vpPlanarTargetSighting> targets =
      scene.carriers.empty() ? std::vector<vpPlanarTargetSighting>() : loadTargets(scene).sightings();
  scene.known.objects.clear();
  for (const vpCollisionObject &object : content.spec.objects) {
    const auto photo = std::find_if(content.photos.begin(), content.photos.end(),
                                    [&](const vpObjectPhoto &p) { return p.object == object.name; });
    if (photo != content.photos.end()) {
      dress(scene, *photo, object, targets);
    }
    else if (mustBeSeen(scene, options.sensor, object)) {
      addObstacle(scene, object);
    }
    else {
      scene.known.objects.push_back(object);
    }
  }
  return scene;
}
} // namespace avoidObstacle
