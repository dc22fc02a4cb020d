/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Result folders: complete results, one run at a time, leftovers of killed runs, and untouched user files.
#include "vpCatch.h"

#include "testFolder.h"

#include "jsonReader.h"
#include "outputFolder.h"

#include <functional>
#include <random>

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
using vpApp::OutputFolder;

//! One complete run of the program "prog".
void finish(const std::string &wanted, const std::vector<std::string> &names, const std::string &content = "x")
{
  OutputFolder out("prog", wanted);
  for (const std::string &name : names) {
    out.write(name, content);
  }
  out.writeSummary({{"runs", 1}});
  out.commit();
}

std::vector<std::string> entriesOf(const fs::path &folder)
{
  std::vector<std::string> names;
  for (const fs::directory_entry &entry : fs::recursive_directory_iterator(folder)) {
    names.push_back(entry.path().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string complaintOf(const std::string &wanted, const std::string &program = "prog")
{
  return complaint([&] { OutputFolder(program, wanted); });
}

bool has(const std::string &text, const std::string &piece) { return text.find(piece) != std::string::npos; }

//! A child process that runs \e body and then waits to be killed.
pid_t inChild(const std::function<void()> &body)
{
  const pid_t child = fork();
  if (child == 0) {
    try {
      body();
    }
    catch (...) {
      _exit(1);
    }
    pause();
    _exit(0);
  }
  return child;
}

void killAndWait(pid_t child)
{
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}
} // namespace

TEST_CASE("A result appears with its summary, and the program may replace its own", "[apps][output]")
{
  const TestFolder folder;
  const std::string wanted = (folder.path / "deep" / "out").string();

  SECTION("nothing is left without commit, not even the parent folder")
  {
    {
      OutputFolder out("prog", wanted);
      out.write("video/a.txt", "a");
      CHECK_FALSE(fs::exists(wanted + "/video"));
    }
    CHECK(folder.entries().empty());
  }
  SECTION("an earlier result stays whole until commit")
  {
    finish(wanted, {"a.txt"}, "first");
    {
      OutputFolder out("prog", wanted);
      out.write("a.txt", "second");
      CHECK(vpApp::readFile(wanted + "/a.txt") == "first");
    }
    CHECK(entriesOf(wanted) == std::vector<std::string>{"a.txt", "summary.json"});
    CHECK(vpApp::readFile(wanted + "/a.txt") == "first");
  }
  SECTION("files of the earlier run are replaced or removed")
  {
    finish(wanted + "/", {"video/a.txt", "b.txt"}, "first");
    finish(wanted, {"b.txt", "c/d/e.txt"}, "second");
    CHECK(entriesOf(wanted) == std::vector<std::string>{"b.txt", "c", "c/d", "c/d/e.txt", "summary.json"});
    CHECK(vpApp::readFile(wanted + "/b.txt") == "second");
    const nlohmann::json summary = vpApp::readJsonFile(wanted + "/summary.json");
    CHECK(summary == nlohmann::json({{"runs", 1},
                                     {"program", "prog"},
                                     {"status", "complete"},
                                     {"files", {"b.txt", "c/d/e.txt", "summary.json"}}}));
  }
  SECTION("an empty folder is used, one of somebody else is left alone")
  {
    fs::create_directories(wanted);
    finish(wanted, {});
    CHECK(has(complaintOf(wanted, "other"), wanted + ": is not empty and not a result of other"));
    fs::remove(wanted + "/summary.json");
    folder.write("deep/out/thesis.txt", "years of work");
    CHECK(has(complaintOf(wanted), "is left alone"));
    const std::string deep = "{\"program\": " + std::string(1000000, '[') + std::string(1000000, ']') + "}";
    for (const std::string &summary : {std::string("{\"program\": 3"), std::string("[]"), std::string("{}"),
                                       std::string("{\"program\": [\"prog\"]}"), deep}) {
      folder.write("deep/out/summary.json", summary);
      CHECK(has(complaintOf(wanted), "is left alone"));
    }
    CHECK(entriesOf(wanted) == std::vector<std::string>{"summary.json", "thesis.txt"});
  }
  SECTION("places that cannot be written are named before anything is computed")
  {
    const std::string file = folder.write("file", "");
    CHECK(complaintOf(file) == file + ": exists and is not a folder");
    CHECK(has(complaintOf(file + "/out"), file + "/out: cannot be written"));
    CHECK(has(complaintOf("/proc/out"), "/proc/out: cannot be written"));
    fs::create_symlink("nowhere", folder.path / "link");
    CHECK(has(complaintOf((folder.path / "link").string()), "is a symbolic link to nowhere, which does not exist"));
  }
}

TEST_CASE("Nothing of the user's in a result folder is touched", "[apps][output]")
{
  const TestFolder folder;
  const std::string real = (folder.path / "real").string();
  const std::string wanted = (folder.path / "link").string();
  finish(real, {"a.txt", "figure/b.txt", "old.txt", "figure/old.txt"}, "first");
  fs::create_directory_symlink("real", wanted);

  folder.write("real/my-notes.txt", "mine");
  folder.write("real/figure/mine.txt", "mine");
  fs::create_directories(real + "/empty/deep");
  fs::create_symlink("/etc/hostname", real + "/my-link");
  REQUIRE(mkfifo((real + "/my-fifo").c_str(), 0600) == 0);
  REQUIRE(chmod(real.c_str(), 0750) == 0);
  finish(wanted, {"a.txt", "figure/b.txt"}, "second");

  CHECK(fs::is_symlink(wanted));
  CHECK(fs::status(real).permissions() == static_cast<fs::perms>(0750));
  CHECK(vpApp::readFile(real + "/my-notes.txt") == "mine");
  CHECK(fs::read_symlink(real + "/my-link") == "/etc/hostname");
  CHECK(fs::is_fifo(real + "/my-fifo"));
  CHECK(entriesOf(real) == std::vector<std::string>{"a.txt", "empty", "empty/deep", "figure", "figure/b.txt",
                                                    "figure/mine.txt", "my-fifo", "my-link", "my-notes.txt",
                                                    "summary.json"});

  SECTION("what has the name of a file of the result is named, and stays")
  {
    const auto writing = [&](const std::string &name) {
      return complaint([&] {
        OutputFolder out("prog", wanted);
        out.write(name, "third");
      });
    };
    const std::string moveIt =
        ": is not of an earlier run but has the name of a file of the result, so it is left alone";
    for (const char *name : {"my-notes.txt", "my-fifo", "my-link", "empty"}) {
      CHECK(has(writing(name), std::string(name) + moveIt));
    }
    CHECK(has(writing("my-link/a.txt"), "my-link" + moveIt));
    CHECK(has(writing("a.txt/b.txt"), "a.txt" + moveIt));
    CHECK(vpApp::readFile(real + "/a.txt") == "second");
  }
  SECTION("what came in the way while the program computed stops the commit before anything is moved")
  {
    OutputFolder out("prog", wanted);
    out.write("a.txt", "third");
    out.write("new.txt", "third");
    out.writeSummary({});
    folder.write("real/new.txt", "mine");
    CHECK(has(complaint([&] { out.commit(); }), "new.txt: is not of an earlier run"));
    CHECK(vpApp::readFile(real + "/new.txt") == "mine");
    CHECK(vpApp::readFile(real + "/a.txt") == "second");
  }
  SECTION("a file of the result that became a link is not followed")
  {
    const std::string precious = folder.write("precious.txt", "mine");
    fs::remove(real + "/a.txt");
    fs::create_symlink(precious, real + "/a.txt");
    folder.write("elsewhere/b.txt", "mine");
    fs::remove_all(real + "/figure");
    fs::create_directory_symlink(folder.path / "elsewhere", real + "/figure");
    finish(wanted, {"other.txt"});
    CHECK(vpApp::readFile(precious) == "mine");
    CHECK(fs::is_symlink(real + "/a.txt"));
    CHECK(vpApp::readFile(folder.path / "elsewhere/b.txt") == "mine");
  }
  SECTION("a summary that was edited does not lead out of the folder")
  {
    const std::string precious = folder.write("precious.txt", "mine");
    folder.write("real/summary.json",
                 nlohmann::json({{"program", "prog"}, {"files", {"../precious.txt", precious, "", ".", 7}}}).dump());
    finish(wanted, {"other.txt"});
    CHECK(vpApp::readFile(precious) == "mine");
  }
  SECTION("a folder with the name of the unfinished run is the user's")
  {
    folder.write("real/unfinished-run/run.txt", "mine");
    CHECK(has(complaintOf(wanted), "unfinished-run: is not a leftover of prog"));
    CHECK(vpApp::readFile(real + "/unfinished-run/run.txt") == "mine");
  }
  SECTION("a summary that is no plain file does not hold the program up")
  {
    fs::remove(real + "/summary.json");
    REQUIRE(mkfifo((real + "/summary.json").c_str(), 0600) == 0);
    CHECK(has(complaintOf(wanted), "is left alone"));
  }
}

TEST_CASE("A summary takes what was typed, whatever the bytes", "[apps][output]")
{
  const TestFolder folder;
  const std::string wanted = (folder.path / "out").string();
  {
    OutputFolder out("prog", wanted);
    out.writeSummary({{"command", "prog --scene \xff.json"}});
    out.commit();
  }
  CHECK(vpApp::readJsonFile(wanted + "/summary.json")["command"] == "prog --scene \xef\xbf\xbd.json");
}

TEST_CASE("Two runs into one folder: the second says so at once", "[apps][output]")
{
  const TestFolder folder;
  const std::string wanted = (folder.path / "out").string();
  for (int round = 0; round < 2; ++round) { // into a new folder, then over an earlier result
    CAPTURE(round);
    OutputFolder first("prog", wanted);
    first.write("a.txt", "first");
    CHECK(complaintOf(wanted) ==
          wanted + ": another run of prog is writing into it; wait for its end or name another folder");
    first.writeSummary({});
    first.commit();
    CHECK(vpApp::readFile(wanted + "/a.txt") == "first");
  }
}

TEST_CASE("Data are kept when a run fails, and marked as unfinished", "[apps][output]")
{
  const TestFolder folder;
  const std::string wanted = (folder.path / "out").string();
  finish(wanted, {"cells.csv"}, "complete");
  {
    OutputFolder out("prog", wanted);
    std::ofstream rows(out.file("cells.csv"));
    rows << "frame,x\n" << std::flush;
    CHECK(vpApp::readFile(wanted + "/unfinished-run/cells.csv") == "frame,x\n"); // can be watched
    rows << "0,1.5\n";
    rows.close();
    CHECK(out.keepUnfinished("the camera is gone") == "the data so far are in " + wanted + "/unfinished-run");
  }
  CHECK(vpApp::readFile(wanted + "/cells.csv") == "complete");
  CHECK(vpApp::readFile(wanted + "/unfinished-run/cells.csv") == "frame,x\n0,1.5\n");
  const nlohmann::json summary = vpApp::readJsonFile(wanted + "/unfinished-run/summary.json");
  CHECK(summary["status"] == "unfinished");
  CHECK(summary["reason"] == "the camera is gone");

  finish(wanted, {"cells.csv"}, "again");
  CHECK(entriesOf(wanted) == std::vector<std::string>{"cells.csv", "summary.json"});
}

TEST_CASE("The next run removes what a killed one left, whenever it was killed", "[apps][output]")
{
  const TestFolder folder;
  const std::string wanted = (folder.path / "out").string();
  SECTION("while it computed, in a new folder")
  {
    const pid_t child = inChild([&] {
      const auto out = std::make_unique<OutputFolder>("prog", wanted);
      out->write("video/a.txt", "a");
      pause();
    });
    while (!fs::exists(wanted + "/unfinished-run/video/a.txt")) {
      usleep(1000);
    }
    CHECK(has(complaintOf(wanted), "another run of prog is writing into it"));
    killAndWait(child);
    CHECK(has(complaintOf(wanted, "other"), "not a result of other"));
    finish(wanted, {"b.txt"});
    CHECK(entriesOf(wanted) == std::vector<std::string>{"b.txt", "summary.json"});
  }
  SECTION("at any moment of a run that replaces a result")
  {
    // Two results with different files; the child creates them in turn until it is killed.
    std::vector<std::string> even{"common.txt"}, odd{"common.txt"};
    for (int i = 0; i < 20; ++i) {
      even.push_back("even/" + std::to_string(i) + "/a.txt");
      odd.push_back("odd-" + std::to_string(i) + ".txt");
    }
    finish(wanted, odd);
    folder.write("out/my-notes.txt", "mine");
    fs::create_directory(wanted + "/even"); // user folder, empty until the program uses it
    const fs::path ready = folder.path / "ready";
    int unfinished = 0, complete = 0;
    std::mt19937_64 random = vpTestSupport::generator();
    for (int round = 0; round < 60; ++round) {
      fs::remove(ready);
      const pid_t child = inChild([&] {
        std::ofstream(ready).close();
        for (int i = 0;; ++i) {
          finish(wanted, i % 2 == 0 ? even : odd);
        }
      });
      while (!fs::exists(ready)) {
        usleep(100);
      }
      usleep(std::uniform_int_distribution<useconds_t>(0, 10000)(random));
      killAndWait(child);
      const nlohmann::json summary = vpApp::readJsonFile(wanted + "/summary.json");
      if (summary["status"] == "complete") {
        ++complete;
        for (const nlohmann::json &name : summary["files"]) {
          CHECK(fs::exists(fs::path(wanted) / name.get<std::string>()));
        }
      }
      else {
        ++unfinished;
        CHECK(summary["status"] == "unfinished");
      }
      finish(wanted, {"last.txt"});
      std::vector<std::string> left = entriesOf(wanted);
      left.erase(std::remove(left.begin(), left.end(), "even"), left.end());
      CHECK(left == std::vector<std::string>{"last.txt", "my-notes.txt", "summary.json"});
    }
    CAPTURE(unfinished, complete);
    CHECK(complete > 0);
  }
}

namespace
{
/*!
 * Run \e body in a child process with private mounts and a tiny file system at \e place.
 * \return The result of \e body, or "not permitted".
 */
std::string onOwnFileSystem(const fs::path &place, const std::string &options, unsigned long flags,
                            const std::function<std::string()> &body)
{
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    std::string answer = "not permitted";
    const bool own = unshare(CLONE_NEWNS) == 0 || unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0;
    if (own && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
        mount("none", place.c_str(), "tmpfs", flags, options.c_str()) == 0) {
      answer = body();
    }
    const ssize_t written = write(ends[1], answer.data(), answer.size());
    _exit(written == static_cast<ssize_t>(answer.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string answer(4096, '\0');
  const ssize_t size = read(ends[0], answer.data(), answer.size());
  close(ends[0]);
  waitpid(child, nullptr, 0);
  answer.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return answer;
}
} // namespace

TEST_CASE("A mount point may be the result folder; a full or read-only one is refused at once", "[apps][output]")
{
  const TestFolder folder;
  const fs::path place = folder.path / "mount";
  fs::create_directory(place);
  const std::string wanted = place.string();
  const std::string mounted = onOwnFileSystem(place, "size=1m", 0, [&] {
    finish(wanted, {"a.txt"}, "first");
    finish(wanted, {"a.txt"}, "second");
    return vpApp::readFile(wanted + "/a.txt");
  });
  if (mounted == "not permitted") {
    vpTestSupport::skip("this system does not permit file systems of one's own");
    return;
  }
  CHECK(mounted == "second");
  CHECK(onOwnFileSystem(place, "size=4k", 0, [&] {
          std::ofstream(place / "full") << std::string(8192, 'x');
          return complaintOf(wanted + "/out") + (fs::exists(place / "out") ? " and leaves a folder" : "");
        }) == wanted + "/out: cannot be written (No space left on device)");
  CHECK(has(onOwnFileSystem(place, "size=1m", MS_RDONLY, [&] { return complaintOf(wanted + "/out"); }),
            wanted + "/out: cannot be written (Read-only file system)"));
  CHECK(has(onOwnFileSystem(place, "size=1m", MS_RDONLY, [&] { return complaintOf(wanted); }),
            wanted + ": cannot be written (Read-only file system)"));
  // The disk fills up during the run: the data so far are kept.
  CHECK(onOwnFileSystem(place, "size=64k", 0, [&] {
          const std::string error = complaint([&] {
            OutputFolder out("prog", wanted);
            try {
              out.write("rows.csv", "0,1\n");
              out.write("large.csv", std::string(100000, 'x'));
            }
            catch (const std::exception &failure) {
              (void)out.keepUnfinished(failure.what());
              throw;
            }
          });
          return error + "; " + vpApp::readFile(wanted + "/unfinished-run/rows.csv");
        }) == wanted + "/large.csv: cannot be written; 0,1\n");
}
