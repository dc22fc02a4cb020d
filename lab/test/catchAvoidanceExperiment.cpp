/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The loop of avoidance against closed forms: a sledge that is driven by a known polynomial past balls.
#include "vpCatch.h"
#include "vpMethodsOfTests.h"

#include <visp3/core/vpException.h>

#include <cmath>

using namespace vpMethodsOfTests;

namespace
{
std::string messageOf(vpAvoidanceRunSpec spec)
{
  try {
    static_cast<void>(runAvoidanceExperiment(spec));
  }
  catch (const vpException &e) {
    return e.getStringMessage();
  }
  return "no error";
}

double minimumJerk(double t, double duration)
{
  const double s = std::min(1., t / duration);
  return s * s * s * (10. - 15. * s + 6. * s * s);
}
} // namespace

TEST_CASE("The figures of a straight motion are those of its polynomial", "[avoidance-experiment]")
{
  for (const double T : {1.5, 4.}) {
    BlindMethod::Spec blind;
    blind.duration = T;
    vpAvoidanceRunSpec spec = sledgeRun(-0.2, 0.6, blind);
    spec.methodSpec.period = 0.002;
    const double h = 0.8;
    const vpAvoidanceRun run = runAvoidanceExperiment(spec);
    const vpAvoidanceMetrics &m = run.metrics;
    CAPTURE(T, m.status);
    CHECK(m.success);
    CHECK(m.goal_error_m < 1e-12);
    CHECK(m.peak_v == Approx(15. / 8. * h / T).epsilon(2e-3));
    CHECK(m.peak_a == Approx(10. / std::sqrt(3.) * h / (T * T)).epsilon(5e-3));
    CHECK(m.peak_jerk == Approx(60. * h / (T * T * T)).epsilon(2e-2)); // at the ends, where differences are late
    CHECK(m.jerk_integral == Approx(720. * h * h / std::pow(T, 5)).epsilon(1e-2));
    CHECK(m.path_length == Approx(h).epsilon(1e-9));
    CHECK(m.duration_s < T);
    CHECK(m.duration_s > 0.9 * T);
    CHECK(run.samples.back().time - m.duration_s == Approx(0.2).margin(0.01));
    CHECK(m.min_clearance_m == 1.); // nothing is there
    const bool tooFast = 15. / 8. * h / T > 0.5, tooHard = 10. / std::sqrt(3.) * h / (T * T) > 1.;
    CHECK((m.tool_v_violations > 0) == tooFast);
    CHECK((m.tool_a_violations > 0) == tooHard);
    CHECK(m.joint_v_violations == 0);
    CHECK(m.joint_a_violations == 0);
  }
}

TEST_CASE("The limits of the joints are those of the arm", "[avoidance-experiment]")
{
  BlindMethod::Spec blind;
  blind.duration = 0.8; // 3 m: 7 m/s, 27 m/s^2
  const vpAvoidanceRun run = runAvoidanceExperiment(sledgeRun(-1., 2., blind));
  int fast = 0;
  for (int i = 0; i < 160; ++i) {
    const double v = 3. * (minimumJerk(0.005 * (i + 1), 0.8) - minimumJerk(0.005 * i, 0.8)) / 0.005;
    fast += v > 2. * (1. + 1e-6) ? 1 : 0;
  }
  CHECK(run.metrics.joint_v_violations == fast);
  CHECK(fast > 50);
  CHECK(run.metrics.joint_a_violations > 20);
}

TEST_CASE("The least clearance is that between the samples, too", "[avoidance-experiment]")
{
  auto rng = vpTestSupport::generator(11);
  CAPTURE(vpTestSupport::seed());
  int touched = 0;
  for (int problem = 0; problem < 60; ++problem) {
    BlindMethod::Spec blind;
    blind.duration = 0.5;
    vpAvoidanceRunSpec spec = sledgeRun(0., 0.8, blind);
    spec.methodSpec.period = 0.05; // up to 15 cm of the arm between two samples
    const Vector3d cross(uniform(rng, 0.2, 0.6), uniform(rng, -0.1, 0.1), 0.);
    const Vector3d velocity(uniform(rng, -1., 1.), uniform(rng, -2., 2.), uniform(rng, -2., 2.));
    const double meets = uniform(rng, 0.1, 0.5);
    spec.obstacles.push_back(movingBall(cross - meets * velocity, velocity));
    if (problem % 3 == 0) {
      spec.obstacles.back().turnAfter = uniform(rng, 0.25, 0.6);
    }
    const vpAvoidanceRun run = runAvoidanceExperiment(spec);

    double least = 1.;
    for (const vpAvoidanceSample &s : run.samples) {
      for (int i = 0; i < 2000 && &s != &run.samples.back(); ++i) { // every 25 us
        const double t = 0.05 / 2000 * i;
        vpRigidTransform pose;
        vpTwist unused;
        spec.obstacles.back().stateAt(s.time + t, pose, unused);
        least = std::min(least, (Vector3d(s.q(0) + t * s.command(0), 0., 0.) - pose.p).norm() - ball - 0.04);
      }
    }
    CAPTURE(problem, least, run.metrics.min_clearance_m);
    CHECK(run.metrics.min_clearance_m <= least + 2e-4);
    CHECK(run.metrics.min_clearance_m >= least - 2e-4);
    if (std::fabs(least) > 3e-4) {
      const int collisions = run.metrics.collisions_moving + run.metrics.collisions_standing;
      CHECK((collisions > 0) == (least < 0.));
      touched += least < 0. ? 1 : 0;
    }
  }
  CHECK(touched > 5);
  CHECK(touched < 55);
}

