/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Files, stacks, videos and cameras: gaps, unreadable images, depth.
#include "vpCatch.h"

#include "cameraClock.h"
#include "fileSource.h"
#include "testFolder.h"
#include "videoSource.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <deque>
#include <map>

namespace
{
using namespace vpApp;
using vpTestSupport::uniform;
namespace fs = std::filesystem;

//! Images distinguishable by their grey value.
cv::Mat plain(int grey, int type = CV_8UC1) { return cv::Mat(20, 30, type, cv::Scalar::all(grey)); }

//! Grey value of the first pixel of each image, preceded by ! after a gap, followed by its number.
std::string contentOf(ImageSource &source)
{
  std::string line;
  vpImage<unsigned char> image;
  while (source.next(image)) {
    line += std::string(source.isAfterGap() ? "!" : "") + std::to_string(int(image[0][0])) + "@" +
            std::to_string(source.number()) + " ";
  }
  return line;
}

std::string joined(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines) {
    text += line + "\n";
  }
  return text;
}

//! A camera that gives its images in turn; an empty one is a failure.
class ScriptedCapture : public cv::VideoCapture
{
public:
  ScriptedCapture(std::deque<cv::Mat> pictures, const std::string &code = "YUYV")
    : m_pictures(std::move(pictures)), m_code(code)
  {}
  bool read(cv::OutputArray image) override
  {
    if (m_pictures.empty() || m_pictures.front().empty()) {
      if (!m_pictures.empty()) {
        m_pictures.pop_front();
      }
      return false;
    }
    m_pictures.front().copyTo(image);
    m_pictures.pop_front();
    return true;
  }
  double get(int property) const override
  {
    return property == cv::CAP_PROP_FOURCC ? cv::VideoWriter::fourcc(m_code[0], m_code[1], m_code[2], m_code[3]) : 0.;
  }
  bool set(int property, double value) override
  {
    m_raw = m_raw || (property == cv::CAP_PROP_CONVERT_RGB && value == 0.);
    return true;
  }
  bool m_raw = false;

private:
  std::deque<cv::Mat> m_pictures;
  std::string m_code;
};
} // namespace

TEST_CASE("patterns and folders give their files in the order of the numbers", "[visp-track-pattern]")
{
  const TestFolder folder;
  for (const char *name : {"img2.png", "img10.png", "img1.png", "img003.png", "other.png", "img5.txt", "img7.pgm"}) {
    folder.write(name, "");
  }
  const auto names = [](const std::vector<fs::path> &files) {
    std::string line;
    for (const fs::path &file : files) {
      line += file.filename().string() + " ";
    }
    return line;
  };
  CHECK(names(filesOfPattern(folder.file("img%d.png"))) == "img1.png img2.png img003.png img10.png ");
  CHECK(names(filesOfPattern(folder.file("img%03d.png"))) == "img003.png ");
  folder.write("._img2.png", "");
  std::vector<fs::path> hidden;
  CHECK(names(imagesOfFolder(folder.file(""), hidden)) == "img1.png img2.png img003.png img7.pgm img10.png other.png ");
  CHECK(names(hidden) == "._img2.png ");
  CHECK(complaint([&] { (void)filesOfPattern(folder.file("x%d.png")); }) ==
        folder.file("x%d.png") + ": no file has such a name");
  CHECK(complaint([&] { (void)filesOfPattern("/none/x%d.png"); }) == "/none/x%d.png: no file has such a name");
  for (const char *bad : {"x%s.png", "x%.png", "x%d%d.png", "x%-3d.png", "100%"}) {
    CHECK(complaint([&] { (void)filesOfPattern(bad); }).find("is no pattern; it must have one %d") !=
          std::string::npos);
  }
}

