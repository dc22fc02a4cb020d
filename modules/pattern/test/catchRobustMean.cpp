/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The tracker's own vectorised median is one of the values: the middle one, or the upper of two.
#include "../src/vpRobustMean.cpp" // the class is not exported

#include "vpCatch.h"

#include <algorithm>

VISP_DIRECT_USING_NAMESPACE

TEST_CASE("the median of the tracker is the value in the middle of any number of values", "[median]")
{
  auto rng = vpTestSupport::generator(860);
  CAPTURE(vpTestSupport::seed());
  std::vector<double> values = {1., 2., 3., 4., 5., 6., 7., 8., 9., 10.};
  CHECK(vpRobustMean::median(values) == 6.);
  for (int trial = 0; trial < 2000; ++trial) {
    values.resize(static_cast<std::size_t>(1 + trial % 70));
    const bool ties = trial % 3 == 0;
    for (double &value : values) {
      const double number = std::uniform_real_distribution<double>(-5., 5.)(rng);
      value = ties ? std::round(number) : number;
    }
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    CAPTURE(values.size(), ties);
    CHECK(vpRobustMean::median(values) == sorted[sorted.size() / 2]);
  }
  values.clear();
  CHECK(vpRobustMean::median(values) == 0.);
}
