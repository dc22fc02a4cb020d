/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file printableStreams.h
 * \brief Keeps control characters from files away from the terminal.
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
 * \brief During its lifetime, a stream escapes unprintable characters (vpEscapeUnprintable()) from all writers: names
 * from files, messages of libraries. JSON text keeps its meaning.
 */
class PrintableStream : private std::streambuf
{
public:
  //! \param stream : The stream. \param keep : Control characters to pass besides line end and tabulator.
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
  std::string m_pending; // incomplete character
  std::mutex m_mutex;    // several threads may write, as with the standard streams
};
} // namespace vpApp

#endif
