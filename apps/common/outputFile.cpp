/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "outputFile.h"

#include <fstream>
#include <stdexcept>

#include <unistd.h>

namespace fs = std::filesystem;

namespace vpApp
{
void requireWritable(const fs::path &file)
{
  const fs::path folder = fs::absolute(file).parent_path();
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(file.string() + ": the folder " + folder.string() + " does not exist");
  }
  if (fs::is_directory(file)) {
    throw std::runtime_error(file.string() + ": is a folder, must be a file");
  }
  if (access((fs::exists(file) ? fs::absolute(file) : folder).c_str(), W_OK) != 0) {
    throw std::runtime_error(file.string() + ": cannot be written (permission)");
  }
}

void writeWholeFile(const fs::path &file, const std::string &content)
{
  // A device or a pipe is written to, never replaced; a link stays a link.
  const bool inPlace = fs::exists(file) && !fs::is_regular_file(file);
  const fs::path target = fs::weakly_canonical(file);
  const fs::path temporary =
      target.parent_path() / ("." + target.filename().string() + ".partial-" + std::to_string(getpid()));
  std::ofstream stream(inPlace ? file : temporary, std::ios::binary);
  stream << content;
  stream.close();
  std::error_code error;
  if (stream && !inPlace) {
    fs::rename(temporary, target, error);
  }
  if (!stream || error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw std::runtime_error(file.string() + ": cannot be written" + (error ? " (" + error.message() + ")" : ""));
  }
}
} // namespace vpApp
