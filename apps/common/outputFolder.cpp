/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "outputFolder.h"
#include "outputFile.h"

#include "vpFileText.h"
#include "vpStrictJson.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace fs = std::filesystem;

namespace vpApp
{
namespace
{
constexpr const char *SUMMARY = "summary.json";
constexpr const char *UNFINISHED = "unfinished-run";

std::runtime_error cannot(const fs::path &path, const std::string &what, const std::error_code &reason)
{
  return std::runtime_error(path.string() + ": " + what + (reason ? " (" + reason.message() + ")" : ""));
}

// Without changing the meaning: "link/.." is kept, as it is not ".".
fs::path plainPath(const std::string &folder)
{
  const fs::path path = fs::absolute(folder);
  const bool goesUp = std::find(path.begin(), path.end(), "..") != path.end();
  const fs::path plain = goesUp ? path : path.lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path(); // "out/" is "out"
}

fs::file_type typeOf(const fs::path &path) // of a symbolic link, not of its target
{
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type();
}

// An edited summary.json must not lead out of the folder.
bool isInside(const fs::path &name)
{
  return !name.empty() && name.is_relative() && std::find(name.begin(), name.end(), "..") == name.end();
}

// The parents of folder/name that are not plain folders, or the first of them.
fs::path obstacleOnWay(const fs::path &folder, const fs::path &name)
{
  fs::path way;
  for (const fs::path &part : name.parent_path()) {
    way /= part;
    const fs::file_type type = typeOf(folder / way);
    if (type != fs::file_type::not_found && type != fs::file_type::directory) {
      return way;
    }
  }
  return {};
}

// Null if there is none.
nlohmann::json readSummary(const fs::path &folder)
{
  try {
    const fs::path file = folder / SUMMARY;
    return typeOf(file) == fs::file_type::regular ? vpReadJson(file.string()) : nlohmann::json();
  }
  catch (const vpFileError &) {
    return {};
  }
}

void writeFile(const fs::path &file, const std::string &content, const fs::path &wanted)
{
  std::ofstream stream(file, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) {
    throw std::runtime_error(wanted.string() + ": cannot be written");
  }
}

void moveFile(const fs::path &from, const fs::path &to)
{
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  fs::rename(from, to, error);
  if (error) {
    throw cannot(to, "cannot be written", error);
  }
}
} // namespace

OutputFolder::OutputFolder(std::string program, const std::string &folder)
  : m_program(std::move(program)), m_folder(plainPath(folder)), m_unfinished(m_folder / UNFINISHED)
{
  readFormerResult();
  makeFolder();
  try {
    m_lock = std::make_unique<FolderLock>(m_unfinished, m_program);
    readFormerResult(); // another run may have ended just now
  }
  catch (...) {
    undo();
    throw;
  }
}

OutputFolder::~OutputFolder()
{
  if (!m_stays) {
    undo();
  }
}

void OutputFolder::undo()
{
  if (m_lock) {
    m_lock->remove();
  }
  std::error_code ignored;
  for (const fs::path &made : m_made) {
    fs::remove(made, ignored); // only if empty
  }
}

void OutputFolder::readFormerResult()
{
  std::error_code error;
  m_formerFiles.clear();
  if (!fs::exists(m_folder, error)) {
    if (fs::is_symlink(m_folder)) {
      throw std::runtime_error(m_folder.string() + ": is a symbolic link to " + fs::read_symlink(m_folder).string() +
                               ", which does not exist");
    }
    return;
  }
  if (!fs::is_directory(m_folder)) {
    throw std::runtime_error(m_folder.string() + ": exists and is not a folder");
  }
  bool empty = true;
  for (fs::directory_iterator entry(m_folder, error), end; !error && entry != end; entry.increment(error)) {
    const bool leftover = entry->path() == m_unfinished && FolderLock::isLeftoverOf(m_program, m_unfinished);
    empty = empty && leftover;
  }
  if (error) {
    throw cannot(m_folder, "cannot be read", error);
  }
  if (empty) {
    return;
  }
  const nlohmann::json former = readSummary(m_folder);
  if (!former.is_object() || former.value("program", nlohmann::json()) != m_program) {
    throw std::runtime_error(m_folder.string() + ": is not empty and not a result of " + m_program +
                             ", so it is left alone; name another folder");
  }
  m_formerFiles.emplace_back(SUMMARY);
  const nlohmann::json files = former.value("files", nlohmann::json());
  for (const nlohmann::json &name : files.is_array() ? files : nlohmann::json::array()) {
    if (name.is_string() && isInside(name.get<std::string>())) {
      m_formerFiles.push_back(name.get<std::string>());
    }
  }
}

void OutputFolder::makeFolder()
{
  std::error_code error;
  for (fs::path part = m_folder; !fs::exists(part, error) && part.has_relative_path(); part = part.parent_path()) {
    m_made.push_back(part);
  }
  error.clear();
  fs::create_directories(m_folder, error);
  if (error) {
    throw cannot(m_folder, "cannot be written", error);
  }
}

std::string OutputFolder::file(const std::string &name)
{
  requireFreePlace(name);
  const fs::path path = m_unfinished / name;
  fs::create_directories(path.parent_path());
  return path.string();
}

void OutputFolder::requireFreePlace(const std::string &name) const
{
  fs::path inTheWay = obstacleOnWay(m_folder, name);
  if (inTheWay.empty()) {
    const fs::file_type type = typeOf(m_folder / name);
    const bool former = std::find(m_formerFiles.begin(), m_formerFiles.end(), name) != m_formerFiles.end();
    const bool free = type == fs::file_type::not_found || (type == fs::file_type::regular && former);
    inTheWay = free ? "" : name;
  }
  if (!inTheWay.empty()) {
    throw std::runtime_error(
        (m_folder / inTheWay).string() +
        ": is not of an earlier run but has the name of a file of the result, so it is left alone; "
        "move it away or name another folder");
  }
}

void OutputFolder::write(const std::string &name, const std::string &content)
{
  writeFile(file(name), content, m_folder / name);
}

std::vector<std::string> OutputFolder::newFiles() const
{
  std::vector<std::string> files;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(m_unfinished)) {
    const fs::path name = entry.path().lexically_relative(m_unfinished);
    if (entry.is_regular_file() && !FolderLock::isMark(entry.path()) && name != SUMMARY) {
      files.push_back(name.string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

void OutputFolder::writeSummary(nlohmann::ordered_json summary)
{
  std::vector<std::string> files = newFiles();
  files.insert(std::lower_bound(files.begin(), files.end(), SUMMARY), SUMMARY);
  summary["program"] = m_program;
  summary["status"] = summary.value("status", std::string("complete"));
  summary["files"] = files;
  // User input may be invalid UTF-8.
  write(SUMMARY, summary.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void OutputFolder::commit()
{
  const std::vector<std::string> files = newFiles();
  for (const std::string &name : files) {
    requireFreePlace(name);
  }
  // From here on both results are identified as ours, even if the process is killed.
  std::vector<std::string> all = m_formerFiles;
  all.insert(all.end(), files.begin(), files.end());
  const fs::path mixed = m_unfinished / ".summary-while-moving";
  writeFile(mixed,
            nlohmann::ordered_json({{"program", m_program}, {"status", "unfinished"}, {"files", all}}).dump(2) + "\n",
            m_folder / SUMMARY);
  m_stays = true;
  moveFile(mixed, m_folder / SUMMARY);
  removeFormer(files);
  for (const std::string &name : files) {
    moveFile(m_unfinished / name, m_folder / name);
  }
  moveFile(m_unfinished / SUMMARY, m_folder / SUMMARY);
  m_lock->remove();
}

void OutputFolder::removeFormer(const std::vector<std::string> &except) const
{
  for (const std::string &name : m_formerFiles) {
    const fs::file_type type = typeOf(m_folder / name);
    const bool gone = type == fs::file_type::not_found; // a run was killed between removing file and folder
    const bool ours = (type == fs::file_type::regular || gone) && obstacleOnWay(m_folder, name).empty();
    if (ours && name != SUMMARY && !std::binary_search(except.begin(), except.end(), name)) {
      std::error_code ignored;
      fs::remove(m_folder / name, ignored);
      for (fs::path part = fs::path(name).parent_path(); !part.empty(); part = part.parent_path()) {
        fs::remove(m_folder / part, ignored); // only if empty
      }
    }
  }
}

std::string OutputFolder::keepUnfinished(const std::string &reason)
{
  m_stays = true;
  try {
    writeSummary({{"status", "unfinished"}, {"reason", reason}});
  }
  catch (const std::exception &) { // the folder's name shows it, too
  }
  return "the data so far are in " + m_unfinished.string();
}

std::string readFile(const fs::path &file)
{
  return vpReadFileText(file.string(), std::numeric_limits<std::size_t>::max());
}
} // namespace vpApp
