/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Forms of a user's own: valid ones are used, all others are refused for our motion. A program of its own: they stay.
#include "vpCatch.h"

#include <visp3/core/vpException.h>
#include <visp3/trajectory/vpMotionFamily.h>
#include <visp3/trajectory/vpMotionForm.h>
#include <visp3/trajectory/vpTrajectoryPlanner.h>

#include <algorithm>
#include <cmath>
#include <limits>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using P = vpTrajectoryProblem;
using vpTestSupport::uniform;
constexpr int axes = 3;

enum class Fault {
  None,
  Late,
  Jump,
  Kink,
  Elsewhere,
  TooFast,
  NotANumber,
  Crowded,
  WrongAxis,
  OneShort,
  HighDegree,
  Endless,
  Refuses
};

// One polynomial for each axis with zero jerk at both ends, of the time that suffices from rest; with a fault.
class Smooth : public vpMotionForm
{
public:
  explicit Smooth(Fault fault = Fault::None) : m_fault(fault) {}

  static double duration(const vpTrajectoryProblem &problem, double floor)
  {
    double T = floor; // peaks of the septic: 35/16 h/T, 7.5132 h/T^2, 52.5 h/T^3
    for (int i = 0; i < problem.axes(); ++i) {
      const double h = std::abs(problem.goal(i)[0] - problem.start(i)[0]);
      const vpAxisLimits limits = problem.limits(i);
      T = std::max({T, 35. / 16. * h / limits.velocity, std::sqrt(7.5133 * h / limits.acceleration),
                    std::cbrt(52.5 * h / limits.jerk)});
    }
    return T;
  }

  bool plan(const vpTrajectoryProblem &problem, double floor, Writer &writer) const noexcept override
  {
    const double late = m_fault == Fault::Late ? 0.999 : m_fault == Fault::TooFast ? 0.99 : 1.;
    const double T = late * duration(problem, m_fault == Fault::TooFast ? 0. : floor);
    for (int i = 0; i < problem.axes(); ++i) {
      vpAxisState from = problem.start(i), to = problem.goal(i);
      to[0] -= from[0];
      from[0] = 0.;
      to[0] += m_fault == Fault::Elsewhere && i == 1 ? 1e-6 * to[0] : 0.;
      from[0] += m_fault == Fault::NotANumber ? std::numeric_limits<double>::quiet_NaN() : 0.;
      from[1] += m_fault == Fault::Kink ? 1e-5 : 0.;
      vpPolynomial p = vpMotionFamily::pointToPoint(from, to, 4).at(T);
      const int axis = m_fault == Fault::WrongAxis ? i - 1 : i;
      if (m_fault == Fault::Jump && i == 0) {
        writer.append(i, {0., 0.5 * to[0]}, 1e-12 * T); // as good as a jump
        p = vpMotionFamily::pointToPoint({0.5 * to[0], from[1], from[2], from[3]}, to, 4).at(T);
      }
      for (int k = 0; k < (m_fault == Fault::Crowded ? 40 : 0); ++k) {
        writer.append(i, {0.}, 0.01);
      }
      if (m_fault == Fault::HighDegree) {
        p.setDegree(9);
      }
      const double duration = m_fault == Fault::OneShort && i == 2 ? 0.99 * T
                              : m_fault == Fault::Endless          ? std::numeric_limits<double>::infinity()
                                                                   : T;
      writer.append(axis, p, duration);
    }
    return m_fault != Fault::Refuses;
  }

private:
  Fault m_fault;
};

