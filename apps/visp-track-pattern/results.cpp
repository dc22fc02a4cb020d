/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "results.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace trackPattern
{
const char *RunResults::endingWord() const
{
  return ending == Ending::Complete ? "complete" : ending == Ending::Interrupted ? "interrupted" : "incomplete";
}

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
  return vpQuantile(std::move(values), p);
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

std::string text(const char *format, ...)
{
  char buffer[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}
} // namespace trackPattern
