/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Option --plugin with good and bad libraries.
#include "vpCatch.h"

#include "testFolder.h"

#include "appMain.h"
#include "commandLine.h"
#include "plugin.h"

#include <cstdlib>
#include <filesystem>

namespace
{
void parse(const std::vector<const char *> &arguments)
{
  vpApp::CommandLine line("prog", "About.", "Examples.");
  vpApp::addPluginOption(line, "laws");
  std::vector<const char *> all{"prog"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const bool run = line.parse(static_cast<int>(all.size()), all.data());
  REQUIRE(run);
}

std::string mark()
{
  const char *value = std::getenv("VISP_DIRECT_TEST_PLUGIN");
  return value == nullptr ? "" : value;
}
} // namespace

TEST_CASE("a plug-in is loaded and called while the command line is read", "[plugin]")
{
  unsetenv("VISP_DIRECT_TEST_PLUGIN");
  parse({});
  CHECK(mark().empty());
  parse({"--plugin", PLUGIN_GOOD});
  CHECK(mark() == "called");

  unsetenv("VISP_DIRECT_TEST_PLUGIN");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(std::filesystem::path(PLUGIN_GOOD).parent_path());
  parse({"--plugin", std::filesystem::path(PLUGIN_GOOD).filename().c_str()}); // a name without a slash is no search
  std::filesystem::current_path(before);
  CHECK(mark() == "called");
}

TEST_CASE("a bad plug-in is one sentence that names the file", "[plugin][errors]")
{
  using Catch::Contains;
  const TestFolder folder;
  folder.write("text.so", "no library");
  folder.write("empty.so", "");
  const std::string text = (folder.path / "text.so").string(), empty = (folder.path / "empty.so").string();
  const std::string cut = (folder.path / "cut.so").string(), directory = folder.path.string();
  std::filesystem::copy_file(PLUGIN_GOOD, cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 3);

  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"missing.so", "missing.so: no such file"},
      {directory, ": is not a file"},
      {text, "text.so: cannot be loaded: "},
      {empty, "empty.so: cannot be loaded: file too short"},
      {cut, "cut.so: cannot be loaded: its end is missing"},
      {PLUGIN_WITHOUT, "has no function vispDirectPlugin(), see visp3/direct_core/vpPlugin.h"},
      {PLUGIN_UNDEFINED, ": cannot be loaded: undefined symbol: "},
      {PLUGIN_THROWS, ": the licence has expired"},
      {PLUGIN_THROWS_INT, "vispDirectPlugin() threw something that is no std::exception"}};
  for (const auto &[file, sentence] : wrong) {
    CAPTURE(file);
    try {
      parse({"--plugin", PLUGIN_GOOD, "--plugin", file.c_str()});
      FAIL("was loaded");
    }
    catch (const vpApp::UsageError &) {
      FAIL("is no mistake of the command line");
    }
    catch (const std::runtime_error &error) {
      const std::string said = vpApp::sentenceOf(error);
      CHECK_THAT(said, Contains(sentence));
      CHECK(said.rfind(file, 0) == 0);
      CHECK(said.find('\n') == std::string::npos);
      CHECK(said.find(file, 1) == std::string::npos); // names the file once
    }
  }
  CHECK_THROWS_AS(parse({"--plugin"}), vpApp::UsageError);
  CHECK_THROWS_AS(parse({"--plugin", ""}), vpApp::UsageError);
}
