/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// What a newcomer tries first is the same in all programs: help, version, mistakes, a full device, a folder of others.
#include "vpCatch.h"

#include "programRun.h"
#include "testFolder.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <functional>
#include <sstream>

#include <sys/stat.h>
#include <unistd.h>

namespace
{
const std::vector<std::string> programs = {PROGRAMS};

std::string nameOf(const std::string &program) { return std::filesystem::path(program).filename().string(); }

bool has(const std::string &text, const std::string &piece) { return text.find(piece) != std::string::npos; }

//! Status 2 or 1, one sentence that begins with the program's name, nothing on standard output and nothing written.
void complains(ProgramRun &run, const std::string &program, const std::string &arguments, int status,
               const std::string &sentence)
{
  CAPTURE(program, arguments);
  CHECK(run(arguments) == status);
  CAPTURE(run.err());
  CHECK(has(run.err(), nameOf(program) + ": "));
  CHECK(has(run.err(), sentence));
  CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
  CHECK(run.out().empty());
  CHECK(run.entries().empty());
}
} // namespace

TEST_CASE("Help and version", "[programs]")
{
  for (const std::string &program : programs) {
    CAPTURE(program);
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    CHECK(run.err().empty());
    for (const char *piece : {"Usage: ", "Examples:", "Exit status: 0 ", "--version"}) {
      CHECK(has(run.out(), piece));
    }
    CHECK(has(run.out(), nameOf(program)));
    std::istringstream help(run.out());
    for (std::string line; std::getline(help, line);) {
      CAPTURE(line);
      CHECK((line.size() <= 80 || has(line, VISP_DIRECT_DATA_DIR))); // paths are not broken
    }
    for (const char *lonely : {"\n  --seed", "\n  --law", "\n  --method", "\n  --robot"}) { // they have a heading
      const std::size_t headings = run.out().find("\n\n", run.out().find("\nOptions:"));
      CHECK(run.out().find(lonely) >= headings);
    }
    REQUIRE(run("--version") == 0);
    CHECK(run.out().find(nameOf(program) + " " + VISP_DIRECT_VERSION + " (ViSP ") == 0);
    CHECK(std::count(run.out().begin(), run.out().end(), '\n') == 1);
    CHECK(run.entries().empty());
  }
}

TEST_CASE("A failing standard output is reported", "[programs]")
{
  if (!std::filesystem::exists("/dev/full")) {
    vpTestSupport::skip("there is no /dev/full");
    return;
  }
  for (const std::string &program : programs) {
    CAPTURE(program);
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    const bool lists = has(run.out(), "--list");
    for (const char *arguments : {"--help", "--version", "--list"}) {
      if (arguments != std::string("--list") || lists) {
        CAPTURE(arguments);
        CHECK(run.intoFullDevice(arguments) == 1);
        CHECK(run.err() == nameOf(program) + ": standard output: cannot be written\n");
      }
    }
  }
}

TEST_CASE("Mistakes on the command line", "[programs]")
{
  for (const std::string &program : programs) {
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    const std::string help = run.out();
    complains(run, program, "--nonsense", 2, "--nonsense");
    complains(run, program, "--nonsense", 2, "(see " + nameOf(program) + " --help)");
    if (has(help, "--jobs")) {
      for (const char *jobs : {"0", "-1", "many", "1.5", "99999999999999999999"}) {
        complains(run, program, std::string("--jobs ") + jobs, 2, "--jobs is " + std::string(jobs));
      }
    }
    if (has(help, "--frames")) {
      complains(run, program, "--frames -5", 2, " is -5, must be ");
    }
    if (has(help, "--seed ")) {
      complains(run, program, "--seed luck", 2, "--seed is luck, must be ");
    }
    if (has(help, "--out")) {
      complains(run, program, "--out ''", 2, "--out is given without a value");
      complains(run, program, "--out", 2, "--out");
    }
  }
}

TEST_CASE("A result folder that cannot be used ends the program at once", "[programs]")
{
  for (const std::string &program : programs) {
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    if (!has(run.out(), "--out")) {
      continue;
    }
    complains(run, program, "--out /proc/none", 1, "/proc/none: cannot be written");
    complains(run, program, "--out /dev/null", 1, "/dev/null: exists and is not a folder");
    std::filesystem::create_directory(run.path("mine"));
    run.write("mine/thesis.txt", "years of work");
    CAPTURE(program);
    CHECK(run("--out mine") == 1);
    CHECK(has(run.err(), "mine: is not empty and not a result of " + nameOf(program) + ", so it is left alone"));
    CHECK(vpApp::readFile(run.path("mine/thesis.txt")) == "years of work");
  }
}

