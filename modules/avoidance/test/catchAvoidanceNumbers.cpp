/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// NaN, infinities and magnitudes that overflow, into every check and every step of the module: none of them may come out
// as free, as passed, or as a command that is no number.
#include "vpAvoidanceTestKit.h"
#include "vpCatch.h"
#include "vpIndependentClearance.h"
#include "vpTrackTestKit.h"
#include "vpWildNumbers.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpCertifiedTrajectory.h>
#include <visp3/avoidance/vpDepthObstacles.h>
#include <visp3/avoidance/vpDiscreteMotion.h>
#include <visp3/avoidance/vpFclChecker.h>
#include <visp3/avoidance/vpGoalConfiguration.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/avoidance/vpPotentialField.h>
#include <visp3/avoidance/vpSegmentDistance.h>
#include <visp3/avoidance/vpStopSupervisor.h>
#include <visp3/avoidance/vpTimedPath.h>
#include <visp3/core/vpException.h>

#include <functional>

using namespace vpAvoidanceTestKit;
using namespace vpWildNumbers;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double period = 0.005;

vpJointVector home() { return amor().home(); }

bool isInRange(const vpJointVector &q) { return (q.cwiseAbs().array() <= vpLargestCoordinate).all(); }

//! Something of every shape, out of the way of AMOR at home.
vpCollisionSceneSpec everything()
{
  vpCollisionSceneSpec spec;
  const auto add = [&spec](const char *name, const vpCollisionShape &shape, const Vector3d &place) {
    vpCollisionObject object;
    object.name = name;
    object.shape = shape;
    object.pose.p = place;
    object.velocity = vpTwist(0.01, 0., 0., 0., 0.1, 0.);
    spec.objects.push_back(object);
  };
  add("sphere", vpCollisionShape::sphere(0.1), {-1.5, 0., 0.});
  add("capsule", vpCollisionShape::capsule(0.1, 0.2), {0., -1.5, 0.});
  add("box", vpCollisionShape::box({0.2, 0.3, 0.1}), {1.5, 0., 0.});
  add("cylinder", vpCollisionShape::cylinder(0.1, 0.2), {1.5, 1., 0.});
  add("mesh", vpCollisionShape::mesh(tetrahedron(0.1)), {-1.5, 1., 0.5});
  add("octree", vpCollisionShape::octree(vpOctree({{{0., 0., 0.}, 0.1}, {{0.1, 0., 0.}, 0.1}})), {0., 1.8, 0.});
  vpHalfSpace ground;
  ground.offset = -0.5;
  spec.ground = ground;
  return spec;
}
} // namespace

TEST_CASE("A distance of numbers out of range is -infinity, never NaN and never far", "[numbers]")
{
  using Numbers = std::array<double, 15>;
  const Numbers ordinary{{0.1, 0.2, 0.3, 0.4, -0.1, 0.2, 0.5, 0.5, 0.5, 0.7, 0.4, 0.5, 0.9, 0.2, 0.1}};
  const auto p = [](const Numbers &x, std::size_t k) { return Vector3d(x[3 * k], x[3 * k + 1], x[3 * k + 2]); };
  const std::vector<std::pair<std::size_t, std::function<double(const Numbers &)>>> kernels = {
      {9, [&](const Numbers &x) { return vpSegmentDistance::point(p(x, 0), p(x, 1), p(x, 2)).distance; }},
      {12, [&](const Numbers &x) { return vpSegmentDistance::segment(p(x, 0), p(x, 1), p(x, 2), p(x, 3)).distance; }},
      {9, [&](const Numbers &x) { return vpSegmentDistance::box(p(x, 0), p(x, 1), p(x, 2)).distance; }},
      {8, [&](const Numbers &x) { return vpSegmentDistance::cylinder(p(x, 0), p(x, 1), x[6], x[7]).distance; }},
      {15, [&](const Numbers &x) {
         return vpSegmentDistance::triangle(p(x, 0), p(x, 1), p(x, 2), p(x, 3), p(x, 4)).distance;
       }}};
  for (std::size_t kernel = 0; kernel < kernels.size(); ++kernel) {
    everyPlace(ordinary, [&](const Numbers &x, std::size_t place, std::size_t value) {
      const double distance = kernels[kernel].second(x);
      CAPTURE(kernel, place, values[value], distance);
      if (place < kernels[kernel].first && !(std::fabs(values[value]) <= 100. * vpLargestLength)) {
        REQUIRE(distance == -infinity);
      }
      else {
        REQUIRE((distance >= 0. && distance < 10.));
      }
    });
  }
}