TEST_CASE("What runs into an arm at rest is counted apart", "[avoidance-experiment]")
{
  // The sledge rests at 0.5 m from 1 s on; the ball hits it from above at 2 s, leaves, and returns.
  BlindMethod::Spec blind;
  blind.duration = 1.;
  vpAvoidanceRunSpec spec = sledgeRun(0., 0.5, blind);
  spec.goalMoves.push_back({8., 8., spec.goal}); // something to stay for
  vpMovingObstacle falling = movingBall({0.5, 0., 1.}, {0., 0., -0.5});
  falling.turnAfter = 2.2;
  spec.obstacles.push_back(falling);
  const vpAvoidanceMetrics standing = runAvoidanceExperiment(spec).metrics;
  CHECK(standing.collisions_standing == 2);
  CHECK(standing.collisions_moving == 0);
  CHECK(standing.success);

  spec.makeMethod = sledgeRun(0., 0.5).makeMethod; // takes 2 s: it still moves a little, or not, when the ball comes
  spec.obstacles.front().object.velocity[2] = -1.; // comes at 1 s
  spec.obstacles.front().object.pose.p.x() = 0.25;
  const vpAvoidanceMetrics moving = runAvoidanceExperiment(spec).metrics;
  CHECK(moving.collisions_moving == 1);
  CHECK_FALSE(moving.success);
  CHECK(moving.status.find("touched something while it moved, 1 times, by ") == 0);
}

TEST_CASE("Who watches the track table gets what the method gets, and changes nothing", "[avoidance-experiment]")
{
  vpAvoidanceRunSpec spec = sledgeRun(0., 0.5, {});
  spec.obstacles.push_back(movingBall({0.25, 0.6, 0.}, {0.1, 0., 0.}));
  spec.sight = vpObstacleSight::Poses;
  spec.visionRate = 20.;
  spec.latency = 0.03;
  const vpAvoidanceRun unwatched = runAvoidanceExperiment(spec);
  std::vector<double> times;
  double known = -1., worst = 0.;
  spec.watchTracks = [&](double time, const std::vector<vpObjectTrack> &tracks) {
    times.push_back(time);
    if (tracks.empty()) {
      return;
    }
    known = known < 0. ? time : known;
    REQUIRE(tracks.size() == 1);
    CHECK(tracks[0].name == "ball");
    if (time > 0.5) {
      worst = std::max(worst, (tracks[0].pose.p - Vector3d(0.25 + 0.1 * time, 0.6, 0.)).norm());
    }
  };
  const vpAvoidanceRun watched = runAvoidanceExperiment(spec);
  CHECK(known == Approx(0.03).margin(1e-9)); // first exposure at 0, then the latency
  CHECK(worst > 0.);
  CHECK(worst < 0.01);                                 // noise of 2 mm
  REQUIRE(times.size() >= watched.samples.size() - 1); // the last row commands nothing
  for (std::size_t i = 0; i < times.size(); ++i) {
    CHECK(times[i] == Approx(0.005 * static_cast<double>(i)).margin(1e-9));
  }
  REQUIRE(watched.samples.size() == unwatched.samples.size());
  for (std::size_t i = 0; i < watched.samples.size(); ++i) {
    CHECK(watched.samples[i].q == unwatched.samples[i].q);
  }
  spec.sight = vpObstacleSight::Exact;
  times.clear();
  static_cast<void>(runAvoidanceExperiment(spec));
  CHECK(times.empty());
}

TEST_CASE("A stop without a reason is a false one", "[avoidance-experiment]")
{
  // At 0.5 s the sledge moves at 0.4 m/s and would be 0.4 m farther on a second later.
  BlindMethod::Spec blind;
  blind.duration = 2.5;
  blind.stopFrom = 1.2;
  blind.stopTo = 1.5;
  const auto run = [&](const std::vector<vpMovingObstacle> &obstacles) {
    vpAvoidanceRunSpec spec = sledgeRun(0., 0.6, blind);
    spec.obstacles = obstacles;
    return runAvoidanceExperiment(spec).metrics;
  };
  CHECK(run({}).stops == 1);
  CHECK(run({}).false_stops == 1);
  CHECK(run({movingBall({0.5, 0., 0.}, {0., 0., 0.})}).false_stops == 0);
  // Beside the way, at a distance of 0.05 + 0.04 + the margin of 10 mm + 20 mm, less or more.
  CHECK(run({movingBall({0.5, 0.119, 0.}, {0., 0., 0.})}).false_stops == 0);
  CHECK(run({movingBall({0.5, 0.121, 0.}, {0., 0., 0.})}).false_stops == 1);
  CHECK(run({movingBall({0.9, 0., 0.}, {0., 0., 0.})}).false_stops == 1); // beyond the goal, and a second
  // Behind it; and one that crosses in time, or so late that a second is over.
  CHECK(run({movingBall({-0.3, 0., 0.}, {0., 0., 0.})}).false_stops == 1);
  CHECK(run({movingBall({0.45, 1.58, 0.}, {0., -1., 0.})}).false_stops == 0);
  CHECK(run({movingBall({0.45, 3.9, 0.}, {0., -1., 0.})}).false_stops == 1);
  // Just started it would be only 0.1 m farther after a second; but the ball is on the straight path to the goal.
  blind.stopFrom = 0.3;
  CHECK(run({}).false_stops == 1);
  CHECK(run({movingBall({0.5, 0., 0.}, {0., 0., 0.})}).false_stops == 0);
}

