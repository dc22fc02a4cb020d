/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pictures.h
 * \brief Pictures of the product: the drops on it, what the camera sees, what the thesis's detection finds.
 */
#ifndef printPattern_pictures_h
#define printPattern_pictures_h

#include "results.h"

#include <opencv2/core.hpp>

namespace printPattern
{
/*!
 * The printed product from above, up to 6 cells of 4 rows: the first ones and those around the worst drop. Drops are
 * circles of 50 um, green within the tolerance and red beyond; a cross marks the true centre.
 */
[[nodiscard]] cv::Mat printedProduct(const vpPrintRun &run);

/*!
 * Figure 7.11: on the left the threshold image (Otsu), on the right the cells that algorithm 7.4 finds, their boxes and
 * centres; true centres as crosses.
 */
[[nodiscard]] cv::Mat detection(const vpPrintExperimentSpec &spec);

//! What the camera sees at a frame of the run, with the drops that have landed; \e scale times as large.
[[nodiscard]] cv::Mat cameraView(const vpPrintRun &run, std::size_t sample, int scale);

/*!
 * Write the camera's view over the whole run, 25 times a second.
 * \throw std::runtime_error naming the file.
 */
void writeVideo(const vpPrintRun &run, const std::string &file);

//! A picture as PNG. \throw std::runtime_error when OpenCV cannot.
[[nodiscard]] std::string pngOf(const cv::Mat &picture);
} // namespace printPattern

#endif
