/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Inputs of a method and their times: frames, goals, objects that appear and vanish.
#include "vpCatch.h"
#include "vpMethodsOfTests.h"

#include <cmath>

using namespace vpMethodsOfTests;

TEST_CASE("What appears is there from then on, and goes when it vanishes", "[avoidance-experiment]")
{
  auto diary = std::make_shared<BlindMethod::Diary>();
  vpAvoidanceRunSpec spec = sledgeRun(0., 0.5, {}, diary);
  spec.obstacles.push_back(movingBall({0.25, 0., 0.}, {0., 0., 0.}));
  spec.obstacles.front().appears = 0.3;
  spec.obstacles.front().vanishes = 0.6; // the sledge is 10 cm away then
  const vpAvoidanceRun run = runAvoidanceExperiment(spec);
  CHECK(run.metrics.success);
  for (const vpAvoidanceSample &s : run.samples) {
    CHECK((s.clearance.kind == vpCollisionKind::Object) == (s.time >= 0.3 - 1e-9 && s.time < 0.6 - 1e-9));
    CHECK((s.nearest == "ball") == (s.clearance.kind == vpCollisionKind::Object));
  }
  for (std::size_t i = 0; i < diary->seenAt.size(); ++i) { // seen with the first frame from then on
    const double t = 0.005 * static_cast<double>(i);
    CHECK(std::isfinite(diary->seenAt[i]) == (t >= 0.3 - 1e-9 && t < 0.6 - 1e-9));
  }
}

TEST_CASE("Frames come at their rate, after their latency, and not while the camera is covered",
          "[avoidance-experiment]")
{
  struct Watcher : vpObstacleSensor {
    explicit Watcher(std::shared_ptr<std::vector<double>> exposures) : times(std::move(exposures)) {}
    void look(const vpCollisionScene &, const vpCollisionData &, double time,
              std::vector<vpObjectSighting> &result) override
    {
      times->push_back(time);
      result.clear();
    }
    std::shared_ptr<std::vector<double>> times;
  };
  auto diary = std::make_shared<BlindMethod::Diary>();
  auto exposures = std::make_shared<std::vector<double>>();
  vpAvoidanceRunSpec spec = sledgeRun(0., 0.5, {}, diary);
  spec.sight = vpObstacleSight::Custom;
  spec.makeSensor = [exposures](unsigned int) { return std::make_unique<Watcher>(exposures); };
  spec.visionRate = 20.;
  spec.latency = 0.03;
  spec.covered = {{0.42, 0.81}};
  const vpAvoidanceRun run = runAvoidanceExperiment(spec);
  REQUIRE(exposures->size() > 20);
  int frame = 0;
  for (const double time : *exposures) {
    frame = frame == 9 ? 17 : frame; // 0.45 .. 0.80 s are covered
    CHECK(time == Approx(0.05 * frame).margin(1e-9));
    ++frame;
  }
  REQUIRE(diary->looks.size() + 1 >= exposures->size());
  for (std::size_t i = 0; i < diary->looks.size(); ++i) {
    CHECK(0.005 * diary->looks[i] == Approx((*exposures)[i] + 0.03).margin(1e-9));
  }
  CHECK(run.lookTimes.size() == diary->looks.size());
}

TEST_CASE("A goal that moves is told at its rate", "[avoidance-experiment]")
{
  auto diary = std::make_shared<BlindMethod::Diary>();
  vpAvoidanceRunSpec spec = sledgeRun(0., 0.5, {}, diary);
  spec.goalMoves = {{0.5, 0.9, vpAvoidanceGoal::at(*spec.arm, at(0.9))},
                    {1.2, 1.2, vpAvoidanceGoal::at(*spec.arm, at(0.7))}};
  const vpAvoidanceRun run = runAvoidanceExperiment(spec);
  CHECK(run.metrics.success);
  REQUIRE(diary->goals.size() >= 60);
  for (std::size_t i = 0; i < diary->goals.size(); ++i) {
    const double t = 0.02 * static_cast<double>(i + 1); // the first one came with start()
    const double x = t < 0.5 ? 0.5 : t < 0.9 ? 0.5 + t - 0.5 : t < 1.2 - 1e-9 ? 0.9 : 0.7;
    CHECK(diary->goals[i].position.x() == Approx(x).margin(1e-9));
    CHECK(diary->goals[i].q(0) == Approx(x).margin(1e-9));
  }

  auto noisy = std::make_shared<BlindMethod::Diary>();
  spec.goalNoise = 0.01;
  spec.makeMethod = sledgeRun(0., 0.5, {}, noisy).makeMethod;
  CHECK(runAvoidanceExperiment(spec).metrics.success); // in the end the goal is told without noise
  double squares = 0.;
  for (std::size_t i = 0; i < 59; ++i) {
    squares += std::pow(noisy->goals[i].position.y(), 2);
  }
  CHECK(std::sqrt(squares / 59) == Approx(0.01).epsilon(0.4));
  CHECK(noisy->goals.back().position.y() == 0.);
}

TEST_CASE("Through sensor, latency and tracks the method sees an obstacle about where it is", "[avoidance-experiment]")
{
  auto diary = std::make_shared<BlindMethod::Diary>();
  vpAvoidanceRunSpec spec = sledgeRun(0., 0.3, {}, diary);
  spec.goalMoves = {{3., 3., spec.goal}};
  spec.sight = vpObstacleSight::Poses;
  spec.latency = 0.1;
  spec.covered = {{1.5, 1.8}};
  spec.obstacles.push_back(movingBall({-0.6, 0.5, 0.}, {0.3, 0., 0.}));
  static_cast<void>(runAvoidanceExperiment(spec));
  REQUIRE(diary->seenAt.size() > 600);
  for (std::size_t i = 0; i < diary->seenAt.size(); ++i) {
    const double t = 0.005 * static_cast<double>(i), truth = -0.6 + 0.3 * t;
    CAPTURE(t, truth);
    CHECK(std::isfinite(diary->seenAt[i]) == (t > 0.1 - 1e-9));
    // Without the velocity it would be seen 30 mm behind, and 90 mm while the camera is covered.
    if (t > 1.) {
      CHECK(diary->seenAt[i] == Approx(truth).margin(t > 1.6 && t < 2. ? 0.02 : 0.01));
    }
  }
  auto other = std::make_shared<BlindMethod::Diary>();
  spec.makeMethod = sledgeRun(0., 0.3, {}, other).makeMethod;
  static_cast<void>(runAvoidanceExperiment(spec));
  const std::size_t first = 25; // NaN before
  CHECK((std::vector<double>(diary->seenAt.begin() + first, diary->seenAt.end()) ==
         std::vector<double>(other->seenAt.begin() + first, other->seenAt.end())));
}
