/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Figures 8.6 to 8.10 and 8.13: detours, by the replicas of visp-avoid-obstacle.
#include "part.h"

#include "numberText.h"
#include "visp-avoid-obstacle/replicas.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

namespace thesisReport
{
namespace
{
using avoidObstacle::Replica;

constexpr double MAX_SPEED = 0.5, MAX_ACCELERATION = 1.; // m/s, m/s^2
constexpr double KEPT = 1e-9;                            // m/s: rounding tolerance
constexpr double NEAR = 0.005;                           // m: a via is reached

//! The same, judged by the worst of several seeds.
Quantity inEveryRun(Quantity quantity)
{
  quantity.never = true;
  quantity.note += " Of several seeds the worst.";
  return quantity;
}

Quantity speedKept(double peak)
{
  return inEveryRun({"largest speed", "m/s", MAX_SPEED, peak, Tolerance::atMost(KEPT), Good::Smaller, "",
                     "The thesis: not violated."});
}

constexpr double REACHED = 0.01; // of a bound: what can be seen in a figure

//! A bound that is reached, so that no shorter time would keep it.
Quantity reached(const std::string &name, const char *unit, double bound, double peak)
{
  return inEveryRun({name + ", reached", unit, bound, peak, Tolerance::atLeast(REACHED * bound), Good::Neither, "",
                     "The thesis: as the bound is reached, the time is the shortest."});
}

//! \param thesis : None on an arm, of which the thesis gives no distances.
Quantity arrived(double distance, double tolerance, std::optional<double> thesis = 0.)
{
  return {"distance from the final point", "m", thesis, distance, Tolerance::atMost(tolerance), Good::Smaller, "", ""};
}

Quantity throughVia(double distance, double tolerance, std::optional<double> thesis = 0.)
{
  return {"distance at which the via is passed", "m",           thesis, distance,
          Tolerance::atMost(tolerance),          Good::Smaller, "",     ""};
}

double distanceOf(const nlohmann::ordered_json &a, const nlohmann::ordered_json &b)
{
  return std::hypot(a[0].get<double>() - b[0].get<double>(), a[1].get<double>() - b[1].get<double>());
}

std::vector<Quantity> fieldQuantities(const nlohmann::ordered_json &numbers)
{
  const auto &strict = numbers.at("strict"), &mild = numbers.at("mild");
  const auto reached = [](const char *name, double thesis, const nlohmann::ordered_json &motion) {
    return Quantity{std::string(name) + ": end point reached (1 yes, 0 no)",
                    "1",
                    thesis,
                    motion.at("end_reached").get<bool>() ? 1. : 0.,
                    Tolerance::distance(0.),
                    Good::Neither,
                    "",
                    "Reached: within 5 mm."};
  };
  const auto missed = [](const nlohmann::ordered_json &motion, std::size_t i) {
    return motion.at("missed_m").at(i).get<double>();
  };
  double missing = 0.;
  std::string distances;
  for (const auto *motion : {&strict, &mild}) {
    for (const std::size_t via : {0, 1}) {
      missing += missed(*motion, via) >= NEAR ? 1. : 0.;
      distances += (distances.empty() ? "" : ", ") + vpApp::number(1000. * missed(*motion, via), 3);
    }
  }
  return {reached("strict parameters", 0., strict),
          reached("mild parameters", 1., mild),
          {"vias that are not reached, of two with strict and two with mild parameters", "1", 4., missing,
           Tolerance::distance(0.), Good::Neither,
           "Only near the obstacle the field acts, and the mild one hardly at the second via; where the vias are the "
           "thesis does not say.",
           "Reached: within 5 mm. The four are missed by " + distances + " mm."},
          {"distance at which the second via is missed, mild over strict", "1", 1., missed(mild, 1) / missed(strict, 1),
           Tolerance::atMost(), Good::Smaller, "",
           "The thesis: with less strict parameters the path stays closer to the wanted one."}};
}

std::vector<Quantity> pointQuantities(const nlohmann::ordered_json &numbers)
{
  std::vector<Quantity> quantities = {speedKept(numbers.at("peak_v")),
                                      arrived(distanceOf(numbers.at("end_m"), numbers.at("goal_m")), 1e-6)};
  if (numbers.contains("via_distance_m")) {
    quantities.push_back(reached("largest speed", "m/s", MAX_SPEED, numbers.at("peak_v")));
    quantities.push_back(throughVia(numbers.at("via_distance_m"), 1e-3));
  }
  quantities.push_back({"time of arrival", "s", std::nullopt, numbers.at("arrival_s"), Tolerance::factor(1.1),
                        Good::Neither, "", "Only drawn in the thesis."});
  return quantities;
}

std::vector<Quantity> armQuantities(const nlohmann::ordered_json &numbers)
{
  const auto &metrics = numbers.at("metrics");
  std::vector<Quantity> quantities = {speedKept(numbers.at("moved_peak_v")), speedKept(metrics.at("peak_v")),
                                      arrived(metrics.at("goal_error_m"), 0.005, std::nullopt)};
  quantities[0].name += " of the tool";
  quantities[0].reason = "Only the commanded motion is bounded; drives with PD and gravity overshoot it, by how much "
                         "masses, gains and friction decide, which are ours.";
  quantities[1].name += " of the commanded tool";
  quantities.back().note = "Drives as in section 8.2.3: PD with gravity, without friction compensation.";
  if (numbers.contains("via_distance_m")) {
    quantities.push_back(reached("largest speed of the commanded tool", "m/s", MAX_SPEED, metrics.at("peak_v")));
    quantities.back().reason =
        "Where the obstacle is seen early, the bound of 2 m/s^2 is reached instead, which is ours.";
    quantities.back().note += " Largest acceleration: " + vpApp::number(metrics.at("peak_a"), 3) + " m/s^2.";
    quantities.push_back(throughVia(numbers.at("via_distance_m"), 0.01, std::nullopt));
  }
  return quantities;
}

std::vector<Quantity> followingQuantities(const nlohmann::ordered_json &numbers)
{
  return {inEveryRun({"largest acceleration", "m/s^2", MAX_ACCELERATION, numbers.at("peak_a"), Tolerance::atMost(KEPT),
                      Good::Smaller, "", "The thesis: guaranteed. Norm over both axes."}),
          reached("largest acceleration", "m/s^2", MAX_ACCELERATION, numbers.at("peak_a")),
          {"unevenness of the position over that of the measured object", "1", 0.1,
           numbers.at("unevenness_over_that_of_goal"), Tolerance::atMost(), Good::Smaller, "",
           "The thesis: measurements are noisy, positions are not. Rms second difference over 20 ms, the period of the "
           "measurements."},
          inEveryRun({"largest change of the acceleration within 1 ms", "m/s^2", 0., numbers.at("largest_step_of_a"),
                      Tolerance::atMost(0.1), Good::Smaller, "", "The thesis: continuous."}),
          arrived(distanceOf(numbers.at("end_m"), numbers.at("goal_m")), 1e-6),
          {"distance from the object, rms", "m", std::nullopt, numbers.at("rms_distance_m"), Tolerance::factor(1.1),
           Good::Neither, "", "Setting out included."}};
}

//! The columns of a table with a line of names. Cells that are no number are NaN.
std::map<std::string, std::vector<double>> columnsOf(const std::string &csv)
{
  std::vector<std::string> names;
  std::map<std::string, std::vector<double>> columns;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::size_t i = 0;
    const bool first = names.empty();
    for (std::string cell; std::getline(cells, cell, ','); ++i) {
      if (first) {
        names.push_back(cell);
      }
      else {
        double value = std::nan("");
        std::from_chars(cell.data(), cell.data() + cell.size(), value);
        columns[names[i]].push_back(value);
      }
    }
  }
  return columns;
}

//! Way, speed and what else a table of motion has.
void illustrate(const std::string &name, const std::string &csv, Item &item)
{
  auto columns = columnsOf(csv);
  const auto has = [&](const char *column) { return columns.count(column) != 0; };
  const std::vector<double> &time = columns["time_s"];
  vpApp::Plot way;
  way.title = "The way";
  way.xLabel = "x (m)";
  way.yLabel = "y (m)";
  way.equalAxes = true;
  std::vector<vpApp::Plot> panels;
  const auto norm = [&](const char *x, const char *y, const char *title, const char *unit) {
    std::vector<double> values;
    for (std::size_t i = 0; i < time.size(); ++i) {
      values.push_back(std::hypot(columns[x][i], columns[y][i]));
    }
    panels.push_back(vpApp::timePlot(title, unit));
    addCurve(panels.back(), "", time, values);
  };
  if (has("tool_x_m")) {
    addCurve(way, "true", columns["tool_x_m"], columns["tool_y_m"]);
    addCurve(way, "planned", columns["wanted_x_m"], columns["wanted_y_m"], vpApp::PlotStyle::Dashed);
    addCurve(way, "goal", columns["goal_x_m"], columns["goal_y_m"], vpApp::PlotStyle::Points);
  }
  else {
    addCurve(way, "way", columns["x_m"], columns["y_m"]);
  }
  if (has("vx_mps")) {
    addCurve(way, "goal as given", columns["goal_x_m"], columns["goal_y_m"], vpApp::PlotStyle::Points);
    norm("vx_mps", "vy_mps", "Speed", "m/s");
    norm("ax_mps2", "ay_mps2", "Acceleration", "m/s^2");
  }
  if (has("commanded_speed_mps")) {
    panels.push_back(vpApp::timePlot("Speed of the commanded tool", "m/s"));
    addCurve(panels.back(), "", time, columns["commanded_speed_mps"]);
    panels.push_back(vpApp::timePlot("Acceleration of the commanded tool", "m/s^2"));
    addCurve(panels.back(), "", time, columns["commanded_acceleration_mps2"]);
  }
  if (has("weight")) {
    panels.push_back(vpApp::timePlot("Weight of avoidance", "0..1"));
    addCurve(panels.back(), "", time, columns["weight"]);
  }
  panels.insert(panels.begin(), way);
  addPlot(item, name, "Way and motion, " + name, "As commanded; planned and true where an arm follows.", panels);
}

void add(const std::string &how, std::vector<Quantity> rows, Item &item)
{
  for (Quantity &row : rows) {
    row.name = how + ": " + row.name;
    item.quantities.push_back(row);
  }
}

//! Figures 8.8 and 8.10 beside their ideal runs: ideal drives, and the change when the image sensor finds the obstacle.
void addArmVariants(const avoidObstacle::Options &options, Item &item)
{
  avoidObstacle::Options ideal = options;
  ideal.friction = 0.;
  add("ideal drives", armQuantities(avoidObstacle::playReplica(ideal).numbers), item);
  const nlohmann::ordered_json seen = avoidObstacle::playSeenArmReplica(options);
  add("image sensor", armQuantities(seen), item);
  item.quantities.push_back({"image sensor: time from the appearance of the obstacle to the change", "s", std::nullopt,
                             seen.at("seen_after_s"), Tolerance::factor(1.1), Good::Neither, "",
                             "10 Hz as in section 8.3.2, a latency of " + vpApp::number(options.latency, 2) +
                                 " s; a box with a photograph, found by the database of targets. It appears at " +
                                 vpApp::number(seen.at("appears_s").get<double>(), 3) +
                                 " s, by the seed, and the change comes when it is seen, not at 0.95 s."});
}

Item itemOf(const std::string &id, const Setting &setting,
            std::vector<Quantity> (*quantities)(const nlohmann::ordered_json &))
{
  avoidObstacle::Options options;
  options.replica = id;
  options.seed = setting.seed;
  const Replica replica = avoidObstacle::playReplica(options);
  Item item;
  item.id = id;
  item.quantities = quantities(replica.numbers);
  if (quantities == armQuantities) {
    addArmVariants(options, item);
  }
  if (quantities == fieldQuantities) {
    add("arm with image sensor", fieldQuantities(avoidObstacle::playSeenFieldReplica(options)), item);
  }
  item.remarks = replica.findings;
  for (const std::string &choice : replica.choices) {
    item.parameters.emplace_back("our choice", choice);
  }
  for (const auto &table : replica.tables) {
    illustrate(table.first.substr(0, table.first.find('.')), table.second, item);
  }
  return item;
}
} // namespace

std::vector<Part> avoidanceParts()
{
  const auto part = [](const char *id, double cost, std::vector<Quantity> (*quantities)(const nlohmann::ordered_json &),
                       bool random = true) {
    return Part{"Chapter 8: obstacle avoidance",
                {{id, avoidObstacle::replicaTitle(id)}},
                cost,
                [id, quantities](const Setting &setting) { return std::vector<Item>{itemOf(id, setting, quantities)}; },
                random};
  };
  return {part("fig8.6", 1., fieldQuantities), part("fig8.7", 1., pointQuantities, false),
          part("fig8.8", 5., armQuantities),   part("fig8.9", 1., pointQuantities, false),
          part("fig8.10", 5., armQuantities),  part("fig8.13", 1., followingQuantities)};
}
} // namespace thesisReport
