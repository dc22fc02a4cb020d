/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpFieldCheck.h"

#include <visp3/servoing/vpRealTime.h>

#ifdef __linux__
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#endif

#include <cerrno>
#include <cstddef>
#include <system_error>

BEGIN_VISP_NAMESPACE

#ifdef __linux__
namespace
{
std::string reason(int error) { return " (" + std::generic_category().message(error) + ")"; }

void touchStack()
{
  constexpr std::size_t size = 256U << 10U, page = 4096;
  unsigned char stack[size];
  volatile unsigned char *const bytes = stack; // or the compiler leaves it out
  for (std::size_t i = 0; i < size; i += page) {
    bytes[i] = 0;
  }
}
} // namespace
#endif

vpRealTimeGrant vpRequestRealTime(int priority)
{
  constexpr vpFieldCheck fields("the real-time thread");
  fields.in("priority", priority, {1., 99.});
  vpRealTimeGrant grant;
#ifdef __linux__
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int refused = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  grant.isScheduled = refused == 0;
  grant.isLocked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  const int unlocked = grant.isLocked ? 0 : errno;
  touchStack();
  grant.message = (grant.isScheduled ? "SCHED_FIFO with priority " + std::to_string(priority)
                                     : "SCHED_FIFO was refused" + reason(refused)) +
                  (grant.isLocked ? ", memory locked." : ", memory not locked" + reason(unlocked) + ".");
#else
  grant.message = "Real-time scheduling is requested on Linux only.";
#endif
  return grant;
}

END_VISP_NAMESPACE
