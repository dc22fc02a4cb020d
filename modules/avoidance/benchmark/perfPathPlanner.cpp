/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Planning time on pillar and shelf (S4), one seed per iteration: certified, own discrete and FCL discrete motions,
// and the other planners. first_ms is the planner's own time without shortening, call_us the whole of plan().
#include "vpBenchmark.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/avoidance/vpPathPlanner.h>
#include <visp3/direct_core/vpQuantile.h>
#include <visp3/manipulator/vpArmJson.h>

#include <chrono>
#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace
{
std::string dataFile(const std::string &name) { return std::string(VISP_DIRECT_DATA_DIR) + "/" + name; }

void plan(benchmark::State &state, const std::string &file, const std::string &planner, vpMotionValidation validation)
{
  static const vpArmModel arm = vpLoadArmJson(dataFile("robot/amor.json"));
  const vpCollisionSceneFile scenes = vpLoadCollisionScene(dataFile(file));
  const vpCollisionScene scene(arm, scenes.spec);
  std::vector<double> times, calls, lengths;
  unsigned int seed = 0;
  int solved = 0;
  long motions = 0;
  for (auto step : state) {
    static_cast<void>(step);
    vpPathPlannerSpec spec;
    spec.planner = planner;
    spec.validation = validation;
    spec.seed = ++seed;
    spec.shortenTime = 0.;
    vpPathPlanner how(scene, spec);
    const vpMotionTask &task = scenes.tasks[seed % scenes.tasks.size()];
    const auto begin = std::chrono::steady_clock::now();
    const vpPathResult result = how.plan(task.start, task.goal);
    calls.push_back(1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    lengths.push_back(result.path.length());
    solved += result.status == vpPathStatus::Solved ? 1 : 0;
    motions += result.motions;
    times.push_back(1000. * result.planningTime);
  }
  const double runs = static_cast<double>(times.size());
  state.counters["solved_%"] = 100. * solved / runs;
  state.counters["first_ms_p50"] = vpQuantile(times, 0.5);
  state.counters["first_ms_p95"] = vpQuantile(times, 0.95);
  state.counters["call_us_p50"] = vpQuantile(calls, 0.5);
  state.counters["call_us_p95"] = vpQuantile(calls, 0.95);
  state.counters["length_p50"] = vpQuantile(lengths, 0.5);
  state.counters["motions"] = static_cast<double>(motions) / runs;
}

void add(const char *scene, const char *file, const char *planner, const char *how, vpMotionValidation validation,
         int runs)
{
  const std::string name = std::string(scene) + "/" + planner + "/" + how;
  benchmark::RegisterBenchmark(name.c_str(), plan, file, planner, validation)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(runs);
}
} // namespace

int main(int argc, char **argv)
{
  const std::pair<const char *, const char *> scenes[] = {{"pillar", "scene/s4a-pillar.json"},
                                                          {"shelf", "scene/s4b-shelf.json"}};
  for (const auto &scene : scenes) {
    add(scene.first, scene.second, "BiRRT", "certified", vpMotionValidation::Certified, 100);
    add(scene.first, scene.second, "RRTConnect", "certified", vpMotionValidation::Certified, 100);
    add(scene.first, scene.second, "RRTConnect", "discrete", vpMotionValidation::Discrete, 100);
    add(scene.first, scene.second, "RRTConnect", "discrete by FCL", vpMotionValidation::DiscreteFcl, 100);
    for (const char *planner : {"BITstar", "PRM", "KPIECE", "RRT", "RRTstar"}) {
      add(scene.first, scene.second, planner, "certified", vpMotionValidation::Certified, 10);
    }
  }
  return vpTestSupport::runBenchmarks(argc, argv);
}
