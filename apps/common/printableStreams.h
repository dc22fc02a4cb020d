/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file printableStreams.h
 * \brief What comes from files never steers the terminal.
 */
#ifndef vpApp_printableStreams_h
#define vpApp_printableStreams_h

#include <iostream>
#include <mutex>
#include <streambuf>
#include <string>

namespace vpApp
{
/*!
 * \brief As long as it lives, a stream escapes what is unprintable (vpEscapeUnprintable()), whoever writes to it: names from
 * files, sentences of libraries. A text of JSON stays the same text.
 */
class PrintableStream : private std::streambuf
{
public:
  //! \param stream : The stream. \param keep : Control characters that pass besides the end of a line and the tabulator.
  explicit PrintableStream(std::ostream &stream, const std::string &keep = "");
  ~PrintableStream() override;
  PrintableStream(const PrintableStream &) = delete;
  PrintableStream &operator=(const PrintableStream &) = delete;

private:
  int overflow(int c) override;
  std::streamsize xsputn(const char *text, std::streamsize size) override;
  int sync() override;
  bool pass(bool all);

  std::ostream &m_stream;
  std::streambuf *m_target;
  std::string m_keep;
  std::string m_pending; // the beginning of a character
  std::mutex m_mutex;    // as the standard streams, this one may be written to by several threads
};
} // namespace vpApp

#endif
