/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCaseFile.h
 * \brief Inputs from public problems and packages, which are not part of the project.
 */
#ifndef vpCaseFile_h
#define vpCaseFile_h

#include "vpCatch.h"

#include <visp3/core/vpIoTools.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace vpTestSupport
{
/*!
 * Path of a file in the folder `shared/cases` in a parent folder of the project, or in the folder named by the
 * environment variable `VISP_DIRECT_CASES`.
 * \return Empty if there is no such file: the test is then marked as skipped.
 */
inline std::string caseFile(const std::string &name)
{
  namespace fs = std::filesystem;
  std::error_code ignored;
  const char *folder = std::getenv("VISP_DIRECT_CASES");
  if (folder != nullptr && fs::exists(fs::path(folder) / name, ignored)) {
    return (fs::path(folder) / name).string();
  }
  for (fs::path at = VISP_DIRECT_DATA_DIR; at.has_relative_path(); at = at.parent_path()) {
    const fs::path file = at / "shared" / "cases" / name;
    if (fs::exists(file, ignored)) {
      return file.string();
    }
  }
  skip("the public case " + name + " is not there (folder shared/cases, or VISP_DIRECT_CASES)");
  return "";
}

//! Path of an image of Debian's visp-images-data, whether it is there or not. Those of type .pgm are of type .png since ViSP 3.6.
inline std::string vispImage(const std::string &name)
{
  const std::filesystem::path file = std::filesystem::path(vpIoTools::getViSPImagesDataPath()) / name;
  std::filesystem::path later = file;
  later.replace_extension(".png");
  std::error_code ignored;
  return (std::filesystem::exists(later, ignored) ? later : file).string();
}
} // namespace vpTestSupport

#endif
