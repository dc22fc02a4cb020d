/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file jobs.h
 * \brief Independent jobs on several threads.
 */
#ifndef vpApp_jobs_h
#define vpApp_jobs_h

#include <cstddef>
#include <functional>

namespace vpApp
{
//! Number of processor cores, at least 1.
[[nodiscard]] unsigned int coreCount();

/*!
 * Call \e work(0) ... \e work(count - 1), each once, on \e threads threads, started in order. OpenCV's own
 * threads are disabled meanwhile, as the jobs use all cores.
 * \param count : Number of jobs. \param threads : >= 1; with 1 everything runs in the calling thread.
 * \param work : Must be safe to call at the same time for different indices.
 * \throw Whatever \e work throws: the exception of the lowest index, after all threads have ended. Jobs not
 * started by then are skipped.
 */
void runJobs(std::size_t count, unsigned int threads, const std::function<void(std::size_t)> &work);
} // namespace vpApp

#endif
