/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A planned motion with an obstacle appearing on its path: replanning from rest and on the fly.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpPlannedMotion.h>
#include <visp3/core/vpException.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
constexpr double period = 0.005;

//! Result of a motion in which a ball appeared on the remaining path.
struct Outcome {
  bool appeared = false, arrived = false, stood = false, unsafe = false, hard = false; // hard: beyond the tool's bounds
  double time = 0., least = 1., velocity = 0., acceleration = 0.; // of the tool, largest while it keeps its bounds
};

//! Differences of the commanded tool positions.
class ToolMotion
{
public:
  explicit ToolMotion(const vpJointVector &q) : m_p(at(q)) {}

  void step(const vpJointVector &q, bool stopping, Outcome &outcome)
  {
    const Eigen::Vector3d p = at(q), v = (p - m_p) / period;
    if (!stopping && !m_stopping) {
      outcome.velocity = std::max(outcome.velocity, v.norm());
      outcome.acceleration = std::max(outcome.acceleration, (v - m_v).norm() / period);
    }
    outcome.hard = outcome.hard || stopping;
    m_p = p;
    m_v = v;
    m_stopping = stopping;
  }

private:
  static Eigen::Vector3d at(const vpJointVector &q)
  {
    vpArmData data;
    vpArmKinematics::forward(amor(), q, data);
    return data.tool.p;
  }
  Eigen::Vector3d m_p, m_v = Eigen::Vector3d::Zero();
  bool m_stopping = false;
};

Outcome withSurprise(vpReplanning replanning, std::uint64_t problem)
{
  auto rng = vpTestSupport::generator(9900 + problem);
  Outcome result;
  vpCollisionScene scene(amor());
  vpPlannedMotionSpec spec;
  spec.replanning = replanning;
  vpPlannedMotion method(scene, spec);
  const vpJointVector start = configuration(amor(), rng, 0.1), goal = configuration(amor(), rng, 0.1);
  vpCollisionData data;
  scene.place(start, data);
  const bool free = !scene.inCollision(data, 0.03);
  scene.place(goal, data);
  if (!free || scene.inCollision(data, 0.03) ||
      method.start(start, vpAvoidanceGoal::at(amor(), goal)) == vpAvoidanceStatus::Waiting) {
    return result;
  }
  const double share = uniform(rng, 0.2, 0.4), soon = 0.35;
  vpAvoidanceOutput output;
  vpJointVector q = start;
  ToolMotion tool(start);
  vpCollisionSceneSpec objects;
  for (int k = 0; k < 16000 && !result.arrived; ++k) {
    if (!result.appeared && method.clock() > share * method.duration()) {
      // Where the tool would be two thirds of the way, unless the arm is too near to it already, or the goal is.
      vpJointVector later(7);
      for (int j = 0; j < 7; ++j) {
        later(j) = method.at(j, method.clock() + soon * method.duration())[0];
      }
      vpArmData there;
      vpArmKinematics::forward(amor(), later, there);
      vpCollisionObject ball;
      ball.name = "surprise";
      ball.shape = vpCollisionShape::sphere(0.05);
      ball.pose.p = there.tool.p;
      objects.objects.push_back(ball);
      const IndependentClearance clearance(amor(), objects);
      if (clearance.clearance(q, scene.selfPairs(), 0.3) < 0.2 ||
          clearance.clearance(goal, scene.selfPairs(), 0.3) < 0.05) {
        return result;
      }
      scene.add(ball);
      result.appeared = true;
    }
    if (k % 7 == 0) {
      method.look();
    }
    method.step(q, output);
    q += period * output.velocity;
    tool.step(q, output.stopping, result);
    result.time += period;
    result.arrived = output.status == vpAvoidanceStatus::Arrived;
    result.unsafe = result.unsafe || output.status == vpAvoidanceStatus::Unsafe;
    if (result.appeared && !result.arrived) {
      result.stood = result.stood || output.velocity.norm() == 0.;
      result.least = std::min(result.least, IndependentClearance(amor(), objects).clearance(q, scene.selfPairs(), 0.1));
    }
  }
  return result;
}
} // namespace

