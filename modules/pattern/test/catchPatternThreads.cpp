/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The tracker in several threads: the same results to the last bit, no allocation; each part of the work is done once.
#include "../src/vpPatternWorkers.cpp" // the class is not exported

#include "vpAnalyticPattern.h"
#include "vpCatch.h"

#include <visp3/pattern/vpPatternTracker.h>

#include <algorithm>
#include <cstring>
#include <numeric>

VISP_DIRECT_USING_NAMESPACE
using vpPatternTest::Pattern;

namespace
{
bool same(double a, double b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

bool same(const vpPatternCell &a, const vpPatternCell &b)
{
  return a.row == b.row && a.column == b.column && a.valid == b.valid && same(a.x, b.x) && same(a.y, b.y) &&
         same(a.sigmaX, b.sigmaX) && same(a.sigmaY, b.sigmaY) && same(a.deviationX, b.deviationX) &&
         same(a.deviationY, b.deviationY);
}

bool same(const vpPatternFrame &a, const vpPatternFrame &b)
{
  return a.status == b.status && a.reason == b.reason && a.validCells == b.validCells && a.hasMotion == b.hasMotion &&
         a.epoch == b.epoch && a.templates == b.templates && same(a.dx, b.dx) && same(a.dy, b.dy) &&
         same(a.sigmaDx, b.sigmaDx) && same(a.sigmaDy, b.sigmaDy) && same(a.noise, b.noise) &&
         std::memcmp(&a.lattice, &b.lattice, sizeof(a.lattice)) == 0 &&
         std::equal(a.cells.begin(), a.cells.end(), b.cells.begin(), b.cells.end(),
                    [](const vpPatternCell &p, const vpPatternCell &q) { return same(p, q); });
}

// Random images of a product: dirt, jitter, motion, turns, and images without it.
class Scene
{
public:
  explicit Scene(std::mt19937_64 &rng) : m_rng(rng)
  {
    m_pattern.width = 320 + static_cast<unsigned int>(rng() % 100);
    m_pattern.height = 240 + static_cast<unsigned int>(rng() % 60);
    m_pattern.pitchX = 19.3 + between(0., 3.);
    m_pattern.pitchY = 14.7 + between(0., 3.);
    m_pattern.cellX = 0.6 * m_pattern.pitchX;
    m_pattern.cellY = 0.6 * m_pattern.pitchY;
    m_pattern.jitter = between(0., 0.5);
    m_pattern.slope = between(0., 0.1);
  }

  const Pattern &pattern() const { return m_pattern; }

  const vpImage<unsigned char> &next()
  {
    ++m_images;
    m_vx = std::clamp(m_vx + between(-0.5, 0.5), -3., 3.);
    m_pattern.x += m_images % 40 == 0 ? 0.47 * m_pattern.pitchX : m_vx; // now and then a jump
    m_pattern.y += between(-0.5, 0.5);
    m_pattern.rotation = m_images > 75 ? 0.002 * std::sin(0.2 * m_images) : 0.;
    m_pattern.render(m_rng, m_image);
    if (m_images % 37 == 0) { // nothing there
      std::fill_n(m_image.bitmap, m_image.getSize(), static_cast<unsigned char>(90));
    }
    for (int speck = 0; m_images > 60 && speck < 25; ++speck) {
      const unsigned int u = static_cast<unsigned int>(between(0., m_pattern.width - 9.)),
                         v = static_cast<unsigned int>(between(0., m_pattern.height - 9.));
      const auto grey = static_cast<unsigned char>(between(0., 255.));
      for (unsigned int k = 0; k < 64; ++k) {
        m_image[v + k / 8][u + k % 8] = grey;
      }
    }
    return m_image;
  }

private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(m_rng); }

  std::mt19937_64 &m_rng;
  Pattern m_pattern;
  vpImage<unsigned char> m_image;
  double m_vx = 0.;
  int m_images = 0;
};
} // namespace

TEST_CASE("the tracker's results do not depend on the number of threads", "[threads]")
{
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(871);
  int tracked = 0, degraded = 0, lost = 0, invalid = 0;
  for (int problem = 0; problem < vpTestSupport::longer(2); ++problem) {
    Scene scene(rng);
    std::vector<vpPatternTracker> trackers; // trackers[0] in one thread
    for (const int threads : {1, 2, 3, 5}) {
      vpPatternTrackerSpec spec;
      spec.threads = threads;
      spec.refreshEvery = 1 + problem % 4;
      trackers.emplace_back(scene.pattern().width, scene.pattern().height, spec);
    }
    for (int image = 0; image < 130; ++image) {
      const vpImage<unsigned char> &view = scene.next();
      const vpPatternFrame &one = trackers[0].process(view);
      for (std::size_t k = 1; k < trackers.size(); ++k) {
        CAPTURE(problem, image, k, one.cells.size(), vpToString(one.status));
        REQUIRE(same(one, trackers[k].process(view)));
      }
      tracked += one.status == vpPatternStatus::Tracking && one.cells.size() >= 128 ? 1 : 0; // fewer are not shared
      degraded += one.status == vpPatternStatus::Degraded ? 1 : 0;
      lost += one.status == vpPatternStatus::Lost ? 1 : 0;
      invalid += one.status == vpPatternStatus::Tracking ? static_cast<int>(one.cells.size()) - one.validCells : 0;
    }
  }
  CHECK(tracked > 20);
  CHECK(degraded > 0);
  CHECK(lost > 0);
  CHECK(invalid > 30);
}

