/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A second copy of the hot loops for AVX2, selected at load time; the module itself is built for any x86-64. With memory
// for them, and interpolation by cubics, as filters along rows and columns.
#ifndef vpPatternSimd_h
#define vpPatternSimd_h

// Sanitizers are not ready yet when the choice is made.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define VISP_PATTERN_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VISP_PATTERN_SANITIZED
#endif
#if defined(__x86_64__) && defined(__ELF__) && defined(__has_attribute) && !defined(VISP_PATTERN_SANITIZED)
#if __has_attribute(target_clones)
#define VISP_PATTERN_CLONES __attribute__((target_clones("avx2", "default")))
#endif
#endif
#ifndef VISP_PATTERN_CLONES
#define VISP_PATTERN_CLONES
#endif

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <algorithm>
#include <array>
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

BEGIN_VISP_NAMESPACE

namespace vpCubicFilter
{
using Taps = std::array<float, 4>;

// Interpolation by a cubic of third order (Keys 1981) between the second and the third of four neighbours.
inline Taps keys(double f)
{
  return {static_cast<float>(((-0.5 * f + 1.) * f - 0.5) * f), static_cast<float>((1.5 * f - 2.5) * f * f + 1.),
          static_cast<float>(((-1.5 * f + 2.) * f + 0.5) * f), static_cast<float>((0.5 * f - 0.5) * f * f)};
}

// Cubic B-spline and its derivative.
inline Taps spline(double f)
{
  const double g = 1. - f;
  return {static_cast<float>(g * g * g / 6.), static_cast<float>((4. - 6. * f * f + 3. * f * f * f) / 6.),
          static_cast<float>((4. - 6. * g * g + 3. * g * g * g) / 6.), static_cast<float>(f * f * f / 6.)};
}

inline Taps splineSlope(double f)
{
  const double g = 1. - f;
  return {static_cast<float>(-0.5 * g * g), static_cast<float>(-2. * f + 1.5 * f * f),
          static_cast<float>(2. * g - 1.5 * g * g), static_cast<float>(0.5 * f * f)};
}

// to[i] = sum of t[k] from[i + k * stride]
inline void filter(const float *from, int count, int stride, const Taps &t, float *__restrict to)
{
  for (int i = 0; i < count; ++i) {
    to[i] = t[0] * from[i] + t[1] * from[i + stride] + t[2] * from[i + 2 * stride] + t[3] * from[i + 3 * stride];
  }
}

// The border of the image is repeated: only the surroundings of a cell's window may lie outside.
inline float clampedPixel(const vpImage<unsigned char> &image, int x, int y)
{
  return static_cast<float>(image[static_cast<unsigned int>(std::clamp(y, 0, static_cast<int>(image.getHeight()) - 1))]
                                 [static_cast<unsigned int>(std::clamp(x, 0, static_cast<int>(image.getWidth()) - 1))]);
}
} // namespace vpCubicFilter

END_VISP_NAMESPACE
#endif
