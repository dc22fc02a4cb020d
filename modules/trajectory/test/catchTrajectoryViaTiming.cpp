/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Vias whose times the planner chooses: how short the motion is, that it keeps its limits, and on the way.
#include "vpTrajectoryTestKit.h"
#include "vpViaProblems.h"

VISP_DIRECT_USING_NAMESPACE
using namespace vpTrajectoryTest;

namespace
{
double median(std::vector<double> x)
{
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), middle, x.end());
  return *middle;
}

template <int N> void requireVias(const vpTrajectoryInput<N> &input, const vpTrajectoryPlan &plan)
{
  REQUIRE(plan.vias() == static_cast<int>(input.vias.size()));
  for (int k = 0; k < plan.vias(); ++k) {
    for (int i = 0; i < plan.axes(); ++i) {
      REQUIRE(std::abs(plan.at(i, plan.viaTime(k))[0] - input.vias[static_cast<std::size_t>(k)].q[i]) < 1e-9);
    }
  }
}

template <int N> vpTrajectoryPlan planned(const vpTrajectoryInput<N> &input)
{
  vpTrajectoryPlan plan(static_cast<int>(input.goal.q.size()));
  const vpTrajectoryStatus status = vpDirectTrajectory<N>::calculate(input, plan);
  CAPTURE(status.message());
  REQUIRE(status.result == vpTrajectoryResult::Working);
  REQUIRE(worstViolation(input, plan) <= 1e-9);
  REQUIRE(worstMismatch(input, plan) <= 1e-8);
  requireVias(input, plan);
  return plan;
}

// Random motions with other numbers of axes, moving ends, jerk limits, groups and vias with velocities.
vpTrajectoryInput<3> randomTask(std::mt19937_64 &rng, int k)
{
  auto input = randomInput<3>(rng, k % 3 == 0 ? Class::AnyToAny : Class::RestToRest, k % 3 == 1);
  if (k % 5 == 0) {
    input.spec.groups[0] =
        vpAxisGroup({0, 1}, 2. * input.maxVelocity.maxCoeff(), 2. * input.maxAcceleration.maxCoeff());
  }
  input.vias.resize(static_cast<std::size_t>(1 + k % 6));
  for (auto &via : input.vias) {
    via.hasVelocity = uniform(rng, 0., 1.) < 0.2;
    for (int i = 0; i < 3; ++i) {
      via.q[i] = uniform(rng, -2., 2.);
      via.v[i] = uniform(rng, -0.5, 0.5) * input.maxVelocity[i];
    }
  }
  return input;
}
} // namespace

TEST_CASE("the peer is the trapezoid on a straight line", "[via]")
{
  Eigen::MatrixXd points(2, 2);
  points << 0., 0., 3., 1.;
  const vpTimeOptimalPath::Spline line(points);
  // Axis 0 alone decides: 3 rad at 2 rad/s and 5 rad/s^2 take 3/2 + 2/5 s.
  CHECK(vpTimeOptimalPath::duration(line, Eigen::Vector2d(2., 9.), Eigen::Vector2d(5., 9.), 4000) ==
        Approx(1.9).epsilon(2e-3));
  CHECK(vpTimeOptimalPath::duration(line, Eigen::Vector2d(99., 9.), Eigen::Vector2d(3., 9.), 4000) ==
        Approx(2.).epsilon(2e-3));
}

TEST_CASE("chosen times of vias against the time-optimal motion along a spline", "[via]")
{
  auto rng = vpTestSupport::generator(83);
  CAPTURE(vpTestSupport::seed());
  for (const int vias : {1, 4, 10}) {
    std::vector<double> chosen, byWay;
    for (int k = 0; k < vpTestSupport::longer(vias == 10 ? 400 : 2000); ++k) {
      auto input = vpViaProblems::random(rng, vias);
      const double peer = vpViaProblems::peerDuration(input, 100);
      const vpTrajectoryPlan plan = planned(input);
      REQUIRE(plan.form() == vpTrajectoryForm::Direct);
      chosen.push_back(plan.duration() / peer);
      vpViaProblems::setTimesByWay(input);
      byWay.push_back(planned(input).duration() / peer);
    }
    WARN(vias << " vias: " << median(chosen) << " times the duration of the peer, by the way " << median(byWay));
    CHECK(median(chosen) <= 1.125);
    CHECK(median(chosen) < median(byWay));
  }
}

