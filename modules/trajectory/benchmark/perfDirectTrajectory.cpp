/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Planning times, compared with the thesis's iteration, and with Ruckig where VISP_DIRECT_PEER_RUCKIG is its source.
#include "vpBenchmark.h"
#include "../test/vpViaProblems.h"
#include "vpRetargets.h"

#include <visp3/trajectory/vpPoseTrajectory.h>
#include <visp3/trajectory/vpThesisDuration.h>
#include <visp3/trajectory/vpTwistShaper.h>

#include <chrono>
#include <cstdio>

VISP_DIRECT_USING_NAMESPACE
using namespace vpRetargets;

namespace
{
// Fastest motion from (q, v) to rest without a jerk limit: constant acceleration, full speed, constant deceleration.
double leastTime(double q, double v, double goal, double maxVelocity, double maxAcceleration)
{
  const double stop = q + 0.5 * v * std::abs(v) / maxAcceleration, side = goal < stop ? -1. : 1.;
  const double h = side * (goal - q), u = side * v;
  const double top = std::min(maxVelocity, std::sqrt(std::max(maxAcceleration * h + 0.5 * u * u, 0.)));
  const double ends = (2. * top * top - u * u) / (2. * maxAcceleration);
  return (2. * top - u) / maxAcceleration + std::max(h - ends, 0.) / top;
}

// Retargets of 7 axes over moves of every length: what the cruise form gains in time and costs in smoothness.
void forms(benchmark::State &state, bool cruise)
{
  std::mt19937_64 rng(6);
  std::vector<vpTrajectoryProblem> problems;
  std::vector<double> times, jerks;
  vpTrajectoryPlanner planner(7);
  vpTrajectoryPlan plan(7);
  for (int k = 0; k < 5000; ++k) {
    vpTrajectoryInput<7> input;
    const double length = std::pow(10., uniform(rng, -2., 1.));
    for (int i = 0; i < 7; ++i) {
      input.maxVelocity[i] = uniform(rng, 0.5, 2.);
      input.maxAcceleration[i] = uniform(rng, 1., 5.);
      input.start.q[i] = length * uniform(rng, -1., 1.);
      input.start.v[i] = 0.9 * input.maxVelocity[i] * uniform(rng, -1., 1.) * std::min(1., length);
      input.goal.q[i] = length * uniform(rng, -1., 1.);
    }
    input.spec.cruise = cruise;
    vpTrajectoryProblem problem(7);
    static_cast<void>(input.copyTo(problem));
    static_cast<void>(planner.plan(problem, 0., plan));
    double least = 0., jerk = 0., unit = 0.;
    for (int i = 0; i < 7; ++i) {
      least = std::max(least, leastTime(input.start.q[i], input.start.v[i], input.goal.q[i], input.maxVelocity[i],
                                        input.maxAcceleration[i]));
      jerk += plan.peaks(i).squaredJerk;
      unit += std::pow(input.maxAcceleration[i], 3) / input.maxVelocity[i];
    }
    times.push_back(plan.duration() / least);
    jerks.push_back(jerk / unit);
    problems.push_back(problem);
  }
  measure(state, problems.size(),
          [&](std::size_t k) { benchmark::DoNotOptimize(planner.plan(problems[k], 0., plan)); });
  const auto quantile = [](std::vector<double> &x, double p) {
    std::sort(x.begin(), x.end());
    return x[static_cast<std::size_t>(p * static_cast<double>(x.size() - 1))];
  };
  for (const auto &p : {std::pair<const char *, double>{"50", 0.5}, {"95", 0.95}, {"100", 1.}}) {
    state.counters[std::string("time_p") + p.first] = quantile(times, p.second);
    state.counters[std::string("jerk_p") + p.first] = quantile(jerks, p.second);
  }
}

template <int N> void planning(benchmark::State &state, vpTrajectoryForm form, bool jerk = false)
{
  const auto problems = retargets<N>(5000, form, jerk);
  if (problems.empty()) {
    state.SkipWithError("none of the retargets is answered by this form");
    return;
  }
  vpTrajectoryPlanner planner(N);
  vpTrajectoryPlan plan(N);
  int iterations = 0;
  measure(state, problems.size(), [&](std::size_t k) {
    benchmark::DoNotOptimize(planner.plan(problems[k], 0., plan));
    iterations = std::max(iterations, plan.iterations());
  });
  state.counters["iterations"] = iterations;
  state.counters["problems"] = static_cast<double>(problems.size());
}

void planning1(benchmark::State &state, vpTrajectoryForm form, bool jerk) { planning<1>(state, form, jerk); }
void planning7(benchmark::State &state, vpTrajectoryForm form, bool jerk) { planning<7>(state, form, jerk); }

// Retargets of 1 to 16 axes: how the time grows.
template <int N> void retargetOf(benchmark::State &state) { planning<N>(state, vpTrajectoryForm::Hold); }

// Time of a control loop: one cycle of update(), a new goal every 20 cycles.
template <int N> void cycle(benchmark::State &state)
{
  std::mt19937_64 rng(2);
  vpDirectTrajectory<N> trajectory;
  vpTrajectoryInput<N> input;
  vpTrajectoryOutput<N> output;
  int i = 0;
  measure(state, 5000, [&](std::size_t) {
    if (i++ % 20 == 0) {
      for (int axis = 0; axis < N; ++axis) {
        input.goal.q[axis] = uniform(rng, -1., 1.);
      }
    }
    benchmark::DoNotOptimize(trajectory.step(input, output, 1e-3));
  });
}

void sixthOrder(benchmark::State &state)
{
  std::mt19937_64 rng(3);
  std::vector<vpTrajectoryProblem> problems;
  vpTrajectoryPlanner planner(1, 1);
  vpTrajectoryPlan plan(1, 1);
  while (problems.size() < 5000) {
    vpTrajectoryInput<1> input;
    input.goal.q[0] = uniform(rng, -1., 1.);
    vpTrajectoryVia<1> via;
    via.tau = uniform(rng, 0.3, 0.7);
    via.q[0] = uniform(rng, -1., 1.);
    input.vias.push_back(via);
    input.start.v[0] = uniform(rng, -0.3, 0.3);
    input.start.a[0] = uniform(rng, -0.3, 0.3);
    vpTrajectoryProblem problem(1, 1);
    static_cast<void>(input.copyTo(problem));
    static_cast<void>(planner.plan(problem, 0., plan));
    if (plan.form() == vpTrajectoryForm::Direct) {
      problems.push_back(problem);
    }
  }
  int iterations = 0;
  measure(state, problems.size(), [&](std::size_t k) {
    benchmark::DoNotOptimize(planner.plan(problems[k], 0., plan));
    iterations = std::max(iterations, plan.iterations());
  });
  state.counters["iterations"] = iterations;
}

// How vias get their times: in proportion to the way as a user would, by the planner, by a search before the motion.
enum class ViaTimes { ByWay, Chosen, Optimised };

// Plans of 7 axes through vias, their duration over that of TOPP-RA with 100 intervals, its usual number, and converged.
void vias(benchmark::State &state, ViaTimes times)
{
  constexpr int axes = vpViaProblems::axes;
  const int count = static_cast<int>(state.range(0));
  std::mt19937_64 rng(7);
  std::vector<vpTrajectoryProblem> problems;
  std::vector<double> usual, converged, search;
  vpTrajectoryPlanner planner(axes, count);
  vpTrajectoryPlan plan(axes, count);
  const std::size_t number = times != ViaTimes::Optimised ? 500 : (count > 4 ? 10 : 60);
  while (problems.size() < number) {
    auto input = vpViaProblems::random(rng, count);
    const double coarse = vpViaProblems::peerDuration(input, 100), fine = vpViaProblems::peerDuration(input, 1000);
    if (times == ViaTimes::ByWay) {
      vpViaProblems::setTimesByWay(input);
    }
    vpTrajectoryProblem problem(axes, count);
    static_cast<void>(input.copyTo(problem));
    if (times == ViaTimes::Optimised) {
      const auto begin = std::chrono::steady_clock::now();
      planner.optimiseVias(problem);
      search.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    static_cast<void>(planner.plan(problem, 0., plan));
    usual.push_back(plan.duration() / coarse);
    converged.push_back(plan.duration() / fine);
    problems.push_back(problem);
  }
  measure(state, problems.size(),
          [&](std::size_t k) { benchmark::DoNotOptimize(planner.plan(problems[k], 0., plan)); });
  const auto quantile = [](std::vector<double> x, double p) {
    std::sort(x.begin(), x.end());
    return x[static_cast<std::size_t>(p * static_cast<double>(x.size() - 1))];
  };
  state.counters["time_p50"] = quantile(usual, 0.5);
  state.counters["time_p95"] = quantile(usual, 0.95);
  state.counters["time_converged_p50"] = quantile(converged, 0.5);
  if (!search.empty()) {
    state.counters["search_ms"] = quantile(search, 0.5);
  }
}

// The peer itself: TOPP-RA along the spline through the same points.
void viasPeer(benchmark::State &state)
{
  std::mt19937_64 rng(7);
  std::vector<vpTrajectoryInput<vpViaProblems::axes>> inputs;
  for (int k = 0; k < 200; ++k) {
    inputs.push_back(vpViaProblems::random(rng, static_cast<int>(state.range(0))));
  }
  measure(state, inputs.size(),
          [&](std::size_t k) { benchmark::DoNotOptimize(vpViaProblems::peerDuration(inputs[k], 100)); });
}

// Retargets solved by a single polynomial, by (6.6) with its default gains, one axis.
void thesisIteration(benchmark::State &state)
{
  const auto problems = retargets<1>(5000, vpTrajectoryForm::Direct);
  int notConverged = 0, calls = 0;
  measure(state, problems.size(), [&](std::size_t k) {
    const vpTrajectoryProblem &problem = problems[k];
    const vpAxisState from = problem.start(0), to = problem.goal(0);
    const vpMotionFamily motion = vpMotionFamily::pointToPoint(from, to, 3);
    const vpAxisLimits limits = problem.limits(0);
    const double T = std::max(vpMinimumDuration::lowerBound(from, to, limits), 0.1);
    vpDurationAnswer answer = vpThesisDuration::solve(motion, limits, {0.5, 0.1}, T, 2600);
    notConverged += answer.kind != vpDurationAnswer::Kind::Found;
    ++calls;
    benchmark::DoNotOptimize(answer.T);
  });
  state.counters["not_converged_percent"] = 100. * notConverged / calls;
}

void poseRetarget(benchmark::State &state)
{
  vpPoseTrajectory trajectory;
  std::mt19937_64 rng(4);
  std::vector<vpHomogeneousMatrix> goals;
  for (int k = 0; k < 500; ++k) {
    goals.emplace_back(uniform(rng, -0.5, 0.5), uniform(rng, -0.5, 0.5), uniform(rng, -0.5, 0.5), uniform(rng, -1., 1.),
                       uniform(rng, -1., 1.), uniform(rng, -1., 1.));
  }
  measure(state, goals.size(), [&](std::size_t k) {
    static_cast<void>(trajectory.setGoal(goals[k]));
    benchmark::DoNotOptimize(trajectory.step(0.05));
  });
}

void shaperStep(benchmark::State &state)
{
  vpTwistShaper shaper;
  std::mt19937_64 rng(5);
  measure(state, 5000, [&](std::size_t) {
    benchmark::DoNotOptimize(
        shaper.step(vpTwist(uniform(rng, -1., 1.), 0.2, 0.1, uniform(rng, -1., 1.), 0., 0.1), 1e-3));
  });
}
} // namespace

BENCHMARK_CAPTURE(planning1, retarget, vpTrajectoryForm::Hold, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(planning1, retarget_direct, vpTrajectoryForm::Direct, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(planning1, retarget_fallback, vpTrajectoryForm::StopAndGo, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(planning1, retarget_jerk_limits, vpTrajectoryForm::Hold, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(planning7, retarget, vpTrajectoryForm::Hold, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(planning7, retarget_direct, vpTrajectoryForm::Direct, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(planning7, retarget_fallback, vpTrajectoryForm::StopAndGo, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(planning7, retarget_jerk_limits, vpTrajectoryForm::Hold, true)->Unit(benchmark::kMicrosecond);
BENCHMARK(retargetOf<1>)->Unit(benchmark::kMicrosecond);
BENCHMARK(retargetOf<2>)->Unit(benchmark::kMicrosecond);
BENCHMARK(retargetOf<4>)->Unit(benchmark::kMicrosecond);
BENCHMARK(retargetOf<8>)->Unit(benchmark::kMicrosecond);
BENCHMARK(retargetOf<16>)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(forms, single_polynomial, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(forms, cruise, true)->Unit(benchmark::kMicrosecond);
BENCHMARK(sixthOrder)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(vias, by_way, ViaTimes::ByWay)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(vias, chosen, ViaTimes::Chosen)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(vias, optimised, ViaTimes::Optimised)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMicrosecond);
BENCHMARK(viasPeer)->Arg(1)->Arg(4)->Arg(10)->Unit(benchmark::kMicrosecond);
BENCHMARK(cycle<1>)->Unit(benchmark::kMicrosecond);
BENCHMARK(cycle<7>)->Unit(benchmark::kMicrosecond);
BENCHMARK(thesisIteration)->Unit(benchmark::kMicrosecond);
BENCHMARK(poseRetarget)->Unit(benchmark::kMicrosecond);
BENCHMARK(shaperStep)->Unit(benchmark::kMicrosecond);

VP_BENCHMARK_MAIN();
