/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file appMain.h
 * \brief From command line to exit status, the same for every program.
 */
#ifndef vpApp_appMain_h
#define vpApp_appMain_h

#include <functional>
#include <stdexcept>
#include <string>

namespace vpApp
{
//! Exit statuses of all programs of visp-direct.
enum ExitStatus : int {
  ExitOk = 0,    //!< Done.
  ExitData = 1,  //!< The data or the machine do not allow it: a file that is missing or wrong, full disk, no display.
  ExitUsage = 2, //!< The command line is wrong.
  ExitInterrupted = 130 //!< Ended by Ctrl-C, as a shell reports it.
};

//! \brief A mistake on the command line. runMain() turns it into ExitUsage.
class UsageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

//! \brief Thrown by throwIfInterrupted(). runMain() turns it into ExitInterrupted.
class Interrupted : public std::runtime_error
{
public:
  explicit Interrupted(const std::string &sentence = "interrupted, nothing was written") : std::runtime_error(sentence)
  {}
};

/*!
 * Run a program's body and turn any exception into one sentence on stderr, "program: what is wrong", and an exit
 * status. Also makes Ctrl-C and SIGTERM end the program through throwIfInterrupted(), so that destructors remove
 * temporary files; makes all output printable, so that no control character from a file reaches the terminal; and reports incomplete writes to standard output.
 * \param program : Name at the beginning of the sentence.
 * \param body : The program; its exit status is returned.
 */
[[nodiscard]] int runMain(const std::string &program, const std::function<int()> &body);

//! Version of visp-direct and of ViSP, "0.1.0 (ViSP 3.5.0)".
[[nodiscard]] std::string versionText();

//! The command line as typed, for reports and summaries: program name and arguments.
[[nodiscard]] std::string commandLine(const std::string &program, int argc, const char *const *argv);

//! True after Ctrl-C or SIGTERM.
[[nodiscard]] bool interrupted();
//! \throw Interrupted after Ctrl-C.
void throwIfInterrupted();
//! File descriptor for poll() that becomes readable when interrupted() is true; negative outside runMain().
[[nodiscard]] int interruptDescriptor();

//! The message of any exception as one printable line, without decoration added by libraries.
[[nodiscard]] std::string sentenceOf(const std::exception &error);
} // namespace vpApp

#endif
