/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "quietLibraries.h"

#include <cstdio>

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
} // namespace vpApp
