/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// For any input: ends are exact, no limit is exceeded without a status that reports it, no axis makes a detour while
// waiting, and everything is finite. Checked from the printed pieces, by definition, independently of the module.
#include "vpTrajectoryTestKit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
// Value of the derivative \e d of c[0] + c[1] t + ..., term by term.
double derivativeAt(const std::vector<double> &c, int d, double t)
{
  long double sum = 0.L, power = 1.L;
  for (std::size_t k = static_cast<std::size_t>(d); k < c.size(); ++k, power *= t) {
    long double factor = c[k];
    for (int i = 0; i < d; ++i) {
      factor *= static_cast<long double>(k) - i;
    }
    sum += factor * power;
  }
  return static_cast<double>(sum);
}

// Sign changes of the derivative \e d in [0, T], by bisection between the sign changes of the next one.
std::vector<double> signChanges(const std::vector<double> &c, int d, double T)
{
  std::vector<double> out;
  if (d + 1 >= static_cast<int>(c.size())) {
    return out;
  }
  std::vector<double> between = signChanges(c, d + 1, T);
  between.push_back(T);
  double from = 0.;
  for (double to : between) {
    const bool rising = derivativeAt(c, d, from) < 0.;
    if (rising != (derivativeAt(c, d, to) < 0.)) {
      double low = from, high = to;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((derivativeAt(c, d, middle) < 0.) == rising ? low : high) = middle;
      }
      out.push_back(0.5 * (low + high));
    }
    from = to;
  }
  return out;
}

// Extremes of one axis over a motion.
struct Extremes {
  double low = std::numeric_limits<double>::infinity();   // Lowest position.
  double high = -std::numeric_limits<double>::infinity(); // Highest position.
  std::array<double, 3> peak{};                           // Largest |v|, |a|, |j|.
  bool finite = true;                                     // All coefficients are finite.

  // Add a piece of duration T: its ends, its exact extrema, and some times in between.
  void include(const std::vector<double> &c, double T)
  {
    for (double x : c) {
      finite = finite && std::isfinite(x);
    }
    for (int d = 0; d <= 3 && finite; ++d) {
      std::vector<double> times = signChanges(c, d + 1, T);
      for (int i = 0; i <= 4; ++i) {
        times.push_back(T * i / 4.);
      }
      for (double t : times) {
        const double x = derivativeAt(c, d, t);
        if (d == 0) {
          low = std::min(low, x);
          high = std::max(high, x);
        }
        else {
          double &most = peak[static_cast<std::size_t>(d) - 1];
          most = std::max(most, std::abs(x));
        }
      }
    }
  }
};

using Input = vpTrajectoryInput<Eigen::Dynamic>;

bool chance(std::mt19937_64 &rng, double p) { return uniform(rng, 0., 1.) < p; }

