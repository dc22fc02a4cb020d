/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file greyPicture.h
 * \brief Input photographs of programs, all read by the rule of support/vpPictureFile.h.
 */
#ifndef vpApp_greyPicture_h
#define vpApp_greyPicture_h

#include "vpPictureFile.h"

#include <algorithm>
#include <filesystem>

namespace vpApp
{
//! Like vpPictures::readGreyPicture(), with the output of the decoders suppressed.
[[nodiscard]] cv::Mat readGreyPicture(const std::filesystem::path &file, vpPictures::GreyScale &scale);

//! Copy a CV_8UC1 image into a vpImage<unsigned char>.
template <class Image> void copyGrey(const cv::Mat &picture, Image &image)
{
  image.resize(static_cast<unsigned int>(picture.rows), static_cast<unsigned int>(picture.cols));
  for (int row = 0; row < picture.rows; ++row) {
    std::copy_n(picture.ptr(row), picture.cols, image[static_cast<unsigned int>(row)]);
  }
}
} // namespace vpApp

#endif