TEST_CASE("A configuration or time out of range is in collision for every query", "[numbers]")
{
  const vpCollisionScene scene(amor(), everything());
  vpCollisionData data;
  vpNearPairs near;
  const auto isUnknown = [&](double time) {
    scene.near(data, 0.3, near, time);
    const vpClearance least = scene.clearance(data, infinity, time);
    return scene.inCollision(data, 0., time) && least.distance == -infinity && least.kind == vpCollisionKind::Unknown &&
           near.dropped && near.count == 0 && scene.pair(data, 0, 0, time).distance == -infinity &&
           !scene.describe(least).empty();
  };
  CHECK(isUnknown(0.)); // before the first place()
  scene.place(home(), data);
  REQUIRE_FALSE(scene.inCollision(data));
  for (const double time : values) {
    CAPTURE(time);
    CHECK((isUnknown(time) || (std::fabs(time) <= 1e6 && !scene.inCollision(data, 0., time))));
  }
  CHECK(scene.inCollision(data, NAN));
  CHECK(scene.clearance(data, NAN).distance == -infinity);
  vpSceneChecker own(scene);
  vpFclChecker fcl(scene);
  vpReachBounds reach(amor());
  everyPlace(home(), [&](const vpJointVector &q, std::size_t place, std::size_t value) {
    CAPTURE(place, values[value]);
    scene.place(q, data);
    REQUIRE(isUnknown(0.) == !isInRange(q));
    REQUIRE(reach.holds(q) == isInRange(q));
    if (!isInRange(q)) {
      REQUIRE(scene.selfPair(data, 0, 2).distance == -infinity);
      REQUIRE(scene.groundPair(data, 3).distance == -infinity);
      REQUIRE(own.inCollision(q, 0.));
      REQUIRE(fcl.inCollision(q, 0.));
      REQUIRE(own.clearance(q, infinity).distance == -infinity);
      REQUIRE(fcl.clearance(q, infinity).distance == -infinity);
    }
  });
  scene.place(vpJointVector::Zero(6), data);
  CHECK(isUnknown(0.));
}

TEST_CASE("An object goes nowhere else and gets no motion that is no number", "[numbers]")
{
  vpCollisionScene scene(amor(), everything());
  const auto isGood = [&scene] {
    for (int i = 0; i < scene.objectCount(); ++i) {
      const vpCollisionObject &o = scene.object(i);
      if (!o.pose.p.allFinite() || !o.pose.R.allFinite() || !std::isfinite(o.inflation) ||
          !allFinite(std::array<double, 6>{o.velocity[0], o.velocity[1], o.velocity[2], o.velocity[3], o.velocity[4],
                                           o.velocity[5]})) {
        return false;
      }
    }
    return true;
  };
  for (int i = 0; i < scene.objectCount(); ++i) {
    const vpCollisionObject before = scene.object(i);
    for (const double value : values) {
      CAPTURE(i, value);
      vpRigidTransform pose = before.pose;
      pose.p.y() = value;
      REQUIRE(scene.moveObject(i, pose) == (std::fabs(value) <= vpLargestLength));
      pose.R(1, 2) = value;
      REQUIRE((std::fabs(value) < 1e-9 || !scene.moveObject(i, pose)));
      vpTwist velocity = before.velocity;
      velocity[4] = value;
      REQUIRE(scene.setVelocity(i, velocity) == (std::fabs(value) <= 1e3));
      REQUIRE(scene.setInflation(i, value) == (value >= 0. && value <= vpLargestLength));
      static_cast<void>(scene.advance(value));
      REQUIRE(isGood());
      REQUIRE(scene.moveObject(i, before.pose));
      REQUIRE(scene.setVelocity(i, before.velocity));
      REQUIRE(scene.setInflation(i, 0.));
    }
  }
  REQUIRE(scene.setVelocity(0, vpTwist(1., 0., 0., 0., 0., 0.)));
  CHECK_FALSE(scene.advance(NAN));
  CHECK_FALSE(scene.advance(1e12));
}

