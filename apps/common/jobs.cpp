/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "jobs.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace vpApp
{
namespace
{
//! Sets the number of OpenCV threads and restores it.
class OpenCVThreads
{
public:
  explicit OpenCVThreads(int count) : m_before(cv::getNumThreads()) { cv::setNumThreads(count); }
  ~OpenCVThreads() { cv::setNumThreads(m_before); }
  OpenCVThreads(const OpenCVThreads &) = delete;
  OpenCVThreads &operator=(const OpenCVThreads &) = delete;

private:
  int m_before;
};
} // namespace

unsigned int coreCount() { return std::max(1u, std::thread::hardware_concurrency()); }

void runJobs(std::size_t count, unsigned int threads, const std::function<void(std::size_t)> &work)
{
  const OpenCVThreads single(1);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::mutex mutex;
  std::exception_ptr error;
  std::size_t errorIndex = std::numeric_limits<std::size_t>::max();

  const auto worker = [&]() {
    while (!failed) {
      const std::size_t index = next++;
      if (index >= count) {
        return;
      }
      try {
        work(index);
      }
      catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        failed = true;
        if (index < errorIndex) {
          errorIndex = index;
          error = std::current_exception();
        }
      }
    }
  };

  std::vector<std::thread> pool;
  const std::size_t helpers = std::min<std::size_t>(std::max(threads, 1u), std::max<std::size_t>(count, 1)) - 1;
  pool.reserve(helpers);
  try {
    for (std::size_t i = 0; i < helpers; ++i) {
      pool.emplace_back(worker);
    }
  }
  catch (const std::system_error &) { // no more threads available: the running ones do the work
  }
  worker();
  for (std::thread &thread : pool) {
    thread.join();
  }
  if (error) {
    std::rethrow_exception(error);
  }
}
} // namespace vpApp