namespace
{
//! A way to give a program a file: F in the arguments stands for the file, D for its folder.
struct Input {
  std::string program, arguments, file;
};

const std::vector<Input> ownInputs = {
    {"visp-arm", "F", "arm.json"},
    {"visp-arm", "F", "arm.urdf"},
    {"visp-arm", "--at 0,0,0,0,0,0,0 --touches F", "scene.json"},
    {"visp-avoid-obstacle", "--sensor depth --scene F", "scene.json"},
    {"visp-avoid-obstacle", "--robot F", "arm.json"},
    {"visp-avoid-obstacle", "--robot F", "arm.urdf"},
    {"visp-avoid-obstacle", "--targets D", "targets.json"},
    {"visp-generate-pattern", "--config F", "product.json"},
    {"visp-plan-compare", "--scene F", "scene.json"},
    {"visp-plan-compare", "--robot F", "arm.json"},
    {"visp-plan-compare", "--robot F", "arm.urdf"},
    {"visp-plan-trajectory", "F", "problems.jsonl"},
    {"visp-print-pattern", "--explore F", "setup.json"},
    {"visp-servo", "--goal F", "goal.json"},
    {"visp-servo", "--target F --size 0.1", "photo.png"},
    {"visp-servo", "--reference F", "photo.png"},
    {"visp-servo", "--camera F", "video.mp4"},
    {"visp-servo", "--eMc F", "eMc.yaml"},
    {"visp-servo", "--fMc F", "fMc.yaml"},
    {"visp-servo", "--scene F", "scene.json"},
    {"visp-servo", "--camera '" VISP_DIRECT_DATA_DIR "/target/box.png' --camera-xml F", "camera.xml"},
    {"visp-servo-compare", "--task F", "task.json"},
    {"visp-servo-compare", "--robot F", "arm.json"},
    {"visp-servo-compare", "--robot F", "arm.urdf"},
    {"visp-servo-compare", "--target F", "photo.png"},
    {"visp-track-pattern", "F", "image.png"},
    {"visp-track-pattern", "F", "video.mp4"},
    {"visp-track-pattern", VISP_DIRECT_DATA_DIR "/target/box.png --calibration F", "calibration.json"},
    {"visp-track-pattern", VISP_DIRECT_DATA_DIR "/target/box.png --calibration F", "calibration.xml"}};

//! With the files of the robot, which several programs take in the same way.
std::vector<Input> allInputs()
{
  std::vector<Input> all = ownInputs;
  const std::string robot = "'" VISP_DIRECT_DATA_DIR "/robot/generic-6r.urdf' --robot-tip tool ";
  for (const char *program :
       {"visp-arm", "visp-avoid-obstacle", "visp-plan-compare", "visp-servo", "visp-servo-compare"}) {
    const std::string before = (program == std::string("visp-arm") ? "" : "--robot ") + robot;
    all.push_back({program, before + "--srdf F", "arm.srdf"});
    all.push_back({program, before + "--joint-limits F", "limits.yaml"});
    all.push_back({program, before + "--allowed-pairs F", "pairs.json"});
  }
  return all;
}

const std::vector<Input> inputs = allInputs();

std::string replaced(std::string text, char mark, const std::string &by)
{
  const std::size_t at = text.find(std::string(" ") + mark);
  const std::size_t place = text[0] == mark ? 0 : at == std::string::npos ? at : at + 1;
  return place == std::string::npos ? text : text.replace(place, 1, "'" + by + "'");
}

//! What may lie where a good file should, and what the reader has to say of it; empty: whatever it is.
struct Fault {
  std::string name;
  std::function<void(const std::string &)> make;
  std::string sentence;
};

std::string deep(const std::string &opening)
{
  std::string text;
  for (int i = 0; i < 1000000; ++i) {
    text += opening;
  }
  return text;
}

std::vector<Fault> faults()
{
  const auto text = [](const std::string &content) {
    return [content](const std::string &file) { std::ofstream(file, std::ios::binary) << content; };
  };
  std::vector<Fault> all = {
      {"missing", [](const std::string &) {}, ": cannot be read (there is no such file)"},
      {"folder", [](const std::string &file) { std::filesystem::create_directory(file); },
       ": cannot be read (it is a folder)"},
      {"pipe that nobody writes to", [](const std::string &file) { REQUIRE(mkfifo(file.c_str(), 0600) == 0); },
       ": cannot be read (it is a pipe or a device)"},
      {"device", [](const std::string &file) { std::filesystem::create_symlink("/dev/zero", file); },
       ": cannot be read (it is a pipe or a device)"},
      {"link to itself", [](const std::string &file) { std::filesystem::create_symlink(file, file); },
       ": cannot be read (Too many levels of symbolic links)"},
      {"no bytes", text(""), ""},
      {"cut", text("{\"name\": \"x\", \"objects\": ["), ""},
      {"brackets", text(deep("[")), ""},
      {"objects", text(deep("{\"a\":")), ""},
      {"elements", text(deep("<a>")), ""},
      {"no number", text("{\"name\": NaN}"), ""},
      {"infinity", text("{\"name\": 1e999}"), ""},
      {"control characters", text("{\"\x1b[31mred\x07\": 1}"), ""},
      {"escaped control characters", text("{\"\\u001b[31mred\\u0007\": 1}"), ""},
      {"zeros", text(std::string(5000, '\0')), ""},
      {"another format", text("<!DOCTYPE html><html>\x1b[31m</html>"), ""}};
  if (geteuid() != 0) { // root may read everything
    all.push_back({"no permission",
                   [](const std::string &file) {
                     std::ofstream(file, std::ios::binary) << "{}";
                     std::filesystem::permissions(file, std::filesystem::perms::none);
                   },
                   ": cannot be read (Permission denied)"});
  }
  return all;
}

//! A grey picture as PNG, cut, or with another size in its header.
std::vector<Fault> pictureFaults()
{
  std::vector<unsigned char> bytes;
  REQUIRE(cv::imencode(".png", cv::Mat(64, 64, CV_8UC1, cv::Scalar(99)), bytes));
  const std::string good(bytes.begin(), bytes.end());
  std::string huge = good;
  huge.replace(16, 8, std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff", 8));
  const auto text = [](const std::string &content) {
    return [content](const std::string &file) { std::ofstream(file, std::ios::binary) << content; };
  };
  return {{"cut picture", text(good.substr(0, good.size() / 2)), ""}, {"huge picture", text(huge), ""}};
}
} // namespace

// Whatever is wrong with a file is a matter of the data: status 1, one sentence that names it, in a bounded time, and nothing
// written. The readers have their own tests, so here every third fault in turn is enough, every sixth of two runs; the seed
// shifts them, VISP_DIRECT_LONG_TESTS=3 takes all.
TEST_CASE("Files that are missing or wrong", "[programs]")
{
  unsigned int turn = vpTestSupport::seed();
  const unsigned int turns = static_cast<unsigned int>(std::max(1, 6 / vpTestSupport::longer(2)));
  for (const Input &input : inputs) {
    const auto program = std::find_if(programs.begin(), programs.end(),
                                      [&](const std::string &path) { return nameOf(path) == input.program; });
    if (program == programs.end()) {
      continue;
    }
    std::vector<Fault> all = faults();
    if (has(input.file, ".png")) {
      const std::vector<Fault> more = pictureFaults();
      all.insert(all.end(), more.begin(), more.end());
    }
    for (const Fault &fault : all) {
      if (++turn % turns != 0) {
        continue;
      }
      if (input.program == "visp-plan-trajectory" && has(fault.sentence, "pipe")) {
        continue; // it reads them, until Ctrl-C; see catchPlanTrajectoryProgram
      }
      const TestFolder folder;
      fault.make(folder.file(input.file));
      ProgramRun run(*program);
      const std::string arguments =
          replaced(replaced(input.arguments, 'F', folder.file(input.file)), 'D', folder.path.string());
      CAPTURE(input.program, arguments, fault.name);
      CHECK(run(arguments, "timeout 60") == 1);
      CAPTURE(run.err());
      CHECK(run.err().find(nameOf(*program) + ": ") == 0);
      const bool isSource = input.arguments == (input.program == "visp-servo" ? "--camera F" : "F");
      const bool ownSentence = isSource && (input.program == "visp-track-pattern" || input.program == "visp-servo") &&
                               (fault.name == "missing" || fault.name == "folder"); // it takes folders, too
      CHECK(has(run.err(), input.file + (ownSentence ? ": " : fault.sentence)));
      CHECK(std::count(run.err().begin(), run.err().end(), '\n') == 1);
      CHECK(
          std::none_of(run.err().begin(), run.err().end(), [](char c) { return c != '\n' && (c < ' ' || c == 127); }));
      CHECK((run.out().empty() || input.program == "visp-plan-trajectory")); // which answers line by line
      CHECK(run.entries().empty());
    }
  }
}

TEST_CASE("Every option that reads a file is among those that are tried", "[programs]")
{
  for (const std::string &program : programs) {
    ProgramRun run(program);
    REQUIRE(run("--help") == 0);
    std::istringstream help(run.out());
    for (std::string line; std::getline(help, line);) {
      std::istringstream words(line);
      std::string option, value;
      words >> option >> value;
      const bool reads = (value.find("FILE") == 0 || value == "DIR" || value == "IMAGE") && option.find("--") == 0 &&
                         option != "--out" && option != "--write-pairs" && option != "--cover-file" &&
                         option != "--csv" && option != "--teach";
      CAPTURE(program, line);
      CHECK((!reads || std::any_of(inputs.begin(), inputs.end(), [&](const Input &input) {
        return input.program == nameOf(program) && has(input.arguments, option + " ");
      })));
    }
  }
}