TEST_CASE("No motion to or from nowhere is free", "[numbers]")
{
  const vpCollisionScene scene(amor(), everything());
  const vpCertifiedMotion certified(scene);
  vpSceneChecker checker(scene);
  vpDiscreteMotion discrete(checker, 0.1);
  vpMotionScratch scratch;
  REQUIRE(certified.check(home(), home(), scratch).isFree());
  everyPlace(home(), [&](const vpJointVector &q, std::size_t place, std::size_t value) {
    if (isInRange(q)) {
      return; // 0 and what is next to it
    }
    CAPTURE(place, values[value]);
    REQUIRE(certified.check(home(), q, scratch).status == vpMotionStatus::BadInput);
    REQUIRE(certified.check(q, home(), scratch).status == vpMotionStatus::BadInput);
    REQUIRE(certified.check(q, q, scratch).status == vpMotionStatus::BadInput);
    REQUIRE_FALSE(discrete.check(home(), q).isFree());
    REQUIRE_FALSE(discrete.check(q, q).isFree());
  });
  // Bounds on the reach of an arm with slides hold within their limits only.
  const vpCollisionScene slides(mixed());
  const vpCertifiedMotion within(slides);
  const vpJointVector zero = vpJointVector::Zero(5);
  vpJointVector far = zero;
  far(1) = 3.; // upper is 1
  CHECK(within.check(zero, far, scratch).status == vpMotionStatus::BadInput);
  far(1) = 1.04;
  CHECK(within.check(zero, far, scratch).status != vpMotionStatus::BadInput);
}

TEST_CASE("No plan with a number out of range is free", "[numbers]")
{
  const vpCollisionScene scene(amor(), everything());
  vpCertifiedTrajectory certificate(scene);
  vpTrajectoryPlan plan(7);
  const auto make = [&plan](const std::array<double, 9> &x) {
    plan.clear();
    for (int j = 0; j < 7; ++j) {
      const bool odd = j == 2;
      plan.begin(j, odd ? x[0] : home()(j), vpTrajectoryForm::Direct);
      plan.append(j, odd ? vpPolynomial{x[1], x[2], x[3], x[4]} : vpPolynomial{0.}, odd ? x[5] : 0.5);
      plan.finish(j, odd ? vpAxisState{x[6], x[7], 0., 0.} : vpAxisState{home()(j), 0., 0., 0.}, odd ? x[8] : 0.);
    }
  };
  const double q = home()(2);
  const std::array<double, 9> ordinary{{q, 0., 0.01, 0.01, 0.01, 0.5, q + 0.03, 0.12, 0.}};
  make(ordinary);
  REQUIRE(certificate.check(plan).isFree());
  int free = 0;
  everyPlace(ordinary, [&](const std::array<double, 9> &x, std::size_t place, std::size_t value) {
    CAPTURE(place, values[value]);
    make(x);
    const vpTrajectoryClearance verdict = certificate.verdict(plan, 0., 0.5, 0., 2000);
    if (verdict.isFree()) {
      ++free;
      vpCollisionData data;
      for (int k = 0; k <= 200; ++k) {
        vpJointVector at(7);
        for (int j = 0; j < 7; ++j) {
          at(j) = plan.at(j, 0.0025 * k)[0];
        }
        scene.place(at, data);
        REQUIRE_FALSE(scene.inCollision(data, 0., 0.0025 * k));
      }
    }
    REQUIRE((std::fabs(values[value]) <= 1e6 || place == 8 || place == 5 || !verdict.isFree()));
  });
  CHECK(free > 20); // zeros and what is next to them
  make(ordinary);
  for (const double time : values) {
    CAPTURE(time);
    const bool good = std::fabs(time) <= 1e6;
    CHECK((good || certificate.check(plan, 0., time).status == vpMotionStatus::BadInput));
    CHECK((good || certificate.check(plan, -time, time).status == vpMotionStatus::BadInput));
    CHECK((good || certificate.check(plan, 0., 0.5, time).status == vpMotionStatus::BadInput));
  }
  // A plan that jumps is no proof for the way of the jump: the hand passes a plate between two places that are free.
  vpCollisionSceneSpec spec;
  vpCollisionObject plate;
  plate.name = "plate";
  plate.shape = vpCollisionShape::box({0.3, 0.002, 0.3});
  vpArmData data;
  vpJointVector turned = home();
  turned(0) += 0.5;
  vpArmKinematics::update(amor(), turned, data);
  plate.pose.p = data.tool.p;
  plate.pose.R = Eigen::AngleAxisd(std::atan2(data.tool.p.y(), data.tool.p.x()), Vector3d::UnitZ()).toRotationMatrix();
  spec.objects.push_back(plate);
  const vpCollisionScene behind(amor(), spec);
  vpCertifiedTrajectory careful(behind);
  vpTrajectoryPlan jump(7);
  for (int j = 0; j < 7; ++j) {
    jump.begin(j, home()(j), vpTrajectoryForm::Direct);
    jump.append(j, {0.}, 0.5);
    jump.finish(j, {home()(j) + (j == 0 ? 1. : 0.), 0., 0., 0.}, 0.);
  }
  CHECK_FALSE(careful.verdict(jump, 0., 1., 0., 5000).isFree());
}

