/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Files that programs read: dataFile.h, lineReader.h.
#include "appMain.h"
#include "dataFile.h"
#include "lineReader.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

namespace vpApp
{
namespace
{
// In the order in which they are searched. An installation is found from its program, so it can be moved, and a program of
// a build folder never takes the data of another version that is installed.
std::vector<std::string> dataFolders()
{
  const char *named = std::getenv("VISP_DIRECT_DATA");
  if (named != nullptr) {
    return {named};
  }
  std::vector<std::string> folders;
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  if (!program.empty()) {
    folders.push_back((program.parent_path() / VISP_DIRECT_DATA_FROM_PROGRAM).lexically_normal().string());
  }
  folders.push_back(VISP_DIRECT_SOURCE_DATA);
  return folders;
}

// As a word of a shell command.
std::string quoted(const std::string &path)
{
  static const std::regex special(R"([^\w./+:@%,=-])"), quote("'");
  return std::regex_search(path, special) ? "'" + std::regex_replace(path, quote, R"('\'')") + "'" : path;
}

// data/NAME as the user reaches it from the current folder; unchanged when there is no such file or folder.
std::string reachable(const std::string &name)
{
  std::error_code ignored;
  for (const std::string &folder : dataFolders()) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    if (std::filesystem::exists(file, ignored)) {
      const std::string near = std::filesystem::proximate(file, ignored).string();
      return quoted(near.empty() || near.rfind("..", 0) == 0 ? file.string() : near);
    }
  }
  return "data/" + name;
}
} // namespace

std::string dataFile(const std::string &name)
{
  std::string searched;
  for (const std::string &folder : dataFolders()) {
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) {
      return file.string();
    }
    searched += (searched.empty() ? "" : " nor in ") + folder;
  }
  throw std::runtime_error("data file " + name + " is not in " + searched +
                           "; set VISP_DIRECT_DATA to the data folder of visp-direct");
}

std::string withDataPaths(const std::string &text)
{
  const std::regex word(R"((^|[^\w./-])data/([\w./-]*\w))");
  std::string result;
  auto rest = text.begin();
  for (std::sregex_iterator found(text.begin(), text.end(), word), end; found != end; ++found) {
    result.append(rest, (*found)[1].second).append(reachable((*found)[2]));
    rest = (*found)[0].second;
  }
  return result.append(rest, text.end());
}

LineReader::LineReader(const std::string &file) : m_name(file == "-" ? "standard input" : file)
{
  if (file != "-") {
    // Do not wait here for the other end of a pipe, as Ctrl-C could not interrupt it: next() waits.
    m_descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    struct stat status {
    };
    if (m_descriptor < 0 || fstat(m_descriptor, &status) != 0 || S_ISDIR(status.st_mode)) {
      const std::string reason = m_descriptor >= 0 ? "it is a folder"
                                 : errno == ENOENT ? "there is no such file"
                                                   : std::generic_category().message(errno);
      throw std::runtime_error(m_name + ": cannot be read (" + reason + ")");
    }
  }
}

LineReader::~LineReader()
{
  if (m_descriptor > 0) {
    close(m_descriptor);
  }
}

bool LineReader::next(std::string &line)
{
  ++m_line;
  for (;;) {
    const std::size_t end = m_buffer.find('\n', m_searched);
    if (end != std::string::npos) {
      line.assign(m_buffer, m_start, end - m_start);
      m_start = m_searched = end + 1;
      return true;
    }
    m_buffer.erase(0, m_start);
    m_start = 0;
    m_searched = m_buffer.size();
    if (m_buffer.size() > LONGEST) {
      throw std::runtime_error(m_name + ":" + std::to_string(m_line) + ": is longer than " +
                               std::to_string(LONGEST >> 20U) + " MB");
    }
    if (!readMore()) {
      line = std::move(m_buffer);
      m_buffer.clear();
      m_searched = 0;
      return !line.empty();
    }
  }
}

bool LineReader::readMore()
{
  for (;;) {
    pollfd waited[2] = {{m_descriptor, POLLIN, 0}, {interruptDescriptor(), POLLIN, 0}};
    const int count = poll(waited, 2, -1);
    if (interrupted()) {
      throw Interrupted("interrupted");
    }
    if (count < 0 && errno == EINTR) {
      continue;
    }
    std::array<char, 1U << 16U> block;
    const ssize_t size = read(m_descriptor, block.data(), block.size());
    if (size > 0) {
      m_buffer.append(block.data(), static_cast<std::size_t>(size));
      return true;
    }
    if (size == 0) {
      return false;
    }
    if (errno != EINTR && errno != EAGAIN) {
      throw std::runtime_error(m_name + ": cannot be read");
    }
  }
}
} // namespace vpApp
