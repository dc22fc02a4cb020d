/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "imageFile.h"
#include "quietLibraries.h"

#include "outputFolder.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <vector>

namespace trackPattern
{
namespace
{
std::string extensionOf(const std::filesystem::path &file)
{
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

// libjpeg fills up what is missing and only warns; the end of the file tells.
bool isCutShort(const std::string &content)
{
  const bool isJpeg = content.compare(0, 2, "\xff\xd8") == 0;
  return isJpeg && content.rfind("\xff\xd9") == std::string::npos;
}
} // namespace

bool isImageName(const std::filesystem::path &file)
{
  static const std::array<const char *, 10> known = {".png", ".pgm",  ".ppm", ".pnm",  ".bmp",
                                                     ".jpg", ".jpeg", ".tif", ".tiff", ".webp"};
  const std::string extension = extensionOf(file);
  return std::find(known.begin(), known.end(), extension) != known.end();
}

bool makeGrey(const cv::Mat &picture, const std::string &name, vpImage<unsigned char> &grey)
{
  if (picture.depth() != CV_8U) {
    const std::string bits = std::to_string(8 * picture.elemSize1());
    throw std::runtime_error(name + ": has " + bits +
                             " bits a value, must have 8; make it so first, for example with "
                             "\"convert in.png -auto-level -depth 8 out.png\"");
  }
  grey.resize(static_cast<unsigned int>(picture.rows), static_cast<unsigned int>(picture.cols));
  cv::Mat target(picture.rows, picture.cols, CV_8UC1, grey.bitmap);
  switch (picture.channels()) {
  case 1:
    picture.copyTo(target);
    return false;
  case 3:
    cv::cvtColor(picture, target, cv::COLOR_BGR2GRAY);
    return true;
  case 4:
    cv::cvtColor(picture, target, cv::COLOR_BGRA2GRAY);
    return true;
  default:
    throw std::runtime_error(name + ": has " + std::to_string(picture.channels()) +
                             " values a pixel, must be grey or colour");
  }
}

bool readGreyImage(const std::filesystem::path &file, vpImage<unsigned char> &grey)
{
  const std::string content = vpApp::readFile(file);
  cv::Mat picture;
  if (!content.empty() && !isCutShort(content)) {
    const QuietLibraries quiet;
    const std::vector<unsigned char> bytes(content.begin(), content.end());
    try {
      picture = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    }
    catch (const cv::Exception &) { // says the same as an empty picture
      picture.release();
    }
  }
  if (picture.empty()) {
    throw std::runtime_error(file.string() + ": is not an image that can be read, or is cut short");
  }
  return makeGrey(picture, file.string(), grey);
}
} // namespace trackPattern
