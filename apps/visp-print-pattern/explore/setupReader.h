/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file setupReader.h
 * \brief Reads an exploration from its JSON file; data/explore/README.md describes the format.
 */
#ifndef printExplore_setupReader_h
#define printExplore_setupReader_h

#include "design.h"

#include <string>

namespace printExplore
{
/*!
 * \param text : File content. \param file : File name, the prefix of every message.
 * \throw std::runtime_error naming the file, the field and the value.
 */
[[nodiscard]] Setup readSetup(const std::string &text, const std::string &file);
} // namespace printExplore

#endif
