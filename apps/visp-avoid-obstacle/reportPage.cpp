/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "reportPage.h"

#include "numberText.h"

#include <cmath>

namespace avoidObstacle
{
namespace
{
using vpApp::fixed;
using vpApp::HtmlCell;
using vpApp::HtmlReport;
using vpApp::HtmlTable;
using vpApp::number;

std::string timeText(const std::optional<double> &time) { return time ? fixed(*time, 3) : "-"; }
std::string mm(double metres) { return fixed(1000. * metres, 1); }
std::string bounded(double value, double bound, const char *unit)
{
  return number(value, 3) + " of " + number(bound, 3) + " " + unit;
}

void addNumbers(HtmlReport &page, const vpAvoidanceRun &run)
{
  const vpAvoidanceMetrics &m = run.metrics;
  const vpAvoidanceMethodSpec &limits = run.spec.methodSpec;
  const JointUse use = jointUseOf(run);
  page.facts(
      {{"Ended", m.status},
       {"Duration", fixed(m.duration_s, 2) + " s"},
       {"Distance from the goal in the end", mm(m.goal_error_m) + " mm"},
       {"Least clearance of the whole arm, true scene, at every instant", mm(m.min_clearance_m) + " mm"},
       {"Commanded tool, speed", bounded(m.peak_v, limits.maxVelocity, "m/s")},
       {"Commanded tool, acceleration", bounded(m.peak_a, limits.maxAcceleration, "m/s^2")},
       {"Periods over these bounds without a protective stop",
        std::to_string(m.tool_v_violations) + " and " + std::to_string(m.tool_a_violations)},
       {"Joints, part of their velocity limits", fixed(100. * use.velocity, 0) + " %"},
       {"Joints, part of their acceleration limits", fixed(100. * use.acceleration, 0) + " %"},
       {"Protective stops, of them without a reason", std::to_string(m.stops) + ", " + std::to_string(m.false_stops)},
       {"Way of the tool", fixed(m.path_length, 3) + " m"},
       {"Time of a look at a new picture, median / 99 %",
        number(m.replan_ms_p50, 2) + " / " + number(m.replan_ms_p99, 2) + " ms"}},
      "The run in numbers");
}

void addTurns(HtmlReport &page, const vpAvoidanceRun &run)
{
  HtmlTable table;
  table.header = {{HtmlCell("from s"), HtmlCell("status", "left"), HtmlCell("what it means", "left")}};
  for (const StatusChange &turn : statusChangesOf(run)) {
    table.rows.push_back(
        {HtmlCell(fixed(turn.time, 2)),
         HtmlCell(std::string(vpToString(turn.status)) + (turn.stopping ? ", protective stop" : ""), "left"),
         HtmlCell(vpMessage(turn.status), "left")});
  }
  page.table(table, "What the method did; changes shorter than 50 ms are left out");
}

void addSightings(HtmlReport &page, const PhotoScene &scene, const Episode &episode)
{
  HtmlTable table;
  table.header = {{HtmlCell("obstacle", "left"), HtmlCell("pictures"), HtmlCell("seen in"), HtmlCell("first seen s"),
                   HtmlCell("known from s"), HtmlCell("last seen s"), HtmlCell("longest gap s"),
                   HtmlCell("error mm, median"), HtmlCell("worst"), HtmlCell("reported sigma mm"),
                   HtmlCell("track: worst error mm"), HtmlCell("least inflation less error mm")}};
  for (const SightingSummary &a : sightingSummaries(scene, episode)) {
    const bool known = a.known.has_value(), seen = a.firstSeen.has_value();
    table.rows.push_back({HtmlCell(a.object, "left"), HtmlCell(std::to_string(a.frames)),
                          HtmlCell(std::to_string(a.seen)), HtmlCell(timeText(a.firstSeen)),
                          HtmlCell(timeText(a.known)), HtmlCell(timeText(a.lastSeen)), HtmlCell(fixed(a.gap, 2)),
                          HtmlCell(seen ? mm(a.medianError) : "-"), HtmlCell(seen ? mm(a.worstError) : "-"),
                          HtmlCell(seen ? mm(a.medianSigma) : "-"), HtmlCell(known ? mm(a.worstTrackError) : "-"),
                          HtmlCell(known ? mm(a.leastMargin) : "-", known && a.leastMargin < 0. ? "worst" : "")});
  }
  page.table(table, "How well the obstacles were seen. An obstacle is known to the method from the time on when the "
                    "result of the first picture arrives");
}

std::string hiddenText(const Options &options)
{
  std::vector<std::string> intervals;
  for (const auto &[from, until] : options.hidden) {
    intervals.push_back(number(from, 4) + " to " + number(until, 4) + " s");
  }
  return intervals.empty() ? "never" : vpApp::enumerate(intervals);
}

void addSettings(HtmlReport &page, const PhotoScene &scene, const Options &options, const vpAvoidanceRun &run,
                 const std::string &commandLine)
{
  page.facts(
      {{"Command", commandLine},
       {"Arm", scene.arm->label()},
       {"Scene, motion", scene.name + ", " + scene.task.name},
       {"Method", options.method},
       {"Control", number(1. / run.spec.methodSpec.period, 4) + " Hz"},
       {"Sensor", std::string(nameOf(options.sensor)) + " at " + number(options.visionRate, 4) + " Hz, " +
                      number(1000. * options.latency, 4) + " ms from exposure to result"},
       {"Camera covered", hiddenText(options)},
       {"Noise of pictures", number(options.noise, 3) + " grey values"},
       {"Drives", run.spec.drives.ideal ? "ideal"
                                        : "PD with gravity and friction compensation, torques at 1 kHz against " +
                                              number(options.friction, 3) + " times the friction of the file"},
       {"What is out of view", options.forget > 0. ? "is forgotten after " + number(options.forget, 4) + " s"
                                                   : std::string("stays where it was, and its uncertainty grows")},
       {"Seed", std::to_string(options.seed)}},
      "Settings");
  if (!scene.warnings.empty()) {
    page.list(scene.warnings);
  }
}
} // namespace

void addFigure(HtmlReport &page, const Figure &figure)
{
  if (!figure.html.empty()) {
    page.raw(figure.html);
    page.paragraph(figure.title + ". " + figure.caption);
  }
  else if (!figure.jpeg.empty()) {
    page.picture(vpApp::dataUri("image/jpeg", figure.jpeg), figure.title, figure.title + ". " + figure.caption);
  }
  else if (!figure.svg.empty()) {
    page.picture(vpApp::dataUri("image/svg+xml", figure.svg), figure.title, figure.title + ". " + figure.caption);
  }
}

std::string reportPage(const PhotoScene &scene, const Options &options, const Episode &episode,
                       const std::vector<Figure> &figures, const FilmFile &film, const std::string &commandLine)
{
  HtmlReport page("Avoiding what the camera sees: " + scene.name,
                  "Arm, drives and camera are simulated; the obstacles' photographs are real, their views rendered.");
  const auto add = [&](const char *name) {
    for (const Figure &figure : figures) {
      if (figure.name == name) {
        addFigure(page, figure);
      }
    }
  };
  page.section("What happened");
  page.highlight(findingsOf(scene, options, episode));
  add("way");
  addTurns(page, episode.run);
  add("animation");
  if (!film.name.empty() && film.forBrowsers) {
    page.videos({{vpApp::dataUri("video/mp4", film.bytes), "Camera and arm, " + film.name + "."}});
  }
  else if (!film.name.empty()) {
    page.paragraph("Video: " + film.name + ", for players; browsers do not play it.");
  }
  page.section("What was seen");
  add("views");
  addSightings(page, scene, episode);
  add("tracks");
  page.section("Motion");
  addNumbers(page, episode.run);
  add("times");
  page.section("How it was made");
  addSettings(page, scene, options, episode.run, commandLine);
  return page.html();
}

std::string replicaPage(const Replica &replica, const std::string &commandLine)
{
  HtmlReport page("Replica of figure " + replica.name.substr(3), replica.title + ".");
  page.section("What came out");
  page.highlight(replica.findings);
  HtmlTable table;
  table.header = {{HtmlCell("", "left"), HtmlCell("thesis", "left"), HtmlCell("here", "left"), HtmlCell("agrees")}};
  for (const Comparison &c : replica.comparisons) {
    table.rows.push_back({HtmlCell(c.what, "left"), HtmlCell(c.thesis, "left"), HtmlCell(c.ours, "left"),
                          HtmlCell(c.agrees ? "yes" : "no", c.agrees ? "" : "worst")});
  }
  page.table(table, "The thesis's values beside ours; what it does not tell cannot disagree");
  for (const Figure &figure : replica.figures) {
    addFigure(page, figure);
  }
  page.section("What was chosen here");
  page.list(replica.choices);
  page.section("How it was made");
  page.facts({{"Command", commandLine}}, "Settings");
  return page.html();
}
} // namespace avoidObstacle