TEST_CASE("The supervisor answers every number with a command within the limits, and touches nothing", "[numbers]")
{
  auto rng = vpTestSupport::generator(981);
  CAPTURE(vpTestSupport::seed());
  vpCollisionSceneSpec spec = everything();
  for (vpCollisionObject &object : spec.objects) {
    object.pose.p *= 0.55; // within reach
  }
  for (int problem = 0; problem < 6; ++problem) {
    vpCollisionScene scene(amor(), spec);
    vpStopSupervisor supervisor(scene);
    vpSupervisedVelocity answer;
    vpJointVector q = home(), command = vpJointVector::Zero(7), aim = command;
    for (int k = 0; k < 600; ++k) {
      for (int j = 0; j < 7 && k % 100 == 0; ++j) {
        aim(j) = uniform(rng, -2., 2.);
      }
      vpJointVector said = q, wish = aim;
      if (problem > 0) {
        mix(rng, wish, 0.01);
        mix(rng, said, problem % 2 == 0 ? 0.01 : 0.);
      }
      const unsigned long before = vpTestSupport::allocationCount();
      supervisor.step(said, wish, answer);
      REQUIRE(vpTestSupport::allocationCount() == before);
      CAPTURE(problem, k, said.transpose(), wish.transpose(), answer.sentence());
      REQUIRE(answer.velocity.size() == 7);
      for (int j = 0; j < 7; ++j) {
        REQUIRE(atMost(answer.velocity(j), amor().velocity()(j)));
        REQUIRE(atMost(answer.velocity(j) - command(j), period * amor().acceleration()(j), 1e-6));
      }
      const bool good = isInRange(said) && wish.allFinite();
      REQUIRE((answer.status == vpSupervision::InvalidInput) == !good);
      command = answer.velocity;
      if (command.norm() > 0. && said == q) {
        vpCollisionSceneSpec now = spec;
        for (int i = 0; i < scene.objectCount(); ++i) {
          now.objects[static_cast<std::size_t>(i)] = scene.object(i);
        }
        for (vpCollisionObject &object : now.objects) { // the independent check knows solids only
          object.shape = object.shape.type() == vpShapeType::Mesh || object.shape.type() == vpShapeType::Octree
                             ? vpCollisionShape::sphere(1e-3)
                             : object.shape;
        }
        now.ground.reset();
        REQUIRE(IndependentClearance(amor(), now).clearance(q, scene.selfPairs(), 0.1) > 0.);
      }
      q += period * command;
      REQUIRE(scene.advance(period));
    }
  }
  vpCollisionScene scene(amor(), spec);
  vpStopSupervisor supervisor(scene);
  vpSupervisedVelocity answer;
  everyPlace(vpJointVector(vpJointVector::Constant(7, 0.01)), [&](const vpJointVector &wish, std::size_t, std::size_t) {
    supervisor.reset();
    supervisor.step(home(), wish, answer);
    REQUIRE((answer.velocity.cwiseAbs().array() <= period * amor().acceleration().array() * (1. + 1e-9)).all());
    REQUIRE((wish.allFinite() || answer.status == vpSupervision::InvalidInput));
    REQUIRE((wish.cwiseAbs().maxCoeff() <= 0.02 || answer.status != vpSupervision::Passed));
  });
}

