/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "greyPicture.h"
#include "quietLibraries.h"

namespace vpApp
{
cv::Mat readGreyPicture(const std::filesystem::path &file, vpPictures::GreyScale &scale)
{
  const QuietLibraries quiet;
  return vpPictures::readGreyPicture(file.string(), scale);
}
} // namespace vpApp
