/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "videoFile.h"

#include <opencv2/core/utils/logger.hpp>

#include <filesystem>
#include <stdexcept>

namespace vpApp
{
VideoFile::VideoFile(const std::string &file, int width, int height, double rate) : m_file(file)
{
  const cv::Size size(width, height);
  // A missing encoder is handled by the fallback, without OpenCV's log.
  const auto level = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  m_forBrowsers = m_writer.open(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'), rate, size);
  if (!m_forBrowsers) {
    m_writer.open(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), rate, size);
  }
  cv::utils::logging::setLogLevel(level);
  if (!m_writer.isOpened()) {
    throw std::runtime_error(file + ": OpenCV cannot write MP4 (its videoio module needs FFmpeg)");
  }
}

void VideoFile::write(const cv::Mat &frame) { m_writer.write(frame); }

void VideoFile::close()
{
  m_writer.release();
  std::error_code error;
  if (std::filesystem::file_size(m_file, error) == 0 || error) {
    throw std::runtime_error(m_file + ": the video could not be written");
  }
}
} // namespace vpApp
