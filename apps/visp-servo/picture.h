/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file picture.h
 * \brief Grey images of ViSP as pictures of OpenCV and PNG files.
 */
#ifndef visualServo_picture_h
#define visualServo_picture_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <opencv2/imgcodecs.hpp>

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace visualServo
{
//! The image itself, not a copy.
inline cv::Mat matOf(const vpImage<unsigned char> &image)
{
  return cv::Mat(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
}

//! Content of a PNG file; empty without a picture.
inline std::string pngOf(const cv::Mat &picture)
{
  std::vector<unsigned char> bytes;
  return !picture.empty() && cv::imencode(".png", picture, bytes) ? std::string(bytes.begin(), bytes.end()) : "";
}
} // namespace visualServo

#endif
