/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRetargets.h
 * \brief Random replanning problems, and the time of each call: what the trajectory and its peers are measured with.
 */
#ifndef vpRetargets_h
#define vpRetargets_h

#include <benchmark/benchmark.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <vector>

namespace vpRetargets
{
VISP_DIRECT_USING_NAMESPACE
constexpr double none = std::numeric_limits<double>::infinity();

inline double uniform(std::mt19937_64 &rng, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(rng);
}

// Retargeting in mid-motion: each problem starts somewhere on the way to another goal. The limits are those of a
// robot's joints. `wanted` selects problems by the form that answers them (Hold: any); a rare form gives fewer problems.
template <int N> std::vector<vpTrajectoryProblem> retargets(int count, vpTrajectoryForm wanted, bool jerk = false)
{
  constexpr int attempts = 100000;
  std::mt19937_64 rng(1);
  std::vector<vpTrajectoryProblem> problems;
  vpTrajectoryPlanner planner(N);
  vpTrajectoryPlan plan(N);
  for (int k = 0; k < attempts && static_cast<int>(problems.size()) < count; ++k) {
    vpTrajectoryInput<N> input;
    for (int i = 0; i < N; ++i) {
      input.maxVelocity[i] = uniform(rng, 0.5, 2.);
      input.maxAcceleration[i] = uniform(rng, 1., 5.);
      input.maxJerk[i] = jerk ? 20. * input.maxAcceleration[i] : none;
      input.goal.q[i] = uniform(rng, -1., 1.);
    }
    vpTrajectoryProblem problem(N);
    static_cast<void>(input.copyTo(problem));
    static_cast<void>(planner.plan(problem, 0., plan));
    const double t = uniform(rng, 0.05, 0.95) * plan.duration();
    for (int i = 0; i < N; ++i) {
      problem.setStart(i, plan.at(i, t));
      problem.field(vpTrajectoryProblem::GoalQ)[i] = uniform(rng, -1., 1.);
    }
    static_cast<void>(planner.plan(problem, 0., plan));
    if (wanted == vpTrajectoryForm::Hold || plan.form() == wanted) {
      problems.push_back(problem);
    }
  }
  return problems;
}

// Time of each call: mean by Google Benchmark, the distribution here. The clock itself takes about 25 ns per call.
template <typename Call> void measure(benchmark::State &state, std::size_t count, Call call)
{
  using Clock = std::chrono::steady_clock;
  std::vector<double> ns;
  ns.reserve(count * 20);
  double quietest = none; // mean of the round least disturbed by other users of the machine, ns
  for (int round = 0; round < 20; ++round) {
    double sum = 0.;
    for (std::size_t k = 0; k < count; ++k) {
      const auto begin = Clock::now();
      call(k);
      ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
      sum += ns.back();
    }
    quietest = std::min(quietest, sum / static_cast<double>(count));
  }
  std::sort(ns.begin(), ns.end());
  std::size_t k = 0;
  for (auto _ : state) {
    call(k);
    k = k + 1 < count ? k + 1 : 0;
  }
  state.counters["quietest_mean_us"] = 1e-3 * quietest;
  state.counters["p50_us"] = 1e-3 * ns[ns.size() / 2];
  state.counters["p99_us"] = 1e-3 * ns[ns.size() * 99 / 100];
  state.counters["max_us"] = 1e-3 * ns.back();
}

} // namespace vpRetargets
#endif
