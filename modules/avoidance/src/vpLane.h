/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Vectors of two, four or eight doubles, for different register widths. Include before vpSegmentKernel.h, whose
// templates must find root().
#ifndef vpLane_h
#define vpLane_h

using vpLane2 = double __attribute__((vector_size(16)));
using vpLane4 = double __attribute__((vector_size(32)));
using vpLane8 = double __attribute__((vector_size(64)));

namespace vpSegmentKernel
{
template <class Lane, int lanes> inline __attribute__((always_inline)) Lane rootOf(const Lane &v)
{
  Lane r;
  for (int l = 0; l < lanes; ++l) {
    r[l] = __builtin_sqrt(v[l]);
  }
  return r;
}
inline __attribute__((always_inline)) vpLane2 root(const vpLane2 &v) { return rootOf<vpLane2, 2>(v); }
inline __attribute__((always_inline)) vpLane4 root(const vpLane4 &v) { return rootOf<vpLane4, 4>(v); }
inline __attribute__((always_inline)) vpLane8 root(const vpLane8 &v) { return rootOf<vpLane8, 8>(v); }
} // namespace vpSegmentKernel
#endif
