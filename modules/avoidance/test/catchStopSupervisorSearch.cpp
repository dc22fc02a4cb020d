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
  const double speed = uniform(rng, 0., 1.) < 0.4 ? 0. : std::exp(uniform(rng, -3., 0.5));
  vpCollisionScene scene(arm, scenery(rng, speed));
  vpStopSupervisorSpec spec;
  spec.period = std::exp(uniform(rng, std::log(1e-3), std::log(0.05)));
  spec.margin = uniform(rng, 0., 1.) < 0.3 ? 0. : uniform(rng, 0., 0.03);
  spec.attempts = std::uniform_int_distribution<int>(1, 6)(rng);
  spec.looks = std::uniform_int_distribution<int>(0, 4)(rng) == 0 ? 60 : spec.looks;
  spec.latency = std::uniform_int_distribution<int>(0, 2)(rng) == 0 ? uniform(rng, 0., 0.1) : 0.;
  vpStopSupervisor supervisor(scene, spec);
  vpCollisionData data;
  const double room = uniform(rng, 0., 1.) < 0.3 ? 1e-4 : spec.margin + 1e-3; // some begin within the margin
  vpJointVector q;
  for (int attempt = 0; attempt < 200; ++attempt) {
    q = configuration(arm, rng);
    scene.place(q, data);
    if (!scene.inCollision(data, room, spec.latency)) {
      break;
    }
  }
  if (scene.inCollision(data, room, spec.latency)) {
    return;
  }
  const vpReachBounds reach(arm);
  const double T = spec.period;
  double off = 0.; // e of the proof at the joints' largest decelerations
  for (int i = 0; i < scene.capsuleCount(); ++i) {
    double sum = 0.;
    for (int j = 0; j < arm.size(); ++j) {
      sum += reach(i, j) * std::min(arm.velocity()(j) * T, arm.acceleration()(j) * T * T / 8.);
    }
    off = std::max(off, sum);
  }
  vpSupervisedVelocity answer;
  vpJointVector command = vpJointVector::Zero(arm.size()), aim = command;
  double last = IndependentClearance(arm, after(scene, spec.latency)).clearance(q, scene.selfPairs(), 0.1);
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
      last =
          IndependentClearance(arm, after(scene, spec.latency + t)).clearance(q + t * command, scene.selfPairs(), 0.1);
      const double kept = i == parts || !retreats ? margin - rounding : std::max(0., margin - slack - off);
      CAPTURE(k, i, last, margin, off, T, speed, answer.message());
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
  const long wanted = vpTestSupport::longer(20000); // a million by VISP_DIRECT_LONG_TESTS=50
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

