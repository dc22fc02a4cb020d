/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "reportPage.h"

#include "findings.h"
#include "results.h"

#include "appMain.h"
#include "htmlReport.h"
#include "numberText.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cmath>

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

//! Methods by scenes: successes, and their median duration.
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

//! Description and strengths of each method.
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

//! All metrics of a scene.
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

//! Successes of a scene by variant.
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

using vpApp::fixed;
using vpApp::HtmlCell;
using vpApp::HtmlReport;
using vpApp::HtmlTable;
using vpApp::number;
using M = vpAvoidanceMetrics;

constexpr const char *COLUMNS_CAPTION = "touched: runs in which the arm touched something while it moved; hit at rest: "
                                        "something ran into the standing arm. "
                                        "clearance: the least of all runs, at every instant, to 0.1 mm (negative: "
                                        "depth). goal, s, path, jerk^2 (integral of the "
                                        "squared jerk, m^2/s^5): medians; s, path and jerk^2 of the successes. v, a, "
                                        "jerk: the largest of all runs, m/s, m/s^2, "
                                        "m/s^3. replan: wall time of a look at the scene, 50 / 95 / 99 %. false stops: "
                                        "of how many. over v, a: runs above a bound "
                                        "or limit.";

void writeScene(HtmlReport &page, const Plan &plan, const Results &results, const SceneInfo &scene,
                const std::vector<Figure> &figures)
{
  page.section(scene.id == scene.name ? scene.id : scene.id + " " + scene.name);
  page.paragraph(scene.sentence);
  page.list(findingsOf(plan, results, scene));
  for (const Figure &figure : figures) {
    if (figure.scene == scene.id && figure.name == scene.id + "-arm") {
      page.picture(vpApp::dataUri("image/svg+xml", figure.svg), figure.title, figure.caption);
    }
  }
  page.table(sceneTable(plan, results, scene.id), COLUMNS_CAPTION);
  if (results.variants(scene.id).size() > 1) {
    page.table(variantTable(plan, results, scene.id), "Successes by what differs among the runs of this scene.");
  }
  for (const Figure &figure : figures) {
    if (figure.scene != scene.id) {
      continue;
    }
    if (!figure.html.empty()) {
      page.raw(figure.html);
      page.paragraph(figure.caption);
    }
    else if (figure.name != scene.id + "-arm") {
      page.picture(vpApp::dataUri("image/svg+xml", figure.svg), figure.title, figure.title + ". " + figure.caption);
    }
  }
}

void writeSelfMotion(HtmlReport &page, const std::vector<SelfMotionRow> &rows, const std::vector<Figure> &figures)
{
  page.section("S5 self-motion");
  page.paragraph(selfMotionSentence());
  page.highlight({selfMotionFinding(rows)});
  HtmlTable table;
  table.header = {{HtmlCell("index", "left"), HtmlCell("sense", "left"), HtmlCell("share"), HtmlCell("drift um"),
                   HtmlCell("turn mrad"), HtmlCell("distance at start mm"), HtmlCell("mean mm"), HtmlCell("end mm"),
                   HtmlCell("way of the joints rad")}};
  for (const SelfMotionRow &row : rows) {
    table.rows.push_back(
        {HtmlCell(row.index, "left"), HtmlCell(row.sense, "left"), HtmlCell(fixed(row.share, 1)),
         HtmlCell(number(1e6 * row.run.tcp_drift_m, 2)), HtmlCell(number(1e3 * row.run.tcp_drift_rad, 2)),
         HtmlCell(fixed(1000. * row.run.start_distance_m, 1)), HtmlCell(fixed(1000. * row.run.mean_distance_m, 1)),
         HtmlCell(fixed(1000. * row.run.end_distance_m, 1)), HtmlCell(fixed(row.run.joint_travel_rad, 2))});
  }
  page.table(table, "Distance of joint 4; drift and turn of the tool are the largest. share: length of the self-motion "
                    "relative to the motion of the task.");
  for (const Figure &figure : figures) {
    if (figure.scene == "S5") {
      page.picture(vpApp::dataUri("image/svg+xml", figure.svg), figure.title, figure.title + ". " + figure.caption);
    }
  }
}

