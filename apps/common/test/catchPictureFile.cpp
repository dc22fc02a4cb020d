/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The rule for reading image files: depth, pages, orientation, and rejected files.
#include "vpCatch.h"

#include "greyPicture.h"
#include "outputFolder.h"
#include "quietLibraries.h"
#include "testFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <cmath>

namespace
{
namespace fs = std::filesystem;
using vpApp::readGreyPicture;
using vpPictures::GreyScale;

cv::Mat read(const std::string &file)
{
  GreyScale scale;
  return readGreyPicture(file, scale);
}

bool same(const cv::Mat &a, const cv::Mat &b)
{
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0.;
}

//! White at the top left corner of a black ground.
cv::Mat marked()
{
  cv::Mat picture = cv::Mat::zeros(16, 32, CV_8UC1);
  picture(cv::Rect(0, 0, 8, 8)) = 255;
  return picture;
}

//! Position of the mark: 0 top left, 1 top right, 2 bottom right, 3 bottom left.
int cornerOf(const cv::Mat &picture)
{
  const int right = picture.cols - 3, bottom = picture.rows - 3;
  const cv::Point corners[] = {{2, 2}, {right, 2}, {right, bottom}, {2, bottom}};
  for (int i = 0; i < 4; ++i) {
    if (picture.at<unsigned char>(corners[i]) > 128) {
      return i;
    }
  }
  return -1;
}

std::string bytesOf(const std::string &file) { return vpApp::readFile(file); }

//! EXIF data of a JPEG file with only the orientation.
std::string withOrientation(const std::string &jpeg, int orientation)
{
  const std::string tiff = std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18) +
                           static_cast<char>(orientation) + std::string(7, '\0');
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  return jpeg.substr(0, 2) + "\xff\xe1" + '\0' + static_cast<char>(exif.size() + 2) + exif + jpeg.substr(2);
}

//! A TIFF file, 8 bit grey, with pages of one grey value each; other byte order if \e big.
class TiffFile
{
public:
  explicit TiffFile(bool bigEndian, bool bigTiff) : m_bigEndian(bigEndian), m_bigTiff(bigTiff)
  {
    m_bytes = bigEndian ? "MM" : "II";
    put(bigTiff ? 43 : 42, 2);
    if (bigTiff) {
      put(8, 2);
      put(0, 2);
    }
    m_link = m_bytes.size();
    put(0, word());
  }
  //! \param orientation : 1..8. \param kind : Value of NewSubfileType.
  void add(const cv::Mat &page, unsigned int orientation = 1, unsigned int kind = 0)
  {
    const std::size_t pixels = m_bytes.size();
    m_bytes.append(reinterpret_cast<const char *>(page.data), page.total());
    m_bytes.append(m_bytes.size() % 2, '\0');
    patch(m_link, m_bytes.size());
    const unsigned int tags[][2] = {{254, kind},
                                    {256, unsigned(page.cols)},
                                    {257, unsigned(page.rows)},
                                    {258, 8},
                                    {259, 1},
                                    {262, 1},
                                    {273, unsigned(pixels)},
                                    {274, orientation},
                                    {277, 1},
                                    {278, unsigned(page.rows)},
                                    {279, unsigned(page.total())}};
    put(std::size(tags), m_bigTiff ? 8 : 2);
    for (const auto &tag : tags) {
      put(tag[0], 2);
      put(4, 2); // LONG
      put(1, word());
      put(tag[1], 4);
      m_bytes.append(word() - 4, '\0');
    }
    m_link = m_bytes.size();
    put(0, word());
  }
  //! Links the last page to the first.
  void close() { patch(m_link, m_bigTiff ? 16 : 8); }
  [[nodiscard]] const std::string &bytes() const { return m_bytes; }

private:
  [[nodiscard]] unsigned int word() const { return m_bigTiff ? 8 : 4; }
  [[nodiscard]] std::string number(std::size_t value, unsigned int size) const
  {
    std::string bytes;
    for (unsigned int i = 0; i < size; ++i) {
      bytes += static_cast<char>(value >> 8 * (m_bigEndian ? size - 1 - i : i) & 255U);
    }
    return bytes;
  }
  void put(std::size_t value, unsigned int size) { m_bytes += number(value, size); }
  void patch(std::size_t place, std::size_t value) { m_bytes.replace(place, word(), number(value, word())); }

