/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file film.h
 * \brief Video of a run: the camera view beside the arm.
 */
#ifndef avoidObstacle_film_h
#define avoidObstacle_film_h

#include "episode.h"

#include "pictureWindow.h"

#include <opencv2/core.hpp>

namespace avoidObstacle
{
//! Colour image of a frame, with detections outlined and its time.
[[nodiscard]] cv::Mat cameraPicture(const Frame &frame);

/*!
 * Every exposure as an image of the camera view beside the arm from above and from the side, in real time.
 * \param file : MP4 to write; empty: none. \param window : Also shows the video; null: no window. A click ends the
 * display.
 * \return True if browsers can play the file.
 */
[[nodiscard]] bool makeFilm(const Episode &episode, const std::string &file, vpApp::PictureWindow *window);
} // namespace avoidObstacle

#endif
