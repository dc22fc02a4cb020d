/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "report.h"

#include "htmlReport.h"
#include "numberText.h"
#include "timePlot.h"

#include <visp3/core/vpMath.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace visualServo
{
namespace
{
using vpApp::fixed;
constexpr std::size_t LARGEST_EVENTS = 40;

vpApp::HtmlTable::Row headings(const std::vector<std::string> &texts) { return {texts.begin(), texts.end()}; }

std::string svg(const std::string &document) { return vpApp::dataUri("image/svg+xml", document); }

vpApp::PlotCurve curve(const Outcome &outcome, const std::string &label, const std::string &colour,
                       double (*value)(const CycleRow &))
{
  const std::vector<CycleRow> &rows = outcome.recording->cycles();
  return vpApp::timeCurve(
      label, colour, rows.size(), [&](std::size_t i) { return rows[i].time; },
      [&](std::size_t i) { return value(rows[i]); });
}

bool wasSeen(const Outcome &outcome)
{
  const std::vector<CycleRow> &rows = outcome.recording->cycles();
  return std::any_of(rows.begin(), rows.end(), [](const CycleRow &row) { return std::isfinite(row.positionError); });
}

std::string errorFigure(const Outcome &outcome)
{
  vpApp::Plot position = vpApp::timePlot("Distance from the goal", "mm");
  position.curves.push_back(curve(outcome, "", "#1f77b4", [](const CycleRow &row) { return 1e3 * row.positionError; }));
  position.fromZero = true;
  vpApp::Plot rotation = vpApp::timePlot("Angle from the goal", "degrees");
  rotation.curves.push_back(
      curve(outcome, "", "#d62728", [](const CycleRow &row) { return vpMath::deg(row.rotationError); }));
  rotation.fromZero = true;
  return vpApp::renderPanels({position, rotation}, vpApp::PlotFormat::Svg);
}

std::string speedFigure(const Outcome &outcome)
{
  const vpServoMotionLimits &limits = outcome.options->law.motion;
  vpApp::Plot linear = vpApp::timePlot("Commanded speed of the camera", "mm/s");
  linear.curves.push_back(
      curve(outcome, "", "#1f77b4", [](const CycleRow &row) { return 1e3 * row.twist.linearNorm(); }));
  linear.fromZero = true;
  vpApp::addLevel(linear, 1e3 * limits.linearVelocity, "limit");
  vpApp::Plot angular = vpApp::timePlot("Commanded angular speed", "degrees/s");
  angular.curves.push_back(
      curve(outcome, "", "#d62728", [](const CycleRow &row) { return vpMath::deg(row.twist.angularNorm()); }));
  angular.fromZero = true;
  vpApp::addLevel(angular, vpMath::deg(limits.angularVelocity), "limit");
  return vpApp::renderPanels({linear, angular}, vpApp::PlotFormat::Svg);
}

//! Histograms on one logarithmic axis.
std::string timeFigure(const Outcome &outcome)
{
  static const char *const colours[] = {"#1f77b4", "#ff7f0e", "#2ca02c", "#17becf", "#7f7f7f", "#d62728"};
  vpApp::Plot plot;
  plot.xLabel = "ms";
  plot.yLabel = "share (%)";
  plot.logX = plot.fromZero = true;
  plot.height = 360;
  plot.xRange = {1e-3, 1e4};
  std::size_t number = 0;
  for (const Duration &duration : durationsOf(*outcome.timing)) {
    const vpTimingStatistics &times = *duration.statistics;
    vpApp::PlotCurve bins;
    bins.label = duration.word;
    bins.colour = colours[number++ % std::size(colours)];
    for (std::size_t i = 1; i + 1 < vpTimingStatistics::bins; ++i) {
      const double left = 1e3 * vpTimingStatistics::upperBound(i - 1), right = 1e3 * vpTimingStatistics::upperBound(i);
      const double share = 100. * static_cast<double>(times.countOf(i)) / static_cast<double>(times.count());
      const bool isShown = times.count() > 0 && left >= plot.xRange.first && right <= plot.xRange.second;
      bins.x.insert(bins.x.end(), {left, right});
      bins.y.insert(bins.y.end(), {isShown ? share : NOTHING, isShown ? share : NOTHING});
    }
    if (times.count() > 0) {
      plot.curves.push_back(bins);
    }
  }
  return plot.curves.empty() ? "" : vpApp::renderSvg(plot);
}

void addTimes(const Outcome &outcome, vpApp::HtmlReport &page)
{
  vpApp::HtmlTable table;
  table.header = {headings({"", "in the figure", "number", "median", "99 %", "largest"})};
  for (const Duration &duration : durationsOf(*outcome.timing)) {
    const vpTimingStatistics &times = *duration.statistics;
    if (times.count() == 0) {
      continue;
    }
    const auto ms = [](double s) { return vpApp::number(1e3 * s, 3) + " ms"; };
    table.rows.push_back({vpApp::HtmlCell(duration.sentence, "left"), duration.word, std::to_string(times.count()),
                          ms(times.quantile(0.5)), ms(times.quantile(0.99)), ms(times.max())});
  }
  page.table(table, "Quantiles are exact to 5 %.");
  const std::string figure = timeFigure(outcome);
  if (!figure.empty()) {
    page.picture(svg(figure), "histograms of the times",
                 "How often each duration occurred, on a logarithmic axis. A narrow peak is a steady clock.");
  }
  if (!outcome.realTime.empty()) {
    page.paragraph(outcome.realTime + " doc/real-time.md helps.");
  }
  else {
    page.paragraph(
        "This run went as fast as the machine can: latency, periods and jitter are those of the simulated or recorded "
        "clock; only the computing times are real. --real-time measures them all.");
  }
}

void addEvents(const Outcome &outcome, vpApp::HtmlReport &page)
{
  const std::vector<Event> &events = outcome.recording->events();
  vpApp::HtmlTable table;
  table.header = {headings({"time", "status", ""})};
  for (std::size_t i = 0; i < std::min(events.size(), LARGEST_EVENTS); ++i) {
    table.rows.push_back({fixed(events[i].time, 2) + " s", vpApp::HtmlCell(events[i].word, "left"),
                          vpApp::HtmlCell(events[i].sentence, "left")});
  }
  page.table(table, events.size() > LARGEST_EVENTS ? "The first " + std::to_string(LARGEST_EVENTS) + " of " +
                                                         std::to_string(events.size()) + " changes; all are in log.csv."
                                                   : "Every change of status.");
}

void addSettings(const Outcome &outcome, const std::string &commandLine, vpApp::HtmlReport &page)
{
  const Options &options = *outcome.options;
  const vpServoMotionLimits &limits = options.law.motion;
  page.facts(
      {{"camera", outcome.camera + ", by " + outcome.clock},
       {"target", outcome.target},
       {"robot", outcome.robot + (options.motion.dryRun ? ", not commanded (dry run)" : "")},
       {"laws used", vpApp::enumerate(outcome.laws)},
       {"gain", vpApp::number(options.law.gains.lambda, 4) + " 1/s"},
       {"limits", fixed(1e3 * limits.linearVelocity, 1) + " mm/s, " + vpApp::number(limits.linearAcceleration, 3) +
                      " m/s^2, " + vpApp::number(limits.linearJerk, 3) + " m/s^3; " +
                      fixed(vpMath::deg(limits.angularVelocity), 1) + " deg/s, " +
                      vpApp::number(limits.angularAcceleration, 3) + " rad/s^2, " +
                      vpApp::number(limits.angularJerk, 3) + " rad/s^3"},
       {"control period", vpApp::number(1e3 * options.servo.period, 4) + " ms"},
       {"command", commandLine},
       {"version", VISP_DIRECT_VERSION}},
      "What was run.");
}
} // namespace

std::vector<Duration> durationsOf(const vpServoTiming &timing)
{
  return {{"image period", "Time between images", &timing.image},
          {"latency", "Time from capture to the first step that uses the image", &timing.latency},
          {"vision", "Computing time of an image", &timing.vision},
          {"step period", "Time between steps", &timing.period},
          {"step jitter", "Deviation of that time from the period", &timing.jitter},
          {"step", "Computing time of a step", &timing.step}};
}

std::vector<std::string> findings(const Outcome &outcome)
{
  const Recording &recording = *outcome.recording;
  std::vector<std::string> lines;
  std::string first = sentenceOf(outcome.ending);
  if (!outcome.failure.empty()) {
    first += " " + outcome.failure;
  }
  lines.push_back(first);
  if (recording.cycleCount() > 0) {
    const CycleRow &row = recording.last();
    lines.push_back(
        fixed(row.time, 2) + " s: " + std::to_string(recording.cycleCount()) + " cycles, " +
        std::to_string(recording.imageCount()) + " images, the target found in " + std::to_string(recording.found()) +
        " of them" +
        (outcome.lostImages > 0 ? ", " + std::to_string(outcome.lostImages) + " images lost on the way" : "") + ".");
    lines.push_back(row.hasPose
                        ? "At the end the camera was " + fixed(1e3 * row.positionError, 2) + " mm and " +
                              fixed(vpMath::deg(row.rotationError), 3) + " degrees from the goal, as it sees it."
                        : "At the end the target was not seen: " + std::string(row.message));
  }
  if (outcome.options->motion.dryRun) {
    lines.emplace_back("Dry run: nothing was commanded to a robot.");
  }
  else if (!outcome.hasStarted) {
    lines.emplace_back(
        "The robot was not told to move: --start, or the space bar in the window of --display, does it.");
  }
  if (outcome.isAssumedCamera) {
    lines.emplace_back(
        "There is no --camera-xml: a field of view of 60 degrees was assumed, so distances are only rough.");
  }
  if (outcome.lostRows + outcome.unrecorded > 0) {
    lines.push_back("The files lack " + std::to_string(outcome.lostRows) + " cycles and " +
                    std::to_string(outcome.unrecorded) + " images: writing was too slow.");
  }
  lines.insert(lines.end(), outcome.remarks.begin(), outcome.remarks.end());
  return lines;
}

std::string reportPage(const Outcome &outcome, const std::string &video, const std::string &picture,
                       const std::string &commandLine)
{
  vpApp::HtmlReport page("Visual servoing", outcome.camera + "; " + outcome.robot + "; " + outcome.target);
  page.section("What came out");
  page.highlight(findings(outcome));
  if (!video.empty()) {
    page.videos({{vpApp::dataUri("video/mp4", video), "What the camera saw. Green: the target as it was found; blue, "
                                                      "dashed: where it is at the goal; yellow: the way of "
                                                      "its corners in the last 3 s."}});
  }
  else if (!picture.empty()) {
    page.picture(vpApp::dataUri("image/png", picture), "the last image",
                 "The last image. Green: the target as it was found; blue, dashed: where it is at the goal.");
  }
  if (outcome.recording->cycleCount() > 1) {
    page.section("Motion");
    if (wasSeen(outcome)) {
      page.picture(svg(errorFigure(outcome)), "distance from the goal over time",
                   "From the last image, carried on to each cycle by the motion of the robot since its capture. A gap: "
                   "the target was "
                   "not seen.");
    }
    page.picture(svg(speedFigure(outcome)), "speed over time", "As it was given to the robot, within the limits.");
  }
  page.section("Status");
  addEvents(outcome, page);
  page.section("Time");
  addTimes(outcome, page);
  page.section("Settings");
  addSettings(outcome, commandLine, page);
  page.paragraph(
      "Beside this page: log.csv (every cycle), images.csv (every image), camera.mkv (the images without loss, for "
      "visp-servo --replay), view.mp4, summary.json. data/servo/README.md describes their columns.");
  return page.html();
}

nlohmann::ordered_json summaryOf(const Outcome &outcome, const std::string &commandLine)
{
  const Recording &recording = *outcome.recording;
  nlohmann::ordered_json times = nlohmann::ordered_json::object();
  for (const Duration &duration : durationsOf(*outcome.timing)) {
    const vpTimingStatistics &s = *duration.statistics;
    if (s.count() > 0) {
      std::string key = duration.word;
      std::replace(key.begin(), key.end(), ' ', '_');
      times[key] = {{"count", s.count()},
                    {"median_ms", 1e3 * s.quantile(0.5)},
                    {"p99_ms", 1e3 * s.quantile(0.99)},
                    {"max_ms", 1e3 * s.max()}};
    }
  }
  nlohmann::ordered_json json = {{"version", VISP_DIRECT_VERSION},
                                 {"command", commandLine},
                                 {"status", outcome.ending == Ending::Failed        ? "incomplete"
                                            : outcome.ending == Ending::Interrupted ? "interrupted"
                                                                                    : "complete"},
                                 {"ending", sentenceOf(outcome.ending)},
                                 {"failure", outcome.failure},
                                 {"camera", outcome.camera},
                                 {"clock", outcome.clock},
                                 {"target", outcome.target},
                                 {"robot", outcome.robot},
                                 {"dry_run", outcome.options->motion.dryRun},
                                 {"laws", outcome.laws},
                                 {"cycles", recording.cycleCount()},
                                 {"images", recording.imageCount()},
                                 {"images_found", recording.found()},
                                 {"images_lost", outcome.lostImages},
                                 {"times", times}};
  if (recording.cycleCount() > 0) {
    const CycleRow &row = recording.last();
    json["duration_s"] = row.time;
    json["end"] = {
        {"status", vpToString(row.status)},
        {"message", row.message},
        {"position_error_mm", row.hasPose ? nlohmann::ordered_json(1e3 * row.positionError) : nullptr},
        {"rotation_error_deg", row.hasPose ? nlohmann::ordered_json(vpMath::deg(row.rotationError)) : nullptr}};
  }
  json["findings"] = findings(outcome);
  return json;
}
} // namespace visualServo
