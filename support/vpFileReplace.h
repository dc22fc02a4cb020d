/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFileReplace.h
 * \brief Writes a file as a whole or not at all. Not installed.
 */
#ifndef vpFileReplace_h
#define vpFileReplace_h

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

/*!
 * \brief Writes beside the file and renames: a reader never gets half of it, and a failure leaves the old content.
 * \return Empty; else why it cannot be written, in brackets behind a blank: " (No space left on device)".
 */
inline std::string vpReplaceFile(const std::string &file, const std::string &content)
{
  namespace fs = std::filesystem;
  const fs::path target = file;
  const fs::path part =
      target.parent_path() / ("." + target.filename().string() + "." + std::to_string(getpid()) + ".partial");
  errno = 0;
  std::ofstream stream(part, std::ios::binary);
  stream << content;
  stream.close();
  std::error_code error, ignored;
  if (stream) {
    fs::rename(part, target, error);
  }
  if (stream && !error) {
    return "";
  }
  const int reason = error ? error.value() : errno;
  fs::remove(part, ignored);
  return reason != 0 ? " (" + std::generic_category().message(reason) + ")" : " (unknown reason)";
}

#endif
