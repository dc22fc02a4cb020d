/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpArmsOfTests.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpJointVelocityControl.h>
#include <visp3/simulation/vpArmDrives.h>
#include <visp3/simulation/vpArmPlant.h>

#include <cmath>
#include <iostream>

using namespace vpArmsOfTests;

// Drives that follow joint velocities: better than table 8.1, exact when ideal, safe with bad input.

namespace
{
//! Result of the straight motion of section 8.3.3, to 80 % of the path in 4.5 s and back.
struct Tracking {
  vpJointVector rms = vpJointVector::Zero(7); // rad
  double tool = 0.;                           // m
};

Tracking track(const vpArmDriveSpec &spec)
{
  Tracking result;
  vpArmDrives drives(amor(), spec);
  vpClosedLoopKinematics loop(amor());
  vpClosedLoopState state;
  vpClosedLoopInput input;
  vpClosedLoopOutput output;
  state.q = amor().home();
  vpArmData data, wanted;
  vpArmKinematics::forward(amor(), amor().home(), data);
  const vpRigidTransform start = data.tool;
  const int periods = 2000, half = periods / 2;
  for (int k = 0; k < periods; ++k) {
    const double t = std::min(1., (k < half ? k : periods - 1 - k) / (0.9 * half));
    const double s = t * t * t * (10. - 15. * t + 6. * t * t);
    input.goal = start;
    input.goal.p += 0.8 * s * (Eigen::Vector3d(0.225, 0.93, start.p(2)) - start.p);
    loop.step(input, state, output);
    drives.move(state.velocity, 0.005);
    result.rms += (drives.wanted() - drives.q()).cwiseAbs2();
    vpArmKinematics::forward(amor(), drives.wanted(), wanted);
    vpArmKinematics::forward(amor(), drives.q(), data);
    result.tool = std::max(result.tool, (data.tool.p - wanted.tool.p).norm());
  }
  result.rms = (result.rms / periods).cwiseSqrt();
  return result;
}
} // namespace

TEST_CASE("Joints follow better than in table 8.1 of the thesis", "[drives]")
{
  vpJointVector thesis(7);
  thesis << .0064, .0086, .0052, .0125, .0082, .0085, .0064;
  vpArmDriveSpec plain, compensated, noisy;
  compensated.compensateFriction = noisy.compensateFriction = true;
  noisy.encoderNoise = 2e-5;
  const Tracking a = track(plain), b = track(compensated), c = track(noisy);
  std::cout << "joint rms, mrad: thesis; PD and gravity; with friction compensation; and estimated velocities\n";
  for (int i = 0; i < 7; ++i) {
    std::cout << "q" << i + 1 << ": " << 1e3 * thesis(i) << "; " << 1e3 * a.rms(i) << "; " << 1e3 * b.rms(i) << "; "
              << 1e3 * c.rms(i) << '\n';
    CHECK(a.rms(i) < thesis(i));
    CHECK(b.rms(i) < 0.002);
    CHECK(c.rms(i) < 0.002);
    CHECK(a.rms(i) > b.rms(i)); // friction does hold it back
  }
  std::cout << "tool off by at most, mm: " << 1e3 * a.tool << "; " << 1e3 * b.tool << "; " << 1e3 * c.tool << '\n';
}

TEST_CASE("Ideal drives integrate exactly, and the others come there", "[drives]")
{
  auto rng = vpTestSupport::generator(711);
  CAPTURE(vpTestSupport::seed());
  for (const vpArmModel *model : {&amor(), &sixAxes()}) {
    vpArmDriveSpec ideal;
    ideal.ideal = true;
    vpArmDrives exact(*model, ideal), real(*model);
    const vpJointVector start = configuration(*model, rng, 0.3);
    exact.reset(start);
    real.reset(start);
    vpJointVector way = vpJointVector::Zero(model->size());
    vpJointVector velocity = way;
    for (int k = 0; k < 200; ++k) {
      // Within the acceleration limits, there and back.
      velocity = 0.3 * std::sin(k * pi / 100.) * vpJointVector::Ones(model->size());
      way += 0.005 * velocity;
      exact.move(velocity, 0.005);
      real.move(velocity, 0.005);
      REQUIRE((exact.q() - start - way).cwiseAbs().maxCoeff() < 1e-12);
      REQUIRE((real.wanted() - start - way).cwiseAbs().maxCoeff() < 1e-12);
      REQUIRE((real.q() - real.wanted()).cwiseAbs().maxCoeff() < 0.02);
    }
  }
}

TEST_CASE("The velocity PI holds a velocity against friction and gravity", "[drives]")
{
  vpJointVelocityControlSpec spec;
  spec.kp.resize(7);
  spec.ki.resize(7);
  spec.kp << 40., 40., 30., 30., 8., 5., 3.;
  spec.ki << 400., 400., 300., 300., 120., 80., 50.;
  spec.maxTorque = amor().torque();
  vpJointVelocityControl control(spec);
  vpArmPlant plant(amor());
  vpJointVelocityControl::Input in;
  in.wantedVelocity.resize(7);
  in.wantedVelocity << 0.2, -0.05, 0.1, 0.1, 0.2, 0.1, 0.3;
  in.feedforward.setZero(7);
  vpJointVelocityControl::Output out;
  for (int k = 0; k < 4000; ++k) {
    in.velocity = plant.velocity();
    control.step(in, out);
    plant.step(out.torque, 0.001);
  }
  CAPTURE(plant.velocity().transpose());
  CHECK((plant.velocity() - in.wantedVelocity).cwiseAbs().maxCoeff() < 0.01);
}

TEST_CASE("Drives do not allocate, brake on bad commands, and say what is wrong", "[drives]")
{
  vpArmDriveSpec spec;
  spec.encoderNoise = 1e-5;
  vpArmDrives drives(amor(), spec);
  const vpJointVector velocity = vpJointVector::Constant(7, 0.1);
  drives.move(velocity, 0.005);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 20; ++k) {
    drives.move(velocity, 0.005);
  }
  CHECK(vpTestSupport::allocationCount() == before);
  drives.move(vpJointVector::Constant(7, NAN), 0.005);
  CHECK(drives.command().norm() == 0.);
  drives.move(vpJointVector::Ones(3), 0.005);
  CHECK(drives.command().norm() == 0.);
  CHECK(drives.q().allFinite());

  spec.period = 0.;
  CHECK_THROWS_WITH(vpArmDrives(amor(), spec), Catch::Contains("period of the arm's drives is 0, must be > 0"));
  spec = vpArmDriveSpec();
  spec.kp = vpJointVector::Ones(2);
  CHECK_THROWS_WITH(vpArmDrives(amor(), spec), Catch::Contains("kp of the arm's drives has 2 numbers, must have 7"));
  spec = vpArmDriveSpec();
  spec.kd = vpJointVector::Constant(7, -1.);
  CHECK_THROWS_WITH(vpArmDrives(amor(), spec), Catch::Contains("kd of joint 1 of the joint position control is -1"));
  vpArmSpec massless = amor().spec();
  massless.links[2].hasMass = false;
  CHECK_THROWS_WITH(vpArmDrives(vpArmModel(massless)), Catch::Contains("link3"));
  spec = vpArmDriveSpec();
  spec.ideal = true;
  CHECK_NOTHROW(vpArmDrives(vpArmModel(massless), spec));
}

// The plant against closed forms, against an explicit integration without friction, and at its end stops.

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
