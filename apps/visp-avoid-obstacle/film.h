/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file film.h
 * \brief Moving pictures of a run: the camera's view beside the arm.
 */
#ifndef avoidObstacle_film_h
#define avoidObstacle_film_h

#include "episode.h"

#include "pictureWindow.h"

#include <opencv2/core.hpp>

namespace avoidObstacle
{
//! The picture of a frame in colour, with what was found outlined and its time.
[[nodiscard]] cv::Mat cameraPicture(const Frame &frame);

/*!
 * Every exposure as a picture of the camera's view beside the arm from above and from the side, in real time.
 * \param file : MP4 to write; empty: none. \param window : Where to show it as well; null: nowhere. A click ends that.
 * \return True when browsers play the file.
 */
[[nodiscard]] bool makeFilm(const Episode &episode, const std::string &file, vpApp::PictureWindow *window);
} // namespace avoidObstacle

#endif
