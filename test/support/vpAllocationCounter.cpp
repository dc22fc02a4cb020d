/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Counts heap allocations by replacing the C allocator: ViSP's arrays use realloc, Eigen and the standard library
// malloc or new, and all of them end here. Only for glibc, and not together with a sanitizer.
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace
{
thread_local unsigned long s_allocations = 0;
}

extern "C" {
void *__libc_malloc(std::size_t);
void *__libc_calloc(std::size_t, std::size_t);
void *__libc_realloc(void *, std::size_t);
void *__libc_memalign(std::size_t, std::size_t);

void *malloc(std::size_t size)
{
  ++s_allocations;
  return __libc_malloc(size);
}

void *calloc(std::size_t count, std::size_t size)
{
  ++s_allocations;
  return __libc_calloc(count, size);
}

void *realloc(void *old, std::size_t size)
{
  ++s_allocations;
  return __libc_realloc(old, size);
}

void *memalign(std::size_t alignment, std::size_t size)
{
  ++s_allocations;
  return __libc_memalign(alignment, size);
}

void *aligned_alloc(std::size_t alignment, std::size_t size)
{
  ++s_allocations;
  return __libc_memalign(alignment, size);
}
}

namespace vpTestSupport
{
unsigned long allocationCount() { return s_allocations; }
bool canCountAllocations() { return true; }
} // namespace vpTestSupport

#else

namespace vpTestSupport
{
unsigned long allocationCount() { return 0; }
bool canCountAllocations() { return false; }
} // namespace vpTestSupport

#endif
