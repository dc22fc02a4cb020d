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
#include "programServer.h"
#include "testFolder.h"

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>
#include <wordexp.h>

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
    const int status = call(environment, arguments, "stdout.txt");
    m_out = take("stdout.txt");
    m_err = take("stderr.txt");
    return status;
  }
  //! Run with a standard output that accepts no data.
  int intoFullDevice(const std::string &arguments)
  {
    const int status = call("", arguments, "/dev/full");
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
  //! By the server of the program, or by a shell: what stands before the program may be any command, as mpirun.
  int call(const std::string &before, const std::string &arguments, const std::string &out) const
  {
    std::optional<int> status;
    if (std::optional<ProgramServer::Request> request = requestOf(before, arguments)) {
      request->out = out;
      status = ProgramServer::of(m_program).run(*request);
    }
    if (!status) {
      status = std::system(("cd '" + m_folder.path.string() + "' && " + before + " '" + m_program + "' " + arguments +
                            " >" + out + " 2>stderr.txt")
                               .c_str());
    }
    return WIFEXITED(*status) ? WEXITSTATUS(*status) : 128 + WTERMSIG(*status); // as a shell does
  }
  //! Nothing if it takes a shell.
  [[nodiscard]] std::optional<ProgramServer::Request> requestOf(const std::string &before,
                                                                const std::string &arguments) const
  {
    ProgramServer::Request request;
    request.folder = m_folder.path.string();
    request.err = "stderr.txt";
    std::map<std::string, std::string> variables;
    for (char **variable = environ; *variable != nullptr; ++variable) {
      const std::string text = *variable;
      variables[text.substr(0, text.find('='))] = text;
    }
    const std::optional<std::vector<std::string>> prefix = wordsOf(before), words = wordsOf(arguments);
    if (!prefix || !words) {
      return std::nullopt;
    }
    for (std::size_t i = 0; i < prefix->size(); ++i) {
      const std::string &word = (*prefix)[i];
      const std::size_t end = word.find('=');
      if (end != std::string::npos &&
          std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(end),
                      [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; })) {
        variables[word.substr(0, end)] = word;
      }
      else if (word == "timeout" && i + 2 == prefix->size()) {
        request.seconds = static_cast<unsigned int>(std::stoul((*prefix)[++i]));
      }
      else {
        return std::nullopt;
      }
    }
    request.arguments = {m_program};
    request.arguments.insert(request.arguments.end(), words->begin(), words->end());
    for (const auto &[name, text] : variables) {
      request.environment.push_back(text);
    }
    return request;
  }
  //! The words of a command line; nothing if they need more of a shell than quotes.
  static std::optional<std::vector<std::string>> wordsOf(const std::string &text)
  {
    wordexp_t found{};
    if (text.find_first_of("*?~$`\n") != std::string::npos || wordexp(text.c_str(), &found, WRDE_NOCMD) != 0) {
      return std::nullopt;
    }
    std::vector<std::string> words(found.we_wordv, found.we_wordv + found.we_wordc);
    wordfree(&found);
    return words;
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