  bool m_bigEndian, m_bigTiff;
  std::string m_bytes;
  std::size_t m_link;
};
} // namespace

TEST_CASE("grey pictures of 8 bits are read as they are, colour is made grey", "[pictures]")
{
  const TestFolder folder;
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(1);
  cv::Mat grey(20, 30, CV_8UC1);
  for (int i = 0; i < 600; ++i) {
    grey.data[i] = static_cast<unsigned char>(rng() % 256);
  }
  for (const char *name : {"a.png", "a.pgm", "a.bmp", "a.tif"}) {
    CAPTURE(name);
    cv::imwrite(folder.file(name), grey);
    GreyScale scale;
    CHECK(same(readGreyPicture(folder.file(name), scale), grey));
    CHECK(scale.remark().empty());
  }
  for (const int type : {CV_8UC3, CV_8UC4, CV_16UC3}) {
    CAPTURE(type);
    const double unit = type == CV_16UC3 ? 257. : 1.;
    cv::Mat colour(20, 30, type, cv::Scalar(10, 20, 200, 255) * unit);
    colour(cv::Rect(0, 0, 1, 1)) = cv::Scalar::all(255. * unit); // so that all bits are in use
    cv::imwrite(folder.file("colour.png"), colour);
    GreyScale scale;
    CHECK(readGreyPicture(folder.file("colour.png"), scale).at<unsigned char>(3, 4) ==
          std::lround(0.114 * 10 + 0.587 * 20 + 0.299 * 200));
    CHECK(scale.remark().find("The images are in colour; they were made grey.") == 0);
  }
}

TEST_CASE("values of more than 8 bits are scaled by the range of the format or of the data", "[pictures][depth]")
{
  const TestFolder folder;
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(2);
  for (int bits = 8; bits <= 16; ++bits) {
    const unsigned int white = (1U << static_cast<unsigned int>(bits)) - 1U;
    cv::Mat deep(20, 30, CV_16UC1);
    for (int i = 0; i < 600; ++i) {
      deep.at<unsigned short>(i / 30, i % 30) = static_cast<unsigned short>(rng() % (white + 1U));
    }
    deep.at<unsigned short>(0, 0) = static_cast<unsigned short>(white / 2U + 1U); // the highest bit is in use
    for (const char *name : {"deep.png", "deep.tif"}) {
      CAPTURE(name, bits);
      cv::imwrite(folder.file(name), deep);
      GreyScale scale;
      const cv::Mat grey = readGreyPicture(folder.file(name), scale);
      for (int i = 0; i < 600; ++i) {
        const double exact = 255. * deep.at<unsigned short>(i / 30, i % 30) / white;
        REQUIRE(std::abs(grey.at<unsigned char>(i / 30, i % 30) - exact) <= 0.5 + 1e-4);
      }
      CHECK(scale.remark() == "The images have 16 bits a value; the values 0 to " + std::to_string(white) +
                                  " became the grey values 0 to 255.");
    }
  }
  // A PGM states its maximum value, with comments anywhere, independently of the largest actual value.
  for (const unsigned int white : {15U, 100U, 1023U, 4095U, 65535U}) {
    CAPTURE(white);
    std::string content = "P5 # by hand\n4 #\n# x\n4\n" + std::to_string(white) + "\n";
    for (int i = 0; i < 16; ++i) {
      const unsigned int value = white * 2U / 5U;
      content += white > 255U ? std::string{char(value >> 8U), char(value & 255U)} : std::string(1, char(value));
    }
    GreyScale scale;
    CHECK(std::abs(readGreyPicture(folder.write("deep.pgm", content), scale).at<unsigned char>(2, 2) - 102) <= 1);
    CHECK(scale.remark().find("the values 0 to " + std::to_string(white) + " became") != std::string::npos);
  }
}

