/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Long jobs: jobs.h, progress.h.
#include "jobs.h"
#include "progress.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <iostream>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include <unistd.h>

namespace vpApp
{
namespace
{
constexpr int BAR_WIDTH = 30;

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

Progress::Style Progress::detect() { return isatty(STDERR_FILENO) != 0 ? Style::Bar : Style::Lines; }

Progress::Progress(std::string title, double total, std::ostream &out, Style style)
  : m_title(std::move(title)), m_total(std::max(total, 1e-9)), m_out(out), m_style(style)
{
  if (m_style == Style::Bar) {
    show();
  }
}

Progress::Progress(std::string title, double total) : Progress(std::move(title), total, std::cerr, detect()) {}

Progress::~Progress()
{
  if (m_style == Style::Bar) {
    m_out << std::endl;
  }
}

void Progress::add(double amount)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_done += amount;
  show();
}

double Progress::share() const
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return std::min(1., m_done / m_total);
}

void Progress::show()
{
  // The sum of many fractions ends slightly below one.
  const double share = std::min(1., m_done / m_total + 1e-9);
  const int percent = static_cast<int>(std::floor(100. * share));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
  if (m_style == Style::Bar && percent != m_shown) {
    m_shown = percent;
    const int filled = BAR_WIDTH * percent / 100;
    m_out << '\r' << m_title << " [" << std::string(filled, '#') << std::string(BAR_WIDTH - filled, '.') << "] "
          << percent << " %, " << static_cast<int>(seconds) << " s " << std::flush;
  }
  else if (m_style == Style::Lines && percent / 25 > std::max(m_shown, 0)) {
    m_shown = percent / 25;
    m_out << m_title << ": " << 25 * m_shown << " %, " << static_cast<int>(seconds) << " s" << std::endl;
  }
}
} // namespace vpApp