namespace
{
// Two axes at right angles that move a ball. The first one can brake harder, and has to, before its limit.
vpArmModel gantry(std::mt19937_64 &rng)
{
  vpArmSpec spec;
  spec.name = "gantry";
  for (int i = 0; i < 2; ++i) {
    vpArmJointSpec joint = vpArmJointSpec::standardDH(0., i == 0 ? 0.5 * M_PI : 0., 0., 0.);
    joint.name = i == 0 ? "along" : "across";
    joint.type = vpJointType::Prismatic;
    joint.lower = -5.;
    joint.upper = uniform(rng, 0.3, 2.);
    joint.velocity = uniform(rng, 0.5, 3.);
    joint.acceleration = i == 0 ? uniform(rng, 5., 20.) : uniform(rng, 1., 5.);
    spec.joints.push_back(joint);
  }
  const double radius = uniform(rng, 0.005, 0.03);
  spec.capsules.push_back({2, {0., 0., 0.}, {0., 0., 0.}, radius});
  return vpArmModel(spec);
}

Vector3d toolOf(const vpArmModel &arm, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::update(arm, q, data);
  return data.tool.p;
}

struct Stop {
  std::vector<vpJointVector> places, commands; // of every period in which the arm moves
  double share = 0.;                           // of the last wish
};

//! The stop after a number of periods towards a wish: bad input until the arm stands.
Stop stopOf(vpCollisionScene scene, const vpStopSupervisorSpec &spec, vpJointVector q, const vpJointVector &aim,
            int periods)
{
  vpStopSupervisor supervisor(scene, spec);
  vpSupervisedVelocity answer;
  Stop stop;
  for (int k = 0; k < periods || answer.velocity.norm() > 0.; ++k) {
    supervisor.step(q, k < periods ? aim : vpJointVector::Constant(2, NAN), answer);
    stop.share = k < periods ? answer.share : stop.share;
    stop.places.push_back(q);
    stop.commands.push_back(answer.velocity);
    q += spec.period * answer.velocity;
    scene.advance(spec.period);
  }
  return stop;
}

//! Where the plan of a stop is, so long after the last wish: v t - v t^2 / (2 b) with the b that ends where the stop
//! does.
vpJointVector planned(const Stop &stop, std::size_t periods, double period, double time)
{
  const vpJointVector from = stop.places[periods], v = stop.commands[periods - 1];
  vpJointVector q = stop.places.back() + period * stop.commands.back();
  for (int j = 0; j < 2; ++j) {
    const double braking = 2. * (q(j) - from(j)) / v(j);
    q(j) = time < braking ? from(j) + v(j) * (time - time * time / (2. * braking)) : q(j);
  }
  return q;
}
} // namespace

