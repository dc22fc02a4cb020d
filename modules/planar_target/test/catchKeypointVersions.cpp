/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Distances of binary descriptors by the version for each kind of processor, of which a machine uses only one, bit by bit.
#include "../src/vpKeypoints.cpp" // not exported

#include "vpCatch.h"

VISP_DIRECT_USING_NAMESPACE

namespace
{
std::vector<std::pair<const char *, CompareRow>> versionsOfThisMachine()
{
  std::vector<std::pair<const char *, CompareRow>> versions = {{"anywhere", compareRowAnywhere},
                                                               {"best", bestVersion()}};
#ifdef VISP_DIRECT_POPCOUNT_VERSIONS
  if (__builtin_cpu_supports("popcnt") && __builtin_cpu_supports("sse4.1")) {
    versions.emplace_back("popcount", compareRowPopcount);
  }
#endif
  return versions;
}

int distanceOf(const std::uint64_t *from, const std::vector<std::uint64_t> &to, std::size_t j, std::size_t n,
               std::size_t words)
{
  int distance = 0;
  for (std::size_t bit = 0; bit < 64 * words; ++bit) {
    distance += (from[bit / 64] >> bit % 64 & 1U) != (to[bit / 64 * n + j] >> bit % 64 & 1U) ? 1 : 0;
  }
  return distance;
}
} // namespace

TEST_CASE("distances of binary descriptors, by every version", "[matching]")
{
  for (int problem = 0; problem < vpTestSupport::longer(200); ++problem) {
    std::mt19937_64 rng = vpTestSupport::generator(static_cast<unsigned int>(problem));
    const std::size_t n = std::uniform_int_distribution<std::size_t>(1, 70)(rng), words = problem % 2 == 0 ? 4 : 8;
    const std::uint64_t different = problem % 3 == 0 ? 7U : ~std::uint64_t(0); // few bits: many equal distances
    std::vector<std::uint64_t> from(words), to(words * n);
    for (std::vector<std::uint64_t> *set : {&from, &to}) {
      std::generate(set->begin(), set->end(), [&] { return rng() & different; });
    }
    std::vector<int> distances(n);
    for (std::size_t j = 0; j < n; ++j) {
      distances[j] = distanceOf(from.data(), to, j, n, words);
    }
    const auto best = std::min_element(distances.begin(), distances.end());
    std::vector<int> others = distances;
    others.erase(others.begin() + (best - distances.begin()));
    for (const auto &[name, compare] : versionsOfThisMachine()) {
      const int row = problem;
      std::vector<int> keys(n), columns(n, far);
      const Nearest nearest = compare(from.data(), to.data(), n, words, row, keys.data(), columns.data());
      CAPTURE(problem, n, words, name);
      REQUIRE(distanceOf(nearest.best) == *best);
      REQUIRE(placeOf(nearest.best) == best - distances.begin());
      REQUIRE((n > 1 ? distanceOf(nearest.second) == *std::min_element(others.begin(), others.end())
                     : nearest.second == far));
      for (std::size_t j = 0; j < n; ++j) {
        REQUIRE(distanceOf(columns[j]) == distances[j]);
        REQUIRE(placeOf(columns[j]) == row);
      }
    }
  }
}
