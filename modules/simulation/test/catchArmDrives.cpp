/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Drives that follow joint velocities: better than table 8.1, exact when ideal, safe with bad input.
#include "vpArmsOfTests.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpJointVelocityControl.h>
#include <visp3/simulation/vpArmDrives.h>

#include <cmath>
#include <iostream>

using namespace vpArmsOfTests;

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
