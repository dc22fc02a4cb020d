/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include <algorithm>

namespace trackPattern
{
std::size_t RunResults::count(vpPatternStatus status) const
{
  return static_cast<std::size_t>(std::count_if(frames.begin(), frames.end(),
                                                [status](const FrameRecord &frame) { return frame.status == status; }));
}

std::size_t RunResults::imagesWithCells() const
{
  return static_cast<std::size_t>(
      std::count_if(frames.begin(), frames.end(), [](const FrameRecord &frame) { return frame.validCells > 0; }));
}

double quantile(std::vector<double> values, double p)
{
  values.erase(std::remove_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); }), values.end());
  if (values.empty()) {
    return NOTHING;
  }
  const auto place = static_cast<std::ptrdiff_t>(std::lround(p * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

std::vector<double> column(const RunResults &results, double FrameRecord::*member)
{
  std::vector<double> values;
  values.reserve(results.frames.size());
  for (const FrameRecord &frame : results.frames) {
    values.push_back(frame.*member);
  }
  return values;
}
} // namespace trackPattern
