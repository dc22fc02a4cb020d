/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "progress.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <unistd.h>

namespace vpApp
{
namespace
{
constexpr int BAR_WIDTH = 30;
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
