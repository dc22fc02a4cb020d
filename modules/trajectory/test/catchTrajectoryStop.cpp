/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Where a position limit cannot be kept under a jerk limit: no motion exceeds it by less and keeps the other one.
#include "vpTrajectoryTestKit.h"

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
struct Axis {
  double v, a; // at place 0; the first turn is on the positive side
  double V, A, J;
  double low, high;
};

struct Turn {
  double place = 0.,
         rest = 0.; // where the velocity is zero, and the velocity when the acceleration has been taken back
};

/*
 * The earliest turn of any motion whose velocity never has to go below -floor: an optimal control that looks at nothing
 * but its next step. The jerk is the lowest after which the acceleration can still be taken back in time; the state
 * depends on the jerk monotonically, so that no other motion is below this one at any time. The turn is late by less than
 * what the first step of the opposite jerk takes, v dt.
 */
Turn earliestTurn(const Axis &axis, double floor)
{
  constexpr int steps = 4000;
  double q = 0., v = axis.v, a = axis.a;
  const double dt = (std::abs(a) / axis.J + 2. * v / axis.A + 2. * std::sqrt(v / axis.J)) / steps;
  for (int i = 0; i < 10 * steps && v > 0.; ++i) {
    double next[3] = {q, v, a};
    for (const double j : {std::max(-axis.J, -(axis.A + a) / dt), axis.J}) {
      next[0] = q + dt * (v + dt * (a / 2. + dt * j / 6.));
      next[1] = v + dt * (a + dt * j / 2.);
      next[2] = a + dt * j;
      if (next[2] >= 0. || next[1] - next[2] * next[2] / (2. * axis.J) >= -floor) {
        break;
      }
    }
    q = next[0];
    v = next[1];
    a = next[2];
  }
  return {q, v - a * a / (2. * axis.J)};
}

struct Bound {
  double first = 0.; // nothing that keeps the other place turns below
  double ours = 0.;  // a motion that turns once gets there
  double other = 0.; // lowest place that it needs on the other side
};

/*
 * From a turn with the deceleration b no way back is shorter than 2/3 b^3/J^2 (back to zero velocity at full jerk); with
 * rest at its end it takes (1/3 + 1/sqrt(8)) b^3/J^2, so that there is room for a b that is less by 1.01004, the cube root
 * of the ratio.
 */
Bound leastExcess(const Axis &axis)
{
  const double forced = std::max(0., -(axis.v + axis.a * std::abs(axis.a) / (2. * axis.J)));
  const auto turn = [&](double b) { return earliestTurn(axis, std::max(forced, b * b / (2. * axis.J))).place; };
  const auto way = [&](double b) { return 2. / 3. * b * b * b / (axis.J * axis.J); };
  const double least = std::sqrt(2. * axis.J * forced);
  const double most = std::max(least, std::min(axis.A, std::sqrt(2. * axis.J * axis.V)));
  double low = least, high = most;
  for (int i = 0; i < 25 && turn(most) - way(most) < axis.low; ++i) {
    const double b = 0.5 * (low + high);
    (turn(b) - way(b) < axis.low ? high : low) = b;
  }
  const double b = turn(most) - way(most) < axis.low ? low : most;
  return {turn(b), turn(std::max(least, b / 1.01004)), std::min(axis.low, turn(least) - way(least))};
}

Axis anyAxis(std::mt19937_64 &rng)
{
  Axis x{};
  do {
    x.V = logUniform(rng, 0.3, 3.);
    x.A = logUniform(rng, 0.3, 3.);
    x.J = logUniform(rng, 0.1, 30.);
    x.v = x.V * uniform(rng, 0.02, 0.99);
    x.a = x.A * uniform(rng, -0.99, 0.99);
  } while (std::abs(x.v + x.a * std::abs(x.a) / (2. * x.J)) > 0.99 * x.V);
  const double stop = x.v * x.v / x.A + std::sqrt(x.v * x.v * x.v / x.J);
  x.low = -stop * logUniform(rng, 1e-3, 10.);
  x.high = stop * logUniform(rng, 1e-3, 1.);
  return x;
}

vpTrajectoryInput<1> inputOf(const Axis &axis, double side, double elsewhere)
{
  vpTrajectoryInput<1> input;
  input.start.v[0] = side * axis.v;
  input.start.a[0] = side * axis.a;
  input.goal.q[0] = side * elsewhere;
  input.maxVelocity[0] = axis.V;
  input.maxAcceleration[0] = axis.A;
  input.maxJerk[0] = axis.J;
  input.minPosition[0] = std::min(side * axis.low, side * axis.high);
  input.maxPosition[0] = std::max(side * axis.low, side * axis.high);
  return input;
}

struct Tally {
  int exceeded = 0, bothWays = 0, kept = 0;
  double most = 0.; // over what the earliest turn of any motion needs, relative to it
};

