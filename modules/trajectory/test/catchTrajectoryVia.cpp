/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Motions through vias: one polynomial, chains, leg by leg, and vias under way.
#include "vpTrajectoryTestKit.h"

#include <Eigen/Geometry>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
template <int N> vpTrajectoryInput<N> randomVias(std::mt19937_64 &rng, int count, Class kind)
{
  auto input = randomInput<N>(rng, kind, false);
  for (int k = 0; k < count; ++k) {
    vpTrajectoryVia<N> via;
    via.tau = (k + 0.5 + uniform(rng, -0.3, 0.3)) / count;
    via.hasVelocity = uniform(rng, 0., 1.) < 0.4;
    via.hasAcceleration = via.hasVelocity && uniform(rng, 0., 1.) < 0.5;
    for (int i = 0; i < N; ++i) {
      via.q[i] = uniform(rng, -2., 2.);
      via.v[i] = uniform(rng, -0.5, 0.5) * input.maxVelocity[i];
      via.a[i] = via.hasAcceleration ? uniform(rng, -0.5, 0.5) * input.maxAcceleration[i] : 0.;
    }
    input.vias.push_back(via);
  }
  return input;
}

// Rounding error of velocity and acceleration, relative to their limits: Horner's rule rounds by 2 n u of the sum of
// the magnitudes of its terms, and a via near an end makes large terms of different signs.
template <int N> double roundingOf(const vpTrajectoryInput<N> &input, const vpTrajectoryPlan &plan)
{
  double worst = 0.;
  for (int i = 0; i < plan.axes(); ++i) {
    for (int k = 0; k < plan.segments(i); ++k) {
      const vpTrajectorySegment &segment = plan.segment(i, k);
      vpPolynomial p = segment.p;
      double unit = 1.;
      for (const double limit : {input.maxVelocity[i], input.maxAcceleration[i]}) {
        p = p.derivative();
        unit *= segment.duration;
        double terms = 0.;
        for (int j = 0; j <= p.degree(); ++j) {
          terms += std::abs(p[j]);
        }
        worst = std::max(worst, p.degree() * std::numeric_limits<double>::epsilon() * terms / (limit * unit));
      }
    }
  }
  return worst;
}
} // namespace

TEST_CASE("vias are met, joints are C2, limits kept, for any number of vias", "[via]")
{
  auto rng = vpTestSupport::generator(80);
  CAPTURE(vpTestSupport::seed());
  int direct = 0, legs = 0;
  for (int k = 0; k < vpTestSupport::longer(4000); ++k) {
    const int count = 1 + k % 6;
    auto input = randomVias<3>(rng, count, k % 3 == 0 ? Class::AnyToAny : Class::RestToRest);
    vpTrajectoryPlan plan(3);
    const vpTrajectoryStatus status = vpDirectTrajectory<3>::calculate(input, plan);
    CAPTURE(k, count, status.message(), vpToString(plan.form()), plan.duration());
    REQUIRE(status.result == vpTrajectoryResult::Working);
    REQUIRE(worstViolation(input, plan) <= 1e-12 + roundingOf(input, plan));
    REQUIRE(worstMismatch(input, plan) <= 1e-10); // short segments amplify errors at the joints of a chain
    REQUIRE(plan.vias() == count);
    (plan.form() == vpTrajectoryForm::Direct ? direct : legs) += 1;
    for (int v = 0; v < count; ++v) {
      const vpTrajectoryVia<3> &via = input.vias[static_cast<std::size_t>(v)];
      if (plan.form() == vpTrajectoryForm::Direct) {
        REQUIRE(plan.viaTime(v) == Approx(via.tau * plan.duration()).margin(1e-12));
      }
      for (int i = 0; i < 3; ++i) {
        const vpTrajectoryPeaks peaks = plan.peaks(i);
        const double size = 1. + peaks.maxPosition - peaks.minPosition;
        const vpAxisState x = plan.at(i, plan.viaTime(v));
        REQUIRE(std::abs(x[0] - via.q[i]) < 1e-10 * size);
        if (via.hasVelocity) {
          REQUIRE(std::abs(x[1] - via.v[i]) < 1e-9 * input.maxVelocity[i]);
        }
        if (via.hasAcceleration) {
          REQUIRE(std::abs(x[2] - via.a[i]) < 1e-7 * input.maxAcceleration[i]);
        }
      }
    }
  }
  WARN("chains with one duration " << direct << ", leg by leg " << legs);
  CHECK(direct > 500);
  CHECK(legs > 100);
}