// At rest or not, with a goal at rest, limits on everything.
vpTrajectoryProblem randomProblem(std::mt19937_64 &rng, bool atRest)
{
  vpTrajectoryProblem problem(axes);
  for (int i = 0; i < axes; ++i) {
    const double v = uniform(rng, 0.2, 2.), a = uniform(rng, 0.5, 5.);
    problem.field(P::MaxVelocity)[i] = v;
    problem.field(P::MaxAcceleration)[i] = a;
    problem.field(P::MaxJerk)[i] = uniform(rng, 5., 50.);
    problem.setStart(i, {uniform(rng, -1., 1.), atRest ? 0. : uniform(rng, -0.3, 0.3) * v,
                         atRest ? 0. : uniform(rng, -0.3, 0.3) * a, 0.});
    problem.field(P::GoalQ)[i] = uniform(rng, -1., 1.);
  }
  const vpTrajectoryContinuity all[] = {vpTrajectoryContinuity::C1, vpTrajectoryContinuity::C2,
                                        vpTrajectoryContinuity::C3};
  problem.spec.continuity = all[static_cast<int>(uniform(rng, 0., 3.))];
  problem.spec.synchronisation = uniform(rng, 0., 1.) < 0.5 ? vpSynchronisation::Time : vpSynchronisation::None;
  return problem;
}

void requireSame(const vpTrajectoryPlan &a, const vpTrajectoryPlan &b)
{
  REQUIRE(a.form() == b.form());
  REQUIRE(a.duration() == b.duration());
  for (int i = 0; i < axes; ++i) {
    for (int k = 0; k <= 20; ++k) {
      REQUIRE(a.at(i, 0.05 * k * a.duration()) == b.at(i, 0.05 * k * b.duration()));
    }
  }
}

const vpMotionForm *smooth()
{
  static const bool added = [] {
    vpMotionForm::add("smooth", "Zero jerk at both ends.", std::make_unique<Smooth>());
    return true;
  }();
  return added ? vpMotionForm::find("smooth") : nullptr;
}
} // namespace

TEST_CASE("a form is used where it is valid, and keeps all limits; else the motion is ours", "[form]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(91);
  vpTrajectoryPlanner planner(axes);
  vpTrajectoryPlan plan(axes), ours(axes);
  int used = 0;
  const int count = vpTestSupport::longer(1000);
  for (int run = 0; run < count; ++run) {
    const bool atRest = run % 2 == 0;
    vpTrajectoryProblem problem = randomProblem(rng, atRest);
    const double floor = uniform(rng, 0., 1.) < 0.5 ? 0. : uniform(rng, 0., 5.);
    CAPTURE(seed, run, floor);
    const vpTrajectoryStatus ourStatus = planner.plan(problem, floor, ours);
    problem.spec.form = smooth();
    const vpTrajectoryStatus status = planner.plan(problem, floor, plan);
    if (plan.form() != vpTrajectoryForm::Own) {
      REQUIRE_FALSE(atRest);
      REQUIRE(status.result == ourStatus.result);
      requireSame(plan, ours);
      continue;
    }
    ++used;
    REQUIRE(status.result == vpTrajectoryResult::Working);
    REQUIRE(plan.duration() >= floor);
    REQUIRE(plan.duration() == Approx(Smooth::duration(problem, floor)));
    for (int i = 0; i < axes; ++i) {
      const vpTrajectoryPeaks peaks = plan.peaks(i);
      REQUIRE(peaks.velocity <= problem.field(P::MaxVelocity)[i] * (1. + 1e-9));
      REQUIRE(peaks.acceleration <= problem.field(P::MaxAcceleration)[i] * (1. + 1e-9));
      REQUIRE((problem.spec.continuity == vpTrajectoryContinuity::C1 || // has no limit on the jerk
               peaks.jerk <= problem.field(P::MaxJerk)[i] * (1. + 1e-9)));
      for (std::size_t k = 0; k < 2; ++k) {
        REQUIRE(std::abs(plan.at(i, 0.)[k] - problem.start(i)[k]) < 1e-9);
        REQUIRE(std::abs(plan.at(i, plan.duration() * (1. - 1e-13))[k] - problem.goal(i)[k]) < 1e-9);
      }
    }
  }
  CHECK(used >= count / 2);
  CHECK(used < count); // moving starts often need more time than from rest
}

