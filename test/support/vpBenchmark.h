/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpBenchmark.h
 * \brief The main of the benchmarks. Google Benchmark aborts when writing CSV if a later benchmark has counters
 * that the first one lacks; here the columns are those of all benchmarks.
 */
#ifndef vpBenchmark_h
#define vpBenchmark_h

#include <benchmark/benchmark.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

namespace vpTestSupport
{
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations" // will be removed, and --benchmark_format=csv with it
#endif
//! \brief Waits for the last benchmark, then gives each the counters of all, NaN where missing.
class WholeCsv : public benchmark::CSVReporter
{
public:
  void ReportRuns(const std::vector<Run> &runs) override { m_runs.insert(m_runs.end(), runs.begin(), runs.end()); }
  void Finalize() override
  {
    std::set<std::string> names;
    for (const Run &run : m_runs) {
      for (const auto &counter : run.counters) {
        names.insert(counter.first);
      }
    }
    for (Run &run : m_runs) {
      for (const std::string &name : names) {
        run.counters.emplace(name, std::numeric_limits<double>::quiet_NaN());
      }
    }
    if (!m_runs.empty()) {
      CSVReporter::ReportRuns(m_runs);
    }
  }

private:
  std::vector<Run> m_runs;
};
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

//! Runs the registered benchmarks according to the command line. \return Exit status: 2 for an invalid command line.
inline int runBenchmarks(int argc, char **argv)
{
  bool csv = false, csvFile = false;
  for (int i = 1; i < argc; ++i) {
    csv = csv || std::string(argv[i]) == "--benchmark_format=csv";
    csvFile = csvFile || std::string(argv[i]) == "--benchmark_out_format=csv";
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 2;
  }
  WholeCsv display, file;
  benchmark::RunSpecifiedBenchmarks(csv ? &display : nullptr, csvFile ? &file : nullptr);
  return 0;
}
} // namespace vpTestSupport

//! Replaces BENCHMARK_MAIN().
#define VP_BENCHMARK_MAIN()                                                                                            \
  int main(int argc, char **argv) { return vpTestSupport::runBenchmarks(argc, argv); }                                 \
  static_assert(true, "a semicolon follows")

#endif
