/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpMeshPath.h"

#include "vpFileText.h"
#include "vpXmlOutline.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace fs = std::filesystem;

namespace
{
bool isFile(const fs::path &path)
{
  std::error_code failed;
  return fs::is_regular_file(path, failed) && !failed;
}

// The file, whatever the letter case of its suffix.
std::string existing(const fs::path &path)
{
  std::string lower = path.extension().string(), upper = lower;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  for (const std::string &suffix : {path.extension().string(), lower, upper}) {
    fs::path file = path;
    file.replace_extension(suffix);
    if (isFile(file)) {
      return file.lexically_normal().string();
    }
  }
  return "";
}

// The name in package.xml; empty if there is none.
std::string packageName(const fs::path &folder)
{
  const fs::path file = folder / "package.xml";
  if (!isFile(file)) {
    return "";
  }
  try {
    const std::string text = vpReadFileText(file.string());
    for (const vpXmlElement &element : vpReadXmlOutline(text, file.string())) {
      if (element.name == "name" && element.parent == 0) {
        const std::size_t from = text.find('>', element.afterName);
        return text.substr(from + 1, text.find('<', from) - from - 1);
      }
    }
  }
  catch (const vpFileError &) { // another program's file: the name of the folder may still do
  }
  return "";
}

bool begins(const std::string &text, const std::string &with) { return text.compare(0, with.size(), with) == 0; }
} // namespace

vpMeshPath::vpMeshPath(const std::string &urdf, const std::vector<std::string> &packagePaths)
  : m_folders(packagePaths), m_given(packagePaths.size())
{
  std::error_code failed;
  fs::path folder = fs::absolute(urdf, failed).parent_path().lexically_normal();
  m_folder = folder.string();
  for (; !folder.empty(); folder = folder.parent_path()) {
    m_folders.push_back(folder.string());
    if (!folder.has_relative_path()) {
      break;
    }
  }
}

std::string vpMeshPath::find(const std::string &name) const
{
  for (const char *scheme : {"package://", "model://"}) {
    if (!begins(name, scheme)) {
      continue;
    }
    const std::string inside = name.substr(std::string(scheme).size());
    const std::size_t slash = inside.find('/');
    if (slash == std::string::npos) {
      return "";
    }
    const std::string package = inside.substr(0, slash), rest = inside.substr(slash + 1);
    for (const std::string &folder : m_folders) {
      std::string file = existing(fs::path(folder) / package / rest);
      if (file.empty() && (fs::path(folder).filename() == package || packageName(folder) == package)) {
        file = existing(fs::path(folder) / rest);
      }
      if (!file.empty()) {
        return file;
      }
    }
    return "";
  }
  return name.empty() ? "" : existing(fs::path(m_folder) / (begins(name, "file://") ? name.substr(7) : name));
}

std::string vpMeshPath::searched() const
{
  std::string text;
  for (std::size_t i = 0; i < m_given; ++i) {
    text += m_folders[i] + ", ";
  }
  return text + m_folder + " and the folders above it";
}
