/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "printableStreams.h"

#include "vpPrintable.h"

namespace vpApp
{
namespace
{
// Bytes at the end of a text that may be an incomplete character.
std::size_t unfinished(const std::string &text)
{
  for (std::size_t back = 1; back <= 3 && back <= text.size(); ++back) {
    const auto byte = static_cast<unsigned char>(text[text.size() - back]);
    const std::size_t size = byte >= 0xf0 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc0 ? 2 : 1;
    if ((byte & 0xc0) != 0x80) {
      return size > back ? back : 0;
    }
  }
  return 0;
}
} // namespace

PrintableStream::PrintableStream(std::ostream &stream, const std::string &keep)
  : m_stream(stream), m_target(stream.rdbuf(this)), m_keep("\n\t" + keep)
{}

PrintableStream::~PrintableStream()
{
  pass(true);
  m_stream.rdbuf(m_target); // clears the state, already checked by the caller
}

bool PrintableStream::pass(bool all)
{
  const std::size_t left = all ? 0 : unfinished(m_pending);
  const std::string text = vpEscapeUnprintable(m_pending.substr(0, m_pending.size() - left), m_keep);
  m_pending.erase(0, m_pending.size() - left);
  const auto size = static_cast<std::streamsize>(text.size());
  return m_target->sputn(text.data(), size) == size;
}

int PrintableStream::overflow(int c)
{
  const char character = traits_type::to_char_type(c);
  return c == traits_type::eof() || xsputn(&character, 1) == 1 ? traits_type::not_eof(c) : traits_type::eof();
}

std::streamsize PrintableStream::xsputn(const char *text, std::streamsize size)
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  m_pending.append(text, static_cast<std::size_t>(size));
  return pass(false) ? size : 0;
}

int PrintableStream::sync()
{
  const std::lock_guard<std::mutex> lock(m_mutex);
  return pass(false) && m_target->pubsync() == 0 ? 0 : -1;
}
} // namespace vpApp
