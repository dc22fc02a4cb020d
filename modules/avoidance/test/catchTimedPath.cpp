/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Trajectories in time: those reported free are free at every instant, and the joint limits are kept.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpTimedPath.h>
#include <visp3/core/vpException.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
vpCollisionSceneSpec randomScene(std::mt19937_64 &rng, bool moving)
{
  vpCollisionSceneSpec spec;
  const int count = 3 + static_cast<int>(rng() % 5);
  for (int k = 0; k < count; ++k) {
    vpCollisionObject object;
    object.name = "object " + std::to_string(k);
    const double size = uniform(rng, 0.04, 0.2);
    object.shape = k % 3 == 0   ? vpCollisionShape::sphere(size)
                   : k % 3 == 1 ? vpCollisionShape::box({size, 0.3, 0.6 * size})
                                : vpCollisionShape::capsule(0.5 * size, 0.4);
    object.pose = pose(rng, 0.9);
    if (moving) {
      const Vector3d v = point(rng, 0.3), w = point(rng, 1.);
      object.velocity = vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
    }
    spec.objects.push_back(object);
  }
  return spec;
}

//! From one random state to another, or through vias.
vpTrajectoryPlan randomPlan(std::mt19937_64 &rng)
{
  vpTrajectoryInput<Eigen::Dynamic> input(7);
  input.start.q = configuration(amor(), rng);
  input.goal.q = input.start.q + uniform(rng, 0.1, 0.6) * (configuration(amor(), rng) - input.start.q);
  for (int i = 0; i < 7; ++i) {
    input.start.v(i) = uniform(rng, -0.4, 0.4);
  }
  input.maxVelocity = amor().velocity();
  input.maxAcceleration = amor().acceleration();
  vpTrajectoryPlan plan(7);
  REQUIRE(vpDirectTrajectory<Eigen::Dynamic>::calculate(input, plan).isGood());
  return plan;
}

//! The extrapolated objects, for the reference.
vpCollisionSceneSpec at(const vpCollisionSceneSpec &spec, double time)
{
  vpCollisionSceneSpec later = spec;
  for (vpCollisionObject &object : later.objects) {
    object.pose = object.poseAt(time);
  }
  return later;
}

vpJointVector placeOf(const vpTrajectoryPlan &plan, double t)
{
  vpJointVector q(plan.axes());
  for (int j = 0; j < plan.axes(); ++j) {
    q(j) = plan.at(j, t)[0];
  }
  return q;
}
} // namespace

TEST_CASE("A trajectory that is called free is free at every instant, with obstacles that move", "[trajectory]")
{
  auto rng = vpTestSupport::generator(911);
  CAPTURE(vpTestSupport::seed());
  int free = 0, collisions = 0, undecided = 0;
  long looks = 0;
  for (int problem = 0; problem < 600; ++problem) {
    const bool moving = problem % 2 == 1;
    const vpCollisionSceneSpec spec = randomScene(rng, moving);
    const vpCollisionScene scene(amor(), spec);
    const vpTrajectoryPlan plan = randomPlan(rng);
    const double age = moving ? uniform(rng, 0., 0.3) : 0.;
    vpCertifiedTrajectory certificate(scene, {problem % 3 == 0 ? 0.01 : 0., 1e-4});
    const double margin = problem % 3 == 0 ? 0.01 : 0.;
    const vpTrajectoryClearance verdict = certificate.check(plan, 0., plan.duration(), age);
    CAPTURE(problem, plan.duration(), verdict.time);
    looks += verdict.evaluated;
    if (verdict.isFree()) {
      ++free;
      for (int i = 0; i <= 300; ++i) {
        const double t = plan.duration() * i / 300.;
        const vpCollisionSceneSpec then = at(spec, t + age);
        const IndependentClearance oracle(amor(), then);
        REQUIRE(oracle.clearance(placeOf(plan, t), scene.selfPairs(), margin + 0.01) >= margin - 1e-9);
      }
    }
    else if (verdict.status == vpMotionStatus::Collision) {
      ++collisions;
      const vpCollisionSceneSpec then = at(spec, verdict.time + age);
      const IndependentClearance oracle(amor(), then);
      REQUIRE(oracle.clearance(placeOf(plan, verdict.time), scene.selfPairs(), 1.) <= margin + 3e-4);
      for (int i = 0; i < 100 && verdict.time > 0.; ++i) { // the first place: all before is free
        const double t = verdict.time * i / 100.;
        const vpCollisionSceneSpec earlier = at(spec, t + age);
        const IndependentClearance before(amor(), earlier);
        REQUIRE(before.clearance(placeOf(plan, t), scene.selfPairs(), margin + 0.01) >= margin - 1e-9);
      }
      REQUIRE(verdict.pair.kind != vpCollisionKind::None);
    }
    else {
      REQUIRE(verdict.status == vpMotionStatus::Undecided);
      ++undecided;
    }
  }
  std::cout << free << " free, " << collisions << " collide, " << undecided << " undecided; " << looks / 600
            << " configurations looked at on average\n";
  CHECK(free > 100);
  CHECK(collisions > 100);
  CHECK(undecided < 30);
}

