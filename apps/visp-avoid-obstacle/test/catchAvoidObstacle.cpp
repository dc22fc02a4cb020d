/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The parts of the program: replicas against independently computed values, and the findings of a run.
#include "vpCatch.h"

#include "planeMotion.h"
#include "results.h"

#include <array>
#include <cmath>
#include <set>

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
using namespace avoidObstacle;

//! Quintic from a state to rest at \e goal in T, and its derivative: textbook formulas, not the module's.
struct Quintic {
  Quintic(double q, double v, double a, double goal, double T)
  {
    const double h = goal - q;
    c = {q,
         v,
         a / 2.,
         (20. * h - 12. * v * T - 3. * a * T * T) / (2. * std::pow(T, 3)),
         (-30. * h + 16. * v * T + 3. * a * T * T) / (2. * std::pow(T, 4)),
         (12. * h - 6. * v * T - a * T * T) / (2. * std::pow(T, 5))};
  }
  [[nodiscard]] double speed(double t) const
  {
    double sum = 0.;
    for (int k = 5; k >= 1; --k) {
      sum = sum * t + k * c[static_cast<std::size_t>(k)];
    }
    return sum;
  }
  std::array<double, 6> c{};
};

double peakSpeed(const Quintic &x, const Quintic &y, double T)
{
  double peak = 0.;
  for (int i = 0; i <= 4000; ++i) {
    peak = std::max(peak, std::hypot(x.speed(T * i / 4000.), y.speed(T * i / 4000.)));
  }
  return peak;
}

Options replica(const std::string &name)
{
  Options options;
  options.replica = name;
  return options;
}

PointTask figure87()
{
  PointTask task;
  task.goal = {0., 0.3};
  task.maxSpeed = 0.5;
  task.events = {{0.1, {0.2, 0.3}, std::nullopt}};
  task.duration = 0.;
  return task;
}
} // namespace

TEST_CASE("Figure 8.7: the bound is kept at any time and the arrival is the earliest", "[visp-avoid-obstacle]")
{
  const PointMotion motion = follow(figure87());
  REQUIRE(motion.arrived);
  CHECK((motion.samples.back().place - Vector2d(0.2, 0.3)).norm() < 1e-9);
  CHECK(motion.peakSpeed <= 0.5 * (1. + 1e-9));
  CHECK(motion.peakSpeed > 0.4999); // limited by the bound
  CHECK(motion.jump < 0.05);        // the acceleration does not jump
  CHECK(motion.plans == 2);

  // Independent computation: minimum jerk over 15/8 h/v until 0.1 s, then the shortest quintic whose speed stays below
  // the bound.
  const double T1 = 15. / 8. * 0.3 / 0.5, s = 0.1 / T1;
  const double q = 0.3 * s * s * s * (10. - 15. * s + 6. * s * s), v = 0.3 / T1 * 30. * s * s * (1. - s) * (1. - s),
               a = 0.3 / (T1 * T1) * 60. * s * (1. - s) * (1. - 2. * s);
  double low = 0.5, high = 3.;
  for (int i = 0; i < 60; ++i) {
    const double T = 0.5 * (low + high);
    const bool fits = peakSpeed(Quintic(0., 0., 0., 0.2, T), Quintic(q, v, a, 0.3, T), T) <= 0.5;
    (fits ? high : low) = T;
  }
  CHECK(motion.arrival == Approx(0.1 + high).margin(2e-3));
  const PointSample &atEvent = motion.samples[100];
  CHECK(atEvent.place.y() == Approx(q).margin(1e-9));
  CHECK(atEvent.velocity.y() == Approx(v).margin(1e-9));
}

TEST_CASE("Any interruption keeps the bound and arrives", "[visp-avoid-obstacle]")
{
  auto rng = vpTestSupport::generator(861);
  CAPTURE(vpTestSupport::seed());
  std::uniform_real_distribution<double> place(-0.4, 0.4), when(0.01, 1.), chance(0., 1.);
  for (int problem = 0; problem < 60; ++problem) {
    PointTask task = figure87();
    task.events = {{when(rng), {place(rng), place(rng)}, std::nullopt}};
    if (chance(rng) < 0.5) {
      task.events[0].via = Vector2d(place(rng), place(rng));
    }
    const PointMotion motion = follow(task);
    CAPTURE(problem, task.events[0].time);
    CHECK(motion.arrived);
    CHECK((motion.samples.back().place - task.events[0].goal).norm() < 1e-9);
    CHECK(motion.peakSpeed <= 0.5 * (1. + 1e-9));
    double least = HUGE_VAL;
    for (std::size_t i = 1; i < motion.samples.size(); ++i) {
      const PointSample &b = motion.samples[i], &a = motion.samples[i - 1];
      CHECK((b.place - a.place).norm() <= 0.5 * pointPeriod * (1. + 1e-9)); // no position is skipped
      least = task.events[0].via ? std::min(least, (b.place - *task.events[0].via).norm()) : 0.;
    }
    CHECK(least < 1e-3);
  }
}

