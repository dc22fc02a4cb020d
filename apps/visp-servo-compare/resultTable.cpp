/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "resultTable.h"

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

//! A column of a table.
struct Column {
  const char *title;
  Metric metric;
  int decimals;
  enum { LessIsBetter, MoreIsBetter, Neutral } order;
  const char *hint;
};

const std::vector<Column> MAIN = {
    {"max px", &vpServoMetrics::max_image_error_px, 1, Column::LessIsBetter,
     "Largest distance of the object's centre from its desired image position"},
    {"rms px", &vpServoMetrics::rms_image_error_px, 1, Column::LessIsBetter, "Root mean square of that distance"},
    {"end deg", &vpServoMetrics::end_rotation_deg, 2, Column::LessIsBetter,
     "Largest rotation error at the end of a segment"},
    {"left", &vpServoMetrics::left_end_rotation_deg, 3, Column::Neutral,
     "The part of it, in deg, that the last measurement still shows: what the law has left"},
    {"expected", &vpServoMetrics::expected_end_rotation_deg, 3, Column::Neutral,
     "Root mean square, in deg, that the last measurement and its covariance let expect; \"unknown\" without a "
     "covariance"},
    {"yaw deg", &vpServoMetrics::yaw_range_deg, 1, Column::MoreIsBetter, "Range of yaw covered, up to the ideal"},
    {"out s", &vpServoMetrics::out_of_view_s, 1, Column::LessIsBetter,
     "Time with a corner of the object out of the image"},
};

const std::vector<Column> FURTHER = {
    {"settle s", &vpServoMetrics::settle_s, 2, Column::LessIsBetter,
     "Mean time until the error stays below 2 deg and 5 mm; the segment's duration if never"},
    {"end mm", &vpServoMetrics::end_translation_mm, 2, Column::LessIsBetter,
     "Largest translation error at the end of a segment"},
    {"left", &vpServoMetrics::left_end_translation_mm, 2, Column::Neutral,
     "The part of it, in mm, that the last measurement still shows: what the law has left"},
    {"expected", &vpServoMetrics::expected_end_translation_mm, 2, Column::Neutral,
     "Root mean square, in mm, that the last measurement and its covariance let expect; \"unknown\" without a "
     "covariance"},
    {"path m", &vpServoMetrics::path_length_m, 3, Column::Neutral, "Length of the camera's path"},
    {"peak m/s", &vpServoMetrics::peak_linear_mps, 3, Column::Neutral, "Largest linear speed executed"},
    {"peak rad/s", &vpServoMetrics::peak_angular_radps, 3, Column::Neutral, "Largest angular speed executed"},
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

  for (const GainGroup group : {GainGroup::Single, GainGroup::Double, GainGroup::Integral}) {
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
} // namespace

HtmlTable mainTable(const Plan &plan, const Results &results, const std::string &measure)
{
  return tableOf(plan, results, measure, MAIN);
}

HtmlTable furtherTable(const Plan &plan, const Results &results, const std::string &measure)
{
  return tableOf(plan, results, measure, FURTHER);
}
} // namespace servoCompare