TEST_CASE("Timed paths keep limits, ends and freedom", "[path]")
{
  int rests = 0, motions = 0;
  for (const char *name : {"scene/s4a-pillar.json", "scene/s4b-shelf.json"}) {
    const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile(name));
    const vpCollisionScene scene(amor(), file.spec);
    for (unsigned int seed = 1; seed <= 4; ++seed) {
      for (const vpMotionTask &task : file.tasks) {
        vpPathPlannerSpec how;
        how.seed = seed;
        vpPathPlanner planner(scene, how);
        const vpPathResult found = planner.plan(task.start, task.goal);
        REQUIRE(found.status == vpPathStatus::Solved);
        vpTimedPathSpec spec;
        spec.margin = 0.8 * how.margin;
        const vpTimedPath timed(scene, found.path, spec);
        CAPTURE(name, seed, task.name, timed.message(scene));
        REQUIRE(timed.isFree());
        const IndependentClearance oracle(amor(), file.spec);
        vpJointVector q(7);
        const int places = 3000;
        for (int i = 0; i <= places; ++i) {
          const double t = timed.duration() * i / places;
          for (int j = 0; j < 7; ++j) {
            const vpAxisState x = timed.at(j, t);
            q(j) = x[0];
            REQUIRE(std::fabs(x[1]) <= amor().velocity()(j) * (1. + 1e-9));
            REQUIRE(std::fabs(x[2]) <= amor().acceleration()(j) * (1. + 1e-9));
          }
          REQUIRE(oracle.clearance(q, scene.selfPairs(), 0.05) >= spec.margin - 1e-9);
        }
        REQUIRE((q - found.path.points.back()).norm() < 1e-9);
        for (const vpTimedPath::Part &part : timed.parts()) {
          for (int j = 0; j < 7; ++j) {
            REQUIRE(part.plan.at(j, 0.)[1] == Approx(0.).margin(1e-9));
            REQUIRE(part.plan.at(j, part.plan.duration())[1] == Approx(0.).margin(1e-9));
          }
        }
        rests += static_cast<int>(timed.parts().size()) - 1;
        ++motions;
      }
    }
  }
  std::cout << motions << " timed paths, " << rests << " rests on the way in all\n";
}

