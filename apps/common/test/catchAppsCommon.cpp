/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Code shared by the programs: exit statuses, progress, jobs, JSON errors, HTML, plots and videos.
#include "vpCatch.h"

#include "testFolder.h"

#include "appMain.h"
#include "curves.h"
#include "dataFile.h"
#include "jobs.h"
#include "jsonReader.h"
#include "lineReader.h"
#include "numberText.h"
#include "outputFile.h"
#include "outputFolder.h"
#include "progress.h"
#include "videoFile.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <thread>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
//! Captures the output of code on a stream.
class Captured
{
public:
  explicit Captured(std::ostream &stream) : m_stream(stream), m_before(stream.rdbuf(m_text.rdbuf())) {}
  ~Captured() { m_stream.rdbuf(m_before); }
  [[nodiscard]] std::string text() const { return m_text.str(); }

private:
  std::ostream &m_stream;
  std::ostringstream m_text;
  std::streambuf *m_before;
};
} // namespace

TEST_CASE("runMain turns exceptions into one sentence and an exit status", "[apps]")
{
  const auto run = [](const std::function<int()> &body) {
    const Captured printed(std::cerr);
    const int status = vpApp::runMain("prog", body);
    return std::make_pair(status, printed.text());
  };
  CHECK(run([] { return 0; }) == std::make_pair(0, std::string()));
  CHECK(run([]() -> int { throw std::runtime_error("photo.png: cannot\nbe  read"); }) ==
        std::make_pair(1, std::string("prog: photo.png: cannot be read\n")));
  CHECK(run([]() -> int { throw vpApp::UsageError("--jobs is 0"); }) ==
        std::make_pair(2, std::string("prog: --jobs is 0 (see prog --help)\n")));
  CHECK(run([]() -> int { throw vpApp::Interrupted(); }).first == 130);
  CHECK(run([]() -> int { throw std::bad_alloc(); }).second == "prog: out of memory\n");
  CHECK(run([]() -> int { throw std::runtime_error("\x1b[31mred\xff"); }).second == "prog: \\u001b[31mred\\xff\n");
}

TEST_CASE("What programs print does not steer the terminal, whoever prints it", "[apps]")
{
  const Captured printed(std::cout), complained(std::cerr);
  CHECK(vpApp::runMain("prog", [] {
          std::cout << "name: \x1b[2J"
                    << "gr\xc3" << std::flush << "\xbc\xc3\x9f" << 'e' << '\r' << '\n'
                    << "\xc3";
          std::cerr << "\r50 %\a";
          return 0;
        }) == 0);
  CHECK(printed.text() == "name: \\u001b[2Jgr\xc3\xbc\xc3\x9f"
                          "e\\u000d\n\\xc3");
  CHECK(complained.text() == "\r50 %\\u0007");
}

TEST_CASE("A program whose output is not taken says so", "[apps]")
{
  std::ofstream full("/dev/full");
  if (!full) {
    vpTestSupport::skip("there is no /dev/full");
    return;
  }
  const Captured complained(std::cerr);
  std::streambuf *before = std::cout.rdbuf(full.rdbuf());
  const int status = vpApp::runMain("prog", [] {
    std::cout << "a long help" << std::endl;
    return 0;
  });
  std::cout.rdbuf(before);
  CHECK(status == 1);
  CHECK(complained.text() == "prog: standard output: cannot be written\n");
}

