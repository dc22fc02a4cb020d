/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// For any request, the arm touches nothing while it moves, and is never prevented from leaving.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpStopSupervisor.h>
#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpJointBounds.h>

#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
constexpr double period = 0.005;

vpCollisionSceneSpec randomScene(std::mt19937_64 &rng, double speed)
{
  vpCollisionSceneSpec spec;
  for (int k = 0; k < 6; ++k) {
    vpCollisionObject object;
    object.name = "object " + std::to_string(k);
    object.shape = k % 2 == 0 ? vpCollisionShape::sphere(uniform(rng, 0.05, 0.15))
                              : vpCollisionShape::box({uniform(rng, 0.05, 0.3), 0.2, 0.02});
    object.pose = pose(rng, 1.);
    object.pose.p = uniform(rng, 0.55, 1.) * object.pose.p.normalized();
    const Vector3d v = speed * point(rng, 1.).normalized(), w = point(rng, speed);
    object.velocity = vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
    spec.objects.push_back(object);
  }
  return spec;
}

//! A free configuration, or an empty vector.
vpJointVector freeStart(const vpCollisionScene &scene, std::mt19937_64 &rng)
{
  vpCollisionData data;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const vpJointVector q = configuration(amor(), rng);
    scene.place(q, data);
    if (!scene.inCollision(data, 0.03)) {
      return q;
    }
  }
  return {};
}

//! Result of a run with random requests.
struct Run {
  int touches = 0; // periods in which the moving arm was nearer than it should be
  int limited = 0; // periods not as requested
  double way = 0.; // rad
  bool unsafe = false;
};

// The margin is kept to resting objects. Moving ones may come within it while the arm stands, and the arm may then
// leave; so only contacts count there.
Run drive(vpCollisionScene &scene, std::mt19937_64 &rng, bool supervised, double margin, double kept)
{
  Run run;
  vpStopSupervisorSpec spec;
  spec.margin = margin;
  vpStopSupervisor supervisor(scene, spec);
  vpSupervisedVelocity answer;
  vpJointBounds bounds;
  vpJointVector q = freeStart(scene, rng), command = vpJointVector::Zero(7), aim = command;
  REQUIRE(q.size() == 7);
  for (int k = 0; k < 600; ++k) {
    if (k % 80 == 0) {
      for (int j = 0; j < 7; ++j) {
        aim(j) = uniform(rng, -1.5, 1.5);
      }
    }
    bounds.update(amor(), q, command, period, 0.);
    vpJointVector wish(7);
    for (int j = 0; j < 7; ++j) {
      wish(j) = bounds.clamp(j, aim(j));
    }
    const vpJointVector before = command;
    if (supervised) {
      supervisor.step(q, wish, answer);
      command = answer.velocity;
      run.limited += answer.status == vpSupervision::Passed ? 0 : 1;
      run.unsafe = run.unsafe || answer.status == vpSupervision::Unsafe;
      for (int j = 0; j < 7; ++j) {
        REQUIRE(std::fabs(command(j) - before(j)) <= period * amor().acceleration()(j) * (1. + 1e-9) + 1e-12);
      }
    }
    else {
      command = wish;
    }
    q += period * command;
    scene.advance(period);
    run.way += period * command.norm();
    vpCollisionSceneSpec now;
    for (int i = 0; i < scene.objectCount(); ++i) {
      now.objects.push_back(scene.object(i));
    }
    if (command.norm() > 0. && IndependentClearance(amor(), now).clearance(q, scene.selfPairs(), 0.1) < kept) {
      ++run.touches;
    }
  }
  return run;
}
} // namespace

TEST_CASE("A supervised arm touches nothing while it moves, among obstacles that stand and that move", "[supervisor]")
{
  auto rng = vpTestSupport::generator(921);
  CAPTURE(vpTestSupport::seed());
  int touches = 0; // without
  for (const double speed : {0., 0.3}) {
    Run with, without;
    for (int problem = 0; problem < 25; ++problem) {
      const vpCollisionSceneSpec spec = randomScene(rng, speed);
      vpCollisionScene scene(amor(), spec);
      const auto state = rng;
      const double kept = speed == 0. ? 0.01 - 3e-4 : 0.;
      const Run run = drive(scene, rng, true, 0.01, kept);
      CAPTURE(speed, problem);
      REQUIRE(run.touches == 0);
      REQUIRE_FALSE(run.unsafe);
      with.limited += run.limited;
      with.way += run.way;
      rng = state;
      vpCollisionScene again(amor(), spec);
      without.touches += drive(again, rng, false, 0.01, kept).touches > 0 ? 1 : 0;
    }
    std::cout << "obstacles at " << speed << " m/s: supervised 0 of 25 runs touch, " << with.limited / 150.
              << " % of the periods not as wished, way " << with.way / 25. << " rad a run; without " << without.touches
              << " of 25 touch\n";
    touches += without.touches;
    CHECK(with.way / 25. > 0.3); // it does move
  }
  CHECK(touches > 0); // without supervisor there are contacts: in about a third of the 50 runs
}