TEST_CASE("A straight motion is timed as a straight line, and a path through an obstacle is not called free", "[path]")
{
  auto rng = vpTestSupport::generator(912);
  CAPTURE(vpTestSupport::seed());
  vpCollisionScene scene(amor());
  for (int problem = 0; problem < 50; ++problem) {
    vpJointPath path;
    path.points = {configuration(amor(), rng), configuration(amor(), rng)};
    const vpTimedPath timed(scene, path);
    const vpJointVector way = path.points[1] - path.points[0];
    for (double t = 0.; t < timed.duration(); t += 0.05) {
      vpJointVector q(7);
      for (int j = 0; j < 7; ++j) {
        q(j) = timed.at(j, t)[0];
      }
      const double share = (q - path.points[0]).dot(way) / way.squaredNorm();
      REQUIRE((q - path.points[0] - share * way).norm() < 1e-9);
    }
  }
  vpJointVector start(7);
  start << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
  vpJointPath path;
  path.points = {start, start}; // a motion of none
  const vpTimedPath still(scene, path);
  CHECK(still.duration() == 0.);
  CHECK(still.isFree());
  CHECK(still.at(3, 1.)[0] == start(3));
  path.points[1](0) += 1.;
  vpArmData data;
  vpArmKinematics::forward(amor(), 0.5 * (path.points[0] + path.points[1]), data);
  vpCollisionObject ball;
  ball.name = "ball";
  ball.pose = data.tool;
  scene.add(ball);
  const vpTimedPath blocked(scene, path);
  CHECK_FALSE(blocked.isFree());
  CHECK(blocked.message(scene).find("ball") != std::string::npos);
  CHECK(blocked.clearance().time < 0.5 * blocked.duration());

  vpTimedPathSpec spec;
  spec.speed = 0.;
  CHECK_THROWS_WITH(vpTimedPath(scene, path, spec), Catch::Contains("speed of the timed path is 0, must be > 0"));
  CHECK_THROWS_WITH(vpTimedPath(scene, vpJointPath()), Catch::Contains("has no points"));
  path.points[0] = vpJointVector::Zero(3);
  CHECK_THROWS_WITH(vpTimedPath(scene, path), Catch::Contains("has 3 numbers, must have 7"));
  CHECK_THROWS_WITH(vpCertifiedTrajectory(scene, {-1., 1e-4}),
                    Catch::Contains("margin of the certified trajectory is -1 m"));
}

TEST_CASE("Obstacles move on while the arm is under way, behind a rest too", "[path]")
{
  // There and back by the base, with a rest in between, since both paths coincide. A ball crosses the position where
  // the tool rests: too early, at that time, and when the arm is back.
  vpJointVector start(7);
  start << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
  vpJointVector out = start;
  out(0) += 1.2;
  vpJointPath path;
  path.points = {start, out, start};
  vpArmData data;
  vpArmKinematics::forward(amor(), out, data);
  vpCollisionScene empty(amor());
  const vpTimedPath alone(empty, path);
  const double turn = 0.5 * alone.duration();
  for (const double late : {-1.2, 0., 2.}) {
    vpCollisionSceneSpec spec;
    vpCollisionObject ball;
    ball.name = "ball";
    ball.velocity = vpTwist(0., 0., 1., 0., 0., 0.);
    ball.pose.p = data.tool.p - Vector3d(0., 0., turn + late);
    spec.objects.push_back(ball);
    const vpCollisionScene scene(amor(), spec);
    const vpTimedPath timed(scene, path);
    bool touches = false;
    for (double t = 0.; t < timed.duration(); t += 0.002) {
      vpJointVector q(7);
      for (int j = 0; j < 7; ++j) {
        q(j) = timed.at(j, t)[0];
      }
      const vpCollisionSceneSpec then = at(spec, t);
      touches = touches || IndependentClearance(amor(), then).clearance(q, scene.selfPairs(), 0.1) < 0.;
    }
    CAPTURE(late, timed.parts().size(), timed.message(scene));
    CHECK(timed.isFree() == !touches);
    CHECK(touches == (late == 0.));
  }
}

