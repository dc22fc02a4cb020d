/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Which side a detour takes, how smooth it is, and what happens when nothing is free.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>
#include <visp3/core/vpException.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
constexpr double period = 0.005;

Vector3d toolAt(const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::forward(amor(), q, data);
  return data.tool.p;
}

vpCollisionObject ball(const Vector3d &place, double radius)
{
  vpCollisionObject object;
  object.name = "ball";
  object.shape = vpCollisionShape::sphere(radius);
  object.pose.p = place;
  return object;
}

vpAvoidanceGoal ahead(double distance)
{
  vpAvoidanceGoal goal;
  goal.position = toolAt(amor().home()) + Vector3d(0., distance, 0.);
  return goal;
}

//! Planned tool positions, one period apart, from the first one on; the arm follows.
std::vector<Vector3d> follow(vpCollisionScene &scene, vpDirectTrajectoryAvoidance &method, vpJointVector &q, int steps,
                             vpAvoidanceOutput &output, bool looking = true)
{
  std::vector<Vector3d> places;
  for (int k = 0; k < steps; ++k) {
    if (looking && k % 7 == 0) {
      method.look();
    }
    method.step(q, output);
    q += period * output.velocity;
    scene.advance(period);
    places.push_back(output.wanted);
  }
  return places;
}
} // namespace

TEST_CASE("The detour takes the side that is nearer, round the extent of the obstacle", "[dtg]")
{
  auto rng = vpTestSupport::generator(981);
  CAPTURE(vpTestSupport::seed());
  const Vector3d start = toolAt(amor().home());
  for (const vpDetourKind kind : {vpDetourKind::Via, vpDetourKind::PointToPoint}) {
    int nearer = 0, free = 0;
    for (int problem = 0; problem < 12; ++problem) {
      // Across the front of the arm, with a ball a little above or below the straight way: the other side is shorter.
      const double side = problem % 2 == 0 ? 0.025 : -0.025;
      vpCollisionScene scene(amor());
      scene.add(ball(start + Vector3d(uniform(rng, 0.13, 0.17), uniform(rng, -0.005, 0.005), side), 0.03));
      vpAvoidanceGoal goal;
      goal.position = start + Vector3d(0.3, 0., 0.);
      vpDirectTrajectoryAvoidanceSpec spec;
      spec.detour = kind;
      vpDirectTrajectoryAvoidance method(scene, spec);
      const vpAvoidanceStatus status = method.start(amor().home(), goal);
      UNSCOPED_INFO(vpToString(status));
      if (status != vpAvoidanceStatus::Detouring) {
        continue;
      }
      ++free;
      REQUIRE_FALSE(method.detour().empty());
      const Vector3d via = method.detour().front();
      nearer += (via.z() - start.z()) * side < 0. ? 1 : 0;
      CAPTURE(problem, (via - start).transpose());
      CHECK((via - scene.object(0).pose.p).norm() > 0.04 + spec.toolClearance - 0.03);
    }
    CAPTURE(static_cast<int>(kind));
    CHECK(free >= 10);
    CHECK(nearer == free);
  }
}