TEST_CASE("Progress shows a bar, plain lines or nothing", "[apps]")
{
  std::ostringstream bar, lines, silent;
  {
    vpApp::Progress a("work", 4., bar, vpApp::Progress::Style::Bar);
    vpApp::Progress b("work", 4., lines, vpApp::Progress::Style::Lines);
    vpApp::Progress c("work", 4., silent, vpApp::Progress::Style::Silent);
    CHECK(a.share() == 0.);
    for (int i = 0; i < 40; ++i) {
      a.add(0.1);
      b.add(0.1);
      c.add(0.1);
    }
    CHECK(a.share() == Approx(1.));
  }
  CHECK(bar.str().find("\rwork [") == 0);
  CHECK(bar.str().find("100 %") != std::string::npos);
  CHECK(bar.str().back() == '\n');
  CHECK(silent.str().empty());
  CHECK(lines.str().find('\r') == std::string::npos);
  const std::string printed = lines.str();
  CAPTURE(printed);
  for (const char *quarter : {"work: 25 %", "work: 50 %", "work: 75 %", "work: 100 %"}) {
    CHECK(printed.find(quarter) != std::string::npos);
  }
  CHECK(std::count(printed.begin(), printed.end(), '\n') == 4);
}

TEST_CASE("runJobs does every piece once and passes on the first error", "[apps]")
{
  for (const unsigned int threads : {1u, 3u, 16u}) {
    CAPTURE(threads);
    std::vector<std::atomic<int>> done(50);
    vpApp::runJobs(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    for (const std::atomic<int> &count : done) {
      CHECK(count == 1);
    }
    vpApp::runJobs(0, threads, [](std::size_t) { throw std::runtime_error("never called"); });

    std::atomic<int> calls{0};
    const std::string error = complaint([&] {
      vpApp::runJobs(1000, threads, [&](std::size_t i) {
        ++calls;
        if (i >= 5) {
          throw std::runtime_error("job " + std::to_string(i));
        }
      });
    });
    CHECK(error == "job 5");
    CHECK(calls < 1000);
  }
}

TEST_CASE("runJobs does without threads that the system does not give", "[apps]")
{
  if (!vpTestSupport::canCountAllocations()) {
    vpTestSupport::skip("a sanitizer needs more memory than the limit of this test");
    return;
  }
  const pid_t child = fork();
  if (child == 0) { // in a separate process, as the limit is permanent
    const rlimit none{0, 0};
    std::atomic<int> done{0};
    try {
      setrlimit(RLIMIT_NPROC, &none);
      std::size_t pages = 0; // for root, which the number does not limit: memory for a few stacks
      std::ifstream("/proc/self/statm") >> pages;
      const rlim_t most = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (64U << 20U);
      const rlimit memory{most, most};
      setrlimit(RLIMIT_AS, &memory);
      vpApp::runJobs(500, 256, [&](std::size_t) { ++done; });
    }
    catch (...) {
      _exit(2);
    }
    _exit(done == 500 ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("Lines of files and pipes", "[apps]")
{
  const TestFolder folder;
  const auto linesOf = [](const std::string &file) {
    vpApp::LineReader reader(file);
    std::vector<std::string> lines;
    for (std::string line; reader.next(line);) {
      lines.push_back(line);
    }
    return lines;
  };
  CHECK(linesOf(folder.write("a", "")).empty());
  CHECK(linesOf(folder.write("a", "one\n\nthree")) == std::vector<std::string>{"one", "", "three"});
  CHECK(linesOf(folder.write("a", "one\n")) == std::vector<std::string>{"one"});
  const std::string large(100000, 'x');
  CHECK(linesOf(folder.write("a", large + "\n" + large)) == std::vector<std::string>{large, large});
  CHECK(complaint([&] { (void)linesOf("none.jsonl"); }) == "none.jsonl: cannot be read (there is no such file)");
  CHECK(complaint([&] { (void)linesOf(folder.path.string()); }) ==
        folder.path.string() + ": cannot be read (it is a folder)");
  CHECK(complaint([&] { (void)linesOf("/dev/zero"); }) == "/dev/zero:1: is longer than 64 MB");

  // A pipe whose other end is opened later and writes in pieces.
  const std::string pipe = (folder.path / "pipe").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::thread writer([&pipe] {
    std::ofstream out(pipe);
    for (const char *piece : {"o", "ne\ntw", "o\n"}) {
      out << piece << std::flush;
      usleep(1000);
    }
  });
  CHECK(linesOf(pipe) == std::vector<std::string>{"one", "two"});
  writer.join();
}

TEST_CASE("A file is replaced in one step, with its mode, through its link", "[apps]")
{
  const TestFolder folder;
  const std::string file = folder.write("a.csv", "first"), link = (folder.path / "link.csv").string();
  fs::create_symlink("a.csv", link);
  REQUIRE(chmod(file.c_str(), 0640) == 0);
  folder.write(".a.csv.partial", "what a killed run left, longer than the new content");
  vpApp::writeWholeFile(link, "second");
  CHECK(vpApp::readFile(file) == "second");
  CHECK(fs::is_symlink(link));
  CHECK(fs::status(file).permissions() == static_cast<fs::perms>(0640));
  CHECK(folder.entries() == std::vector<std::string>{"a.csv", "link.csv"});
  CHECK(complaint([&] { vpApp::writeWholeFile("/dev/full", "x"); }) ==
        "/dev/full: cannot be written (No space left on device)");
}

TEST_CASE("JSON errors name the file, the place and the value", "[apps]")
{
  const TestFolder folder;
  const auto reading = [&](const std::string &content) {
    const std::string file = folder.write("task.json", content);
    const std::string text = complaint([&] {
      const nlohmann::json json = vpApp::readJsonFile(file);
      vpApp::JsonObject top(json, "task.json");
      vpApp::JsonObject camera = top.object("camera");
      (void)camera.number("px");
      (void)camera.number("py", 800.);
      (void)camera.count("width", 640);
      camera.finish();
      (void)top.text("name", "none");
      if (top.has("poses")) {
        for (vpApp::JsonObject &pose : top.objects("poses")) {
          (void)pose.numbers("t", 3);
          pose.finish();
        }
      }
      top.finish();
    });
    const std::size_t at = text.find("task.json");
    return at == std::string::npos ? text : text.substr(at);
  };
  CHECK(reading(R"({"camera": {"px": 1}})") == "no exception");
  CHECK(reading(R"({"camera": {"px": 1}, "poses": [{"t": [1, 2, 3]}]})") == "no exception");
  CHECK(reading("{\n  \"camera\": {\"px\": NaN}\n}").find("task.json: line 2, column 20: ") == 0);
  CHECK(reading("{\"camera\"").find("task.json: line 1, column ") == 0);
  CHECK(reading("").find("task.json: line 1, column 1") == 0);
  CHECK(reading("[1, 2]") == "task.json: the content is [1,2], must be an object { }");
  CHECK(reading(R"({"camera": {"px": 1e999}})") == "task.json: line 1, column 23: number overflow parsing '1e999'");
  CHECK(reading(R"({"camera": {"px": "wide"}})") == "task.json: camera.px is \"wide\", must be a number");
  CHECK(reading(R"({"camera": {}})") == "task.json: camera.px is missing");
  CHECK(reading(R"({"camera": {"px": 1, "fx": 2}})") == "task.json: unknown field camera.fx; known are px, py, width");
  CHECK(reading(R"({"camera": {"px": 1, "width": -3}})") ==
        "task.json: camera.width is -3, must be a whole number >= 0");
  CHECK(reading(R"({"camera": {"px": 1}, "name": 7})") == "task.json: name is 7, must be a text");
  CHECK(reading(R"({"camera": {"px": 1}, "poses": []})") ==
        "task.json: poses is [], must be a list of at least one object");
  CHECK(reading(R"({"camera": {"px": 1}, "poses": [{"t": [1, 2, 3]}, {"t": [1, 2]}]})") ==
        "task.json: poses[1].t is [1,2], must be a list of 3 numbers");
  CHECK(reading(R"({"camera": {"px": 1, "px": 2}})") == "task.json: field \"px\" is given twice");
  CHECK(reading(R"({"camera": {"px": 1}, "poses": [{"t": [1, 2, 3], "t": 0}]})") ==
        "task.json: field \"t\" is given twice");
  CHECK(reading("{\"camera\": " + std::string(1000000, '[')) == "task.json: is nested more than 64 deep");
  CHECK(reading("\xef\xbb\xbf{\"camera\":\r\n {\"px\": 1}}\r\n") == "no exception");
  CHECK(reading("{\"camera\": {\"px\": \"\\u009b31m\\u0000\"}}") ==
        "task.json: camera.px is \"\\u009b31m\\u0000\", must be a number");
  CHECK(complaint([] { (void)vpApp::parseJsonLine("{\"id\": " + std::string(1000000, '['), "a.jsonl:7"); }) ==
        "a.jsonl:7: is nested more than 64 deep");
  CHECK(complaint([] { (void)vpApp::parseJsonLine("{\"a\" 1}", "a.jsonl:7"); }).find("a.jsonl:7: column 6: ") == 0);
  CHECK(complaint([] { (void)vpApp::readJsonFile("/dev/zero"); }) ==
        "/dev/zero: cannot be read (it is a pipe or a device)");
  const std::string huge = folder.write("huge.json", "");
  std::filesystem::resize_file(huge, (64U << 20U) + 1U);
  CHECK(complaint([&] { (void)vpApp::readJsonFile(huge); }) == huge + ": is larger than 64 MB");
  CHECK(complaint([&] { (void)vpApp::readJsonFile(folder.path / "none.json"); }).find("none.json: cannot be read") !=
        std::string::npos);
}

TEST_CASE("Numbers are written as people do", "[apps]")
{
  CHECK(vpApp::number(150., 2) == "150");
  CHECK(vpApp::number(-99.6, 2) == "-100");
  CHECK(vpApp::number(123456., 3) == "123000");
  CHECK(vpApp::number(0.20001, 3) == "0.2");
  CHECK(vpApp::number(57., 4) == "57");
  CHECK(vpApp::number(0.00123456, 3) == "0.00123");
  CHECK(vpApp::number(2e-5, 3) == "2e-05");
  CHECK(vpApp::number(3e12, 3) == "3e+12");
  CHECK(vpApp::number(INFINITY, 3) == "inf");
  std::mt19937_64 random = vpTestSupport::generator();
  for (int i = 0; i < 1000; ++i) { // exactly the requested digits
    const int digits = std::uniform_int_distribution<int>(1, 12)(random);
    const double value = std::pow(10., std::uniform_real_distribution<double>(-6., 9.)(random));
    const double written = std::stod(vpApp::number(value, digits));
    CAPTURE(value, digits, written);
    CHECK(std::fabs(written - value) <= 0.5000001 * std::pow(10., std::floor(std::log10(value)) - digits + 1.));
  }
}

TEST_CASE("Texts of files are made printable", "[apps]")
{
  CHECK(vpPrintable("plain, grüße, 世界, 🤖") == "plain, grüße, 世界, 🤖");
  CHECK(vpPrintable("  two\nlines\t\r\n and  blanks \n") == "two lines and blanks");
  CHECK(vpPrintable("\x1b[31m\a\x7f") == "\\u001b[31m\\u0007\\u007f");
  CHECK(vpPrintable("\xc2\x9b") == "\\u009b"); // also controls a terminal
  CHECK(vpPrintable("a\xe2\x80\xae"
                    "b") == "a\\u202eb"); // reverses the text direction
  CHECK(vpPrintable("\xf3\xa0\x81\x81") == "\\udb40\\udc41");
  CHECK(nlohmann::json::parse("\"" + vpPrintable("\xf3\xa0\x81\x81") + "\"") == "\xf3\xa0\x81\x81");
  // Invalid UTF-8: isolated, truncated, overlong, half of a pair, beyond the last character.
  CHECK(vpPrintable("\xff\xc3") == "\\xff\\xc3");
  CHECK(vpPrintable("\xc0\xaf") == "\\xc0\\xaf");
  CHECK(vpPrintable("\xe0\x80\xaf") == "\\xe0\\x80\\xaf");
  CHECK(vpPrintable("\xed\xa0\x80") == "\\xed\\xa0\\x80");
  CHECK(vpPrintable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");
  CHECK(vpPrintable(std::string(2000, 'x'), 10) == "xxxxxxxxxx...");
  CHECK(vpPrintable("123456789\xc3\xa4zzzzzz", 10) == "123456789...");
}

TEST_CASE("Data files are found, and a missing one is named", "[apps]")
{
  CHECK(fs::exists(vpApp::dataFile("target/klimt.jpg")));
  CHECK(complaint([] { (void)vpApp::dataFile("target/none.jpg"); }).find("target/none.jpg") != std::string::npos);
  setenv("VISP_DIRECT_DATA", "/nowhere", 1);
  CHECK(complaint([] { (void)vpApp::dataFile("target/klimt.jpg"); }).find("is not in /nowhere;") != std::string::npos);
  unsetenv("VISP_DIRECT_DATA");
}

TEST_CASE("Texts name data files as the user reaches them", "[apps]")
{
  const fs::path folder = fs::path(vpApp::dataFile("target/klimt.jpg")).parent_path().parent_path(),
                 before = fs::current_path();
  const std::string text =
      "data/target/klimt.jpg, (see data/target). Not data/none.txt, mydata/target, /data/target, data/.";
  const auto expected = [](const fs::path &from) {
    return (from / "target/klimt.jpg").string() + ", (see " + (from / "target").string() +
           "). Not data/none.txt, mydata/target, /data/target, data/.";
  };
  fs::current_path(folder / "robot"); // beside them
  const std::string beside = vpApp::withDataPaths(text);
  fs::current_path(folder.parent_path());
  const std::string above = vpApp::withDataPaths(text);
  fs::current_path(before);
  CHECK(beside == expected(folder));
  CHECK(above == expected(folder.filename()));
  CHECK(vpApp::withDataPaths("").empty());
}

TEST_CASE("A path with a blank is a word of a shell command", "[apps]")
{
  const fs::path folder = fs::temp_directory_path() / "visp-direct it's data";
  fs::create_directories(folder / "target");
  setenv("VISP_DIRECT_DATA", folder.c_str(), 1);
  const std::string text = vpApp::withDataPaths("--target data/target");
  unsetenv("VISP_DIRECT_DATA");
  fs::remove_all(folder);
  CHECK(text == "--target '" + (folder.parent_path() / "visp-direct it'\\''s data/target").string() + "'");
}

TEST_CASE("A video file can be read back", "[apps]")
{
  const TestFolder folder;
  const std::string file = (folder.path / "a.mp4").string();
  vpApp::VideoFile video(file, 160, 120, 10.);
  for (int i = 0; i < 12; ++i) {
    video.write(cv::Mat(120, 160, CV_8UC3, cv::Scalar(20 * i, 0, 0)));
  }
  video.close();
  cv::VideoCapture capture(file);
  REQUIRE(capture.isOpened());
  CHECK(capture.get(cv::CAP_PROP_FRAME_COUNT) == 12.);
  CHECK(complaint([] { vpApp::VideoFile("/nowhere/a.mp4", 160, 120, 10.); }).find("/nowhere/a.mp4") == 0);
}

TEST_CASE("A level spans the curves of a plot, or its range", "[apps]")
{
  vpApp::Plot plot = vpApp::timePlot("t", "m");
  vpApp::addLevel(plot, 1., "nothing yet");
  CHECK(plot.curves.back().x == std::vector<double>{0., 0.});
  plot.xRange = {0., 5.};
  vpApp::addLevel(plot, 1., "over the range");
  CHECK(plot.curves.back().x == std::vector<double>{0., 5.});
  plot.curves.push_back({"c", "#000000", vpApp::PlotStyle::Solid, 2., {0., 3., 9.}, {0., 1., 0.}});
  vpApp::addLevel(plot, 2., "over the curves");
  CHECK(plot.curves.back().x.back() == 9.);
  CHECK(plot.curves.back().y == std::vector<double>{2., 2.});
}
