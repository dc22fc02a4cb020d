/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "appMain.h"

#include <opencv2/core.hpp>

#include <csignal>
#include <iostream>
#include <new>

namespace vpApp
{
namespace
{
volatile std::sig_atomic_t s_interrupted = 0;

// The second Ctrl-C ends the program at once, should a step take long.
void onInterrupt(int signal)
{
  s_interrupted = 1;
  std::signal(signal, SIG_DFL);
}

std::string oneLine(const std::string &text)
{
  std::string line;
  for (const char c : text) {
    const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!space) {
      line += c;
    }
    else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  while (!line.empty() && line.back() == ' ') {
    line.pop_back();
  }
  return line;
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
    return oneLine("OpenCV: " + fromOpenCV->err + " (" + fromOpenCV->func + ")");
  }
  if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr) {
    return "out of memory";
  }
  return oneLine(error.what());
}

int runMain(const std::string &program, const std::function<int()> &body)
{
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  try {
    return body();
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

bool parseCommandLine(CLI::App &app, int argc, const char *const *argv)
{
  try {
    app.parse(argc, argv);
    return true;
  }
  catch (const CLI::Success &request) { // --help, --version
    app.exit(request);
    return false;
  }
  catch (const CLI::ParseError &error) {
    throw UsageError(oneLine(error.what()));
  }
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

void throwIfInterrupted()
{
  if (interrupted()) {
    throw Interrupted();
  }
}
} // namespace vpApp
