/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time per image of tracking, acquisition and the baselines, with OpenCV's and ViSP's own ways of doing it beside them.
#include "../test/vpAnalyticPattern.h"

#include <visp3/blob/vpDot2.h>
#include <visp3/core/vpException.h>
#include <visp3/pattern/vpPatternTracker.h>

#include <opencv2/imgproc.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

VISP_DIRECT_USING_NAMESPACE
using vpPatternTest::Pattern;

namespace
{
constexpr int frames = 200; // a closed path, so that it can be gone round and round

std::vector<vpImage<unsigned char>> sequence(unsigned int width, unsigned int height, double amplitude = 40.)
{
  std::mt19937_64 rng(1);
  std::vector<vpImage<unsigned char>> images(frames);
  Pattern pattern;
  pattern.width = width;
  pattern.height = height;
  const double x = pattern.x, y = pattern.y;
  for (int i = 0; i < frames; ++i) {
    const double phase = 2. * M_PI * i / frames;
    pattern.x = x + amplitude * std::sin(phase);
    pattern.y = y + 0.3 * amplitude * std::cos(phase);
    pattern.render(rng, images[static_cast<std::size_t>(i)]);
  }
  return images;
}

const std::vector<vpImage<unsigned char>> &small()
{
  static const auto images = sequence(160, 100);
  return images;
}

// Time of each call: mean by Google Benchmark, the distribution here. The clock itself costs about 25 ns a call.
template <typename Call> void measure(benchmark::State &state, std::size_t count, int rounds, Call call)
{
  using Clock = std::chrono::steady_clock;
  std::vector<double> us;
  us.reserve(count * static_cast<std::size_t>(rounds));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < count; ++k) {
      const auto begin = Clock::now();
      call(k);
      us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    }
  }
  std::sort(us.begin(), us.end());
  std::size_t k = 0;
  for (auto _ : state) {
    call(k);
    k = k + 1 < count ? k + 1 : 0;
  }
  state.counters["min_us"] = us.front();
  state.counters["p50_us"] = us[us.size() / 2];
  state.counters["p99_us"] = us[us.size() * 99 / 100];
}

void track(benchmark::State &state, const std::vector<vpImage<unsigned char>> &images, const vpPatternOptions &options)
{
  vpPatternTracker tracker(images[0].getWidth(), images[0].getHeight(), options);
  for (const auto &image : images) { // acquire and learn
    static_cast<void>(tracker.track(image));
  }
  std::size_t cells = 0, locked = 0, all = 0;
  measure(state, images.size(), images[0].getSize() > 100000 ? 1 : 30, [&](std::size_t k) {
    const vpPatternFrame &frame = tracker.track(images[k]);
    cells += static_cast<std::size_t>(frame.validCells);
    locked += frame.status == vpPatternStatus::Tracking ? 1 : 0;
    ++all;
  });
  state.counters["cells"] = static_cast<double>(cells) / static_cast<double>(all);
  state.counters["locked_percent"] = 100. * static_cast<double>(locked) / static_cast<double>(all);
}

void tracking(benchmark::State &state) { track(state, small(), vpPatternOptions()); }

void baseline(benchmark::State &state, vpPatternMethod method, vpPatternThreshold threshold,
              vpPatternDerivative derivative)
{
  vpPatternOptions options;
  options.method = method;
  options.threshold = threshold;
  options.derivative = derivative;
  track(state, small(), options);
}

void scaling(benchmark::State &state)
{
  const auto size = static_cast<unsigned int>(state.range(0));
  auto images = sequence(size, size, 4.);
  track(state, images, vpPatternOptions());
}

// The first image after a reset: threshold, labels, edges, lattice, names.
void coldAcquisition(benchmark::State &state)
{
  vpPatternOptions options;
  options.method = vpPatternMethod::HalfMaximumEdges;
  vpPatternTracker tracker(160, 100, options);
  measure(state, small().size(), 30, [&](std::size_t k) {
    tracker.reset();
    benchmark::DoNotOptimize(tracker.track(small()[k]).validCells);
  });
}

