/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file input.h
 * \brief The images of the options with their ground truth, and the program's own sequence.
 */
#ifndef trackPattern_input_h
#define trackPattern_input_h

#include "imageSource.h"
#include "options.h"
#include "truth.h"

#include <functional>
#include <memory>
#include <optional>

namespace trackPattern
{
//! \brief Images, and what is known of them.
struct Input {
  std::unique_ptr<vpApp::ImageSource> images;
  std::function<std::optional<FrameTruth>()> truth; //!< Ground truth of the last image, if any.
};

//! The input named by the options. \throw std::runtime_error naming an unusable input.
[[nodiscard]] Input openInput(const Options &options);
} // namespace trackPattern

#endif