TEST_CASE("Something appears on the way: both ways of replanning keep clear; on the fly is sooner there", "[planned]")
{
  CAPTURE(vpTestSupport::seed());
  int cases = 0, arrivedFromRest = 0, arrivedOnTheFly = 0, stoodFromRest = 0, stoodOnTheFly = 0, hard = 0;
  double timeFromRest = 0., timeOnTheFly = 0.;
  for (std::uint64_t problem = 0; problem < 20; ++problem) {
    const Outcome rest = withSurprise(vpReplanning::FromRest, problem);
    const Outcome fly = withSurprise(vpReplanning::OnTheFly, problem);
    if (!rest.appeared || !fly.appeared) {
      continue;
    }
    CAPTURE(problem);
    ++cases;
    for (const Outcome &outcome : {rest, fly}) {
      CHECK_FALSE(outcome.unsafe);
      CHECK(outcome.least > 0.0095);
      CHECK(outcome.velocity <= 1.001 * vpAvoidanceMethodSpec().maxVelocity);
      CHECK(outcome.acceleration <= 1.02 * vpAvoidanceMethodSpec().maxAcceleration); // by differences over a period
      hard += outcome.hard ? 1 : 0;
    }
    arrivedFromRest += rest.arrived ? 1 : 0;
    arrivedOnTheFly += fly.arrived ? 1 : 0;
    stoodFromRest += rest.stood ? 1 : 0;
    stoodOnTheFly += fly.stood ? 1 : 0;
    timeFromRest += rest.time;
    timeOnTheFly += fly.time;
  }
  std::cout << cases << " surprises: from rest " << stoodFromRest << " stand, " << timeFromRest / cases
            << " s; on the fly " << stoodOnTheFly << " stand, " << timeOnTheFly / cases << " s; " << hard
            << " stops beyond the bounds of the tool\n";
  REQUIRE(cases > 8);
  CHECK(arrivedFromRest >= cases - 1); // within 80 s: a detour has no bound
  CHECK(arrivedOnTheFly >= cases - 1);
  CHECK(stoodOnTheFly < stoodFromRest);
  CHECK(timeOnTheFly < timeFromRest);
  CHECK(hard <= cases / 4); // what appears is a third of the motion ahead: there is room to stop within the bounds
}