// One time scale for all, one length scale per axis, both over twelve decades.
Input anyProblem(std::mt19937_64 &rng)
{
  constexpr int counts[] = {1, 1, 1, 2, 3, 7};
  const int n = counts[rng() % 6];
  Input input(n);
  const double second = logUniform(rng, 1e-6, 1e6);
  vpTrajectorySpec &o = input.spec;
  o.continuity = chance(rng, 0.8)   ? vpTrajectoryContinuity::C2
                 : chance(rng, 0.5) ? vpTrajectoryContinuity::C1
                                    : vpTrajectoryContinuity::C3;
  o.synchronisation = chance(rng, 0.7)   ? vpSynchronisation::Time
                      : chance(rng, 0.5) ? vpSynchronisation::Straight
                                         : vpSynchronisation::None;
  o.cruise = chance(rng, 0.5);
  const bool jerk = chance(rng, 0.4), rest = chance(rng, 0.3), outside = chance(rng, 0.2);
  for (int i = 0; i < n; ++i) {
    const double metre = logUniform(rng, 1e-6, 1e6);
    input.maxVelocity[i] = metre / second * logUniform(rng, 0.1, 10.);
    input.maxAcceleration[i] = metre / second / second * logUniform(rng, 0.1, 10.);
    if (jerk) {
      input.maxJerk[i] = input.maxAcceleration[i] / second * logUniform(rng, 0.3, 300.);
    }
    const int without = chance(rng, 0.1) ? 1 + static_cast<int>(rng() % 2) : 0;
    const auto state = [&](vpTrajectoryState<Eigen::Dynamic> &x, double beyond) {
      x.q[i] = metre * uniform(rng, -2., 2.) * (chance(rng, 0.1) ? 1e-3 : 1.);
      x.v[i] = chance(rng, 0.3) ? 0. : input.maxVelocity[i] * uniform(rng, -beyond, beyond);
      x.a[i] = chance(rng, 0.3) ? 0. : input.maxAcceleration[i] * uniform(rng, -beyond, beyond);
      x.j[i] = jerk && chance(rng, 0.5) ? input.maxJerk[i] * uniform(rng, -beyond, beyond) : 0.;
    };
    state(input.start, outside && chance(rng, 0.3) ? 2. : 0.999);
    state(input.goal, 0.999);
    if (rest || chance(rng, 0.4)) {
      input.goal.v[i] = input.goal.a[i] = input.goal.j[i] = 0.;
    }
    if (chance(rng, 0.5)) {
      const double stop = std::pow(input.start.v[i], 2) / input.maxAcceleration[i];
      const double low = std::min(input.start.q[i], input.goal.q[i]);
      const double high = std::max(input.start.q[i], input.goal.q[i]);
      input.minPosition[i] = low - uniform(rng, 0., 1.) * stop - 0.01 * metre * uniform(rng, 0., 1.);
      input.maxPosition[i] = high + uniform(rng, 0., 1.) * stop + 0.01 * metre * uniform(rng, 0., 1.);
      if (outside && chance(rng, 0.3)) { // the limits apply to the goal only
        input.minPosition[i] = input.goal.q[i] - metre * uniform(rng, 0., 0.5);
        input.maxPosition[i] = input.goal.q[i] + metre * uniform(rng, 0.001, 0.5);
      }
    }
    if (without == 1) {
      input.maxVelocity[i] = none;
    }
    else if (without == 2) {
      input.maxAcceleration[i] = none;
    }
  }
  if (chance(rng, 0.2)) {
    o.minimumDuration = second * logUniform(rng, 0.1, 1e3);
  }
  else if (chance(rng, 0.1)) {
    o.policy = vpReplanPolicy::FixedArrival;
    o.arrivalTime = second * logUniform(rng, 0.1, 1e3);
  }
  if (n >= 3 && chance(rng, 0.2)) {
    // Same lengths: the second axis takes the limits of the first.
    for (auto *x : {&input.maxVelocity, &input.maxAcceleration, &input.maxJerk, &input.minPosition, &input.maxPosition,
                    &input.start.q, &input.start.v, &input.start.a, &input.start.j, &input.goal.q, &input.goal.v,
                    &input.goal.a, &input.goal.j}) {
      (*x)[1] = (*x)[0];
    }
    input.start.q[1] += input.goal.q[0];
    input.goal.q[1] -= input.start.q[0];
    input.minPosition[1] = -none;
    input.maxPosition[1] = none;
    o.groups[0] = vpAxisGroup({0, 1}, (std::isfinite(input.maxVelocity[0]) ? 1.5 : 1.) * input.maxVelocity[0],
                              chance(rng, 0.5) ? 1.5 * input.maxAcceleration[0] : none);
  }
  return input;
}

// Distance of the hardest stop from (v, a), with |a| <= A and |j| <= J, by its three phases.
double stopDistance(double v, double a, double A, double J)
{
  double q = 0., furthest = 0.;
  const auto go = [&](double j, double t) {
    for (int i = 1; i <= 200; ++i) {
      const double x = t * i / 200.;
      furthest = std::max(furthest, std::abs(q + x * (v + x * (a / 2. + x * j / 6.))));
    }
    q += t * (v + t * (a / 2. + t * j / 6.));
    v += t * (a + t * j / 2.);
    a += t * j;
  };
  if (std::abs(a) > A) {
    go(-std::copysign(J, a), (std::abs(a) - A) / J);
  }
  const double left = v + a * std::abs(a) / (2. * J); // when the acceleration is taken back at once
  const double side = left > 0. ? -1. : 1.;
  double peak = std::sqrt(std::max(J * std::abs(v) * (side * v < 0. ? 1. : -1.) + 0.5 * a * a, 0.));
  peak = std::max(peak, side * a);
  const double held = std::min(peak, A);
  go(side * J, std::max(held - side * a, 0.) / J);
  if (peak > A) {
    go(0., std::max(std::abs(v) - A * A / (2. * J), 0.) / A);
  }
  go(-side * J, std::abs(a) / J);
  return furthest;
}

