/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The steps of the simulated arm and stage under NaN, infinities, numbers whose squares overflow and denormals.
#include "vpArmsOfTests.h"
#include "vpCatch.h"
#include "vpWildNumbers.h"

#include <visp3/core/vpException.h>
#include <visp3/simulation/vpArmDrives.h>
#include <visp3/simulation/vpSimulatedArm.h>
#include <visp3/simulation/vpXYStage.h>

using namespace vpArmsOfTests;

namespace
{
constexpr int sequences = 20, steps = 40;
constexpr double share = 0.05; // of wild numbers

vpJointVector wild(std::mt19937_64 &rng, vpJointVector numbers)
{
  vpWildNumbers::mix(rng, numbers, share);
  return numbers;
}

void plant(std::mt19937_64 &rng)
{
  vpArmPlant plant(amor());
  for (int k = 0; k < steps; ++k) {
    const vpJointVector torque = wild(rng, randomVector(7, rng)), q = plant.q();
    const double dt = vpWildNumbers::mixed(rng, 1e-3, share);
    const bool moved = plant.step(torque, dt);
    REQUIRE(vpIsPlausibleForArm(plant.q()));
    REQUIRE(vpIsPlausibleForArm(plant.velocity()));
    REQUIRE((moved || plant.q() == q));
    if (!vpIsPlausibleForArm(torque) || !(dt > 0. && dt <= vpArmPlant::longestStep)) {
      REQUIRE_FALSE(moved);
    }
  }
}

void drives(std::mt19937_64 &rng)
{
  vpArmDriveSpec spec;
  spec.ideal = std::uniform_int_distribution<int>(0, 1)(rng) == 0;
  spec.encoderNoise = 1e-5;
  vpArmDrives drives(amor(), spec);
  for (int k = 0; k < steps; ++k) {
    const vpJointVector velocity = wild(rng, vpJointVector(0.1 * randomVector(7, rng)));
    const double duration = vpWildNumbers::mixed(rng, 5e-3, share);
    const bool good = drives.move(velocity, duration);
    for (const vpJointVector *numbers : {&drives.q(), &drives.velocity(), &drives.wanted(), &drives.measured()}) {
      REQUIRE(vpIsPlausibleForArm(*numbers));
    }
    REQUIRE(drives.torque().allFinite());
    REQUIRE((drives.torque().array().abs() <= amor().torque().array()).all());
    if (!vpIsPlausibleForArm(velocity) || !(duration > 0. && duration <= vpArmDrives::longestMove)) {
      REQUIRE_FALSE(good);
      REQUIRE(drives.command().isZero(0.));
    }
  }
}

void stage(std::mt19937_64 &rng)
{
  vpXYStage stage(vpXYStageSpec::thesis());
  for (int k = 0; k < steps; ++k) {
    const double dt = vpWildNumbers::mixed(rng, 1., share);
    const vpXYStage::Pair force{{vpWildNumbers::mixed(rng, 0.3, share), vpWildNumbers::mixed(rng, 0., share)}};
    const vpXYStage::State before = stage.state();
    try {
      stage.step(dt, force);
      REQUIRE((dt > 0. && dt <= 1e6 && std::fabs(force[0]) <= 1e12 && std::fabs(force[1]) <= 1e12));
    }
    catch (const vpException &) {
      REQUIRE(stage.state().time == before.time);
      REQUIRE(stage.state().position == before.position);
    }
    for (const vpXYStage::Pair *numbers : {&stage.state().position, &stage.state().velocity, &stage.state().force}) {
      REQUIRE(vpWildNumbers::allFinite(*numbers));
    }
  }
}

// Invalid numbers from a program: rejected with a sentence, and time passes as before.
void simulatedArm(std::mt19937_64 &rng)
{
  vpSimulatedArmSpec spec;
  spec.drives.ideal = true;
  vpSimulatedArm robot(amor(), spec);
  robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
  for (int k = 0; k < steps; ++k) {
    vpColVector v(6);
    for (unsigned int i = 0; i < 6; ++i) {
      v[i] = vpWildNumbers::mixed(rng, 0.05, share);
    }
    try {
      robot.setVelocity(vpRobot::CAMERA_FRAME, v);
    }
    catch (const vpException &e) {
      REQUIRE(std::string(e.getMessage()).find("must be finite") != std::string::npos);
    }
    const vpSimulatedArmState state = robot.getState();
    REQUIRE(state.q.allFinite());
    REQUIRE((state.velocity.array().abs() <= amor().velocity().array() * (1. + 1e-9)).all());
  }
  const double before = robot.getState().time;
  robot.wait(0.05);
  REQUIRE(robot.getState().time == Approx(before + 0.05).margin(0.0051));
}

struct Step {
  const char *name;
  void (*run)(std::mt19937_64 &);
};
// Add new classes with a step to this list.
const Step everyStep[] = {
    {"vpArmPlant", plant}, {"vpArmDrives", drives}, {"vpXYStage", stage}, {"vpSimulatedArm", simulatedArm}};
} // namespace

TEST_CASE("Under wild numbers the simulated arm and stage stay where numbers are, and say so", "[wild]")
{
  CAPTURE(vpTestSupport::seed());
  for (const Step &step : everyStep) {
    DYNAMIC_SECTION(step.name)
    {
      for (unsigned int sequence = 0; sequence < static_cast<unsigned int>(sequences); ++sequence) {
        CAPTURE(sequence);
        auto rng = vpTestSupport::generator(950 + sequence);
        step.run(rng);
      }
    }
  }
}

TEST_CASE("Times that would stop the simulated arm's clock or never end are refused", "[wild]")
{
  vpSimulatedArmSpec spec;
  spec.drives.ideal = true;
  vpSimulatedArm robot(amor(), spec);
  for (const double t : vpWildNumbers::values) {
    CAPTURE(t);
    if (!(t > 0. && t <= 1e6)) {
      CHECK_THROWS_WITH(robot.setSamplingTime(t), Catch::Contains("sampling time of the simulated arm is"));
    }
    if (!(t >= 0. && t <= 1e6)) {
      CHECK_THROWS_WITH(robot.wait(t), Catch::Contains("the time to wait is"));
    }
  }
  CHECK(robot.getSamplingTime() == Approx(0.04));
}

TEST_CASE("A goal on a limit by rounding is reached", "[limits]")
{
  vpSimulatedArmSpec spec;
  spec.drives.ideal = true;
  vpSimulatedArm robot(amor(), spec);
  vpJointVector goal = amor().home();
  goal(1) = static_cast<double>(std::nextafter(static_cast<float>(amor().upper()(1)), 10.f));
  REQUIRE(goal(1) > amor().upper()(1));
  vpColVector q(7);
  for (unsigned int i = 0; i < 7; ++i) {
    q[i] = goal(i);
  }
  REQUIRE_NOTHROW(robot.setPosition(vpRobot::JOINT_STATE, q));
  CHECK(robot.getState().q(1) == Approx(amor().upper()(1)).margin(1e-9));
  CHECK(robot.getState().q(1) <= amor().upper()(1) + 1e-12);
}
