/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpEdgeLanes.h"

#include "vpSegmentKernel.h"

#include <atomic>
#include <cmath>
#include <optional>

// Vectors of two, four or eight doubles, for different register widths.
using vpLane2 = double __attribute__((vector_size(16)));
using vpLane4 = double __attribute__((vector_size(32)));
using vpLane8 = double __attribute__((vector_size(64)));

// One entry per instruction set, chosen at run time: the build needs no -march, and no type whose layout depends on it
// crosses a call.
#if defined(__x86_64__) && defined(__GNUC__)
#define VP_TARGET(set) __attribute__((target(set)))
#define VP_EDGE_VERSIONS
#else
#define VP_TARGET(set)
#endif

BEGIN_VISP_NAMESPACE

namespace
{
// Rounding of distances, and of the normals of nearest points over the size of a core.
constexpr double rounding = 1e-9, normalRounding = 1e-7;

template <class Lane, int lanes> inline __attribute__((always_inline)) Lane rootOf(const Lane &v)
{
  Lane r;
  for (int l = 0; l < lanes; ++l) {
    r[l] = __builtin_sqrt(v[l]);
  }
  return r;
}

namespace two
{
using vpLane = vpLane2;
constexpr int lanes = 2;
VP_KERNEL_INLINE vpLane root(const vpLane &v) { return rootOf<vpLane, lanes>(v); }
#include "vpSegmentKernelBody.h"
#include "vpEdgeLanesBody.h"
} // namespace two
// GCC breaks vectors up before it inlines, so that the bodies must have the entry's instruction set, too.
#if defined(VP_EDGE_VERSIONS)
#if !defined(__clang__)
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
namespace four
{
using vpLane = vpLane4;
constexpr int lanes = 4;
VP_KERNEL_INLINE vpLane root(const vpLane &v) { return rootOf<vpLane, lanes>(v); }
#include "vpSegmentKernelBody.h"
#include "vpEdgeLanesBody.h"
} // namespace four
#if !defined(__clang__)
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512vl,avx2,fma")
#endif
namespace eight
{
using vpLane = vpLane8;
constexpr int lanes = 8;
VP_KERNEL_INLINE vpLane root(const vpLane &v) { return rootOf<vpLane, lanes>(v); }
#include "vpSegmentKernelBody.h"
#include "vpEdgeLanesBody.h"
} // namespace eight
#if !defined(__clang__)
#pragma GCC pop_options
#endif
#endif

using Entry = void (*)(const vpEdgeMotion &, const vpEdgePair *, const std::uint32_t *, int, double, double,
                       vpEdgeBatch &);

void evaluateBaseline(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list, int count,
                      double start, double piece, vpEdgeBatch &batch)
{
  for (int group = 0; group < 8; group += 2) {
    if (!two::evaluate(motion, pairs, list, count, start, piece, group, batch)) {
      return;
    }
  }
}

#if defined(VP_EDGE_VERSIONS)
VP_TARGET("avx2,fma")
void evaluateAvx2(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list, int count,
                  double start, double piece, vpEdgeBatch &batch)
{
  for (int group = 0; group < 8; group += 4) {
    if (!four::evaluate(motion, pairs, list, count, start, piece, group, batch)) {
      return;
    }
  }
}

VP_TARGET("avx512f,avx512dq,avx512vl,avx2,fma")
void evaluateAvx512(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list, int count,
                    double start, double piece, vpEdgeBatch &batch)
{
  static_cast<void>(eight::evaluate(motion, pairs, list, count, start, piece, 0, batch));
}
#endif

Entry chooseEntry()
{
#if defined(VP_EDGE_VERSIONS)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
    return evaluateAvx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return evaluateAvx2;
  }
#endif
  return evaluateBaseline;
}

// Chosen at the first call, not by an initialiser: those of other files may call it earlier. No lock: all threads
// choose the same.
std::atomic<Entry> chosen{nullptr};
} // namespace

void vpEvaluateEdge(const vpEdgeMotion &motion, const vpEdgePair *pairs, const std::uint32_t *list, int count,
                    double start, double width, vpEdgeBatch &batch) noexcept
{
  batch.hitPair = -1;
  batch.count = 0;
  Entry entry = chosen.load(std::memory_order_relaxed);
  if (!entry) {
    entry = chooseEntry();
    chosen.store(entry, std::memory_order_relaxed);
  }
  entry(motion, pairs, list, count, start, width / 8., batch);
}

END_VISP_NAMESPACE
