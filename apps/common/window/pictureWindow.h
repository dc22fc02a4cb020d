/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pictureWindow.h
 * \brief A window for the programs that can show what they do (--display).
 */
#ifndef vpApp_pictureWindow_h
#define vpApp_pictureWindow_h

#include <visp3/core/vpConfig.h>

#include <opencv2/core.hpp>

#include <memory>
#include <string>

namespace vpApp
{
/*!
 * \brief Shows one picture after another in a window of ViSP (vpDisplayX). For one thread.
 */
class PictureWindow
{
public:
  /*!
   * \param title : Of the window.
   * \throw std::runtime_error saying why no window can be opened (no screen, ViSP without X11).
   */
  explicit PictureWindow(const std::string &title);
  ~PictureWindow();
  PictureWindow(const PictureWindow &) = delete;
  PictureWindow &operator=(const PictureWindow &) = delete;

  /*!
   * Show a picture for \e duration seconds.
   * \return False when the user clicked into the window: enough of it.
   */
  [[nodiscard]] bool show(const cv::Mat &picture, double duration);

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};
} // namespace vpApp

#endif
