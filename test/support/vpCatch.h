/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCatch.h
 * \brief Catch2 for every build: 2.13 of Debian, the copy embedded in ViSP 3.5, or 3.x.
 *
 * The main function is in vpTestMain.cpp, linked to all tests. Random tests take their seed from
 * vpTestSupport::seed(), which Catch2's `--rng-seed` sets and every failure prints. If the environment variable
 * VISP_DIRECT_SEED holds numbers, separated by spaces, the tests that used the seed run again with each of them.
 */
#ifndef vpCatch_h
#define vpCatch_h

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
namespace Catch // names moved since version 2
{
using Matchers::EndsWith;
using Matchers::StartsWith;
inline auto Contains(const std::string &text) { return Matchers::ContainsSubstring(text); }
} // namespace Catch
#elif __has_include(<catch2/catch.hpp>)
#include <catch2/catch.hpp>
#else
#include <catch.hpp>
#endif

#include <random>
#include <string>

namespace vpTestSupport
{
/*!
 * Seed of this run: fixed by default so that failures repeat; set with `--rng-seed N` or `--rng-seed time`.
 * Use with CAPTURE(seed).
 */
unsigned int seed();

//! Generator of the random problem number \e index of this run: independent streams, repeatable one by one.
std::mt19937_64 generator(unsigned int index = 0);

//! Uniform random number.
inline double uniform(std::mt19937_64 &rng, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(rng);
}

/*!
 * Number of random problems: \e count; the environment variable VISP_DIRECT_LONG_TESTS=N makes it N times as many. With
 * VISP_DIRECT_SEED, which repeats the test at other seeds, each run does half of it.
 */
int longer(int count);

//! Skips a check with a reason ("image x is not installed"). If nothing failed, ctest then reports "Skipped".
void skip(const std::string &why);

//! Number of heap allocations (malloc, calloc, realloc, new) made by this thread since the program began.
unsigned long allocationCount();
//! False if the build cannot count (sanitizers); tests of allocations are then skipped with a message.
bool canCountAllocations();
} // namespace vpTestSupport

#endif
