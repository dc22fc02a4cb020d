/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Distance of a segment from a point, segment, box or cylinder, for one configuration (double) or several at once (a
// vector of doubles): no branches, so both use the same formulae.
#ifndef vpSegmentKernel_h
#define vpSegmentKernel_h

#include <cmath>

#if defined(__GNUC__)
#define VP_KERNEL_INLINE inline __attribute__((always_inline))
#else
#define VP_KERNEL_INLINE inline
#endif

namespace vpSegmentKernel
{
#include "vpSegmentKernelBody.h"
} // namespace vpSegmentKernel
#endif
