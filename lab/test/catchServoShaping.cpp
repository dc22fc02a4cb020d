/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The twist shaper between controller and plant: bounds, unchanged properties, and costs.
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include "lab/servo/vpServoExperiment.h"

#include <algorithm>
#include <cmath>
#include <limits>

VISP_DIRECT_USING_NAMESPACE

namespace
{
vpServoRunSpec specOf(const std::string &law, const std::string &plant, double segmentDuration)
{
  vpServoRunSpec spec;
  spec.law = law;
  spec.plant = vpServoPlant::byName(plant);
  for (vpServoSegment &segment : spec.task.segments) {
    segment.duration = segmentDuration;
  }
  return spec;
}

// Rotation matches sideways motion at about 0.4 m from the object.
vpTwistShaperLimits gentle()
{
  vpTwistShaperLimits limits;
  limits.angularAcceleration = 2.5;
  limits.angularJerk = 25.;
  return limits;
}

// Largest differences of the commanded twists, by time; the camera is at rest before the first.
struct Peaks {
  double acceleration[2] = {0., 0.}; // linear m/s^2, angular rad/s^2
  double jerk[2] = {0., 0.};         // linear m/s^3, angular rad/s^3
  double speed[2] = {0., 0.};        // linear m/s, angular rad/s
};

double norm(const double (&d)[6], int part)
{
  return std::sqrt(d[3 * part] * d[3 * part] + d[3 * part + 1] * d[3 * part + 1] + d[3 * part + 2] * d[3 * part + 2]);
}

Peaks peaksOf(const vpServoRun &run, std::size_t from = 0, std::size_t count = std::numeric_limits<std::size_t>::max())
{
  const double rate = run.spec.plant.loopRate;
  const auto at = [&](std::size_t k) { return k < run.samples.size() ? run.samples[k].commanded : vpTwist(); };
  Peaks peaks;
  for (std::size_t k = from; k < run.samples.size() && k - from < count; ++k) {
    const vpTwist v = at(k), v1 = at(k - 1), v2 = at(k - 2); // before the start the index wraps: at rest
    double first[6], second[6], twist[6];
    for (std::size_t i = 0; i < 6; ++i) {
      twist[i] = v[i];
      first[i] = (v[i] - v1[i]) * rate;
      second[i] = (v[i] - 2. * v1[i] + v2[i]) * rate * rate;
    }
    for (int part = 0; part < 2; ++part) {
      peaks.speed[part] = std::max(peaks.speed[part], norm(twist, part));
      peaks.acceleration[part] = std::max(peaks.acceleration[part], norm(first, part));
      peaks.jerk[part] = std::max(peaks.jerk[part], norm(second, part));
    }
  }
  return peaks;
}

bool sameMotion(const vpServoRun &a, const vpServoRun &b)
{
  if (a.samples.size() != b.samples.size()) {
    return false;
  }
  for (std::size_t k = 0; k < a.samples.size(); ++k) {
    const double *v = a.samples[k].commanded.data();
    const double *M = a.samples[k].wMc.data;
    if (!std::equal(v, v + 6, b.samples[k].commanded.data()) || !std::equal(M, M + 16, b.samples[k].wMc.data)) {
      return false;
    }
  }
  return true;
}
} // namespace

TEST_CASE("a shaped command keeps acceleration and jerk in every cycle, at t = 0 and at each new goal", "[shaping]")
{
  auto rng = vpTestSupport::generator(610);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> exponent(-1., 1.);
  for (const char *plant : {"A", "B", "D"}) {
    for (const char *law : {"pbvs1", "ibvs", "ff-lookat-pi", "pbvs1-rot2+cbf"}) {
      vpServoRunSpec spec = specOf(law, plant, 1.5);
      vpTwistShaperLimits limits;
      limits.linearAcceleration = std::pow(5., exponent(rng));
      limits.linearJerk = 10. * std::pow(5., exponent(rng));
      limits.angularAcceleration = 2. * std::pow(5., exponent(rng));
      limits.angularJerk = 20. * std::pow(5., exponent(rng));
      spec.shape = limits;
      const Peaks shaped = peaksOf(runServoExperiment(spec));
      CAPTURE(plant, law);
      CHECK(shaped.acceleration[0] <= limits.linearAcceleration * (1. + 1e-9));
      CHECK(shaped.acceleration[1] <= limits.angularAcceleration * (1. + 1e-9));
      CHECK(shaped.jerk[0] <= limits.linearJerk * (1. + 1e-6));
      CHECK(shaped.jerk[1] <= limits.angularJerk * (1. + 1e-6));
      CHECK(shaped.speed[0] > 0.05); // it moves
    }
  }
}

