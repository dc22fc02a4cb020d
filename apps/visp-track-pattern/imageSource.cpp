/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "imageSource.h"
#include "imageFile.h"
#include "quietLibraries.h"

#include <opencv2/videoio.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace fs = std::filesystem;

namespace trackPattern
{
namespace
{
constexpr std::size_t OWN_FRAMES = 200;
constexpr std::size_t CAMERA_FRAMES = 300;
constexpr const char *COLOUR = "The images are in colour; they were made grey.";

std::size_t least(std::size_t there, std::size_t wanted) { return wanted == 0 ? there : std::min(there, wanted); }

// Compares runs of digits as numbers.
bool naturalLess(const std::string &a, const std::string &b)
{
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      std::size_t endA = i, endB = j;
      while (endA < a.size() && digit(a[endA])) {
        ++endA;
      }
      while (endB < b.size() && digit(b[endB])) {
        ++endB;
      }
      std::string numberA = a.substr(i, endA - i), numberB = b.substr(j, endB - j);
      numberA.erase(0, std::min(numberA.find_first_not_of('0'), numberA.size()));
      numberB.erase(0, std::min(numberB.find_first_not_of('0'), numberB.size()));
      if (numberA != numberB) {
        return numberA.size() != numberB.size() ? numberA.size() < numberB.size() : numberA < numberB;
      }
      i = endA;
      j = endB;
    }
    else if (a[i] != b[j]) {
      return a[i] < b[j];
    }
    else {
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

// The last run of digits in the name; the position in the list when there is none.
unsigned int numberOf(const fs::path &file, std::size_t position)
{
  const std::string stem = file.stem().string();
  const std::size_t end = stem.find_last_of("0123456789");
  if (end == std::string::npos) {
    return static_cast<unsigned int>(position);
  }
  const std::size_t before = stem.find_last_not_of("0123456789", end);
  const std::string digits = stem.substr(before + 1, end - before);
  return digits.size() <= 9 ? static_cast<unsigned int>(std::stoul(digits)) : static_cast<unsigned int>(position);
}

class FileSource : public ImageSource
{
public:
  FileSource(std::vector<fs::path> files, std::string description, std::size_t frames,
             std::unique_ptr<TruthFiles> truth)
    : m_files(std::move(files)), m_description(std::move(description)), m_truth(std::move(truth))
  {
    m_files.resize(least(m_files.size(), frames));
  }
  bool next(vpImage<unsigned char> &image) override
  {
    if (m_next >= m_files.size()) {
      return false;
    }
    m_colour = readGreyImage(m_files[m_next], image) || m_colour;
    ++m_next;
    return true;
  }
  [[nodiscard]] std::string name() const override { return m_files[m_next - 1].string(); }
  [[nodiscard]] unsigned int number() const override { return numberOf(m_files[m_next - 1], m_next - 1); }
  [[nodiscard]] std::optional<FrameTruth> truth() const override
  {
    return m_truth ? m_truth->at(number()) : std::nullopt;
  }
  [[nodiscard]] std::size_t count() const override { return m_files.size(); }
  [[nodiscard]] std::string description() const override { return m_description; }
  [[nodiscard]] std::string remark() const override { return m_colour ? COLOUR : ""; }

private:
  std::vector<fs::path> m_files;
  std::string m_description;
  std::unique_ptr<TruthFiles> m_truth;
  std::size_t m_next = 0;
  bool m_colour = false;
};

class VideoSource : public ImageSource
{
public:
  //! \param device : /dev/videoN instead of a file.
  VideoSource(std::string file, bool device, std::size_t frames)
    : m_file(std::move(file)), m_device(device), m_frames(device && frames == 0 ? CAMERA_FRAMES : frames)
  {
    const QuietLibraries quiet;
    const bool open = m_device ? m_capture.open(std::stoi(m_file.substr(10)), cv::CAP_V4L2) : m_capture.open(m_file);
    if (!open) {
      throw std::runtime_error(m_file +
                               (m_device ? ": the camera cannot be opened" : ": is not a video that can be read"));
    }
    const double promised = m_device ? 0. : m_capture.get(cv::CAP_PROP_FRAME_COUNT);
    m_promised = promised > 0. && promised < 1e9 ? static_cast<std::size_t>(promised) : 0;
  }
  bool next(vpImage<unsigned char> &image) override
  {
    if (m_frames != 0 && m_read >= m_frames) {
      return false;
    }
    const QuietLibraries quiet;
    if (!m_capture.read(m_picture) || m_picture.empty()) {
      if (m_read == 0 || m_device) {
        throw std::runtime_error(m_file +
                                 (m_device ? ": the camera gives no image" : ": has no image that can be read"));
      }
      m_short = m_read < least(m_promised, m_frames);
      return false;
    }
    m_colour = makeGrey(m_picture, m_file, image) || m_colour;
    ++m_read;
    return true;
  }
  [[nodiscard]] std::string name() const override { return "image " + std::to_string(number()) + " of " + m_file; }
  [[nodiscard]] unsigned int number() const override { return static_cast<unsigned int>(m_read - 1); }
  [[nodiscard]] std::size_t count() const override { return m_promised == 0 ? m_frames : least(m_promised, m_frames); }
  [[nodiscard]] std::string description() const override { return (m_device ? "the camera " : "the video ") + m_file; }
  [[nodiscard]] std::string remark() const override
  {
    std::string text = m_colour && m_device ? COLOUR : "";
    if (m_short) {
      text += std::string(text.empty() ? "" : " ") + "The video promises " + std::to_string(m_promised) +
              " images, only " + std::to_string(m_read) + " could be read.";
    }
    return text;
  }

private:
  std::string m_file;
  bool m_device;
  std::size_t m_frames;
  std::size_t m_promised = 0;
  std::size_t m_read = 0;
  bool m_colour = false;
  bool m_short = false;
  cv::VideoCapture m_capture;
  cv::Mat m_picture;
};

/*!
 * The display of the thesis, a little turned, flexible and with the noise of the thesis's camera. It moves forth and
 * back along its rows and a little across.
 */
class OwnSource : public ImageSource
{
public:
  OwnSource(unsigned int seed, std::size_t frames)
    : m_product(specOf(seed)), m_frames(frames == 0 ? OWN_FRAMES : frames)
  {}
  bool next(vpImage<unsigned char> &image) override
  {
    if (m_next >= m_frames) {
      return false;
    }
    const double k = static_cast<double>(m_next);
    m_x = place(k, 0);
    m_y = place(k, 1);
    m_product.render(m_x, m_y, 0.5 * (place(k + 1., 0) - place(k - 1., 0)), 0.5 * (place(k + 1., 1) - place(k - 1., 1)),
                     static_cast<unsigned int>(m_next), image);
    ++m_next;
    return true;
  }
  [[nodiscard]] std::string name() const override { return "image " + std::to_string(number()); }
  [[nodiscard]] unsigned int number() const override { return static_cast<unsigned int>(m_next - 1); }
  [[nodiscard]] std::optional<FrameTruth> truth() const override
  {
    return FrameTruth{m_product.cells(m_x, m_y), m_x, m_y};
  }
  [[nodiscard]] std::size_t count() const override { return m_frames; }
  [[nodiscard]] std::string description() const override { return "its own sequence"; }

private:
  static vpProductPatternSpec specOf(unsigned int seed)
  {
    vpProductPatternSpec spec;
    spec.noise = 4.;
    spec.jitter = 0.3;
    spec.rotation = 0.01;
    spec.illuminationX = 0.1;
    spec.seed = seed;
    return spec;
  }
  static double place(double k, int axis)
  {
    return axis == 0 ? 4. * k + 25. * std::sin(2. * M_PI * k / 60.) : 3. * std::sin(2. * M_PI * k / 85.);
  }

  vpProductPattern m_product;
  std::size_t m_frames;
  std::size_t m_next = 0;
  double m_x = 0.;
  double m_y = 0.;
};

std::unique_ptr<ImageSource> makeFolderSource(const fs::path &given, std::size_t frames)
{
  // What visp-generate-pattern wrote, whichever of its two folders is given.
  const fs::path whole = given.filename().empty() ? given.parent_path() : given;
  fs::path images = given, top = whole;
  std::error_code ignored;
  if (TruthFiles::areIn(top) && fs::is_directory(top / "frames", ignored)) {
    images = top / "frames";
  }
  else if (whole.filename() == "frames" && TruthFiles::areIn(fs::absolute(whole).parent_path())) {
    top = fs::absolute(whole).parent_path();
  }
  else {
    top.clear();
  }
  std::vector<fs::path> files = imagesOfFolder(images);
  if (files.empty()) {
    throw std::runtime_error(given.string() + ": the folder holds no images (png, pgm, ppm, bmp, jpg, tif, webp)");
  }
  return std::make_unique<FileSource>(std::move(files), "the folder " + given.string(), frames,
                                      top.empty() ? nullptr : std::make_unique<TruthFiles>(top));
}
} // namespace

std::vector<fs::path> imagesOfFolder(const fs::path &folder)
{
  std::vector<fs::path> files;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && isImageName(entry.path())) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path &a, const fs::path &b) { return naturalLess(a.string(), b.string()); });
  return files;
}

