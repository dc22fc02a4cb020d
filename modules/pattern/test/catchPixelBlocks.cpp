/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Thresholds of 64 pixels at once: with vector instructions, and the version for processors without them.
#include "../src/vpPatternSpot.cpp" // not exported

#include "vpCatch.h"

#include <array>

TEST_CASE("blocks of pixels above a threshold, by every version", "[threshold]")
{
  for (int problem = 0; problem < vpTestSupport::longer(2000); ++problem) {
    std::mt19937_64 rng = vpTestSupport::generator(static_cast<unsigned int>(problem));
    const int threshold = problem % 256; // values on both sides of it, and it
    const int spread = problem % 3 == 0 ? 255 : 2;
    std::array<unsigned char, block> pixels;
    for (unsigned char &p : pixels) {
      p = static_cast<unsigned char>(
          std::clamp(std::uniform_int_distribution<int>(threshold - spread, threshold + spread)(rng), 0, 255));
    }
    const std::uint64_t fast = blockAbove(pixels.data(), threshold),
                        slow = blockAboveAnywhere(pixels.data(), threshold);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      CAPTURE(problem, i, threshold, int{pixels[i]});
      REQUIRE((fast >> i & 1U) == (pixels[i] > threshold ? 1U : 0U));
      REQUIRE((slow >> i & 1U) == (pixels[i] > threshold ? 1U : 0U));
    }
  }
}
