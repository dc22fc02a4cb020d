/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "appMain.h"
#include "printableStreams.h"

#include "vpPrintable.h"

#include <visp3/core/vpConfig.h>

#include <opencv2/core.hpp>

#include <csignal>
#include <iostream>
#include <new>

#include <fcntl.h>
#include <unistd.h>

namespace vpApp
{
namespace
{
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
