/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The scenes meet their conditions: neither trivial nor infeasible, and the same on every machine.
#include "vpCatch.h"
#include "vpMethodsOfTests.h"

#include <visp3/core/vpException.h>
#include "lab/avoidance/vpAvoidanceScenes.h"
#include "lab/avoidance/vpSceneFrame.h"

#include <cmath>
#include <iostream>

using namespace vpMethodsOfTests;
using namespace vpAvoidanceScenes;

namespace
{
std::shared_ptr<const vpArmModel> arm()
{
  static const auto model = std::make_shared<const vpArmModel>(amor());
  return model;
}

//! Least clearance of the straight motion at a number of positions, obstacles at time 0.
double straightClearance(const vpAvoidanceRunSpec &run, int places)
{
  vpCollisionScene scene(*run.arm, run.scene);
  for (const vpMovingObstacle &o : run.obstacles) {
    scene.add(o.object);
  }
  vpCollisionData data;
  double least = 1.;
  for (int i = 0; i <= places; ++i) {
    scene.place(run.start + static_cast<double>(i) / places * (run.goal.q - run.start), data);
    least = std::min(least, scene.clearance(data).distance);
  }
  return least;
}

double clearanceAt(const vpAvoidanceRunSpec &run, const vpJointVector &q)
{
  vpAvoidanceRunSpec there = run;
  there.start = there.goal.q = q;
  return straightClearance(there, 1);
}

vpAvoidanceMetrics drive(vpAvoidanceRunSpec run, double waiting, double duration)
{
  BlindMethod::Spec blind;
  blind.duration = duration;
  blind.stopFrom = 0.;
  blind.stopTo = waiting;
  run.makeMethod = sledgeRun(0., 0., blind).makeMethod;
  return runAvoidanceExperiment(run).metrics;
}

//! All numbers of a scenario.
std::vector<double> flat(const vpAvoidanceScenario &s)
{
  std::vector<double> n(s.run.start.data(), s.run.start.data() + s.run.start.size());
  n.insert(n.end(), s.run.goal.q.data(), s.run.goal.q.data() + s.run.goal.q.size());
  const auto add = [&n](const vpCollisionObject &o) {
    n.insert(n.end(), o.pose.p.data(), o.pose.p.data() + 3);
    n.insert(n.end(), o.pose.R.data(), o.pose.R.data() + 9);
    n.insert(n.end(), {o.shape.radius(), o.shape.length(), o.shape.size().x(), o.velocity[0], o.velocity[1]});
  };
  for (const vpCollisionObject &o : s.run.scene.objects) {
    add(o);
  }
  for (const vpMovingObstacle &o : s.run.obstacles) {
    add(o.object);
    n.push_back(o.appears);
  }
  return n;
}
} // namespace

TEST_CASE("Random static scenes: ends free, the straight motion not", "[avoidance-scenes]")
{
  int draws = 0, objects = 0;
  std::vector<int> kinds(4, 0);
  for (unsigned int seed = 1; seed <= 15; ++seed) {
    const vpAvoidanceScenario s = randomStatic(arm(), seed);
    CAPTURE(seed, s.draws);
    CHECK(clearanceAt(s.run, s.run.start) > feasibleMargin);
    CHECK(clearanceAt(s.run, s.run.goal.q) > feasibleMargin);
    CHECK(straightClearance(s.run, 3000) < 1e-3);
    CHECK(s.run.scene.objects.size() >= 3);
    CHECK(s.run.scene.objects.size() <= 10);
    CHECK(s.run.obstacles.empty());
    for (const vpCollisionObject &o : s.run.scene.objects) {
      ++kinds[static_cast<std::size_t>(o.shape.type())];
    }
    draws += s.draws;
    objects += static_cast<int>(s.run.scene.objects.size());
    CHECK(flat(s) == flat(randomStatic(arm(), seed)));
  }
  CHECK(flat(randomStatic(arm(), 1)) != flat(randomStatic(arm(), 2)));
  for (const int kind : kinds) {
    CHECK(kind > 0);
  }
  std::cout << "15 random static scenes of " << objects / 15. << " objects on average, " << draws / 15.
            << " draws each\n";
}

TEST_CASE("Crossing obstacles hit who takes no notice, and not who waits", "[avoidance-scenes]")
{
  for (unsigned int seed = 1; seed <= 5; ++seed) {
    vpCrossingSpec spec;
    spec.speed = 0.1 * (1 + seed % 5);
    const vpAvoidanceScenario s = crossing(arm(), seed, spec);
    const vpJointVector way = (s.run.goal.q - s.run.start).cwiseAbs();
    const double going = (way.array() / (0.5 * arm()->velocity().array())).maxCoeff();
    CAPTURE(seed, s.draws, going);
    // Least jerk goes slower at the ends than the constant speed of the condition: no certainty, but most are hit.
    static int hit = 0;
    hit += drive(s.run, 0., going).collisions_moving > 0 ? 1 : 0;
    const vpAvoidanceMetrics waited = drive(s.run, 20., 1.9 * going);
    CAPTURE(waited.status);
    CHECK(waited.success);
    CHECK(waited.collisions_standing == 0);
    CHECK(waited.min_clearance_m >= feasibleMargin - 5e-3); // the conditions look every 10 ms
    CHECK(s.run.obstacles.size() == 2);
    CHECK(s.run.obstacles[0].object.velocity.linearNorm() == Approx(spec.speed));
    CHECK(flat(s) == flat(crossing(arm(), seed, spec)));
    if (seed == 5) {
      CHECK(hit >= 3);
    }
  }
}

