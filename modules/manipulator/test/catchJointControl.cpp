/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Joint control on a plant with friction that sticks: KDL's dynamics at 1 kHz, as the design note wants it.
#include "vpArmTestKit.h"
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/manipulator/vpArmDynamics.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/manipulator/vpJointPositionControl.h>
#include <visp3/manipulator/vpJointVelocityControl.h>
#include <visp3/manipulator/vpJointVelocityEstimator.h>

#include <Eigen/Cholesky>

#include <iostream>

using namespace vpArmTestKit;

namespace
{
// Viscous friction implicitly, Coulomb friction as impulses that at most stop a joint: explicit sgn chatters.
class Plant
{
public:
  Plant(const vpArmModel &model, const vpJointVector &start)
    : q(start), v(vpJointVector::Zero(model.size())), m_dynamics(model), m_friction(vpJointFriction::of(model))
  {}
  void step(const vpJointVector &torque, double dt)
  {
    const Eigen::Index n = q.size();
    vpJointMatrix M;
    vpJointVector c, g;
    m_dynamics.inertia(q, M);
    m_dynamics.coriolis(q, v, c);
    m_dynamics.gravity(q, g);
    vpJointMatrix A = M;
    A.diagonal() += dt * m_friction.viscous;
    const vpJointMatrix inverse = A.llt().solve(vpJointMatrix::Identity(n, n));
    v = inverse * (M * v + dt * (torque - c - g));
    vpJointVector impulse = vpJointVector::Zero(n);
    for (int pass = 0; pass < 60; ++pass) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const double most = dt * m_friction.coulomb(i), before = impulse(i);
        impulse(i) = std::min(most, std::max(-most, before + v(i) / inverse(i, i)));
        v -= inverse.col(i) * (impulse(i) - before);
      }
    }
    q += dt * v;
  }
  vpJointVector q, v;

private:
  vpArmDynamics m_dynamics;
  vpJointFriction m_friction;
};

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

// Root of mean square of the joint errors, rad, along the straight move of section 8.3.3 and back.
vpJointVector track(const vpJointPositionControlSpec &spec, bool noisy, double *worstTool)
{
  auto rng = vpTestSupport::generator(61);
  std::normal_distribution<double> noise(0., 2e-5);
  const vpJointPositionControl control(spec);
  vpArmDynamics dynamics(amor());
  vpRedundancySpec redundancy;
  vpClosedLoopKinematics loop(amor(), redundancy);
  vpClosedLoopState state;
  state.q = home();
  vpClosedLoopInput input;
  vpArmData data;
  vpArmKinematics::forward(amor(), home(), data);
  const vpRigidTransform start = data.tool;
  Plant plant(amor(), home());
  vpJointVelocityEstimator estimator(7, 0.001, 300.);
  vpJointPositionControl::Input in;
  vpJointPositionControl::Output out;
  vpJointVector sum = vpJointVector::Zero(7);
  *worstTool = 0.;
  const int steps = 10000;
  for (int k = 0; k < steps; ++k) {
    if (k % 5 == 0) { // kinematics at 200 Hz
      const double t = std::min(1., std::fabs(k < 5000 ? k / 4500. : (9999. - k) / 4500.));
      const double s = t * t * t * (10. - 15. * t + 6. * t * t);
      input.goal = start;
      input.goal.p += 0.8 * s * (Eigen::Vector3d(0.225, 0.93, start.p(2)) - start.p);
      in.wantedQ = state.q;
      vpClosedLoopOutput ignored;
      loop.step(input, state, ignored);
      in.wantedVelocity = state.velocity;
    }
    in.q = plant.q;
    if (noisy) {
      for (int i = 0; i < 7; ++i) {
        in.q(i) += noise(rng);
      }
    }
    in.velocity = noisy ? estimator.step(in.q) : plant.v;
    dynamics.gravity(in.q, in.feedforward);
    control.step(in, out);
    plant.step(out.torque, 0.001);
    in.wantedQ += 0.001 * in.wantedVelocity;
    sum += (in.wantedQ - plant.q).cwiseAbs2();
    vpArmData wanted;
    vpArmKinematics::forward(amor(), in.wantedQ, wanted);
    vpArmKinematics::forward(amor(), plant.q, data);
    *worstTool = std::max(*worstTool, (data.tool.p - wanted.tool.p).norm());
  }
  return (sum / steps).cwiseSqrt();
}
} // namespace

TEST_CASE("Tracking is better than table 8.1", "[control]")
{
  const vpJointVector thesis = vector({.0064, .0086, .0052, .0125, .0082, .0085, .0064});
  double tool = 0., toolCompensated = 0., toolNoisy = 0.;
  const vpJointVector plain = track(gains(false), false, &tool);
  const vpJointVector compensated = track(gains(true), false, &toolCompensated);
  const vpJointVector noisy = track(gains(true), true, &toolNoisy);
  std::cout << "joint rms, rad: thesis; PD and gravity; with friction compensation; and estimated velocities\n";
  for (int i = 0; i < 7; ++i) {
    std::cout << "q" << i + 1 << ": " << thesis(i) << "; " << plain(i) << "; " << compensated(i) << "; " << noisy(i)
              << '\n';
    CHECK(plain(i) < thesis(i));
    CHECK(compensated(i) < 0.002);
    CHECK(noisy(i) < 0.002);
  }
  std::cout << "tool off by at most, m: " << tool << "; " << toolCompensated << "; " << toolNoisy << '\n';
}

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

TEST_CASE("The velocity PI holds a velocity against friction and gravity, and does not wind up", "[control]")
{
  vpJointVelocityControlSpec spec;
  spec.kp = vector({40., 40., 30., 30., 8., 5., 3.});
  spec.ki = vector({400., 400., 300., 300., 120., 80., 50.});
  spec.maxTorque = amor().torque();
  vpJointVelocityControl control(spec);
  Plant plant(amor(), home());
  vpJointVelocityControl::Input in;
  in.wantedVelocity = vector({0.2, -0.05, 0.1, 0.1, 0.2, 0.1, 0.3});
  in.feedforward.setZero(7);
  vpJointVelocityControl::Output out;
  for (int k = 0; k < 4000; ++k) {
    in.velocity = plant.v;
    control.step(in, out);
    plant.step(out.torque, 0.001);
  }
  CAPTURE(plant.v.transpose());
  CHECK((plant.v - in.wantedVelocity).cwiseAbs().maxCoeff() < 0.01);
  // Blocked: the integral stays where the torque is at its limit.
  control.reset();
  in.velocity.setZero();
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
  CHECK_THROWS_WITH(vpJointVelocityEstimator(9, 0.001, 10.),
                    Catch::Contains("size of the joint velocity estimator is 9, must be 1 to 8"));
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
