/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "outputFolder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <unistd.h>

namespace fs = std::filesystem;

namespace vpApp
{
namespace
{
constexpr const char *SUMMARY = "summary.json";

std::runtime_error cannot(const fs::path &path, const std::string &what, const std::error_code &reason)
{
  return std::runtime_error(path.string() + ": " + what + (reason ? " (" + reason.message() + ")" : ""));
}

fs::path normalised(const std::string &folder)
{
  fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path(); // "out/" is "out"
}

nlohmann::json formerSummary(const fs::path &folder)
{
  std::ifstream stream(folder / SUMMARY);
  return nlohmann::json::parse(stream, nullptr, false);
}
} // namespace

OutputFolder::OutputFolder(std::string program, const std::string &folder)
  : m_program(std::move(program)), m_folder(normalised(folder))
{
  std::error_code error;
  if (fs::exists(m_folder, error)) {
    if (!fs::is_directory(m_folder)) {
      throw std::runtime_error(m_folder.string() + ": exists and is not a folder");
    }
    const bool empty = fs::is_empty(m_folder, error);
    if (error) {
      throw cannot(m_folder, "cannot be read", error);
    }
    const nlohmann::json former = empty ? nlohmann::json::object() : formerSummary(m_folder);
    if (!empty && (!former.is_object() || former.value("program", nlohmann::json()) != m_program)) {
      throw std::runtime_error(m_folder.string() + ": is not empty and not a result of " + m_program +
                               ", so it is left alone; name another folder");
    }
    for (const nlohmann::json &name : former.value("files", nlohmann::json::array())) {
      m_formerFiles.push_back(name.is_string() ? name.get<std::string>() : "");
    }
  }
  for (fs::path parent = m_folder.parent_path(); !fs::exists(parent, error); parent = parent.parent_path()) {
    m_madeParents.push_back(parent);
  }
  m_temporary = m_folder.parent_path() / ("." + m_folder.filename().string() + ".partial-" + std::to_string(getpid()));
  if (!fs::create_directories(m_temporary, error)) {
    throw cannot(m_folder, "cannot be written", error);
  }
}

OutputFolder::~OutputFolder()
{
  if (!m_committed) {
    std::error_code ignored;
    fs::remove_all(m_temporary, ignored);
    for (const fs::path &parent : m_madeParents) {
      fs::remove(parent, ignored); // only if empty
    }
  }
}

std::string OutputFolder::file(const std::string &name)
{
  const fs::path path = m_temporary / name;
  fs::create_directories(path.parent_path());
  return path.string();
}

void OutputFolder::write(const std::string &name, const std::string &content)
{
  std::ofstream stream(file(name), std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw std::runtime_error((m_folder / name).string() + ": cannot be written");
  }
}

void OutputFolder::writeSummary(nlohmann::ordered_json summary)
{
  std::vector<std::string> files{SUMMARY};
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(m_temporary)) {
    if (entry.is_regular_file()) {
      files.push_back(fs::relative(entry.path(), m_temporary).string());
    }
  }
  std::sort(files.begin(), files.end());
  summary["program"] = m_program;
  summary["files"] = files;
  write(SUMMARY, summary.dump(2) + "\n");
}

void OutputFolder::commit()
{
  std::error_code error;
  const fs::path former = m_temporary.string() + "-former";
  if (fs::exists(m_folder)) {
    keepForeignFiles();
    fs::rename(m_folder, former, error);
    if (error) {
      throw cannot(m_folder, "cannot be replaced", error);
    }
  }
  fs::rename(m_temporary, m_folder, error);
  if (error) {
    std::error_code ignored;
    fs::rename(former, m_folder, ignored);
    throw cannot(m_folder, "cannot be written", error);
  }
  m_committed = true;
  fs::remove_all(former, error);
}

// Copies, so that the former folder stays whole until the new one is in place.
void OutputFolder::keepForeignFiles() const
{
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(m_folder)) {
    const fs::path name = fs::relative(entry.path(), m_folder);
    const bool ours = std::find(m_formerFiles.begin(), m_formerFiles.end(), name.string()) != m_formerFiles.end();
    if (entry.is_regular_file() && !ours && !fs::exists(m_temporary / name)) {
      fs::create_directories((m_temporary / name).parent_path());
      fs::copy_file(entry.path(), m_temporary / name);
    }
  }
}

std::string readFile(const fs::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad() || fs::is_directory(file)) {
    throw std::runtime_error(file.string() + ": cannot be read");
  }
  return content;
}
} // namespace vpApp
