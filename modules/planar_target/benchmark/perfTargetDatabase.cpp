/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A frame of 640x480 for a database of which one target is visible and the others are lost, on one core. For
// comparison: each target separately, with full effort in every frame; and OpenCV's ORB with its FLANN matcher, as in
// OpenCV's tutorials, which looks for all targets in every frame, by one index of all targets or one of each.
#include "../test/vpPosters.h"
#include "vpBenchmark.h"

#include <visp3/direct_core/vpQuantile.h>
#include <visp3/planar_target/vpPlanarTargetDatabase.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>

#include <array>
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

vpHomogeneousMatrix placeInFrame(std::size_t i)
{
  const double s = i < frames / 2 ? i : frames - i;
  return vpPlanarScene::pose(0.002 * s - 0.01, 0., 0.52, 0.1, 0.1, -0.1);
}

// The first poster moves there and back by 3 px a frame before a wall full of shapes.
const std::vector<vpPlanarScene::Image> &views()
{
  static const std::vector<vpPlanarScene::Image> all = []() {
    std::mt19937_64 rng(6);
    const vpPlanarScene::Image wall = vpPosters::wall(rng);
    std::vector<vpPlanarScene::Image> made(frames, wall);
    for (std::size_t i = 0; i < frames; ++i) {
      vpPlanarScene::draw(made[i], posters()[0], vpPlanarScene::camera(), placeInFrame(i));
      vpPlanarScene::spoil(made[i], 0.7, 0.9, 3., rng);
    }
    return made;
  }();
  return all;
}

