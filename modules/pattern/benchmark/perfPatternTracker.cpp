/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Time per image and accuracy of tracking, acquisition and the baselines, compared with OpenCV and ViSP. Deviations and
// biases are px; over_bound is the deviation over the Cramer-Rao bound of this pattern.
#include "../test/vpAnalyticPattern.h"
#include "vpBenchmark.h"

#include <visp3/blob/vpDot2.h>
#include <visp3/core/vpException.h>
#include <visp3/pattern/vpPatternTracker.h>

#include <opencv2/imgproc.hpp>

#ifdef __linux__
#include <sched.h>
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

VISP_DIRECT_USING_NAMESPACE
using vpPatternTest::Pattern;

namespace
{
constexpr int frames = 200; // a closed path, so that it can be repeated

struct Sequence {
  Pattern pattern; // at its last position
  std::vector<vpImage<unsigned char>> images;
  std::vector<double> x, y; // of cell (0, 0)
};

Sequence sequence(unsigned int width, unsigned int height, double amplitude = 40., const Pattern &pattern = Pattern(),
                  int count = frames)
{
  std::mt19937_64 rng(1);
  Sequence s;
  s.pattern = pattern;
  s.images.resize(static_cast<std::size_t>(count));
  s.pattern.width = width;
  s.pattern.height = height;
  const double x = s.pattern.x, y = s.pattern.y;
  for (int i = 0; i < count; ++i) {
    const double phase = 2. * M_PI * i / count;
    s.pattern.x = x + amplitude * std::sin(phase);
    s.pattern.y = y + 0.3 * amplitude * std::cos(phase);
    s.pattern.render(rng, s.images[static_cast<std::size_t>(i)]);
    s.x.push_back(s.pattern.x);
    s.y.push_back(s.pattern.y);
  }
  return s;
}

const Sequence &small()
{
  static const Sequence s = sequence(160, 100);
  return s;
}

// Errors of centres against the true ones, and the lower bound for any method.
class Accuracy
{
public:
  void add(const Sequence &s, std::size_t k, double x, double y)
  {
    const double ex = x - s.x[k] - s.pattern.pitchX * std::round((x - s.x[k]) / s.pattern.pitchX);
    const double ey = y - s.y[k] - s.pattern.pitchY * std::round((y - s.y[k]) / s.pattern.pitchY);
    m_x.push_back(ex);
    m_y.push_back(ey);
  }
  void tell(benchmark::State &state, const Sequence &s) const
  {
    double boundX = 0., boundY = 0.;
    s.pattern.bound(boundX, boundY);
    state.counters["sigma_x"] = sigma(m_x);
    state.counters["sigma_y"] = sigma(m_y);
    state.counters["bias_x"] = mean(m_x);
    state.counters["over_bound_x"] = sigma(m_x) / boundX;
    state.counters["over_bound_y"] = sigma(m_y) / boundY;
  }

private:
  static double mean(const std::vector<double> &v)
  {
    return std::accumulate(v.begin(), v.end(), 0.) / static_cast<double>(std::max<std::size_t>(1, v.size()));
  }
  static double sigma(const std::vector<double> &v)
  {
    const double m = mean(v);
    double sum = 0.;
    for (const double e : v) {
      sum += (e - m) * (e - m);
    }
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, v.size())));
  }
  std::vector<double> m_x, m_y;
};

// Time of each call: mean by Google Benchmark, the distribution here. The clock itself takes about 25 ns per call.
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

void track(benchmark::State &state, const Sequence &s, const vpPatternTrackerSpec &spec)
{
  vpPatternTracker tracker(s.images[0].getWidth(), s.images[0].getHeight(), spec);
  for (const auto &image : s.images) { // acquire and learn
    static_cast<void>(tracker.process(image));
  }
  Accuracy accuracy;
  for (std::size_t k = 0; k < s.images.size(); ++k) {
    for (const vpPatternCell &cell : tracker.process(s.images[k]).cells) {
      if (cell.valid) {
        accuracy.add(s, k, cell.x, cell.y);
      }
    }
  }
  std::size_t cells = 0, locked = 0, all = 0;
  measure(state, s.images.size(), s.images[0].getSize() > 100000 ? 1 : 30, [&](std::size_t k) {
    const vpPatternFrame &frame = tracker.process(s.images[k]);
    cells += static_cast<std::size_t>(frame.validCells);
    locked += frame.status == vpPatternStatus::Tracking ? 1 : 0;
    ++all;
  });
  state.counters["cells"] = static_cast<double>(cells) / static_cast<double>(all);
  state.counters["locked_percent"] = 100. * static_cast<double>(locked) / static_cast<double>(all);
  accuracy.tell(state, s);
}

