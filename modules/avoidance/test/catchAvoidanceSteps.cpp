/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// NaN, infinities and overflowing magnitudes as input of every step of the module: each returns a status, and a finite
// command within the limits.
#include "vpCatch.h"
#include "vpIndependentClearance.h"
#include "vpNumbersTestKit.h"
#include "vpTrackTestKit.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpDepthObstacles.h>
#include <visp3/avoidance/vpPotentialField.h>
#include <visp3/avoidance/vpStopSupervisor.h>

using namespace vpAvoidanceTestKit;
using namespace vpWildNumbers;

namespace
{
constexpr double period = 0.005;
} // namespace

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
      CAPTURE(problem, k, said.transpose(), wish.transpose(), answer.message());
      REQUIRE(answer.velocity.size() == 7);
      for (int j = 0; j < 7; ++j) {
        REQUIRE(atMost(answer.velocity(j), amor().velocity()(j)));
        REQUIRE(atMost(answer.velocity(j) - command(j), period * amor().acceleration()(j), 1e-6));
      }
      const bool good = isInRange(said) && wish.allFinite();
      REQUIRE((answer.status == vpSupervision::InvalidInput) == !good);
      REQUIRE(answer.looks <= vpStopSupervisorSpec().looks);
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

TEST_CASE("Every method commands finite numbers within the joints' limits for any input", "[numbers]")
{
  auto rng = vpTestSupport::generator(982);
  CAPTURE(vpTestSupport::seed());
  vpCollisionScene scene(amor(), everything());
  vpJointVector end = home();
  end(0) += 0.6;
  const vpAvoidanceGoal goal = vpAvoidanceGoal::at(amor(), end);
  for (const std::string &name : vpAvoidanceMethodNames()) {
    CAPTURE(name);
    const auto method = vpMakeAvoidanceMethod(name, scene);
    vpAvoidanceOutput output;
    everyPlace(home(), [&](const vpJointVector &q, std::size_t place, std::size_t value) {
      if (!isInRange(q)) {
        CAPTURE(place, values[value]);
        REQUIRE(method->start(q, goal) == vpAvoidanceStatus::InvalidInput);
        method->step(q, output);
        REQUIRE(output.status == vpAvoidanceStatus::InvalidInput);
        REQUIRE(output.velocity.norm() == 0.);
        REQUIRE_FALSE(vpIsWorking(output));
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
      const double w = vpFieldWeight(spec, form, distance);
      REQUIRE((w >= 0. && w <= 1.));
      REQUIRE((!std::isnan(distance) || w > 0.7)); // as in contact
    }
    const Vector3d task(0.1, -0.2, 0.3);
    const Vector3d radial = vpBlendRadial(spec, distance, Vector3d::UnitX(), 0.2, task);
    REQUIRE((radial.x() >= 0.1 && radial.x() <= 0.2));
    const Vector3d printed = vpBlendAsPrinted(spec, {distance, 0.05}, {0.2, 0.2, 0.2}, task);
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

TEST_CASE("A depth image with wild numbers, seen from nowhere, maps nothing that is not there",
          "[numbers][needs-OCTOMAP]")
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
