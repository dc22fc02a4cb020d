/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTargetList.h"

#include "vpJsonObject.h"
#include "vpPictureFile.h"
#include "vpReading.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <set>
#include <stdexcept>

BEGIN_VISP_NAMESPACE

namespace
{
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string &file, const std::string &sentence)
{
  throw vpException(vpException::badValue, file + ": " + sentence);
}

double length(vpJsonObject &entry, const char *field)
{
  const double value = entry.number(field);
  if (!(value > 0.)) {
    throw entry.wrong(field, value, "a number > 0");
  }
  return value;
}

std::string text(vpJsonObject &entry, const char *field)
{
  std::string value = entry.text(field);
  if (value.empty()) {
    throw entry.wrong(field, value, "a text");
  }
  return value;
}

void requireAllListed(const std::string &folder, const std::vector<vpTargetListEntry> &entries)
{
  std::set<std::string> listed;
  for (const vpTargetListEntry &entry : entries) {
    listed.insert(fs::path(entry.file).filename().string());
  }
  std::error_code error;
  for (fs::directory_iterator item(folder, error), end; !error && item != end; item.increment(error)) {
    const std::string name = item->path().filename().string();
    if (name[0] != '.' && vpPictures::isImageName(name) && listed.count(name) == 0) {
      fail(folder + "/targets.json", "does not list the photograph " + name + " of its folder");
    }
  }
  if (error) {
    throw vpFileError(folder + ": cannot be read (" + error.message() + ")", vpFileError::Kind::Unreadable);
  }
}

std::vector<vpTargetListEntry> read(const std::string &folder)
{
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw vpException(vpException::ioError, folder + ": is not a folder");
  }
  const std::string file = folder + "/targets.json";
  const nlohmann::json content = vpReadJson(file);
  vpJsonObject top(content, file);
  std::vector<vpTargetListEntry> entries;
  for (vpJsonObject &entry : top.objects("targets")) {
    vpTargetListEntry target{text(entry, "name"), folder + "/" + text(entry, "image"), length(entry, "width_m"),
                             std::nullopt, 0.};
    if (entry.has("height_m")) {
      target.height = length(entry, "height_m");
    }
    if (entry.has("depth_m")) {
      target.depth = length(entry, "depth_m");
    }
    entry.finish();
    entries.push_back(target);
  }
  top.ignore("comment");
  top.finish();
  requireAllListed(folder, entries);
  return entries;
}
} // namespace

std::vector<vpTargetListEntry> readTargetList(const std::string &folder)
{
  return vpReading([&] { return read(folder); });
}

void readReference(const std::string &file, vpImage<unsigned char> &reference)
{
  cv::Mat image;
  try {
    vpPictures::GreyScale scale;
    image = vpPictures::readGreyPicture(file, scale);
  }
  catch (const std::runtime_error &error) {
    throw vpException(vpException::ioError, error.what());
  }
  reference.resize(static_cast<unsigned int>(image.rows), static_cast<unsigned int>(image.cols));
  for (int row = 0; row < image.rows; ++row) {
    std::memcpy(reference[static_cast<unsigned int>(row)], image.ptr(row), static_cast<std::size_t>(image.cols));
  }
}

END_VISP_NAMESPACE
