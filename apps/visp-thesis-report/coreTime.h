/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file coreTime.h
 * \brief CPU time of this thread, as parts of the report and other programs run in parallel.
 */
#ifndef thesisReport_coreTime_h
#define thesisReport_coreTime_h

#include <ctime>

namespace thesisReport
{
//! CPU time of this thread, s; waiting for a core does not count.
[[nodiscard]] inline double coreSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
} // namespace thesisReport

#endif
