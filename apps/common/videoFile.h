/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file videoFile.h
 * \brief MP4 files for browsers.
 */
#ifndef vpApp_videoFile_h
#define vpApp_videoFile_h

#include <opencv2/videoio.hpp>

#include <string>

namespace vpApp
{
/*!
 * \brief Writes one MP4 file through OpenCV's FFmpeg: H.264, which browsers play, or MPEG-4 part 2 where FFmpeg has no
 * H.264 encoder; see isForBrowsers().
 */
class VideoFile
{
public:
  /*!
   * \param file : Path, ends in .mp4. \param width, height : Frame size, px, even. \param rate : Frames per second, >
   * 0.
   * \throw std::runtime_error naming the file when neither codec can be opened.
   */
  VideoFile(const std::string &file, int width, int height, double rate);

  //! Append a frame. \param frame : 8-bit BGR of the given size.
  void write(const cv::Mat &frame);
  //! Close the file. \throw std::runtime_error naming it when nothing was written.
  void close();
  //! False if the video is MPEG-4 part 2, which browsers do not play.
  [[nodiscard]] bool isForBrowsers() const { return m_forBrowsers; }

private:
  std::string m_file;
  cv::VideoWriter m_writer;
  bool m_forBrowsers = true;
};
} // namespace vpApp

#endif