TEST_CASE("Every method commands numbers within the joints' limits, whatever it is told", "[numbers]")
{
  auto rng = vpTestSupport::generator(982);
  CAPTURE(vpTestSupport::seed());
  vpCollisionScene scene(amor(), everything());
  vpJointVector end = home();
  end(0) += 0.6;
  const vpAvoidanceGoal goal = vpAvoidanceGoal::at(amor(), end);
  for (const std::string &name : avoidanceMethodNames()) {
    CAPTURE(name);
    const auto method = makeAvoidanceMethod(name, scene);
    vpAvoidanceOutput output;
    everyPlace(home(), [&](const vpJointVector &q, std::size_t place, std::size_t value) {
      if (!isInRange(q)) {
        CAPTURE(place, values[value]);
        REQUIRE(method->start(q, goal) == vpAvoidanceStatus::InvalidInput);
        method->step(q, output);
        REQUIRE(output.status == vpAvoidanceStatus::InvalidInput);
        REQUIRE(output.velocity.norm() == 0.);
        REQUIRE_FALSE(isWorking(output));
      }
    });
    for (const double value : values) {
      CAPTURE(value);
      vpAvoidanceGoal wild = goal;
      wild.position.y() = value;
      REQUIRE((std::fabs(value) <= vpLargestLength || method->start(home(), wild) == vpAvoidanceStatus::InvalidInput));
      wild = goal;
      wild.q(3) = value;
      REQUIRE(
          (std::fabs(value) <= vpLargestCoordinate || method->start(home(), wild) == vpAvoidanceStatus::InvalidInput));
    }
    REQUIRE(method->start(home(), goal) != vpAvoidanceStatus::InvalidInput);
    vpJointVector q = home(), command = vpJointVector::Zero(7);
    for (int k = 0; k < 400; ++k) {
      vpAvoidanceGoal told = goal;
      mix(rng, told.position, 0.02);
      mix(rng, told.velocity, 0.02);
      method->setGoal(told);
      if (k % 40 == 39) {
        method->look();
      }
      vpJointVector said = q;
      mix(rng, said, 0.004);
      method->step(said, output);
      CAPTURE(k, said.transpose());
      REQUIRE(output.velocity.size() == 7);
      REQUIRE(output.velocity.allFinite());
      REQUIRE((isInRange(said) || output.status == vpAvoidanceStatus::InvalidInput));
      for (int j = 0; j < 7 && name != "potential"; ++j) { // that one has no limits, as printed
        REQUIRE(atMost(output.velocity(j), amor().velocity()(j)));
      }
      // Wild numbers in range may let a step jump; those out of range may not.
      for (int j = 0; j < 7 && name != "potential" && !isInRange(said); ++j) {
        REQUIRE(atMost(output.velocity(j) - command(j), period * amor().acceleration()(j), 1e-6));
      }
      command = output.velocity;
      q += period * command;
      REQUIRE(isInRange(q));
    }
  }
}

TEST_CASE("Weights and blends of wild distances stay within what they blend", "[numbers]")
{
  const vpFieldWeightSpec spec{0.1, 0.1, 0.5};
  for (const double distance : values) {
    CAPTURE(distance);
    for (const vpFieldForm form : {vpFieldForm::Thesis, vpFieldForm::Corrected}) {
      const double w = fieldWeight(spec, form, distance);
      REQUIRE((w >= 0. && w <= 1.));
      REQUIRE((!std::isnan(distance) || w > 0.7)); // as in contact
    }
    const Vector3d task(0.1, -0.2, 0.3);
    const Vector3d radial = blendRadial(spec, distance, Vector3d::UnitX(), 0.2, task);
    REQUIRE((radial.x() >= 0.1 && radial.x() <= 0.2));
    const Vector3d printed = blendAsPrinted(spec, {distance, 0.05}, {0.2, 0.2, 0.2}, task);
    REQUIRE((printed.allFinite() && printed.norm() < 1.));
  }
}

