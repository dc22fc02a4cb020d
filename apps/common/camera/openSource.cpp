/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "fileSource.h"

#include "vpFileText.h"

#include <chrono>
#include <stdexcept>

namespace fs = std::filesystem;

namespace vpApp
{
namespace
{
std::unique_ptr<ImageSource> openFolder(const std::string &folder, std::size_t frames)
{
  std::vector<fs::path> hidden;
  std::vector<fs::path> files = imagesOfFolder(folder, hidden);
  if (files.empty()) {
    throw std::runtime_error(folder + ": the folder holds no images (png, pgm, ppm, bmp, jpg, tif, webp)");
  }
  auto source = std::make_unique<FileSource>(std::move(files), "the folder " + folder, frames);
  source->leaveOut(hidden, "begins with a dot, as companion files do that are no images");
  return source;
}
} // namespace

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string cameraDevice(const std::string &text)
{
  const std::string prefix = "/dev/video";
  const std::string number = text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text;
  const bool digits =
      !number.empty() && number.size() <= 4 && number.find_first_not_of("0123456789") == std::string::npos;
  return digits ? prefix + number : "";
}

std::unique_ptr<ImageSource> openImages(const std::vector<std::string> &inputs, std::size_t frames)
{
  const std::string &first = inputs.at(0);
  std::error_code ignored;
  if (inputs.size() == 1) {
    if (fs::is_directory(first, ignored)) {
      return openFolder(first, frames);
    }
    if (first.find('%') != std::string::npos && !fs::exists(first, ignored)) {
      return std::make_unique<FileSource>(filesOfPattern(first), "the images " + first, frames);
    }
    if (fs::status(first, ignored).type() == fs::file_type::not_found) {
      throw std::runtime_error(first + ": there is no such file or folder");
    }
    if (!vpPictures::isImageName(first)) {
      static_cast<void>(vpOpenFile(first)); // of a pipe or a device FFmpeg might wait for ever
      return openVideo(first, frames);
    }
  }
  std::vector<fs::path> files;
  for (const std::string &file : inputs) {
    static_cast<void>(vpOpenFile(file));
    files.emplace_back(file);
  }
  const std::string description =
      files.size() == 1 ? "the image " + first : std::to_string(files.size()) + " images from " + first + " on";
  return std::make_unique<FileSource>(std::move(files), description, frames);
}
} // namespace vpApp
