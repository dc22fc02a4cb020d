/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "reportPage.h"
#include "appMain.h"

#include "findings.h"
#include "htmlReport.h"
#include "numberText.h"
#include "resultTables.h"

#include <algorithm>
#include <cmath>

namespace planCompare
{
namespace
{
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
