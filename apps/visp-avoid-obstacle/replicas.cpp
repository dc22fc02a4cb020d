/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "replicas.h"

#include "planeMotion.h"

#include "numberText.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>

namespace avoidObstacle
{
namespace
{
struct Entry {
  std::string title;
  Replica (*play)(const Options &);
};

const std::map<std::string, Entry> &entries()
{
  static const std::map<std::string, Entry> all = {
      {"fig8.6", {"Avoidance on path level by a potential field, strict and mild parameters", playFieldReplica}},
      {"fig8.7", {"Simulated direct trajectory, point to point, interrupted under way", playPointReplica}},
      {"fig8.8", {"Direct trajectory of the arm, point to point, interrupted under way", playArmReplica}},
      {"fig8.9", {"Simulated direct trajectory through a via that appears under way", playPointReplica}},
      {"fig8.10", {"Direct trajectory of the arm through a via that appears under way", playArmReplica}},
      {"fig8.11", {"Snapshots of figure 8.8", playArmReplica}},
      {"fig8.12", {"Snapshots of figure 8.10", playArmReplica}},
      {"fig8.13", {"Simulated direct trajectory to an object that moves", playPointReplica}}};
  return all;
}
} // namespace

const std::vector<std::string> &replicaNames()
{
  static const std::vector<std::string> names = {"fig8.6",  "fig8.7",  "fig8.8",  "fig8.9",
                                                 "fig8.10", "fig8.11", "fig8.12", "fig8.13"};
  return names;
}

const std::string &replicaTitle(const std::string &name) { return entries().at(name).title; }

Replica playReplica(const Options &options) { return entries().at(options.replica).play(options); }

// Figure 8.6: a potential field as printed, with two sets of parameters.

namespace
{
using Eigen::Vector2d;
using vpApp::number;

constexpr double REACHED = 0.005; // m

std::string csvOf(const FieldMotion &motion)
{
  std::string csv = "time_s,x_m,y_m,weight\n";
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    csv += number(motion.times[i], 7) + "," + number(motion.way[i].x(), 9) + "," + number(motion.way[i].y(), 9) + "," +
           number(motion.weights[i], 9) + "\n";
  }
  return csv;
}

std::string missedText(const FieldMotion &motion)
{
  std::vector<std::string> parts;
  for (const double m : motion.missed) {
    parts.push_back(number(1000. * m, 3));
  }
  return vpApp::enumerate(parts) + " mm";
}

bool missesVias(const FieldMotion &motion) { return motion.missed[0] >= REACHED && motion.missed[1] >= REACHED; }

void add(const char *name, const FieldMotion &motion, Replica &replica)
{
  replica.tables.emplace_back(std::string("field-") + name + ".csv", csvOf(motion));
  replica.numbers[name] = {{"d0_m", motion.weight.centre},
                           {"ks_m", motion.weight.width},
                           {"missed_m", motion.missed},
                           {"end_m", {motion.way.back().x(), motion.way.back().y()}},
                           {"end_reached", motion.missed.back() < REACHED},
                           {"peak_v", motion.peakSpeed}};
}
} // namespace

Replica playFieldReplica(const Options &options)
{
  Replica replica;
  replica.name = options.replica;
  replica.title = replicaTitle(options.replica);
  const FieldTask task;
  const FieldMotion strict = followField(task, strictField()), mild = followField(task, mildField()),
                    undisturbed = followField(task, mildField(), false);
  const bool strictFails = strict.missed.back() >= REACHED, mildReaches = mild.missed.back() < REACHED;
  replica.findings = {"With the strict parameters the point ends " + number(1000. * strict.missed.back(), 3) +
                          " mm from its end and " + (strictFails ? "does not reach it" : "reaches it") +
                          ", with the mild ones " + number(1000. * mild.missed.back(), 3) +
                          " mm from it, which counts as " + (mildReaches ? "reached." : "missed."),
                      "Nothing is known of speeds beforehand: they go up to " + number(strict.peakSpeed, 3) + " and " +
                          number(mild.peakSpeed, 3) +
                          " m/s and jump where a new position is given or the obstacle comes into view."};
  replica.comparisons = {
      {"strict (upper): end reached", "no", strictFails ? "no" : "yes", strictFails},
      {"mild (lower): end reached", "yes", mildReaches ? "yes" : "no", mildReaches},
      {"strict: vias reached", "no", "missed by " + missedText(strict) + " (the end last)", missesVias(strict)},
      {"mild: vias reached", "no", "missed by " + missedText(mild) + " (the end last)", missesVias(mild)},
      {"mild stays closer to the way without obstacle", "yes", "missed by " + missedText(mild) + " (the end last)",
       mild.missed[1] < strict.missed[1]},
      {"bounds on speed and acceleration", "none", "none"},
      {"clearance", "not given",
       number(1000. * (strict.way.back() - task.obstacle).norm(), 3) + " and " +
           number(1000. * (mild.way.back() - task.obstacle).norm(), 3) + " mm from the obstacle's centre in the end"}};
  replica.choices = {
      "The thesis gives no numbers: places, obstacle, d_0 = 0.12 and 0.06 m, k_s = 0.06 and 0.03 m, w_s = 0.5, gain 2 "
      "/s "
      "and x'_oa = 0.25 m/s are ours. Distances are in m instead of px, which is a matter of scale.",
      "As in the text only x is affected by the obstacle; the camera sees it while it is within 0.2 m along y."};
  add("strict", strict, replica);
  add("mild", mild, replica);
  replica.tables.emplace_back("field-alone.csv", csvOf(undisturbed));
  replica.numbers["obstacle_m"] = {task.obstacle.x(), task.obstacle.y()};
  for (const Vector2d &place : task.places) {
    replica.numbers["places_m"].push_back({place.x(), place.y()});
  }
  return replica;
}