TEST_CASE("Within the margin of what was just seen, the arm stops within the bounds of the tool and touches nothing",
          "[planned]")
{
  CAPTURE(vpTestSupport::seed());
  int cases = 0, hard = 0;
  for (std::uint64_t problem = 0; problem < 60 && cases < 12; ++problem) {
    CAPTURE(problem);
    auto rng = vpTestSupport::generator(9700 + problem);
    vpCollisionScene scene(amor());
    vpPlannedMotion method(scene);
    const vpJointVector start = configuration(amor(), rng, 0.1), goal = configuration(amor(), rng, 0.1);
    vpCollisionData data;
    scene.place(start, data);
    const bool free = !scene.inCollision(data, 0.03);
    scene.place(goal, data);
    if (!free || scene.inCollision(data, 0.03) ||
        method.start(start, vpAvoidanceGoal::at(amor(), goal)) == vpAvoidanceStatus::Waiting) {
      continue;
    }
    vpAvoidanceOutput output;
    vpJointVector q = start;
    ToolMotion tool(start);
    Outcome outcome;
    const auto step = [&] {
      method.step(q, output);
      q += period * output.velocity;
      tool.step(q, output.stopping, outcome);
    };
    while (method.clock() < 0.5 * method.duration()) {
      step();
    }
    // A ball beside the tool's way, 5 mm from the arm, whose margin is 10 mm.
    vpArmData here;
    vpArmKinematics::update(amor(), q, here);
    const Eigen::Vector3d velocity = here.J.topRows<3>() * output.velocity;
    Eigen::Vector3d aside = velocity.cross(Eigen::Vector3d(uniform(rng, -1., 1.), uniform(rng, -1., 1.), 1.));
    aside.normalize();
    vpCollisionSceneSpec objects;
    objects.objects.resize(1);
    objects.objects[0].name = "ball";
    objects.objects[0].shape = vpCollisionShape::sphere(0.03);
    double distance = 0.4, clearance = 0.;
    for (int k = 0; k < 50; ++k) {
      objects.objects[0].pose.p = here.tool.p + distance * aside;
      clearance = IndependentClearance(amor(), objects).clearance(q, {}, 1.);
      distance -= clearance - 0.005;
    }
    if (velocity.norm() < 0.2 || std::fabs(clearance - 0.005) > 1e-6) {
      continue;
    }
    ++cases;
    scene.add(objects.objects[0]);
    method.look();
    CHECK(output.status != vpAvoidanceStatus::Unsafe); // of the step before
    bool unsafe = false;
    for (int k = 1; k < 600 && (k < 3 || output.velocity.norm() > 0.); ++k) {
      step();
      unsafe = unsafe || output.status == vpAvoidanceStatus::Unsafe;
      clearance = std::min(clearance, IndependentClearance(amor(), objects).clearance(q, {}, 0.1));
      if (k % 7 == 0) {
        method.look();
      }
    }
    CHECK(unsafe);
    CHECK(outcome.acceleration <= 1.01 * vpAvoidanceMethodSpec().maxAcceleration);
    hard += outcome.hard ? 1 : 0;
    if (!outcome.hard) {
      CHECK(clearance > 0.);
    }
  }
  std::cout << cases << " times within the margin: " << hard << " stops beyond the bounds of the tool\n";
  REQUIRE(cases == 12);
  CHECK(hard <= cases / 2); // where the way leads into the ball, nothing else helps
}

TEST_CASE("What is driven is what was proven: the same motion, state by state", "[planned]")
{
  const vpCollisionSceneFile file = vpLoadCollisionScene(dataFile("scene/s4b-shelf.json"));
  const vpCollisionScene scene(amor(), file.spec);
  vpPlannedMotionSpec spec;
  spec.replanning = vpReplanning::FromRest;
  vpPlannedMotion method(scene, spec);
  REQUIRE(method.start(file.tasks[0].start, vpAvoidanceGoal::at(amor(), file.tasks[0].goal)) ==
          vpAvoidanceStatus::Detouring);
  vpAvoidanceOutput output;
  vpJointVector q = file.tasks[0].start;
  const IndependentClearance clearance(amor(), file.spec);
  double time = 0., least = 1.;
  while (time < method.duration() + 2. * period) {
    method.look();
    method.step(q, output);
    q += period * output.velocity;
    time += period;
    for (int j = 0; j < 7; ++j) {
      REQUIRE(q(j) == Approx(method.at(j, std::min(time, method.duration()))[0]).margin(1e-9));
    }
    least = std::min(least, clearance.clearance(q, scene.selfPairs(), 0.1));
  }
  CHECK(output.status == vpAvoidanceStatus::Arrived);
  CHECK(least >= 0.01 - 1e-9);
}

TEST_CASE("Parameters of the planned motion are checked", "[planned]")
{
  const vpCollisionScene scene(amor());
  vpPlannedMotionSpec spec;
  spec.replanTime = 0.;
  CHECK_THROWS_WITH(vpPlannedMotion(scene, spec), Catch::Contains("replanTime of the planned motion is 0"));
  spec = {};
  spec.clearance = -1.;
  CHECK_THROWS_WITH(vpPlannedMotion(scene, spec), Catch::Contains("clearance of the planned motion is -1"));
  spec = {};
  spec.planner = "A*";
  CHECK_THROWS_WITH(vpPlannedMotion(scene, spec), Catch::Contains("path planner \"A*\" is unknown"));
}
