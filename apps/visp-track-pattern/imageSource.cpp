/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "imageSource.h"

#include "sources.h"

#include "appMain.h"
#include "greyPicture.h"
#include "quietLibraries.h"
#include "vpFileText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace fs = std::filesystem;

namespace trackPattern
{
namespace
{
constexpr std::size_t CAMERA_FRAMES = 300;
constexpr std::size_t MOST_FAILURES = 2; // consecutive failures of a camera; each may last its time limit

std::size_t least(std::size_t there, std::size_t wanted) { return wanted == 0 ? there : std::min(there, wanted); }

std::array<char, 4> lettersOf(double code)
{
  const auto bits = static_cast<unsigned int>(static_cast<int>(code));
  return {static_cast<char>(bits & 255U), static_cast<char>(bits >> 8U & 255U), static_cast<char>(bits >> 16U & 255U),
          static_cast<char>(bits >> 24U & 255U)};
}

// FFmpeg's code of a pixel format, such as Y 1 0 16 or RGB 48: for values of more than 8 bits, a byte at one end is the
// number of bits per value, or per pixel.
unsigned int bitsOf(double pixelFormat)
{
  const std::array<char, 4> code = lettersOf(pixelFormat);
  const std::string letters(code.begin(), code.end());
  for (const char end : {code[3], code[0]}) {
    if (end >= 9 && end <= 16) {
      return static_cast<unsigned int>(end);
    }
  }
  for (const char *start : {"RGB", "BGR", "RBA", "BRA", "P01"}) {
    if (letters.compare(0, 3, start) == 0) {
      return 16;
    }
  }
  return 8;
}

// Without this OpenCV gives the upper 8 bits.
void askForAllBits(cv::VideoCapture &camera)
{
  const std::array<char, 4> code = lettersOf(camera.get(cv::CAP_PROP_FOURCC));
  if (code[0] == 'Y' && code[1] == '1' && code[3] == ' ') { // Y10, Y12, Y16
    camera.set(cv::CAP_PROP_CONVERT_RGB, 0.);
  }
}
} // namespace

VideoSource::VideoSource(std::unique_ptr<cv::VideoCapture> capture, std::string name, bool isCamera, std::size_t frames)
  : m_capture(std::move(capture)), m_name(std::move(name)), m_isCamera(isCamera),
    m_frames(isCamera && frames == 0 ? CAMERA_FRAMES : frames)
{
  if (m_isCamera) {
    askForAllBits(*m_capture);
    return;
  }
  const double promised = m_capture->get(cv::CAP_PROP_FRAME_COUNT);
  m_promised = promised > 0. && promised < 1e9 ? static_cast<std::size_t>(promised) : 0;
  m_bits = bitsOf(m_capture->get(cv::CAP_PROP_CODEC_PIXEL_FORMAT));
}

bool VideoSource::grab()
{
  const vpApp::QuietLibraries quiet;
  return m_capture->read(m_picture) && !m_picture.empty();
}

bool VideoSource::next(vpImage<unsigned char> &image)
{
  if (m_frames != 0 && m_read >= m_frames) {
    return false;
  }
  std::size_t failures = 0;
  while (!grab()) {
    if (!m_isCamera && m_read > 0) {
      m_short = m_read < least(m_promised, m_frames);
      return false;
    }
    if (!m_isCamera || failures == MOST_FAILURES) {
      throw std::runtime_error(
          m_name + (m_isCamera ? ": the camera gives no image" + (m_read > 0 ? " after " + std::to_string(m_read) : "")
                               : ": has no image that can be read"));
    }
    ++failures;
    if (vpApp::interrupted()) {
      return false;
    }
  }
  m_afterGap = failures > 0 && m_read > 0;
  m_failed += failures;
  vpApp::copyGrey(m_scale.toGrey(m_picture, 0, m_name), image);
  ++m_read;
  return true;
}

std::size_t VideoSource::count() const { return m_promised == 0 ? m_frames : least(m_promised, m_frames); }

std::vector<std::string> VideoSource::remarks() const
{
  std::vector<std::string> all;
  if (m_failed > 0) {
    all.push_back(
        "The camera failed to give an image " + std::to_string(m_failed) + (m_failed == 1 ? " time" : " times") +
        ". How far the product moved meanwhile is not known: no displacement is given there, and a new epoch begins.");
  }
  if (m_isCamera && !m_scale.remark().empty()) { // OpenCV converts the images of every video to colour
    all.push_back(m_scale.remark());
  }
  if (m_bits > 8) {
    all.push_back(
        "The video has " + std::to_string(m_bits) +
        " bits a value; its largest possible value became the grey "
        "value 255. If it uses a small part of that range, store its images as PNG or TIFF, of which all bits "
        "are read.");
  }
  if (m_short) {
    all.push_back("The video promises " + std::to_string(m_promised) + " images, only " + std::to_string(m_read) +
                  " could be read.");
  }
  return all;
}

std::unique_ptr<ImageSource> openVideo(const std::string &file, std::size_t frames)
{
  const vpApp::QuietLibraries quiet;
  auto capture = std::make_unique<cv::VideoCapture>();
  if (!capture->open(file)) {
    throw std::runtime_error(file + ": is not a video that can be read");
  }
  return std::make_unique<VideoSource>(std::move(capture), file, false, frames);
}

std::unique_ptr<ImageSource> openCamera(const std::string &device, std::size_t frames)
{
  const vpApp::QuietLibraries quiet;
  auto capture = std::make_unique<cv::VideoCapture>();
  if (!capture->open(std::stoi(device.substr(10)), cv::CAP_V4L2)) {
    throw std::runtime_error(device + ": the camera cannot be opened");
  }
  return std::make_unique<VideoSource>(std::move(capture), device, true, frames);
}

namespace
{
constexpr std::size_t OWN_FRAMES = 200;

/*!
 * The display of the thesis, slightly rotated, flexible and with the noise of the thesis's camera. It moves back and
 * forth along its rows and slightly across.
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
  // Output of visp-generate-pattern, given by either of its two folders.
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
  std::vector<fs::path> hidden;
  std::vector<fs::path> files = imagesOfFolder(images, hidden);
  if (files.empty()) {
    throw std::runtime_error(given.string() + ": the folder holds no images (png, pgm, ppm, bmp, jpg, tif, webp)");
  }
  auto source = std::make_unique<FileSource>(std::move(files), "the folder " + given.string(), frames,
                                             top.empty() ? nullptr : std::make_unique<TruthFiles>(top));
  source->leaveOut(hidden, "begins with a dot, as companion files do that are no images");
  return source;
}
} // namespace

std::unique_ptr<ImageSource> makeSource(const Options &options)
{
  if (!options.camera.empty()) {
    return openCamera(options.camera, options.frames);
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
    if (fs::status(first, ignored).type() == fs::file_type::not_found) {
      throw std::runtime_error(first + ": there is no such file or folder");
    }
    if (!vpPictures::isImageName(first)) {
      static_cast<void>(vpOpenFile(first)); // of a pipe or a device FFmpeg might wait for ever
      return openVideo(first, options.frames);
    }
  }
  std::vector<fs::path> files;
  for (const std::string &file : options.inputs) {
    static_cast<void>(vpOpenFile(file));
    files.emplace_back(file);
  }
  const std::string description =
      files.size() == 1 ? "the image " + first : std::to_string(files.size()) + " images from " + first + " on";
  return std::make_unique<FileSource>(std::move(files), description, options.frames, nullptr);
}
} // namespace trackPattern
