/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file quietLibraries.h
 * \brief Keeps what libraries print away from the user, who gets a sentence instead.
 */
#ifndef vpApp_quietLibraries_h
#define vpApp_quietLibraries_h

#include <opencv2/core/utils/logger.hpp>

namespace vpApp
{
/*!
 * \brief While it lives, OpenCV logs nothing and what anyone prints on stderr is lost: its decoders, and FFmpeg below
 * them, print there directly. For one thread, and for calls that only decode.
 */
class QuietLibraries
{
public:
  QuietLibraries();
  ~QuietLibraries();
  QuietLibraries(const QuietLibraries &) = delete;
  QuietLibraries &operator=(const QuietLibraries &) = delete;

private:
  cv::utils::logging::LogLevel m_level;
  int m_stderr; // the real one; -1: could not be kept, nothing was redirected
};
} // namespace vpApp

#endif