double stopTime(double v, double a, double A, double J)
{
  // No stop is slower than taking back the acceleration, then the velocity.
  const double left = std::abs(v + a * std::abs(a) / (2. * J));
  return 2. * std::abs(a) / J + left / A + 2. * A / J + 2. * std::abs(v) / A;
}

struct Limits {
  double v, a, j, low, high;
};

Limits limitsOf(const Input &input, int i)
{
  const bool jerk = input.spec.continuity != vpTrajectoryContinuity::C1;
  return {input.maxVelocity[i], input.maxAcceleration[i], jerk ? input.maxJerk[i] : none, input.minPosition[i],
          input.maxPosition[i]};
}

// Largest relative excess of an axis.
double excessOf(const Extremes &x, const Limits &limits, double place)
{
  return std::max({x.peak[0] / limits.v - 1., x.peak[1] / limits.a - 1., x.peak[2] / limits.j - 1.,
                   (x.high - limits.high) / std::max(place, std::abs(limits.high)),
                   (limits.low - x.low) / std::max(place, std::abs(limits.low))});
}

struct Tally {
  int kept = 0, braking = 0, exceeded = 0, late = 0;
  double ends = 0., excess = -1., detour = 0., silent = 0.;
};

std::string describe(const Input &x)
{
  std::ostringstream s;
  s.precision(17);
  const auto list = [&s](const char *name, const vpAxisVector<Eigen::Dynamic> &v) {
    s << '"' << name << "\":[";
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      s << (i > 0 ? "," : "");
      std::isfinite(v[i]) ? s << v[i] : s << "null";
    }
    s << "],";
  };
  list("q0", x.start.q), list("v0", x.start.v), list("a0", x.start.a), list("j0", x.start.j);
  list("q1", x.goal.q), list("v1", x.goal.v), list("a1", x.goal.a), list("j1", x.goal.j);
  list("v_max", x.maxVelocity), list("a_max", x.maxAcceleration), list("j_max", x.maxJerk);
  list("q_min", x.minPosition), list("q_max", x.maxPosition);
  s << "\"continuity\":\"C" << 1 + static_cast<int>(x.spec.continuity) << "\",\"cruise\":" << x.spec.cruise
    << ",\"synchronisation\":" << static_cast<int>(x.spec.synchronisation) << ",\"floor\":" << x.spec.minimumDuration
    << ",\"arrival\":" << x.spec.arrivalTime << ",\"group\":" << x.spec.groups[0].axes << ','
    << x.spec.groups[0].maxSpeed << ',' << x.spec.groups[0].maxAcceleration;
  return s.str();
}

