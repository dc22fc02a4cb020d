/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpGreyMedian.h
 * \brief Internal: median of grey values or residuals by counting.
 */
#ifndef vpGreyMedian_h
#define vpGreyMedian_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <array>
#include <cstddef>

BEGIN_VISP_NAMESPACE

//! Median within a fraction of a grey level, by interpolation within the bin that holds it. Allocates nothing.
class vpGreyMedian
{
public:
  //! \param perLevel : Bins of a grey level; values above 4096 / perLevel count as that.
  explicit vpGreyMedian(int perLevel) : m_perLevel(static_cast<float>(perLevel)) {}

  void clear()
  {
    m_counts.fill(0);
    m_total = 0;
  }

  //! \param value : >= 0; NaN counts as the largest.
  void add(float value)
  {
    const float place = value * m_perLevel;
    ++m_counts[place < static_cast<float>(bins) ? static_cast<std::size_t>(place) : bins];
    ++m_total;
  }

  //! The median; 0 without values.
  [[nodiscard]] double value() const
  {
    const double half = 0.5 * m_total;
    double below = 0.;
    for (std::size_t i = 0; i <= bins && m_total > 0; ++i) {
      if (below + m_counts[i] >= half) {
        return (static_cast<double>(i) + (half - below) / m_counts[i]) / static_cast<double>(m_perLevel);
      }
      below += m_counts[i];
    }
    return 0.;
  }

private:
  static constexpr std::size_t bins = 4096;
  float m_perLevel;
  std::array<int, bins + 1> m_counts{};
  int m_total = 0;
};

END_VISP_NAMESPACE
#endif
