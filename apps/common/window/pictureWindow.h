/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pictureWindow.h
 * \brief A window for programs with --display.
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
 * \brief Shows images one after another in a ViSP window (vpDisplayX). For one thread.
 */
class PictureWindow
{
public:
  /*!
   * \param title : Window title.
   * \throw std::runtime_error explaining why no window can be opened (no screen, ViSP without X11).
   */
  explicit PictureWindow(const std::string &title);
  ~PictureWindow();
  PictureWindow(const PictureWindow &) = delete;
  PictureWindow &operator=(const PictureWindow &) = delete;

  /*!
   * Show an image for \e duration seconds.
   * \return False when the user clicked into the window to stop.
   */
  [[nodiscard]] bool show(const cv::Mat &picture, double duration);
  //! The key that was pressed in the window since the last call ("q", " "); empty: none.
  [[nodiscard]] std::string key();

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};
} // namespace vpApp

#endif
