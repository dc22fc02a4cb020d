/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "resultTables.h"

#include "findings.h"
#include "numberText.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>

namespace planCompare
{
namespace
{
using vpApp::fixed;
using vpApp::HtmlCell;
using vpApp::HtmlTable;
using vpApp::number;
using M = vpAvoidanceMetrics;

std::string percent(const Cell &cell)
{
  return cell.runs.empty() ? "-" : number(100. * cell.successes() / static_cast<double>(cell.runs.size()), 3) + " %";
}

std::string intervalText(const Cell &cell)
{
  const Interval i = cell.interval();
  return countText(cell.successes(), cell.runs.size()) + ", 95 % interval " + fixed(100. * i.low, 1) + " to " +
         fixed(100. * i.high, 1) + " %";
}

std::string msText(double ms) { return ms < 0.001 ? "0.000" : number(ms, 2); }

//! Millimetres; rounding errors become 0.
std::string mmText(double m) { return m < 1e-8 ? "0" : number(1000. * m, 2); }

HtmlCell methodCell(const std::string &method)
{
  const MethodInfo info = methodInfo(method);
  HtmlCell cell(info.number.empty() ? info.name : info.number + " " + info.name, "left");
  cell.hint = info.id;
  return cell;
}

struct Column {
  const char *title;
  std::string (*text)(const Cell &);
};

const std::vector<Column> &columns()
{
  static const std::vector<Column> all = {
      {"success", [](const Cell &c) { return percent(c); }},
      {"95 %",
       [](const Cell &c) {
         const Interval i = c.interval();
         return fixed(100. * i.low, 0) + "-" + fixed(100. * i.high, 0);
       }},
      {"touched", [](const Cell &c) { return std::to_string(c.runsWith(&M::collisions_moving)); }},
      {"hit at rest", [](const Cell &c) { return std::to_string(c.runsWith(&M::collisions_standing)); }},
      {"clearance mm",
       [](const Cell &c) {
         const std::vector<double> v = c.values(&M::min_clearance_m, false);
         return v.empty() ? std::string("-") : fixed(1000. * *std::min_element(v.begin(), v.end()), 1);
       }},
      {"goal mm", [](const Cell &c) { return mmText(vpMedian(c.values(&M::goal_error_m, false))); }},
      {"s", [](const Cell &c) { return c.successes() > 0 ? fixed(vpMedian(c.values(&M::duration_s, true)), 2) : "-"; }},
      {"path m",
       [](const Cell &c) { return c.successes() > 0 ? fixed(vpMedian(c.values(&M::path_length, true)), 2) : "-"; }},
      {"v", [](const Cell &c) { return number(vpQuantile(c.values(&M::peak_v, false), 1.), 3); }},
      {"a", [](const Cell &c) { return number(vpQuantile(c.values(&M::peak_a, false), 1.), 3); }},
      {"jerk", [](const Cell &c) { return number(vpQuantile(c.values(&M::peak_jerk, false), 1.), 3); }},
      {"jerk^2",
       [](const Cell &c) { return c.successes() > 0 ? number(vpMedian(c.values(&M::jerk_integral, true)), 3) : "-"; }},
      {"replan ms",
       [](const Cell &c) {
         const std::vector<double> t = c.replanTimes();
         return t.empty()
                    ? std::string("-")
                    : msText(vpMedian(t)) + " / " + msText(vpQuantile(t, .95)) + " / " + msText(vpQuantile(t, .99));
       }},
      {"false stops",
       [](const Cell &c) {
         return std::to_string(c.sum(&M::false_stops)) + " of " + std::to_string(c.sum(&M::stops));
       }},
      {"over v, a (tool)",
       [](const Cell &c) {
         return std::to_string(c.runsWith(&M::tool_v_violations)) + ", " +
                std::to_string(c.runsWith(&M::tool_a_violations));
       }},
      {"over v, a (joints)",
       [](const Cell &c) {
         return std::to_string(c.runsWith(&M::joint_v_violations)) + ", " +
                std::to_string(c.runsWith(&M::joint_a_violations));
       }},
  };
  return all;
}

} // namespace

HtmlTable mainTable(const Plan &plan, const Results &results)
{
  HtmlTable table;
  HtmlTable::Row names = {HtmlCell("method", "left")}, units = {HtmlCell("", "left")};
  for (const SceneInfo &scene : plan.scenes) {
    names.emplace_back(scene.id + " " + scene.name, "start", 2);
    units.emplace_back("success", "start");
    units.emplace_back("s");
  }
  table.header = {names, units};
  for (const std::string &method : plan.methods) {
    HtmlTable::Row row = {methodCell(method)};
    for (const SceneInfo &scene : plan.scenes) {
      const Cell cell = results.cell(scene.id, method);
      int most = 0;
      for (const std::string &other : plan.methods) {
        most = std::max(most, results.cell(scene.id, other).successes());
      }
      const bool best = cell.successes() == most && most > 0;
      HtmlCell success(percent(cell), best                                       ? "start best"
                                      : cell.runsWith(&M::collisions_moving) > 0 ? "start worst"
                                                                                 : "start");
      success.hint =
          intervalText(cell) + "; " + std::to_string(cell.runsWith(&M::collisions_moving)) + " runs touched something";
      row.push_back(success);
      row.emplace_back(cell.successes() > 0 ? fixed(vpMedian(cell.values(&M::duration_s, true)), 1) : "-");
    }
    table.rows.push_back(row);
  }
  return table;
}

HtmlTable verdictTable(const Plan &plan, const Results &results)
{
  HtmlTable table;
  table.header = {
      {HtmlCell("method", "left"), HtmlCell("what it does", "left"), HtmlCell("what it is good for", "left")}};
  for (const std::string &method : plan.methods) {
    table.rows.push_back({methodCell(method), HtmlCell(methodInfo(method).sentence, "left wrap"),
                          HtmlCell(verdictOf(plan, results, method), "left wrap")});
  }
  return table;
}

HtmlTable sceneTable(const Plan &plan, const Results &results, const std::string &scene)
{
  HtmlTable table;
  table.header = {{HtmlCell("method", "left")}};
  for (const Column &column : columns()) {
    table.header[0].emplace_back(column.title);
  }
  for (const std::string &method : plan.methods) {
    HtmlTable::Row row = {methodCell(method)};
    for (const Column &column : columns()) {
      row.emplace_back(column.text(results.cell(scene, method)));
    }
    table.rows.push_back(row);
  }
  return table;
}

HtmlTable variantTable(const Plan &plan, const Results &results, const std::string &scene)
{
  HtmlTable table;
  table.header = {{HtmlCell("method", "left")}};
  const std::vector<std::string> variants = results.variants(scene);
  for (const std::string &variant : variants) {
    table.header[0].emplace_back(variant);
  }
  for (const std::string &method : plan.methods) {
    HtmlTable::Row row = {methodCell(method)};
    for (const std::string &variant : variants) {
      const Cell cell = results.cell(scene, method, variant);
      HtmlCell text(countText(cell.successes(), cell.runs.size()));
      text.hint = intervalText(cell);
      row.push_back(text);
    }
    table.rows.push_back(row);
  }
  return table;
}
} // namespace planCompare
