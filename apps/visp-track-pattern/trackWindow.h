/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file trackWindow.h
 * \brief A window on the screen that shows pictures.
 */
#ifndef trackPattern_trackWindow_h
#define trackPattern_trackWindow_h

#include <visp3/core/vpConfig.h>

#include <opencv2/core.hpp>

#include <memory>

namespace trackPattern
{
/*!
 * \brief Shows one picture after another in a window of ViSP (vpDisplayX). For one thread.
 */
class TrackWindow
{
public:
  //! \throw std::runtime_error saying why no window can be opened (no screen, ViSP without X11).
  TrackWindow();
  ~TrackWindow();
  TrackWindow(const TrackWindow &) = delete;
  TrackWindow &operator=(const TrackWindow &) = delete;

  /*!
   * Show a picture for \e duration seconds.
   * \return False when the user clicked into the window: enough.
   */
  [[nodiscard]] bool show(const cv::Mat &picture, double duration);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};
} // namespace trackPattern

#endif