TEST_CASE("the raw command is a step at t = 0 and at each new goal, the shaped one is not", "[shaping]")
{
  vpServoRunSpec spec = specOf("pbvs1", "A", 4.);
  const vpServoRun raw = runServoExperiment(spec);
  spec.shape = gentle();
  const vpServoRun shaped = runServoExperiment(spec);
  for (const std::size_t start : {0u, 400u, 800u}) { // 100 Hz
    CAPTURE(start);
    // 0.22 m and 28 deg away, gain 1 1/s: 0.22 m/s and 0.5 rad/s within one cycle of 10 ms.
    CHECK(peaksOf(raw, start, 1).acceleration[0] > 20.);
    CHECK(peaksOf(raw, start, 1).acceleration[1] > 45.);
    // From the remaining motion of the previous segment, at most jerk * dt per cycle.
    CHECK(peaksOf(shaped, start, 1).acceleration[0] <= 0.15);
    CHECK(peaksOf(shaped, start, 1).acceleration[1] <= 0.4);
    // But it does start at once.
    CHECK(peaksOf(shaped, start, 30).acceleration[0] > 0.9);
  }
}

TEST_CASE("the peak accelerations are those of the log, within the plant's speed limits", "[shaping]")
{
  vpServoRunSpec spec = specOf("ff-lookat-pi", "B", 1.5);
  const vpServoRun raw = runServoExperiment(spec);
  CHECK(raw.metrics.peak_linear_acceleration_mps2 == Approx(peaksOf(raw).acceleration[0]));
  CHECK(raw.metrics.peak_angular_acceleration_radps2 == Approx(peaksOf(raw).acceleration[1]));
  spec.shape = gentle();
  const vpServoRun shaped = runServoExperiment(spec);
  CHECK(shaped.metrics.peak_linear_acceleration_mps2 == Approx(peaksOf(shaped).acceleration[0]));
  CHECK(shaped.metrics.peak_angular_acceleration_radps2 == Approx(peaksOf(shaped).acceleration[1]));

  // Made up: a step from rest, a turn of direction, a command beyond the speed limit.
  spec.plant.loopRate = spec.plant.visionRate = 10.;
  std::vector<vpServoSample> log(4);
  log[0].commanded = vpTwist(0.3, 0., 0.4, 0., 0.2, 0.);
  log[1].commanded = vpTwist(0.3, 0., 0.4, 0., -0.2, 0.);
  log[2].commanded = vpTwist(0., 0., 8., 0., 0., 0.); // the plant's limit is 1 m/s
  log[3].commanded = vpTwist(0., 0., 9., 0., 0., 0.);
  vpServoMetrics m = evaluateServoRun(spec, log);
  CHECK(m.peak_linear_acceleration_mps2 == Approx(10. * std::hypot(0.3, 0.6)));
  CHECK(m.peak_angular_acceleration_radps2 == Approx(4.));
  log.resize(1);
  m = evaluateServoRun(spec, log);
  CHECK(m.peak_linear_acceleration_mps2 == Approx(5.)); // from rest
  CHECK(m.peak_angular_acceleration_radps2 == Approx(2.));
}

TEST_CASE("a shaper that limits nothing changes nothing, bit for bit", "[shaping]")
{
  for (const char *plant : {"A", "D"}) {
    for (const char *law : {"pbvs1", "kyrki-decoupled+cbf", "ff-lookat-pi"}) {
      vpServoRunSpec spec = specOf(law, plant, 1.5);
      const vpServoRun raw = runServoExperiment(spec);
      vpTwistShaperLimits limits;
      limits.linearAcceleration = limits.angularAcceleration = 1e9;
      limits.linearJerk = limits.angularJerk = std::numeric_limits<double>::infinity();
      spec.shape = limits;
      CAPTURE(plant, law);
      CHECK(sameMotion(raw, runServoExperiment(spec)));
      spec.shape = gentle();
      CHECK_FALSE(sameMotion(raw, runServoExperiment(spec)));
    }
  }
}

