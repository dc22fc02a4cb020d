/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTestFile.h
 * \brief A file for a reader to read.
 */
#ifndef vpTestFile_h
#define vpTestFile_h

#include <cstdio>
#include <fstream>
#include <string>

namespace vpTestSupport
{
//! \brief A file in the working folder; removed again.
class File
{
public:
  File(const std::string &name, const std::string &content) : m_name(name)
  {
    std::ofstream(m_name, std::ios::binary) << content;
  }
  ~File() { std::remove(m_name.c_str()); }
  File(const File &) = delete;
  File &operator=(const File &) = delete;
  [[nodiscard]] const std::string &name() const { return m_name; }

private:
  std::string m_name;
};
} // namespace vpTestSupport

#endif
