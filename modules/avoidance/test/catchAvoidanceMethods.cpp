/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Common tests for every method of vpMakeAvoidanceMethod().
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpGoalConfiguration.h>
#include <visp3/core/vpException.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
constexpr double period = 0.005;

bool isReactive(const std::string &method) { return method.rfind("potential", 0) == 0; }

//! Result of a motion.
struct Drive {
  vpAvoidanceOutput last;
  vpJointVector q;
  double time = 0.;
  double least = 1.;         // clearance while the arm moved, by independent code
  double worstVelocity = 0.; // largest fraction of a joint's limit
  double worstAcceleration = 0.;
  double toolSpeed = 0.;
  double toolAcceleration = 0.; // except protective stops
  bool unsafe = false;
};

//! Runs until arrival or timeout; look() at 30 Hz, with true object poses.
Drive drive(vpCollisionScene &scene, vpAvoidanceMethod &method, const vpJointVector &start, double duration)
{
  Drive result;
  result.q = start;
  vpJointVector command = vpJointVector::Zero(start.size());
  vpArmData data;
  vpArmKinematics::forward(scene.arm(), start, data);
  Vector3d toolVelocity = Vector3d::Zero();
  bool stopped = false;
  for (int k = 0; result.time < duration; ++k) {
    if (k % 7 == 0 && k > 0) {
      method.look();
    }
    method.step(result.q, result.last);
    const vpJointVector velocity = result.last.velocity;
    REQUIRE(velocity.size() == start.size());
    REQUIRE(velocity.allFinite());
    for (int j = 0; j < start.size(); ++j) {
      result.worstVelocity = std::max(result.worstVelocity, std::fabs(velocity(j)) / scene.arm().velocity()(j));
      result.worstAcceleration = std::max(result.worstAcceleration, std::fabs(velocity(j) - command(j)) /
                                                                        (period * scene.arm().acceleration()(j)));
    }
    command = velocity;
    const Vector3d before = data.tool.p;
    result.q += period * velocity;
    vpArmKinematics::forward(scene.arm(), result.q, data);
    const Vector3d moved = (data.tool.p - before) / period;
    result.toolSpeed = std::max(result.toolSpeed, moved.norm());
    if (!result.last.stopping && !stopped) {
      result.toolAcceleration = std::max(result.toolAcceleration, (moved - toolVelocity).norm() / period);
    }
    stopped = result.last.stopping;
    toolVelocity = moved;
    scene.advance(period);
    result.time += period;
    result.unsafe = result.unsafe || result.last.status == vpAvoidanceStatus::Unsafe;
    if (velocity.norm() > 1e-3) {
      vpCollisionSceneSpec now;
      for (int i = 0; i < scene.objectCount(); ++i) {
        now.objects.push_back(scene.object(i));
      }
      result.least =
          std::min(result.least, IndependentClearance(scene.arm(), now).clearance(result.q, scene.selfPairs(), 0.1));
    }
    if (result.last.status == vpAvoidanceStatus::Arrived && velocity.norm() == 0.) {
      break;
    }
  }
  return result;
}

vpJointVector home() { return amor().home(); }

//! A free configuration with the tool at some distance from home, reachable from there.
vpJointVector goalNear(std::mt19937_64 &rng, const vpCollisionScene &scene)
{
  vpArmData data;
  vpArmKinematics::forward(amor(), home(), data);
  for (int attempt = 0; attempt < 200; ++attempt) {
    const Vector3d place = data.tool.p + 0.35 * point(rng, 1.).normalized();
    if (place.z() < 0.1 || place.norm() > 0.95 || place.norm() < 0.4) {
      continue;
    }
    const vpGoalConfiguration goal = vpFindGoalConfiguration(scene, home(), place, 0.03, 1);
    if (goal.isFree()) {
      return goal.q;
    }
  }
  return {};
}

vpCollisionObject ball(const std::string &name, const Vector3d &place, double radius)
{
  vpCollisionObject object;
  object.name = name;
  object.shape = vpCollisionShape::sphere(radius);
  object.pose.p = place;
  return object;
}
} // namespace

