/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Objects of similar grey value in front of the product: no valid cell is far from its true position.
#include "vpAnalyticPattern.h"
#include "vpCatch.h"

#include <visp3/pattern/vpPatternTracker.h>

#include <cstdlib>

VISP_DIRECT_USING_NAMESPACE
using namespace vpPatternTest;

namespace
{
// A soft drifting rectangle of a cell's or the background's grey, or any other.
struct Occluder {
  double x, y, width, height, grey, vx, vy, soft;
  int life; // images
};

void draw(const Occluder &o, const Pattern &pattern, std::mt19937_64 &rng, vpImage<unsigned char> &image)
{
  std::normal_distribution<double> normal;
  for (int v = std::max(0, int(o.y - 0.5 * o.height - 4)); v < std::min(100, int(o.y + 0.5 * o.height + 5)); ++v) {
    for (int u = std::max(0, int(o.x - 0.5 * o.width - 4)); u < std::min(160, int(o.x + 0.5 * o.width + 5)); ++u) {
      const double inside = std::min(0.5 * o.width - std::abs(u - o.x), 0.5 * o.height - std::abs(v - o.y)) / o.soft;
      const double share = 1. / (1. + std::exp(-3. * inside));
      if (share > 0.01) {
        unsigned char &pixel = image[static_cast<unsigned int>(v)][static_cast<unsigned int>(u)];
        const double grey = share * (o.grey + pattern.sigma(o.grey) * normal(rng)) + (1. - share) * pixel;
        pixel = static_cast<unsigned char>(std::clamp(std::lround(grey), 0L, 255L));
      }
    }
  }
}

// Distance to the nearest cell of the truth.
double errorOf(const vpPatternCell &cell, const Pattern &pattern)
{
  const int row = static_cast<int>(std::lround((cell.y - pattern.y) / pattern.pitchY));
  const int column = static_cast<int>(std::lround((cell.x - pattern.x) / pattern.pitchX));
  double least = 1e9;
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = column - 1; c <= column + 1; ++c) {
      least = std::min(least, std::hypot(cell.x - pattern.cellPositionX(r, c), cell.y - pattern.cellPositionY(r, c)));
    }
  }
  return least;
}
} // namespace

TEST_CASE("cells behind things of like grey are invalid, right or say how far off they may be", "[tracker][occlusion]")
{
  const int runs = vpTestSupport::longer(3);
  CAPTURE(vpTestSupport::seed());
  constexpr int phases = 40, images = 4000; // the pattern goes to and fro, so that its pictures are made once
  long valid = 0, wide = 0, wrong = 0, far = 0;
  double worst = 0.;
  for (int run = 0; run < runs; ++run) {
    auto rng = vpTestSupport::generator(870 + static_cast<unsigned int>(run));
    const auto uniform = [&rng](double from, double to) {
      return std::uniform_real_distribution<double>(from, to)(rng);
    };
    Pattern pattern;
    pattern.noise = uniform(1., 4.);
    pattern.jitter = uniform(0., 0.3);
    std::vector<Pattern> places(phases, pattern);
    std::vector<vpImage<unsigned char>> pictures(phases);
    for (int k = 0; k < phases; ++k) {
      Pattern &place = places[static_cast<std::size_t>(k)];
      place.x += 7. * std::sin(2. * M_PI * k / phases);
      place.y += 2. * std::sin(2. * M_PI * k / phases);
      place.render(rng, pictures[static_cast<std::size_t>(k)]);
    }
    vpPatternTracker tracker(160, 100);
    for (int i = 0; i < 3 * phases; ++i) {
      tracker.process(pictures[static_cast<std::size_t>(i % phases)]);
    }
    std::vector<Occluder> occluders;
    for (int i = 0; i < images; ++i) {
      const Pattern &place = places[static_cast<std::size_t>(i % phases)];
      vpImage<unsigned char> image = pictures[static_cast<std::size_t>(i % phases)];
      if (occluders.size() < 2 && uniform(0., 1.) < 0.2) {
        const double grey = uniform(0., 1.) < 0.5
                                ? (uniform(0., 1.) < 0.5 ? pattern.bright : pattern.dark) + uniform(-15., 15.)
                                : uniform(40., 190.);
        occluders.push_back({uniform(0., 160.), uniform(0., 100.), uniform(4., 30.), uniform(3., 20.), grey,
                             uniform(-3., 3.), uniform(-2., 2.), uniform(0.5, 2.), int(uniform(3., 60.))});
      }
      for (Occluder &o : occluders) {
        draw(o, pattern, rng, image);
        o.x += o.vx;
        o.y += o.vy;
        --o.life;
      }
      occluders.erase(std::remove_if(occluders.begin(), occluders.end(), [](const Occluder &o) { return o.life <= 0; }),
                      occluders.end());
      for (const vpPatternCell &cell : tracker.process(image).cells) {
        if (cell.valid) {
          const double error = errorOf(cell, place);
          const double told = 4. * std::max(cell.sigmaX, cell.sigmaY);
          worst = std::max(worst, error);
          wide += told > 0.5 ? 1 : 0;
          wrong += error > 0.5 ? 1 : 0;
          far += error > std::max(0.5, told) ? 1 : 0;
          ++valid;
        }
      }
    }
  }
  WARN(valid << " valid cells in " << runs * images << " images, " << wrong << " off by more than 0.5 px, " << far
             << " of them by more than four of their sigmas, the worst " << worst << " px");
  CHECK(valid > 10L * runs * images); // of 11 in view, less what is hidden
  // Normal errors are beyond four deviations in both directions together once in exp(8) times; only where that is more than 0.5 px
  // can it count. And then as many more as a count of that mean has once in 100,000 times.
  const double most = std::exp(-8.) * static_cast<double>(wide);
  CHECK(static_cast<double>(far) <= most + 4.26 * std::sqrt(most));
  // A cell that was taken for something else was followed beside its place for good: 20 to 190 of them then.
  CHECK(wrong <= valid / 10000);
}