void tracking(benchmark::State &state) { track(state, small(), vpPatternTrackerSpec()); }

// A unit of relearning in each image instead of each 128th.
void trackingRefreshedAlways(benchmark::State &state)
{
  vpPatternTrackerSpec spec;
  spec.refreshEvery = 1;
  track(state, small(), spec);
}

// To and fro by 8 degrees, 0.08 from image to image, and to and fro along the rows: the template is relearned at full
// speed.
void trackingTurning(benchmark::State &state)
{
  constexpr int images = 400, toLearn = 100; // the first ones do not turn
  std::mt19937_64 rng(2);
  Sequence s;
  s.images.resize(toLearn + images);
  for (int i = 0; i < toLearn + images; ++i) {
    const double phase = 4. * std::max(0, i - toLearn) / images; // 0..4
    const double share = phase < 1. ? phase : phase < 3. ? 2. - phase : phase - 4.;
    s.pattern.rotation = 8. * M_PI / 180. * share;
    s.pattern.x = 80. + 20. * std::sin(2. * M_PI * i / 100);
    s.pattern.render(rng, s.images[static_cast<std::size_t>(i)]);
  }
  vpPatternTracker tracker(160, 100);
  unsigned int templates = 0;
  std::size_t locked = 0, all = 0;
  for (int i = 0; i < toLearn; ++i) {
    templates = tracker.process(s.images[static_cast<std::size_t>(i)]).templates;
  }
  measure(state, images, 30, [&](std::size_t k) {
    const vpPatternFrame &frame = tracker.process(s.images[toLearn + k]);
    locked += frame.status == vpPatternStatus::Tracking ? 1 : 0;
    ++all;
  });
  state.counters["images_per_template"] = static_cast<double>(all) / (tracker.frame().templates - templates);
  state.counters["locked_percent"] = 100. * static_cast<double>(locked) / static_cast<double>(all);
}

void baseline(benchmark::State &state, vpPatternMethod method, vpPatternThreshold threshold,
              vpPatternDerivative derivative)
{
  vpPatternTrackerSpec spec;
  spec.method = method;
  spec.threshold = threshold;
  spec.derivative = derivative;
  track(state, small(), spec);
}

void scaling(benchmark::State &state)
{
  const auto size = static_cast<unsigned int>(state.range(0));
  track(state, sequence(size, size, 4.), vpPatternTrackerSpec());
}

// The processor of the calling thread and of those that it starts; 0 is the first that the program may use, -1 stands for all.
void useProcessor(int which)
{
#ifdef __linux__
  static const cpu_set_t all = [] {
    cpu_set_t set;
    sched_getaffinity(0, sizeof(set), &set);
    return set;
  }();
  cpu_set_t one;
  CPU_ZERO(&one);
  for (int cpu = 0, k = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(cpu, &all) && k++ == which) {
      CPU_SET(cpu, &one);
    }
  }
  sched_setaffinity(0, sizeof(one), CPU_COUNT(&one) > 0 ? &one : &all);
#else
  static_cast<void>(which);
#endif
}

/*
 * 2048 x 2048 px, by turns in one thread and in two, the second on another processor. On a busy machine most images are interrupted in one of
 * them: compare the fastest tenths.
 */