void writeValidators(HtmlReport &page, const std::vector<ValidatorRow> &rows)
{
  page.section("S4: proofs and samples");
  page.paragraph(
      "RRTConnect on the tasks of S4 with three ways of looking at the motions between configurations: proofs "
      "that hold between samples, samples at a fixed step with the same distances, and the usual set-up, samples "
      "with FCL. A margin of 0 is asked for. One plan at a time on this machine.");
  page.highlight({validatorFinding(rows)});
  HtmlTable table;
  table.header = {{HtmlCell("scene", "left"), HtmlCell("motions", "left"), HtmlCell("solved"), HtmlCell("p50 ms"),
                   HtmlCell("p95 ms"), HtmlCell("colliding")}};
  for (const ValidatorRow &row : rows) {
    table.rows.push_back(
        {HtmlCell(row.scene, "left"), HtmlCell(row.validator, "left"),
         HtmlCell(countText(row.solved, static_cast<std::size_t>(row.plans))), HtmlCell(number(row.p50, 3)),
         HtmlCell(number(row.p95, 3)),
         HtmlCell(countText(row.colliding, static_cast<std::size_t>(row.solved)), row.colliding > 0 ? "worst" : "")});
  }
  page.table(table, "Planning time without set-up and shortening; paths that touch something at one of 10,000 places.");
}

void writeHow(HtmlReport &page, const Plan &plan, const Results &results, const Extras &extras)
{
  page.section("How it was run");
  page.list(
      {"The arm, its drives, the sensor and the obstacles are simulated; nothing here was measured on a robot.",
       "Every method gets the same scenes, seeds, noise and limits. A scene is drawn by its seed alone and certified "
       "to have a way before any method runs on it.",
       "Success: the tool within " +
           std::string(results.shown.empty() ? "2" : number(1000. * results.shown.front().spec.goalTolerance, 2)) +
           " mm of the goal, at rest, in time, and nothing touched while the arm moved.",
       "A stop is false when nothing truly was in the way: neither with the joints at the velocities before it for "
       "another "
       "second, nor with joints or tool going straight to the goal, nothing would have come nearer than the margin and "
       "20 mm. "
       "Stops for obstacles on other ways count as false.",
       "Intervals are Wilson's, 95 %; pairs are compared by McNemar's exact test.",
       "Planners that search have limits of time: on a slower machine their results may differ. All else repeats."});
  if (!plan.remarks.empty()) {
    page.list(plan.remarks);
  }
  page.facts({{"Arm", plan.arm->label()},
              {"Runs", std::to_string(results.records.size())},
              {"Program", "visp-plan-compare " + vpApp::versionText()},
              {"Command line", extras.commandLine},
              {"Wall time", fixed(extras.wallTime, 0) + " s"}},
             "summary.json and runs.csv have all numbers, arena/ has logs for Planner Arena.");
}
} // namespace

std::string reportPage(const Plan &plan, const Results &results, const Extras &extras,
                       const std::vector<Figure> &figures)
{
  HtmlReport page("Ways round obstacles compared", std::to_string(plan.methods.size()) + " methods on " +
                                                       std::to_string(plan.problems.size()) +
                                                       " scenes of a simulated arm: what each is good for.");
  if (!plan.scenes.empty()) {
    page.highlight(answerOf(plan, results));
    page.table(
        mainTable(plan, results),
        "Share of the runs that succeed, and median duration of those, s. Green: the most successes on a scene. Red: "
        "the arm touched something while moving in at least one run, and others have more successes. Rest the pointer "
        "on a number for counts and intervals.");
    page.table(verdictTable(plan, results), "Computed from the runs of this report.");
  }
  for (const SceneInfo &scene : plan.scenes) {
    writeScene(page, plan, results, scene, figures);
  }
  if (!extras.selfMotion.empty()) {
    writeSelfMotion(page, extras.selfMotion, figures);
  }
  if (!extras.validators.empty()) {
    writeValidators(page, extras.validators);
  }
  writeHow(page, plan, results, extras);
  return page.html();
}
} // namespace planCompare
