/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "videoSource.h"

#include "appMain.h"
#include "greyPicture.h"
#include "quietLibraries.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <unistd.h>

namespace vpApp
{
namespace
{
constexpr double LARGEST_LATENCY = 2.;   // s; an older time stamp is that of another clock
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

// Name of a codec that predicts an image from others and leaves out what it takes for noise; empty: none of these.
std::string predictingCodec(double fourcc)
{
  struct Codec {
    const char *letters, *name;
  };
  static constexpr Codec codecs[] = {{"avc", "h264"},   {"264", "h264"},   {"hev", "hevc"},   {"hvc", "hevc"},
                                     {"265", "hevc"},   {"mp4v", "mpeg4"}, {"fmp4", "mpeg4"}, {"xvid", "mpeg4"},
                                     {"divx", "mpeg4"}, {"vp8", "vp8"},    {"vp08", "vp8"},   {"vp9", "vp9"},
                                     {"vp09", "vp9"},   {"av01", "av1"},   {"mpg", "mpeg"}};
  const std::array<char, 4> code = lettersOf(fourcc);
  std::string letters(code.begin(), code.end());
  std::transform(letters.begin(), letters.end(), letters.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Codec &codec : codecs) {
    if (letters.find(codec.letters) != std::string::npos) {
      return codec.name;
    }
  }
  return "";
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
  : m_capture(std::move(capture)), m_name(std::move(name)), m_isCamera(isCamera), m_frames(frames)
{
  if (m_isCamera) {
    askForAllBits(*m_capture);
    return;
  }
  const double promised = m_capture->get(cv::CAP_PROP_FRAME_COUNT);
  m_promised = promised > 0. && promised < 1e9 ? static_cast<std::size_t>(promised) : 0;
  m_bits = bitsOf(m_capture->get(cv::CAP_PROP_CODEC_PIXEL_FORMAT));
  m_codec = predictingCodec(m_capture->get(cv::CAP_PROP_FOURCC));
}

bool VideoSource::grab()
{
  const QuietLibraries quiet;
  return m_capture->read(m_picture) && !m_picture.empty();
}

void VideoSource::readTime()
{
  m_time = 1e-3 * m_capture->get(cv::CAP_PROP_POS_MSEC);
  if (m_isCamera) {
    const double arrival = now();
    m_stamped = m_time > arrival - LARGEST_LATENCY && m_time <= arrival;
    m_time = m_stamped ? m_time : arrival;
  }
}

std::string VideoSource::clock() const
{
  return !m_isCamera ? "times of the video" : m_stamped ? "time stamps of the driver" : "times of arrival";
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
    if (interrupted()) {
      return false;
    }
  }
  m_afterGap = failures > 0 && m_read > 0;
  m_failed += failures;
  readTime();
  copyGrey(m_scale.toGrey(m_picture, 0, m_name), image);
  ++m_read;
  return true;
}

std::size_t VideoSource::count() const { return m_promised == 0 ? m_frames : least(m_promised, m_frames); }

std::vector<std::string> VideoSource::remarks() const
{
  std::vector<std::string> all;
  if (m_failed > 0) {
    all.push_back("The camera failed to give an image " + std::to_string(m_failed) +
                  (m_failed == 1 ? " time." : " times."));
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
  if (!m_codec.empty()) {
    all.push_back(m_name + " is compressed between images (" + m_codec +
                  "): deviations do not include the errors of compression. Record without loss, as PNG or FFV1.");
  }
  if (m_short) {
    all.push_back("The video promises " + std::to_string(m_promised) + " images, only " + std::to_string(m_read) +
                  " could be read.");
  }
  return all;
}

std::unique_ptr<ImageSource> openVideo(const std::string &file, std::size_t frames)
{
  const QuietLibraries quiet;
  auto capture = std::make_unique<cv::VideoCapture>();
  if (!capture->open(file)) {
    throw std::runtime_error(file + ": is not a video that can be read");
  }
  return std::make_unique<VideoSource>(std::move(capture), file, false, frames);
}

std::unique_ptr<ImageSource> openCamera(const std::string &device, std::size_t frames)
{
  const QuietLibraries quiet;
  auto capture = std::make_unique<cv::VideoCapture>();
  if (!capture->open(std::stoi(device.substr(10)), cv::CAP_V4L2)) {
    const bool isThere = ::access(device.c_str(), R_OK | W_OK) == 0;
    throw std::runtime_error(device + ": the camera cannot be opened (" +
                             (isThere ? "it is in use, or gives no images" : std::strerror(errno)) + ")");
  }
  return std::make_unique<VideoSource>(std::move(capture), device, true, frames);
}
} // namespace vpApp
