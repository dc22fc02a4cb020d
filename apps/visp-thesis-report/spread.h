/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file spread.h
 * \brief Mean, standard deviation and quantiles of measurements.
 */
#ifndef thesisReport_spread_h
#define thesisReport_spread_h

#include <vector>

namespace thesisReport
{
//! \brief Collects values. All statistics are 0 without values.
class Spread
{
public:
  void add(double value) { m_values.push_back(value); }
  [[nodiscard]] std::size_t count() const { return m_values.size(); }
  [[nodiscard]] double mean() const;
  //! Standard deviation about the mean, of a sample (n - 1); 0 for a single value.
  [[nodiscard]] double sigma() const;
  [[nodiscard]] double rms() const; //!< Root mean square, about 0.
  [[nodiscard]] double largest() const;
  //! Quantile: the value not exceeded by the fraction \e share. \param share : 0..1.
  [[nodiscard]] double quantile(double share) const;
  [[nodiscard]] double median() const { return quantile(0.5); }

private:
  std::vector<double> m_values;
};
} // namespace thesisReport

#endif