TEST_CASE("Figure 8.6: where it comes to rest is where both velocities cancel", "[visp-avoid-obstacle]")
{
  const FieldTask task;
  for (const vpFieldWeightSpec &field : {strictField(), mildField()}) {
    const FieldMotion motion = followField(task, field);
    // (8.1) and (8.2) again: (1 - w) gain e = w speed, at the distance 0.12 + e.
    double low = 0., high = 0.3;
    for (int i = 0; i < 80; ++i) {
      const double e = 0.5 * (low + high), d = 0.12 + e;
      const double w =
          field.height * (std::tanh((d + field.centre) / field.width) - std::tanh((d - field.centre) / field.width));
      ((1. - w) * task.gain * e < w * task.avoidSpeed ? low : high) = e;
    }
    CHECK(motion.way.back().x() == Approx(low).margin(1e-4));
    CHECK(motion.way.back().y() == Approx(0.45).margin(1e-4)); // not affected
  }
  const FieldMotion alone = followField(task, strictField(), false);
  for (const double missed : alone.missed) {
    CHECK(missed < 2e-3);
  }
  CHECK(followField(task, strictField()).missed.back() > 0.02);
  CHECK(followField(task, mildField()).missed.back() < 0.005);
}

TEST_CASE("Every replica agrees with what the thesis tells, but for what is known to differ", "[visp-avoid-obstacle]")
{
  // The drives overshoot the bounded command; the field does not reach all vias.
  const std::set<std::pair<std::string, std::string>> differing = {{"fig8.8", "speed"},
                                                                   {"fig8.10", "speed"},
                                                                   {"fig8.11", "speed"},
                                                                   {"fig8.12", "speed"},
                                                                   {"fig8.6", "strict: vias reached"},
                                                                   {"fig8.6", "mild: vias reached"}};
  for (const std::string &name : replicaNames()) {
    CAPTURE(name);
    const Replica result = playReplica(replica(name));
    CHECK(result.name == name);
    CHECK_FALSE(result.findings.empty());
    CHECK_FALSE(result.choices.empty());
    CHECK_FALSE(result.tables.empty());
    for (const Comparison &c : result.comparisons) {
      CAPTURE(c.what, c.thesis, c.ours);
      CHECK(c.agrees == (differing.count({name, c.what}) == 0));
    }
  }
}

TEST_CASE("Figure 8.13: the acceleration is bounded whatever the noise", "[visp-avoid-obstacle]")
{
  for (unsigned int seed = 1; seed <= 10; ++seed) {
    Options options = replica("fig8.13");
    options.seed = seed;
    const Replica result = playReplica(options);
    CAPTURE(seed);
    CHECK(result.numbers.at("arrived").get<bool>());
    CHECK(result.numbers.at("peak_a").get<double>() <= 1. + 1e-9);
    CHECK(result.numbers.at("peak_a").get<double>() > 0.9);
    const auto end = result.numbers.at("end_m").get<std::vector<double>>();
    CHECK(std::hypot(end[0] - 0.14, end[1] - 0.04) < 1e-6);
  }
}

TEST_CASE("Figures 8.8 and 8.10: the arm keeps all limits", "[visp-avoid-obstacle]")
{
  for (const char *name : {"fig8.8", "fig8.10"}) {
    const nlohmann::ordered_json metrics = playReplica(replica(name)).numbers.at("metrics");
    CAPTURE(name);
    CHECK(metrics.at("success").get<bool>());
    CHECK(metrics.at("peak_v").get<double>() <= 0.5 * (1. + 1e-6));
    CHECK(metrics.at("peak_v").get<double>() > 0.45);
    CHECK(metrics.at("joint_v_violations").get<int>() == 0);
    CHECK(metrics.at("joint_a_violations").get<int>() == 0);
    CHECK(metrics.at("min_clearance_m").get<double>() > 0.);
    CHECK(metrics.at("goal_error_m").get<double>() < 0.005); // PD with gravity, as in section 8.2.3
  }
}

TEST_CASE("Figure 8.10 with the image sensor: the change comes when the box is seen", "[visp-avoid-obstacle]")
{
  for (const char *name : {"fig8.10"}) {
    const nlohmann::ordered_json seen = playSeenArmReplica(replica(name));
    CAPTURE(name, seen.dump());
    // Another motion than that with the clock of the figure.
    const double changed = seen.at("appears_s").get<double>() + seen.at("seen_after_s").get<double>();
    CHECK(std::fabs(changed - 0.95) > 0.04);
    CHECK(seen.at("metrics").at("goal_error_m") != playReplica(replica(name)).numbers.at("metrics").at("goal_error_m"));
    REQUIRE(seen.at("seen").get<bool>());
    CHECK(seen.at("seen_after_s").get<double>() >= 0.05); // the latency
    CHECK(seen.at("seen_after_s").get<double>() < 0.3);
    CHECK(seen.at("metrics").at("success").get<bool>());
    CHECK(seen.at("metrics").at("peak_v").get<double>() <= 0.5 * (1. + 1e-6));
    CHECK(seen.at("metrics").at("collisions_moving").get<int>() == 0);
  }
  Options late = replica("fig8.8");
  late.latency = 60.; // longer than the motion: the change does not come by itself
  CHECK_FALSE(playSeenArmReplica(late).at("seen").get<bool>());
}

