/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file coreTime.h
 * \brief How long a core has worked for this thread: parts of the report run beside each other, and so do other
 * programs of the machine.
 */
#ifndef thesisReport_coreTime_h
#define thesisReport_coreTime_h

#include <ctime>

namespace thesisReport
{
//! Time that cores have spent on this thread, s. While it waits for a core it stands still.
[[nodiscard]] inline double coreSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
} // namespace thesisReport

#endif