TEST_CASE("Wild sightings and clocks neither break a track nor lose its object", "[numbers]")
{
  auto rng = vpTestSupport::generator(983);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 20; ++problem) {
    CAPTURE(problem);
    vpCollisionScene scene(amor());
    vpObjectTracks tracks;
    vpTrackTestKit::Body body;
    body.p << 0.5, 0., 0.5;
    body.v << 0.1, 0., 0.;
    vpTestSupport::generator(); // streams are independent
    Clock clock(1. / 30.), exposure(1. / 30.);
    for (int k = 0; k < 300; ++k) {
      const double share = k > 20 && k < 240 ? 0.1 : 0.; // what comes first and last is ordinary
      vpObjectSighting sighting = body.seen(exposure.next(rng, 0.), rng);
      const double true_ = sighting.time;
      mix(rng, sighting.pose.p, share);
      sighting.time = mixed(rng, sighting.time, share);
      sighting.positionSigma = mixed(rng, sighting.positionSigma, share);
      sighting.angleSigma = mixed(rng, sighting.angleSigma, share);
      sighting.pose.R(0, 1) = mixed(rng, sighting.pose.R(0, 1), share);
      static_cast<void>(tracks.add(sighting));
      static_cast<void>(tracks.advance(mixed(rng, true_, share)));
      REQUIRE_NOTHROW(tracks.applyTo(scene));
      REQUIRE(tracks.tracks().size() == 1);
      const vpObjectTrack &track = tracks.tracks()[0];
      REQUIRE(track.pose.p.allFinite());
      REQUIRE(track.pose.R.allFinite());
      REQUIRE(std::isfinite(track.positionSigma + track.angleSigma + track.velocitySigma + track.inflation));
      REQUIRE(scene.objectCount() == 1);
      REQUIRE((scene.object(0).pose.p - track.pose.p).norm() == 0.);
      if (k < 299) {
        body.move(1. / 30., 0., 0., rng);
      }
    }
    REQUIRE((scene.object(0).pose.p - body.p).norm() < 0.02);
  }
}

TEST_CASE("A depth image with wild numbers, seen from nowhere, maps nothing that is not there", "[numbers]")
{
  auto rng = vpTestSupport::generator(984);
  CAPTURE(vpTestSupport::seed());
  const vpCollisionScene scene(amor());
  vpCollisionData placed;
  scene.place(home(), placed);
  vpRigidTransform fMc;
  fMc.p << 0., 0., 2.;
  const vpCameraParameters camera(100., 100., 20., 15.);
  vpImage<float> depth(30, 40);
  for (const double value : values) {
    CAPTURE(value);
    vpDepthObstacles obstacles;
    vpRigidTransform wild = fMc;
    wild.p.z() = value;
    depth = 0.5F;
    const vpDepthReport report = obstacles.insert(depth, camera, wild, scene, placed);
    REQUIRE((std::fabs(value) <= vpLargestLength || report.status == vpDepthStatus::BadInput));
    wild = fMc;
    wild.R(0, 0) = value;
    REQUIRE(obstacles.insert(depth, camera, wild, scene, placed).status == vpDepthStatus::BadInput);
  }
  for (int k = 0; k < 10; ++k) {
    vpDepthObstacles obstacles;
    for (unsigned int i = 0; i < depth.getSize(); ++i) {
      depth.bitmap[i] = static_cast<float>(std::clamp(mixed(rng, 0.5, 0.3), -3e38, 3e38));
    }
    static_cast<void>(obstacles.insert(depth, camera, fMc, scene, placed));
    vpCollisionScene filled(amor());
    static_cast<void>(obstacles.applyTo(filled));
    for (int i = 0; i < filled.objectCount(); ++i) {
      for (const vpOctreeCell &cell : filled.object(i).shape.octree().cells()) {
        REQUIRE((cell.centre - fMc.p).norm() < 10.);
      }
    }
  }
}

TEST_CASE("Planners and paths refuse wild configurations in a sentence", "[numbers]")
{
  const vpCollisionScene scene(amor(), everything());
  vpPathPlanner planner(scene);
  vpJointVector end = home();
  end(0) += 0.1;
  REQUIRE(planner.plan(home(), end).status == vpPathStatus::Solved);
  everyPlace(end, [&](const vpJointVector &q, std::size_t place, std::size_t value) {
    if (std::fabs(values[value]) <= 1e-9) {
      return; // small numbers are configurations
    }
    CAPTURE(place, values[value]);
    for (const vpPathResult &result : {planner.plan(home(), q), planner.plan(q, home())}) {
      REQUIRE((result.status == vpPathStatus::BadInput || result.status == vpPathStatus::OutsideLimits));
      REQUIRE_FALSE(result.sentence.empty());
    }
    vpJointPath path;
    path.points = {home(), q};
    REQUIRE_THROWS_AS(vpTimedPath(scene, path), vpException);
    REQUIRE_THROWS_AS(goalConfiguration(scene, q, Vector3d(0.3, 0.3, 0.3), 0.), vpException);
  });
  vpJointPath path;
  CHECK(path.at(0.5).size() == 0);
  path.points = {home(), end};
  const vpTimedPath timed(scene, path);
  for (const double s : values) {
    CAPTURE(s);
    CHECK(path.at(s).allFinite());
    CHECK(std::isfinite(timed.at(0, s)[0]));
  }
}
