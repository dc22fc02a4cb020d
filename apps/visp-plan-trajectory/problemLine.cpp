/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "problemLine.h"

#include "jsonReader.h"

#include <visp3/core/vpException.h>
#include <visp3/trajectory/vpDirectTrajectory.h>
#include <visp3/trajectory/vpMotionForm.h>

#include <cmath>
#include <limits>
#include <utility>

namespace planTrajectory
{
namespace
{
using nlohmann::json;
using vpApp::JsonObject;
using Vector = vpAxisVector<Eigen::Dynamic>;

constexpr double infinity = std::numeric_limits<double>::infinity();

//! Meaning of null in a field.
enum class Null { Forbidden, NoUpperLimit, NoLowerLimit };

double axisValue(const JsonObject &object, const std::string &field, const json &value, Null null)
{
  if (value.is_null() && null != Null::Forbidden) {
    return null == Null::NoUpperLimit ? infinity : -infinity;
  }
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw object.wrong(field, value, null == Null::Forbidden ? "a number" : "a number, or null for no limit");
  }
  return value.get<double>();
}

//! One number per axis: a list, or a single number for all axes.
void readVector(JsonObject &object, const std::string &field, Vector &vector, Null null = Null::Forbidden)
{
  if (!object.has(field)) {
    return;
  }
  const json &value = object.value(field);
  if (!value.is_array()) {
    vector.setConstant(axisValue(object, field, value, null));
    return;
  }
  if (value.size() != static_cast<std::size_t>(vector.size())) {
    throw object.error(field + " has " + std::to_string(value.size()) + " numbers, must have " +
                       std::to_string(vector.size()) + ", one for each axis");
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    vector[static_cast<Eigen::Index>(i)] = axisValue(object, field + "[" + std::to_string(i) + "]", value[i], null);
  }
}

//! A field whose value is one of several words.
template <class Enum>
void readWord(JsonObject &object, const std::string &field, Enum &choice,
              const std::vector<std::pair<const char *, Enum>> &words)
{
  if (!object.has(field)) {
    return;
  }
  std::string known;
  for (const auto &word : words) {
    if (object.value(field) == word.first) {
      choice = word.second;
      return;
    }
    known += (known.empty() ? "" : ", ") + std::string(word.first);
  }
  throw object.wrong(field, object.value(field), "one of " + known);
}

void readVias(JsonObject &object, Input &input)
{
  if (!object.has("via")) {
    return;
  }
  input.vias.clear();
  if (object.value("via").is_array() && object.value("via").empty()) {
    return; // an event that removes them
  }
  for (JsonObject &item : object.objects("via")) {
    vpTrajectoryVia<Eigen::Dynamic> via(static_cast<int>(input.goal.q.size()));
    via.tau = item.number("tau", via.tau);
    if (item.has("tau") && via.tau == vpAutomaticTau) {
      throw item.wrong("tau", item.value("tau"), "in (0, 1), or left out");
    }
    static_cast<void>(item.value("q")); // required
    readVector(item, "q", via.q);
    via.hasVelocity = item.has("v");
    readVector(item, "v", via.v);
    via.hasAcceleration = item.has("a");
    readVector(item, "a", via.a);
    if (via.hasAcceleration && !via.hasVelocity) {
      throw item.error("has an acceleration \"a\" but no velocity \"v\"");
    }
    item.finish();
    input.vias.push_back(std::move(via));
  }
}

void readGroups(JsonObject &object, vpTrajectorySpec &spec)
{
  if (!object.has("groups")) {
    return;
  }
  std::vector<JsonObject> groups = object.objects("groups");
  if (groups.size() > spec.groups.size()) {
    throw object.error("there are " + std::to_string(groups.size()) + " groups, at most " +
                       std::to_string(spec.groups.size()) + " are possible");
  }
  spec.groups.fill({});
  for (std::size_t k = 0; k < groups.size(); ++k) {
    vpAxisGroup &group = spec.groups[k];
    const json &axes = groups[k].value("axes");
    if (!axes.is_array() || axes.empty()) {
      throw groups[k].wrong("axes", axes, "a list of axis numbers, from 0");
    }
    for (const json &axis : axes) {
      if (!axis.is_number_unsigned() || axis.get<std::uint64_t>() > 63) {
        throw groups[k].wrong("axes", axes, "a list of axis numbers from 0 to 63");
      }
      group.axes |= std::uint64_t(1) << axis.get<std::uint64_t>();
    }
    group.maxSpeed = groups[k].number("v_max", group.maxSpeed);
    group.maxAcceleration = groups[k].number("a_max", group.maxAcceleration);
    groups[k].finish();
  }
}

void readSpec(JsonObject &object, vpTrajectorySpec &spec)
{
  const bool timed = object.has("duration");
  if (timed && !object.has("policy") && spec.policy == vpReplanPolicy::EventMinTime) {
    spec.policy = vpReplanPolicy::FixedArrival;
  }
  readWord(object, "policy", spec.policy,
           {{"EventMinTime", vpReplanPolicy::EventMinTime},
            {"KeepArrival", vpReplanPolicy::KeepArrival},
            {"FixedArrival", vpReplanPolicy::FixedArrival}});
  if (timed) {
    const bool fixed = spec.policy == vpReplanPolicy::FixedArrival;
    (fixed ? spec.arrivalTime : spec.minimumDuration) = object.number("duration");
  }
  readWord(object, "synchronisation", spec.synchronisation,
           {{"Time", vpSynchronisation::Time},
            {"Straight", vpSynchronisation::Straight},
            {"None", vpSynchronisation::None}});
  readWord(object, "late", spec.lateArrival,
           {{"Extend", vpLateArrival::Extend}, {"ExceedLimits", vpLateArrival::ExceedLimits}});
  spec.cruise = object.flag("cruise", spec.cruise);
  if (object.has("form")) {
    try {
      spec.form = vpMotionForm::find(object.text("form"));
    }
    catch (const vpException &error) {
      throw object.error(error.getStringMessage());
    }
  }
  readGroups(object, spec);
}

//! Fields that events may also change.
void readTask(JsonObject &object, Input &input)
{
  readVector(object, "q1", input.goal.q);
  readVector(object, "v1", input.goal.v);
  readVector(object, "a1", input.goal.a);
  readVector(object, "j1", input.goal.j);
  readVector(object, "v_max", input.maxVelocity, Null::NoUpperLimit);
  readVector(object, "a_max", input.maxAcceleration, Null::NoUpperLimit);
  readVector(object, "j_max", input.maxJerk, Null::NoUpperLimit);
  readVector(object, "q_min", input.minPosition, Null::NoLowerLimit);
  readVector(object, "q_max", input.maxPosition, Null::NoUpperLimit);
  readVias(object, input);
  readSpec(object, input.spec);
}

//! Fields of the whole motion.
void readMethod(JsonObject &object, vpTrajectorySpec &spec)
{
  readWord(
      object, "continuity", spec.continuity,
      {{"C1", vpTrajectoryContinuity::C1}, {"C2", vpTrajectoryContinuity::C2}, {"C3", vpTrajectoryContinuity::C3}});
  readWord(object, "method", spec.method,
           {{"Exact", vpDurationMethod::Exact}, {"ThesisIteration", vpDurationMethod::ThesisIteration}});
  if (object.has("thesis_steps_per_cycle")) {
    const unsigned int most = 1000000;
    spec.thesisStepsPerCycle = static_cast<int>(std::min(object.count("thesis_steps_per_cycle", 1), most));
  }
  spec.thesisVelocityGain = object.number("thesis_velocity_gain", spec.thesisVelocityGain);
  spec.thesisAccelerationGain = object.number("thesis_acceleration_gain", spec.thesisAccelerationGain);
  spec.replanPeriod = object.number("replan_period", spec.replanPeriod);
  spec.freeze = object.number("freeze", spec.freeze);
}

void readEvents(JsonObject &object, Problem &problem)
{
  if (!object.has("events")) {
    return;
  }
  if (object.value("events").is_array() && object.value("events").empty()) {
    return;
  }
  for (JsonObject &item : object.objects("events")) {
    Event event;
    event.input = problem.events.empty() ? problem.input : problem.events.back().input;
    event.t = item.number("t");
    const double earliest = problem.events.empty() ? 0. : problem.events.back().t;
    if (!(event.t > earliest)) {
      throw item.wrong("t", item.value("t"), "above " + json(earliest).dump() + ", the time of what is before it");
    }
    readTask(item, event.input);
    item.finish();
    problem.events.push_back(std::move(event));
  }
}

int axisCount(JsonObject &object)
{
  const json &goal = object.value("q1");
  if (goal.is_array() && goal.empty()) {
    throw object.wrong("q1", goal, "a list of at least one number");
  }
  return goal.is_array() ? static_cast<int>(goal.size()) : 1;
}
} // namespace

