/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Robust means over the cells.
#ifndef vpRobustMean_h
#define vpRobustMean_h

#include <visp3/direct_core/vpDirectCompat.h>

#include <vector>

BEGIN_VISP_NAMESPACE

class vpRobustMean
{
public:
  struct Result {
    double value = 0., variance = 0.;
    int count = 0; // with a weight
  };
  explicit vpRobustMean(std::size_t capacity);

  //! Those values with which \e use is at least \e least.
  void assign(const std::vector<double> &values, const std::vector<double> &variances,
              const std::vector<unsigned char> &use, unsigned char least);
  //! The same without variances, to \e chosen; without branches that depend on the values.
  static void choose(const std::vector<double> &values, const std::vector<unsigned char> &use, unsigned char least,
                     std::vector<double> &chosen);
  //! Tukey's biweight about \e centre, each value weighted with its variance.
  Result mean(double centre);
  //! Tukey's biweight about the median.
  Result mean();
  /*!
   * One of the values, for an even number of them the upper of the two in the middle; 0 if empty. An initial value for
   * robust estimates, not a result for reports (vpMedian()): the mean of the two is half way to an outlier when there
   * are only two values, which made the tracker lose turning products.
   */
  static double median(std::vector<double> &values);

private:
  std::vector<double> m_values, m_variances, m_scratch;
};

END_VISP_NAMESPACE
#endif
