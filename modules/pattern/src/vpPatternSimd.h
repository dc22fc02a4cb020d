/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A second copy of the hot loops for AVX2, selected at load time; the module itself is built for any x86-64.
#ifndef vpPatternSimd_h
#define vpPatternSimd_h

#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VISP_PATTERN_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define VISP_PATTERN_CLONES
#endif

#include <cstddef>
#include <cstdint>
#include <vector>

//! Vectors of this many bytes that begin at multiples of it never cross a cache line.
constexpr std::size_t vpPatternAlignment = 64;

//! Memory for \e count numbers from alignedBegin() on.
template <typename Number> std::vector<Number> alignedRoom(std::size_t count)
{
  return std::vector<Number>(count + vpPatternAlignment / sizeof(Number));
}

//! First number of alignedRoom() whose address is a multiple of vpPatternAlignment.
template <typename Number> Number *alignedBegin(std::vector<Number> &room)
{
  const auto address = reinterpret_cast<std::uintptr_t>(room.data());
  const std::size_t over = address % vpPatternAlignment;
  return room.data() + (over == 0 ? 0 : (vpPatternAlignment - over) / sizeof(Number));
}

#endif
