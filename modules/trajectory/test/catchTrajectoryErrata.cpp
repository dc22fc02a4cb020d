/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Printed formulas of thesis chapters 3, 6 and 8 on examples where they fail, compared with those used here;
// doc/errata.md.
#include "vpTrajectoryTestKit.h"

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
vpTrajectoryInput<1> moveTo(double goal, double v, double a)
{
  vpTrajectoryInput<1> input;
  input.goal.q[0] = goal;
  input.maxVelocity[0] = v;
  input.maxAcceleration[0] = a;
  return input;
}

// (6.9), with the missing max.
double printedDuration(double h, double v, double a)
{
  return std::max(15. / 8. * h / v, std::sqrt(10. * std::sqrt(3.) / 3. * h / a));
}

// Largest |q^(order)| of a polynomial in t/T by sampling.
double sampledPeak(const vpPolynomial &p, double T, std::size_t order)
{
  double peak = 0.;
  for (int i = 0; i <= 20000; ++i) {
    peak = std::max(peak, std::abs(p.jet(i / 20000.)[order]));
  }
  return peak / std::pow(T, static_cast<double>(order));
}

// Lines 4 to 8 of Algorithm 6.3 with a1..a6 read as a0..a5: the latest root of the acceleration, and its velocity.
double latestExtremum(const vpPolynomial &p, double T)
{
  const auto acceleration = [&](double s) { return p.jet(s)[2]; };
  double latest = 0.;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i) {
    if (acceleration(static_cast<double>(i) / n) * acceleration((i + 1.) / n) < 0.) {
      latest = (i + 0.5) / n;
    }
  }
  return p.jet(latest)[1] / T;
}
} // namespace

TEST_CASE("(3.66): the acceleration peaks at T (1/2 +- sqrt(3)/6), whatever T is", "[errata]")
{
  for (const double T : {0.4, 1., 3.}) {
    const vpPolynomial p = vpMotionFamily::pointToPoint({}, {0.7, 0., 0., 0.}, 3).at(T);
    const double share = 0.5 - std::sqrt(3.) / 6.; // the text prints this number as a time
    CHECK(std::abs(p.jet(share)[2]) / (T * T) == Approx(sampledPeak(p, T, 2)).epsilon(1e-6));
    CHECK(std::abs(p.jet(share)[2]) / (T * T) == Approx(10. * std::sqrt(3.) / 3. * 0.7 / (T * T)));
    if (T > 1.) { // the printed time lies elsewhere
      CHECK(std::abs(p.jet(share / T)[2]) < 0.8 * std::abs(p.jet(share)[2]));
    }
  }
}

TEST_CASE("(6.9) holds from rest to rest only, and for the length of h", "[errata]")
{
  auto rng = vpTestSupport::generator(91);
  CAPTURE(vpTestSupport::seed());
  int broken = 0, longer = 0;
  for (int k = 0; k < 500; ++k) {
    auto input = moveTo(uniform(rng, 0.2, 2.), 1., 2.);
    input.start.v[0] = uniform(rng, -0.9, 0.9);
    const double T = printedDuration(input.goal.q[0], 1., 2.);
    const vpPolynomial p =
        vpMotionFamily::pointToPoint({0., input.start.v[0], 0., 0.}, {input.goal.q[0], 0., 0., 0.}, 3).at(T);
    broken += sampledPeak(p, T, 1) > 1.01 || sampledPeak(p, T, 2) > 2.02;
    vpTrajectoryPlan plan(1);
    REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
    REQUIRE(plan.peaks(0).velocity < 1. + 1e-9);
    REQUIRE(plan.peaks(0).acceleration < 2. + 1e-9);
    longer += plan.duration() < 0.99 * T; // or the printed time is needlessly long
  }
  CHECK(broken > 100);
  CHECK(longer > 100);
  CHECK_FALSE(printedDuration(-0.5, 0.5, 2.) > 0.); // the printed h has a sign
  vpTrajectoryPlan back(1);
  REQUIRE(vpDirectTrajectory<1>::calculate(moveTo(-0.5, 0.5, none), back).isGood());
  CHECK(back.duration() == Approx(1.875));
}