TEST_CASE("a jump of the numbers is a gap, a steady step is none", "[sources][gap]")
{
  const auto gaps = [](const std::vector<fs::path> &files) {
    const FileNumbers numbers(files);
    std::string line;
    for (std::size_t i = 0; i + 1 < files.size(); ++i) {
      line += numbers.isGap(i, i + 1) ? "!" : ".";
    }
    return line;
  };
  CHECK(gaps({"0.png", "1.png", "2.png", "12.png", "13.png"}) == "..!.");
  CHECK(gaps({"f0.png", "f10.png", "f20.png", "f30.png"}) == "...");
  CHECK(gaps({"f0.png", "f10.png", "f20.png", "f40.png"}) == "..!");
  CHECK(gaps({"f9.png", "f8.png", "f7.png", "f5.png"}) == "..!");                         // backwards
  CHECK(gaps({"f0.png", "f1.png", "f2.png", "f1.png"}) == "..!");                         // direction reversed
  CHECK(gaps({"t1000033.png", "t1000066.png", "t1000100.png", "t1000167.png"}) == "..!"); // time stamps
  CHECK(gaps({"t1730000000000033.png", "t1730000000000066.png", "t1730000000000199.png"}) == ".!");
  CHECK(gaps({"a1.png", "a2.png", "b1.png", "b2.png"}) == ".!.");     // another series
  CHECK(gaps({"left.png", "right.png"}) == ".");                      // no information in names
  CHECK(gaps({"3.png", "79.png"}) == ".");                            // nothing to compare with
  CHECK(FileNumbers({"left.png", "?.png", "right.png"}).isGap(0, 2)); // unless one was unreadable
}

TEST_CASE("one unreadable file among many is left out, counted and said; none left is refused", "[sources]")
{
  const TestFolder folder;
  std::vector<fs::path> files;
  for (int i = 0; i < 9; ++i) {
    files.emplace_back(folder.file("img" + std::to_string(i) + ".png"));
    cv::imwrite(files.back().string(), plain(10 * i));
  }
  folder.write("img4.png", "");
  fs::resize_file(files[6], fs::file_size(files[6]) / 2);
  FileSource source(files, "the files");
  source.leaveOut({folder.file("._img1.png")}, "begins with a dot");
  CHECK(source.count() == 9);
  CHECK(contentOf(source) == "0@0 10@1 20@2 30@3 !50@5 !70@7 80@8 ");
  const std::string remarks = joined(source.remarks());
  CHECK(remarks.find("2 gaps: images are missing (after img3.png comes img5.png; after img5.png comes img7.png).\n") ==
        0);
  CHECK(remarks.find("3 images were left out (" + folder.file("._img1.png") + ": begins with a dot; " +
                     files[4].string() + ": is not an image that can be read, or is cut short; " + files[6].string()) !=
        std::string::npos);

  FileSource few(files, "the files", 3);
  CHECK(contentOf(few) == "0@0 10@1 20@2 ");

  vpImage<unsigned char> image;
  FileSource none({files[4], files[6]}, "the files");
  CHECK(complaint([&] { (void)none.next(image); }) ==
        "none of the images can be read; the first: " + files[4].string() +
            ": is not an image that can be read, or is cut short");
  FileSource one({files[4]}, "the file");
  CHECK(complaint([&] { (void)one.next(image); }) ==
        files[4].string() + ": is not an image that can be read, or is cut short");
}

