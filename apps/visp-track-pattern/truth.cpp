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

namespace
{
constexpr double FAR = 2.; // px; larger errors are not caused by noise or bias

const vpPatternTruthCell *nearest(const FrameTruth &truth, double x, double y, double within)
{
  const vpPatternTruthCell *best = nullptr;
  for (const vpPatternTruthCell &cell : truth.cells) {
    const double distance = std::hypot(cell.x - x, cell.y - y);
    if (distance < within) {
      within = distance;
      best = &cell;
    }
  }
  return best;
}
} // namespace

void Comparison::add(const vpPatternFrame &frame, const FrameTruth &truth, double left, double top, FrameRecord &record,
                     RunResults &results)
{
  results.hasTruth = true;
  TruthErrors &errors = frame.status == vpPatternStatus::Acquiring ? results.acquiring : results.tracking;
  const double within = 0.5 * std::min(frame.lattice.columnPitch(), frame.lattice.rowPitch());
  for (const vpPatternCell &cell : frame.cells) {
    if (!cell.valid) {
      continue;
    }
    const vpPatternTruthCell *match = nearest(truth, cell.x + left, cell.y + top, within);
    if (match == nullptr) {
      ++errors.noCell;
      continue;
    }
    const double ex = cell.x + left - match->x, ey = cell.y + top - match->y;
    const auto name =
        m_names.emplace(std::make_tuple(frame.epoch, cell.row, cell.column), std::make_pair(match->row, match->column));
    errors.slips += name.first->second != std::make_pair(match->row, match->column) ? 1 : 0;
    if (std::hypot(ex, ey) > FAR) {
      ++errors.far; // would dominate the statistics
      continue;
    }
    errors.x.add(ex, cell.sigmaX);
    errors.y.add(ey, cell.sigmaY);
  }
  if (m_before) {
    record.trueDx = truth.x - m_before->x;
    record.trueDy = truth.y - m_before->y;
    if (frame.hasMotion) {
      errors.dx.add(frame.dx - record.trueDx, frame.sigmaDx);
      errors.dy.add(frame.dy - record.trueDy, frame.sigmaDy);
    }
  }
  m_before = truth;
}
} // namespace trackPattern
