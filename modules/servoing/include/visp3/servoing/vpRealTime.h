/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpRealTime.h
 * \brief Asks the operating system to run a control thread on time.
 */
#ifndef vpRealTime_h
#define vpRealTime_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <string>

BEGIN_VISP_NAMESPACE

//! \ingroup group_servoing
//! \brief What the operating system has allowed.
struct VISP_EXPORT vpRealTimeGrant {
  bool isScheduled = false; //!< The thread runs with SCHED_FIFO at the requested priority.
  bool isLocked = false;    //!< The memory of the process stays in RAM (mlockall): no step waits for a disk.
  std::string message;      //!< Both grants in one sentence, with the reason of a refusal.
};

/*!
 * \ingroup group_servoing
 * \brief Gives the calling thread a fixed priority (SCHED_FIFO), locks the memory of the process and touches 256 kB of
 * the stack. Call it in the control thread, before its loop; Linux only.
 *
 * Neither is required, but a loop without them is late more often. A thread with SCHED_FIFO that never sleeps blocks
 * its processor for everything else. See doc/real-time.md.
 *
 * \code
 * const vpRealTimeGrant grant = vpRequestRealTime();
 * if (!grant.isScheduled || !grant.isLocked) {
 *   std::cerr << grant.message << std::endl; // the loop works, but is late more often
 * }
 * \endcode
 * \param priority : 1..99; interrupt threads of a PREEMPT_RT kernel have 50.
 * \return What was allowed.
 * \throw vpException (badValue) naming a priority out of range.
 */
[[nodiscard]] VISP_EXPORT vpRealTimeGrant vpRequestRealTime(int priority = 40);

END_VISP_NAMESPACE
#endif
