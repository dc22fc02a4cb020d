/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Every problem strictly inside the limits gets a motion that keeps them, to rounding, at its exact extrema.
#include "vpTrajectoryTestKit.h"

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
struct Tally {
  double violation = -1., mismatch = 0., longest = 0.;
  int unanswered = 0, iterations = 0;
  int forms[6] = {};
};

template <int N, typename Make> Tally run(unsigned int stream, int count, Make make)
{
  auto rng = vpTestSupport::generator(stream);
  Tally tally;
  vpTrajectoryPlan plan(N);
  for (int k = 0; k < count; ++k) {
    const auto problem = make(rng, k);
    const vpTrajectoryStatus status = vpDirectTrajectory<N>::calculate(problem, plan);
    const double violation = worstViolation(problem, plan), mismatch = worstMismatch(problem, plan);
    if (status.result != vpTrajectoryResult::Working || !(violation <= 1e-12) || !(mismatch <= 1e-12)) {
      CAPTURE(k, status.message(), vpToString(plan.form()), violation, mismatch, plan.duration());
      CAPTURE(problem.start.q.transpose(), problem.start.v.transpose(), problem.start.a.transpose());
      CAPTURE(problem.goal.q.transpose(), problem.goal.v.transpose(), problem.goal.a.transpose());
      CAPTURE(problem.maxVelocity.transpose(), problem.maxAcceleration.transpose(), problem.maxJerk.transpose());
      CHECK(status.result == vpTrajectoryResult::Working);
      CHECK(violation <= 1e-12);
      REQUIRE(mismatch <= 1e-12);
      ++tally.unanswered;
    }
    tally.violation = std::max(tally.violation, violation);
    tally.mismatch = std::max(tally.mismatch, mismatch);
    tally.iterations = std::max(tally.iterations, plan.iterations());
    ++tally.forms[static_cast<int>(plan.form())];
  }
  return tally;
}

template <int N> void requireAllSafe(unsigned int stream, bool jerk)
{
  const int count = vpTestSupport::longer(100000 / (jerk ? 4 : 1));
  const Tally tally = run<N>(stream, count, [jerk](std::mt19937_64 &rng, int k) {
    auto input = randomInput<N>(rng, static_cast<Class>(k % 4), jerk);
    input.spec.cruise = (k / 4) % 2 == 1;
    return input;
  });
  WARN(N << " axes, " << count << " problems" << (jerk ? " with jerk limits" : "") << ": worst violation "
         << tally.violation << ", worst mismatch " << tally.mismatch << ", at most " << tally.iterations
         << " iterations; direct " << tally.forms[1] << ", cruise " << tally.forms[2] << ", ramped " << tally.forms[3]
         << ", stop and go " << tally.forms[4]);
  CHECK(tally.unanswered == 0);
  CHECK(tally.iterations <= vpMinimumDuration::maxIterations);
  CHECK(tally.forms[3] + tally.forms[4] > count / 10); // the fallback was exercised
}
} // namespace

TEST_CASE("every problem of 1 axis is answered safely", "[safety]")
{
  CAPTURE(vpTestSupport::seed());
  requireAllSafe<1>(10, false);
  requireAllSafe<1>(11, true);
}

TEST_CASE("every problem of 3 axes is answered safely", "[safety]")
{
  CAPTURE(vpTestSupport::seed());
  requireAllSafe<3>(12, false);
  requireAllSafe<3>(13, true);
}

TEST_CASE("every problem of 7 axes is answered safely", "[safety]")
{
  CAPTURE(vpTestSupport::seed());
  requireAllSafe<7>(14, false);
  requireAllSafe<7>(15, true);
}

// The acceleration adds to the velocity while it ramps down: there is no margin to do that gently.
TEST_CASE("a motion next to its velocity limit, with some acceleration left, never exceeds it", "[safety]")
{
  auto rng = vpTestSupport::generator(43);
  CAPTURE(vpTestSupport::seed());
  vpTrajectoryPlan plan(2);
  int stops = 0;
  for (int k = 0; k < vpTestSupport::longer(20000); ++k) {
    auto input = randomInput<2>(rng, Class::RestToRest, false);
    const double v = input.maxVelocity[0], usual = 10. * std::pow(input.maxAcceleration[0], 2) / v;
    const double room = v * logUniform(rng, 1e-12, 1e-3);
    input.start.v[0] = v - room;
    // From a ramp of the usual jerk to one ten thousand times shorter.
    input.start.a[0] = std::min(input.maxAcceleration[0], std::sqrt(2. * usual * room * logUniform(rng, 1., 1e4)));
    input.goal.q[1] = input.start.q[1] + 100. * uniform(rng, -1., 1.);
    const vpTrajectoryStatus status = vpDirectTrajectory<2>::calculate(input, plan);
    CAPTURE(k, status.message(), room / v, input.start.a[0] / input.maxAcceleration[0]);
    REQUIRE(status.result == vpTrajectoryResult::Working);
    REQUIRE(worstViolation(input, plan) <= 1e-12);
    stops += plan.form(0) == vpTrajectoryForm::StopAndGo;
  }
  CHECK(stops > vpTestSupport::longer(20000) / 4);
}
