/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outputFile.h
 * \brief Single files that appear whole or not at all.
 */
#ifndef vpApp_outputFile_h
#define vpApp_outputFile_h

#include <filesystem>
#include <string>

namespace vpApp
{
/*!
 * Complain before the work is done, not after it.
 * \throw std::runtime_error naming the file when its folder does not exist or it is a folder itself.
 */
void requireWritable(const std::filesystem::path &file);

/*!
 * Write \e content to \e file, replacing an earlier one in one step. After an error the earlier one is still there.
 * \throw std::runtime_error naming the file when the system refuses.
 */
void writeWholeFile(const std::filesystem::path &file, const std::string &content);
} // namespace vpApp

#endif
