/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "task.h"

#include "fieldReader.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>

#include <cmath>
#include <stdexcept>

namespace generatePattern
{
namespace
{
constexpr double longestBlur = 1000.; // px, limit of vpProductPattern
constexpr double farthest = 1e8;      // px
constexpr unsigned int mostFrames = 1000000;

[[noreturn]] void complain(Naming naming, const std::string &option, const std::string &field, const std::string &rest)
{
  throw std::runtime_error((naming == Naming::CommandLine ? "--" + option : field) + " is " + rest);
}

std::string textOf(const Pair &pair) { return shortNumber(pair[0]) + " " + shortNumber(pair[1]); }

void checkMotion(const Task &task, Naming naming)
{
  const Motion &motion = task.motion;
  if (!(motion.period >= 2. && motion.period <= 1e9)) {
    complain(naming, "swing-period", "motion.swing_period", shortNumber(motion.period) + " frames, must be 2..1e9");
  }
  const double share = task.product.exposure;
  double blur[2];
  for (const std::size_t k : {0U, 1U}) {
    const double fastest = std::fabs(motion.velocity[k]) + 2. * M_PI / motion.period * std::fabs(motion.swing[k]);
    blur[k] = share * fastest;
    const double far =
        std::fabs(motion.start[k]) + std::fabs(motion.velocity[k]) * task.frames + std::fabs(motion.swing[k]);
    if (!(far <= farthest)) {
      complain(naming, "motion", "motion.velocity",
               textOf(motion.velocity) + " px/frame, must keep the product within 1e8 px over all frames");
    }
  }
  if (!(std::hypot(blur[0], blur[1]) <= longestBlur)) {
    complain(naming, "motion", "motion.velocity",
             textOf(motion.velocity) + " px/frame, must move the product by at most 1000 px in the exposure");
  }
}
} // namespace

void check(const Task &task, Naming naming)
{
  if (task.frames < 1 || task.frames > mostFrames) {
    complain(naming, "frames", "frames", std::to_string(task.frames) + ", must be 1..1000000");
  }
  const double degrees = vpMath::deg(task.product.rotation);
  if (!(std::fabs(degrees) <= 180.)) {
    complain(naming, "rotation", "cells.rotation_deg", shortNumber(degrees) + " degrees, must be -180..180");
  }
  checkMotion(task, naming);
  try {
    task.product.validate();
  }
  catch (const vpException &error) { // "pitchX is ..."
    const std::string &sentence = error.getStringMessage();
    for (const FieldGroup &group : fieldGroups()) {
      for (const auto &field : group.fields) {
        const std::string start = std::string(field.name) + " is ";
        if (sentence.compare(0, start.size(), start) == 0) {
          complain(naming, optionNameOf(field), group.name + "." + fileNameOf(field), sentence.substr(start.size()));
        }
      }
    }
    throw std::runtime_error(sentence);
  }
}

namespace
{
void readGroup(vpApp::JsonObject object, const FieldGroup &group, vpProductPatternSpec &product)
{
  vpApp::readFields(object, group.fields, product, vpApp::Units::Omitted);
  if (group.name == "cells") {
    try {
      product.shape = shapeOf(object.text("shape", vpToString(product.shape)));
    }
    catch (const std::runtime_error &) {
      throw object.wrong("shape", object.value("shape"), "rectangle, rounded or dot");
    }
    product.rotation = vpMath::rad(object.number("rotation_deg", vpMath::deg(product.rotation)));
  }
  object.finish();
}

void readMotion(vpApp::JsonObject object, Motion &motion)
{
  const auto readPair = [&object](const char *name, Pair &pair) {
    if (object.has(name)) {
      const std::vector<double> values = object.numbers(name, 2);
      pair = {{values[0], values[1]}};
    }
  };
  readPair("start", motion.start);
  readPair("velocity", motion.velocity);
  readPair("swing", motion.swing);
  motion.period = object.number("swing_period", motion.period);
  object.finish();
}
} // namespace

Task readTask(const std::string &file)
{
  const nlohmann::json json = vpApp::readJsonFile(file);
  vpApp::JsonObject top(json, file);
  Task task;
  for (const FieldGroup &group : fieldGroups()) {
    if (top.has(group.name)) {
      readGroup(top.object(group.name), group, task.product);
    }
  }
  if (top.has("motion")) {
    readMotion(top.object("motion"), task.motion);
  }
  task.frames = top.count("frames", task.frames);
  static_cast<void>(top.text("comment", ""));
  top.finish();
  try {
    check(task, Naming::File);
  }
  catch (const std::runtime_error &error) {
    throw top.error(error.what());
  }
  return task;
}

nlohmann::ordered_json jsonOf(const Task &task)
{
  nlohmann::ordered_json json;
  for (const FieldGroup &group : fieldGroups()) {
    for (const auto &field : group.fields) {
      std::visit([&](auto pointer) { json[group.name][fileNameOf(field)] = task.product.*pointer; }, field.member);
    }
  }
  json["cells"]["shape"] = vpToString(task.product.shape);
  json["cells"]["rotation_deg"] = vpMath::deg(task.product.rotation);
  json["motion"] = {{"start", task.motion.start},
                    {"velocity", task.motion.velocity},
                    {"swing", task.motion.swing},
                    {"swing_period", task.motion.period}};
  json["frames"] = task.frames;
  return json;
}
} // namespace generatePattern
