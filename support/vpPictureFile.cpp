/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPictureFile.h"

#include "vpFileText.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

namespace vpPictures
{
namespace
{
constexpr std::size_t MOST_PAGES = 1000000;
constexpr const char *UNREADABLE = ": is not an image that can be read, or is cut short";

// Reads integers at any position of a file; reading beyond its end makes bad() true.
class Numbers
{
public:
  explicit Numbers(std::istream &stream) : m_stream(stream) {}
  void setLittleEndian(bool little) { m_little = little; }
  [[nodiscard]] bool bad() const { return m_bad; }

  std::uint64_t at(std::uint64_t place, unsigned int bytes)
  {
    std::array<char, 8> raw{};
    m_stream.clear();
    m_stream.seekg(static_cast<std::streamoff>(place & 0x7fffffffffffffffULL));
    m_stream.read(raw.data(), bytes);
    m_bad = m_bad || !m_stream;
    std::uint64_t value = 0;
    for (unsigned int i = 0; i < bytes; ++i) {
      const unsigned int shift = 8 * (m_little ? i : bytes - 1 - i);
      value |= static_cast<std::uint64_t>(static_cast<unsigned char>(raw[i])) << shift;
    }
    return value;
  }

private:
  std::istream &m_stream;
  bool m_little = true;
  bool m_bad = false;
};

struct TiffPages {
  bool isTiff = false, big = false, little = true, cut = false;
  std::vector<std::uint64_t> directories;
};

// Bits of the tag NewSubfileType (254): 1 reduced copy of another page, 4 mask.
bool isWholePage(Numbers &file, std::uint64_t entries, std::uint64_t count, bool big)
{
  for (std::uint64_t i = 0; i < count && !file.bad(); ++i) {
    const std::uint64_t entry = entries + i * (big ? 20 : 12);
    if (file.at(entry, 2) == 254) {
      return (file.at(entry + (big ? 12 : 8), 4) & 5U) == 0;
    }
  }
  return true;
}

// TIFF 6.0 and BigTIFF: a chain of directories, one per page.
TiffPages tiffPages(std::istream &stream)
{
  TiffPages result;
  Numbers file(stream);
  const std::uint64_t order = file.at(0, 2);
  result.little = order == 0x4949;
  file.setLittleEndian(result.little);
  const std::uint64_t version = file.at(2, 2);
  result.isTiff = !file.bad() && (order == 0x4949 || order == 0x4d4d) && (version == 42 || version == 43);
  if (!result.isTiff) {
    return result;
  }
  result.big = version == 43;
  std::set<std::uint64_t> seen;
  std::uint64_t next = result.big ? file.at(8, 8) : file.at(4, 4);
  while (next != 0 && !file.bad() && seen.size() < MOST_PAGES && seen.insert(next).second) {
    const std::uint64_t count = file.at(next, result.big ? 8 : 2);
    const std::uint64_t entries = next + (result.big ? 8 : 2);
    const std::uint64_t end = entries + count * (result.big ? 20 : 12);
    if (count > 4096) { // implausible number of entries: the chain is invalid
      result.cut = true;
      break;
    }
    const bool whole = isWholePage(file, entries, count, result.big);
    const std::uint64_t following = file.at(end, result.big ? 8 : 4);
    if (!file.bad() && whole) {
      result.directories.push_back(next);
    }
    next = following;
  }
  result.cut = result.cut || file.bad();
  return result;
}

// The largest value of a PGM or PPM file; 0 for any other.
unsigned int whiteOf(std::istream &stream)
{
  stream.clear();
  stream.seekg(0);
  char p = 0, kind = 0;
  stream.get(p).get(kind);
  if (p != 'P' || (kind != '2' && kind != '3' && kind != '5' && kind != '6')) {
    return 0;
  }
  unsigned int value = 0;
  for (int field = 0; field < 3; ++field) { // width, height, largest value; comments anywhere between
    while (stream && (std::isspace(stream.peek()) != 0 || stream.peek() == '#')) {
      if (stream.get() == '#') {
        stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
      }
    }
    if (!(stream >> value)) {
      return 0;
    }
  }
  return value <= 65535 ? value : 0;
}

// libjpeg fills missing data with only a warning; check the end marker, but not that of a thumbnail in the EXIF data.
bool isCutJpeg(const std::string &content)
{
  if (content.compare(0, 2, "\xff\xd8") != 0) {
    return false;
  }
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(content[i])); };
  std::size_t place = 2;
  while (place + 4 <= content.size() && byte(place) == 0xff && byte(place + 1) != 0xda) {
    place += 2 + (byte(place + 2) << 8) + byte(place + 3);
  }
  const std::size_t end = content.rfind("\xff\xd9");
  return end == std::string::npos || end < place;
}

unsigned int whiteOfBits(unsigned int bits) { return (1U << bits) - 1U; }
} // namespace

bool isImageName(const std::string &file)
{
  static const std::array<const char *, 10> known = {".png", ".pgm",  ".ppm", ".pnm",  ".bmp",
                                                     ".jpg", ".jpeg", ".tif", ".tiff", ".webp"};
  const std::size_t dot = file.find_last_of("./\\");
  std::string extension = dot == std::string::npos ? "" : file.substr(dot);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(known.begin(), known.end(), extension) != known.end();
}