TEST_CASE("optimised times and velocities of vias against the time-optimal motion along a spline", "[via]")
{
  auto rng = vpTestSupport::generator(84);
  CAPTURE(vpTestSupport::seed());
  const struct {
    int vias, count;
    double most;
  } cases[] = {{1, 60, 1.10}, {4, 60, 1.07}, {10, 8, 1.03}};
  for (const auto &c : cases) {
    std::vector<double> ratios;
    for (int k = 0; k < c.count; ++k) {
      auto input = vpViaProblems::random(rng, c.vias);
      const double peer = vpViaProblems::peerDuration(input, 100), chosen = planned(input).duration();
      REQUIRE(vpDirectTrajectory<vpViaProblems::axes>::optimiseVias(input).isGood());
      const vpTrajectoryPlan plan = planned(input);
      REQUIRE(plan.form() == vpTrajectoryForm::Direct);
      REQUIRE(plan.duration() <= chosen * (1. + 1e-9));
      ratios.push_back(plan.duration() / peer);
    }
    WARN(c.vias << " vias: " << median(ratios) << " times the duration of the peer");
    CHECK(median(ratios) <= c.most);
  }
}

TEST_CASE("chosen times keep all limits, for any motion", "[via]")
{
  auto rng = vpTestSupport::generator(85);
  CAPTURE(vpTestSupport::seed());
  const int count = vpTestSupport::longer(1500);
  int direct = 0;
  for (int k = 0; k < count; ++k) {
    CAPTURE(k);
    auto input = randomTask(rng, k);
    const vpTrajectoryPlan plan = planned(input);
    direct += plan.form() == vpTrajectoryForm::Direct;
    if (k % 25 == 0) {
      const auto before = input;
      REQUIRE(vpDirectTrajectory<3>::optimiseVias(input).isGood());
      CHECK(planned(input).duration() <= plan.duration() * (1. + 1e-9));
      for (std::size_t v = 0; v < input.vias.size(); ++v) {
        CHECK(input.vias[v].q == before.vias[v].q);
        CHECK((!before.vias[v].hasVelocity || input.vias[v].v == before.vias[v].v));
      }
    }
  }
  WARN("one duration over all vias in " << direct);
  CHECK(2 * direct > count);
}

TEST_CASE("chosen times know no unit and no direction", "[via]")
{
  auto rng = vpTestSupport::generator(86);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 100; ++k) {
    const int vias = 1 + k % 5;
    const auto input = vpViaProblems::random(rng, vias);
    const vpTrajectoryPlan plan = planned(input);
    auto scaled = input, reversed = input; // other unit of length and of time; from the goal to the start
    const double length = std::exp(uniform(rng, -2., 2.)), time = std::exp(uniform(rng, -2., 2.));
    scaled.start.q *= length;
    scaled.goal.q *= length;
    scaled.maxVelocity *= length / time;
    scaled.maxAcceleration *= length / (time * time);
    for (auto &via : scaled.vias) {
      via.q *= length;
    }
    std::swap(reversed.start.q, reversed.goal.q);
    std::reverse(reversed.vias.begin(), reversed.vias.end());
    CHECK(planned(scaled).duration() == Approx(plan.duration() * time).epsilon(1e-9));
    const vpTrajectoryPlan back = planned(reversed);
    CHECK(back.duration() == Approx(plan.duration()).epsilon(1e-9));
    for (int v = 0; v < vias; ++v) {
      CHECK(back.viaTime(v) == Approx(plan.duration() - plan.viaTime(vias - 1 - v)).epsilon(1e-6));
    }
  }
}

TEST_CASE("coincident vias, and vias at the ends", "[via]")
{
  auto rng = vpTestSupport::generator(87);
  CAPTURE(vpTestSupport::seed());
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    auto input = vpViaProblems::random(rng, 1 + k % 4);
    auto &vias = input.vias;
    vias.front().q = k % 2 == 0 ? input.start.q : vias.back().q;
    vias.back().q = k % 3 == 0 ? input.goal.q : vias.front().q;
    if (k % 7 == 0) { // nowhere to go
      input.goal.q = input.start.q;
      for (auto &via : vias) {
        via.q = input.start.q;
      }
    }
    const double T = planned(input).duration();
    REQUIRE(std::isfinite(T));
    REQUIRE(vpDirectTrajectory<vpViaProblems::axes>::optimiseVias(input).isGood());
    REQUIRE(planned(input).duration() <= T * (1. + 1e-9));
  }
}