TEST_CASE("a shaped run ends where the raw one ends, a little later", "[shaping]")
{
  for (const char *plant : {"A", "B"}) {
    for (const char *law : {"pbvs1", "kyrki", "ff-lookat-pi"}) {
      vpServoRunSpec spec = specOf(law, plant, 8.);
      const vpServoMetrics raw = runServoExperiment(spec).metrics;
      spec.shape = gentle();
      const vpServoMetrics shaped = runServoExperiment(spec).metrics;
      CAPTURE(plant, law);
      CHECK(shaped.status == "ok");
      CHECK(shaped.end_rotation_deg == Approx(raw.end_rotation_deg).margin(0.05));
      CHECK(shaped.end_translation_mm == Approx(raw.end_translation_mm).margin(0.2));
      CHECK(shaped.settle_s >= raw.settle_s);
      CHECK(shaped.settle_s < raw.settle_s + 0.25);
      CHECK(shaped.max_image_error_px < raw.max_image_error_px + 15.);
    }
  }
}

TEST_CASE("shaped speeds stay at the plant's limits", "[shaping]")
{
  // The raw twist asks for more than the plant can, so the ramp ends at the limit and stays there without a kink.
  vpServoRunSpec spec = specOf("pbvs1", "A", 3.);
  spec.plant.maxLinear = 0.1;
  spec.plant.maxAngular = 0.15;
  CHECK(peaksOf(runServoExperiment(spec)).speed[1] > 0.4);
  spec.shape = gentle();
  const vpServoRun run = runServoExperiment(spec);
  const Peaks shaped = peaksOf(run);
  CHECK(shaped.speed[0] <= 0.1 * 1.001);
  CHECK(shaped.speed[1] <= 0.15 * 1.001);
  CHECK(run.metrics.peak_linear_acceleration_mps2 <= 1. * (1. + 1e-9));
  CHECK(run.metrics.peak_angular_acceleration_radps2 <= 2.5 * (1. + 1e-9));
}

TEST_CASE("the view filter stands before the shaper, which weakens its promise", "[shaping]")
{
  // The filter's twist is safe if executed at once; the motion that the shaper carries over is not.
  vpServoRunSpec spec = specOf("ibvs", "A", 4.);
  spec.task.initial = vpHomogeneousMatrix(-0.12, 0.04, 0.6, 0., 0., 0.);
  spec.task.segments = {{"rolled", vpHomogeneousMatrix(-0.12, -0.04, 0.5, 0., 0., 1.5), 4.}};
  const auto outOfView = [&spec]() { return runServoExperiment(spec).metrics.out_of_view_s; };
  CHECK(outOfView() > 2.);
  spec.law = "ibvs+cbf";
  CHECK(outOfView() == 0.);
  spec.shape = vpTwistShaperLimits{1., 10., 0.5, 5., true}; // turns too slowly for its translation
  CHECK(outOfView() > 0.5);
  // A robot ten times as fast nearly fulfils the filter's assumption.
  spec.shape->linearAcceleration = 10.;
  spec.shape->linearJerk = 1000.;
  spec.shape->angularAcceleration = 25.;
  spec.shape->angularJerk = 2500.;
  CHECK(outOfView() == 0.);
}

TEST_CASE("a bad limit of the shaper is refused before the run starts", "[shaping]")
{
  vpServoRunSpec spec = specOf("pbvs1", "A", 1.);
  vpTwistShaperLimits limits;
  limits.angularAcceleration = -2.;
  spec.shape = limits;
  bool started = false;
  CHECK_THROWS_WITH(runServoExperiment(spec, [&started](double) { return started = true; }),
                    Catch::Contains("angularAcceleration of the twist shaper is -2 rad/s^2, must be 1e-06..1e+09"));
  CHECK_FALSE(started);
}
