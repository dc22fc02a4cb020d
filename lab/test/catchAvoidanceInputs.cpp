/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What a method gets, and when: frames, goals, objects that move, appear and vanish, noisy poses.
#include "vpCatch.h"
#include "vpMethodsOfTests.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>

#include <cmath>

using namespace vpMethodsOfTests;

namespace
{
vpCollisionSceneSpec twoObjects()
{
  vpCollisionSceneSpec spec;
  spec.objects = {movingBall({0.5, 0.3, 0.4}, {0., 0., 0.}).object, movingBall({-0.4, 0.2, 0.3}, {0., 0., 0.}).object};
  spec.objects[1].name = "other";
  spec.objects[1].shape = vpCollisionShape::box({0.1, 0.2, 0.3});
  spec.objects[1].pose.R = vpSO3::exp({0.3, -0.8, 1.1});
  return spec;
}
} // namespace

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

TEST_CASE("A moving goal is updated at its own rate", "[avoidance-experiment]")
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
  CHECK(runAvoidanceExperiment(spec).metrics.success); // at the end the goal has no noise
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

TEST_CASE("The velocity of an obstacle is the derivative of its place, to and fro", "[moving-obstacle]")
{
  auto rng = vpTestSupport::generator(31);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 50; ++problem) {
    vpMovingObstacle o = movingBall({0.1, 0.2, 0.3}, Vector3d(uniform(rng, -1., 1.), uniform(rng, -1., 1.), 0.3));
    const Vector3d v(o.object.velocity[0], o.object.velocity[1], o.object.velocity[2]);
    o.turnTime = uniform(rng, 0.05, 0.3);
    o.turnAfter = problem % 5 == 0 ? 0. : o.turnTime + uniform(rng, 0.01, 1.);
    CAPTURE(problem, o.turnTime, o.turnAfter);
    vpRigidTransform pose, next;
    vpTwist velocity;
    double farthest = 0.;
    for (double t = 0.; t < 4.; t += 0.0137) {
      constexpr double h = 1e-6;
      o.stateAt(t + 0.5 * h, pose, velocity);
      const Vector3d told(velocity[0], velocity[1], velocity[2]);
      o.stateAt(t, pose, velocity);
      o.stateAt(t + h, next, velocity);
      REQUIRE(((next.p - pose.p) / h - told).norm() < 1e-4);
      REQUIRE(told.norm() <= v.norm() * (1. + 1e-12)); // what bounds on its motion rely on
      farthest = std::max(farthest, (pose.p - o.object.pose.p).norm());
    }
    o.stateAt(0., pose, velocity);
    CHECK((pose.p - o.object.pose.p).norm() < 1e-12);
    CHECK(velocity[0] == Approx(v.x()));
    if (o.turnAfter > 0.) {
      o.stateAt(2. * o.turnAfter, pose, velocity);
      CHECK((pose.p - o.object.pose.p).norm() < 1e-12);
      CHECK(farthest <= v.norm() * (o.turnAfter - 0.5 * o.turnTime) + 1e-12);
    }
    else {
      CHECK(farthest == Approx(v.norm() * 4.).epsilon(0.01));
    }
  }
}

TEST_CASE("The noise of a pose sensor is what it tells", "[pose-sensor]")
{
  CAPTURE(vpTestSupport::seed());
  const vpCollisionScene scene(amor(), twoObjects());
  vpPoseSensorSpec spec;
  spec.positionNoise = 0.003;
  spec.angleNoise = 0.02;
  vpPoseSensor sensor({"ball", "other"}, spec, vpTestSupport::seed());
  vpCollisionData data;
  scene.place(amor().home(), data);
  std::vector<vpObjectSighting> seen;
  Vector3d shift = Vector3d::Zero(), shiftSquares = shift, turnSquares = shift;
  constexpr int frames = 4000;
  for (int i = 0; i < frames; ++i) {
    sensor.look(scene, data, 0.1 * i, seen);
    REQUIRE(seen.size() == 2);
    CHECK(seen[1].name == "other");
    CHECK(seen[1].time == 0.1 * i);
    CHECK(seen[1].shape.type() == vpShapeType::Box);
    const Vector3d off = seen[1].pose.p - scene.object(1).pose.p;
    const Vector3d turn = vpSO3::log(scene.object(1).pose.R.transpose() * seen[1].pose.R);
    shift += off / frames;
    shiftSquares += off.cwiseAbs2() / frames;
    turnSquares += turn.cwiseAbs2() / frames;
  }
  for (int k = 0; k < 3; ++k) {
    CHECK(std::fabs(shift(k)) < 5. * 0.003 / std::sqrt(frames));
    CHECK(std::sqrt(shiftSquares(k)) == Approx(0.003).epsilon(0.06));
    CHECK(std::sqrt(turnSquares(k)) == Approx(0.02).epsilon(0.06));
  }
  CHECK(seen[1].positionSigma == 0.003);
  CHECK(seen[1].angleSigma == 0.02);
}

TEST_CASE("A pose sensor sees what is in range, and misses some of it", "[pose-sensor]")
{
  const vpCollisionScene scene(amor(), twoObjects());
  vpCollisionData data;
  scene.place(amor().home(), data);
  std::vector<vpObjectSighting> seen;
  vpPoseSensorSpec spec;
  spec.viewpoint = Vector3d(0.5, 0.3, 0.9);
  spec.range = 0.6; // the other is 1.09 m away
  vpPoseSensor near({"ball", "other", "nothing"}, spec, 1);
  near.look(scene, data, 0., seen);
  REQUIRE(seen.size() == 1);
  CHECK(seen[0].name == "ball");
  const Vector3d first = seen[0].pose.p;

  spec.range = 2.;
  vpPoseSensor far({"ball", "other"}, spec, 1);
  far.look(scene, data, 0., seen);
  REQUIRE(seen.size() == 2);
  CHECK(seen[0].pose.p == first); // the noise of objects is independent

  // From the hand the distance is that of the camera.
  spec.viewpoint.reset();
  const Vector3d camera = vpArmKinematics::camera(amor(), data.arm).p;
  for (const double more : {-1e-6, 1e-6}) {
    spec.range = (camera - scene.object(0).pose.p).norm() + more;
    vpPoseSensor inHand({"ball"}, spec, 1);
    inHand.look(scene, data, 0., seen);
    CHECK(seen.size() == (more > 0. ? 1U : 0U));
  }

  spec.range = 2.;
  spec.missed = 0.3;
  vpPoseSensor poor({"ball"}, spec, 5);
  int count = 0;
  for (int i = 0; i < 2000; ++i) {
    poor.look(scene, data, 0., seen);
    count += static_cast<int>(seen.size());
  }
  CHECK(count == Approx(1400).margin(5. * std::sqrt(2000 * 0.3 * 0.7)));
  spec.missed = 1.2;
  CHECK_THROWS_WITH(vpPoseSensor({"ball"}, spec, 1), Catch::Contains("missed of the pose sensor is 1.2, must be 0..1"));
}