TEST_CASE("a recording has one scale, which larger values widen", "[pictures][depth]")
{
  GreyScale scale;
  const auto shown = [&scale](int value, const char *name) {
    return int(scale.toGrey(cv::Mat(4, 4, CV_16UC1, cv::Scalar(value)), 0, name).at<unsigned char>(0, 0));
  };
  CHECK(shown(1000, "a") == std::lround(255. * 1000 / 1023));
  CHECK(shown(500, "b") == std::lround(255. * 500 / 1023));
  CHECK(shown(3000, "c") == std::lround(255. * 3000 / 4095));
  CHECK(shown(500, "d") == std::lround(255. * 500 / 4095));
  CHECK(scale.remark() == "The images have 16 bits a value; the values 0 to 1023 became the grey values 0 to 255, and "
                          "from c on, which has larger ones, the values 0 to 4095.");
}

TEST_CASE("a picture stands as its file says, in JPEG and in TIFF", "[pictures][orientation]")
{
  const TestFolder folder;
  cv::imwrite(folder.file("plain.jpg"), marked(), {cv::IMWRITE_JPEG_QUALITY, 95});
  // EXIF 2.3, tag Orientation: position of the stored first row and column.
  const int corner[] = {0, 0, 1, 2, 3, 0, 1, 2, 3};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    CAPTURE(orientation);
    const std::string jpeg = folder.write("o.jpg", withOrientation(bytesOf(folder.file("plain.jpg")), orientation));
    TiffFile file(false, false);
    file.add(marked(), static_cast<unsigned int>(orientation));
    const std::string tiff = folder.write("o.tif", file.bytes());
    for (const std::string &name : {jpeg, tiff}) {
      CAPTURE(name);
      const cv::Mat picture = read(name);
      CHECK((picture.cols == 16) == (orientation > 4)); // stored with 32
      CHECK(cornerOf(picture) == corner[orientation]);
    }
  }
}

TEST_CASE("every page of a TIFF is read, in any byte order, and copies of pages are none", "[pictures][tiff]")
{
  const TestFolder folder;
  for (const bool bigEndian : {false, true}) {
    for (const bool bigTiff : {false, true}) {
      CAPTURE(bigEndian, bigTiff);
      TiffFile file(bigEndian, bigTiff);
      for (int i = 0; i < 5; ++i) {
        file.add(cv::Mat(16, 32, CV_8UC1, cv::Scalar(10 * i + 5)));
        file.add(cv::Mat(8, 16, CV_8UC1, cv::Scalar(99)), 1, i % 2 == 0 ? 1 : 4); // a reduced copy, or a mask
      }
      vpPictures::File pictures(folder.write("stack.tif", file.bytes()));
      REQUIRE(pictures.pages() == 5);
      CHECK_FALSE(pictures.isCut());
      for (const int i : {0, 3, 1, 4, 2}) {
        const cv::Mat page = pictures.read(static_cast<std::size_t>(i));
        CHECK(page.size() == cv::Size(32, 16));
        CHECK(page.at<unsigned char>(9, 9) == 10 * i + 5);
      }
      CHECK(pictures.nameOf(2) == "page 3 of " + folder.file("stack.tif"));
      CHECK(complaint([&] { (void)read(folder.file("stack.tif")); }) ==
            folder.file("stack.tif") + ": has 5 pages, must have one");
      // A cyclic chain of pages must end, and so must one that leads beyond the file.
      file.close();
      CHECK(vpPictures::File(folder.write("ring.tif", file.bytes())).pages() <= 5);
      const vpPictures::File cut(folder.write("cut.tif", file.bytes().substr(0, file.bytes().size() / 2)));
      CHECK(cut.pages() < 5);
      CHECK(cut.isCut());
    }
  }
}

