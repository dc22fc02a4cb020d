/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "appMain.h"
#include "printableStreams.h"

#include "vpPrintable.h"

#include <CLI/CLI.hpp>

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
// CLI11 says "Could not convert: --frames = -5".
std::string conversionSentence(const CLI::App &app, const std::string &message)
{
  const std::string begin = "Could not convert: ", middle = " = ";
  const std::size_t at = message.find(middle);
  if (message.compare(0, begin.size(), begin) != 0 || at == std::string::npos) {
    return message;
  }
  const std::string name = message.substr(begin.size(), at - begin.size());
  const CLI::Option *option = app.get_option_no_throw(name);
  const std::string type = option == nullptr ? "" : option->get_type_name();
  const std::string wanted = type == "UINT" ? "a whole number >= 0" : type == "INT" ? "a whole number" : "a number";
  return name + " is " + message.substr(at + middle.size()) + ", must be " + wanted;
}
// CLI11 says "--out: 1 required TEXT missing".
std::string mismatchSentence(const std::string &message)
{
  const std::size_t at = message.find(": 1 required ");
  return at == std::string::npos ? message : message.substr(0, at) + " is given without a value";
}
// A name that a script left empty would otherwise be taken as not given.
void requireNoneEmpty(const CLI::App &app)
{
  for (const CLI::Option *option : app.get_options()) {
    for (const std::string &value : option->results()) {
      if (value.empty()) {
        throw UsageError(option->get_name() + " is given without a value");
      }
    }
  }
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

bool parseCommandLine(CLI::App &app, int argc, const char *const *argv)
{
  app.set_version_flag("--version", app.get_name() + " " + versionText());
  try {
    app.parse(argc, argv);
    requireNoneEmpty(app);
    return true;
  }
  catch (const CLI::Success &request) { // --help, --version
    app.exit(request);
    return false;
  }
  catch (const CLI::ConversionError &error) {
    throw UsageError(conversionSentence(app, error.what()));
  }
  catch (const CLI::ArgumentMismatch &error) {
    throw UsageError(mismatchSentence(error.what()));
  }
  catch (const CLI::ParseError &error) {
    throw UsageError(error.what());
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
