/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFileText.h
 * \brief Common parts of all file readers: error class, bounds, and reading a file into memory. Not
 * installed.
 */
#ifndef vpFileText_h
#define vpFileText_h

#include "vpPrintable.h"

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

//! Deepest nesting that readers accept, in elements or brackets; deeper recursion could overflow the stack.
constexpr int vpDeepestNesting = 64;
//! Largest text file that readers accept, bytes. A description of a robot or a scene is a thousand times smaller.
constexpr std::size_t vpLargestTextFile = 64U << 20U;
//! Largest mesh or octree file that readers accept, bytes.
constexpr std::size_t vpLargestDataFile = 256U << 20U;

/*!
 * \brief Error in a file, as one printable sentence. Thrown internally by readers; vpReading() converts it to the
 * documented vpException.
 */
class vpFileError : public std::runtime_error
{
public:
  enum class Kind {
    Unreadable, //!< The file cannot be read.
    Wrong       //!< The content is invalid.
  };
  explicit vpFileError(const std::string &sentence, Kind kind = Kind::Wrong)
    : std::runtime_error(vpPrintable(sentence)), m_kind(kind)
  {}
  [[nodiscard]] Kind kind() const { return m_kind; }

private:
  Kind m_kind;
};

/*!
 * Open a file for reading.
 * \throw vpFileError with the reason: there is none, it is a folder, a pipe or a device (which might never end, or never
 * begin), or the system says no.
 */
inline std::ifstream vpOpenFile(const std::string &file)
{
  const auto refuse = [&file](const std::string &reason) {
    throw vpFileError(file + ": cannot be read" + (reason.empty() ? "" : " (" + reason + ")"),
                      vpFileError::Kind::Unreadable);
  };
  std::error_code ignored; // what the system says on opening is better
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (status.type() == std::filesystem::file_type::not_found) {
    refuse("there is no such file");
  }
  if (std::filesystem::is_directory(status)) {
    refuse("it is a folder");
  }
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    refuse("it is a pipe or a device");
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    refuse(errno != 0 ? std::generic_category().message(errno) : "");
  }
  return stream;
}

/*!
 * The bytes of a file.
 * \throw vpFileError when the file cannot be read, see vpOpenFile(), or has more than \e most bytes.
 */
inline std::string vpReadFileText(const std::string &file, std::size_t most = vpLargestTextFile)
{
  std::ifstream stream = vpOpenFile(file);
  std::string text;
  std::array<char, 1U << 16U> block;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > most) {
      throw vpFileError(file + ": is larger than " + std::to_string(most >> 20U) + " MB");
    }
  }
  if (stream.bad()) {
    throw vpFileError(file + ": cannot be read", vpFileError::Kind::Unreadable);
  }
  return text;
}

//! Position of a byte, counted from 0, as "line 3, column 7".
inline std::string vpLineAndColumn(const std::string &text, std::size_t byte)
{
  std::size_t line = 1, start = 0;
  for (std::size_t i = 0; i < byte && i < text.size(); ++i) {
    if (text[i] == '\n') {
      ++line;
      start = i + 1;
    }
  }
  return "line " + std::to_string(line) + ", column " + std::to_string(byte - start + 1);
}

#endif
