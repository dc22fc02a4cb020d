/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "input.h"

#include <visp3/rendering/vpProductPattern.h>

#include <cmath>
#include <filesystem>
#include <utility>

namespace fs = std::filesystem;

namespace trackPattern
{
namespace
{
constexpr std::size_t CAMERA_FRAMES = 300;
constexpr std::size_t OWN_FRAMES = 200;

/*!
 * The display of the thesis, slightly rotated, flexible and with the noise of the thesis's camera. It moves back and
 * forth along its rows and slightly across.
 */
class OwnSource : public vpApp::ImageSource
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
  [[nodiscard]] std::optional<FrameTruth> truth() const { return FrameTruth{m_product.cells(m_x, m_y), m_x, m_y}; }
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

//! The folder of images and that of the truth, of the output of visp-generate-pattern, given by either; else the folder itself and "".
std::pair<fs::path, fs::path> foldersOf(const fs::path &given)
{
  const fs::path whole = given.filename().empty() ? given.parent_path() : given;
  std::error_code ignored;
  if (TruthFiles::areIn(whole) && fs::is_directory(whole / "frames", ignored)) {
    return {whole / "frames", whole};
  }
  const fs::path above = fs::absolute(whole).parent_path();
  return {given, whole.filename() == "frames" && TruthFiles::areIn(above) ? above : fs::path()};
}
} // namespace

Input openInput(const Options &options)
{
  const auto none = [] { return std::optional<FrameTruth>(); };
  if (!options.camera.empty()) {
    return {vpApp::openCamera(options.camera, options.frames == 0 ? CAMERA_FRAMES : options.frames), none};
  }
  if (options.inputs.empty()) {
    auto own = std::make_unique<OwnSource>(options.seed, options.frames);
    const OwnSource *sequence = own.get();
    return {std::move(own), [sequence] { return sequence->truth(); }};
  }
  std::vector<std::string> inputs = options.inputs;
  std::error_code ignored;
  const auto [images, top] = inputs.size() == 1 && fs::is_directory(inputs[0], ignored)
                                 ? foldersOf(inputs[0])
                                 : std::pair<fs::path, fs::path>();
  if (top.empty()) {
    return {vpApp::openImages(inputs, options.frames), none};
  }
  Input input{vpApp::openImages({images.string()}, options.frames), {}};
  input.truth = [source = input.images.get(), files = std::make_shared<TruthFiles>(top)] {
    return files->at(source->number());
  };
  return input;
}
} // namespace trackPattern
