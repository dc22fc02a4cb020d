/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoTiming.h
 * \brief Histograms of periods, latencies and computing times.
 */
#ifndef vpServoTiming_h
#define vpServoTiming_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpTimingStatistics
 * \ingroup group_servoing
 * \brief Histogram of durations from 0.1 us to 1000 s, 50 bins per decade: quantiles are exact to 4.8 %.
 *
 * One thread adds durations, and any thread may read at the same time; no allocation, no lock. A reader may miss what
 * is just being added.
 *
 * \code
 * vpTimingStatistics times;
 * for (int i = 0; i < 1000; ++i) {
 *   const double before = now();
 *   grabber.acquire(image);
 *   times.add(now() - before);
 * }
 * std::cout << "median " << 1e3 * times.quantile(0.5) << " ms, 99 % within " << 1e3 * times.quantile(0.99)
 *           << " ms, all within " << 1e3 * times.max() << " ms" << std::endl;
 * \endcode
 */
class VISP_EXPORT vpTimingStatistics
{
public:
  //! Adds a duration, s. Beyond the range it counts in the first or last bin; NaN and negative ones are only counted as
  //! invalid().
  void add(double seconds) noexcept;
  //! Number of durations added.
  [[nodiscard]] std::uint64_t count() const noexcept { return m_count.load(std::memory_order_relaxed); }
  //! Number of durations that were NaN or negative.
  [[nodiscard]] std::uint64_t invalid() const noexcept { return m_invalid.load(std::memory_order_relaxed); }
  //! Largest duration, s; 0 without any.
  [[nodiscard]] double max() const noexcept { return m_max.load(std::memory_order_relaxed); }
  //! Smallest value that at least this share (0..1) of the durations do not exceed, s, at most 4.8 % too large; never
  //! above max(). NaN without any.
  [[nodiscard]] double quantile(double share) const noexcept;

  static constexpr std::size_t bins = 500; //!< Number of bins.
  //! Number of durations in a bin.
  [[nodiscard]] std::uint64_t countOf(std::size_t bin) const noexcept
  {
    return m_bins[bin].load(std::memory_order_relaxed);
  }
  //! Upper bound of a bin, s.
  [[nodiscard]] static double upperBound(std::size_t bin) noexcept;

private:
  std::array<std::atomic<std::uint64_t>, bins> m_bins{};
  std::atomic<std::uint64_t> m_count{0}, m_invalid{0};
  std::atomic<double> m_max{0.};
};

//! \ingroup group_servoing
//! \brief Times of a vpVisualServo.
struct VISP_EXPORT vpServoTiming {
  vpTimingStatistics image;   //!< Time between the captures of images.
  vpTimingStatistics vision;  //!< Computing time of an image.
  vpTimingStatistics latency; //!< Time from capture to the first step that uses the image.
  vpTimingStatistics period;  //!< Time between steps.
  vpTimingStatistics jitter;  //!< Deviation of that time from the nominal period.
  vpTimingStatistics step;    //!< Computing time of a step.
};

END_VISP_NAMESPACE
#endif