TEST_CASE("all pages of a TIFF are images, one that cannot be read is a gap", "[sources][tiff]")
{
  const TestFolder folder;
  std::vector<cv::Mat> pages;
  for (int i = 0; i < 7; ++i) {
    pages.push_back(plain(i));
  }
  const std::string stack = folder.file("stack.tif");
  cv::imwrite(stack, pages, {cv::IMWRITE_TIFF_COMPRESSION, 1});
  FileSource source({stack}, "the file");
  CHECK(source.count() == 7);
  CHECK(contentOf(source) == "0@0 1@1 2@2 3@3 4@4 5@5 6@6 ");
  CHECK(source.remarks().empty());
  CHECK(source.name() == "page 7 of " + stack);

  cv::imwrite(folder.file("stack2.tif"), std::vector<cv::Mat>(pages.begin(), pages.begin() + 2));
  FileSource both({stack, folder.file("stack2.tif")}, "the files", 8);
  CHECK(contentOf(both) == "0@0 1@1 2@2 3@3 4@4 5@5 6@6 0@7 ");

  // Truncated: the remaining part is read.
  fs::resize_file(stack, fs::file_size(stack) * 2 / 3);
  FileSource cut({stack}, "the file");
  const std::string content = contentOf(cut);
  CHECK(content.find("0@0 1@1 2@2 ") == 0);
  CHECK(content.find("6@6") == std::string::npos);
  CHECK(joined(cut.remarks()).find("1 file is cut short; the pages before the cut were read.") != std::string::npos);
}

TEST_CASE("a camera may fail for a moment; when it stops, that is an error", "[sources][camera]")
{
  const auto camera = [](const std::deque<cv::Mat> &pictures) {
    return std::make_unique<VideoSource>(std::make_unique<ScriptedCapture>(pictures), "/dev/video0", true, 4);
  };
  const cv::Mat failure;
  const auto good = camera({plain(0), failure, plain(1), plain(2), failure, failure, plain(3), plain(4)});
  CHECK(contentOf(*good) == "0@0 !1@2 2@3 !3@6 ");
  CHECK(joined(good->remarks()).find("The camera failed to give an image 3 times.") == 0);

  const auto dead = camera({plain(0), plain(1)});
  vpImage<unsigned char> image;
  CHECK(dead->next(image));
  CHECK(dead->next(image));
  CHECK(complaint([&] { (void)dead->next(image); }) == "/dev/video0: the camera gives no image after 2");
  CHECK(complaint([&] { (void)camera({})->next(image); }) == "/dev/video0: the camera gives no image");
}

TEST_CASE("a camera with more than 8 bits is asked for all of them", "[sources][camera][depth]")
{
  for (const std::string code : {"Y16 ", "Y12 ", "Y10 ", "YUYV", "GREY", "MJPG"}) {
    CAPTURE(code);
    auto capture =
        std::make_unique<ScriptedCapture>(std::deque<cv::Mat>{plain(4095, CV_16UC1), plain(2048, CV_16UC1)}, code);
    const ScriptedCapture &asked = *capture;
    VideoSource source(std::move(capture), "/dev/video0", true, 2);
    CHECK(asked.m_raw == (code[1] == '1'));
    CHECK(contentOf(source) == "255@0 128@1 ");
    CHECK(joined(source.remarks()) ==
          "The images have 16 bits a value; the values 0 to 4095 became the grey values 0 to 255.\n");
  }
}

TEST_CASE("a video that is compressed between its images says so", "[sources]")
{
  const std::map<std::string, std::string> codecs = {
      {"avc1", "h264"}, {"h264", "h264"}, {"X264", "h264"}, {"hev1", "hevc"}, {"FMP4", "mpeg4"}, {"XVID", "mpeg4"},
      {"VP90", "vp9"},  {"FFV1", ""},     {"MJPG", ""},     {"png ", ""},     {"YUYV", ""}};
  for (const auto &[code, name] : codecs) {
    CAPTURE(code);
    const VideoSource source(std::make_unique<ScriptedCapture>(std::deque<cv::Mat>(), code), "film.mp4", false, 0);
    const std::string sentence = "film.mp4 is compressed between images (" + name +
                                 "): deviations do not include the errors of compression. Record without loss, as PNG "
                                 "or FFV1.\n";
    CHECK(joined(source.remarks()) == (name.empty() ? "" : sentence));
  }
}

