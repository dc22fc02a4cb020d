/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file trackPatternRun.h
 * \brief The program visp-track-pattern as run by users, and what it writes.
 */
#ifndef trackPattern_test_trackPatternRun_h
#define trackPattern_test_trackPatternRun_h

#include "vpCatch.h"

#include "programRun.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace trackPatternRun
{
using nlohmann::json;

constexpr int OK = 0, DATA = 1, USAGE = 2; // exit status

//! Reports are tested with Python; where this file asks for one it sets the variable back.
[[maybe_unused]] inline const int noReports = setenv("VISP_DIRECT_PYTHON", "none", 1);

//! \brief A table with a heading.
struct Table {
  std::vector<std::string> heading;
  std::vector<std::map<std::string, std::string>> lines;
};

inline std::vector<std::string> split(const std::string &line)
{
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) {
    parts.push_back(part);
  }
  return parts;
}

//! A CSV file in the folder of \e run.
inline Table tableIn(const ProgramRun &run, const std::string &file)
{
  Table table;
  std::istringstream stream(vpApp::readFile(run.path(file)));
  std::string line;
  std::getline(stream, line);
  table.heading = split(line);
  while (std::getline(stream, line)) {
    const std::vector<std::string> parts = split(line);
    REQUIRE(parts.size() == table.heading.size());
    table.lines.emplace_back();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      table.lines.back()[table.heading[i]] = parts[i];
    }
  }
  return table;
}

inline double number(const std::map<std::string, std::string> &line, const std::string &name)
{
  return std::stod(line.at(name));
}

inline json jsonIn(const ProgramRun &run, const std::string &file)
{
  return json::parse(vpApp::readFile(run.path(file)));
}
inline json summaryIn(const ProgramRun &run, const std::string &folder)
{
  return jsonIn(run, folder + "/summary.json");
}

//! Name of an image of visp-generate-pattern.
inline std::string imageName(int i) { return (i < 10 ? "00000" : "0000") + std::to_string(i) + ".png"; }

//! A sequence of visp-generate-pattern in the folder of \e run.
inline void generate(const ProgramRun &run, const std::string &arguments)
{
  const std::string command =
      "cd '" + run.path("").string() + "' && '" GENERATE_PATTERN "' " + arguments + " >/dev/null 2>&1";
  REQUIRE(std::system(command.c_str()) == 0);
}
} // namespace trackPatternRun

#endif