TEST_CASE("vias that are not valid are refused and stay as they are", "[via]")
{
  const struct {
    void (*spoil)(vpTrajectoryInput<2> &);
    const char *message;
  } cases[] = {
      {[](vpTrajectoryInput<2> &i) { i.vias[1].q[0] = NAN; }, "via 1 has the value nan, must be finite"},
      {[](vpTrajectoryInput<2> &i) { i.vias[0].tau = NAN; }, "tau of via 0 is nan, must be in (0, 1)"},
      {[](vpTrajectoryInput<2> &i) { i.vias[1].tau = 0.5; }, "tau of via 1 is 0.5, must be in (0, 1), or automatic"},
      {[](vpTrajectoryInput<2> &i) { i.maxVelocity[1] = 0.; }, "velocity limit of axis 1 is 0"},
      {[](vpTrajectoryInput<2> &i) { i.vias[0].q.setConstant(none); }, "via 0 has the value inf, must be finite"},
  };
  for (const auto &c : cases) {
    vpTrajectoryInput<2> input;
    input.goal.q << 1., 0.;
    input.vias.resize(2);
    input.vias[1].q << 0.5, 0.5;
    c.spoil(input);
    const double tau = input.vias[0].tau;
    const vpTrajectoryStatus status = vpDirectTrajectory<2>::optimiseVias(input);
    CHECK(status.result == vpTrajectoryResult::InvalidInput);
    CHECK_THAT(status.message(), Catch::Contains(c.message));
    CHECK((input.vias[0].tau == tau || std::isnan(tau)));
    CHECK_FALSE(input.vias[0].hasVelocity);
    vpTrajectoryPlan plan(2);
    CHECK(vpDirectTrajectory<2>::calculate(input, plan).result == vpTrajectoryResult::InvalidInput);
  }
  vpTrajectoryInput<2> none;
  CHECK(vpDirectTrajectory<2>::optimiseVias(none).isGood());
}

TEST_CASE("motions through vias with chosen times are those with these times given, at a rate of replans too", "[via]")
{
  auto rng = vpTestSupport::generator(88);
  CAPTURE(vpTestSupport::seed());
  constexpr double dt = 1e-3;
  using Trajectory = vpDirectTrajectory<vpViaProblems::axes>;
  for (int k = 0; k < 40; ++k) {
    CAPTURE(k);
    const int vias = 1 + k % 4;
    auto input = vpViaProblems::random(rng, vias);
    const vpTrajectoryPlan plan = planned(input);
    if (k % 8 < 4) {
      input.spec.replanPeriod = 0.02;
    }
    auto given = input;
    for (int v = 0; v < vias && vias > 1; ++v) {
      given.vias[static_cast<std::size_t>(v)].tau = plan.viaTime(v) / plan.duration();
    }
    Trajectory trajectory(vpViaProblems::axes, vias), other = trajectory;
    vpTrajectoryOutput<vpViaProblems::axes> output, expected;
    const unsigned long before = vpTestSupport::allocationCount();
    double off = 0., fastest = 0., t = 0.;
    do {
      t += dt;
      static_cast<void>(trajectory.step(input, output, dt));
      static_cast<void>(other.step(given, expected, dt));
      off = std::max(off, (output.state.q - expected.state.q).cwiseAbs().maxCoeff());
      fastest = std::max(fastest, output.state.v.cwiseAbs().maxCoeff());
    } while (vpIsWorking(output.status.result) && t < 60.);
    CHECK(vpTestSupport::allocationCount() == before);
    CHECK(output.status.result == vpTrajectoryResult::Finished);
    CHECK(fastest <= 2. + 1e-9);
    CHECK(off < 1e-6);
    CHECK(t == Approx(plan.duration()).margin(2. * dt));
  }
}

TEST_CASE("another goal on the way: the times of the remaining vias are chosen again", "[via]")
{
  auto rng = vpTestSupport::generator(89);
  CAPTURE(vpTestSupport::seed());
  constexpr double dt = 1e-3;
  for (int k = 0; k < 60; ++k) {
    CAPTURE(k);
    auto input = vpViaProblems::random(rng, 3);
    vpDirectTrajectory<vpViaProblems::axes> trajectory(vpViaProblems::axes, 3);
    vpTrajectoryOutput<vpViaProblems::axes> output;
    static_cast<void>(trajectory.step(input, output, dt));
    const double change = uniform(rng, 0.05, 0.6) * output.duration;
    vpAxisVector<vpViaProblems::axes> last = output.state.v;
    std::vector<double> closest(3, 9.);
    double jump = 0.;
    for (double t = 0.; t < 60. && vpIsWorking(trajectory.step(input, output, dt)); t += dt) {
      if (t < change && t + dt >= change) {
        for (int i = 0; i < vpViaProblems::axes; ++i) {
          input.goal.q[i] = uniform(rng, -1., 1.);
        }
      }
      jump = std::max(jump, (output.state.v - last).cwiseAbs().maxCoeff());
      last = output.state.v;
      for (std::size_t v = 0; v < 3; ++v) {
        closest[v] = std::min(closest[v], (output.state.q - input.vias[v].q).norm());
      }
    }
    CHECK(output.status.result == vpTrajectoryResult::Finished);
    CHECK(output.state.q == input.goal.q);
    CHECK(jump <= 5. * dt * (1. + 1e-6)); // the acceleration is limited
    for (const double distance : closest) {
      CHECK(distance < 2. * std::sqrt(7.) * dt);
    }
  }
}