TEST_CASE("Every method reaches goals in an empty scene", "[methods]")
{
  auto rng = vpTestSupport::generator(961);
  CAPTURE(vpTestSupport::seed());
  for (const std::string &name : vpAvoidanceMethodNames()) {
    vpCollisionScene scene(amor());
    for (int problem = 0; problem < 6; ++problem) {
      const vpJointVector goal = goalNear(rng, scene);
      REQUIRE(goal.size() == 7);
      vpAvoidanceGoal wish = vpAvoidanceGoal::at(amor(), goal);
      if (problem % 2 == 1) {
        wish.q.resize(0); // the position alone
      }
      const auto method = vpMakeAvoidanceMethod(name, scene);
      CAPTURE(name, problem, goal.transpose());
      CHECK(method->start(home(), wish) == vpAvoidanceStatus::Moving);
      const Drive run = drive(scene, *method, home(), 12.);
      CHECK(run.last.status == vpAvoidanceStatus::Arrived);
      vpArmData data;
      vpArmKinematics::forward(amor(), run.q, data);
      CHECK((data.tool.p - wish.position).norm() < 1.1e-3);
      if (name != "potential") { // as printed it knows no limits
        CHECK(run.worstVelocity <= 1. + 1e-9);
        CHECK(run.worstAcceleration <= 1. + 1e-6);
        CHECK(run.toolSpeed <= 0.5 * 1.01);
      }
    }
  }
}

TEST_CASE("Among obstacles that stand, methods that foresee keep the margin and arrive or say why", "[methods]")
{
  auto rng = vpTestSupport::generator(962);
  CAPTURE(vpTestSupport::seed());
  vpCollisionScene empty(amor());
  for (const std::string &name : vpAvoidanceMethodNames()) {
    if (isReactive(name)) {
      continue;
    }
    int arrived = 0;
    constexpr int problems = 12;
    for (int problem = 0; problem < problems; ++problem) {
      // A ball on the tool's straight path, and others around.
      const vpJointVector goal = goalNear(rng, empty);
      REQUIRE(goal.size() == 7);
      vpArmData from, to;
      vpArmKinematics::forward(amor(), home(), from);
      vpArmKinematics::forward(amor(), goal, to);
      vpCollisionSceneSpec spec;
      spec.objects.push_back(ball("middle", 0.5 * (from.tool.p + to.tool.p) + point(rng, 0.03), 0.04));
      for (int k = 0; k < 3; ++k) {
        spec.objects.push_back(ball("other" + std::to_string(k), 0.6 * point(rng, 1.).normalized(), 0.06));
      }
      vpCollisionScene scene(amor(), spec);
      vpCollisionData data;
      scene.place(home(), data);
      const bool free = !scene.inCollision(data, 0.03);
      scene.place(goal, data);
      if (!free || scene.inCollision(data, 0.03)) {
        --problem;
        continue;
      }
      const auto method = vpMakeAvoidanceMethod(name, scene);
      static_cast<void>(method->start(home(), vpAvoidanceGoal::at(amor(), goal)));
      const Drive run = drive(scene, *method, home(), 40.);
      CAPTURE(name, problem, vpToString(run.last.status));
      CHECK(run.least > 0.009);
      CHECK_FALSE(run.unsafe);
      CHECK(run.worstVelocity <= 1. + 1e-9);
      CHECK(run.worstAcceleration <= 1. + 1e-6);
      CHECK(run.toolSpeed <= 0.5 * 1.01);
      CHECK(run.toolAcceleration <= 1. * 1.02);
      arrived += run.last.status == vpAvoidanceStatus::Arrived ? 1 : 0;
      if (run.last.status != vpAvoidanceStatus::Arrived) {
        CHECK(run.last.velocity.norm() < 1e-3); // at rest, not wandering
        CHECK((run.last.status == vpAvoidanceStatus::Waiting || run.last.status == vpAvoidanceStatus::Unreachable ||
               run.last.status == vpAvoidanceStatus::GoalInCollision));
      }
    }
    std::cout << name << ": " << arrived << " of " << problems << " arrive\n";
    CHECK(arrived >= (name.rfind("planner", 0) == 0 ? problems : problems * 2 / 3));
  }
}