TEST_CASE("Figure 8.6 by the arm and its camera: strict parameters miss the end, mild ones come nearer",
          "[visp-avoid-obstacle]")
{
  const nlohmann::ordered_json seen = playSeenFieldReplica(replica("fig8.6"));
  CAPTURE(seen.dump());
  for (std::size_t i = 1; i < 3; ++i) {
    CHECK(seen.at("mild").at("missed_m").at(i).get<double>() < seen.at("strict").at("missed_m").at(i).get<double>());
  }
  CHECK_FALSE(seen.at("strict").at("end_reached").get<bool>());
  CHECK(seen.at("mild").at("collisions_moving").get<int>() == 0);
}

TEST_CASE("Rates are differences from rest", "[visp-avoid-obstacle]")
{
  const std::vector<Vector3d> places = {{0., 0., 0.}, {0.01, 0., 0.}, {0.01, 0.02, 0.}, {0.01, 0.02, 0.}};
  const vpApp::Rates rates = vpApp::ratesOf(places, 0.1);
  CHECK(rates.speed[0] == 0.);
  CHECK(rates.speed[1] == Approx(0.1));
  CHECK(rates.speed[2] == Approx(0.2));
  CHECK(rates.acceleration[1] == Approx(1.));
  CHECK(rates.acceleration[2] == Approx(std::hypot(0.1, 0.2) / 0.1));
  CHECK(rates.acceleration[3] == Approx(2.));
}

TEST_CASE("What was seen when, from a sensorLog", "[visp-avoid-obstacle]")
{
  PhotoScene scene;
  scene.obstacles.resize(2);
  scene.obstacles[0].object.name = "a";
  scene.obstacles[1].object.name = "b";
  Episode episode;
  const bool seen[] = {false, true, true, false, false, true, false};
  const double errors[] = {0., 0.004, 0.001, 0., 0., 0.002, 0.};
  for (int i = 0; i < 7; ++i) {
    Frame frame;
    frame.time = 0.1 * i;
    frame.sights.resize(2);
    frame.sights[0].object = "a";
    frame.sights[0].seen = seen[i];
    frame.sights[0].error = errors[i];
    frame.sights[0].sigma = 0.003;
    frame.sights[1].object = "b";
    episode.sensorLog.frames.push_back(frame);
    if (i >= 2) {
      TrackRow row;
      row.time = frame.time;
      row.track.name = "a";
      row.track.inflation = 0.005;
      row.error = i == 4 ? 0.006 : 0.001;
      episode.sensorLog.tracks.push_back(row);
    }
  }
  const std::vector<SightingSummary> all = sightingSummaries(scene, episode);
  REQUIRE(all.size() == 2);
  CHECK(all[0].frames == 7);
  CHECK(all[0].seen == 3);
  CHECK(all[0].firstSeen.value() == Approx(0.1));
  CHECK(all[0].known.value() == Approx(0.2));
  CHECK(all[0].lastSeen.value() == Approx(0.5));
  CHECK(all[0].lost.value() == Approx(0.6));
  CHECK(all[0].gap == Approx(0.3));
  CHECK(all[0].medianError == Approx(0.002));
  CHECK(all[0].worstError == Approx(0.004));
  CHECK(all[0].worstTrackError == Approx(0.006));
  CHECK(all[0].leastMargin == Approx(-0.001));
  CHECK_FALSE(all[1].firstSeen.has_value());
  CHECK_FALSE(all[1].known.has_value());
  CHECK(all[1].seen == 0);
}

TEST_CASE("Turns leave out what lasts less than 50 ms", "[visp-avoid-obstacle]")
{
  using S = vpAvoidanceStatus;
  vpAvoidanceRun run;
  const auto add = [&](double until, S status) {
    for (double t = run.samples.empty() ? 0. : run.samples.back().time + 0.005; t < until - 1e-9; t += 0.005) {
      vpAvoidanceSample s;
      s.time = t;
      s.status = status;
      run.samples.push_back(s);
    }
  };
  add(0.2, S::Moving);
  add(0.21, S::Slowed);
  add(0.5, S::Moving);
  add(0.8, S::Detouring);
  add(1., S::Arrived);
  const std::vector<StatusChange> turns = statusChangesOf(run);
  REQUIRE(turns.size() == 3);
  CHECK(turns[0].status == S::Moving);
  CHECK(turns[1].status == S::Detouring);
  CHECK(turns[1].time == Approx(0.5));
  CHECK(turns[2].status == S::Arrived);
  CHECK(turns[2].time == Approx(0.8));
}
