/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPatternWorkers.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <chrono>
#include <system_error>

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

BEGIN_VISP_NAMESPACE

#ifdef VISP_PATTERN_THREADS
namespace
{
constexpr std::uint64_t rest = 0xffffffffU; // of a ticket: parts that nobody has taken

void pause()
{
#if defined(__x86_64__) || defined(__i386__)
  _mm_pause();
#endif
}

void sleepOn(sem_t &semaphore)
{
  while (sem_wait(&semaphore) != 0) { // interrupted by a signal
  }
}
} // namespace

vpPatternWorkers::vpPatternWorkers(int threads) : m_ranges(static_cast<std::size_t>(threads))
{
  sem_init(&m_wakeCaller, 0, 0);
  try {
    for (int k = 1; k < threads; ++k) {
      m_workers.push_back(std::make_unique<Worker>());
      Worker &worker = *m_workers.back();
      sem_init(&worker.wake, 0, 0);
      worker.thread = std::thread([this, &worker, k] { work(worker, k); });
    }
  }
  catch (const std::system_error &error) {
    stop();
    throw vpException(vpException::fatalError, "the pattern tracker cannot start %d threads: %s", threads,
                      error.what());
  }
}

vpPatternWorkers::~vpPatternWorkers() { stop(); }

void vpPatternWorkers::stop()
{
  m_end.store(true);
  wake();
  for (const auto &worker : m_workers) {
    if (worker->thread.joinable()) {
      worker->thread.join();
    }
    sem_destroy(&worker->wake);
  }
  sem_destroy(&m_wakeCaller);
}

void vpPatternWorkers::begin()
{
  m_awake = !m_workers.empty();
  m_open.store(true);
  wake();
}

void vpPatternWorkers::wake()
{
  for (const auto &worker : m_workers) {
    if (worker->sleeps.exchange(false)) {
      sem_post(&worker->wake);
    }
  }
}

void vpPatternWorkers::end()
{
  m_awake = false;
  m_open.store(false);
}

bool vpPatternWorkers::hasWork() const
{
  return m_end.load() || std::any_of(m_ranges.begin(), m_ranges.end(),
                                     [](const Range &range) { return (range.ticket.load() & rest) != 0; });
}

// Index of a part that is the calling thread's now, or -1. The number of the run keeps a thread that comes late from taking a part of
// the next run with what it has read of the last one.
int vpPatternWorkers::claim(int thread)
{
  for (std::size_t k = 0; k < m_ranges.size(); ++k) {
    Range &range = m_ranges[(static_cast<std::size_t>(thread) + k) % m_ranges.size()];
    std::uint64_t ticket = range.ticket.load(std::memory_order_acquire);
    while ((ticket & rest) != 0) {
      if (range.ticket.compare_exchange_weak(ticket, ticket - 1, std::memory_order_acq_rel,
                                             std::memory_order_acquire)) {
        return range.end - static_cast<int>(ticket & rest);
      }
    }
  }
  return -1;
}

void vpPatternWorkers::finish()
{
  m_finished.fetch_add(1);
  if (m_callerSleeps.exchange(false)) {
    sem_post(&m_wakeCaller);
  }
}

void vpPatternWorkers::work(Worker &worker, int thread)
{
  using Clock = std::chrono::steady_clock;
  constexpr auto patience = std::chrono::microseconds(200); // longer than what one thread does between two tasks
  Clock::time_point last = Clock::now();
  while (!m_end.load()) {
    const int part = claim(thread);
    if (part >= 0) {
      m_call(m_task, part, thread);
      finish();
      last = Clock::now();
    }
    else if (m_open.load() && Clock::now() - last < patience) {
      for (int k = 0; k < 8; ++k) {
        pause();
      }
    }
    else {
      worker.sleeps.store(true);
      // Either wake() sees that it sleeps, and posts, or it sees here what there is to do.
      if (!hasWork() || !worker.sleeps.exchange(false)) {
        sleepOn(worker.wake);
      }
      last = Clock::now();
    }
  }
}

void vpPatternWorkers::share(int parts, const void *task, Call call)
{
  m_task = task;
  m_call = call;
  m_finished.store(0, std::memory_order_relaxed);
  const std::uint64_t run = std::uint64_t{++m_runs} << 32U;
  const std::size_t threads = m_ranges.size();
  int begin = 0;
  for (std::size_t k = 0; k < threads; ++k) {
    m_ranges[k].end = static_cast<int>((k + 1) * static_cast<std::size_t>(parts) / threads);
    m_ranges[k].ticket.store(run | static_cast<std::uint64_t>(m_ranges[k].end - begin));
    begin = m_ranges[k].end;
  }
  wake();
  int others = parts;
  for (int part = claim(0); part >= 0; part = claim(0)) {
    call(task, part, 0);
    --others;
  }
  awaitOthers(others);
}

void vpPatternWorkers::awaitOthers(int count)
{
  constexpr int patience = 1000; // pauses, about as long as a part takes
  for (int k = 0; m_finished.load() != count; ++k) {
    if (k < patience) {
      pause();
      continue;
    }
    // A worker may need this processor.
    m_callerSleeps.store(true);
    if (m_finished.load() != count || !m_callerSleeps.exchange(false)) {
      sleepOn(m_wakeCaller);
    }
  }
}
#else
vpPatternWorkers::vpPatternWorkers(int) {}
vpPatternWorkers::~vpPatternWorkers() = default;
void vpPatternWorkers::begin() {}
void vpPatternWorkers::end() {}
#endif

END_VISP_NAMESPACE