TEST_CASE("No method that foresees touches what moves while it moves itself", "[methods]")
{
  auto rng = vpTestSupport::generator(963);
  CAPTURE(vpTestSupport::seed());
  vpCollisionScene empty(amor());
  for (const std::string &name : vpAvoidanceMethodNames()) {
    if (isReactive(name)) {
      continue;
    }
    int arrived = 0;
    constexpr int problems = 10;
    for (int problem = 0; problem < problems; ++problem) {
      const vpJointVector goal = goalNear(rng, empty);
      REQUIRE(goal.size() == 7);
      vpArmData from, to;
      vpArmKinematics::forward(amor(), home(), from);
      vpArmKinematics::forward(amor(), goal, to);
      vpCollisionSceneSpec spec;
      const Vector3d way = (to.tool.p - from.tool.p).normalized();
      const Vector3d across = way.unitOrthogonal();
      // It crosses the middle of the way when the tool would be about there.
      vpCollisionObject object = ball("crossing", 0.5 * (from.tool.p + to.tool.p) - 0.4 * across, 0.05);
      object.velocity = vpTwist(0.3 * across.x(), 0.3 * across.y(), 0.3 * across.z(), 0., 0., 0.);
      spec.objects.push_back(object);
      vpCollisionScene scene(amor(), spec);
      vpCollisionData data;
      scene.place(home(), data);
      if (scene.inCollision(data, 0.05)) {
        --problem;
        continue;
      }
      const auto method = vpMakeAvoidanceMethod(name, scene);
      static_cast<void>(method->start(home(), vpAvoidanceGoal::at(amor(), goal)));
      const Drive run = drive(scene, *method, home(), 40.);
      CAPTURE(name, problem, vpToString(run.last.status), run.time);
      // An obstacle that approaches a standing arm may be within the margin when it leaves; nothing is touched.
      CHECK(run.least > 0.);
      arrived += run.last.status == vpAvoidanceStatus::Arrived ? 1 : 0;
    }
    std::cout << name << ": " << arrived << " of " << problems << " arrive among what moves\n";
    CHECK(arrived >= problems - 1);
  }
}

TEST_CASE("A goal that is taken, then free: the arm waits, says so, and goes", "[methods]")
{
  auto rng = vpTestSupport::generator(964);
  CAPTURE(vpTestSupport::seed());
  for (const std::string &name : vpAvoidanceMethodNames()) {
    if (isReactive(name)) {
      continue;
    }
    vpCollisionScene scene(amor());
    vpAvoidanceGoal wish;
    int index = -1;
    vpCollisionData data;
    do { // an obstacle that does not affect the arm at home
      if (index >= 0) {
        scene.remove(index);
      }
      wish = vpAvoidanceGoal::at(amor(), goalNear(rng, scene));
      index = scene.add(ball("guest", wish.position, 0.05));
      scene.place(home(), data);
    } while (scene.inCollision(data, 0.03));
    const auto method = vpMakeAvoidanceMethod(name, scene);
    CAPTURE(name);
    CHECK(method->start(home(), wish) == vpAvoidanceStatus::GoalInCollision);
    const Drive waiting = drive(scene, *method, home(), 1.);
    CHECK(waiting.last.status == vpAvoidanceStatus::GoalInCollision);
    CHECK((waiting.q - home()).norm() < 0.05);
    REQUIRE(waiting.last.pair.kind == vpCollisionKind::Object);
    CHECK(waiting.last.pair.other == index);
    CHECK(std::string(vpMessage(waiting.last.status)).find("goal") != std::string::npos);
    scene.remove(index);
    CHECK(drive(scene, *method, waiting.q, 12.).last.status == vpAvoidanceStatus::Arrived);
  }
}

