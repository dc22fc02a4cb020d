/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The smallest duration against a dense scan over T with an independent oracle: (3.62) in t, sampled, no root finding.
#include "vpTrajectoryTestKit.h"

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
// Does some sample of the motion of duration T exceed a limit? `excess(s, T)` is the largest ratio to a limit at s.
template <typename Excess> class Scan
{
public:
  explicit Scan(Excess excess) : m_excess(excess) {}

  // Largest excess over s: samples, then a ternary search around each good one. Stops early at a clear violation.
  double worst(double T)
  {
    // Where the last T failed this one usually fails too.
    const double again = m_excess(m_last, T);
    if (again > 1. + 1e-6) {
      return again;
    }
    double best = -1.;
    for (int i = 0; i <= samples; ++i) {
      m_sampled[i] = m_excess(static_cast<double>(i) / samples, T);
      if (m_sampled[i] > best) {
        best = m_sampled[i];
        m_last = static_cast<double>(i) / samples;
      }
    }
    const double good = 0.99 * best;
    for (int i = 0; i <= samples && best < 1. + 1e-6; ++i) {
      const bool peak =
          (i == 0 || m_sampled[i] >= m_sampled[i - 1]) && (i == samples || m_sampled[i] >= m_sampled[i + 1]);
      if (peak && m_sampled[i] > good) {
        best = std::max(best, refine(std::max(i - 1., 0.) / samples, std::min(i + 1., 1. * samples) / samples, T));
      }
      // A low peak between two samples, neither of which is one.
      if (i < samples && std::max(m_sampled[i], m_sampled[i + 1]) > 0.999 * best) {
        best = std::max(best, refine(static_cast<double>(i) / samples, (i + 1.) / samples, T));
      }
    }
    return best;
  }

  // The smallest T in [from, to] of `steps` for which no sample exceeds a limit, or infinity.
  double firstFeasible(double from, double to, int steps)
  {
    for (int i = 0; i < steps; ++i) {
      const double T = from * std::pow(to / from, static_cast<double>(i) / steps);
      if (worst(T) <= 1.) {
        return T;
      }
    }
    return none;
  }

private:
  double refine(double l, double r, double T)
  {
    double best = 0.;
    for (int i = 0; i < 60; ++i) {
      const double a = l + (r - l) / 3., b = r - (r - l) / 3., ea = m_excess(a, T), eb = m_excess(b, T);
      (ea < eb ? l : r) = ea < eb ? a : b;
      best = std::max({best, ea, eb});
    }
    return best;
  }

  static constexpr int samples = 128;
  double m_sampled[samples + 1];
  Excess m_excess;
  double m_last = 0.5;
};

// The quintic as the thesis writes it, (3.60) and (3.62), in t.
struct Quintic {
  vpAxisState x, y;
  vpAxisLimits limits;
  double operator()(double s, double T) const
  {
    const double h = y[0] - x[0], t = s * T, T2 = T * T;
    const double a3 = (20. * h - (8. * y[1] + 12. * x[1]) * T - (3. * x[2] - y[2]) * T2) / (2. * T2 * T);
    const double a4 = (-30. * h + (14. * y[1] + 16. * x[1]) * T + (3. * x[2] - 2. * y[2]) * T2) / (2. * T2 * T2);
    const double a5 = (12. * h - 6. * (y[1] + x[1]) * T + (y[2] - x[2]) * T2) / (2. * T2 * T2 * T);
    const double v = x[1] + t * (x[2] + t * (3. * a3 + t * (4. * a4 + t * 5. * a5)));
    const double a = x[2] + t * (6. * a3 + t * (12. * a4 + t * 20. * a5));
    const double j = 6. * a3 + t * (24. * a4 + t * 60. * a5);
    return std::max({std::abs(v) / limits.velocity, std::abs(a) / limits.acceleration, std::abs(j) / limits.jerk});
  }
};

struct Counts {
  int found = 0, infeasible = 0, undecided = 0, disjoint = 0, iterations = 0;
};

