/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpJointLimitsYaml.h"

#include "vpFileText.h"
#include "vpNumberText.h"

namespace
{
using Fields = std::map<std::string, std::string>;

struct Line {
  std::size_t indent = 0;
  std::string name, value;
};

std::string trimmed(const std::string &text)
{
  const std::size_t first = text.find_first_not_of(" \r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \r") - first + 1);
}

std::string unquoted(const std::string &text)
{
  const bool isQuoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return isQuoted ? text.substr(1, text.size() - 2) : text;
}

// Without its comment. The value of a name may be empty: a map follows.
Line lineOf(std::string text, const std::string &where)
{
  const std::size_t comment = text[0] == '#' ? 0 : text.find(" #");
  text = text.substr(0, comment);
  Line line;
  line.indent = text.find_first_not_of(' ');
  text = trimmed(text);
  if (text.find('\t') != std::string::npos) {
    throw vpFileError(where + " has a tab, must be indented by blanks");
  }
  const std::size_t colon = text.find(':');
  if (!text.empty() && text != "---") {
    if (colon == std::string::npos || (colon + 1 < text.size() && text[colon + 1] != ' ')) {
      throw vpFileError(where + " is " + vpPrintable(text, 60) + ", must be name: value");
    }
    line.name = unquoted(trimmed(text.substr(0, colon)));
    line.value = unquoted(trimmed(text.substr(colon + 1)));
  }
  return line;
}

// The fields of each joint.
std::map<std::string, Fields> fieldsOf(const std::string &file)
{
  std::map<std::string, Fields> joints;
  std::istringstream text(vpReadFileText(file));
  bool isInside = false, isThere = false;
  std::size_t indentOfJoints = 0;
  std::string joint, content;
  for (int number = 1; std::getline(text, content); ++number) {
    const std::string where = file + ": line " + std::to_string(number);
    const Line line = lineOf(content, where);
    if (line.name.empty()) {
      continue;
    }
    if (line.indent == 0) {
      isInside = line.name == "joint_limits";
      if (isInside && (isThere || !line.value.empty())) {
        throw vpFileError(where + ": joint_limits is given twice or has a value, must be a map of joints");
      }
      isThere = isThere || isInside;
      indentOfJoints = 0;
      joint.clear();
    }
    else if (isInside && (indentOfJoints == 0 || line.indent <= indentOfJoints)) {
      joint = line.name;
      if ((indentOfJoints != 0 && line.indent != indentOfJoints) || !line.value.empty() || !joints[joint].empty()) {
        throw vpFileError(where + ": joint " + joint + " is given twice, has a value or is indented differently");
      }
      indentOfJoints = line.indent;
    }
    else if (isInside && !joints[joint].emplace(line.name, line.value).second) {
      throw vpFileError(where + ": " + line.name + " of joint " + joint + " is given twice");
    }
  }
  if (!isThere) {
    throw vpFileError(file + ": has no joint_limits");
  }
  return joints;
}

class Joint
{
public:
  Joint(const std::string &file, const std::string &name, Fields fields)
    : m_where(file + ": joint_limits." + name + "."), m_fields(std::move(fields))
  {}
  vpJointLimits read()
  {
    vpJointLimits limits;
    if (flag("has_position_limits")) {
      limits.lower = number("min_position");
      limits.upper = number("max_position");
    }
    limits.velocity = maximum("velocity");
    limits.acceleration = maximum("acceleration");
    limits.torque = maximum("effort");
    for (const char *unused : {"min_position", "max_position", "max_velocity", "max_acceleration", "max_effort",
                               "has_jerk_limits", "max_jerk"}) {
      m_fields.erase(unused);
    }
    if (!m_fields.empty()) {
      throw vpFileError(m_where + m_fields.begin()->first + " is not known");
    }
    return limits;
  }

private:
  std::string take(const std::string &field)
  {
    const auto found = m_fields.find(field);
    std::string text = found == m_fields.end() ? "" : found->second;
    m_fields.erase(field);
    return text;
  }
  bool flag(const std::string &field)
  {
    const std::string text = take(field);
    const bool yes = text == "true" || text == "True" || text == "TRUE";
    if (!yes && !text.empty() && text != "false" && text != "False" && text != "FALSE") {
      throw vpFileError(m_where + field + " is " + vpPrintable(text, 60) + ", must be true or false");
    }
    return yes;
  }
  double number(const std::string &field)
  {
    const std::string text = take(field);
    const std::optional<std::vector<double>> numbers = vpNumbersOf(text);
    if (!numbers || numbers->size() != 1) {
      throw vpFileError(m_where + field + (text.empty() ? " is missing" : " is " + vpPrintable(text, 60)) +
                        ", must be a finite number");
    }
    return numbers->front();
  }
  std::optional<double> maximum(const std::string &what)
  {
    const std::string flagName = "has_" + what + "_limits", field = "max_" + what;
    if (m_fields.count(field) > 0 && m_fields.count(flagName) == 0) {
      throw vpFileError(m_where + field + " counts only with " + flagName);
    }
    if (!flag(flagName)) {
      return std::nullopt;
    }
    const double value = number(field);
    if (!(value >= 1e-12 && value <= 1e9)) {
      throw vpFileError(m_where + field + " is " + std::to_string(value) + ", must be from 1e-12 to 1e9");
    }
    return value;
  }

  std::string m_where;
  Fields m_fields;
};
} // namespace

std::map<std::string, vpJointLimits> vpReadJointLimits(const std::string &file)
{
  std::map<std::string, vpJointLimits> limits;
  for (const auto &[name, fields] : fieldsOf(file)) {
    limits[name] = Joint(file, name, fields).read();
  }
  return limits;
}
