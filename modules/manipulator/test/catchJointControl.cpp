/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Joint control against its equations. What it does on a plant is tested with the simulated arm.
#include "vpArmTestKit.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpJointPositionControl.h>
#include <visp3/manipulator/vpJointVelocityControl.h>
#include <visp3/manipulator/vpJointVelocityEstimator.h>

#include <iostream>

using namespace vpArmTestKit;

namespace
{
vpJointPositionControlSpec gains(bool friction)
{
  vpJointPositionControlSpec spec;
  spec.kp = vector({400., 400., 300., 300., 120., 80., 50.});
  spec.kd = vector({40., 40., 30., 30., 8., 5., 3.});
  spec.maxTorque = amor().torque();
  spec.compensateFriction = friction;
  spec.friction = vpJointFriction::of(amor());
  return spec;
}
} // namespace

TEST_CASE("PD with gravity is (3.19), within the torque limits", "[control]")
{
  auto rng = vpTestSupport::generator(62);
  CAPTURE(vpTestSupport::seed());
  const vpJointPositionControlSpec spec = gains(true);
  const vpJointPositionControl control(spec);
  for (int problem = 0; problem < 2000; ++problem) {
    vpJointPositionControl::Input in;
    in.q = configuration(amor(), rng);
    in.wantedQ = in.q + 0.1 * randomVector(7, rng);
    in.velocity = randomVector(7, rng);
    in.wantedVelocity = randomVector(7, rng);
    in.feedforward = 20. * randomVector(7, rng);
    vpJointPositionControl::Output out;
    control.step(in, out);
    for (int i = 0; i < 7; ++i) {
      const auto &joint = amor().spec().joints[static_cast<std::size_t>(i)];
      const double expected = spec.kp(i) * (in.wantedQ(i) - in.q(i)) +
                              spec.kd(i) * (in.wantedVelocity(i) - in.velocity(i)) + in.feedforward(i) +
                              joint.viscous * in.wantedVelocity(i) +
                              joint.coulomb * std::tanh(in.wantedVelocity(i) / 0.01);
      REQUIRE(out.torque(i) == Approx(std::min(joint.torque, std::max(-joint.torque, expected))).margin(1e-10));
      REQUIRE((out.saturated >> i & 1U) == (std::fabs(expected) > joint.torque ? 1U : 0U));
    }
  }
}

TEST_CASE("The velocity PI does not wind up", "[control]")
{
  vpJointVelocityControlSpec spec;
  spec.kp = vector({40., 40., 30., 30., 8., 5., 3.});
  spec.ki = vector({400., 400., 300., 300., 120., 80., 50.});
  spec.maxTorque = amor().torque();
  vpJointVelocityControl control(spec);
  vpJointVelocityControl::Input in;
  in.feedforward.setZero(7);
  vpJointVelocityControl::Output out;
  // Blocked: the integral stays where the torque is at its limit.
  in.velocity.setZero(7);
  in.wantedVelocity = vpJointVector::Constant(7, 3.);
  for (int k = 0; k < 10000; ++k) {
    control.step(in, out);
  }
  CHECK(out.saturated == 0x7fU);
  for (int i = 0; i < 7; ++i) {
    CHECK(out.torque(i) == spec.maxTorque(i));
    CHECK(spec.ki(i) * control.integral()(i) <= spec.maxTorque(i) + spec.ki(i) * 0.003);
  }
  in.wantedVelocity = -in.wantedVelocity;
  control.step(in, out);
  CHECK(out.torque(0) < spec.maxTorque(0));
}

TEST_CASE("Estimated velocities are exact in a ramp and quieter than differences", "[control]")
{
  auto rng = vpTestSupport::generator(63);
  CAPTURE(vpTestSupport::seed());
  for (int problem = 0; problem < 200; ++problem) {
    const double bandwidth = uniform(rng, 50., 500.);
    vpJointVelocityEstimator ramp(2, 0.001, bandwidth), bend(2, 0.001, bandwidth);
    const double v = uniform(rng, -2., 2.), a = uniform(rng, -5., 5.);
    for (int k = 0; k <= 2000; ++k) {
      const double t = 0.001 * k;
      static_cast<void>(ramp.step(vector({v * t, 1. - v * t})));
      static_cast<void>(bend.step(vector({v * t + 0.5 * a * t * t, 0.}), vector({a, 0.})));
    }
    REQUIRE(ramp.velocity()(0) == Approx(v).margin(1e-9));
    REQUIRE(ramp.velocity()(1) == Approx(-v).margin(1e-9));
    REQUIRE(bend.velocity()(0) == Approx(v + 2. * a).margin(1e-9));
  }
  std::normal_distribution<double> noise(0., 1e-4);
  vpJointVelocityEstimator estimator(1, 0.001, 100.);
  double sum = 0., differences = 0., before = 0.;
  for (int k = 0; k < 20000; ++k) {
    const double t = 0.001 * k, q = std::sin(t) + noise(rng);
    static_cast<void>(estimator.step(vector({q})));
    if (k > 100) {
      sum += std::pow(estimator.velocity()(0) - std::cos(t), 2);
      differences += std::pow((q - before) / 0.001 - std::cos(t), 2);
    }
    before = q;
  }
  std::cout << "velocity rms at 0.1 mrad of noise: estimated " << std::sqrt(sum / 19899.) << ", by differences "
            << std::sqrt(differences / 19899.) << " rad/s\n";
  CHECK(sum < 0.01 * differences);
}