TEST_CASE("(6.10) as printed breaks the limit of acceleration, and its constants are those of one via only", "[errata]")
{
  auto input = moveTo(0.3, none, 1.);
  vpTrajectoryVia<1> via;
  via.tau = 0.5;
  via.q[0] = 0.15;
  via.hasVelocity = via.hasAcceleration = true;
  input.vias.push_back(via);
  vpTrajectoryPlan plan(1);
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.duration() == Approx(3.80782 * std::sqrt(0.3)).epsilon(1e-5));
  const double printed = 2.6925 * 0.3; // alpha_8 h / sqrt(alpha_max)
  const auto at = [&](double T) {
    return sampledPeak(vpMotionFamily::throughState({}, {0.3, 0., 0., 0.}, {0.15, 0., 0., 0.}, 0.5).at(T), T, 2);
  };
  CHECK(at(plan.duration()) == Approx(1.).epsilon(1e-6));
  CHECK(at(printed) > 6.);
  CHECK(at(2.6925 * std::sqrt(0.3)) > 1.9); // nor with the root where it belongs
  input.vias[0].q[0] = 0.25;                // another via needs another constant
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.duration() > 1.2 * 3.80782 * std::sqrt(0.3));
}

TEST_CASE("(8.8) and (8.9) as printed put the via behind the end; one T with a share for the via does not", "[errata]")
{
  const double via = 0.5, goal = 0.2; // the obstacle is passed on its far side
  CHECK(printedDuration(via, 0.5, 2.) > printedDuration(goal, 0.5, 2.));
  auto input = moveTo(goal, 0.5, 2.);
  vpTrajectoryVia<1> between;
  between.tau = 0.5;
  between.q[0] = via;
  input.vias.push_back(between);
  vpTrajectoryPlan plan(1);
  REQUIRE(vpDirectTrajectory<1>::calculate(input, plan).isGood());
  CHECK(plan.viaTime(0) < plan.duration());
  CHECK(plan.at(0, plan.viaTime(0))[0] == Approx(via));
  CHECK(plan.at(0, plan.duration())[0] == Approx(goal));
  CHECK(plan.peaks(0).velocity < 0.5 + 1e-9);
  CHECK(plan.peaks(0).acceleration < 2. + 1e-9);
}

TEST_CASE("Algorithm 6.2: a goal that moves back is an event, and without events the state goes on", "[errata]")
{
  auto input = moveTo(0.5, 0.5, 2.);
  vpDirectTrajectory<1> trajectory;
  vpTrajectoryOutput<1> output;
  int plans = 0;
  for (int i = 0; i < 5000; ++i) {
    const double before = output.state.q[0];
    input.goal.q[0] = i < 600 ? 0.5 : 0.35; // q_s = -0.15: not detected by the printed "q_s > 0"
    static_cast<void>(trajectory.step(input, output, 1e-3));
    plans += output.newPlan;
    if (i > 10 && i < 600) {
      REQUIRE_FALSE(output.newPlan);
      REQUIRE(output.state.q[0] > before); // S_{k+1} outside of the `if`
    }
  }
  CHECK(plans == 2);
  CHECK(output.state.q[0] == 0.35);
}

TEST_CASE("Algorithm 6.3: the latest root is not the largest velocity, and a negative one counts", "[errata]")
{
  auto rng = vpTestSupport::generator(92);
  CAPTURE(vpTestSupport::seed());
  int smaller = 0, negative = 0;
  constexpr int cases = 1000;
  for (int k = 0; k < cases; ++k) {
    const vpAxisState from{0., uniform(rng, -1., 1.), uniform(rng, -1., 1.), 0.};
    const double T = uniform(rng, 0.5, 3.);
    const vpPolynomial p = vpMotionFamily::pointToPoint(from, {uniform(rng, -1., 1.), 0., 0., 0.}, 3).at(T);
    const double peak = sampledPeak(p, T, 1), latest = latestExtremum(p, T);
    REQUIRE(p.derivative().range(0., 1.).peak() / T == Approx(peak).margin(1e-6)); // as used here
    smaller += std::abs(latest) < 0.9 * peak;
    negative += latest < -0.9 * peak; // accepted by the printed v_m > v_max
  }
  // About a sixth of all or more, 167 +- sqrt(n p (1 - p)) = 12: a tenth is more than five deviations off.
  CHECK(smaller > cases / 10);
  CHECK(negative > cases / 10);
}

TEST_CASE("Table A.1: the ratio for the fourth derivative is 2.1875", "[errata]")
{
  const double expected[] = {1.5, 1.875, 2.1875};
  for (int order = 2; order <= 4; ++order) {
    const vpPolynomial p = vpMotionFamily::pointToPoint({}, {1., 0., 0., 0.}, order).at(1.);
    CHECK(sampledPeak(p, 1., 1) == Approx(expected[order - 2]).epsilon(1e-7));
  }
}
