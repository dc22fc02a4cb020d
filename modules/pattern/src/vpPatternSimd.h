/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// A second copy of the hot loops for AVX2, chosen when the program is loaded; the module itself is built for any x86-64.
#ifndef vpPatternSimd_h
#define vpPatternSimd_h

#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && !defined(__clang__) &&                             \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define VISP_PATTERN_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define VISP_PATTERN_CLONES
#endif

#endif