// Figures 8.7, 8.9 and 8.13: simulations of a point in the plane.

namespace
{
using Eigen::Vector2d;
using vpApp::fixed;
using vpApp::number;

constexpr double ROUNDING = 1e-9;   // relative tolerance of a bound
constexpr double GOAL_NOISE = 0.01; // m
constexpr double NOISY_UNTIL = 1.9; // s

std::string text(const Vector2d &p) { return "[" + number(p.x(), 4) + ", " + number(p.y(), 4) + "] m"; }

double distanceFrom(const PointMotion &motion, const Vector2d &place)
{
  double least = HUGE_VAL;
  for (const PointSample &s : motion.samples) {
    least = std::min(least, (s.place - place).norm());
  }
  return least;
}

std::string csvOf(const PointMotion &motion)
{
  std::string csv = "time_s,x_m,y_m,vx_mps,vy_mps,ax_mps2,ay_mps2,goal_x_m,goal_y_m\n";
  for (const PointSample &s : motion.samples) {
    csv += number(s.time, 7);
    for (const Vector2d &v : {s.place, s.velocity, s.acceleration, s.goal}) {
      csv += "," + number(v.x(), 9) + "," + number(v.y(), 9);
    }
    csv += "\n";
  }
  return csv;
}

nlohmann::ordered_json bound(double value)
{
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json eventsOf(const PointTask &task)
{
  nlohmann::ordered_json events = nlohmann::ordered_json::array();
  for (const PointEvent &event : task.events) {
    events.push_back({{"time_s", event.time}, {"via_m", nullptr}});
    if (event.via) {
      events.back()["via_m"] = {event.via->x(), event.via->y()};
    }
  }
  return events;
}

void finish(const PointTask &task, const PointMotion &motion, Replica &replica)
{
  const Vector2d end = motion.samples.back().place, goal = motion.samples.back().goal;
  replica.comparisons.push_back({"ends at", text(goal), text(end), (end - goal).norm() < 1e-6});
  replica.comparisons.push_back({"duration", "not given", fixed(motion.arrival, 3) + " s"});
  replica.comparisons.push_back(
      {"clearance", "not given", "not known: the thesis does not say where the obstacle was"});
  replica.tables.emplace_back("point.csv", csvOf(motion));
  replica.numbers = {
      {"arrived", motion.arrived},         {"arrival_s", motion.arrival},      {"peak_v", motion.peakSpeed},
      {"peak_a", motion.peakAcceleration}, {"largest_step_of_a", motion.jump}, {"plans", motion.plans},
      {"end_m", {end.x(), end.y()}},       {"goal_m", {goal.x(), goal.y()}},   {"clearance_m", nullptr}};
  replica.numbers["max_speed_mps"] = bound(task.maxSpeed);
  replica.numbers["max_acceleration_mps2"] = bound(task.maxAcceleration);
  replica.numbers["events"] = eventsOf(task);
}

void compareSpeed(const PointTask &task, const PointMotion &motion, Replica &replica)
{
  const bool kept = motion.peakSpeed <= task.maxSpeed * (1. + ROUNDING);
  replica.comparisons.push_back({"speed", "at most 0.5 m/s, not violated",
                                 "at most " + number(motion.peakSpeed, 6) + " m/s, looked at every 0.1 ms", kept});
  replica.comparisons.push_back(
      {"acceleration", "no limit given", "up to " + number(motion.peakAcceleration, 3) + " m/s^2, continuous"});
  replica.findings.push_back(
      "The point went at no more than " + number(motion.peakSpeed, 6) + " m/s where " + number(task.maxSpeed, 3) +
      " m/s are allowed, arrived after " + fixed(motion.arrival, 3) +
      " s, and its acceleration was continuous: from one millisecond to the next it changed by " +
      number(motion.jump, 3) + " m/s^2 at most.");
}

PointTask interrupted()
{
  PointTask task;
  task.goal = {0., 0.3};
  task.maxSpeed = 0.5;
  task.events = {{0.1, {0.2, 0.3}, std::nullopt}};
  task.duration = 0.;
  return task;
}

PointTask throughVia()
{
  PointTask task;
  task.goal = {0., 0.3};
  task.maxSpeed = 0.5;
  task.events = {{0.55, {0.125, 0.3}, Vector2d(0.18, 0.15)}};
  task.duration = 0.;
  return task;
}

//! Position of the object of figure 8.13.
Vector2d objectAt(double t)
{
  const Vector2d a(0.1, 0.3), b(0.23, 0.13), c(0.14, 0.04);
  return t < 0.9 ? Vector2d(a + std::clamp((t - 0.5) / 0.4, 0., 1.) * (b - a))
                 : Vector2d(b + std::clamp((t - 1.7) / 0.2, 0., 1.) * (c - b));
}

PointTask following(unsigned int seed)
{
  PointTask task;
  task.goal = objectAt(0.);
  task.maxAcceleration = 1.;
  task.floor = 0.4;
  task.duration = 3.;
  const auto random = std::make_shared<std::mt19937_64>(seed);
  task.told = [random](double t) {
    std::normal_distribution<double> noise(0., GOAL_NOISE);
    const double dx = noise(*random), dy = noise(*random);
    return Vector2d(objectAt(t) + (t < NOISY_UNTIL ? Vector2d(dx, dy) : Vector2d::Zero()));
  };
  return task;
}

//! Rms second difference of a place of the samples from one goal to the next, while these are noisy, m.
double unevenness(const PointTask &task, const PointMotion &motion, Vector2d PointSample::*place)
{
  const auto step = static_cast<std::size_t>(std::lround(task.toldEvery / pointPeriod));
  double sum = 0.;
  int count = 0;
  for (std::size_t i = 1; i + 2 * step < motion.samples.size() && motion.samples[i + 2 * step].time < NOISY_UNTIL;
       i += step, ++count) {
    const auto at = [&](std::size_t k) -> const Vector2d & { return motion.samples[i + k * step].*place; };
    sum += (at(2) - 2. * at(1) + at(0)).squaredNorm();
  }
  return std::sqrt(sum / count);
}

void compareFollowing(const PointTask &task, const PointMotion &motion, Replica &replica)
{
  const bool kept = motion.peakAcceleration <= task.maxAcceleration * (1. + ROUNDING);
  double sum = 0., after = 0.;
  for (const PointSample &s : motion.samples) {
    sum += (s.place - objectAt(s.time)).squaredNorm();
    after = s.time <= 1.7 ? (s.place - objectAt(s.time)).norm() : after;
  }
  const double rms = std::sqrt(sum / static_cast<double>(motion.samples.size()));
  replica.comparisons.push_back({"acceleration", "at most 1 m/s^2, guaranteed",
                                 "at most " + number(motion.peakAcceleration, 6) + " m/s^2, looked at every 0.1 ms",
                                 kept});
  replica.comparisons.push_back(
      {"goal", "50 Hz of a 1 kHz loop, noise \"50 % standard deviation\"",
       "50 Hz of a 1 kHz loop, noise of " + number(1000. * GOAL_NOISE, 3) + " mm (standard deviation of each axis)"});
  replica.comparisons.push_back({"continuity", "place and acceleration continuous",
                                 "acceleration changes by at most " + number(motion.jump, 3) + " m/s^2 in 1 ms"});
  replica.findings.push_back("The point followed the object with no more than " + number(motion.peakAcceleration, 6) +
                             " m/s^2 where " + number(task.maxAcceleration, 3) + " m/s^2 are allowed; it was off by " +
                             number(1000. * rms, 3) + " mm (rms over all of it, setting out included) and by " +
                             number(1000. * after, 3) + " mm when the object moved for the second time.");
  replica.numbers["goal_noise_m"] = GOAL_NOISE;
  replica.numbers["rms_distance_m"] = rms;
  replica.numbers["unevenness_over_that_of_goal"] =
      unevenness(task, motion, &PointSample::place) / unevenness(task, motion, &PointSample::goal);
}
} // namespace

Replica playPointReplica(const Options &options)
{
  Replica replica;
  replica.name = options.replica;
  replica.title = replicaTitle(options.replica);
  const PointTask task = options.replica == "fig8.7"   ? interrupted()
                         : options.replica == "fig8.9" ? throughVia()
                                                       : following(options.seed);
  const PointMotion motion = follow(task);
  finish(task, motion, replica);
  if (options.replica == "fig8.13") {
    compareFollowing(task, motion, replica);
    replica.choices = {
        "\"50 % standard deviation\" has no unit; the noise here is 10 mm until the object rests at 1.9 s.",
        "The time of arrival is kept from one goal to the next (KeepArrival), at least 0.4 s ahead."};
    return replica;
  }
  compareSpeed(task, motion, replica);
  const PointEvent &event = task.events.front();
  replica.comparisons.insert(replica.comparisons.begin(),
                             {"interrupted at", number(event.time, 3) + " s", number(event.time, 3) + " s"});
  replica.choices = {"The first goal is not in the text; it is [0, 0.3] m, straight on.",
                     "The text gives no bound on the acceleration, so there is none here."};
  if (event.via) {
    const double missed = distanceFrom(motion, *event.via);
    replica.comparisons.push_back(
        {"goes through", text(*event.via), "passes it at " + number(1000. * missed, 2) + " mm", missed < 1e-3});
    replica.numbers["via_distance_m"] = missed;
    replica.choices.emplace_back("When to be at the via is not given; it is half way in time from the event on.");
  }
  return replica;
}
} // namespace avoidObstacle
