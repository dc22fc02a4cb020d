/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "imageSource.h"

#include <stdexcept>

namespace vpApp
{
std::unique_ptr<ImageSource> openAravis(const std::string &, double, std::size_t)
{
  throw std::runtime_error(
      "GigE and USB3 cameras need Aravis, and this build has none: install libaravis-dev and build again");
}
} // namespace vpApp