TEST_CASE("The planned tool keeps its bounds and is C2 over every change of plan", "[dtg]")
{
  // Obstacles appear and vanish at random while the tool moves; the planned velocity never jumps, and the
  // acceleration keeps the bound, as long as no protective stop is active.
  auto rng = vpTestSupport::generator(982);
  CAPTURE(vpTestSupport::seed());
  const Vector3d start = toolAt(amor().home());
  double fastest = 0., hardest = 0.;
  int plans = 0;
  for (int problem = 0; problem < 15; ++problem) {
    vpCollisionScene scene(amor());
    vpDirectTrajectoryAvoidanceSpec spec;
    spec.detour = problem % 2 == 0 ? vpDetourKind::Via : vpDetourKind::PointToPoint;
    vpDirectTrajectoryAvoidance method(scene, spec);
    vpJointVector q = amor().home();
    REQUIRE(method.start(q, ahead(0.3)) == vpAvoidanceStatus::Moving);
    vpAvoidanceOutput output;
    std::vector<Vector3d> all{start, start};
    std::vector<bool> stopping{false, false};
    const int appears = static_cast<int>(uniform(rng, 20., 120.)), goes = appears + 100;
    for (int k = 0; k < 600; ++k) {
      if (k == appears) {
        const Vector3d now = output.wanted;
        scene.add(ball(now + Vector3d(uniform(rng, -0.03, 0.03), uniform(rng, 0.22, 0.3), 0.), 0.035));
        ++plans;
      }
      if (k == goes && scene.objectCount() > 0) {
        scene.remove(0);
      }
      if (k % 7 == 0) {
        method.look();
      }
      method.step(q, output);
      q += period * output.velocity;
      all.push_back(output.wanted);
      stopping.push_back(output.stopping);
    }
    for (std::size_t i = 2; i < all.size(); ++i) {
      const Vector3d v = (all[i] - all[i - 1]) / period,
                     a = (all[i] - 2. * all[i - 1] + all[i - 2]) / (period * period);
      fastest = std::max(fastest, v.norm());
      if (!stopping[i] && !stopping[i - 1] && !stopping[i - 2]) {
        hardest = std::max(hardest, a.norm());
      }
    }
  }
  std::cout << plans << " obstacles appeared; planned tool at most " << fastest << " m/s, " << hardest << " m/s^2\n";
  CHECK(plans >= 10);
  CHECK(fastest <= 0.5 * (1. + 1e-3));
  CHECK(hardest <= 1. * (1. + 1e-2));
}

TEST_CASE("Without a detour the tool stops in time, and goes on when the way is free", "[dtg]")
{
  vpCollisionScene scene(amor());
  vpDirectTrajectoryAvoidance method(scene);
  vpJointVector q = amor().home();
  REQUIRE(method.start(q, ahead(0.3)) == vpAvoidanceStatus::Moving);
  vpAvoidanceOutput output;
  follow(scene, method, q, 100, output);
  REQUIRE(output.velocity.norm() > 0.1);
  // A closed shell of plates about the goal comes down at once.
  const Vector3d goal = ahead(0.3).position;
  const double far = (goal - output.wanted).norm() - 0.16;
  REQUIRE(far > 0.05);
  vpCollisionObject shell;
  shell.name = "shell";
  shell.shape = vpCollisionShape::sphere(0.1);
  shell.pose.p = goal;
  scene.add(shell);
  vpCollisionSceneSpec spec;
  spec.objects.push_back(scene.object(0));
  double least = 1.;
  for (int k = 0; k < 400; ++k) {
    follow(scene, method, q, 1, output);
    if (k % 7 == 0) {
      method.look();
    }
    least = std::min(least, IndependentClearance(amor(), spec).clearance(q, scene.selfPairs(), 0.1));
  }
  CHECK(least > 0.009);
  CHECK(output.status == vpAvoidanceStatus::GoalInCollision);
  CHECK(output.velocity.norm() < 1e-6);
  scene.remove(0);
  follow(scene, method, q, 800, output);
  CHECK(output.status == vpAvoidanceStatus::Arrived);
  CHECK((toolAt(q) - goal).norm() < 1e-4);
}