void twoThreads(benchmark::State &state)
{
  static const Sequence s = sequence(2048, 2048, 4., Pattern(), 24);
  vpPatternTrackerSpec spec;
  vpPatternTracker one(2048, 2048, spec);
  spec.threads = 2;
  useProcessor(1);
  vpPatternTracker two(2048, 2048, spec);
  useProcessor(0);
  std::size_t locked = 0;
  using Clock = std::chrono::steady_clock;
  std::vector<double> times[2];
  for (int round = 0; round < 30; ++round) {
    for (const auto &image : s.images) {
      for (vpPatternTracker *tracker : {&one, &two}) {
        const auto begin = Clock::now();
        const bool tracks = tracker->process(image).status == vpPatternStatus::Tracking;
        const double us = std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
        if (round >= 10) { // before, they acquire and learn
          times[tracker == &one ? 0 : 1].push_back(us);
          locked += tracks ? 1 : 0;
        }
      }
    }
  }
  for (auto _ : state) {
    int valid = two.process(s.images[0]).validCells;
    benchmark::DoNotOptimize(valid);
  }
  useProcessor(-1);
  for (std::vector<double> &us : times) {
    std::sort(us.begin(), us.end());
  }
  const std::size_t n = times[0].size();
  for (int k = 0; k < 2; ++k) {
    const std::string name = k == 0 ? "one_" : "two_";
    state.counters[name + "min_us"] = times[k][0];
    state.counters[name + "p10_us"] = times[k][n / 10];
    state.counters[name + "p50_us"] = times[k][n / 2];
  }
  state.counters["ratio_p10"] = times[0][n / 10] / times[1][n / 10];
  state.counters["cells"] = static_cast<double>(two.frame().cells.size());
  state.counters["locked_percent"] = 100. * static_cast<double>(locked) / static_cast<double>(2 * n);
}

// The same view of the product with larger or smaller pixels, in percent of 160 x 100.
void magnified(benchmark::State &state)
{
  const double scale = 0.01 * static_cast<double>(state.range(0));
  Pattern pattern;
  for (double *length :
       {&pattern.pitchX, &pattern.pitchY, &pattern.cellX, &pattern.cellY, &pattern.blur, &pattern.x, &pattern.y}) {
    *length *= scale;
  }
  const auto width = static_cast<unsigned int>(160. * scale), height = static_cast<unsigned int>(100. * scale);
  track(state, sequence(width, height, 40. * std::min(1., scale), pattern), vpPatternTrackerSpec());
}

// The first image after a reset: threshold, labels, edges, lattice, identities.
void coldAcquisition(benchmark::State &state)
{
  vpPatternTrackerSpec spec;
  spec.method = vpPatternMethod::HalfMaximumEdges;
  vpPatternTracker tracker(160, 100, spec);
  measure(state, small().images.size(), 30, [&](std::size_t k) {
    tracker.reset();
    int valid = tracker.process(small().images[k]).validCells;
    benchmark::DoNotOptimize(valid);
  });
}

