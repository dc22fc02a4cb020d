/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "imageSource.h"
#include "fileSource.h"
#include "videoSource.h"

#include "vpFileText.h"

#include <cmath>
#include <stdexcept>

namespace fs = std::filesystem;

namespace trackPattern
{
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
