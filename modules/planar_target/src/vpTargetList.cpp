/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpTargetList.h"

#include "vpPictureFile.h"

#include <visp3/core/vpException.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>

BEGIN_VISP_NAMESPACE

namespace
{
using nlohmann::json;
namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string &file, const std::string &sentence)
{
  throw vpException(vpException::badValue, file + ": " + sentence);
}

json parse(const std::string &file)
{
  std::ifstream stream(file);
  if (!stream) {
    throw vpException(vpException::ioError, file + ": cannot be read");
  }
  try {
    return json::parse(stream);
  }
  catch (const json::exception &error) {
    fail(file, std::string("is not JSON: ") + error.what());
  }
}

double length(const json &entry, const char *field, const std::string &place, const std::string &file)
{
  const json &value = entry[field];
  if (!value.is_number() || !(value.get<double>() > 0.)) {
    fail(file, place + "." + field + " is " + value.dump() + ", must be a number > 0");
  }
  return value.get<double>();
}

std::string text(const json &entry, const char *field, const std::string &place, const std::string &file)
{
  if (!entry.contains(field) || !entry[field].is_string() || entry[field].get<std::string>().empty()) {
    fail(file,
         place + "." + field + " is " + (entry.contains(field) ? entry[field].dump() : "missing") + ", must be a text");
  }
  return entry[field].get<std::string>();
}

void requireAllListed(const std::string &folder, const std::vector<vpTargetListEntry> &entries)
{
  std::set<std::string> listed;
  for (const vpTargetListEntry &entry : entries) {
    listed.insert(fs::path(entry.file).filename().string());
  }
  for (const fs::directory_entry &item : fs::directory_iterator(folder)) {
    const std::string name = item.path().filename().string();
    if (name[0] != '.' && vpPictures::isImageName(name) && listed.count(name) == 0) {
      fail(folder + "/targets.json", "does not list the photograph " + name + " of its folder");
    }
  }
}
} // namespace

std::vector<vpTargetListEntry> readTargetList(const std::string &folder)
{
  if (!fs::is_directory(folder)) {
    throw vpException(vpException::ioError, folder + ": is not a folder");
  }
  const std::string file = folder + "/targets.json";
  const json root = parse(file);
  if (!root.is_object() || !root.contains("targets") || !root["targets"].is_array() || root["targets"].empty()) {
    fail(file, "must have a list \"targets\" of at least one target");
  }
  std::vector<vpTargetListEntry> entries;
  for (const json &entry : root["targets"]) {
    const std::string place = "targets[" + std::to_string(entries.size()) + "]";
    if (!entry.is_object()) {
      fail(file, place + " is " + entry.dump() + ", must be an object");
    }
    for (const auto &item : entry.items()) {
      static const std::set<std::string> known = {"name", "image", "width_m", "height_m", "depth_m"};
      if (known.count(item.key()) == 0) {
        fail(file, "unknown field " + place + "." + item.key() + "; known are name, image, width_m, height_m, depth_m");
      }
    }
    if (!entry.contains("width_m")) {
      fail(file, place + ".width_m is missing");
    }
    vpTargetListEntry target{text(entry, "name", place, file), folder + "/" + text(entry, "image", place, file),
                             length(entry, "width_m", place, file), std::nullopt, 0.};
    if (entry.contains("height_m")) {
      target.height = length(entry, "height_m", place, file);
    }
    if (entry.contains("depth_m")) {
      target.depth = length(entry, "depth_m", place, file);
    }
    entries.push_back(target);
  }
  requireAllListed(folder, entries);
  return entries;
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