Problem readProblem(const std::string &text, const std::string &place, std::size_t line, nlohmann::ordered_json *id)
{
  const json parsed = vpApp::parseJsonLine(text, place);
  JsonObject object(parsed, place);
  Problem problem;
  problem.place = place;
  problem.line = line;
  problem.id = object.has("id") ? nlohmann::ordered_json(parsed["id"]) : nlohmann::ordered_json();
  if (id != nullptr) {
    *id = problem.id;
  }
  static_cast<void>(object.has("comment"));
  problem.input = Input(axisCount(object));
  problem.input.maxVelocity.setConstant(infinity);
  problem.input.maxAcceleration.setConstant(infinity);
  readVector(object, "q0", problem.input.start.q);
  readVector(object, "v0", problem.input.start.v);
  readVector(object, "a0", problem.input.start.a);
  readVector(object, "j0", problem.input.start.j);
  readTask(object, problem.input);
  readMethod(object, problem.input.spec);
  if (object.flag("optimise_vias", false)) {
    // An invalid problem stays as it is; planning tells what is wrong.
    static_cast<void>(vpDirectTrajectory<Eigen::Dynamic>::optimiseVias(problem.input));
  }
  problem.dt = object.number("dt", problem.dt);
  if (!(problem.dt > 0.)) {
    throw object.wrong("dt", object.value("dt"), "> 0");
  }
  readEvents(object, problem);
  object.finish();
  return problem;
}
} // namespace planTrajectory