TEST_CASE("the chain has the least integrated squared jerk of all chains through the vias", "[via]")
{
  auto rng = vpTestSupport::generator(81);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 200; ++k) {
    vpTrajectoryInput<1> input;
    input.goal.q[0] = 1.;
    input.maxVelocity[0] = input.maxAcceleration[0] = 1e3;
    input.spec.policy = vpReplanPolicy::FixedArrival;
    input.spec.arrivalTime = 2.;
    for (int v = 0; v < 3; ++v) {
      vpTrajectoryVia<1> via;
      via.tau = 0.25 * (v + 1) + uniform(rng, -0.1, 0.1);
      via.q[0] = uniform(rng, -1., 1.);
      input.vias.push_back(via);
    }
    vpTrajectoryPlan plan(1);
    REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
    const double least = plan.peaks(0).squaredJerk;
    for (int v = 0; v < 3; ++v) { // C4 at the joints; any other velocity and acceleration there costs more
      const auto before = plan.segment(0, v).p, after = plan.segment(0, v + 1).p;
      const double l = plan.segment(0, v).duration, r = plan.segment(0, v + 1).duration;
      CHECK(before.jet(1.)[3] / std::pow(l, 3) == Approx(after.jet(0.)[3] / std::pow(r, 3)).epsilon(1e-8).margin(1e-7));
      const double fourthBefore = 24. * before[4] + 120. * before[5], fourthAfter = 24. * after[4];
      CHECK(fourthBefore / std::pow(l, 4) == Approx(fourthAfter / std::pow(r, 4)).epsilon(1e-7).margin(1e-5));
      auto other = input;
      const vpAxisState x = plan.at(0, plan.viaTime(v));
      auto &via = other.vias[static_cast<std::size_t>(v)];
      via.hasVelocity = via.hasAcceleration = true;
      via.v[0] = x[1] + uniform(rng, -0.1, 0.1);
      via.a[0] = x[2] + uniform(rng, -0.1, 0.1);
      vpTrajectoryPlan worse(1);
      REQUIRE(vpDirectTrajectory<1>::calculate(other, worse).isGood());
      REQUIRE(worse.peaks(0).squaredJerk >= least * (1. - 1e-12));
    }
  }
}

TEST_CASE("figure 8.9: the via appears under way and is dropped once passed", "[via]")
{
  vpTrajectoryInput<2> input;
  input.goal.q << 0., 0.3;
  input.maxVelocity.setConstant(0.5);
  input.maxAcceleration.setConstant(2.);
  vpDirectTrajectory<2> trajectory(2, 1);
  vpTrajectoryOutput<2> output;
  Eigen::Vector2d before = Eigen::Vector2d::Zero();
  double closest = 1., jump = 0.;
  int plans = 0;
  for (int i = 0; i < 5000; ++i) {
    if (i == 550) {
      vpTrajectoryVia<2> via;
      via.tau = 0.5;
      via.q << 0.18, 0.15;
      input.vias.push_back(via);
      input.goal.q << 0.125, 0.3;
    }
    if (plans == 2 && output.remaining < 0.3 * output.duration) {
      input.goal.q[0] = 0.13; // a new goal after the via: the via must not return
    }
    static_cast<void>(trajectory.step(input, output, 1e-3));
    plans += output.newPlan;
    closest = std::min(closest, (output.state.q - Eigen::Vector2d(0.18, 0.15)).norm());
    jump = std::max(jump, (output.state.a - before).norm());
    before = output.state.a;
    REQUIRE(output.state.v.cwiseAbs().maxCoeff() <= 0.5 + 1e-12);
    REQUIRE(output.state.a.cwiseAbs().maxCoeff() <= 2. + 1e-12);
    if (plans == 3) {
      REQUIRE(trajectory.plan().vias() == 0);
    }
  }
  CHECK(plans == 3);
  CHECK(closest < 1e-3);
  CHECK(jump < 0.1);
  CHECK((output.state.q - Eigen::Vector2d(0.13, 0.3)).norm() == 0.);
}

TEST_CASE("a new goal before the via keeps the via at its share of what is left", "[via]")
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = 1.;
  vpTrajectoryVia<1> via;
  via.tau = 0.6;
  via.q[0] = 0.9;
  input.vias.push_back(via);
  vpDirectTrajectory<1> trajectory(1, 1);
  vpTrajectoryOutput<1> output;
  static_cast<void>(trajectory.step(input, output, 1e-3));
  const double T = output.duration;
  while (output.time < 0.3 * T) {
    static_cast<void>(trajectory.step(input, output, 1e-3));
  }
  const double done = output.time / T;
  input.goal.q[0] = 1.02;
  static_cast<void>(trajectory.step(input, output, 1e-3));
  REQUIRE(output.newPlan);
  REQUIRE(trajectory.plan().vias() == 1);
  CHECK(trajectory.plan().viaTime(0) / output.duration == Approx((0.6 - done) / (1. - done)).margin(1e-9));
  CHECK(trajectory.plan().at(0, trajectory.plan().viaTime(0))[0] == Approx(0.9).margin(1e-12));
}

TEST_CASE("straight lines from via to via, and a fixed arrival over vias", "[via]")
{
  auto rng = vpTestSupport::generator(82);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 200; ++k) {
    auto input = randomVias<3>(rng, 3, Class::RestToRest);
    for (auto &via : input.vias) {
      via.hasVelocity = via.hasAcceleration = false;
    }
    input.spec.synchronisation = vpSynchronisation::Straight;
    vpTrajectoryPlan plan(3);
    REQUIRE(vpDirectTrajectory<3>::calculate(input, plan).isGood());
    Eigen::Vector3d from = input.start.q;
    double begin = 0.;
    for (int v = 0; v <= 3; ++v) {
      const Eigen::Vector3d to = v < 3 ? input.vias[static_cast<std::size_t>(v)].q : input.goal.q;
      const double end = v < 3 ? plan.viaTime(v) : plan.duration();
      for (int s = 0; s <= 10; ++s) {
        const double t = begin + (end - begin) * s / 10.;
        const Eigen::Vector3d x(plan.at(0, t)[0], plan.at(1, t)[0], plan.at(2, t)[0]);
        REQUIRE((x - from).cross(to - from).norm() < 1e-11);
      }
      from = to;
      begin = end;
    }
    input.spec.policy = vpReplanPolicy::FixedArrival;
    input.spec.arrivalTime = 1.7 * plan.duration();
    REQUIRE(vpDirectTrajectory<3>::calculate(input, plan).isGood());
    CHECK(plan.duration() == Approx(input.spec.arrivalTime).epsilon(1e-9));
  }
}
