/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The plant against closed forms, against an explicit integration without friction, and at its end stops.
#include "vpArmsOfTests.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/simulation/vpArmPlant.h>

#include <cmath>

using namespace vpArmsOfTests;

namespace
{
vpJointVector one(double value) { return vpJointVector::Constant(1, value); }
} // namespace

TEST_CASE("A joint with constant torque speeds up as the closed form says", "[plant]")
{
  const double inertia = 0.5, viscous = 0.8, coulomb = 0.6, torque = 1.7, dt = 1e-4;
  vpArmPlant plant(turntable());
  plant.reset(one(-1.5));
  for (int k = 1; k <= 10000; ++k) {
    plant.step(one(torque), dt);
    const double expected = (torque - coulomb) / viscous * -std::expm1(-viscous / inertia * k * dt);
    REQUIRE(plant.velocity()(0) == Approx(expected).margin(2e-4));
  }
}

TEST_CASE("A joint without torque stops when the closed form says, and stays", "[plant]")
{
  const double inertia = 0.5, viscous = 0.8, coulomb = 0.6, dt = 1e-4;
  vpArmPlant plant(turntable());
  plant.reset(one(-1.5));
  while (plant.velocity()(0) < 1.) {
    plant.step(one(6.), dt);
  }
  const double start = plant.velocity()(0), stop = inertia / viscous * std::log(1. + viscous * start / coulomb);
  int steps = 0;
  for (; plant.velocity()(0) > 0.; ++steps) {
    plant.step(one(0.), dt);
    REQUIRE(steps < 100000);
  }
  CHECK(steps * dt == Approx(stop).epsilon(1e-3));
  const double rest = plant.q()(0);
  for (int k = 0; k < 1000; ++k) {
    plant.step(one(k % 2 == 0 ? 0.59 : -0.59), dt); // below the friction
  }
  CHECK(plant.q()(0) == rest);
  CHECK(plant.velocity()(0) == 0.);
}

TEST_CASE("Loads below the friction move nothing at all, loads above it move that joint", "[plant]")
{
  auto rng = vpTestSupport::generator(701);
  CAPTURE(vpTestSupport::seed());
  vpArmDynamics dynamics(amor());
  for (int problem = 0; problem < 100; ++problem) {
    const vpJointVector q = configuration(amor(), rng, 0.1);
    vpArmPlant plant(amor());
    plant.reset(q);
    vpJointVector gravity;
    dynamics.gravity(q, gravity);
    const vpJointVector below = gravity + 0.999 * randomVector(7, rng).cwiseProduct(plant.friction().coulomb);
    for (int k = 0; k < 200; ++k) {
      plant.step(below, 1e-3);
    }
    REQUIRE(plant.q() == q);
    REQUIRE(plant.velocity().norm() == 0.);
    const int joint = problem % 7;
    vpJointVector above = gravity;
    above(joint) += 1.2 * plant.friction().coulomb(joint);
    for (int k = 0; k < 200; ++k) {
      plant.step(above, 1e-3);
    }
    REQUIRE(plant.q()(joint) > q(joint) + 1e-5);
  }
}

TEST_CASE("Without friction the motion is that of the equations of motion", "[plant]")
{
  auto rng = vpTestSupport::generator(702);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel *model : {&amor(), &sixAxes()}) {
    vpArmDynamics dynamics(*model);
    for (int problem = 0; problem < 5; ++problem) {
      const int n = model->size();
      const vpJointVector start = configuration(*model, rng, 0.3);
      vpJointMatrix M;
      vpJointVector torque;
      dynamics.inertia(start, M);
      dynamics.gravity(start, torque);
      torque += M * (5. * randomVector(n, rng)); // up to 0.5 rad/s in the end
      vpArmPlant plant(*model, 0.);
      plant.reset(start);
      for (int k = 0; k < 10000; ++k) {
        plant.step(torque, 1e-5);
      }
      // Runge-Kutta of fourth order.
      vpJointVector q = start, v = vpJointVector::Zero(n), a[4];
      const double h = 1e-3;
      for (int k = 0; k < 100; ++k) {
        dynamics.acceleration(q, v, torque, a[0]);
        const vpJointVector v1 = v + 0.5 * h * a[0];
        dynamics.acceleration(q + 0.5 * h * v, v1, torque, a[1]);
        const vpJointVector v2 = v + 0.5 * h * a[1];
        dynamics.acceleration(q + 0.5 * h * v1, v2, torque, a[2]);
        const vpJointVector v3 = v + h * a[2];
        dynamics.acceleration(q + h * v2, v3, torque, a[3]);
        q += h / 6. * (v + 2. * v1 + 2. * v2 + v3);
        v += h / 6. * (a[0] + 2. * a[1] + 2. * a[2] + a[3]);
      }
      CAPTURE(plant.q().transpose(), q.transpose());
      // Semi-implicit Euler errs by half a step times the velocity gained.
      REQUIRE(v.norm() > 0.05);
      REQUIRE((plant.q() - q).cwiseAbs().maxCoeff() < 1e-5);
      REQUIRE((plant.velocity() - v).cwiseAbs().maxCoeff() < 1e-4);
    }
  }
}

TEST_CASE("Nothing goes through an end stop, and it does not hold back the way out", "[plant]")
{
  auto rng = vpTestSupport::generator(703);
  CAPTURE(vpTestSupport::seed());
  vpArmPlant plant(amor());
  vpJointVector torque = vpJointVector::Zero(7);
  int touched = 0;
  for (int k = 0; k < 20000; ++k) {
    if (k % 100 == 0) {
      torque = amor().torque().cwiseProduct(randomVector(7, rng));
    }
    plant.step(torque, 1e-3);
    for (int i = 0; i < 7; ++i) {
      REQUIRE(plant.q()(i) <= amor().upper()(i) + 1e-9);
      REQUIRE(plant.q()(i) >= amor().lower()(i) - 1e-9);
      touched += plant.q()(i) > amor().upper()(i) - 1e-9 ? 1 : 0;
    }
  }
  CHECK(touched > 100);

  vpArmPlant table(turntable());
  for (int k = 0; k < 3000; ++k) {
    table.step(one(5.), 1e-3);
  }
  CHECK(table.q()(0) == Approx(2.).margin(1e-12));
  CHECK(table.velocity()(0) == 0.);
  table.step(one(-5.), 1e-3);
  CHECK(table.velocity()(0) == Approx(-4.4e-3 / 0.5).epsilon(2e-3)); // as free as in the middle
}

TEST_CASE("The plant does not allocate, and says what is wrong", "[plant]")
{
  vpArmPlant plant(amor());
  const vpJointVector torque = vpJointVector::Ones(7);
  plant.step(torque, 1e-3);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 100; ++k) {
    plant.step(torque, 1e-3);
  }
  CHECK(vpTestSupport::allocationCount() == before);
  const vpJointVector q = plant.q();
  plant.step(vpJointVector::Constant(7, NAN), 1e-3);
  plant.step(vpJointVector::Ones(6), 1e-3);
  CHECK(plant.q() == q);
  CHECK_THROWS_WITH(vpArmPlant(amor(), -1.), Catch::Contains("frictionScale of the arm's plant is -1, must be >= 0"));
  CHECK_THROWS_WITH(plant.reset(vpJointVector::Zero(3)), Catch::Contains("has 3 numbers, must have 7"));
}