TEST_CASE("A run in which nothing moves any more ends", "[avoidance-experiment]")
{
  BlindMethod::Spec blind;
  blind.stopFrom = 0.5;
  blind.stopTo = 100.;
  const auto run = [&](const std::vector<vpMovingObstacle> &obstacles) {
    vpAvoidanceRunSpec spec = sledgeRun(0., 0.6, blind);
    spec.obstacles = obstacles;
    const vpAvoidanceRun r = runAvoidanceExperiment(spec);
    CHECK_FALSE(r.metrics.success);
    return r.samples.back().time;
  };
  CHECK(run({}) == Approx(3.5).margin(0.02));
  CHECK(run({movingBall({3., 0., 0.}, {0., 0., 0.})}) == Approx(3.5).margin(0.02));
  CHECK(run({movingBall({3., 0., 0.}, {0., 0.1, 0.})}) == Approx(20.).margin(0.02));
  vpMovingObstacle late = movingBall({3., 0., 0.}, {0., 0., 0.});
  late.appears = 2.;
  CHECK(run({late}) == Approx(5.).margin(0.02));
}

TEST_CASE("The same specification gives the same log, another seed another one", "[avoidance-experiment]")
{
  vpAvoidanceRunSpec spec = sledgeRun(0., 0.5);
  spec.goalMoves = {{0.5, 0.9, vpAvoidanceGoal::at(*spec.arm, at(0.9))}};
  spec.goalNoise = 0.002;
  const auto flat = [](const vpAvoidanceRun &run) {
    std::vector<double> n;
    for (const vpAvoidanceSample &s : run.samples) {
      n.insert(n.end(),
               {s.time, s.q(0), s.commanded(0), s.command(0), s.tool.x(), s.goalDistance, s.clearance.distance});
    }
    return n;
  };
  const std::vector<double> first = flat(runAvoidanceExperiment(spec));
  CHECK((first == flat(runAvoidanceExperiment(spec)))); // in brackets: thousands of numbers are not printed
  spec.seed = 2;
  CHECK((first != flat(runAvoidanceExperiment(spec))));
}

TEST_CASE("Errors name the field and its value", "[avoidance-experiment]")
{
  const vpAvoidanceRunSpec good = sledgeRun(0., 0.5);
  const auto broken = [&](const std::function<void(vpAvoidanceRunSpec &)> &breakIt) {
    vpAvoidanceRunSpec spec = good;
    breakIt(spec);
    return messageOf(spec);
  };
  CHECK(broken([](auto &) {}) == "no error");
  CHECK(broken([](auto &s) { s.arm = nullptr; }) == "the avoidance experiment has no arm");
  CHECK(broken([](auto &s) { s.visionRate = 0.; }) == "visionRate of the avoidance experiment is 0 Hz, must be > 0");
  CHECK(broken([](auto &s) { s.latency = -0.1; }) == "latency of the avoidance experiment is -0.1 s, must be >= 0");
  CHECK(broken([](auto &s) { s.maxDuration = INFINITY; }) ==
        "maxDuration of the avoidance experiment is inf s, must be > 0 and finite");
  CHECK(broken([](auto &s) { s.start = vpJointVector::Zero(3); }) ==
        "the start of the avoidance experiment has 3 numbers, must have 1 finite ones");
  CHECK(broken([](auto &s) { s.goal.position.x() = NAN; }) ==
        "the goal of the avoidance experiment is nan, must be finite");
  CHECK(broken([](auto &s) {
          s.goalMoves = {{1., 0.5, s.goal}};
        }) == "end of a goal's move of the avoidance experiment is 0.5 s, must be >= 1");
  CHECK(broken([](auto &s) { s.sight = vpObstacleSight::Custom; }) ==
        "makeSensor of the avoidance experiment is empty, a custom sensor needs it");
  CHECK(broken([](auto &s) {
          s.obstacles.push_back(movingBall({1., 0., 0.}, {0., 0., 0.}));
          s.obstacles.back().turnAfter = 0.1;
        }) == "turnAfter of obstacle ball is 0.1, must be 0 or > turnTime, and finite");
}
