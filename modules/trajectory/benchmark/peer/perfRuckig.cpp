/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Part of perfDirectTrajectory where the user has Ruckig's source: the same retargets, planned for the least time.
#include "../vpRetargets.h"

#include <ruckig/ruckig.hpp>

VISP_DIRECT_USING_NAMESPACE
using namespace vpRetargets;

namespace
{
template <int N> ruckig::InputParameter<N> inputOf(const vpTrajectoryProblem &problem)
{
  ruckig::InputParameter<N> input;
  for (int i = 0; i < N; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const vpAxisState start = problem.start(i);
    const vpAxisLimits limits = problem.limits(i);
    input.current_position[k] = start[0];
    input.current_velocity[k] = start[1];
    input.current_acceleration[k] = start[2];
    input.target_position[k] = problem.goal(i)[0];
    input.max_velocity[k] = limits.velocity;
    input.max_acceleration[k] = limits.acceleration;
    input.max_jerk[k] = limits.jerk;
  }
  return input;
}

template <int N> void planningByRuckig(benchmark::State &state, bool jerk)
{
  const auto problems = retargets<N>(5000, vpTrajectoryForm::Hold, jerk);
  ruckig::Ruckig<N> planner;
  ruckig::Trajectory<N> trajectory;
  std::vector<ruckig::InputParameter<N>> inputs;
  std::vector<double> times; // of ours, over Ruckig's
  vpTrajectoryPlanner ours(N);
  vpTrajectoryPlan plan(N);
  int failed = 0;
  for (const vpTrajectoryProblem &problem : problems) {
    inputs.push_back(inputOf<N>(problem));
    if (planner.calculate(inputs.back(), trajectory) < 0) {
      ++failed;
      continue;
    }
    static_cast<void>(ours.plan(problem, 0., plan));
    times.push_back(plan.duration() / trajectory.get_duration());
  }
  measure(state, inputs.size(),
          [&](std::size_t k) { benchmark::DoNotOptimize(planner.calculate(inputs[k], trajectory)); });
  std::sort(times.begin(), times.end());
  state.counters["failed"] = failed;
  state.counters["our_time_p50"] = times[times.size() / 2];
  state.counters["our_time_p95"] = times[times.size() * 95 / 100];
}

void ruckig1(benchmark::State &state, bool jerk) { planningByRuckig<1>(state, jerk); }
void ruckig7(benchmark::State &state, bool jerk) { planningByRuckig<7>(state, jerk); }
} // namespace

BENCHMARK_CAPTURE(ruckig1, retarget, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ruckig1, retarget_jerk_limits, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ruckig7, retarget, false)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ruckig7, retarget_jerk_limits, true)->Unit(benchmark::kMicrosecond);
