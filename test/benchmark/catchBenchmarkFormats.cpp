/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// The benchmarks run in every output format, whatever their counters.
#include "vpBenchmark.h"
#include "vpCatch.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;

std::string contentOf(const fs::path &file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void without(benchmark::State &state)
{
  for (auto _ : state) {
  }
}

void with(benchmark::State &state, const char *counter)
{
  without(state);
  state.counters[counter] = 7.;
}

//! Exit status of a run in a process of its own, as Google Benchmark expects; -1 when it ended by a signal.
int runApart(std::vector<std::string> arguments, const std::string &shown)
{
  const pid_t child = fork();
  if (child == 0) {
    std::vector<char *> argv;
    for (std::string &argument : arguments) {
      argv.push_back(argument.data());
    }
    const bool open = std::freopen(shown.c_str(), "w", stdout) != nullptr;
    const int result = vpTestSupport::runBenchmarks(static_cast<int>(argv.size()), argv.data());
    std::cout.flush();
    std::fflush(stdout);
    _exit(open ? result : 99);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

//! Each data row has as many fields as the heading, which ends with both counters.
void checkTable(const std::string &csv)
{
  std::istringstream stream(csv);
  std::string heading, line;
  while (std::getline(stream, heading) &&
         heading.rfind("name,", 0) != 0) { // what the machine is comes before, in a file
  }
  CHECK(heading.find(",\"first\",\"second\"") != std::string::npos);
  std::vector<std::string> ends;
  while (std::getline(stream, line)) {
    CHECK(std::count(line.begin(), line.end(), ',') == std::count(heading.begin(), heading.end(), ','));
    const std::size_t last = line.rfind(','), before = line.rfind(',', last - 1);
    ends.push_back(line.substr(before));
  }
  CHECK(ends == std::vector<std::string>{",nan,nan", ",7,nan", ",nan,7"});
}
} // namespace

TEST_CASE("benchmarks of which the first has no counters are written in every format", "[benchmark]")
{
  std::string name = (fs::temp_directory_path() / "visp-direct-benchmark-XXXXXX").string();
  const fs::path folder = mkdtemp(name.data());
  benchmark::RegisterBenchmark("none", without)->Iterations(3);
  benchmark::RegisterBenchmark("one", with, "first")->Iterations(3);
  benchmark::RegisterBenchmark("another", with, "second")->Iterations(3);
  for (const std::string format : {"csv", "json", "console"}) {
    CAPTURE(format);
    const std::string file = (folder / format).string();
    std::vector<std::string> arguments = {"perf", "--benchmark_format=" + format, "--benchmark_out=" + file,
                                          "--benchmark_out_format=" + format};
    const std::string shown = (folder / "stdout").string();
    const int status = runApart(arguments, shown);
    CHECK(status == 0);
    CHECK(contentOf(file).find("another") != std::string::npos);
    if (format == "csv") {
      checkTable(contentOf(file));
      checkTable(contentOf(shown));
    }
  }
  benchmark::ClearRegisteredBenchmarks();
  fs::remove_all(folder);
}

TEST_CASE("every benchmark program has this main", "[benchmark]")
{
  int programs = 0;
  for (const fs::directory_entry &entry :
       fs::recursive_directory_iterator(fs::path(VISP_DIRECT_DATA_DIR).parent_path() / "modules")) {
    if (entry.path().extension() == ".cpp" && entry.path().parent_path().filename() == "benchmark") {
      CAPTURE(entry.path().filename().string());
      const std::string source = contentOf(entry.path());
      CHECK((source.find("VP_BENCHMARK_MAIN();") != std::string::npos ||
             source.find("vpTestSupport::runBenchmarks(argc, argv)") != std::string::npos));
      ++programs;
    }
  }
  CHECK(programs >= 10);
}
