/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Plant and gains of figures 7.12 to 7.15: the stored ones are those of the data file, which says what they miss.
#include "vpCatch.h"

#include "lab/printing/vpPrintFit.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace vpPrintFit;

namespace
{
//! \brief What the search of data/thesis/print-fit.csv was started with; environment variables change it.
struct SearchSpec {
  PoorFilter poor = storedPoor;
  int generations = 150, seeds = 2, seed = 1;

  static SearchSpec fromEnvironment()
  {
    const auto number = [](const char *name, int otherwise) {
      const char *const text = std::getenv(name);
      return text != nullptr ? std::atoi(text) : otherwise;
    };
    SearchSpec spec;
    spec.generations = number("FIT_GENERATIONS", spec.generations);
    spec.seeds = number("FIT_SEEDS", spec.seeds);
    spec.seed = number("FIT_SEED", spec.seed);
    const char *const poor = std::getenv("FIT_POOR");
    spec.poor = poor == nullptr                      ? storedPoor
                : std::string(poor) == "feedforward" ? PoorFilter::Feedforward
                                                     : PoorFilter::Pid;
    return spec;
  }
  //! First line of the file: the command that writes it again.
  [[nodiscard]] std::string command() const
  {
    return "# FIT_POOR=" + std::string(poor == PoorFilter::Pid ? "pid" : "feedforward") +
           " FIT_GENERATIONS=" + std::to_string(generations) + " FIT_SEEDS=" + std::to_string(seeds) +
           " FIT_SEED=" + std::to_string(seed) +
           " FIT_OUT=data/thesis/print-fit.csv build/release/bin/catchPrintFit \"[.fit]\"\n";
  }
};

//! Searches and returns the whole file.
std::string searched(const SearchSpec &spec)
{
  const Result result = search(spec.poor, spec.generations, spec.seeds, static_cast<unsigned int>(spec.seed),
                               [](int generation, double cost) {
                                 if (generation % 10 == 0) {
                                   std::cerr << "generation " << generation << ": " << cost << '\n';
                                 }
                                 return true;
                               });
  std::ostringstream text;
  text << spec.command() << "# figure 7.15 with the controller of figure "
       << (spec.poor == PoorFilter::Pid ? "7.13" : "7.14") << ": " << result.evaluations << " evaluations, cost "
       << result.cost << " with " << spec.seeds
       << " seeds (1 of figure 7.12) and 4 parts of a frame; the statements below are with 8 seeds and 32 parts\n"
       << csvOf(result.values, spec.poor, 8);
  return text.str();
}

//! Cells of the lines that begin with a name; comments are left out.
std::vector<std::vector<std::string>> linesOf(std::istream &text)
{
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line[0] == '#') {
      continue;
    }
    lines.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ';');) {
      lines.back().push_back(cell);
    }
  }
  return lines;
}
} // namespace

TEST_CASE("The stored plant and gains are those of data/thesis/print-fit.csv, with its residuals", "[print]")
{
  std::ifstream file(VISP_DIRECT_DATA_DIR "/thesis/print-fit.csv");
  REQUIRE(file.good());
  const std::string text = csvOf(stored(), storedPoor, 8);
  std::cout << text;
  std::istringstream now(text);
  const auto kept = linesOf(file), made = linesOf(now);
  REQUIRE(kept.size() == made.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    CAPTURE(i, kept[i][0]);
    REQUIRE(kept[i].size() == made[i].size());
    for (std::size_t k = 0; k < kept[i].size(); ++k) {
      char *end = nullptr;
      const double number = std::strtod(kept[i][k].c_str(), &end);
      if (end != kept[i][k].c_str() && *end == '\0') { // a number: friction amplifies rounding
        CHECK(std::stod(made[i][k]) == Approx(number).epsilon(0.01).margin(0.05));
      }
      else {
        CHECK(made[i][k] == kept[i][k]);
      }
    }
  }
}

TEST_CASE("Other seeds than those of the search say the same", "[print]")
{
  auto rng = vpTestSupport::generator(771);
  const auto first = std::uniform_int_distribution<unsigned int>(100, 100000)(rng);
  CAPTURE(vpTestSupport::seed(), first);
  for (const Statement &s : statementsOf(figuresOf(stored(), storedPoor), 6, first)) {
    CAPTURE(s.name, s.thesis, s.ours, s.scale);
    CHECK(std::fabs(s.residual) <
          6.); // of six seeds, the search had two; of 30 seeds here the largest was 3.8, the next 2.5
  }
}

TEST_CASE("A residual is the distance in units of its scale, and 0 on the good side of a bound", "[print]")
{
  const std::vector<Statement> all = statementsOf(figuresOf(stored(), storedPoor), 1);
  double cost = 0.;
  for (const Statement &s : all) {
    CAPTURE(s.name, s.thesis, s.ours);
    CHECK(s.scale > 0.);
    CHECK(((s.residual == 0. && s.ours != s.thesis) ||
           std::fabs(s.residual) == Approx(std::fabs(s.ours - s.thesis) / s.scale)));
    cost += s.residual * s.residual;
  }
  CHECK(costOf(all) == Approx(cost));
  // Another stage, other statements: the fit depends on what it fits.
  Eigen::VectorXd other = stored();
  other(0) *= 2.; // viscous friction
  CHECK(costOf(statementsOf(figuresOf(other, storedPoor), 1)) > cost);
  CHECK_THROWS_WITH(figuresOf(Eigen::VectorXd::Zero(3), storedPoor), Catch::Contains("has 3 numbers, must have 19"));
}

TEST_CASE("The file's first line is the command that writes it", "[print]")
{
  std::ifstream file(VISP_DIRECT_DATA_DIR "/thesis/print-fit.csv");
  std::string line;
  REQUIRE(std::getline(file, line));
  CHECK(line + '\n' == SearchSpec().command());
  // A search that hardly searches is the same again, and has all lines of the file.
  const SearchSpec brief{PoorFilter::Pid, 2, 1, 5};
  const std::string text = searched(brief);
  CHECK((searched(brief) == text));
  std::istringstream made(text);
  std::ifstream kept(VISP_DIRECT_DATA_DIR "/thesis/print-fit.csv");
  CHECK(linesOf(made).size() == linesOf(kept).size());
  CHECK(text.substr(0, text.find('\n') + 1) == brief.command());
}

// Minutes. FIT_OUT is the file to be written; without it the text is printed.
TEST_CASE("Search plant and gains of figures 7.12 to 7.15", "[.fit]")
{
  const std::string text = searched(SearchSpec::fromEnvironment());
  if (const char *const name = std::getenv("FIT_OUT")) {
    std::ofstream file(name);
    file << text;
    CHECK(file.flush().good());
  }
  else {
    std::cout << text;
  }
}
