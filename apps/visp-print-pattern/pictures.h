/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pictures.h
 * \brief Images of the product: the drops on it, the camera view, the detection of the thesis.
 */
#ifndef printPattern_pictures_h
#define printPattern_pictures_h

#include "results.h"

#include <opencv2/core.hpp>

namespace printPattern
{
/*!
 * The printed product from above, up to 6 cells of 4 rows: the first ones and those around the worst drop. Drops are
 * circles of 50 um, green within the tolerance, red outside; a cross marks the true centre.
 */
[[nodiscard]] cv::Mat printedProduct(const vpPrintRun &run);

/*!
 * Figure 7.11: the threshold image (Otsu) on the left, the cells found by algorithm 7.4 on the right, with their boxes
 * and centres; true centres as crosses.
 */
[[nodiscard]] cv::Mat detection(const vpPrintExperimentSpec &spec);

//! Camera view at a frame of the run, with the landed drops, magnified by \e scale.
[[nodiscard]] cv::Mat cameraView(const vpPrintRun &run, std::size_t sample, int scale);

/*!
 * Write the camera view over the whole run as a video of 25 frames per second.
 * \throw std::runtime_error naming the file.
 */
void writeVideo(const vpPrintRun &run, const std::string &file);

//! An image as PNG. \throw std::runtime_error when OpenCV fails.
[[nodiscard]] std::string pngOf(const cv::Mat &picture);
} // namespace printPattern

#endif
