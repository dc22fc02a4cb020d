/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file imageFile.h
 * \brief Reads image files strictly: what cannot be measured in is refused by name.
 */
#ifndef trackPattern_imageFile_h
#define trackPattern_imageFile_h

#include <visp3/core/vpImage.h>
#include <visp3/direct_core/vpDirectCompat.h>

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>

VISP_DIRECT_USING_NAMESPACE

namespace trackPattern
{
//! True for names that end like an image file.
[[nodiscard]] bool isImageName(const std::filesystem::path &file);

/*!
 * A picture of 8 bits as grey values; colour by the weights of OpenCV (0.299, 0.587, 0.114).
 * \param picture : As OpenCV decodes it, unchanged. \param name : Begins the complaints.
 * \param grey : Result. \return True when it was a colour picture.
 * \throw std::runtime_error "NAME: has 16 bits a value, must have 8; ...".
 */
bool makeGrey(const cv::Mat &picture, const std::string &name, vpImage<unsigned char> &grey);

/*!
 * Read a file as makeGrey() does.
 * \throw std::runtime_error naming the file when it cannot be read, is no image or is cut short.
 */
bool readGreyImage(const std::filesystem::path &file, vpImage<unsigned char> &grey);
} // namespace trackPattern

#endif
