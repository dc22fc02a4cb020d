/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Catch2's implementation and main, compiled once for all tests. ViSP's ctest passes "-c" and "-d" (later
// "--no-display") to every test program; they mean nothing here and are dropped.
#define CATCH_CONFIG_RUNNER
#include "vpCatch.h"

#include <cstring>
#include <vector>

namespace
{
constexpr int skipped = 77; // SKIP_RETURN_CODE of cmake/VispDirectModule.cmake
unsigned int s_seed = 20240613;
bool s_skipped = false;
} // namespace

namespace vpTestSupport
{
unsigned int seed() { return s_seed; }

std::mt19937_64 generator(unsigned int index)
{
  std::seed_seq sequence{s_seed, index};
  return std::mt19937_64(sequence);
}

void skip(const std::string &why)
{
  s_skipped = true;
  WARN("skipped: " << why);
}
} // namespace vpTestSupport

int main(int argc, char *argv[])
{
  std::vector<char *> arguments;
  bool seedGiven = false;
  for (int i = 0; i < argc; ++i) {
    if (std::strcmp(argv[i], "-c") == 0 || std::strcmp(argv[i], "-d") == 0 ||
        std::strcmp(argv[i], "--no-display") == 0) {
      continue;
    }
    seedGiven = seedGiven || std::strcmp(argv[i], "--rng-seed") == 0;
    arguments.push_back(argv[i]);
  }
  Catch::Session session;
  const int status = session.applyCommandLine(static_cast<int>(arguments.size()), arguments.data());
  if (status != 0) {
    return status;
  }
  if (seedGiven) {
    s_seed = session.config().rngSeed();
  }
  const int failed = session.run();
  return failed == 0 && s_skipped ? skipped : failed;
}
