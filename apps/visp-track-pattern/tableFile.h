/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file tableFile.h
 * \brief A table in the result folder, written line by line; it may exceed the memory.
 */
#ifndef trackPattern_tableFile_h
#define trackPattern_tableFile_h

#include "outputFolder.h"

#include <fstream>
#include <string>

namespace trackPattern
{
class TableFile
{
public:
  TableFile(vpApp::OutputFolder &out, const std::string &name, const std::string &heading);
  void add(const std::string &line) { m_stream << line << '\n'; }
  //! Flush added lines to disk, in case the program is killed.
  void flush() { m_stream.flush(); }
  //! \throw std::runtime_error naming the file when writing fails.
  void close();

private:
  std::string m_name;
  std::ofstream m_stream;
};

//! Like printf, as a string.
[[nodiscard]] std::string text(const char *format, ...) __attribute__((format(printf, 1, 2)));
} // namespace trackPattern

#endif