// The memory has 64 rows for the 62 in view at first: later two cells have one slot, and what writes to it stays in one thread.
TEST_CASE("more rows come into view than the memory has", "[threads]")
{
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(873);
  Pattern pattern;
  pattern.width = 200;
  pattern.height = 1000;
  pattern.pitchX = 20.;
  pattern.cellX = 12.;
  pattern.cellY = 9.;
  vpPatternTrackerSpec spec;
  vpPatternTracker one(pattern.width, pattern.height, spec);
  spec.threads = 4;
  vpPatternTracker four(pattern.width, pattern.height, spec);
  vpImage<unsigned char> view;
  int rows = 0;
  for (int image = 0; image < 130; ++image) {
    CAPTURE(image);
    pattern.pitchY = 16. - 0.02 * std::max(0, image - 70);
    pattern.x = 0.3 * image;
    pattern.render(rng, view);
    const vpPatternFrame &frame = one.process(view);
    REQUIRE(same(frame, four.process(view)));
    if (image > 70) {
      REQUIRE(frame.status == vpPatternStatus::Tracking);
      const auto ends = std::minmax_element(frame.cells.begin(), frame.cells.end(),
                                            [](const auto &a, const auto &b) { return a.row < b.row; });
      rows = std::max(rows, ends.second->row - ends.first->row + 1);
    }
  }
  CHECK(rows > 64);
}

TEST_CASE("a frame in several threads does not allocate", "[threads][allocation]")
{
  if (!vpTestSupport::canCountAllocations()) {
    WARN("allocations cannot be counted in this build");
    return;
  }
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(872);
  Scene scene(rng);
  std::vector<vpImage<unsigned char>> views;
  for (int k = 0; k < 90; ++k) {
    views.push_back(scene.next());
  }
  vpPatternTrackerSpec spec;
  spec.threads = 3;
  vpPatternTracker tracker(scene.pattern().width, scene.pattern().height, spec);
  int tracked = 0;
  const unsigned long before = vpTestSupport::allocationCount();
  for (const auto &view : views) {
    tracked += tracker.process(view).status == vpPatternStatus::Tracking ? 1 : 0;
  }
  CHECK(vpTestSupport::allocationCount() == before);
  CHECK(tracked > 10);
}

TEST_CASE("workers do each part once, and no thread two at a time", "[threads]")
{
  auto rng = vpTestSupport::generator(873);
  CAPTURE(vpTestSupport::seed());
  for (const int threads : {1, 2, 3, 8}) {
    vpPatternWorkers workers(threads);
    std::vector<int> done; // plain numbers: another thread's would be a race
    std::vector<int> busy(static_cast<std::size_t>(threads), 0), sum(static_cast<std::size_t>(threads), 0);
    long all = 0;
    for (int frame = 0; frame < vpTestSupport::longer(300); ++frame) {
      CAPTURE(threads, frame);
      if (frame % 5 != 0) {
        workers.begin();
      }
      for (int run = 0; run < 6; ++run) {
        const int parts = static_cast<int>(rng() % 40), length = static_cast<int>(rng() % 2000);
        done.assign(static_cast<std::size_t>(parts), 0);
        std::atomic<bool> overlaps{false};
        workers.run(parts, [&](int part, int thread) {
          const std::size_t t = static_cast<std::size_t>(thread);
          overlaps = overlaps || busy[t] != 0;
          busy[t] = 1;
          volatile int spent = 0;
          for (int k = 0; k < length; ++k) {
            spent = spent + 1;
          }
          ++done[static_cast<std::size_t>(part)];
          sum[t] += 1;
          busy[t] = 0;
        });
        REQUIRE_FALSE(overlaps);
        REQUIRE(std::count(done.begin(), done.end(), 1) == parts);
        all += parts;
      }
      workers.end();
      if (frame % 50 == 0) { // workers fall asleep
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    }
    REQUIRE(std::accumulate(sum.begin(), sum.end(), 0L) == all);
  }
}

TEST_CASE("threads out of range are named", "[threads]")
{
  vpPatternTrackerSpec spec;
  spec.threads = 0;
  CHECK_THROWS_WITH(vpPatternTracker(160, 100, spec),
                    Catch::Contains("threads of the pattern tracker is 0, must be 1..64"));
  spec.threads = 65;
  CHECK_THROWS_WITH(vpPatternTracker(160, 100, spec), Catch::Contains("threads of the pattern tracker is 65"));
}
