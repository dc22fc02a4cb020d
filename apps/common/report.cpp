/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "report.h"

#include "appMain.h"

#include "vpPrintable.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <system_error>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace vpApp
{
namespace
{
namespace fs = std::filesystem;

std::string variable(const char *name)
{
  const char *value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::string interpreter()
{
  const std::string named = variable("VISP_DIRECT_PYTHON");
  std::error_code ignored;
  const bool here = fs::exists(VISP_DIRECT_BUILD_PYTHON, ignored); // not on another machine, perhaps
  return !named.empty() ? named : here ? VISP_DIRECT_BUILD_PYTHON : "python3";
}

//! The package beside the running program, in the build folder or installed; then where Python looks anyway.
std::string packageFolders()
{
  std::error_code ignored;
  const fs::path bin = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  std::string folders;
  for (const char *folder : {"../python", VISP_DIRECT_PYTHON_FROM_PROGRAM}) {
    if (fs::exists(bin / folder / "visp_direct" / "report", ignored)) {
      folders += (bin / folder).lexically_normal().string() + ":";
    }
  }
  return folders + variable("PYTHONPATH");
}

//! Runs Python with its output in \e said, whose last line is the reason of a failure. \return True: exit status 0.
bool runPython(const std::string &folder, std::string &said)
{
  std::string program = interpreter(), option = "-m", module = "visp_direct.report", out = folder;
  std::array<char *, 5> arguments = {program.data(), option.data(), module.data(), out.data(), nullptr};
  std::vector<std::string> environment = {"PYTHONPATH=" + packageFolders(), "PYTHONDONTWRITEBYTECODE=1",
                                          "PYTHONIOENCODING=utf-8"};
  for (char **entry = environ; *entry != nullptr; ++entry) {
    if (std::string(*entry).rfind("PYTHONPATH=", 0) != 0) {
      environment.emplace_back(*entry);
    }
  }
  std::vector<char *> pointers;
  for (std::string &entry : environment) {
    pointers.push_back(entry.data());
  }
  pointers.push_back(nullptr);

  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    said = std::strerror(errno);
    return false;
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
  posix_spawn_file_actions_adddup2(&actions, ends[1], 2);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), pointers.data());
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    said = error == ENOENT ? program + " was not found" : program + ": " + std::strerror(error);
    return false;
  }
  std::array<char, 4096> part{};
  for (ssize_t size = 0; (size = read(ends[0], part.data(), part.size())) > 0 || (size < 0 && errno == EINTR);) {
    said.append(part.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    said += "\n" + program + " was ended by signal " + std::to_string(WTERMSIG(status));
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

//! The last line, which has the reason.
std::string reasonIn(std::string said, const std::string &folder, const std::string &place)
{
  said.erase(said.find_last_not_of(" \n") + 1);
  std::string reason = said.substr(said.rfind('\n') + 1);
  for (std::size_t at = 0; (at = reason.find(folder, at)) != std::string::npos; at += place.size()) {
    reason.replace(at, folder.size(), place);
  }
  return reason.empty() ? interpreter() + " wrote no report" : vpEscapeUnprintable(reason, "");
}
} // namespace

std::string finishWithReport(OutputFolder &out, const nlohmann::ordered_json &summary, bool isKeptAfterCtrlC,
                             bool hasAnswer)
{
  out.writeSummary(summary);
  const fs::path report = out.file("report.html");
  const std::string folder = report.parent_path().string();
  std::string said;
  const bool made = runPython(folder, said) && fs::exists(report);
  if (!isKeptAfterCtrlC) {
    throwIfInterrupted();
  }
  out.writeSummary(summary); // whose list of files has the report now
  out.commit();
  if (!made) {
    std::cerr << "The data is in " << out.path().string()
              << ", without a report, which needs Python: " << reasonIn(said, folder, out.path().string())
              << "; make it later by: python3 -m visp_direct.report " << out.path().string() << std::endl;
  }
  if (!made) {
    return "Data: " + out.path().string();
  }
  const std::string heading = "Answer:\n";
  const std::size_t begin = said.rfind(heading);
  std::string answer;
  if (hasAnswer && begin != std::string::npos) {
    answer = said.substr(begin + heading.size());
    answer.erase(answer.rfind('\n', answer.size() - 2) + 1); // the name of the file
  }
  return vpEscapeUnprintable(answer, "\n") + "Report: " + (out.path() / "report.html").string();
}
} // namespace vpApp
