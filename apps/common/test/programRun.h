/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file programRun.h
 * \brief Runs a program in an empty folder and captures its output.
 */
#ifndef vpApp_test_programRun_h
#define vpApp_test_programRun_h

#include "outputFolder.h"
#include "testFolder.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/wait.h>

//! For tests that look at data only: a report takes a second, and python/test opens those of all programs.
inline bool withoutReports() { return setenv("VISP_DIRECT_PYTHON", "/nowhere", 1) == 0; }
//! Environment of a run with a report after all.
constexpr const char *WITH_REPORT = "VISP_DIRECT_PYTHON=";

//! \brief Empty folder for one test, the working directory of the program; removed afterwards.
class ProgramRun
{
public:
  //! \param program : Path of the program.
  explicit ProgramRun(std::string program) : m_program(std::move(program)) {}

  //! Run with arguments (shell syntax), optionally with environment variables; returns the exit status.
  int operator()(const std::string &arguments, const std::string &environment = "")
  {
    const int status = call(environment + " '" + m_program + "' " + arguments + " >stdout.txt 2>stderr.txt");
    m_out = take("stdout.txt");
    m_err = take("stderr.txt");
    return status;
  }
  //! Run with a standard output that accepts no data.
  int intoFullDevice(const std::string &arguments)
  {
    const int status = call("'" + m_program + "' " + arguments + " >/dev/full 2>stderr.txt");
    m_out.clear();
    m_err = take("stderr.txt");
    return status;
  }
  [[nodiscard]] const std::string &out() const { return m_out; }
  [[nodiscard]] const std::string &err() const { return m_err; }
  [[nodiscard]] std::filesystem::path path(const std::string &name) const { return m_folder.path / name; }

  void write(const std::string &name, const std::string &content) const { m_folder.write(name, content); }
  //! Names in the folder, unsorted.
  [[nodiscard]] std::vector<std::string> entries() const
  {
    std::vector<std::string> names;
    for (const auto &entry : std::filesystem::directory_iterator(m_folder.path)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

private:
  int call(const std::string &command) const
  {
    const int status = std::system(("cd '" + m_folder.path.string() + "' && " + command).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string take(const std::string &name) const
  {
    std::string content = vpApp::readFile(path(name));
    std::filesystem::remove(path(name));
    return content;
  }

  std::string m_program;
  TestFolder m_folder;
  std::string m_out;
  std::string m_err;
};

#endif
