/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "stepTable.h"

#include "catalogue.h"
#include "format.h"

#include <algorithm>
#include <cmath>

namespace servoCompare
{
namespace
{
using vpApp::HtmlCell;
using vpApp::HtmlTable;

struct Column {
  const char *title;
  Metric metric;
  int decimals;
  const char *hint;
};

const std::vector<Column> COLUMNS = {
    {"m/s2", &vpServoMetrics::peak_linear_acceleration_mps2, 2, "Largest linear acceleration of the command"},
    {"rad/s2", &vpServoMetrics::peak_angular_acceleration_radps2, 2, "Largest angular acceleration of the command"},
    {"max px", &vpServoMetrics::max_image_error_px, 1,
     "Largest distance of the object's centre from its desired image position"},
    {"end deg", &vpServoMetrics::end_rotation_deg, 2, "Largest rotation error at the end of a segment"},
    {"end mm", &vpServoMetrics::end_translation_mm, 2, "Largest translation error at the end of a segment"},
    {"settle s", &vpServoMetrics::settle_s, 2,
     "Mean time until the error stays below 2 deg and 5 mm; the segment's duration if never"},
    {"out s", &vpServoMetrics::out_of_view_s, 2, "Time with a corner of the object out of the image"},
};

//! A median of a law, raw and shaped.
struct Pair {
  double raw;
  double shaped;
};

std::optional<Pair> pairOf(const Results &results, const std::string &law, const vpServoPlant &plant,
                           const std::string &measure, Metric metric)
{
  const auto raw = results.spread(law, plant.name, measure, metric);
  const auto shaped = results.spread(law, plant.name, measure, metric, Command::Shaped);
  return raw && shaped ? std::optional<Pair>(Pair{raw->median, shaped->median}) : std::nullopt;
}

//! The largest accelerations over all runs of one kind.
Pair largestAcceleration(const Results &results, Metric metric)
{
  Pair largest{0., 0.};
  for (const vpServoRun &run : results.runs()) {
    double &value = run.spec.shape ? largest.shaped : largest.raw;
    value = std::max(value, run.metrics.*metric);
  }
  return largest;
}

std::string stepGone(const Results &results)
{
  const Pair linear = largestAcceleration(results, &vpServoMetrics::peak_linear_acceleration_mps2);
  const Pair angular = largestAcceleration(results, &vpServoMetrics::peak_angular_acceleration_radps2);
  return "Over all laws and plants the command asks for accelerations of up to " + number(linear.raw, 3) +
         " m/s^2 and " + number(angular.raw, 3) + " rad/s^2 raw, and of up to " + number(linear.shaped, 3) +
         " m/s^2 and " + number(angular.shaped, 3) + " rad/s^2 shaped.";
}

//! Increase of a metric by the shaper: the law with the largest increase.
struct Rise {
  std::string law;
  Pair pair{0., 0.};
  [[nodiscard]] double amount() const { return pair.shaped - pair.raw; }
};

Rise largestRise(const Plan &plan, const Results &results, const vpServoPlant &plant, Metric metric)
{
  Rise largest;
  for (const std::string &law : plan.laws) {
    const auto pair = pairOf(results, law, plant, plan.mainMeasure(), metric);
    if (pair && (largest.law.empty() || pair->shaped - pair->raw > largest.amount())) {
      largest = {law, *pair};
    }
  }
  return largest;
}

std::string riseText(const Plan &plan, const Results &results, const vpServoPlant &plant, Metric metric,
                     const std::string &what, const std::string &unit, int decimals)
{
  const Rise rise = largestRise(plan, results, plant, metric);
  if (fixed(rise.pair.raw, decimals) == fixed(rise.pair.shaped, decimals) || rise.amount() < 0.) {
    return what + " rises with no law";
  }
  return what + " rises most with " + rise.law + ", from " + fixed(rise.pair.raw, decimals) + " to " +
         fixed(rise.pair.shaped, decimals) + " " + unit;
}

std::string cost(const Plan &plan, const Results &results, const vpServoPlant &plant)
{
  const auto text = [&](Metric metric, const std::string &what, const std::string &unit, int decimals) {
    return riseText(plan, results, plant, metric, what, unit, decimals);
  };
  return "What it costs on plant " + plant.name + ": " +
         text(&vpServoMetrics::max_image_error_px, "the largest image error", "px", 1) + "; " +
         text(&vpServoMetrics::end_rotation_deg, "the rotation error at the end", "deg", 2) + "; " +
         text(&vpServoMetrics::settle_s, "the time to settle", "s", 2) + "; " +
         text(&vpServoMetrics::out_of_view_s, "the time out of view", "s", 2) + ".";
}

//! The filter assumes that its twist is executed at once, which is not the case behind a shaper.
std::optional<std::string> filterBehindShaper(const Plan &plan, const Results &results)
{
  std::vector<std::string> losses;
  bool filtered = false;
  for (const std::string &law : plan.laws) {
    for (const vpServoPlant &plant : plan.scenario.plants) {
      const auto pair = pairOf(results, law, plant, plan.mainMeasure(), &vpServoMetrics::out_of_view_s);
      filtered = filtered || (isFiltered(law) && pair);
      if (isFiltered(law) && pair && pair->shaped > pair->raw) {
        losses.push_back(law + " on plant " + plant.name + " (" + fixed(pair->raw, 2) + " s raw, " +
                         fixed(pair->shaped, 2) + " s shaped)");
      }
    }
  }
  if (!filtered) {
    return std::nullopt;
  }
  return "The view filter comes before the shaper and relies on its twist being executed at once; shaped, it promises "
         "nothing. " +
         (losses.empty() ? "In these runs no filtered law is longer out of view for that."
                         : "Longer out of view for that: " + enumerate(losses) + ".");
}
} // namespace

HtmlTable stepTable(const Plan &plan, const Results &results, const vpServoPlant &plant, const std::string &measure)
{
  HtmlTable table;
  HtmlTable::Row titles{HtmlCell("law", "left")};
  HtmlTable::Row kinds{HtmlCell("")};
  for (const Column &column : COLUMNS) {
    titles.emplace_back(column.title, "start", 2);
    titles.back().hint = column.hint;
    kinds.emplace_back("raw", "start");
    kinds.emplace_back("shaped");
  }
  table.header = {titles, kinds};
  for (const std::string &law : plan.laws) {
    HtmlTable::Row row{HtmlCell(law, "left")};
    for (const Column &column : COLUMNS) {
      if (const auto pair = pairOf(results, law, plant, measure, column.metric)) {
        row.emplace_back(fixed(pair->raw, column.decimals), "start");
        row.emplace_back(fixed(pair->shaped, column.decimals));
      }
    }
    if (row.size() > 1) {
      table.rows.push_back(row);
    }
  }
  return table;
}

std::vector<std::string> stepFindings(const Plan &plan, const Results &results)
{
  std::vector<std::string> sentences{stepGone(results), cost(plan, results, plan.easyPlant())};
  if (plan.scenario.plants.size() > 1) {
    sentences.push_back(cost(plan, results, plan.hardPlant()));
  }
  if (const auto sentence = filterBehindShaper(plan, results)) {
    sentences.push_back(*sentence);
  }
  sentences.push_back(
      "Translation and rotation ramp up apart. Where one of the two is shaped longer than the other, the "
      "object swings in the image meanwhile; angular limits of about 1 / Z times the linear ones (Z: "
      "distance of the object in m) keep that small.");
  return sentences;
}
} // namespace servoCompare