void judge(const Input &input, const vpTrajectoryPlan &plan, const vpTrajectoryStatus &status, Tally &tally)
{
  const bool silent = status.isGood() && status.result != vpTrajectoryResult::Braking;
  // Braking and hard stops are C2 for every continuity.
  const int n = plan.axes(), order = 2 + static_cast<int>(input.spec.continuity);
  const int given = silent && plan.form() != vpTrajectoryForm::StopAndGo ? order : std::min(order, 3);
  const auto pieces = plan.pieces(), onwards = plan.pieces(1.3 * plan.duration());
  double worst = -1.;
  for (int i = 0; i < n; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    const double q0 = input.start.q[i], q1 = input.goal.q[i], place = std::max(std::abs(q0), std::abs(q1));
    const Limits limits = limitsOf(input, i);
    Extremes x, all;
    x.low = std::min(q0, q1);
    x.high = std::max(q0, q1);
    for (const vpTrajectoryPiece &piece : pieces) {
      if (piece.end <= plan.duration(i) * (1. + 1e-12)) {
        x.include(piece.coefficients[axis], piece.duration);
      }
    }
    for (const vpTrajectoryPiece &piece : onwards) {
      all.include(piece.coefficients[axis], piece.duration);
    }
    REQUIRE(all.finite);
    worst = std::max(worst, onwards.empty() ? -1. : excessOf(all, limits, place));

    // The ends: from the pieces, and from at().
    const bool dropped = status.fault == vpTrajectoryFault::GoalContradiction;
    const double goal[4] = {q1, input.goal.v[i], dropped ? 0. : input.goal.a[i], dropped ? 0. : input.goal.j[i]};
    const double scale[4] = {std::max({place, x.high - x.low}), std::max(x.peak[0], std::abs(goal[1])),
                             std::max(x.peak[1], std::abs(goal[2])), std::max(x.peak[2], std::abs(goal[3]))};
    const vpAxisState end = plan.at(i, plan.duration());
    for (int k = 0; k < given && !pieces.empty() && input.spec.synchronisation != vpSynchronisation::None; ++k) {
      const auto d = static_cast<std::size_t>(k);
      const vpTrajectoryPiece &last = pieces.back();
      const double printed = derivativeAt(last.coefficients[axis], k, last.duration);
      if (!(dropped && k >= 2)) {
        CAPTURE(i, k, printed, goal[k], scale[k], end[d]);
        REQUIRE(std::abs(printed - goal[k]) <= 1e-9 * scale[k]);
        REQUIRE(std::abs(end[d] - goal[k]) <= 1e-9 * scale[k]);
        tally.ends = std::max(tally.ends, std::abs(printed - goal[k]) / (scale[k] + 1e-300));
      }
    }

    // Detours: beyond the braking distance only where that is faster than stopping first.
    const bool defined = std::isfinite(limits.a) && std::isfinite(limits.v) &&
                         input.spec.continuity == vpTrajectoryContinuity::C2 && !input.spec.groups[0].contains(i) &&
                         (plan.form(i) != vpTrajectoryForm::Vias) &&
                         !(input.spec.synchronisation == vpSynchronisation::Straight);
    if (defined && !dropped && plan.segments(i) > 0) {
      const double J = std::min(limits.j, 10. * limits.a * limits.a / limits.v);
      const double out = std::max(std::min(q0, q1) - x.low, x.high - std::max(q0, q1));
      const double d = std::max(stopDistance(input.start.v[i], input.start.a[i], limits.a, J),
                                stopDistance(-input.goal.v[i], input.goal.a[i], limits.a, J));
      if (out > d * (1. + 1e-4) + 1e-12 * place) {
        const double h = std::abs(q1 - q0) + 2. * d;
        const double quintic =
            std::max({1.875 * h / limits.v, std::sqrt(5.7735026919 * h / limits.a), std::cbrt(60. * h / limits.j)});
        const double stopFirst = stopTime(input.start.v[i], input.start.a[i], limits.a, J) +
                                 stopTime(-input.goal.v[i], input.goal.a[i], limits.a, J) + quintic;
        CAPTURE(i, out, d, stopFirst, plan.duration(i), vpToString(plan.form(i)));
        const bool told = !status.isGood() || status.result == vpTrajectoryResult::Braking;
        REQUIRE((told || (plan.form(i) != vpTrajectoryForm::StopAndGo && plan.duration(i) <= stopFirst)));
        tally.detour = std::max(tally.detour, out / d);
      }
    }
  }
  if (silent) {
    REQUIRE(worst <= 1e-9);
    tally.silent = std::max(tally.silent, worst);
  }
  tally.excess = std::max(tally.excess, worst);
  tally.kept += silent;
  tally.braking += status.result == vpTrajectoryResult::Braking;
  tally.late += status.result == vpTrajectoryResult::ArrivalInfeasible;
  tally.exceeded += status.result == vpTrajectoryResult::NoFeasibleDuration;
}
} // namespace

TEST_CASE("any problem: exact ends, limits kept or told, no detours, all finite", "[limits]")
{
  auto rng = vpTestSupport::generator(200);
  CAPTURE(vpTestSupport::seed());
  Tally tally;
  const int count = vpTestSupport::longer(20000);
  for (int k = 0; k < count; ++k) {
    const Input input = anyProblem(rng);
    vpTrajectoryPlan plan(1);
    const vpTrajectoryStatus status = vpDirectTrajectory<Eigen::Dynamic>::calculate(input, plan);
    if (status.fault == vpTrajectoryFault::GoalOutsideGroup || status.fault == vpTrajectoryFault::PositionLimits ||
        status.fault == vpTrajectoryFault::OutOfRange || status.fault == vpTrajectoryFault::GroupLimit) {
      continue;
    }
    CAPTURE(k, status.message(), vpToString(plan.form()), plan.duration(), describe(input));
    REQUIRE(status.result != vpTrajectoryResult::InvalidInput);
    judge(input, plan, status, tally);
  }
  WARN(count << " problems: " << tally.kept << " within the limits, " << tally.braking << " braking, " << tally.exceeded
             << " told to exceed, " << tally.late << " told to be late; ends to " << tally.ends
             << ", largest untold excess " << tally.silent
             << ", largest detour of a motion that is quicker than a stop " << tally.detour << " braking distances");
  CHECK(tally.kept > count / 3);
}