void learning(benchmark::State &state)
{
  vpPatternTracker tracker(160, 100);
  measure(state, 48, 30, [&](std::size_t k) {
    if (k == 0) {
      tracker.reset();
    }
    int valid = tracker.process(small().images[k]).validCells;
    benchmark::DoNotOptimize(valid);
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
  const auto find = [&](std::size_t k) {
    cv::threshold(view(small().images[k]), binary, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
    return cv::connectedComponentsWithStats(binary, labels, statistics, centroids);
  };
  Accuracy accuracy;
  for (std::size_t k = 0; k < small().images.size(); ++k) {
    const int n = find(k);
    for (int i = 1; i < n; ++i) {
      const int left = statistics.at<int>(i, cv::CC_STAT_LEFT), top = statistics.at<int>(i, cv::CC_STAT_TOP);
      const bool whole = left > 0 && top > 0 && left + statistics.at<int>(i, cv::CC_STAT_WIDTH) < 160 &&
                         top + statistics.at<int>(i, cv::CC_STAT_HEIGHT) < 100;
      if (whole && statistics.at<int>(i, cv::CC_STAT_AREA) > 200) {
        accuracy.add(small(), k, centroids.at<double>(i, 0), centroids.at<double>(i, 1));
      }
    }
  }
  measure(state, small().images.size(), 10, [&](std::size_t k) { benchmark::DoNotOptimize(find(k)); });
  accuracy.tell(state, small());
}

void opencvMatchTemplate(benchmark::State &state)
{
  cv::setNumThreads(1);
  const cv::Mat cell = view(small().images[0])(cv::Rect(40, 40, 46, 18)).clone();
  cv::Mat score;
  measure(state, small().images.size(), 10, [&](std::size_t k) {
    cv::matchTemplate(view(small().images[k]), cell, score, cv::TM_CCOEFF_NORMED);
    benchmark::DoNotOptimize(score.data);
  });
}

// One dot per cell completely in view, each tracked from its position in the previous image.
void vispDot2(benchmark::State &state)
{
  vpPatternTrackerSpec spec;
  spec.method = vpPatternMethod::HalfMaximumEdges;
  vpPatternTracker finder(160, 100, spec);
  std::vector<vpDot2> dots;
  std::size_t lost = 0, all = 0;
  Accuracy accuracy;
  measure(state, small().images.size(), 3, [&](std::size_t k) {
    if (k % 20 == 0) { // cells leave and enter: restart
      dots.clear();
      for (const vpPatternCell &cell : finder.process(small().images[k]).cells) {
        dots.emplace_back(vpImagePoint(cell.y, cell.x));
        dots.back().setGraphics(false);
        dots.back().setGrayLevelMin(115);
        dots.back().setGrayLevelMax(255);
        try {
          dots.back().initTracking(small().images[k], vpImagePoint(cell.y, cell.x), 115, 255);
        }
        catch (const vpException &) {
          dots.pop_back();
        }
      }
    }
    for (vpDot2 &dot : dots) {
      ++all;
      try {
        dot.track(small().images[k], false);
        accuracy.add(small(), k, dot.getCog().get_u(), dot.getCog().get_v());
      }
      catch (const vpException &) {
        ++lost;
      }
    }
  });
  state.counters["lost_percent"] =
      100. * static_cast<double>(lost) / static_cast<double>(std::max<std::size_t>(1, all));
  accuracy.tell(state, small());
}
// Table 7.1: the threshold alone, from the histogram of an image.
void threshold(benchmark::State &state, vpPatternThreshold method)
{
  vpPatternHistogram histogram{};
  for (unsigned int i = 0; i < small().images[0].getSize(); ++i) {
    ++histogram[small().images[0].bitmap[i]];
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(vpFindThreshold(histogram, method));
  }
}
} // namespace

BENCHMARK(tracking)->Unit(benchmark::kMicrosecond);
BENCHMARK(trackingRefreshedAlways)->Unit(benchmark::kMicrosecond);
BENCHMARK(trackingTurning)->Unit(benchmark::kMicrosecond);
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
BENCHMARK_CAPTURE(baseline, thesis_7_4_fixed_roberts, vpPatternMethod::ThesisAlgorithmFixed, vpPatternThreshold::Otsu,
                  vpPatternDerivative::Roberts)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, thesis_7_4_fixed_prewitt, vpPatternMethod::ThesisAlgorithmFixed, vpPatternThreshold::Otsu,
                  vpPatternDerivative::Prewitt)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(baseline, thesis_7_4_fixed_sobel, vpPatternMethod::ThesisAlgorithmFixed, vpPatternThreshold::Otsu,
                  vpPatternDerivative::Sobel)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(threshold, otsu, vpPatternThreshold::Otsu)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(threshold, isodata, vpPatternThreshold::Isodata)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(threshold, minimum_error, vpPatternThreshold::MinimumError)->Unit(benchmark::kMicrosecond);
BENCHMARK(opencvComponents)->Unit(benchmark::kMicrosecond);
BENCHMARK(opencvMatchTemplate)->Unit(benchmark::kMicrosecond);
BENCHMARK(vispDot2)->Unit(benchmark::kMicrosecond);
BENCHMARK(scaling)->RangeMultiplier(2)->Range(128, 2048)->Unit(benchmark::kMicrosecond)->Iterations(200);
BENCHMARK(twoThreads)->Unit(benchmark::kMicrosecond)->Iterations(24);
BENCHMARK(magnified)->Arg(50)->Arg(70)->Arg(100)->Arg(140)->Arg(200)->Arg(300)->Unit(benchmark::kMicrosecond);

VP_BENCHMARK_MAIN();