File::File(std::string name) : m_name(std::move(name))
{
  std::ifstream stream = vpOpenFile(m_name);
  if (stream.peek(), stream.bad()) {
    throw std::runtime_error(m_name + ": cannot be read");
  }
  const TiffPages tiff = tiffPages(stream);
  if (tiff.isTiff && tiff.directories.empty()) {
    throw std::runtime_error(m_name + UNREADABLE);
  }
  m_pages = tiff.directories;
  m_bigTiff = tiff.big;
  m_littleEndian = tiff.little;
  m_cut = tiff.isTiff && tiff.cut;
  m_white = tiff.isTiff ? 0 : whiteOf(stream);
}

std::string File::nameOf(std::size_t page) const
{
  return pages() == 1 ? m_name : "page " + std::to_string(page + 1) + " of " + m_name;
}

void File::load()
{
  if (!m_content.empty()) {
    return;
  }
  std::ifstream stream = vpOpenFile(m_name);
  stream.seekg(0, std::ios::end);
  const std::streamoff size = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
  if (size > std::numeric_limits<int>::max()) {
    throw std::runtime_error(m_name + ": has " + std::to_string(size >> 20) +
                             " MB, must have less than 2048; split it into several files");
  }
  if (size > 0) {
    m_content.resize(static_cast<std::size_t>(size));
    stream.seekg(0);
    stream.read(m_content.data(), size);
  }
  if (size < 0 || !stream) {
    m_content.clear();
    throw std::runtime_error(m_name + ": cannot be read");
  }
}

cv::Mat File::read(std::size_t page)
{
  load();
  if (m_content.empty() || isCutJpeg(m_content)) {
    throw std::runtime_error(nameOf(page) + UNREADABLE);
  }
  if (!m_pages.empty()) {
    // OpenCV reads the first page: make the requested page the first one.
    const unsigned int bytes = m_bigTiff ? 8 : 4;
    for (unsigned int i = 0; i < bytes; ++i) {
      const unsigned int shift = 8 * (m_littleEndian ? i : bytes - 1 - i);
      m_content[(m_bigTiff ? 8 : 4) + i] = static_cast<char>(m_pages.at(page) >> shift & 255U);
    }
  }
  cv::Mat picture;
  try {
    const cv::Mat bytes(1, static_cast<int>(m_content.size()), CV_8UC1, m_content.data());
    picture = cv::imdecode(bytes, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
  }
  catch (const cv::Exception &) { // equivalent to an empty image
    picture.release();
  }
  if (picture.empty()) {
    throw std::runtime_error(nameOf(page) + UNREADABLE);
  }
  return picture;
}

cv::Mat GreyScale::toGrey(const cv::Mat &picture, unsigned int white, const std::string &name)
{
  if (picture.depth() != CV_8U && picture.depth() != CV_16U) {
    const bool real = picture.depth() == CV_32F || picture.depth() == CV_64F;
    throw std::runtime_error(name + ": has " + (real ? "real" : "signed") + " values of " +
                             std::to_string(8 * picture.elemSize1()) +
                             " bits, must have 8 or 16 bits without sign; make it so first, for example with \"convert "
                             "in.tif -auto-level -depth 16 out.png\"");
  }
  cv::Mat grey = picture;
  switch (picture.channels()) {
  case 1:
    break;
  case 3:
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    break;
  case 4:
    cv::cvtColor(picture, grey, cv::COLOR_BGRA2GRAY);
    break;
  default:
    throw std::runtime_error(name + ": has " + std::to_string(picture.channels()) +
                             " values a pixel, must be grey or colour");
  }
  m_colour = m_colour || picture.channels() > 1;
  if (grey.depth() == CV_8U && (white == 0 || white == 255)) {
    return grey;
  }
  if (white == 0) {
    double largest = 0.;
    cv::minMaxLoc(grey, nullptr, &largest);
    unsigned int bits = 8;
    while (whiteOfBits(bits) < largest) {
      ++bits;
    }
    white = std::max(m_white, whiteOfBits(bits));
  }
  m_bits = static_cast<unsigned int>(8 * grey.elemSize1());
  if (m_white != 0 && white > m_white) {
    m_widenedAt = name;
  }
  m_firstWhite = m_firstWhite == 0 ? white : m_firstWhite;
  m_white = white;
  cv::Mat scaled;
  grey.convertTo(scaled, CV_8U, 255. / white);
  return scaled;
}

std::string GreyScale::remark() const
{
  const std::string colour = m_colour ? "The images are in colour; they were made grey." : "", depth = depthRemark();
  return colour + (colour.empty() || depth.empty() ? "" : " ") + depth;
}

std::string GreyScale::depthRemark() const
{
  std::string text;
  if (m_white != 0) {
    text = "The images have " + std::to_string(m_bits) + " bits a value; the values 0 to " +
           std::to_string(m_firstWhite) + " became the grey values 0 to 255";
    if (!m_widenedAt.empty()) {
      text += ", and from " + m_widenedAt + " on, which has larger ones, the values 0 to " + std::to_string(m_white);
    }
    text += ".";
  }
  return text;
}

cv::Mat readGreyPicture(const std::string &file, GreyScale &scale)
{
  File pictures(file);
  if (pictures.pages() > 1) {
    throw std::runtime_error(file + ": has " + std::to_string(pictures.pages()) + " pages, must have one");
  }
  return scale.toGrey(pictures.read(0), pictures.white(), file);
}
} // namespace vpPictures
