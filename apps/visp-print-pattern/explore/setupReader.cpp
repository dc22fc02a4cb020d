/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "design.h"

#include "jsonReader.h"
#include "numberText.h"
#include "outcome.h"

#include <algorithm>

namespace printExplore
{
namespace
{
using nlohmann::json;
using vpApp::JsonObject;

constexpr double mostDesigns = 1e6;

//! \brief Valid range of a number.
struct Range {
  double least, most;
  [[nodiscard]] bool holds(double value) const { return value >= least && value <= most; }
  [[nodiscard]] std::string text() const { return vpApp::number(least, 7) + ".." + vpApp::number(most, 7); }
};

void take(JsonObject &object, const char *field, const Range &range, double &value)
{
  const double given = object.number(field, value);
  if (!range.holds(given)) {
    throw object.wrong(field, object.value(field), range.text());
  }
  value = given;
}

void take(JsonObject &object, const char *field, const Range &range, int &value)
{
  const double given = object.count(field, static_cast<unsigned int>(value));
  if (!range.holds(given)) {
    throw object.wrong(field, object.value(field), range.text());
  }
  value = static_cast<int>(given);
}

Axis rangeOf(JsonObject object, const Range &range)
{
  const double from = object.number("from"), to = object.number("to");
  const std::string scale = object.text("scale", "linear");
  for (const char *end : {"from", "to"}) {
    if (!range.holds(object.number(end))) {
      throw object.wrong(end, object.value(end), range.text());
    }
  }
  if (!(to > from)) {
    throw object.wrong("to", object.value("to"), "more than from");
  }
  if (scale != "linear" && scale != "log") {
    throw object.wrong("scale", object.value("scale"), "linear or log");
  }
  int steps = 5;
  take(object, "steps", {2., 1000.}, steps);
  object.finish();
  return Axis::range(from, to, steps, scale == "log");
}

//! A number, a list of numbers, or a range.
void takeAxis(JsonObject &object, const char *field, const Range &range, Axis &axis)
{
  if (!object.has(field)) {
    return;
  }
  const json &value = object.value(field);
  if (value.is_object()) {
    axis = rangeOf(object.object(field), range);
    return;
  }
  const json list = value.is_array() ? value : json::array({value});
  bool good = !list.empty();
  for (const json &item : list) {
    good = good && item.is_number() && range.holds(item.get<double>());
  }
  if (!good) {
    throw object.wrong(field, value,
                       "a number, a list of numbers or a range from, to, steps, scale, within " + range.text());
  }
  axis = Axis::list(list.get<std::vector<double>>());
}

void takeImages(JsonObject &object, DesignSpace &space)
{
  if (!object.has("image_px")) {
    return;
  }
  const json &list = object.value("image_px");
  bool good = list.is_array() && !list.empty();
  space.images.clear();
  for (std::size_t i = 0; good && i < list.size(); ++i) {
    good = list[i].is_array() && list[i].size() == 2;
    for (std::size_t k = 0; good && k < 2; ++k) {
      good = list[i][k].is_number_unsigned() && list[i][k].get<unsigned int>() >= 8 &&
             list[i][k].get<unsigned int>() <= 4096;
    }
    if (good) {
      space.images.push_back({{list[i][0].get<unsigned int>(), list[i][1].get<unsigned int>()}});
    }
  }
  if (!good) {
    throw object.wrong("image_px", list, "a list of [width, height], each 8..4096");
  }
}

void takeControllers(JsonObject &object, DesignSpace &space)
{
  if (!object.has("controller")) {
    return;
  }
  const json &value = object.value("controller");
  const json list = value.is_array() ? value : json::array({value});
  space.controllers.clear();
  for (const json &item : list) {
    for (const auto controller :
         {vpPrintController::Pid, vpPrintController::PidFeedforward, vpPrintController::Observer}) {
      if (item.is_string() && item.get<std::string>() == nameOf(controller)) {
        space.controllers.push_back(controller);
      }
    }
  }
  if (space.controllers.empty() || space.controllers.size() != list.size()) {
    throw object.wrong("controller", value, "pid, pid-ff or observer, or a list of them");
  }
}

DesignSpace spaceOf(JsonObject object)
{
  DesignSpace space;
  takeAxis(object, "frame_rate_hz", {50., 200000.}, space.frameRate);
  takeImages(object, space);
  takeAxis(object, "um_per_px", {0.2, 50.}, space.pixelSize);
  takeAxis(object, "exposure_us", {0.1, 20000.}, space.exposure);
  takeControllers(object, space);
  takeAxis(object, "drop_velocity_mm_s", {1., 2000.}, space.dropVelocity);
  takeAxis(object, "speed_up", {1., 1.6}, space.speedUp);
  object.finish();
  return space;
}

void readTask(JsonObject object, Task &task)
{
  take(object, "cells", {2., 10000.}, task.cells);
  take(object, "runs", {1., 60.}, task.runs);
  take(object, "jitter_um", {0., 5.}, task.jitter);
  take(object, "flex_um", {0., 40.}, task.flex);
  take(object, "flex_period_cells", {4., 1e6}, task.flexPeriod);
  object.finish();
}

void readCamera(JsonObject object, Camera &camera)
{
  take(object, "pixel_rate_mpx_s", {0.01, 1e6}, camera.pixelRate);
  take(object, "link_mb_s", {0.01, 1e6}, camera.link);
  camera.overlap = object.flag("overlap", camera.overlap);
  take(object, "interface_us", {0., 1e5}, camera.interfaceTime);
  take(object, "dark", {0., 255.}, camera.dark);
  take(object, "bright", {1., 255.}, camera.bright);
  take(object, "light_exposure_us", {0.1, 1e5}, camera.lightExposure);
  take(object, "light_um_per_px", {0.1, 100.}, camera.lightPixel);
  take(object, "full_grey", {1., 255.}, camera.fullGrey);
  take(object, "noise", {0., 50.}, camera.noise);
  take(object, "blur_um", {0., 100.}, camera.blur);
  if (camera.dark >= camera.bright) {
    throw object.error("dark is " + vpApp::number(camera.dark, 4) + ", must be less than bright");
  }
  object.finish();
}

void readProcessor(JsonObject object, Processor &processor)
{
  take(object, "frame_us", {0., 1e6}, processor.frame);
  take(object, "cell_us", {0., 1e6}, processor.cell);
  take(object, "cell_pixel_ns", {0., 1e6}, processor.cellPixel);
  take(object, "pid_us", {0., 1e6}, processor.pid);
  take(object, "observer_us", {0., 1e6}, processor.observer);
  take(object, "max_load", {1e-6, 1.}, processor.maxLoad);
  object.finish();
}

std::vector<std::string> namesOfFigures()
{
  std::vector<std::string> names;
  for (const Figure &figure : figures()) {
    names.emplace_back(figure.name);
  }
  return names;
}

void readObjectives(JsonObject &top, Setup &setup)
{
  if (!top.has("objectives")) {
    return;
  }
  const json &list = top.value("objectives");
  const std::vector<std::string> known = namesOfFigures();
  setup.objectives.clear();
  bool good = list.is_array() && !list.empty();
  for (std::size_t i = 0; good && i < list.size(); ++i) {
    good = list[i].is_string() && std::count(known.begin(), known.end(), list[i].get<std::string>()) == 1 &&
           std::count(list.begin(), list.end(), list[i]) == 1;
    if (good) {
      setup.objectives.push_back(list[i].get<std::string>());
    }
  }
  if (!good) {
    throw top.wrong("objectives", list, "a list of some of " + vpApp::enumerate(known) + ", each once");
  }
}

void readRequirements(JsonObject object, Setup &setup)
{
  for (const std::string &name : namesOfFigures()) {
    if (object.has(name)) {
      setup.requirements.push_back({name, object.number(name)});
    }
  }
  object.finish();
}

void makeDesigns(JsonObject &top, const DesignSpace &space, Setup &setup)
{
  int samples = 0;
  take(top, "samples", {0., mostDesigns}, samples);
  setup.sampled = samples > 0;
  if (setup.sampled) {
    setup.designs = space.samples(static_cast<unsigned int>(samples), setup.seed);
  }
  else if (space.gridSize() > mostDesigns) {
    throw top.error("the grid has " + vpApp::number(space.gridSize(), 4) +
                    " designs, must be at most 1000000; use samples");
  }
  else {
    setup.designs = space.grid();
  }
  if (top.flag("thesis", true)) { // also its camera, with the same controllers
    for (const vpPrintController controller : space.controllers) {
      const Design design = Design::thesis(controller);
      if (std::find(setup.designs.begin(), setup.designs.end(), design) == setup.designs.end()) {
        setup.designs.push_back(design);
      }
    }
  }
}
} // namespace

Setup readSetup(const std::string &text, const std::string &file)
{
  const json value = vpApp::parseJson(text, file);
  JsonObject top(value, file);
  Setup setup;
  setup.name = top.text("name", setup.name);
  static_cast<void>(top.text("comment", ""));
  setup.seed = top.count("seed", setup.seed);
  const DesignSpace space = top.has("design") ? spaceOf(top.object("design")) : DesignSpace();
  makeDesigns(top, space, setup);
  if (top.has("task")) {
    readTask(top.object("task"), setup.task);
  }
  if (top.has("camera")) {
    readCamera(top.object("camera"), setup.camera);
  }
  if (top.has("processor")) {
    readProcessor(top.object("processor"), setup.processor);
  }
  take(top, "max_acceleration_m_s2", {0.1, 1e5}, setup.maxAcceleration);
  take(top, "min_cells_in_view", {1., 1000.}, setup.minCells);
  readObjectives(top, setup);
  if (top.has("require")) {
    readRequirements(top.object("require"), setup);
  }
  top.finish();
  return setup;
}
} // namespace printExplore
