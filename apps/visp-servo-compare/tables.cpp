/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "tables.h"

#include "catalogue.h"
#include "format.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>

namespace servoCompare
{
namespace
{
using vpApp::HtmlCell;
using vpApp::HtmlTable;

//! A column of a table.
struct Column {
  const char *title;
  Metric metric;
  int decimals;
  const char *hint;
  enum Order { LessIsBetter, MoreIsBetter, Neutral } order = Neutral; //!< For the marks of the best and the worst.
};

constexpr const char *MAX_PX = "Largest distance of the object's centre from its desired image position";
constexpr const char *END_DEG = "Largest rotation error at the end of a segment";
constexpr const char *END_MM = "Largest translation error at the end of a segment";
constexpr const char *SETTLE = "Mean time until the error stays below 2 deg and 5 mm; the segment's duration if never";
constexpr const char *OUT = "Time with a corner of the object out of the image";

const std::vector<Column> MAIN = {
    {"max px", &vpServoMetrics::max_image_error_px, 1, MAX_PX, Column::LessIsBetter},
    {"rms px", &vpServoMetrics::rms_image_error_px, 1, "Root mean square of that distance", Column::LessIsBetter},
    {"end deg", &vpServoMetrics::end_rotation_deg, 2, END_DEG, Column::LessIsBetter},
    {"left", &vpServoMetrics::left_end_rotation_deg, 3,
     "The part of it, in deg, that the last measurement still shows: what the law has left"},
    {"expected", &vpServoMetrics::expected_end_rotation_deg, 3,
     "Root mean square, in deg, that the last measurement and its covariance let expect; \"unknown\" without a "
     "covariance"},
    {"yaw deg", &vpServoMetrics::yaw_range_deg, 1, "Range of yaw covered, up to the ideal", Column::MoreIsBetter},
    {"out s", &vpServoMetrics::out_of_view_s, 1, OUT, Column::LessIsBetter},
};

const std::vector<Column> FURTHER = {
    {"settle s", &vpServoMetrics::settle_s, 2, SETTLE, Column::LessIsBetter},
    {"end mm", &vpServoMetrics::end_translation_mm, 2, END_MM, Column::LessIsBetter},
    {"left", &vpServoMetrics::left_end_translation_mm, 2,
     "The part of it, in mm, that the last measurement still shows: what the law has left"},
    {"expected", &vpServoMetrics::expected_end_translation_mm, 2,
     "Root mean square, in mm, that the last measurement and its covariance let expect; \"unknown\" without a "
     "covariance"},
    {"path m", &vpServoMetrics::path_length_m, 3, "Length of the camera's path"},
    {"peak m/s", &vpServoMetrics::peak_linear_mps, 3, "Largest linear speed executed"},
    {"peak rad/s", &vpServoMetrics::peak_angular_radps, 3, "Largest angular speed executed"},
    {"jerk", &vpServoMetrics::rms_linear_jerk_mps3, 2, "Root mean square of the linear jerk of the command, m/s^3"},
    {"peak", &vpServoMetrics::peak_linear_jerk_mps3, 2, "Largest linear jerk of the command, m/s^3"},
    {"losses", &vpServoMetrics::view_losses, 0, "How often a corner of the object left the image"},
    {"above", &vpServoMetrics::bounds_exceeded_cycles, 0,
     "With --bounded: cycles above a limit of the camera's motion"},
};

//! Rating of a median as displayed: smaller is better. A yaw beyond the ideal is as wrong as one below.
double badness(const Column &column, double median, double idealYaw)
{
  const double shown = std::stod(fixed(median, column.decimals));
  return column.order == Column::MoreIsBetter ? std::abs(shown - std::stod(fixed(idealYaw, column.decimals))) : shown;
}

//! Marks the best and the worst value of a column, unless too many laws share it.
class Marks
{
public:
  Marks(const Plan &plan, const Results &results, const vpServoPlant &plant, const std::string &measure,
        const Column &column)
    : m_column(column), m_idealYaw(results.runs().front().metrics.ideal_yaw_range_deg)
  {
    for (const std::string &law : plan.laws) {
      if (const auto spread = results.spread(law, plant.name, measure, column.metric)) {
        m_values.push_back(badness(column, spread->median, m_idealYaw));
      }
    }
  }

