/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The independent parts of an image's work, in several threads.
#ifndef vpPatternWorkers_h
#define vpPatternWorkers_h

#include <visp3/direct_core/vpDirectCompat.h>

#if defined(__linux__) || defined(__FreeBSD__)
#define VISP_PATTERN_THREADS // unnamed semaphores
#include <semaphore.h>
#endif

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * Each thread takes the parts of its own range one by one, whose data are in its cache since the last run, then those of
 * the other ranges: a worker that comes late, or never, costs nothing, as the caller then does all. The caller waits only
 * for parts that a worker has begun. There is no lock; a worker is woken by a semaphore. During an image, from begin() to
 * end(), a worker without a part waits actively for 200 us before it sleeps. The caller, too, waits actively before it
 * sleeps, so that a worker of lower priority on the same processor goes on.
 *
 * Workers have the scheduling policy, priority and processors of the thread that constructs this object. Where there are
 * no unnamed semaphores, everything runs in the caller.
 */
class vpPatternWorkers
{
public:
  //! \throw vpException (fatalError) with the system's reason when a thread cannot be started.
  explicit vpPatternWorkers(int threads);
  ~vpPatternWorkers();
  vpPatternWorkers(const vpPatternWorkers &) = delete;
  vpPatternWorkers &operator=(const vpPatternWorkers &) = delete;

  //! Wakes the workers; not done for little work, which then runs in the caller.
  void begin();
  void end();

  /*!
   * Calls part(index, thread) once for each index in [0, parts). Calls with the same thread, in [0, threads), do not overlap: thread 0 is
   * the caller. The parts must not depend on each other. Returns when all are done.
   */
  template <class Part> void run(int parts, const Part &part)
  {
    if (!m_awake || parts < 2) {
      for (int k = 0; k < parts; ++k) {
        part(k, 0);
      }
      return;
    }
    share(parts, &part, [](const void *task, int k, int thread) { (*static_cast<const Part *>(task))(k, thread); });
  }

private:
  using Call = void (*)(const void *, int, int);
  bool m_awake = false; // of the caller: between begin() and end()
#ifdef VISP_PATTERN_THREADS
  struct Worker {
    sem_t wake;
    std::atomic<bool> sleeps{false};
    std::thread thread;
  };
  void share(int parts, const void *task, Call call);
  void work(Worker &worker, int thread);
  void wake();
  [[nodiscard]] bool hasWork() const;
  int claim(int thread);
  void finish();
  void awaitOthers(int count);
  void stop();

  struct alignas(64) Range {
    std::atomic<std::uint64_t> ticket{0}; // number of the run, and of the range's parts that nobody has taken
    int end = 0;
  };

  std::vector<std::unique_ptr<Worker>> m_workers;
  std::vector<Range> m_ranges; // one for each thread
  // Written, with the ends of the ranges, before the tickets. A worker reads them after it has taken a part, of which the caller waits for
  // the end.
  const void *m_task = nullptr;
  Call m_call = nullptr;
  std::uint32_t m_runs = 0;
  std::atomic<int> m_finished{0}; // parts, by workers
  std::atomic<bool> m_open{false}, m_end{false}, m_callerSleeps{false};
  sem_t m_wakeCaller;
#else
  void share(int, const void *, Call) {}
#endif
};

END_VISP_NAMESPACE
#endif
