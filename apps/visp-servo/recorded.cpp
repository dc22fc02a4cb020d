/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "recorded.h"

#include "jsonReader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace visualServo
{
namespace
{
using Columns = std::vector<std::string>;

//! Lines of a CSV file with these columns first to last wanted; the cells are given in the order of \e wanted.
class Table
{
public:
  Table(const fs::path &file, const Columns &wanted) : m_file(file.string()), m_stream(vpOpenFile(file.string()))
  {
    std::string heading;
    std::getline(m_stream, heading);
    m_names = split(heading);
    for (const std::string &name : wanted) {
      const auto found =
          std::find_if(m_names.begin(), m_names.end(), [&name](const std::string &one) { return fits(one, name); });
      if (found == m_names.end()) {
        throw std::runtime_error(m_file + ": has no column " + name + ", so it is no recording of visp-servo");
      }
      m_places.push_back(static_cast<std::size_t>(found - m_names.begin()));
    }
  }
  bool next()
  {
    std::string line;
    if (!std::getline(m_stream, line) || m_stream.eof()) { // without its end the last line is cut
      return false;
    }
    ++m_line;
    m_cells = split(line);
    if (m_cells.size() < *std::max_element(m_places.begin(), m_places.end()) + 1) {
      throw std::runtime_error(place() + ": has " + std::to_string(m_cells.size()) + " fields, must have " +
                               std::to_string(m_names.size()));
    }
    return true;
  }
  [[nodiscard]] const std::string &text(std::size_t column) const { return m_cells[m_places[column]]; }
  //! NaN for an empty cell.
  [[nodiscard]] double number(std::size_t column) const
  {
    const std::string &cell = text(column);
    char *end = nullptr;
    const double value = cell.empty() ? NOTHING : std::strtod(cell.c_str(), &end);
    if (!cell.empty() && (*end != '\0' || !(std::fabs(value) < 1e12))) {
      throw std::runtime_error(place() + ": " + m_names[m_places[column]] + " is \"" + cell.substr(0, 40) +
                               "\", must be a number");
    }
    return value;
  }
  //! A whole number.
  [[nodiscard]] std::size_t count(std::size_t column) const
  {
    const double value = number(column);
    if (!(value >= 0. && value < 1e9)) {
      throw std::runtime_error(place() + ": " + m_names[m_places[column]] + " is \"" + text(column).substr(0, 40) +
                               "\", must be a whole number");
    }
    return static_cast<std::size_t>(value);
  }
  //! A pose of six columns; false if the first is empty.
  bool pose(std::size_t column, vpHomogeneousMatrix &M) const
  {
    if (text(column).empty()) {
      return false;
    }
    double v[6];
    for (std::size_t i = 0; i < 6; ++i) {
      v[i] = number(column + i);
    }
    M = vpHomogeneousMatrix(vpTranslationVector(v[0], v[1], v[2]), vpThetaUVector(v[3], v[4], v[5]));
    return true;
  }

private:
  //! What moves before a fixed camera is the end effector.
  static bool fits(const std::string &name, const std::string &wanted)
  {
    return name == wanted || (wanted.rfind("fMc_", 0) == 0 && name == "fMe_" + wanted.substr(4));
  }
  [[nodiscard]] std::string place() const { return m_file + ":" + std::to_string(m_line + 1); }
  // A sentence in quotes is the last cell and not wanted.
  static Columns split(const std::string &line)
  {
    Columns cells;
    std::size_t begin = 0;
    for (std::size_t comma = 0; comma != std::string::npos; begin = comma + 1) {
      comma = line.find(',', begin);
      cells.push_back(line.substr(begin, comma == std::string::npos ? comma : comma - begin));
    }
    return cells;
  }

  std::string m_file;
  std::ifstream m_stream;
  Columns m_names, m_cells;
  std::vector<std::size_t> m_places;
  std::size_t m_line = 0;
};

void addPose(Columns &columns, const std::string &prefix)
{
  for (const char *part : {"tx", "ty", "tz", "tux", "tuy", "tuz"}) {
    columns.push_back(prefix + part);
  }
}
} // namespace

Settings readSettings(const fs::path &folder)
{
  const std::string file = (folder / SETTINGS_FILE).string();
  const nlohmann::json content = vpApp::readJsonFile(file);
  vpApp::JsonObject object(content, file);
  const std::vector<std::string> texts = object.texts("settings");
  if (texts.size() % 2 != 0) {
    throw vpFileError(file + ": settings has " + std::to_string(texts.size()) +
                      " texts, must be names and values in turn");
  }
  Settings settings;
  for (std::size_t i = 0; i < texts.size(); i += 2) {
    settings.emplace_back(texts[i], texts[i + 1]);
  }
  return settings;
}

std::string settingsText(const Settings &settings)
{
  nlohmann::ordered_json texts = nlohmann::ordered_json::array();
  for (const auto &[name, value] : settings) {
    texts.push_back(name);
    texts.push_back(value);
  }
  return nlohmann::ordered_json{{"settings", texts}}.dump(2) + "\n";
}

void readCycles(const fs::path &folder, const std::function<void(const RecordedCycle &)> &take)
{
  Columns columns{"time_s", "status", "position_error_m", "rotation_error_rad"};
  addPose(columns, "fMc_");
  columns.insert(columns.end(), {"v_x", "v_y", "v_z", "v_wx", "v_wy", "v_wz"});
  Table table(folder / "log.csv", columns);
  while (table.next()) {
    RecordedCycle cycle;
    cycle.time = table.number(0);
    cycle.isIdle = table.text(1) == vpToString(vpVisualServoStatus::Idle);
    cycle.positionError = table.number(2);
    cycle.rotationError = table.number(3);
    vpHomogeneousMatrix fMc;
    cycle.hasCamera = table.pose(4, fMc);
    cycle.fMc = vpRigidTransform::fromHomogeneous(fMc);
    for (std::size_t i = 0; i < 6; ++i) {
      cycle.twist[i] = table.number(10 + i);
    }
    take(cycle);
  }
}

std::vector<RecordedImage> readImages(const fs::path &folder)
{
  Columns columns{"image", "capture_s", "seen_s", "found"};
  addPose(columns, "cMo_");
  Table table(folder / "images.csv", columns);
  std::vector<RecordedImage> images;
  while (table.next()) {
    if (table.text(0).empty()) {
      continue;
    }
    RecordedImage image;
    image.index = table.count(0);
    image.capture = table.number(1);
    image.seen = table.number(2);
    image.found = table.text(3) == "1" && table.pose(4, image.cMo);
    images.push_back(image);
  }
  return images;
}
} // namespace visualServo