  [[nodiscard]] std::string styleOf(double median) const
  {
    if (m_column.order == Column::Neutral || m_values.size() < 2) {
      return "";
    }
    const auto limits = std::minmax_element(m_values.begin(), m_values.end());
    const double value = badness(m_column, median, m_idealYaw);
    const auto sharing = static_cast<std::size_t>(std::count(m_values.begin(), m_values.end(), value));
    if (*limits.first == *limits.second || 2 * sharing > m_values.size()) {
      return "";
    }
    return value == *limits.first ? "best" : value == *limits.second ? "worst" : "";
  }

private:
  const Column &m_column;
  double m_idealYaw;
  std::vector<double> m_values;
};

HtmlCell cellOf(const Column &column, const Spread &spread, const Marks &marks, bool first)
{
  if (!std::isfinite(spread.largest)) {
    return HtmlCell("unknown", first ? "start" : "");
  }
  HtmlCell cell(fixed(spread.median, column.decimals), marks.styleOf(spread.median));
  cell.style += first ? " start" : "";
  if (spread.least != spread.largest) {
    cell.text += " [" + fixed(spread.least, column.decimals) + ", " + fixed(spread.largest, column.decimals) + "]";
  }
  return cell;
}

HtmlTable tableOf(const Plan &plan, const Results &results, const std::string &measure,
                  const std::vector<Column> &columns)
{
  const auto width = static_cast<unsigned int>(columns.size());
  std::vector<vpServoPlant> shown;
  for (const vpServoPlant &plant : plan.scenario.plants) {
    const auto measured = [&](const std::string &law) { return results.find(law, plant.name, measure) != nullptr; };
    if (std::any_of(plan.laws.begin(), plan.laws.end(), measured)) {
      shown.push_back(plant);
    }
  }
  HtmlTable table;
  HtmlTable::Row plants{HtmlCell("law", "left")};
  HtmlTable::Row titles{HtmlCell("")};
  for (const vpServoPlant &plant : shown) {
    plants.emplace_back("plant " + plant.name, "start", width);
    for (const Column &column : columns) {
      titles.emplace_back(column.title, &column == &columns.front() ? "start" : "");
      titles.back().hint = column.hint;
    }
  }
  table.header = {plants, titles};

  for (const GainGroup group : {GainGroup::Single, GainGroup::Double, GainGroup::Integral, GainGroup::Own}) {
    std::vector<HtmlTable::Row> rows;
    for (const std::string &law : plan.laws) {
      const LawInfo info = lawInfo(law);
      bool any = false;
      HtmlTable::Row row{HtmlCell(law, "left")};
      row.back().hint = info.name + ": " + info.sentence;
      for (const vpServoPlant &plant : shown) {
        for (const Column &column : columns) {
          const bool first = &column == &columns.front();
          const auto spread = results.spread(law, plant.name, measure, column.metric);
          any = any || spread;
          row.push_back(spread ? cellOf(column, *spread, Marks(plan, results, plant, measure, column), first)
                               : HtmlCell("-", first ? "start" : ""));
        }
      }
      if (any && info.group == group) {
        rows.push_back(row);
      }
    }
    if (!rows.empty()) {
      table.rows.push_back({HtmlCell(titleOf(group))});
      table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    }
  }
  return table;
}

//! Of each law raw and shaped.
const std::vector<Column> STEP = {
    {"m/s2", &vpServoMetrics::peak_linear_acceleration_mps2, 2, "Largest linear acceleration of the command"},
    {"rad/s2", &vpServoMetrics::peak_angular_acceleration_radps2, 2, "Largest angular acceleration of the command"},
    {"max px", &vpServoMetrics::max_image_error_px, 1, MAX_PX},
    {"end deg", &vpServoMetrics::end_rotation_deg, 2, END_DEG},
    {"end mm", &vpServoMetrics::end_translation_mm, 2, END_MM},
    {"settle s", &vpServoMetrics::settle_s, 2, SETTLE},
    {"out s", &vpServoMetrics::out_of_view_s, 2, OUT},
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

constexpr double THESIS_JOINT_RMS[] = {6.4, 8.6, 5.2, 12.5, 8.2, 8.5, 6.4}; // mrad, table 8.1

std::string marginText(const vpArmModel &model, const vpArmMetrics &m)
{
  if (m.least_margin_joint < 0) {
    return "no limits";
  }
  const bool slides = model.isPrismatic(m.least_margin_joint);
  const double margin = std::max(0., m.least_limit_margin);
  return (slides ? fixed(1000. * margin, 1) + " mm" : fixed(vpMath::deg(margin), 1)) + " (" +
         model.spec().joints[static_cast<std::size_t>(m.least_margin_joint)].name + ")";
}
} // namespace

HtmlTable mainTable(const Plan &plan, const Results &results, const std::string &measure)
{
  return tableOf(plan, results, measure, MAIN);
}

HtmlTable furtherTable(const Plan &plan, const Results &results, const std::string &measure)
{
  return tableOf(plan, results, measure, FURTHER);
}

HtmlTable stepTable(const Plan &plan, const Results &results, const vpServoPlant &plant, const std::string &measure)
{
  HtmlTable table;
  HtmlTable::Row titles{HtmlCell("law", "left")};
  HtmlTable::Row kinds{HtmlCell("")};
  for (const Column &column : STEP) {
    titles.emplace_back(column.title, "start", 2);
    titles.back().hint = column.hint;
    kinds.emplace_back("raw", "start");
    kinds.emplace_back("shaped");
  }
  table.header = {titles, kinds};
  for (const std::string &law : plan.laws) {
    HtmlTable::Row row{HtmlCell(law, "left")};
    for (const Column &column : STEP) {
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

HtmlTable armTable(const Plan &plan, const Results &results)
{
  HtmlTable table;
  table.header = {{HtmlCell("law", "left"), HtmlCell("plant"), HtmlCell("limit margin deg"), HtmlCell("speed %"),
                   HtmlCell("acceleration %"), HtmlCell("worst joint rms mrad"), HtmlCell("least manipulability"),
                   HtmlCell("self-motion rad"), HtmlCell("slowed s"), HtmlCell("blocked s"),
                   HtmlCell("status", "left")}};
  for (const vpServoPlant &plant : plan.scenario.plants) {
    for (const std::string &law : plan.laws) {
      const vpServoRun *run = results.find(law, plant.name, plan.mainMeasure());
      if (run == nullptr || !run->armMetrics) {
        continue;
      }
      const vpArmMetrics &m = *run->armMetrics;
      table.rows.push_back(
          {HtmlCell(law, "left"), HtmlCell(plant.name), HtmlCell(marginText(plan.arm->model, m)),
           HtmlCell(fixed(100. * m.peak_velocity_share, 0)), HtmlCell(fixed(100. * m.peak_acceleration_share, 0)),
           HtmlCell(fixed(1000. * m.joint_rms.maxCoeff(), 2)), HtmlCell(fixed(m.least_manipulability, 4)),
           HtmlCell(fixed(m.self_motion_rad, 2)), HtmlCell(fixed(m.limited_s, 2)), HtmlCell(fixed(m.blocked_s, 2)),
           HtmlCell(m.status, "left wrap")});
    }
  }
  return table;
}

HtmlTable jointErrorTable(const Plan &plan, const Results &results, const std::string &law)
{
  const vpArmModel &model = plan.arm->model;
  HtmlTable table;
  HtmlTable::Row header{HtmlCell("joint rms mrad", "left")};
  for (const vpArmJointSpec &joint : model.spec().joints) {
    header.emplace_back(joint.name);
  }
  table.header = {header};
  if (model.spec().name == "AMOR" && model.size() == 7) {
    HtmlTable::Row thesis{HtmlCell("thesis, table 8.1", "left")};
    for (const double rms : THESIS_JOINT_RMS) {
      thesis.emplace_back(fixed(rms, 1));
    }
    table.rows.push_back(thesis);
  }
  for (const vpServoPlant &plant : plan.scenario.plants) {
    const vpServoRun *run = results.find(law, plant.name, plan.mainMeasure());
    if (run == nullptr || !run->armMetrics) {
      continue;
    }
    HtmlTable::Row row{HtmlCell("plant " + plant.name + ", " + law, "left")};
    for (int i = 0; i < model.size(); ++i) {
      row.emplace_back(fixed(1000. * run->armMetrics->joint_rms(i), 2));
    }
    table.rows.push_back(row);
  }
  return table;
}
} // namespace servoCompare
