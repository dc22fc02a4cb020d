/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file quietLibraries.h
 * \brief Suppresses output of libraries; the user gets a sentence instead.
 */
#ifndef vpApp_quietLibraries_h
#define vpApp_quietLibraries_h

#include <opencv2/core/utils/logger.hpp>

namespace vpApp
{
/*!
 * \brief During its lifetime, OpenCV logs nothing and all output on stderr is discarded: its decoders, and FFmpeg below
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
  int m_stderr; // the original; -1: could not be duplicated, nothing was redirected
};
} // namespace vpApp

#endif
