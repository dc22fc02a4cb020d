/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoExperiment.h"

#include <visp3/core/vpException.h>
#include <visp3/core/vpMath.h>

#include "lab/servo/vpServoGeometry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr double settledRotation = 2. * M_PI / 180.;
constexpr double settledTranslation = 0.005;

double idealYawRange(const vpServoTask &task)
{
  double lowest = 0., highest = 0.; // world frame: the camera at the start
  for (const vpServoSegment &segment : task.segments) {
    const double yaw = vpServoGeometry::yaw(vpServoGeometry::rotation(task.initial * segment.cdMo.inverse()));
    lowest = std::min(lowest, yaw);
    highest = std::max(highest, yaw);
  }
  return vpMath::deg(highest - lowest);
}

// Final status of the run: the first rule that applies.
std::string describeEnd(const vpServoRunSpec &spec, const std::vector<vpServoSample> &samples)
{
  char text[256];
  double duration = 0.;
  for (const vpServoSegment &segment : spec.task.segments) {
    duration += segment.duration;
  }
  const double cycle = 1. / spec.plant.loopRate, end = samples.back().time + cycle;
  if (end < duration - 1.5 * cycle) {
    std::snprintf(text, sizeof(text), "stopped after %.2f s of %.2f s", end, duration);
    return text;
  }
  const vpServoStatus last = samples.back().status;
  if (last == vpServoStatus::Servoing || last == vpServoStatus::ViewLimited) {
    return "ok";
  }
  auto since = samples.end() - 1;
  while (since != samples.begin() && (since - 1)->status == last) {
    --since;
  }
  std::snprintf(text, sizeof(text), "ended in %s since %.2f s: %s", vpToString(last), since->time, vpMessage(last));
  return text;
}

vpTwist minus(const vpTwist &a, const vpTwist &b)
{
  return vpTwist(a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3], a[4] - b[4], a[5] - b[5]);
}

// Time from a segment's first sample until its errors stay small.
double settlingTime(const vpServoSample *first, const vpServoSample *last, double cycle)
{
  const vpServoSample *s = last;
  while (s != first && (s - 1)->rotationError < settledRotation && (s - 1)->translationError < settledTranslation) {
    --s;
  }
  return (s - first) * cycle;
}
} // namespace

vpServoMetrics evaluateServoRun(const vpServoRunSpec &spec, const std::vector<vpServoSample> &samples)
{
  vpServoMetrics m;
  m.ideal_yaw_range_deg = idealYawRange(spec.task);
  if (samples.empty()) {
    m.status = "no cycle was run";
    return m;
  }
  const double cycle = 1. / spec.plant.loopRate;
  double squares = 0., lowestYaw = samples.front().yaw, highestYaw = lowestYaw, settleSum = 0.;
  int segments = 0;
  vpTwist before; // the camera starts at rest
  const vpServoSample *const end = samples.data() + samples.size();
  const vpServoSample *segmentBegin = samples.data();
  for (const vpServoSample *s = samples.data(); s != end; ++s) {
    const double error = std::hypot(s->imageErrorU, s->imageErrorV);
    m.max_image_error_px = std::max(m.max_image_error_px, error);
    squares += error * error;
    lowestYaw = std::min(lowestYaw, s->yaw);
    highestYaw = std::max(highestYaw, s->yaw);
    m.out_of_view_s += s->inView ? 0. : cycle;
    m.path_length_m += s->actual.linearNorm() * cycle;
    m.peak_linear_mps = std::max(m.peak_linear_mps, s->actual.linearNorm());
    m.peak_angular_radps = std::max(m.peak_angular_radps, s->actual.angularNorm());
    const vpTwist asked = vpLimitTwist(s->commanded, spec.plant.maxLinear, spec.plant.maxAngular);
    const vpTwist change = minus(asked, before);
    m.peak_linear_acceleration_mps2 = std::max(m.peak_linear_acceleration_mps2, change.linearNorm() / cycle);
    m.peak_angular_acceleration_radps2 = std::max(m.peak_angular_acceleration_radps2, change.angularNorm() / cycle);
    before = asked;
    m.deadlock_cycles += s->status == vpServoStatus::Deadlock ? 1 : 0;
    if (s + 1 == end || (s + 1)->segment != s->segment) {
      m.end_rotation_deg = std::max(m.end_rotation_deg, vpMath::deg(s->rotationError));
      m.end_translation_mm = std::max(m.end_translation_mm, 1000. * s->translationError);
      m.left_end_rotation_deg = std::max(m.left_end_rotation_deg, vpMath::deg(s->seenRotationError));
      m.left_end_translation_mm = std::max(m.left_end_translation_mm, 1000. * s->seenTranslationError);
      m.expected_end_rotation_deg =
          std::max(m.expected_end_rotation_deg, vpMath::deg(std::hypot(s->seenRotationError, s->rotationDeviation)));
      m.expected_end_translation_mm =
          std::max(m.expected_end_translation_mm, 1000. * std::hypot(s->seenTranslationError, s->translationDeviation));
      settleSum += settlingTime(segmentBegin, s + 1, cycle);
      segmentBegin = s + 1;
      ++segments;
    }
  }
  m.rms_image_error_px = std::sqrt(squares / samples.size());
  m.yaw_range_deg = vpMath::deg(highestYaw - lowestYaw);
  m.settle_s = settleSum / segments;
  m.status = describeEnd(spec, samples);
  return m;
}

END_VISP_NAMESPACE
