/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "dataFile.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace vpApp
{
std::string dataFile(const std::string &name)
{
  std::vector<std::string> folders{VISP_DIRECT_INSTALLED_DATA, VISP_DIRECT_SOURCE_DATA};
  if (const char *folder = std::getenv("VISP_DIRECT_DATA")) {
    folders = {folder};
  }
  std::string searched;
  for (const std::string &folder : folders) {
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
} // namespace vpApp