TEST_CASE("Goals out of reach, an arm that touches, nonsense: a status, and the arm stands", "[methods]")
{
  for (const std::string &name : vpAvoidanceMethodNames()) {
    vpCollisionScene scene(amor());
    CAPTURE(name);
    const auto method = vpMakeAvoidanceMethod(name, scene);
    vpAvoidanceGoal far;
    far.position = Vector3d(0., 2., 0.3);
    vpAvoidanceOutput output;
    if (!isReactive(name)) {
      CHECK(method->start(home(), far) == vpAvoidanceStatus::Unreachable);
      CHECK(drive(scene, *method, home(), 0.5).last.velocity.norm() < 1e-3);
    }
    vpAvoidanceGoal broken = vpAvoidanceGoal::at(amor(), home());
    broken.position.x() = NAN;
    CHECK(method->start(home(), broken) == vpAvoidanceStatus::InvalidInput);
    method->step(home(), output);
    CHECK(output.status == vpAvoidanceStatus::InvalidInput);
    CHECK(output.velocity == vpJointVector::Zero(7));
    broken = vpAvoidanceGoal::at(amor(), home());
    broken.q = vpJointVector::Zero(3);
    CHECK(method->start(home(), broken) == vpAvoidanceStatus::InvalidInput);
    CHECK(method->start(vpJointVector::Zero(2), vpAvoidanceGoal::at(amor(), home())) ==
          vpAvoidanceStatus::InvalidInput);

    static_cast<void>(method->start(home(), vpAvoidanceGoal::at(amor(), home())));
    method->step(vpJointVector::Constant(7, NAN), output);
    CHECK(output.status == vpAvoidanceStatus::InvalidInput);
    CHECK(output.velocity == vpJointVector::Zero(7));

    vpCollisionScene tight(amor());
    vpArmData data;
    vpArmKinematics::forward(amor(), home(), data);
    tight.add(ball("cuff", data.tool.p, 0.05));
    if (!isReactive(name)) {
      const auto held = vpMakeAvoidanceMethod(name, tight);
      vpAvoidanceGoal wish = vpAvoidanceGoal::at(amor(), home());
      wish.position += Vector3d(0., 0., 0.2);
      wish.q.resize(0);
      static_cast<void>(held->start(home(), wish));
      const Drive run = drive(tight, *held, home(), 0.5);
      CHECK((run.q - home()).norm() < 1e-6);
      CHECK(run.last.status == vpAvoidanceStatus::StartInCollision);
      CHECK(vpMessage(run.last, tight, 0.01) == "The arm stands: link 7 and object cuff touch.");
      CHECK_FALSE(vpIsWorking(run.last)); // a loop ends
    }
  }
}

TEST_CASE("An arm within the margin: the message names the pair, the clearance and the margin", "[methods]")
{
  vpAvoidanceOutput output;
  // 9.85 mm from a ball with a margin of 10 mm: no contact, and the message says so.
  vpCollisionScene scene(amor());
  vpCollisionData placed;
  scene.place(home(), placed);
  const vpPlacedCapsule &hand = placed.capsules[3];
  scene.add(ball("ball", hand.to + (hand.radius + 0.05 + 0.00985) * (hand.to - hand.from).normalized(), 0.05));
  const auto method = vpMakeAvoidanceMethod("planner", scene);
  vpJointVector there = home();
  there(0) += 0.5;
  CHECK(method->start(home(), vpAvoidanceGoal::at(amor(), there)) == vpAvoidanceStatus::StartInCollision);
  method->step(home(), output);
  CHECK(vpMessage(output, scene, 0.01) ==
        "The arm stands: link 7 and object ball are 9.85 mm apart, the margin is 10 mm.");
  CHECK(method->start(there, vpAvoidanceGoal::at(amor(), home())) == vpAvoidanceStatus::GoalInCollision);
  method->step(there, output);
  CHECK(vpMessage(output, scene, 0.01) ==
        "The arm waits: at the goal link 7 and object ball are 9.85 mm apart, the margin is 10 mm.");
}