template <typename Excess>
void compare(Excess excess, const vpMotionFamily &motion, const vpAxisLimits &limits, double lower, Counts &counts)
{
  Scan<Excess> scan(excess);
  const vpDurationAnswer answer = vpMinimumDuration::solve(motion, limits, lower);
  counts.iterations = std::max(counts.iterations, answer.iterations);
  CAPTURE(answer.T, answer.iterations, lower);
  if (answer.kind == vpDurationAnswer::Kind::Found) {
    ++counts.found;
    const double slack = 1e-9 * std::max(answer.T, 1.);
    const double shorter = scan.firstFeasible(0.01 * lower, answer.T - slack, 150);
    if (shorter < none || scan.worst(answer.T) > 1. + 1e-9 ||
        (answer.T > lower && scan.worst(answer.T - slack) < 1. - 1e-9)) {
      CAPTURE(shorter);
      REQUIRE(shorter == none);
      REQUIRE(scan.worst(answer.T) <= 1. + 1e-9);
      REQUIRE((answer.T == lower || scan.worst(answer.T - slack) >= 1. - 1e-9));
    }
    // Some longer duration is infeasible again: the feasible set is not one interval to infinity.
    const double after = vpMinimumDuration::nextCandidate(motion, limits, 1.5 * answer.T);
    counts.disjoint += after != 1.5 * answer.T ? 1 : 0;
  }
  else if (answer.kind == vpDurationAnswer::Kind::Infeasible) {
    ++counts.infeasible;
    const double feasible = scan.firstFeasible(0.01 * lower, 1000. * lower, 400);
    if (feasible < none) {
      CAPTURE(feasible);
      REQUIRE(feasible == none);
    }
  }
  else {
    ++counts.undecided;
  }
}

void report(const char *name, int count, const Counts &counts)
{
  WARN(name << ", " << count << " problems: found " << counts.found << " (then infeasible again " << counts.disjoint
            << "), proven infeasible " << counts.infeasible << ", undecided " << counts.undecided << ", at most "
            << counts.iterations << " iterations");
}
} // namespace

TEST_CASE("no shorter duration exists than the one found", "[minimum]")
{
  CAPTURE(vpTestSupport::seed());
  const int count = vpTestSupport::longer(100000);
  const char *names[] = {"rest to rest", "retarget mid-motion", "any to rest", "any to any"};
  for (int jerk = 0; jerk < 2; ++jerk) {
    for (int kind = 0; kind < 4; ++kind) {
      auto rng = vpTestSupport::generator(static_cast<unsigned int>(20 + 4 * jerk + kind));
      Counts counts;
      for (int k = 0; k < count / (1 + 3 * jerk); ++k) {
        const auto input = randomInput<1>(rng, static_cast<Class>(kind), jerk == 1);
        Quintic quintic;
        quintic.x = {input.start.q[0], input.start.v[0], input.start.a[0], 0.};
        quintic.y = {input.goal.q[0], input.goal.v[0], input.goal.a[0], 0.};
        quintic.limits = {input.maxVelocity[0], input.maxAcceleration[0], input.maxJerk[0], -none, none};
        const double lower = vpMinimumDuration::lowerBound(quintic.x, quintic.y, quintic.limits);
        CAPTURE(k, kind, jerk);
        compare(quintic, vpMotionFamily::pointToPoint(quintic.x, quintic.y, 3), quintic.limits, lower, counts);
      }
      report(names[kind], count / (1 + 3 * jerk), counts);
      CHECK(counts.undecided == 0);
      CHECK(counts.found + counts.infeasible == count / (1 + 3 * jerk));
      CHECK((kind == 0) == (counts.infeasible == 0));
      CHECK(counts.iterations <= vpMinimumDuration::maxIterations);
    }
  }
}