std::vector<fs::path> filesOfPattern(const std::string &pattern)
{
  const fs::path path(pattern);
  const std::string name = path.filename().string();
  const std::size_t percent = name.find('%');
  const std::size_t end = name.find_first_not_of("0123456789", percent + 1);
  if (percent == std::string::npos || end == std::string::npos || name[end] != 'd' ||
      name.find('%', end) != std::string::npos || path.parent_path().string().find('%') != std::string::npos) {
    throw std::runtime_error(pattern + ": is no pattern; it must have one %d or %04d in the file's name");
  }
  const std::string digits = name.substr(percent + 1, end - percent - 1);
  const std::size_t width = digits.empty() || digits.size() > 4 ? 0 : std::stoul(digits);
  const std::string start = name.substr(0, percent), rest = name.substr(end + 1);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  std::vector<fs::path> files;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (file.size() <= start.size() + rest.size() || file.compare(0, start.size(), start) != 0 ||
        file.compare(file.size() - rest.size(), rest.size(), rest) != 0) {
      continue;
    }
    const std::string number = file.substr(start.size(), file.size() - start.size() - rest.size());
    if (number.find_first_not_of("0123456789") == std::string::npos && number.size() >= width) {
      files.push_back(path.has_parent_path() ? entry.path() : entry.path().filename());
    }
  }
  if (error || files.empty()) {
    throw std::runtime_error(pattern + ": no file has such a name");
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path &a, const fs::path &b) { return naturalLess(a.string(), b.string()); });
  return files;
}