void judge(const Axis &axis, double low, double high, const vpTrajectoryStatus &status, Tally &tally)
{
  const Bound bound = leastExcess(axis);
  const double scale = std::max(high - low, axis.high - axis.low), slack = 2e-3 * scale;
  CAPTURE(axis.v, axis.a, axis.V, axis.A, axis.J, axis.low, axis.high, low, high, bound.first, bound.ours, bound.other);
  CAPTURE(status.message());
  REQUIRE(high <= std::max(axis.high, bound.ours) + slack);
  REQUIRE(low >= bound.other - slack);
  REQUIRE((high > axis.high * (1. + 1e-9) || low < axis.low * (1. + 1e-9)) != status.isGood());
  if (high > axis.high + slack) {
    REQUIRE(high >= bound.first - slack); // or the bound is wrong
    REQUIRE(bound.first > axis.high - slack);
    ++tally.exceeded;
    tally.bothWays += low < axis.low + 1e-6 * scale;
    tally.most = std::max(tally.most, high / bound.first - 1.);
  }
  tally.kept += status.isGood();
}
} // namespace

TEST_CASE("under a jerk limit too, a position limit is exceeded as little as can be", "[stop]")
{
  auto rng = vpTestSupport::generator(60);
  CAPTURE(vpTestSupport::seed());
  Tally tally[3];
  vpTrajectoryPlan plan(1);
  for (int k = 0; k < vpTestSupport::longer(1500); ++k) {
    const Axis axis = anyAxis(rng);
    const double side = k % 2 == 0 ? 1. : -1.;
    const auto extremes = [&](double low, double high) {
      return side > 0. ? std::pair<double, double>(low, high) : std::pair<double, double>(-high, -low);
    };
    vpTrajectoryInput<1> input = inputOf(axis, side, uniform(rng, axis.low, axis.high));
    vpTrajectoryStatus status = vpDirectTrajectory<1>::calculate(input, plan);
    auto x = extremes(plan.peaks(0).minPosition, plan.peaks(0).maxPosition);
    CAPTURE(k, side);
    {
      INFO("from the moving start");
      judge(axis, x.first, x.second, status, tally[0]);
    }

    // Time runs backwards: the same motion leads to a goal that moves. After it the axis coasts; not judged here.
    std::swap(input.start, input.goal);
    input.goal.v[0] = -input.goal.v[0];
    status = vpDirectTrajectory<1>::calculate(input, plan);
    x = extremes(plan.peaks(0).minPosition, plan.peaks(0).maxPosition);
    const double tiny = 1e-9;
    if (status.isGood() == (x.second <= axis.high * (1. + tiny) && x.first >= axis.low * (1. + tiny))) {
      INFO("to the moving goal");
      judge(axis, x.first, x.second, status, tally[1]);
    }

    // What follows the arrival.
    input = inputOf(axis, side, 0.);
    input.goal = input.start;
    status = vpDirectTrajectory<1>::calculate(input, plan);
    double low = 0., high = 0.;
    for (int i = 0; i < plan.coasting(0); ++i) {
      const vpTrajectorySegment &s = plan.segment(0, plan.segments(0) + i);
      low = std::min(low, s.p.range().min);
      high = std::max(high, s.p.range().max);
    }
    x = extremes(low, high);
    if (status.fault != vpTrajectoryFault::GoalContradiction) {
      INFO("after the arrival");
      judge(axis, x.first, x.second, status, tally[2]);
    }
  }
  for (const Tally &t : tally) {
    WARN(t.exceeded << " exceed, of them " << t.bothWays << " as far as the other limit allows, at most by " << t.most
                    << " more than any motion must; " << t.kept << " keep the limits");
    CHECK(t.exceeded > vpTestSupport::longer(1500) / 10);
  }
  CHECK(tally[0].bothWays > 0);
}

// Item 1 of the problems that were answered wrongly once: v, a at 0.783, the limit at 0.8265.
TEST_CASE("the excess of a stop with a low jerk limit", "[stop]")
{
  const Axis axis{1.566, -2.193, 1.83, 2.975, 1.325, 0.1417 - 0.783, 0.8265 - 0.783};
  const Bound bound = leastExcess(axis), free = leastExcess({axis.v, axis.a, axis.V, axis.A, axis.J, -none, axis.high});
  vpTrajectoryPlan plan(1);
  vpTrajectoryInput<1> input = inputOf(axis, 1., 0.4636 - 0.783);
  CHECK(vpDirectTrajectory<1>::calculate(input, plan).result == vpTrajectoryResult::NoFeasibleDuration);
  CHECK(0.783 + plan.peaks(0).maxPosition == Approx(1.3586).margin(1e-4)); // 1.474 with the hardest stop to rest
  CHECK(plan.peaks(0).maxPosition <= bound.ours + 1e-3);
  CHECK(plan.peaks(0).minPosition >= axis.low - 1e-9);
  // Without the lower limit the velocity limit decides.
  input.minPosition[0] = -none;
  CHECK(vpDirectTrajectory<1>::calculate(input, plan).result == vpTrajectoryResult::NoFeasibleDuration);
  CHECK(plan.peaks(0).maxPosition == Approx(free.first).margin(1e-3));
  CHECK(0.783 + plan.peaks(0).maxPosition == Approx(1.2917).margin(1e-4));
  CHECK(plan.peaks(0).velocity <= 1.83 * (1. + 1e-9));
  CHECK(plan.peaks(0).acceleration <= 2.975 * (1. + 1e-9));
  CHECK(plan.peaks(0).jerk <= 1.325 * (1. + 1e-9));
}
