/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "trackWindow.h"

#include <visp3/core/vpImage.h>
#include <visp3/core/vpImageConvert.h>
#include <visp3/core/vpTime.h>
#include <visp3/direct_core/vpDirectCompat.h>
#include <visp3/gui/vpDisplayX.h>

#include <cstdlib>
#include <stdexcept>

VISP_DIRECT_USING_NAMESPACE

namespace trackPattern
{
class TrackWindow::Impl
{
public:
#if defined(VISP_HAVE_X11)
  vpDisplayX display;
#endif
  vpImage<vpRGBa> image;
  bool open = false;
};

#if defined(VISP_HAVE_X11)

TrackWindow::TrackWindow() : m_impl(std::make_unique<Impl>())
{
  const char *screen = std::getenv("DISPLAY");
  if (screen == nullptr || *screen == '\0') {
    throw std::runtime_error("--display needs a screen, but the environment variable DISPLAY is not set");
  }
  // Opened and closed once: a screen that does not answer is found before the work, not after.
  vpImage<vpRGBa> probe(16, 16);
  try {
    vpDisplayX display;
    display.init(probe);
  }
  catch (const std::exception &) {
    throw std::runtime_error(std::string("--display needs a screen, but DISPLAY=") + screen + " cannot be opened");
  }
}

TrackWindow::~TrackWindow() = default;

bool TrackWindow::show(const cv::Mat &picture, double duration)
{
  const double start = vpTime::measureTimeMs();
  vpImageConvert::convert(picture, m_impl->image);
  if (!m_impl->open) {
    m_impl->display.init(m_impl->image, 100, 100, "visp-track-pattern: click to end");
    m_impl->open = true;
  }
  vpDisplay::display(m_impl->image);
  vpDisplay::flush(m_impl->image);
  const bool clicked = vpDisplay::getClick(m_impl->image, false);
  vpTime::wait(start, 1000. * duration);
  return !clicked;
}

#else

TrackWindow::TrackWindow() { throw std::runtime_error("--display needs X11, and this ViSP was built without it"); }

TrackWindow::~TrackWindow() = default;

bool TrackWindow::show(const cv::Mat &, double) { return false; }

#endif
} // namespace trackPattern