cv::Mat pixels(const vpPlanarScene::Image &image)
{
  return cv::Mat(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
}

// Error of a homography from the photograph of the visible target, mean of its corners, px.
double cornerError(const cv::Mat &H, std::size_t frame)
{
  const vpPlanarScene::Target &target = posters()[0];
  const vpCameraParameters camera = vpPlanarScene::camera();
  const double w = target.image.getWidth(), h = target.image.getHeight();
  const std::vector<cv::Point2f> photo{{-0.5F, -0.5F},
                                       {static_cast<float>(w - 0.5), -0.5F},
                                       {static_cast<float>(w - 0.5), static_cast<float>(h - 0.5)},
                                       {-0.5F, static_cast<float>(h - 0.5)}};
  std::vector<cv::Point2f> found;
  cv::perspectiveTransform(photo, found, H);
  double sum = 0.;
  for (std::size_t k = 0; k < photo.size(); ++k) {
    vpColVector X(4, 1.);
    X[0] = ((photo[k].x + 0.5) / w - 0.5) * target.width;
    X[1] = ((photo[k].y + 0.5) / h - 0.5) * target.height;
    X[2] = 0.;
    const vpColVector P = placeInFrame(frame) * X;
    sum += std::hypot(camera.get_px() * P[0] / P[2] + camera.get_u0() - found[k].x,
                      camera.get_py() * P[1] / P[2] + camera.get_v0() - found[k].y);
  }
  return sum / static_cast<double>(photo.size());
}

// Of the target that is there, and others that were found although they are not.
class Findings
{
public:
  //! Homographies of all targets in the next frame, from the photograph; empty where not found.
  void add(const std::vector<cv::Mat> &homographies)
  {
    for (std::size_t i = 1; i < homographies.size(); ++i) {
      m_others += homographies[i].empty() ? 0. : 1.;
    }
    if (!homographies[0].empty()) {
      m_found += 1.;
      m_error += cornerError(homographies[0], m_frame % frames);
    }
    ++m_frame;
  }
  void tell(benchmark::State &state) const
  {
    state.counters["found_percent"] = 100. * m_found / static_cast<double>(m_frame);
    state.counters["not_there"] = m_others;
    state.counters["corner_px"] = m_error / m_found;
  }

private:
  std::size_t m_frame = 0;
  double m_found = 0., m_others = 0., m_error = 0.;
};

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
  Findings findings;
  run(state, [&](const vpPlanarScene::Image &view) {
    all.process(view);
    std::vector<cv::Mat> homographies;
    for (const vpPlanarTargetSighting &sighting : all.sightings()) {
      std::array<double, 9> H = sighting.result.homography;
      homographies.push_back(sighting.result.found() ? cv::Mat(3, 3, CV_64F, H.data()).clone() : cv::Mat());
    }
    findings.add(homographies);
  });
  findings.tell(state);
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

/*
 * The usual way with OpenCV: ORB (1500 keypoints, as many as we take), FlannBasedMatcher with LSH (6 tables, keys of 12 bits,
 * one probe level: OpenCV's tutorial), ratio test 0.8, and a target is there when RANSAC finds a homography (3 px) with
 * 12 inliers, as for us. The index of the photographs is built beforehand; a frame asks it for the two nearest of each of
 * its keypoints. Nothing is tracked, refined or limited, and there is no pose. With \e shared one index has the descriptors of all
 * targets, and the second nearest may be another target's; without it each target has its own.
 */
class FlannDatabase
{
public:
  FlannDatabase(std::size_t count, bool shared) : m_photos(count)
  {
    m_matchers.resize(shared ? 1 : count);
    for (std::size_t i = 0; i < count; ++i) {
      cv::Mat descriptors;
      m_orb->detectAndCompute(pixels(posters()[i].image), cv::noArray(), m_photos[i], descriptors);
      cv::Ptr<cv::FlannBasedMatcher> &matcher = m_matchers[shared ? 0 : i];
      if (!matcher) {
        matcher = cv::makePtr<cv::FlannBasedMatcher>(cv::makePtr<cv::flann::LshIndexParams>(6, 12, 1));
      }
      matcher->add(std::vector<cv::Mat>{descriptors});
    }
    for (const auto &matcher : m_matchers) {
      matcher->train();
    }
  }

  //! Homographies of the targets, empty where one is not found.
  const std::vector<cv::Mat> &process(const vpPlanarScene::Image &view)
  {
    std::vector<cv::KeyPoint> current;
    cv::Mat descriptors;
    m_orb->detectAndCompute(pixels(view), cv::noArray(), current, descriptors);
    std::vector<std::vector<cv::Point2f>> from(m_photos.size()), to(m_photos.size());
    for (std::size_t i = 0; i < m_matchers.size(); ++i) {
      std::vector<std::vector<cv::DMatch>> nearest;
      m_matchers[i]->knnMatch(descriptors, nearest, 2);
      for (const std::vector<cv::DMatch> &pair : nearest) {
        if (pair.size() == 2 && pair[0].distance < 0.8F * pair[1].distance) { // LSH may find fewer
          const std::size_t target = m_matchers.size() == 1 ? static_cast<std::size_t>(pair[0].imgIdx) : i;
          from[target].push_back(m_photos[target][static_cast<std::size_t>(pair[0].trainIdx)].pt);
          to[target].push_back(current[static_cast<std::size_t>(pair[0].queryIdx)].pt);
        }
      }
    }
    m_found.assign(m_photos.size(), cv::Mat());
    for (std::size_t i = 0; i < m_photos.size(); ++i) {
      cv::Mat inliers;
      const cv::Mat H = from[i].size() >= 12 ? cv::findHomography(from[i], to[i], cv::RANSAC, 3., inliers) : cv::Mat();
      if (!H.empty() && cv::countNonZero(inliers) >= 12) {
        m_found[i] = H;
      }
    }
    return m_found;
  }

private:
  cv::Ptr<cv::ORB> m_orb = cv::ORB::create(1500);
  std::vector<cv::Ptr<cv::FlannBasedMatcher>> m_matchers;
  std::vector<std::vector<cv::KeyPoint>> m_photos;
  std::vector<cv::Mat> m_found;
};

void orbFlann(benchmark::State &state, bool shared)
{
  FlannDatabase all(static_cast<std::size_t>(state.range(0)), shared);
  Findings findings;
  run(state, [&](const vpPlanarScene::Image &view) { findings.add(all.process(view)); });
  findings.tell(state);
}
} // namespace

BENCHMARK(database)->Arg(1)->Arg(2)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(240);
BENCHMARK(allInEveryFrame)->Arg(2)->Arg(10)->Unit(benchmark::kMillisecond)->Iterations(24);
BENCHMARK_CAPTURE(orbFlann, shared, true)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(12);
BENCHMARK_CAPTURE(orbFlann, each, false)->Arg(10)->Unit(benchmark::kMillisecond)->Iterations(12);
BENCHMARK_CAPTURE(orbFlann, each, false)->Arg(100)->Unit(benchmark::kMillisecond)->Iterations(6);

int main(int argc, char *argv[])
{
  cv::setNumThreads(1);
  views();
  return vpTestSupport::runBenchmarks(argc, argv);
}