TEST_CASE("Joint control says what is wrong and does not allocate", "[control]")
{
  vpJointPositionControlSpec spec = gains(false);
  spec.kp(2) = -1.;
  CHECK_THROWS_WITH(vpJointPositionControl(spec),
                    Catch::Contains("kp of joint 3 of the joint position control is -1, must be >= 0 and finite"));
  spec = gains(false);
  spec.kd = vector({1.});
  CHECK_THROWS_WITH(
      vpJointPositionControl(spec),
      Catch::Contains("kd of the joint position control has 1 numbers, must have one for each of 7 joints"));
  spec = gains(true);
  spec.friction.smoothing = 0.;
  CHECK_THROWS_WITH(vpJointPositionControl(spec), Catch::Contains("smoothing of the joint friction is 0, must be > 0"));
  vpJointVelocityControlSpec pi;
  pi.kp = pi.ki = vector({1.});
  pi.maxTorque = vector({0.});
  CHECK_THROWS_WITH(vpJointVelocityControl(pi),
                    Catch::Contains("maxTorque of joint 1 of the joint velocity control is 0, must be > 0"));
  CHECK_THROWS_WITH(vpJointVelocityEstimator(17, 0.001, 10.),
                    Catch::Contains("size of the joint velocity estimator is 17, must be 1 to 16"));
  CHECK_THROWS_WITH(vpJointVelocityEstimator(2, 0.001, -10.),
                    Catch::Contains("bandwidth of the joint velocity estimator is -10"));

  const vpJointPositionControl control(gains(true));
  vpJointPositionControl::Input in;
  in.q = in.velocity = in.wantedQ = in.wantedVelocity = in.feedforward = vpJointVector::Zero(7);
  vpJointPositionControl::Output out;
  pi.kp = pi.ki = pi.maxTorque = vpJointVector::Ones(7);
  vpJointVelocityControl velocity(pi);
  vpJointVelocityControl::Input vin{in.q, in.q, in.q};
  vpJointVelocityControl::Output vout;
  vpJointVelocityEstimator estimator(7, 0.001, 100.);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int k = 0; k < 10; ++k) {
    control.step(in, out);
    velocity.step(vin, vout);
    static_cast<void>(estimator.step(in.q));
  }
  CHECK(vpTestSupport::allocationCount() == before);
  in.q(1) = NAN;
  control.step(in, out);
  CHECK_FALSE(out.valid);
  CHECK(out.torque.norm() == 0.);
  static_cast<void>(estimator.step(in.q));
  CHECK(estimator.velocity().allFinite());
}

TEST_CASE("Torques are bounded, and at the bound the integral does not press on", "[control]")
{
  auto rng = vpTestSupport::generator(82);
  CAPTURE(vpTestSupport::seed());
  int saturated = 0;
  for (int problem = 0; problem < 200; ++problem) {
    vpJointVelocityControlSpec spec;
    spec.kp = spec.ki = vpJointVector::Constant(1, uniform(rng, 0., 50.));
    spec.maxTorque = vpJointVector::Constant(1, uniform(rng, 0.1, 10.));
    vpJointVelocityControl control(spec);
    vpJointVelocityControl::Output out;
    for (int k = 0; k < 200; ++k) {
      const double before = control.integral()(0);
      control.step({randomVector(1, rng), randomVector(1, rng), randomVector(1, rng)}, out);
      REQUIRE(std::fabs(out.torque(0)) <= spec.maxTorque(0));
      if (out.saturated != 0U) {
        ++saturated;
        REQUIRE((control.integral()(0) - before) * out.torque(0) <= 0.);
      }
    }
  }
  CHECK(saturated > 1000);
}