TEST_CASE("a form with any fault is refused", "[form]")
{
  const unsigned int seed = vpTestSupport::seed();
  auto rng = vpTestSupport::generator(92);
  vpTrajectoryPlanner planner(axes);
  vpTrajectoryPlan plan(axes), ours(axes);
  for (const Fault fault :
       {Fault::Late, Fault::Jump, Fault::Kink, Fault::Elsewhere, Fault::TooFast, Fault::NotANumber, Fault::Crowded,
        Fault::WrongAxis, Fault::OneShort, Fault::HighDegree, Fault::Endless, Fault::Refuses}) {
    const Smooth form(fault);
    for (int run = 0; run < 100; ++run) {
      vpTrajectoryProblem problem = randomProblem(rng, true);
      problem.spec.synchronisation = vpSynchronisation::Time;
      problem.spec.continuity = run % 2 == 0 ? vpTrajectoryContinuity::C2 : vpTrajectoryContinuity::C3;
      const double floor = fault == Fault::Late ? 20. : 0.;
      CAPTURE(seed, run, static_cast<int>(fault));
      static_cast<void>(planner.plan(problem, floor, ours));
      problem.spec.form = &form;
      REQUIRE(planner.plan(problem, floor, plan).result == vpTrajectoryResult::Working);
      requireSame(plan, ours);
    }
  }
}

TEST_CASE("what a form is not asked for is planned by us", "[form]")
{
  auto rng = vpTestSupport::generator(93);
  vpTrajectoryPlanner planner(axes, 1);
  vpTrajectoryPlan plan(axes, 1);
  const auto formOf = [&](vpTrajectoryProblem problem, double floor) {
    problem.spec.form = smooth();
    static_cast<void>(planner.plan(problem, floor, plan));
    return plan.form();
  };
  const vpTrajectoryProblem plain = randomProblem(rng, true);
  CHECK(formOf(plain, 0.) == vpTrajectoryForm::Own);
  vpTrajectoryProblem other = plain;
  other.spec.synchronisation = vpSynchronisation::Straight;
  CHECK(formOf(other, 0.) != vpTrajectoryForm::Own);
  other = plain;
  other.field(P::GoalV)[1] = 0.1;
  CHECK(formOf(other, 0.) != vpTrajectoryForm::Own);
  other = plain;
  other.setStart(0, {0., 3., 0., 0.}); // above the velocity limit
  CHECK(formOf(other, 0.) != vpTrajectoryForm::Own);
  other = plain;
  other.spec.policy = vpReplanPolicy::FixedArrival; // only at the given time
  other.spec.arrivalTime = 10.;
  CHECK(formOf(other, 10.) == vpTrajectoryForm::Own);
  CHECK(plan.duration() == Approx(10.));
  CHECK(formOf(other, 0.01) != vpTrajectoryForm::Own);
}

TEST_CASE("no plan with a form allocates, and forms are named", "[form][errors]")
{
  using Catch::Contains;
  CHECK_THROWS_WITH(vpMotionForm::find("smoth"), Contains("motion form \"smoth\" is unknown, "));
  static_cast<void>(smooth());
  CHECK(vpMotionForm::names() == std::vector<std::string>{"smooth"});
  CHECK(vpMotionForm::sentence("smooth") == "Zero jerk at both ends.");
  CHECK_THROWS_WITH(vpMotionForm::add("smooth", "Again.", std::make_unique<Smooth>()),
                    "motion form \"smooth\" is registered already");
  CHECK_THROWS_WITH(vpMotionForm::add("none", "Nothing.", nullptr), "motion form \"none\" has no maker");

  auto rng = vpTestSupport::generator(94);
  vpTrajectoryProblem problem = randomProblem(rng, true);
  problem.spec.form = smooth();
  vpTrajectoryPlanner planner(axes);
  vpTrajectoryPlan plan(axes);
  const unsigned long before = vpTestSupport::allocationCount();
  for (int run = 0; run < 100; ++run) {
    static_cast<void>(planner.plan(problem, 0.1 * run, plan));
  }
  CHECK(plan.form() == vpTrajectoryForm::Own);
  if (vpTestSupport::canCountAllocations()) {
    CHECK(vpTestSupport::allocationCount() == before);
  }
}