std::unique_ptr<ImageSource> makeSource(const Options &options)
{
  if (!options.camera.empty()) {
    return std::make_unique<VideoSource>(options.camera, true, options.frames);
  }
  if (options.inputs.empty()) {
    return std::make_unique<OwnSource>(options.seed, options.frames);
  }
  const std::string &first = options.inputs[0];
  std::error_code ignored;
  if (options.inputs.size() == 1) {
    if (fs::is_directory(first, ignored)) {
      return makeFolderSource(first, options.frames);
    }
    if (first.find('%') != std::string::npos && !fs::exists(first, ignored)) {
      return std::make_unique<FileSource>(filesOfPattern(first), "the images " + first, options.frames, nullptr);
    }
    if (!fs::exists(first, ignored)) {
      throw std::runtime_error(first + ": there is no such file or folder");
    }
    if (!isImageName(first)) {
      return std::make_unique<VideoSource>(first, false, options.frames);
    }
  }
  std::vector<fs::path> files;
  for (const std::string &file : options.inputs) {
    if (!fs::is_regular_file(file, ignored)) {
      throw std::runtime_error(file + ": there is no such file");
    }
    files.emplace_back(file);
  }
  const std::string description =
      files.size() == 1 ? "the image " + first : std::to_string(files.size()) + " images from " + first + " on";
  return std::make_unique<FileSource>(std::move(files), description, options.frames, nullptr);
}
} // namespace trackPattern
