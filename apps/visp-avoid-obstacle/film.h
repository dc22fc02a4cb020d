/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file film.h
 * \brief Pictures of the camera: as files for the report, as a video, in a window.
 */
#ifndef avoidObstacle_film_h
#define avoidObstacle_film_h

#include "episode.h"

#include "outputFolder.h"
#include "pictureWindow.h"

#include <opencv2/core.hpp>

namespace avoidObstacle
{
//! Colour image of a frame, with detections outlined and its time.
[[nodiscard]] cv::Mat cameraPicture(const Frame &frame);

//! Up to 40 of them, spread evenly, for the report: views.csv and view/N.jpg.
void writeViews(vpApp::OutputFolder &out, const std::vector<Frame> &frames);

/*!
 * What the camera saw, in real time, with the status of the method.
 * \param file : MP4 to write; empty: none. \param window : Also shows the video; null: no window. A click ends the
 * display.
 * \return True if browsers can play the file.
 */
[[nodiscard]] bool makeFilm(const Episode &episode, const std::string &file, vpApp::PictureWindow *window);
} // namespace avoidObstacle

#endif