TEST_CASE("Parts behind a rest meet obstacles where they are by then", "[path]")
{
  auto rng = vpTestSupport::generator(914);
  CAPTURE(vpTestSupport::seed());
  int withRests = 0;
  for (int problem = 0; problem < 600; ++problem) {
    const vpCollisionSceneSpec spec = randomScene(rng, true);
    const vpCollisionScene scene(amor(), spec);
    vpJointPath path;
    path.points = {configuration(amor(), rng)};
    for (int k = 0; k < 2; ++k) {
      path.points.push_back(path.points.back() + 0.4 * (configuration(amor(), rng) - path.points.back()));
    }
    const vpTimedPath timed(scene, path);
    if (timed.parts().size() < 2 || !timed.isFree()) {
      continue;
    }
    ++withRests;
    CAPTURE(problem, timed.duration());
    for (int i = 0; i <= 300; ++i) {
      const double t = timed.duration() * i / 300.;
      vpJointVector q(7);
      for (int j = 0; j < 7; ++j) {
        q(j) = timed.at(j, t)[0];
      }
      const vpCollisionSceneSpec then = at(spec, t);
      REQUIRE(IndependentClearance(amor(), then).clearance(q, scene.selfPairs(), 0.01) >= -1e-9);
    }
  }
  std::cout << withRests << " paths with a rest are free among moving obstacles\n";
  CHECK(withRests > 5);
}

TEST_CASE("A path is taken up from a moving state, smoothly and within the limits", "[path]")
{
  auto rng = vpTestSupport::generator(915);
  CAPTURE(vpTestSupport::seed());
  int free = 0;
  for (int problem = 0; problem < 200; ++problem) {
    const vpCollisionSceneSpec spec = randomScene(rng, problem % 2 == 0);
    const vpCollisionScene scene(amor(), spec);
    vpJointPath path;
    path.points = {configuration(amor(), rng, 0.1)};
    for (int k = 0; k < 2; ++k) {
      path.points.push_back(path.points.back() + 0.4 * (configuration(amor(), rng, 0.1) - path.points.back()));
    }
    vpTimedPathSpec timing;
    timing.startVelocity = 0.5 * amor().velocity().cwiseProduct(vpTestArms::randomVector(7, rng));
    timing.startAcceleration = 0.3 * amor().acceleration().cwiseProduct(vpTestArms::randomVector(7, rng));
    vpCertifiedTrajectory certificate(scene);
    const vpTimedPath timed(scene, path, timing, certificate);
    if (!timed.isFree()) {
      continue;
    }
    ++free;
    CAPTURE(problem);
    for (int j = 0; j < 7; ++j) {
      REQUIRE(timed.at(j, 0.)[0] == Approx(path.points[0](j)));
      REQUIRE(timed.at(j, 0.)[1] == Approx(timing.startVelocity(j)).margin(1e-9));
      REQUIRE(timed.at(j, timed.duration())[0] == Approx(path.points[2](j)).margin(1e-9));
      double before = timing.startVelocity(j);
      for (int i = 1; i <= 400; ++i) {
        const vpAxisState x = timed.at(j, timed.duration() * i / 400.);
        REQUIRE(std::fabs(x[1]) <= amor().velocity()(j) * (1. + 1e-9));
        REQUIRE(std::fabs(x[2]) <= amor().acceleration()(j) * (1. + 1e-9));
        REQUIRE(std::fabs(x[1] - before) <= amor().acceleration()(j) * timed.duration() / 400. * (1. + 1e-6) + 1e-9);
        before = x[1];
      }
    }
    for (int i = 0; i <= 200; ++i) {
      const double t = timed.duration() * i / 200.;
      vpJointVector q(7);
      for (int j = 0; j < 7; ++j) {
        q(j) = timed.at(j, t)[0];
      }
      const vpCollisionSceneSpec then = at(spec, t);
      REQUIRE(IndependentClearance(amor(), then).clearance(q, scene.selfPairs(), 0.01) >= -1e-9);
    }
  }
  std::cout << free << " of 200 paths are free from a moving state\n";
  CHECK(free > 50);
}