void learning(benchmark::State &state)
{
  vpPatternTracker tracker(160, 100);
  measure(state, 48, 30, [&](std::size_t k) {
    if (k == 0) {
      tracker.reset();
    }
    benchmark::DoNotOptimize(tracker.track(small()[k]).validCells);
  });
}

cv::Mat view(const vpImage<unsigned char> &image)
{
  return {static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap};
}

void opencvComponents(benchmark::State &state)
{
  cv::setNumThreads(1);
  cv::Mat binary, labels, statistics, centroids;
  measure(state, small().size(), 10, [&](std::size_t k) {
    cv::threshold(view(small()[k]), binary, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    benchmark::DoNotOptimize(cv::connectedComponentsWithStats(binary, labels, statistics, centroids));
  });
}

void opencvMatchTemplate(benchmark::State &state)
{
  cv::setNumThreads(1);
  const cv::Mat cell = view(small()[0])(cv::Rect(40, 40, 46, 18)).clone();
  cv::Mat score;
  measure(state, small().size(), 10, [&](std::size_t k) {
    cv::matchTemplate(view(small()[k]), cell, score, cv::TM_CCOEFF_NORMED);
    benchmark::DoNotOptimize(score.data);
  });
}

// One dot per cell that is completely in view, each tracked from its place in the image before.
void vispDot2(benchmark::State &state)
{
  vpPatternOptions options;
  options.method = vpPatternMethod::HalfMaximumEdges;
  vpPatternTracker finder(160, 100, options);
  std::vector<vpDot2> dots;
  std::size_t lost = 0, all = 0;
  measure(state, small().size(), 3, [&](std::size_t k) {
    if (k % 20 == 0) { // cells leave and enter: begin anew
      dots.clear();
      for (const vpPatternCell &cell : finder.track(small()[k]).cells) {
        dots.emplace_back(vpImagePoint(cell.y, cell.x));
        dots.back().setGraphics(false);
        dots.back().setGrayLevelMin(115);
        dots.back().setGrayLevelMax(255);
        try {
          dots.back().initTracking(small()[k], vpImagePoint(cell.y, cell.x), 115, 255);
        }
        catch (const vpException &) {
          dots.pop_back();
        }
      }
    }
    for (vpDot2 &dot : dots) {
      ++all;
      try {
        dot.track(small()[k], false);
      }
      catch (const vpException &) {
        ++lost;
      }
    }
  });
  state.counters["lost_percent"] =
      100. * static_cast<double>(lost) / static_cast<double>(std::max<std::size_t>(1, all));
}
} // namespace

BENCHMARK(tracking)->Unit(benchmark::kMicrosecond);
BENCHMARK(coldAcquisition)->Unit(benchmark::kMicrosecond);
BENCHMARK(learning)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, half_maximum, vpPatternMethod::HalfMaximumEdges, vpPatternThreshold::Otsu,
                  vpPatternDerivative::Symmetric)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, thesis_7_4, vpPatternMethod::ThesisAlgorithm, vpPatternThreshold::Otsu,
                  vpPatternDerivative::Symmetric)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, thesis_7_4_fixed, vpPatternMethod::ThesisAlgorithmFixed, vpPatternThreshold::Otsu,
                  vpPatternDerivative::Symmetric)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, thesis_7_4_isodata, vpPatternMethod::ThesisAlgorithm, vpPatternThreshold::Isodata,
                  vpPatternDerivative::Symmetric)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, thesis_7_4_minimum_error, vpPatternMethod::ThesisAlgorithm,
                  vpPatternThreshold::MinimumError, vpPatternDerivative::Symmetric)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, thesis_7_4_sobel, vpPatternMethod::ThesisAlgorithm, vpPatternThreshold::Otsu,
                  vpPatternDerivative::Sobel)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(opencvComponents)->Unit(benchmark::kMicrosecond);
BENCHMARK(opencvMatchTemplate)->Unit(benchmark::kMicrosecond);
BENCHMARK(vispDot2)->Unit(benchmark::kMicrosecond);
BENCHMARK(scaling)->RangeMultiplier(2)->Range(128, 2048)->Unit(benchmark::kMicrosecond)->Iterations(200);

BENCHMARK_MAIN();
