/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Pictures and videos by OpenCV: greyPicture.h, quietLibraries.h, videoFile.h.
#include "greyPicture.h"
#include "quietLibraries.h"
#include "videoFile.h"

#include <opencv2/core/utils/logger.hpp>

#include <cstdio>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace vpApp
{
QuietLibraries::QuietLibraries()
  : m_level(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)),
    m_stderr(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0))
{
  const int nowhere = m_stderr < 0 ? -1 : open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) {
    std::fflush(stderr);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
  }
}

QuietLibraries::~QuietLibraries()
{
  if (m_stderr >= 0) {
    std::fflush(stderr);
    dup2(m_stderr, STDERR_FILENO);
    close(m_stderr);
  }
  cv::utils::logging::setLogLevel(m_level);
}

cv::Mat readGreyPicture(const std::filesystem::path &file, vpPictures::GreyScale &scale)
{
  const QuietLibraries quiet;
  return vpPictures::readGreyPicture(file.string(), scale);
}

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
