/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Catch2's implementation and main, compiled once for all tests. ViSP's ctest passes "-c" and "-d" (later
// "--no-display") to every test program; they have no meaning here and are dropped.
#define CATCH_CONFIG_RUNNER
#include "vpCatch.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

namespace
{
constexpr int skipped = 77; // SKIP_RETURN_CODE of cmake/VispDirectModule.cmake
unsigned int s_seed = 20240613;
bool s_skipped = false;
bool s_ran = false;             // any test
bool s_halved = false;          // see vpTestSupport::longer()
std::set<std::string> s_random; // names of the tests that used the seed

#if __has_include(<catch2/catch_all.hpp>)
using CatchListener = Catch::EventListenerBase;
#else
using CatchListener = Catch::TestEventListenerBase;
#endif

struct Listener : CatchListener {
  using CatchListener::CatchListener;
  void testCaseStarting(const Catch::TestCaseInfo &) override { s_ran = true; }
};
CATCH_REGISTER_LISTENER(Listener)

void noteRandomTest() { s_random.insert(Catch::getResultCapture().getCurrentTestName()); }

// Adds tags that tests must have: to each alternative of a filter; commas outside of quotes and brackets separate them.
std::string withTags(const std::string &filter, const std::string &tags)
{
  std::string text;
  char closing = '\0';
  for (std::size_t i = 0; i < filter.size(); ++i) {
    const char c = filter[i];
    if (c == '\\' && i + 1 < filter.size()) {
      text += c;
      text += filter[++i];
      continue;
    }
    if (closing != '\0') {
      closing = c == closing ? '\0' : closing;
    }
    else if (c == '"' || c == '[') {
      closing = c == '[' ? ']' : c;
    }
    else if (c == ',') {
      text += tags;
    }
    text += c;
  }
  return text;
}

// A program that unites the tests of several files runs those of catchName.cpp alone when it is called catchName. Tests that
// need a library which this build has not are left out.
void selectTests(Catch::ConfigData &config, const char *called)
{
  std::string tags = VISP_DIRECT_WITHOUT;
  std::string name(called);
  name.erase(0, name.find_last_of("/\\") + 1); // npos + 1 is 0
  name.erase(std::min(name.find('.'), name.size()));
  if (name.compare(0, 5, "catch") == 0) {
    config.filenamesAsTags = true;
    tags += "[#" + name + "]";
  }
  if (tags.empty()) {
    return;
  }
  std::vector<std::string> &filters = config.testsOrTags;
  std::transform(filters.begin(), filters.end(), filters.begin(), [&](const auto &f) { return withTags(f, tags); });
  filters.push_back(filters.empty() ? tags + "~[.]" : tags); // hidden tests run only when they are named
}

// Runs the random tests again, with a seed from the environment; a test that its filter does not find is a failure.
int runAgain(Catch::Session &session, unsigned int seed)
{
  Catch::ConfigData config = session.configData();
  config.testsOrTags.clear();
  for (const std::string &name : s_random) {
    std::string quoted;
    for (const char c : name) {
      quoted += std::strchr("\"\\[*,", c) != nullptr ? std::string("\\") + c : std::string(1, c);
    }
    config.testsOrTags.push_back((config.testsOrTags.empty() ? "\"" : ",\"") + quoted + "\"");
  }
  config.rngSeed = s_seed = seed;
  session.useConfigData(config);
  std::cout << "The same at seed " << seed << " (VISP_DIRECT_SEED): " << s_random.size() << " random tests\n";
  const std::set<std::string> wanted = std::exchange(s_random, {});
  const int failed = session.run();
  if (failed == 0 && s_random != wanted) {
    std::cerr << wanted.size() - s_random.size() << " random tests were not run again\n";
    return 1;
  }
  return failed;
}
} // namespace

namespace vpTestSupport
{
int longer(int count)
{
  const char *factor = std::getenv("VISP_DIRECT_LONG_TESTS");
  const int all = count * std::max(1, factor == nullptr ? 1 : std::atoi(factor));
  return s_halved ? (all + 1) / 2 : all;
}

unsigned int seed()
{
  noteRandomTest();
  return s_seed;
}

std::mt19937_64 generator(unsigned int index)
{
  std::seed_seq sequence{seed(), index};
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
  selectTests(session.configData(), argv[0]);
  if (seedGiven) {
    s_seed = session.configData().rngSeed;
  }
  const char *seeds = std::getenv("VISP_DIRECT_SEED");
  s_halved = !seedGiven && seeds != nullptr;
  int failed = session.run();
  if (!s_ran && *VISP_DIRECT_WITHOUT != '\0') {
    std::cout << "skipped: no test of this file runs without the libraries that are missing\n";
    return skipped;
  }
  if (s_halved && !s_random.empty()) {
    std::istringstream list(seeds);
    for (unsigned int seed = 0; failed == 0 && !(list >> std::ws).eof();) {
      if (list >> seed) {
        failed = runAgain(session, seed);
        continue;
      }
      std::cerr << "VISP_DIRECT_SEED is \"" << seeds << "\", must be whole numbers from 0 to 4294967295\n";
      failed = 1;
    }
  }
  return failed == 0 && s_skipped ? skipped : failed;
}