TEST_CASE("The step of no method allocates", "[methods]")
{
  auto rng = vpTestSupport::generator(965);
  vpArmData data;
  vpArmKinematics::forward(amor(), home(), data);
  for (const std::string &name : vpAvoidanceMethodNames()) {
    vpCollisionScene scene(amor());
    const vpJointVector goal = goalNear(rng, scene);
    scene.add(ball("near", data.tool.p + Vector3d(0.15, 0., 0.), 0.05));
    const auto method = vpMakeAvoidanceMethod(name, scene);
    static_cast<void>(method->start(home(), vpAvoidanceGoal::at(amor(), goal)));
    vpAvoidanceOutput output;
    vpJointVector q = home();
    unsigned long allocations = 0;
    for (int k = 0; k < 400; ++k) {
      if (k % 7 == 0) {
        scene.moveObject(0, {Eigen::Matrix3d::Identity(), data.tool.p + Vector3d(0.15 - 0.0002 * k, 0., 0.)});
        method->look();
      }
      const unsigned long before = vpTestSupport::allocationCount();
      method->step(q, output);
      allocations += vpTestSupport::allocationCount() - before;
      q += period * output.velocity;
    }
    CAPTURE(name);
    CHECK(allocations == 0);
  }
}

TEST_CASE("Names and parameters of methods are checked", "[methods]")
{
  const vpCollisionScene scene(amor());
  CHECK_THROWS_WITH(
      vpMakeAvoidanceMethod("teleport", scene),
      Catch::Contains("avoidance method \"teleport\" is unknown, known are: potential, potential-corrected"));
  vpAvoidanceMethodSpec spec;
  spec.maxVelocity = 0.;
  for (const std::string &name : vpAvoidanceMethodNames()) {
    CHECK_THROWS_WITH(vpMakeAvoidanceMethod(name, scene, spec),
                      Catch::Contains("maxVelocity of the avoidance method is 0"));
  }
  CHECK_THROWS_WITH(vpAvoidanceGoal::at(amor(), vpJointVector::Zero(3)), Catch::Contains("a goal of 3 numbers"));
  CHECK_THROWS_WITH(vpFindGoalConfiguration(scene, vpJointVector::Zero(2), Vector3d::Zero()),
                    Catch::Contains("is sought from 2 numbers"));
}

TEST_CASE("A goal configuration is free, or its status says that none is, or that the place is out of reach",
          "[methods]")
{
  auto rng = vpTestSupport::generator(94);
  CAPTURE(vpTestSupport::seed());
  int counts[3] = {0, 0, 0};
  for (int problem = 0; problem < 60; ++problem) {
    vpCollisionScene scene(amor(), randomScene(rng, 5, 0.8));
    const Vector3d place = point(rng, 0.9);
    if (problem % 3 == 0) { // nothing can be there
      scene.add(ball("plug", place, 0.05));
    }
    const vpGoalConfiguration goal = vpFindGoalConfiguration(scene, home(), place, 0.01, 3, 1 + rng() % 1000);
    ++counts[static_cast<int>(goal.status)];
    CAPTURE(problem, place.transpose(), static_cast<int>(goal.status));
    CHECK(goal.isFree() == (goal.status == vpGoalConfigurationStatus::Free));
    CHECK_THAT(goal.message(), Catch::StartsWith(goal.isFree()       ? "Free: "
                                                 : goal.q.size() > 0 ? "InCollision: "
                                                                     : "Unreachable: "));
    CHECK((problem % 3 != 0 || !goal.isFree()));
    if (goal.status == vpGoalConfigurationStatus::Unreachable) {
      CHECK(goal.q.size() == 0);
      continue;
    }
    vpArmData data;
    vpArmKinematics::forward(amor(), goal.q, data);
    CHECK((data.tool.p - place).norm() < 1e-3);
    for (int j = 0; j < goal.q.size(); ++j) {
      CHECK((goal.q(j) >= amor().lower()(j) - 1e-9 && goal.q(j) <= amor().upper()(j) + 1e-9));
    }
    vpCollisionData placed;
    scene.place(goal.q, placed);
    CHECK(scene.inCollision(placed, 0.01) == (goal.status == vpGoalConfigurationStatus::InCollision));
  }
  for (const int count : counts) {
    CHECK(count > 0);
  }
  const vpGoalConfiguration far =
      vpFindGoalConfiguration(vpCollisionScene(amor()), home(), Vector3d(0., 3., 0.), 0., 3);
  CHECK(far.status == vpGoalConfigurationStatus::Unreachable);
}