TEST_CASE("The scenes of the thesis", "[avoidance-scenes]")
{
  for (unsigned int seed = 1; seed <= 10; ++seed) {
    const vpAvoidanceScenario s = figure88(arm(), seed);
    CAPTURE(seed, s.draws);
    const auto tool = [](const vpJointVector &q) { return vpAvoidanceGoal::at(*arm(), q).position; };
    CHECK((tool(s.run.start) - Vector3d(0.05, 0.63, 0.35)).norm() < 1e-8);
    CHECK((s.run.goal.position - Vector3d(0.05, 0.93, 0.35)).norm() < 1e-8);
    REQUIRE(s.run.goalMoves.size() == 1);
    CHECK((s.run.goalMoves[0].to.position - Vector3d(0.225, 0.93, 0.35)).norm() < 1e-8);
    CHECK(clearanceAt(s.run, s.run.start) > feasibleMargin);
    CHECK(clearanceAt(s.run, s.run.goalMoves[0].to.q) > feasibleMargin);
    CHECK(s.run.obstacles[0].appears == s.run.goalMoves[0].begin);
  }
  const vpAvoidanceScenario moving = movingGoal(arm(), 1);
  CHECK(drive(moving.run, 0., 2.5).success); // nothing is in the way
  CHECK((moving.run.goalMoves.back().to.position - Vector3d(0.19, 0.67, 0.35)).norm() < 1e-8);

  const vpCollisionSceneFile file = vpLoadCollisionScene(std::string(VISP_DIRECT_DATA_DIR) + "/scene/s4b-shelf.json");
  const vpAvoidanceScenario shelf = fromTask(arm(), file, 1, 7);
  CHECK(shelf.name == "S4b shelf, lower to upper");
  CHECK(shelf.run.methodSpec.seed == 7);
  CHECK(straightClearance(shelf.run, 2000) < 0.);
  CHECK_THROWS_WITH(fromTask(arm(), file, 2, 1), Catch::Contains("scene S4b shelf has 2 tasks, there is no number 2"));
  CHECK_THROWS_WITH(fromTask(sledge(), file, 0, 1),
                    Catch::Contains("task right to left of scene S4b shelf is for 7 joints, arm sledge has 1"));
  CHECK_THROWS_WITH(randomStatic(nullptr, 1), Catch::Contains("the scene has no arm"));
  CHECK_THROWS_WITH(figure88(sledge(), 1),
                    Catch::Contains("scene S1: arm sledge is free and reaches all goals from none of"));
}

namespace
{
//! AMOR with all lengths times a factor, on a stand.
std::shared_ptr<const vpArmModel> resized(double factor, const Eigen::Vector3d &stand)
{
  vpArmSpec spec = amor().spec();
  for (vpArmJointSpec &joint : spec.joints) {
    joint.before.p *= factor;
    joint.after.p *= factor;
  }
  spec.joints.front().before.p += stand;
  spec.tool.p *= factor;
  spec.links.clear();
  for (vpArmCapsule &capsule : spec.capsules) {
    capsule.from *= factor;
    capsule.to *= factor;
    capsule.radius *= factor;
  }
  return std::make_shared<const vpArmModel>(spec);
}
} // namespace

TEST_CASE("Scenes are fitted to the arm", "[scenes]")
{
  const vpSceneFrame own = vpSceneFrame::of(amor());
  CHECK(own.scale == 1.);
  CHECK(own.ground == 0.);
  CHECK(own.centre.norm() == 0.);
  CHECK(own.reach > 0.95);
  CHECK(own.reach < 1.1);
  CHECK(own.place({0.3, 0.2, 0.1}) == Eigen::Vector3d(0.3, 0.2, 0.1));
  std::mt19937_64 rng = vpTestSupport::generator(77);
  for (int i = 0; i < 5; ++i) {
    const double factor = uniform(rng, 0.4, 0.5);
    const Eigen::Vector3d stand(uniform(rng, -0.5, 0.5), uniform(rng, -0.5, 0.5), uniform(rng, -0.2, -0.1));
    const auto small = resized(factor, stand);
    const vpSceneFrame frame = vpSceneFrame::of(*small);
    CAPTURE(factor, stand.transpose());
    CHECK(std::fabs(frame.reach - factor * own.reach) < 1e-9);
    CHECK(std::fabs(frame.scale - frame.reach / 1.1) < 1e-12);
    CHECK((frame.centre - stand).norm() < 1e-12);
    CHECK(frame.ground < stand.z());
    const unsigned int seed = 1 + static_cast<unsigned int>(i);
    for (const vpAvoidanceScenario &s : {randomStatic(small, seed), movingGoal(small, seed)}) {
      CAPTURE(s.name);
      CHECK(clearanceAt(s.run, s.run.start) > 0.);
      CHECK(clearanceAt(s.run, s.run.goal.q) > 0.);
      CHECK((s.run.goal.position - stand).norm() < 2. * frame.reach);
    }
  }
}

TEST_CASE("Bodies that the user ignores are ignored in all scenes", "[scenes]")
{
  vpArmSpec spec = amor().spec();
  spec.bodies = {{"cable", 7}};
  spec.uncovered = {"cable"};
  const auto with = std::make_shared<const vpArmModel>(spec);
  for (const vpAvoidanceScenario &s :
       {figure88(with, 1), randomStatic(with, 1), crossing(with, 1), movingGoal(with, 1)}) {
    CAPTURE(s.name);
    CHECK(s.run.scene.ignoredBodies == spec.uncovered);
    CHECK_NOTHROW(vpCollisionScene(*with, s.run.scene));
  }
}