TEST_CASE("When look() is called no more, the arm still touches nothing", "[dtg]")
{
  // The camera is covered: an obstacle approaches the arm, and only the supervisor sees it in the scene.
  auto rng = vpTestSupport::generator(983);
  CAPTURE(vpTestSupport::seed());
  const Vector3d start = toolAt(amor().home());
  for (int problem = 0; problem < 8; ++problem) {
    vpCollisionScene scene(amor());
    vpDirectTrajectoryAvoidance method(scene);
    vpJointVector q = amor().home();
    REQUIRE(method.start(q, ahead(0.3)) == vpAvoidanceStatus::Moving);
    vpCollisionObject object = ball(start + Vector3d(0.4, uniform(rng, 0.1, 0.3), 0.), 0.05);
    object.velocity = vpTwist(-0.3, 0., 0., 0., 0., 0.);
    scene.add(object);
    vpAvoidanceOutput output;
    for (int k = 0; k < 500; ++k) {
      follow(scene, method, q, 1, output, false);
      vpCollisionSceneSpec now;
      now.objects.push_back(scene.object(0));
      if (output.velocity.norm() > 1e-3) {
        REQUIRE(IndependentClearance(amor(), now).clearance(q, scene.selfPairs(), 0.1) > 0.);
      }
    }
  }
}

TEST_CASE("A goal that moves is followed within the bounds (figure 8.13)", "[dtg]")
{
  auto rng = vpTestSupport::generator(984);
  CAPTURE(vpTestSupport::seed());
  std::normal_distribution<double> noise(0., 0.01);
  const Vector3d start = toolAt(amor().home());
  vpCollisionScene scene(amor());
  vpDirectTrajectoryAvoidance method(scene);
  vpJointVector q = amor().home();
  vpAvoidanceGoal goal = ahead(0.25);
  REQUIRE(method.start(q, goal) == vpAvoidanceStatus::Moving);
  vpAvoidanceOutput output;
  Vector3d last = start, lastV = Vector3d::Zero();
  for (int k = 0; k < 900; ++k) {
    if (k % 4 == 0) { // 50 Hz
      const double t = k * period, way = std::clamp((t - 0.5) / 0.4, 0., 1.);
      goal.position = start + Vector3d(0.1 * way, 0.25 - 0.1 * way, 0.);
      if (k < 500) {
        goal.position += Vector3d(noise(rng), noise(rng), 0.);
      }
      method.setGoal(goal);
      method.look();
    }
    method.step(q, output);
    q += period * output.velocity;
    const Vector3d v = (output.wanted - last) / period;
    REQUIRE(v.norm() <= 0.5 * 1.001);
    REQUIRE((v - lastV).norm() / period <= 1.02);
    last = output.wanted;
    lastV = v;
  }
  CHECK(output.status == vpAvoidanceStatus::Arrived);
  CHECK((toolAt(q) - (start + Vector3d(0.1, 0.15, 0.))).norm() < 1e-4);
}

TEST_CASE("A camera that is asked to keep looking keeps looking", "[dtg]")
{
  vpCollisionScene scene(amor());
  vpDirectTrajectoryAvoidanceSpec spec;
  spec.keepOrientation = true;
  vpDirectTrajectoryAvoidance method(scene, spec);
  vpJointVector q = amor().home();
  vpArmData data;
  vpArmKinematics::forward(amor(), q, data);
  const Eigen::Matrix3d R = data.tool.R;
  REQUIRE(method.start(q, ahead(0.1)) == vpAvoidanceStatus::Moving);
  vpAvoidanceOutput output;
  for (int k = 0; k < 400; ++k) {
    follow(scene, method, q, 1, output);
    vpArmKinematics::forward(amor(), q, data);
    REQUIRE(vpSO3::log(data.tool.R * R.transpose()).norm() < 1e-3);
  }
  CHECK(output.status == vpAvoidanceStatus::Arrived);
}

TEST_CASE("Parameters of the direct trajectory avoidance are checked", "[dtg]")
{
  const vpCollisionScene scene(amor());
  vpDirectTrajectoryAvoidanceSpec spec;
  spec.sides = 1;
  CHECK_THROWS_WITH(vpDirectTrajectoryAvoidance(scene, spec),
                    Catch::Contains("sides of the direct trajectory avoidance is 1"));
  spec = {};
  spec.clearance = -0.1;
  CHECK_THROWS_WITH(vpDirectTrajectoryAvoidance(scene, spec),
                    Catch::Contains("clearance of the direct trajectory avoidance is -0.1"));
}
