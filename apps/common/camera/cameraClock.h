/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file cameraClock.h
 * \brief Time stamps and numbers of a camera's images: its clock on that of the computer, and lost images.
 */
#ifndef vpApp_cameraClock_h
#define vpApp_cameraClock_h

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

namespace vpApp
{
/*!
 * \brief Converts the time stamps of a camera to the clock of the computer.
 *
 * An image arrives later than it was taken, by at least the time that the transport needs. The least difference
 * arrival - stamp of the last images is therefore the offset of the clocks plus the least delay of the transport: the result is
 * late by that delay, which is constant, and has no jitter of the transport. A window of images follows the drift of the clocks.
 */
class CameraClock
{
public:
  //! \param window : Number of images whose least difference counts, >= 1.
  explicit CameraClock(std::size_t window = 200) : m_window(window) {}
  //! Time of capture by the computer's clock, s. \param stamp : By the camera's clock, s. \param arrival : By the computer's, s.
  [[nodiscard]] double convert(double stamp, double arrival)
  {
    if (stamp < m_stamp) { // the camera's clock was set back
      m_least.clear();
    }
    m_stamp = stamp;
    const double difference = arrival - stamp;
    while (!m_least.empty() && m_least.back().second >= difference) {
      m_least.pop_back();
    }
    m_least.emplace_back(m_images, difference);
    if (m_least.front().first + m_window <= m_images) {
      m_least.pop_front();
    }
    ++m_images;
    return stamp + m_least.front().second;
  }

private:
  std::size_t m_window;
  std::size_t m_images = 0;
  double m_stamp = 0.;
  std::deque<std::pair<std::size_t, double>> m_least; // number and difference, increasing
};

//! \brief Finds lost images by the numbers that a camera gives its images: 1 to 65535 in turn (GigE Vision), or without end.
class ImageNumbers
{
public:
  //! Images missing between the last call and this one. \param number : 0: the camera gives no numbers.
  [[nodiscard]] std::size_t missingBefore(std::uint64_t number)
  {
    const std::uint64_t last = std::exchange(m_last, number);
    if (last == 0 || number == 0) {
      return 0;
    }
    constexpr std::uint64_t largest = 65535;
    std::uint64_t step = number - last;
    if (number < last) {
      if (last > largest || last - number < largest / 2) { // the counter restarted
        return 0;
      }
      step = number + largest - last;
    }
    return step > 0 ? static_cast<std::size_t>(step - 1) : 0;
  }

private:
  std::uint64_t m_last = 0;
};
} // namespace vpApp

#endif
