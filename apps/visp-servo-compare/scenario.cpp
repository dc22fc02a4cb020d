/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "scenario.h"

#include "catalogue.h"
#include "fieldReader.h"
#include "format.h"

#include <visp3/core/vpMath.h>
#include <visp3/core/vpThetaUVector.h>

namespace servoCompare
{
namespace
{
using vpApp::JsonObject;

void readCamera(JsonObject camera, vpServoTask &task)
{
  const double px = camera.number("px");
  const double py = camera.number("py");
  const double u0 = camera.number("u0");
  const double v0 = camera.number("v0");
  for (const auto &focal : {std::make_pair("px", px), std::make_pair("py", py)}) {
    if (!(focal.second >= 1e-6)) { // vpCameraParameters has a less specific message
      throw camera.error(std::string(focal.first) + " is " + number(focal.second, 6) + ", must be > 0, at least 1e-6");
    }
  }
  task.camera.initPersProjWithoutDistortion(px, py, u0, v0);
  task.width = camera.count("width", task.width);
  task.height = camera.count("height", task.height);
  camera.finish();
}

void readObject(JsonObject object, vpServoTask &task)
{
  task.objectWidth = object.number("width_m");
  task.objectHeight = object.number("height_m");
  task.pointCount = object.count("points", task.pointCount);
  object.finish();
}

//! Position and theta u of the object in the camera.
vpHomogeneousMatrix readPose(JsonObject &pose)
{
  const std::vector<double> t = pose.numbers("position_m", 3);
  const std::vector<double> r = pose.numbers("rotation_deg", 3);
  return vpHomogeneousMatrix(vpTranslationVector(t[0], t[1], t[2]),
                             vpThetaUVector(vpMath::rad(r[0]), vpMath::rad(r[1]), vpMath::rad(r[2])));
}

void readSegments(JsonObject &file, vpServoTask &task)
{
  task.segments.clear();
  for (JsonObject &object : file.objects("segments")) {
    vpServoSegment segment;
    segment.name = object.text("name", std::to_string(task.segments.size() + 2));
    segment.cdMo = readPose(object);
    segment.duration = object.number("duration_s", segment.duration);
    object.finish();
    task.segments.push_back(segment);
  }
}

vpServoPlant readPlant(JsonObject &object)
{
  vpServoPlant plant;
  if (object.has("like")) {
    const std::string like = object.text("like", "");
    try {
      plant = vpServoPlant::byName(like);
    }
    catch (const std::exception &error) {
      throw object.error(error.what());
    }
  }
  plant.name = object.text("name", plant.name);
  vpApp::readFields(object, vpServoPlant::fields(), plant);
  object.finish();
  return plant;
}

void readPlants(JsonObject &file, std::vector<vpServoPlant> &plants)
{
  plants.clear();
  for (JsonObject &object : file.objects("plants")) {
    const vpServoPlant plant = readPlant(object);
    for (const vpServoPlant &other : plants) {
      if (other.name == plant.name) {
        throw object.error("there is a plant \"" + plant.name + "\" before, names must differ");
      }
    }
    try {
      plant.validate();
    }
    catch (const std::exception &error) {
      throw object.error(error.what());
    }
    plants.push_back(plant);
  }
}
} // namespace

Scenario::Scenario() : task(vpServoTask::thesis())
{
  for (const std::string &name : standardPlants()) {
    plants.push_back(vpServoPlant::byName(name));
  }
  faults.noise = 2.;
  faults.blur = 0.5;
  shape.angularAcceleration = 2.5 * shape.linearAcceleration;
  shape.angularJerk = 2.5 * shape.linearJerk;
}

Scenario readScenario(const std::string &file)
{
  const nlohmann::json json = vpApp::readJsonFile(file);
  JsonObject top(json, file);
  Scenario scenario;
  scenario.task.name = top.text("name", "my task");
  scenario.description = top.text("description", "");
  readCamera(top.object("camera"), scenario.task);
  readObject(top.object("object"), scenario.task);
  JsonObject start = top.object("start");
  scenario.task.initial = readPose(start);
  start.finish();
  readSegments(top, scenario.task);
  top.optional("gains", [&](JsonObject &object) { vpApp::readFields(object, vpServoGains::fields(), scenario.gains); });
  if (top.has("plants")) {
    readPlants(top, scenario.plants);
  }
  top.optional("image_faults",
               [&](JsonObject &object) { vpApp::readFields(object, vpCameraFaults::fields(), scenario.faults); });
  top.optional("shape",
               [&](JsonObject &object) { vpApp::readFields(object, vpTwistShaperLimits::fields(), scenario.shape); });
  top.optional("motion",
               [&](JsonObject &object) { vpApp::readFields(object, vpServoMotionLimits::fields(), scenario.motion); });
  top.finish();
  try {
    scenario.task.validate();
  }
  catch (const std::exception &error) {
    throw top.error(error.what());
  }
  return scenario;
}
} // namespace servoCompare