TEST_CASE("The arm stops before a post, says so, and leaves at full speed", "[supervisor]")
{
  vpJointVector q(7);
  q << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
  vpArmData data;
  vpArmKinematics::update(amor(), q, data);
  vpCollisionSceneSpec spec;
  vpCollisionObject post;
  post.name = "post";
  post.shape = vpCollisionShape::cylinder(0.05, 1.);
  post.pose.p = Eigen::AngleAxisd(0.8, Vector3d::UnitZ()) * data.tool.p;
  spec.objects.push_back(post);
  const vpCollisionScene scene(amor(), spec);
  vpStopSupervisor supervisor(scene);
  vpSupervisedVelocity answer;
  vpCollisionData placed;
  const double step = period * amor().acceleration()(0);
  answer.velocity = vpJointVector::Zero(7);
  vpJointVector wish = answer.velocity; // to turn the base towards the post
  double clearance = 1., fastest = 0.;
  for (int k = 0; k < 1000; ++k) {
    wish(0) = std::min(answer.velocity(0) + step, 1.);
    supervisor.step(q, wish, answer);
    fastest = std::max(fastest, answer.velocity(0));
    q += period * answer.velocity;
    scene.place(q, placed);
    clearance = scene.clearance(placed, 1.).distance;
    REQUIRE(clearance >= 0.01 - 1.1e-4);
  }
  CAPTURE(answer.message(), clearance);
  CHECK(fastest == Approx(1.));
  CHECK(clearance < 0.0105);
  CHECK(answer.velocity.norm() < 0.01);
  CHECK(answer.status != vpSupervision::Passed);
  CHECK(scene.describe(answer.pair).find("post") != std::string::npos);
  // Away: no limit, however near.
  for (int k = 0; k < 30; ++k) {
    wish(0) = answer.velocity(0) - step;
    supervisor.step(q, wish, answer);
    REQUIRE(answer.status == vpSupervision::Passed);
    q += period * answer.velocity;
  }
}

TEST_CASE("An obstacle that comes too near too fast is told, and an arm within the margin may leave it", "[supervisor]")
{
  vpJointVector q(7);
  q << .246, .868, -1.237, -2.390, -2.591, -1.099, .324;
  vpArmData data;
  vpArmKinematics::update(amor(), q, data);
  vpCollisionSceneSpec spec;
  vpCollisionObject ball;
  ball.name = "ball";
  ball.shape = vpCollisionShape::sphere(0.05);
  ball.pose.p << 2., 0., 0.;
  spec.objects.push_back(ball);
  vpCollisionScene scene(amor(), spec);
  vpStopSupervisor supervisor(scene);
  vpSupervisedVelocity answer;
  vpJointVector wish = vpJointVector::Zero(7);
  for (int k = 0; k < 40; ++k) {
    wish(0) += 0.8 * period * amor().acceleration()(0);
    supervisor.step(q, wish, answer);
    REQUIRE(answer.status == vpSupervision::Passed);
    q += period * answer.velocity;
  }
  vpArmKinematics::update(amor(), q + 0.02 * wish, data);
  vpRigidTransform near;
  near.p = data.tool.p; // where the tool is on its way to rest
  REQUIRE(scene.moveObject(0, near));
  supervisor.step(q, wish, answer);
  CHECK(answer.status == vpSupervision::Unsafe);
  CHECK(answer.velocity.norm() < wish.norm());

  // 5 mm away, within the margin of 10 mm: nearer is refused, away is not.
  supervisor.reset();
  vpCollisionData placed;
  vpArmKinematics::update(amor(), q, data);
  scene.place(q, placed);
  const vpPlacedCapsule &hand = placed.capsules[3];
  near.p = hand.to + (hand.radius + 0.055) * (hand.to - hand.from).normalized();
  REQUIRE(scene.moveObject(0, near));
  scene.place(q, placed);
  REQUIRE(scene.clearance(placed, 1.).distance == Approx(0.005).margin(1e-9));
  // The Jacobian of the hand's end tells which way is away.
  vpJointVector away(7);
  for (int j = 0; j < 7; ++j) {
    const Vector3d axis = data.joint[static_cast<std::size_t>(j)].R.col(2);
    away(j) = -axis.cross(hand.to - data.joint[static_cast<std::size_t>(j)].p).dot((hand.to - hand.from).normalized());
  }
  away *= 0.02 / away.norm(); // within one period's acceleration
  for (int k = 0; k < 100; ++k) {
    supervisor.step(q, -away, answer);
    q += period * answer.velocity;
  }
  CHECK(answer.status != vpSupervision::Passed);
  scene.place(q, placed);
  CHECK(scene.clearance(placed, 1.).distance > 0.005 - 1.1e-4);
  supervisor.step(q, away, answer);
  CHECK(answer.status == vpSupervision::Passed);
}

TEST_CASE("The supervisor does not allocate, brakes on nonsense, and says what is wrong", "[supervisor]")
{
  auto rng = vpTestSupport::generator(922);
  vpCollisionScene scene(amor(), randomScene(rng, 0.1));
  vpStopSupervisor supervisor(scene);
  vpSupervisedVelocity answer;
  vpJointVector q = freeStart(scene, rng), wish = vpJointVector::Constant(7, 0.02);
  supervisor.step(q, wish, answer);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 20; ++k) {
    supervisor.step(q, wish, answer);
    q += period * answer.velocity;
  }
  CHECK(vpTestSupport::allocationCount() == before);
  wish(2) = NAN;
  for (int k = 0; k < 20; ++k) {
    supervisor.step(q, wish, answer);
    CHECK(answer.status == vpSupervision::InvalidInput);
  }
  CHECK(answer.velocity.norm() == 0.);

  vpStopSupervisorSpec spec;
  spec.attempts = 0;
  CHECK_THROWS_WITH(vpStopSupervisor(scene, spec),
                    Catch::Contains("attempts of the stop supervisor is 0, must be 1..16"));
  spec = vpStopSupervisorSpec();
  spec.resolution = 0.;
  CHECK_THROWS_WITH(vpStopSupervisor(scene, spec),
                    Catch::Contains("resolution of the stop supervisor is 0 m, must be > 0"));
  spec = vpStopSupervisorSpec();
  spec.latency = -1.;
  CHECK_THROWS_WITH(vpStopSupervisor(scene, spec),
                    Catch::Contains("latency of the stop supervisor is -1 s, must be >= 0"));
}
