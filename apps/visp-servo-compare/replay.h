/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file replay.h
 * \brief Logged runs as videos and film strips of the camera view.
 */
#ifndef servoCompare_replay_h
#define servoCompare_replay_h

#include "results.h"

#include "outputFolder.h"
#include "pictureWindow.h"

namespace servoCompare
{
//! \brief The video of one law.
struct ReplayVideo {
  std::string file; //!< Inside the result folder.
  std::string law;
  double speedUp = 1.;
  bool forBrowsers = true;
};

/*!
 * Write a video of each law on the hardest plant, sped up to about 8 s.
 * \param jobs : Videos written in parallel. \param window : If given, also shows the frames, one law after another.
 */
[[nodiscard]] std::vector<ReplayVideo> writeVideos(const Plan &plan, const Results &results, vpApp::OutputFolder &out,
                                                   unsigned int jobs, vpApp::PictureWindow *window);

//! \brief Film strips as in figure 5.11: a row of views for each law.
struct FilmStrip {
  std::string jpeg;
  std::vector<std::string> laws; //!< Rows from top to bottom.
  std::vector<double> times;     //!< Columns, s.
};
//! Views of the complete first segment on the hardest plant.
[[nodiscard]] FilmStrip drawFilmStrip(const Plan &plan, const Results &results);
} // namespace servoCompare

#endif
