/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outputFile.h
 * \brief Single files that are written completely or not at all.
 */
#ifndef vpApp_outputFile_h
#define vpApp_outputFile_h

#include <filesystem>
#include <string>

namespace vpApp
{
/*!
 * Check a file name before the work, not after it.
 * \throw std::runtime_error naming the file when its folder does not exist or it is a folder itself.
 */
void requireWritable(const std::filesystem::path &file);

/*!
 * Write \e content to \e file, replacing an earlier file atomically. After an error the earlier file is kept.
 * \throw std::runtime_error naming the file when writing fails.
 */
void writeWholeFile(const std::filesystem::path &file, const std::string &content);
} // namespace vpApp

#endif
