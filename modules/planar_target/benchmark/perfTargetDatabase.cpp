/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A frame of 640x480 for a database of which one target is visible and the others are lost, on one core. For
// comparison: each target separately, with full effort in every frame.
#include "../test/vpPosters.h"
#include "vpBenchmark.h"

#include <visp3/direct_core/vpQuantile.h>
#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include <ctime>

namespace
{
constexpr std::size_t frames = 24;

const std::vector<vpPlanarScene::Target> &posters()
{
  static const std::vector<vpPlanarScene::Target> all = []() {
    std::mt19937_64 rng(5);
    std::vector<vpPlanarScene::Target> made;
    for (int i = 0; i < 100; ++i) {
      made.push_back(vpPosters::poster(rng));
    }
    return made;
  }();
  return all;
}

// The first poster moves there and back by 3 px a frame before a wall full of shapes.
const std::vector<vpPlanarScene::Image> &views()
{
  static const std::vector<vpPlanarScene::Image> all = []() {
    std::mt19937_64 rng(6);
    const vpPlanarScene::Image wall = vpPosters::wall(rng);
    std::vector<vpPlanarScene::Image> made(frames, wall);
    for (std::size_t i = 0; i < frames; ++i) {
      const double s = i < frames / 2 ? i : frames - i;
      vpPlanarScene::draw(made[i], posters()[0], vpPlanarScene::camera(),
                          vpPlanarScene::pose(0.002 * s - 0.01, 0., 0.52, 0.1, 0.1, -0.1));
      vpPlanarScene::spoil(made[i], 0.7, 0.9, 3., rng);
    }
    return made;
  }();
  return all;
}

template <class Process> void run(benchmark::State &state, const Process &process)
{
  std::vector<double> times; // processor time, so that other programs do not count
  std::size_t i = 0;
  for (auto _ : state) {
    const std::clock_t start = std::clock();
    process(views()[i++ % frames]);
    times.push_back(1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  state.counters["cpu_ms_p50"] = vpQuantile(times, 0.5);
  state.counters["cpu_ms_p90"] = vpQuantile(times, 0.9);
  state.counters["cpu_ms_max"] = vpQuantile(times, 1.);
}

void database(benchmark::State &state)
{
  vpPlanarTargetDatabase all(vpPlanarScene::camera());
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.range(0)); ++i) {
    all.add(std::to_string(i), posters()[i].image, posters()[i].width, posters()[i].height);
  }
  all.process(views()[frames - 1]);
  run(state, [&all](const vpPlanarScene::Image &view) { all.process(view); });
  if (!all.sightings()[0].result.found()) {
    state.SkipWithError("the target that is there was lost");
  }
}

void allInEveryFrame(benchmark::State &state)
{
  std::vector<vpPlanarTarget> all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.range(0)); ++i) {
    all.emplace_back(posters()[i].image, posters()[i].width, posters()[i].height, vpPlanarScene::camera());
    all.back().process(views()[frames - 1]);
  }
  run(state, [&all](const vpPlanarScene::Image &view) {
    for (vpPlanarTarget &target : all) {
      if (!target.track(view).found()) {
        target.acquire(view);
      }
    }
  });
}
} // namespace

BENCHMARK(database)->Arg(1)->Arg(2)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(240);
BENCHMARK(allInEveryFrame)->Arg(2)->Arg(10)->Unit(benchmark::kMillisecond)->Iterations(24);

int main(int argc, char *argv[])
{
  cv::setNumThreads(1);
  views();
  return vpTestSupport::runBenchmarks(argc, argv);
}
