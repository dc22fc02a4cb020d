/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpGreyLanes.h"

#include <algorithm>
#include <cstring>

#define VP_GREY_INLINE inline __attribute__((always_inline))

// One entry per instruction set, chosen at run time: the build needs no -march, and no type whose layout depends on it
// crosses a call.
#if defined(__x86_64__) && defined(__GNUC__)
#define VP_TARGET(set) __attribute__((target(set)))
#define VP_GREY_VERSIONS
#else
#define VP_TARGET(set)
#endif

BEGIN_VISP_NAMESPACE

namespace
{
namespace four
{
constexpr int lanes = 4;
#include "vpGreyLanesBody.h"
} // namespace four
// GCC breaks vectors up before it inlines, so that the body must have the entry's instruction set, too.
#if defined(VP_GREY_VERSIONS)
#if !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
namespace eight
{
constexpr int lanes = 8;
#include "vpGreyLanesBody.h"
} // namespace eight
#if !defined(__clang__)
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512bw,avx512vl,avx2,fma")
#endif
namespace sixteen
{
constexpr int lanes = 16;
#include "vpGreyLanesBody.h"
} // namespace sixteen
#if !defined(__clang__)
#pragma GCC pop_options
#endif
#endif

// The entries of one version: body(...) compiled for an instruction set.
#define VP_GREY_ENTRIES(version, body, target)                                                                         \
  namespace version                                                                                                    \
  {                                                                                                                    \
  target int sampleFrame(const vpGreyFrameRow &row, int cols, float *values)                                           \
  {                                                                                                                    \
    return body::sampleFrame(row, cols, values);                                                                       \
  }                                                                                                                    \
  target void sampleTexture(const vpGreyTextureRow &row, int count, float *values)                                     \
  {                                                                                                                    \
    body::sampleTexture(row, count, values);                                                                           \
  }                                                                                                                    \
  target void lightSums(const vpGreySamples &samples, int count, double *sums)                                         \
  {                                                                                                                    \
    body::lightSums(samples, count, sums);                                                                             \
  }                                                                                                                    \
  target void normalSums(const vpGreySamples &samples, const vpGreyGrid &grid, double *sums)                           \
  {                                                                                                                    \
    body::normalSums(samples, grid, sums);                                                                             \
  }                                                                                                                    \
  target void moments(const vpGreySamples &samples, int rows, std::ptrdiff_t step, vpGreyMoments &m)                   \
  {                                                                                                                    \
    body::moments(samples, rows, step, m);                                                                             \
  }                                                                                                                    \
  target void filterRow(const float *left, const float *right, const float *const *kernels, int size, int count,       \
                        float *const *out)                                                                             \
  {                                                                                                                    \
    body::filterRow(left, right, kernels, size, count, out);                                                           \
  }                                                                                                                    \
  target void filterColumns(const float *const *below, const float *const *above, const float *const *kernels,         \
                            int size, int count, float *const *out)                                                    \
  {                                                                                                                    \
    body::filterColumns(below, above, kernels, size, count, out);                                                      \
  }                                                                                                                    \
  target void residuals(const vpGreyPixels &pixels, const vpGreyBlock *blocks, std::size_t count,                      \
                        const double *change, float gain, float bias, float beta)                                      \
  {                                                                                                                    \
    body::residuals(pixels, blocks, count, change, gain, bias, beta);                                                  \
  }                                                                                                                    \
  target void blockSums(const vpGreyPixels &pixels, const vpGreyBlock *blocks, std::size_t count,                      \
                        vpGreyWeights::Kind kind, const vpGreyWeights &weights, float *sums)                           \
  {                                                                                                                    \
    body::blockSums(pixels, blocks, count, kind, weights, sums);                                                       \
  }                                                                                                                    \
  target void assemble(const vpGreyBlock *blocks, const float *sums, std::size_t count, double gain,                   \
                       vpGreyNormal &normal)                                                                           \
  {                                                                                                                    \
    body::assemble(blocks, sums, count, gain, normal);                                                                 \
  }                                                                                                                    \
  target void misfit(const float *e, const float *du, const float *dv, int begin, int end, int count,                  \
                     const vpGreyWeights &variance, float cap, float limit, float *out)                                \
  {                                                                                                                    \
    body::misfit(e, du, dv, begin, end, count, variance, cap, limit, out);                                             \
  }                                                                                                                    \
  constexpr vpGreyLanes table = {#version,  sampleFrame,   sampleTexture, lightSums, normalSums, moments,              \
                                 filterRow, filterColumns, residuals,     blockSums, assemble,   misfit};              \
  }

VP_GREY_ENTRIES(baseline, four, )
#ifdef VP_GREY_VERSIONS
VP_GREY_ENTRIES(avx2, eight, VP_TARGET("avx2,fma"))
VP_GREY_ENTRIES(avx512, sixteen, VP_TARGET("avx512f,avx512dq,avx512bw,avx512vl,avx2,fma"))
#endif

const vpGreyLanes &chooseLanes()
{
#ifdef VP_GREY_VERSIONS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl")) {
    return avx512::table;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return avx2::table;
  }
#endif
  return baseline::table;
}
} // namespace

const vpGreyLanes &vpChosenGreyLanes()
{
  static const vpGreyLanes &chosen = chooseLanes();
  return chosen;
}

END_VISP_NAMESPACE
