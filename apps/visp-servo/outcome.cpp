/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "outcome.h"

#include "viewData.h"
#include "numberText.h"

#include <visp3/core/vpMath.h>

namespace visualServo
{
namespace
{
using vpApp::fixed;
using Json = nlohmann::ordered_json;

//! \brief One of the measured times.
struct Duration {
  std::string word;     //!< Short name.
  std::string sentence; //!< What it is.
  const vpTimingStatistics *statistics;
};

std::vector<Duration> durationsOf(const vpServoTiming &timing)
{
  return {{"image_period", "Time between images", &timing.image},
          {"latency", "Time from capture to the first step that uses the image", &timing.latency},
          {"vision", "Computing time of an image", &timing.vision},
          {"step_period", "Time between steps", &timing.period},
          {"step_jitter", "Deviation of that time from the period", &timing.jitter},
          {"step", "Computing time of a step", &timing.step}};
}

//! Bins that are not empty: from, to (ms), number.
Json histogramOf(const vpTimingStatistics &times)
{
  Json bins = Json::array();
  for (std::size_t i = 0; i < vpTimingStatistics::bins; ++i) {
    if (times.countOf(i) > 0) {
      const double from = i > 0 ? vpTimingStatistics::upperBound(i - 1) : 0.;
      bins.push_back({1e3 * from, 1e3 * vpTimingStatistics::upperBound(i), times.countOf(i)});
    }
  }
  return bins;
}

Json timesOf(const vpServoTiming &timing)
{
  Json times = Json::object();
  for (const Duration &duration : durationsOf(timing)) {
    const vpTimingStatistics &s = *duration.statistics;
    if (s.count() > 0) {
      times[duration.word] = {
          {"sentence", duration.sentence},    {"count", s.count()},      {"median_ms", 1e3 * s.quantile(0.5)},
          {"p99_ms", 1e3 * s.quantile(0.99)}, {"max_ms", 1e3 * s.max()}, {"histogram", histogramOf(s)}};
    }
  }
  return times;
}

Json settingsOf(const Options &options)
{
  const vpServoMotionLimits &limits = options.law.motion;
  return {{"lambda", options.law.gains.lambda},
          {"period_s", options.servo.period},
          {"linear_velocity_mps", limits.linearVelocity},
          {"linear_acceleration_mps2", limits.linearAcceleration},
          {"linear_jerk_mps3", limits.linearJerk},
          {"angular_velocity_radps", limits.angularVelocity},
          {"angular_acceleration_radps2", limits.angularAcceleration},
          {"angular_jerk_radps3", limits.angularJerk}};
}

//! What the camera looks at. Empty size: not known.
Json sceneOf(const Outcome &outcome)
{
  const vpCameraParameters &camera = outcome.eye.intrinsics;
  const TargetOptions &target = outcome.options->target;
  const bool isKnown = target.reference.empty();
  Json size = nullptr, goal = nullptr;
  if (isKnown) {
    size = {target.width, target.height > 0. ? target.height : target.width};
    goal = vpApp::rowsOf(vpRigidTransform::fromHomogeneous(outcome.cdMo));
  }
  Json scene = {{"camera",
                 {{"px", camera.get_px()},
                  {"py", camera.get_py()},
                  {"u0", camera.get_u0()},
                  {"v0", camera.get_v0()},
                  {"width", outcome.eye.width},
                  {"height", outcome.eye.height}}},
                {"size_m", size},
                {"goal", goal},
                {"picture", !isKnown                   ? Json("reference.png")
                            : target.tagFamily.empty() ? Json("target.png")
                                                       : Json(nullptr)}};
  if (outcome.options->camera.isFixed) {
    scene["fMc"] = vpApp::rowsOf(outcome.eye.fMc);
  }
  return scene;
}
} // namespace

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
    if (recording.found() == 0 && recording.imageCount() > 0) {
      lines.push_back("The target was in no image. It is " + outcome.target + ".");
    }
    if (row.status == vpVisualServoStatus::Obstructed) {
      lines.push_back(recording.sentenceOf(row));
    }
    for (const std::string &hindrance : outcome.hindrances) {
      lines.push_back("At the end: " + hindrance + ".");
    }
  }
  if (outcome.options->motion.dryRun) {
    lines.emplace_back("Dry run: nothing was commanded to a robot.");
  }
  else if (!outcome.hasStarted) {
    lines.emplace_back(
        "The robot was not told to move: --start, or the space bar in the window of --display, does it.");
  }
  if (outcome.eye.isAssumed) {
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

Json summaryOf(const Outcome &outcome, const std::string &commandLine)
{
  const Recording &recording = *outcome.recording;
  Json json = {{"version", VISP_DIRECT_VERSION},
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
               {"real_time", outcome.realTime},
               {"settings", settingsOf(*outcome.options)},
               {"scene", sceneOf(outcome)},
               {"times", timesOf(*outcome.timing)}};
  if (recording.cycleCount() > 0) {
    const CycleRow &row = recording.last();
    json["duration_s"] = row.time;
    json["end"] = {{"status", vpToString(row.status)},
                   {"message", recording.sentenceOf(row)},
                   {"position_error_mm", row.hasPose ? Json(1e3 * row.positionError) : nullptr},
                   {"rotation_error_deg", row.hasPose ? Json(vpMath::deg(row.rotationError)) : nullptr}};
  }
  json["findings"] = findings(outcome);
  return json;
}
} // namespace visualServo
