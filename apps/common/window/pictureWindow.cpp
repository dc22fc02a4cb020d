/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "pictureWindow.h"

#include <visp3/core/vpImage.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/core/vpTime.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/gui/vpDisplayX.h>

#include <cstdlib>
#include <stdexcept>

VISP_DIRECT_USING_NAMESPACE

namespace vpApp
{
class PictureWindow::Impl
{
public:
#if defined(VISP_HAVE_X11)
  vpDisplayX display;
#endif
  vpImage<vpRGBa> image;
  std::string title;
  bool open = false;
};

#if defined(VISP_HAVE_X11)

PictureWindow::PictureWindow(const std::string &title) : m_impl(std::make_unique<Impl>())
{
  m_impl->title = title;
  const char *screen = std::getenv("DISPLAY");
  if (screen == nullptr || *screen == '\0') {
    throw std::runtime_error("--display needs a screen, but the environment variable DISPLAY is not set");
  }
  // Open and close once, to detect an unavailable screen before the work, not after.
  vpImage<vpRGBa> probe(16, 16);
  try {
    vpDisplayX display;
    display.init(probe);
  }
  catch (const std::exception &) {
    throw std::runtime_error(std::string("--display needs a screen, but DISPLAY=") + screen + " cannot be opened");
  }
}

PictureWindow::~PictureWindow() = default;

bool PictureWindow::show(const cv::Mat &picture, double duration)
{
  const double start = vpTime::measureTimeMs();
  vpImageConvert::convert(picture, m_impl->image);
  if (!m_impl->open) {
    m_impl->display.init(m_impl->image, 100, 100, m_impl->title);
    m_impl->open = true;
  }
  vpDisplay::display(m_impl->image);
  vpDisplay::flush(m_impl->image);
  const bool clicked = vpDisplay::getClick(m_impl->image, false);
  vpTime::wait(start, 1000. * duration);
  return !clicked;
}

std::string PictureWindow::key()
{
  std::string key;
  const bool pressed = m_impl->open && vpDisplay::getKeyboardEvent(m_impl->image, key, false);
  return pressed ? key : "";
}

#else

PictureWindow::PictureWindow(const std::string &)
{
  throw std::runtime_error("--display needs X11, and this ViSP was built without it");
}

PictureWindow::~PictureWindow() = default;

bool PictureWindow::show(const cv::Mat &, double) { return false; }

std::string PictureWindow::key() { return ""; }

#endif
} // namespace vpApp