TEST_CASE("The tool keeps its bounds along a timed path", "[path]")
{
  auto rng = vpTestSupport::generator(916);
  CAPTURE(vpTestSupport::seed());
  const vpCollisionScene scene(amor());
  vpTimedPathSpec timing;
  timing.toolVelocity = 0.5;
  timing.toolAcceleration = 1.;
  int bound = 0;
  for (int problem = 0; problem < 60; ++problem) {
    vpJointPath path;
    path.points = {configuration(amor(), rng, 0.1), configuration(amor(), rng, 0.1), configuration(amor(), rng, 0.1)};
    const vpTimedPath kept(scene, path, timing), quick(scene, path);
    if (!kept.isFree() || !quick.isFree()) {
      continue;
    }
    const auto place = [&](double t) {
      vpJointVector q(7);
      for (int j = 0; j < 7; ++j) {
        q(j) = kept.at(j, t)[0];
      }
      vpArmData data;
      vpArmKinematics::forward(amor(), q, data);
      return data.tool.p;
    };
    constexpr double dt = 1e-3;
    double v = 0., a = 0.;
    for (double t = dt; t < kept.duration(); t += dt) {
      v = std::max(v, (place(t + 0.5 * dt) - place(t - 0.5 * dt)).norm() / dt);
      a = std::max(a, (place(t + dt) - 2. * place(t) + place(t - dt)).norm() / (dt * dt));
    }
    CAPTURE(problem, kept.duration(), quick.duration());
    CHECK(v <= 0.5 * 1.001);
    CHECK(a <= 1. * 1.01);
    CHECK(kept.duration() >= quick.duration() - 1e-9);
    bound += v > 0.48 || a > 0.95 ? 1 : 0; // not slower than it must be
  }
  CHECK(bound > 10);
  timing.toolVelocity = 0.;
  vpJointPath still;
  still.points = {amor().home()};
  CHECK_THROWS_WITH(vpTimedPath(scene, still, timing), Catch::Contains("toolVelocity of the timed path is 0"));
  timing = {};
  timing.startVelocity = vpJointVector::Zero(2);
  CHECK_THROWS_WITH(vpTimedPath(scene, still, timing),
                    Catch::Contains("velocity at the start of the timed path has 2"));
}

TEST_CASE("The quick verdict is that of the whole check", "[trajectory]")
{
  auto rng = vpTestSupport::generator(917);
  CAPTURE(vpTestSupport::seed());
  int free = 0;
  for (int problem = 0; problem < 300; ++problem) {
    const vpCollisionScene scene(amor(), randomScene(rng, problem % 2 == 0));
    vpCertifiedTrajectory certificate(scene);
    const vpTrajectoryPlan plan = randomPlan(rng);
    const vpTrajectoryClearance whole = certificate.check(plan);
    const vpTrajectoryClearance quick = certificate.verdict(plan, 0., plan.duration());
    REQUIRE(whole.isFree() == quick.isFree());
    REQUIRE(quick.evaluated <= whole.evaluated);
    REQUIRE((quick.isFree() || quick.time >= whole.time - 1e-9));
    free += whole.isFree() ? 1 : 0;
  }
  CHECK(free > 30);
  CHECK(free < 270);
}

TEST_CASE("The check of a trajectory does not allocate and refuses nonsense", "[trajectory]")
{
  auto rng = vpTestSupport::generator(913);
  const vpCollisionScene scene(amor(), randomScene(rng, true));
  vpCertifiedTrajectory certificate(scene);
  const vpTrajectoryPlan plan = randomPlan(rng);
  static_cast<void>(certificate.check(plan));
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 5; ++k) {
    static_cast<void>(certificate.check(plan, 0., plan.duration(), 0.1 * k));
  }
  CHECK(vpTestSupport::allocationCount() == before);
  CHECK(certificate.check(vpTrajectoryPlan(3)).status == vpMotionStatus::BadInput);
  CHECK(certificate.check(plan, 1., 0.).status == vpMotionStatus::BadInput);
  CHECK(certificate.check(plan, 0., NAN).status == vpMotionStatus::BadInput);
}
