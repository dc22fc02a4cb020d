/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "truth.h"

#include "outputFolder.h"

#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace trackPattern
{
namespace
{
constexpr const char *TRUTH = "truth.csv";
constexpr const char *MOTION = "motion.csv";
constexpr double LARGEST = 1e9; // limit of all numbers, so that frames, rows and columns are exact integers

void forEachLine(const std::filesystem::path &file, const std::string &heading, std::size_t fields,
                 const std::function<void(const std::vector<double> &)> &take)
{
  std::istringstream stream(vpApp::readFile(file));
  std::string line;
  if (!std::getline(stream, line) || line != heading) {
    throw std::runtime_error(file.string() + ": begins with \"" + line.substr(0, 60) + "\", must be \"" + heading +
                             "\"");
  }
  for (std::size_t number = 2; std::getline(stream, line); ++number) {
    std::vector<double> values;
    std::istringstream parts(line);
    for (std::string part; std::getline(parts, part, ',');) {
      char *end = nullptr;
      const double value = std::strtod(part.c_str(), &end);
      if (part.empty() || *end != '\0' || !(std::fabs(value) <= LARGEST)) {
        break;
      }
      values.push_back(value);
    }
    if (values.size() != fields || values[0] < 0.) {
      throw std::runtime_error(file.string() + ":" + std::to_string(number) + ": is \"" + line.substr(0, 60) +
                               "\", must be " + std::to_string(fields) + " numbers (" + heading + ")");
    }
    take(values);
  }
}
} // namespace

bool TruthFiles::areIn(const std::filesystem::path &folder)
{
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / TRUTH, ignored) &&
         std::filesystem::is_regular_file(folder / MOTION, ignored);
}

TruthFiles::TruthFiles(const std::filesystem::path &folder)
{
  forEachLine(folder / MOTION, "frame,x,y,dx,dy", 5, [this](const std::vector<double> &values) {
    FrameTruth &frame = m_frames[static_cast<unsigned int>(values[0])];
    frame.x = values[1];
    frame.y = values[2];
  });
  forEachLine(folder / TRUTH, "frame,row,column,x,y,complete,defective", 7, [this](const std::vector<double> &values) {
    vpPatternTruthCell cell;
    cell.row = static_cast<int>(values[1]);
    cell.column = static_cast<int>(values[2]);
    cell.x = values[3];
    cell.y = values[4];
    cell.complete = values[5] != 0.;
    cell.defective = values[6] != 0.;
    m_frames[static_cast<unsigned int>(values[0])].cells.push_back(cell);
  });
}

std::optional<FrameTruth> TruthFiles::at(unsigned int frame) const
{
  const auto found = m_frames.find(frame);
  return found == m_frames.end() ? std::nullopt : std::optional<FrameTruth>(found->second);
}
} // namespace trackPattern