// Where one joint brakes harder than the other the plan of a stop goes round a corner, which the arm cuts. A ball is
// put just there, or comes there just then, so that the plan keeps about the margin; then the same is asked for again.
// In half of the cases another ball is so near behind the start that only a retreat is allowed, and the ball at the
// corner so near that cutting it touches.
TEST_CASE("A stop that cuts a corner keeps the margin, and a retreat that does so does not touch", "[supervisor]")
{
  auto rng = vpTestSupport::generator(926);
  CAPTURE(vpTestSupport::seed());
  long stops = 0, retreats = 0;
  double nearest = 1., nearestRetreat = 1.;
  const int cases = vpTestSupport::longer(40000);
  for (int problem = 0; problem < cases; ++problem) {
    const vpArmModel arm = gantry(rng);
    const double radius = arm.spec().capsules.front().radius;
    const bool retreat = problem % 2 == 0;
    vpStopSupervisorSpec spec;
    spec.period = uniform(rng, 0.02, 0.2);
    spec.margin = retreat ? uniform(rng, 0.01, 0.05) : uniform(rng, 0., 0.02);
    spec.attempts = 1;
    spec.latency = problem % 5 == 0 ? uniform(rng, 0., 0.2) : 0.;
    const std::size_t periods = retreat ? 1 : std::uniform_int_distribution<std::size_t>(1, 5)(rng);
    vpJointVector start(2), aim(2);
    for (int j = 0; j < 2; ++j) {
      const double a = arm.acceleration()(j);
      aim(j) = uniform(rng, 0.3, 1.) * std::min(arm.velocity()(j), a * static_cast<double>(periods) * spec.period);
      double way = 0.5 * aim(j) * aim(j) / a;
      for (std::size_t k = 1; k <= periods; ++k) {
        way += spec.period * std::min(aim(j), a * static_cast<double>(k) * spec.period);
      }
      start(j) = arm.upper()(j) - way * uniform(rng, 1., j == 0 ? 1.1 : 3.);
    }
    const Stop alone = stopOf(vpCollisionScene(arm), spec, start, aim, static_cast<int>(periods));
    if (!(alone.places.size() > periods + 1)) {
      continue;
    }
    const std::size_t cut = std::uniform_int_distribution<std::size_t>(periods, alone.places.size() - 2)(rng);
    const vpJointVector chord = alone.places[cut] + 0.5 * spec.period * alone.commands[cut];
    const Vector3d middle = toolOf(arm, chord);
    const Vector3d along = (toolOf(arm, chord + alone.commands[cut]) - middle).normalized();
    Vector3d corner =
        toolOf(arm, planned(alone, periods, spec.period, (static_cast<double>(cut - periods) + 0.5) * spec.period)) -
        middle;
    corner -= corner.dot(along) * along;
    const double off = corner.norm();
    if (!(off > 1e-4)) {
      continue;
    }
    vpCollisionSceneSpec balls;
    // So far from a place in a direction, at a time.
    const auto addBall = [&](const Vector3d &direction, const Vector3d &from, double clearance, double time,
                             const Vector3d &velocity) {
      vpCollisionObject ball;
      ball.name = "ball " + std::to_string(balls.objects.size());
      const double size = uniform(rng, 0.002, 0.02);
      ball.shape = vpCollisionShape::sphere(size);
      ball.pose.p = from + (radius + size + clearance) * direction.normalized() - (spec.latency + time) * velocity;
      ball.velocity = vpTwist(velocity.x(), velocity.y(), velocity.z(), 0., 0., 0.);
      balls.objects.push_back(ball);
    };
    // Half of them where only the corner decides, the others where some stops are allowed.
    const double far = problem % 4 < 2 ? 1. : 30.;
    addBall(-corner, middle, (retreat ? 0. : spec.margin) + uniform(rng, -1., far) * off,
            (static_cast<double>(cut) + 0.5) * spec.period,
            problem % 3 == 0 || retreat ? Vector3d::Zero() : point(rng, 2.));
    if (retreat) {
      addBall(toolOf(arm, start) - toolOf(arm, start + alone.commands[0]), toolOf(arm, start),
              slack + uniform(rng, 0., far) * off, 0., Vector3d::Zero());
    }
    const auto clearance = [&](const vpJointVector &q, double time) {
      double least = 1.;
      for (const vpCollisionObject &ball : balls.objects) {
        const Vector3d place = ball.pose.p + (spec.latency + time) * Vector3d(ball.velocity.data());
        least = std::min(least, (place - toolOf(arm, q)).norm() - radius - ball.shape.radius());
      }
      return least;
    };
    const double before = clearance(start, 0.);
    if (!(before > (retreat ? 0. : spec.margin))) {
      continue;
    }
    const Stop stop = stopOf(vpCollisionScene(arm, balls), spec, start, aim, static_cast<int>(periods));
    // Where it began a period so near to its margin, as a ball that comes can bring it, it may go by way of a retreat.
    const double slip = 0.125 * spec.period * spec.period * arm.acceleration().sum();
    double least = 1., kept = retreat ? 0. : spec.margin - rounding;
    for (std::size_t k = 0; k < stop.places.size(); ++k) {
      const double begin = clearance(stop.places[k], static_cast<double>(k) * spec.period);
      if (k < periods && begin < spec.margin + slip + spec.resolution + slack) {
        kept = std::min(kept, std::max(0., begin - slack - slip));
      }
      for (int i = 0; i <= 32 && stop.commands[k].norm() > 0.; ++i) {
        const double t = i / 32. * spec.period;
        least =
            std::min(least, clearance(stop.places[k] + t * stop.commands[k], static_cast<double>(k) * spec.period + t));
      }
    }
    CAPTURE(problem, retreat, least, kept, before, off, spec.period, periods, cut);
    REQUIRE(least >= kept);
    if (stop.share > 0.) {
      ++(retreat ? retreats : stops);
      double &nearestOfKind = retreat ? nearestRetreat : nearest;
      nearestOfKind = std::min(nearestOfKind, least - kept);
    }
  }
  std::cout << stops << " stops past a ball, " << retreats << " retreats; least clearance above what was to be kept "
            << 1e3 * nearest << " and " << 1e3 * nearestRetreat << " mm\n";
  CHECK(stops > cases / 50);
  CHECK(retreats > cases / 5000);
}
