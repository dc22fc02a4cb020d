/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file overlay.h
 * \brief Draws results into an image.
 */
#ifndef trackPattern_overlay_h
#define trackPattern_overlay_h

#include "options.h"

#include <visp3/core/vpImage.h>
#include <visp3/pattern/vpPatternFrame.h>

#include <opencv2/core.hpp>

#include <memory>
#include <optional>
#include <string>

namespace vpApp
{
class OutputFolder;
class VideoFile;
} // namespace vpApp

namespace trackPattern
{
/*!
 * The image, enlarged so that crosses of a pixel can be distinguished, with the cells (green: measured, red: not
 * measured) and a line of text below. Both sizes are even.
 * \param roi : Tracked region; the tracker's positions are relative to it.
 */
[[nodiscard]] cv::Mat drawOverlay(const vpImage<unsigned char> &image, const vpPatternFrame &frame,
                                  const std::optional<Roi> &roi, unsigned int number);

//! \brief The overlays of a run as overlay.mp4 or overlay/000000.png.
class OverlayFiles
{
public:
  OverlayFiles(vpApp::OutputFolder &out, OverlayKind kind, double rate);
  ~OverlayFiles();
  OverlayFiles(const OverlayFiles &) = delete;
  OverlayFiles &operator=(const OverlayFiles &) = delete;
  //! \throw std::runtime_error naming a file that cannot be written.
  void add(const cv::Mat &picture, unsigned int number);
  //! \throw std::runtime_error naming the file.
  void close();

private:
  vpApp::OutputFolder &m_out;
  OverlayKind m_kind;
  double m_rate;
  std::unique_ptr<vpApp::VideoFile> m_video;
};

//! An image as the bytes of a PNG file.
[[nodiscard]] std::string pngOf(const cv::Mat &picture);
} // namespace trackPattern

#endif
