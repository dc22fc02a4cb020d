/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "tableFile.h"

#include <cstdarg>
#include <cstdio>
#include <stdexcept>

namespace trackPattern
{
TableFile::TableFile(vpApp::OutputFolder &out, const std::string &name, const std::string &heading)
  : m_name((out.path() / name).string()), m_stream(out.file(name), std::ios::binary)
{
  add(heading);
}

void TableFile::close()
{
  m_stream.close();
  if (!m_stream) {
    throw std::runtime_error(m_name + ": cannot be written");
  }
}

std::string text(const char *format, ...)
{
  char buffer[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  return buffer;
}
} // namespace trackPattern