TEST_CASE("a video of more than 8 bits says what became of them", "[sources][depth]")
{
  // YUV4MPEG2, grey: no codec needed. 0.4 of the full range in every format.
  const TestFolder folder;
  for (const int bits : {8, 10, 12, 16}) {
    CAPTURE(bits);
    const std::string name = bits == 8 ? "mono" : "mono" + std::to_string(bits);
    std::string content = "YUV4MPEG2 W32 H16 F25:1 Ip A1:1 C" + name + " XYSCSS=" + name + "\n";
    const unsigned int value = static_cast<unsigned int>(0.4 * ((1U << static_cast<unsigned int>(bits)) - 1U));
    for (int frame = 0; frame < 2; ++frame) {
      content += "FRAME\n";
      for (int pixel = 0; pixel < 32 * 16; ++pixel) {
        content += static_cast<char>(value & 255U);
        if (bits > 8) {
          content += static_cast<char>(value >> 8U);
        }
      }
    }
    folder.write("film.y4m", content);
    const std::unique_ptr<ImageSource> source = openVideo(folder.file("film.y4m"));
    vpImage<unsigned char> image;
    REQUIRE(source->next(image));
    CHECK(std::abs(image[8][8] - 102) <= 2);
    const std::string remarks = joined(source->remarks());
    CHECK((bits > 8) == (remarks.find("The video has " + std::to_string(bits) +
                                      " bits a value; its largest possible "
                                      "value became the grey value 255.") == 0));
    CHECK((bits == 8) == remarks.empty());
  }
}

TEST_CASE("a camera's times lose the jitter of the transport, and follow a drifting clock", "[sources][clock]")
{
  std::mt19937_64 generator = vpTestSupport::generator();
  for (int trial = 0; trial < 200; ++trial) {
    const double offset = uniform(generator, -1e6, 1e6), drift = uniform(generator, -1e-4, 1e-4);
    const double least = uniform(generator, 1e-4, 0.02), jitter = uniform(generator, 0., 0.1);
    CameraClock clock(50);
    for (int k = 0; k < 400; ++k) {
      const double taken = 0.04 * k, stamp = offset + (1. + drift) * taken;
      const double arrival = taken + least + (uniform(generator, 0., 1.) < 0.2 ? 0. : uniform(generator, 0., jitter));
      const double found = clock.convert(stamp, arrival);
      REQUIRE(found <= arrival + 1e-9);
      if (k >= 50) { // of the clocks' difference: the least delay, and the drift over the window
        REQUIRE(std::fabs(found - taken - least) < std::fabs(drift) * 50 * 0.04 + 1e-3 * jitter + 1e-9);
      }
    }
    const double arrival = 100.; // the camera restarts
    REQUIRE(std::fabs(clock.convert(offset - 1000., arrival) - arrival) < 1e-9);
  }
}

TEST_CASE("lost images are counted by their numbers, also when the numbers start again", "[sources][clock]")
{
  std::mt19937_64 generator = vpTestSupport::generator();
  for (const std::uint64_t largest : {std::uint64_t(65535), std::uint64_t(1) << 40U}) {
    ImageNumbers numbers;
    std::uint64_t number = largest == 65535 ? 65000 : 65000; // passes 65535 within the test
    std::size_t lost = 0, found = 0;
    (void)numbers.missingBefore(number);
    for (int k = 0; k < 2000; ++k) {
      const std::size_t gap =
          uniform(generator, 0., 1.) < 0.1 ? static_cast<std::size_t>(uniform(generator, 1., 40.)) : 0;
      number = (number + gap) % largest + 1;
      lost += gap;
      found += numbers.missingBefore(number);
    }
    CHECK(found == lost);
  }
  ImageNumbers none;
  CHECK(none.missingBefore(0) + none.missingBefore(0) + none.missingBefore(7) + none.missingBefore(7) == 0);
  ImageNumbers restarted;
  (void)restarted.missingBefore(5000);
  CHECK(restarted.missingBefore(1) == 0);
}
