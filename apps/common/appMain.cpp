/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "appMain.h"

#include "vpPrintable.h"

#include <visp3/core/vpConfig.h>

#include <opencv2/core.hpp>

#include <csignal>
#include <iostream>
#include <mutex>
#include <new>
#include <streambuf>

#include <fcntl.h>
#include <unistd.h>

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

volatile std::sig_atomic_t s_interrupted = 0;
int s_wake[2] = {-1, -1}; // pipe: read end, write end

// The second Ctrl-C ends the program at once, in case a step takes long.
void onInterrupt(int signal)
{
  s_interrupted = 1;
  static_cast<void>(!write(s_wake[1], "", 1));
  std::signal(signal, SIG_DFL);
}

void catchInterrupts()
{
  if (s_wake[0] < 0 && pipe2(s_wake, O_CLOEXEC | O_NONBLOCK) != 0) {
    throw std::runtime_error("the system gives no more files");
  }
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
}

int fail(const std::string &program, const std::string &sentence, int status)
{
  std::cerr << program << ": " << sentence << std::endl;
  return status;
}
} // namespace

std::string sentenceOf(const std::exception &error)
{
  if (const auto *fromOpenCV = dynamic_cast<const cv::Exception *>(&error)) {
    return vpPrintable("OpenCV: " + fromOpenCV->err + " (" + fromOpenCV->func + ")");
  }
  if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr) {
    return "out of memory";
  }
  return vpPrintable(error.what());
}

int runMain(const std::string &program, const std::function<int()> &body)
{
  const PrintableStream out(std::cout);
  const PrintableStream errors(std::cerr, "\r"); // "\r" is used by the progress bar
  try {
    catchInterrupts();
    const int status = body();
    if (!std::cout.flush()) {
      throw std::runtime_error("standard output: cannot be written");
    }
    return status;
  }
  catch (const UsageError &error) {
    return fail(program, sentenceOf(error) + " (see " + program + " --help)", ExitUsage);
  }
  catch (const Interrupted &error) {
    return fail(program, sentenceOf(error), ExitInterrupted);
  }
  catch (const std::exception &error) {
    return fail(program, sentenceOf(error), ExitData);
  }
}

std::string versionText()
{
  return std::string(VISP_DIRECT_VERSION) + " (ViSP " + std::to_string(VISP_VERSION_MAJOR) + "." +
         std::to_string(VISP_VERSION_MINOR) + "." + std::to_string(VISP_VERSION_PATCH) + ")";
}

std::string commandLine(const std::string &program, int argc, const char *const *argv)
{
  std::string line = program;
  for (int i = 1; i < argc; ++i) {
    line += std::string(" ") + argv[i];
  }
  return line;
}

bool interrupted() { return s_interrupted != 0; }

int interruptDescriptor() { return s_wake[0]; }

void throwIfInterrupted()
{
  if (interrupted()) {
    throw Interrupted();
  }
}
} // namespace vpApp