TEST_CASE("no shorter duration exists with vias, cubics and septics", "[minimum]")
{
  CAPTURE(vpTestSupport::seed());
  const int count = vpTestSupport::longer(2000);
  for (int kind = 0; kind < 4; ++kind) {
    auto rng = vpTestSupport::generator(static_cast<unsigned int>(30 + kind));
    Counts counts;
    for (int k = 0; k < count; ++k) {
      const auto input = randomInput<1>(rng, k % 2 == 0 ? Class::RestToRest : Class::AnyToRest, false);
      const vpAxisState x{0., input.start.v[0], input.start.a[0], 0.},
          y{input.goal.q[0] - input.start.q[0], 0., 0., 0.};
      const vpAxisLimits limits{input.maxVelocity[0], input.maxAcceleration[0], none, -none, none};
      const double tau = uniform(rng, 0.2, 0.8), place = uniform(rng, -2., 2.);
      const vpAxisState via{place, uniform(rng, -0.9, 0.9) * limits.velocity,
                            uniform(rng, -0.9, 0.9) * limits.acceleration, 0.};
      const vpMotionFamily motions[] = {vpMotionFamily::throughPosition(x, y, place, tau),
                                        vpMotionFamily::throughState(x, y, via, tau),
                                        vpMotionFamily::pointToPoint(x, y, 2), vpMotionFamily::pointToPoint(x, y, 4)};
      const vpMotionFamily &motion = motions[kind];
      const auto excess = [&](double s, double T) {
        double v = 0., a = 0.;
        for (int i = 1; i <= motion.degree(); ++i) {
          double c = 0.;
          for (int m = motion.power(); m >= 0; --m) {
            c = c * T + motion.coefficient(i, m);
          }
          v += i * c * std::pow(s, i - 1);
          a += i > 1 ? i * (i - 1) * c * std::pow(s, i - 2) : 0.;
        }
        return std::max(std::abs(v) / (T * limits.velocity), std::abs(a) / (T * T * limits.acceleration));
      };
      CAPTURE(k, kind);
      compare(excess, motion, limits, vpMinimumDuration::lowerBound(x, y, limits), counts);
    }
    const char *names[] = {"via position (degree 6)", "via state (degree 8)", "cubic", "septic"};
    report(names[kind], count, counts);
    CHECK(counts.undecided <= count / 1000);
  }
}

TEST_CASE("a floor and disjoint feasible sets", "[minimum]")
{
  // From the thesis's figure 6.3, later: infeasible for every T between t = 0.517 and 0.937.
  vpTrajectoryInput<1> first;
  first.goal.q[0] = 0.5;
  first.maxVelocity[0] = 0.5;
  first.maxAcceleration[0] = none;
  vpTrajectoryPlan plan(1);
  REQUIRE(vpDirectTrajectory<1>::calculate(first, plan).isGood());
  const auto kindAt = [&](double t) {
    const vpAxisLimits limits{0.5, none, none, -none, none};
    const vpAxisState x = plan.at(0, t), y{0.8, 0., 0., 0.};
    return vpMinimumDuration::solve(vpMotionFamily::pointToPoint(x, y, 3), limits,
                                    vpMinimumDuration::lowerBound(x, y, limits))
        .kind;
  };
  CHECK(kindAt(0.515) == vpDurationAnswer::Kind::Found);
  for (double t = 0.518; t < 0.937; t += 0.01) {
    CHECK(kindAt(t) == vpDurationAnswer::Kind::Infeasible);
  }
  CHECK(kindAt(0.938) == vpDurationAnswer::Kind::Found);

  // Fast at the start: feasible for short T, infeasible in between or for good.
  auto rng = vpTestSupport::generator(40);
  CAPTURE(vpTestSupport::seed());
  int islands = 0;
  for (int k = 0; k < 20000; ++k) {
    const auto input = randomInput<1>(rng, Class::AnyToAny, false);
    const vpAxisState x{0., input.start.v[0], input.start.a[0], 0.};
    const vpAxisState y{input.goal.q[0] - input.start.q[0], input.goal.v[0], input.goal.a[0], 0.};
    const vpAxisLimits limits{input.maxVelocity[0], input.maxAcceleration[0], none, -none, none};
    const vpMotionFamily motion = vpMotionFamily::pointToPoint(x, y, 3);
    const vpDurationAnswer a = vpMinimumDuration::solve(motion, limits, vpMinimumDuration::lowerBound(x, y, limits));
    if (a.kind != vpDurationAnswer::Kind::Found) {
      continue;
    }
    for (double factor = 1.02; factor < 3.; factor *= 1.05) {
      const vpDurationAnswer b = vpMinimumDuration::solve(motion, limits, factor * a.T);
      REQUIRE(b.T >= factor * a.T);
      if (b.kind == vpDurationAnswer::Kind::Found && b.T > factor * a.T) {
        ++islands; // a gap, then feasible again
        REQUIRE_FALSE(vpMinimumDuration::isFeasible(motion, limits, factor * a.T));
        REQUIRE_FALSE(vpMinimumDuration::isFeasible(motion, limits, 0.5 * (factor * a.T + b.T)));
        REQUIRE(vpMinimumDuration::isFeasible(motion, limits, b.T));
      }
    }
  }
  CHECK(islands > 100);
}
