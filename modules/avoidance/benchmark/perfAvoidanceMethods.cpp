/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time of each method: every step and every look of whole motions past the pillar of S4a, timed individually. The
// planners are for comparison: their start is OMPL's RRTConnect on certified motions, with path and timing.
#include "vpBenchmark.h"

#include <visp3/avoidance/vpAvoidanceMethods.h>
#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/manipulator/vpArmJson.h>

#include <chrono>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace
{
using Clock = std::chrono::steady_clock;
constexpr double period = 0.005;

double since(Clock::time_point begin) { return 1e6 * std::chrono::duration<double>(Clock::now() - begin).count(); }

void motions(benchmark::State &state, const char *name)
{
  static const vpArmModel arm = vpLoadArmJson(std::string(VISP_DIRECT_DATA_DIR) + "/robot/amor.json");
  static const vpCollisionSceneFile file =
      vpLoadCollisionScene(std::string(VISP_DIRECT_DATA_DIR) + "/scene/s4a-pillar.json");
  const vpCollisionScene scene(arm, file.spec);
  const vpAvoidanceGoal goal = vpAvoidanceGoal::at(arm, file.tasks[0].goal);
  const auto method = vpMakeAvoidanceMethod(name, scene);
  std::vector<double> starts, looks, steps;
  vpAvoidanceOutput output;
  for (auto loop : state) {
    static_cast<void>(loop);
    vpJointVector q = file.tasks[0].start;
    auto begin = Clock::now();
    static_cast<void>(method->start(q, goal));
    starts.push_back(since(begin));
    output.status = vpAvoidanceStatus::Moving;
    for (int k = 1; k < 3000 && vpIsWorking(output); ++k) {
      if (k % 7 == 0) {
        begin = Clock::now();
        method->look();
        looks.push_back(since(begin));
      }
      begin = Clock::now();
      method->step(q, output);
      steps.push_back(since(begin));
      q += period * output.velocity;
    }
  }
  state.counters["start_us_p50"] = vpQuantile(starts, 0.5);
  state.counters["look_us_p50"] = vpQuantile(looks, 0.5);
  state.counters["look_us_p95"] = vpQuantile(looks, 0.95);
  state.counters["step_us_p50"] = vpQuantile(steps, 0.5);
  state.counters["step_us_p99"] = vpQuantile(steps, 0.99);
}
} // namespace

BENCHMARK_CAPTURE(motions, potential, "potential")->Iterations(10);
BENCHMARK_CAPTURE(motions, potential_corrected, "potential-corrected")->Iterations(10);
BENCHMARK_CAPTURE(motions, dtg, "dtg")->Iterations(10);
BENCHMARK_CAPTURE(motions, dtg_via, "dtg-via")->Iterations(10);
BENCHMARK_CAPTURE(motions, planner, "planner")->Iterations(10);
BENCHMARK_CAPTURE(motions, planner_dtg, "planner-dtg")->Iterations(10);

VP_BENCHMARK_MAIN();
