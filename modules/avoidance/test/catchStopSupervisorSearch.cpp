/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Searches for contacts of a moving supervised arm, and for commands beyond the joint limits: random arms, scenes,
// moving and rotating objects, requests of any size. Checked in dense time by independent code.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"

#include <visp3/avoidance/vpStopSupervisor.h>

#include <cstdlib>
#include <iostream>

using namespace vpAvoidanceTestKit;

namespace
{
constexpr double slack = 1e-4;    // m, that a retreat may lose between the ends of periods
constexpr double rounding = 1e-8; // m

//! 1 by default; a million steps in all by VISP_DIRECT_LONG_TESTS=50.
int lengthOfTests()
{
  const char *factor = std::getenv("VISP_DIRECT_LONG_TESTS");
  return std::max(1, factor ? std::atoi(factor) : 1);
}

//! 2 to 8 joints of any kind in skew frames, each with motion limits, a capsule on most links and on the base.
vpArmModel randomArm(std::mt19937_64 &rng)
{
  vpArmSpec spec;
  spec.name = "random";
  const int n = std::uniform_int_distribution<int>(2, 8)(rng);
  for (int i = 0; i < n; ++i) {
    vpArmJointSpec joint = vpArmJointSpec::standardDH(uniform(rng, -0.3, 0.3), uniform(rng, -2., 2.),
                                                      uniform(rng, -0.3, 0.3), uniform(rng, -3., 3.));
    joint.before.R = vpSO3::exp(point(rng, 1.));
    joint.name = "j" + std::to_string(i);
    const int kind = std::uniform_int_distribution<int>(0, 9)(rng);
    joint.type = kind < 2 ? vpJointType::Prismatic : kind < 5 ? vpJointType::Continuous : vpJointType::Revolute;
    const double range = joint.type == vpJointType::Prismatic ? 0.6 : 2.5;
    joint.lower = uniform(rng, -range, 0.1 * range);
    joint.upper = joint.lower + uniform(rng, 0.1 * range, 1.5 * range);
    joint.velocity = uniform(rng, 0.2, 3.);
    joint.acceleration = std::exp(uniform(rng, -1., 3.));
    spec.joints.push_back(joint);
    if (i > 0 && kind % 4 != 3) {
      spec.capsules.push_back({i + 1, point(rng, 0.2), point(rng, 0.2), uniform(rng, 0.02, 0.07)});
    }
  }
  spec.capsules.push_back({n, point(rng, 0.1), point(rng, 0.2), uniform(rng, 0.02, 0.07)});
  spec.capsules.push_back({0, {0., 0., -0.3}, {0., 0., -0.1}, 0.06});
  return vpArmModel(spec);
}

vpCollisionSceneSpec scenery(std::mt19937_64 &rng, double speed)
{
  vpCollisionSceneSpec spec = randomScene(rng, std::uniform_int_distribution<int>(1, 10)(rng), 1.2);
  for (vpCollisionObject &object : spec.objects) {
    const Vector3d v = point(rng, speed), w = point(rng, 3. * speed);
    object.velocity = vpTwist(v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
  }
  if (uniform(rng, 0., 1.) < 0.3) {
    vpHalfSpace ground;
    ground.normal = Vector3d(point(rng, 0.2) + Vector3d::UnitZ()).normalized();
    ground.offset = uniform(rng, -0.8, -0.3);
    ground.firstLink = 1;
    spec.ground = ground;
  }
  return spec;
}

//! Objects moved on by their velocities for a time.
vpCollisionSceneSpec after(const vpCollisionScene &scene, double time)
{
  vpCollisionSceneSpec spec;
  spec.ground = scene.ground();
  for (int i = 0; i < scene.objectCount(); ++i) {
    spec.objects.push_back(scene.object(i));
    spec.objects.back().pose = scene.object(i).poseAt(time);
  }
  return spec;
}

//! Next request: mostly within the limits, some far beyond, some towards moving objects, for a random time.
vpJointVector wish(const vpArmModel &arm, std::mt19937_64 &rng)
{
  vpJointVector v(arm.size());
  const double size = std::exp(uniform(rng, -3., 1.5)), wild = uniform(rng, 0., 1.);
  for (int j = 0; j < v.size(); ++j) {
    v(j) = size * uniform(rng, -1., 1.) * arm.velocity()(j);
    v(j) *= wild < 0.05 ? 1e9 : wild < 0.08 ? 1e154 : 1.;
  }
  return v;
}

struct Count {
  long steps = 0, moving = 0, near = 0, stopped = 0;
  double nearest = 1.;
};

void drive(const vpArmModel &arm, std::mt19937_64 &rng, int steps, Count &count)
{
  const double speed = uniform(rng, 0., 1.) < 0.4 ? 0. : uniform(rng, 0., 0.6);
  vpCollisionScene scene(arm, scenery(rng, speed));
  vpStopSupervisorSpec spec;
  spec.period = std::exp(uniform(rng, std::log(1e-3), std::log(0.05)));
  spec.margin = uniform(rng, 0., 1.) < 0.3 ? 0. : uniform(rng, 0., 0.03);
  spec.attempts = std::uniform_int_distribution<int>(1, 6)(rng);
  spec.looks = std::uniform_int_distribution<int>(0, 4)(rng) == 0 ? 60 : spec.looks;
  vpStopSupervisor supervisor(scene, spec);
  vpCollisionData data;
  const double room = uniform(rng, 0., 1.) < 0.3 ? 1e-4 : spec.margin + 1e-3; // some begin within the margin
  vpJointVector q;
  for (int attempt = 0; attempt < 200; ++attempt) {
    q = configuration(arm, rng);
    scene.place(q, data);
    if (!scene.inCollision(data, room)) {
      break;
    }
  }
  if (scene.inCollision(data, room)) {
    return;
  }
  const vpReachBounds reach(arm);
  const double T = spec.period;
  double off = 0.; // 2 e of the proof at the joints' largest decelerations
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    double sum = 0.;
    for (int j = 0; j < arm.size(); ++j) {
      sum += reach(i, j) * std::min(arm.velocity()(j) * T, arm.acceleration()(j) * T * T / 8.);
    }
    off = std::max(off, 2. * sum);
  }
  vpSupervisedVelocity answer;
  vpJointVector command = vpJointVector::Zero(arm.size()), aim = command;
  double last = IndependentClearance(arm, after(scene, 0.)).clearance(q, scene.selfPairs(), 0.1);
  bool moved = false;
  bool retreats = false; // on a motion that began near its margin: may lose slightly between ends of periods
  for (int k = 0, left = 0; k < steps; ++k, --left) {
    if (left == 0) {
      aim = wish(arm, rng);
      left = std::uniform_int_distribution<int>(1, 1 + static_cast<int>(1. / T))(rng);
    }
    supervisor.step(q, aim, answer);
    REQUIRE(answer.velocity.size() == arm.size());
    REQUIRE(answer.looks <= spec.looks);
    for (int j = 0; j < arm.size(); ++j) {
      REQUIRE(std::fabs(answer.velocity(j)) <= arm.velocity()(j) * (1. + 1e-9));
      REQUIRE(std::fabs(answer.velocity(j) - command(j)) <= T * arm.acceleration()(j) * (1. + 1e-6));
    }
    // With few evaluations a proven stop may not be proven again, which must be reported.
    REQUIRE((answer.status != vpSupervision::Unsafe || spec.looks == 60));
    REQUIRE(answer.status != vpSupervision::InvalidInput);
    command = answer.velocity;
    const bool moves = command.cwiseAbs().maxCoeff() > 0.;
    retreats = (retreats && moved) || last < spec.margin + off + spec.resolution + slack;
    moved = moves;
    // Between the ends of the period the arm moves at one velocity; at its end a clearance within the margin may not
    // have become less by the arm's motion.
    const double margin = std::min(spec.margin, last);
    const int parts = moves ? 4 : 1;
    for (int i = 1; i <= parts; ++i) {
      const double t = T * i / parts;
      last = IndependentClearance(arm, after(scene, t)).clearance(q + t * command, scene.selfPairs(), 0.1);
      const double kept = i == parts || !retreats ? margin - rounding : std::max(0., margin - slack - off);
      CAPTURE(k, i, last, margin, off, T, speed, answer.sentence());
      REQUIRE((!moves || last >= kept));
    }
    q += T * command;
    for (int j = 0; j < arm.size(); ++j) {
      REQUIRE((arm.isContinuous(j) || (q(j) >= arm.lower()(j) - 1e-8 && q(j) <= arm.upper()(j) + 1e-8)));
    }
    scene.advance(T);
    ++count.steps;
    count.moving += moves ? 1 : 0;
    count.near += moves && last < spec.margin + 0.01 ? 1 : 0;
    count.stopped += answer.status == vpSupervision::Stopping || answer.status == vpSupervision::Slowed ? 1 : 0;
    count.nearest = moves ? std::min(count.nearest, last - margin) : count.nearest;
  }
}
} // namespace

TEST_CASE("No search finds a supervised arm that touches while it moves or exceeds a limit", "[supervisor]")
{
  auto rng = vpTestSupport::generator(925);
  CAPTURE(vpTestSupport::seed());
  const long wanted = 20000L * lengthOfTests();
  Count count;
  for (int problem = 0; count.steps < wanted; ++problem) {
    CAPTURE(problem);
    drive(problem % 3 == 0 ? amor() : randomArm(rng), rng, 400, count);
  }
  std::cout << count.steps << " steps, " << count.moving << " in motion, " << count.near
            << " of them within 10 mm of the "
            << "margin, " << count.stopped << " braked; least clearance at the end of a period in motion "
            << 1e3 * count.nearest << " mm above what was to be kept\n";
  CHECK(count.moving > wanted / 4);
  CHECK(count.near > wanted / 200);
  CHECK(count.stopped > wanted / 200);
}