TEST_CASE("what is no picture, or cut short, is refused by name", "[pictures][errors]")
{
  const TestFolder folder;
  const std::string unreadable = "is not an image that can be read, or is cut short";
  const auto refused = [&](const std::string &name) {
    const std::string sentence = complaint([&] { (void)read(folder.file(name)); });
    CHECK(sentence.find(folder.file(name) + ": ") == 0);
    return sentence.substr(std::min(sentence.size(), folder.file(name).size() + 2));
  };
  cv::imwrite(folder.file("real.tif"), cv::Mat(20, 30, CV_32FC1, cv::Scalar(0.5)));
  CHECK(refused("real.tif").find("has real values of 32 bits, must have 8 or 16 bits without sign") == 0);
  folder.write("text.png", "this is no image");
  CHECK(refused("text.png") == unreadable);
  folder.write("empty.png", "");
  CHECK(refused("empty.png") == unreadable);
  CHECK(refused("none.png") == "cannot be read (there is no such file)");
  fs::create_directory(folder.file("folder.png"));
  CHECK(refused("folder.png") == "cannot be read (it is a folder)");
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(3);
  cv::Mat noise(200, 200, CV_8UC1);
  for (int i = 0; i < 40000; ++i) {
    noise.data[i] = static_cast<unsigned char>(rng() % 256);
  }
  for (const char *name : {"cut.png", "cut.jpg", "cut.pgm", "cut.bmp", "cut.tif"}) {
    cv::imwrite(folder.file(name), noise, {cv::IMWRITE_TIFF_COMPRESSION, 1});
    fs::resize_file(folder.file(name), fs::file_size(folder.file(name)) / 2);
    CAPTURE(name);
    CHECK(refused(name) == unreadable);
  }
  // The end mark of a thumbnail within the EXIF data is not that of the image.
  const std::string jpeg = bytesOf(folder.file("cut.jpg"));
  folder.write("thumbnail.jpg", jpeg.substr(0, 2) + std::string("\xff\xe1\0\x06\xff\xd9..", 8) + jpeg.substr(2));
  CHECK(refused("thumbnail.jpg") == unreadable);
}

TEST_CASE("no file, however spoiled, does worse than be refused", "[pictures][errors]")
{
  const TestFolder folder;
  CAPTURE(vpTestSupport::seed());
  auto rng = vpTestSupport::generator(4);
  TiffFile file(false, false);
  for (int i = 0; i < 3; ++i) {
    file.add(marked());
  }
  cv::imwrite(folder.file("m.png"), marked());
  cv::imwrite(folder.file("m.jpg"), marked());
  const std::vector<std::string> good = {file.bytes(), bytesOf(folder.file("m.png")), bytesOf(folder.file("m.jpg"))};
  int refusals = 0;
  const vpApp::QuietLibraries quiet;
  for (int trial = 0; trial < 600; ++trial) {
    std::string bytes = good[static_cast<std::size_t>(trial) % good.size()];
    const int flips = 1 + static_cast<int>(rng() % 8);
    for (int i = 0; i < flips; ++i) {
      bytes[rng() % bytes.size()] = static_cast<char>(rng() % 256);
    }
    bytes.resize(rng() % 4 == 0 ? rng() % bytes.size() : bytes.size());
    const std::string name = folder.write("spoiled", bytes);
    const std::string sentence = complaint([&] {
      const vpPictures::File pictures(name);
      REQUIRE(pictures.pages() <= std::max<std::size_t>(1, bytes.size())); // a chain of distinct positions
      GreyScale scale;
      for (std::size_t page = 0; page < pictures.pages(); ++page) {
        (void)scale.toGrey(vpPictures::File(pictures).read(page), pictures.white(), name);
      }
    });
    CAPTURE(trial);
    CHECK((sentence == "no exception" || sentence.find(name) != std::string::npos));
    refusals += sentence == "no exception" ? 0 : 1;
  }
  CHECK(refusals > 100);
}
