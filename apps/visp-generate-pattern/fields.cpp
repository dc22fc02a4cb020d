/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "fields.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <stdexcept>

namespace generatePattern
{
std::string shortNumber(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

const std::vector<FieldGroup> &fieldGroups()
{
  static const std::vector<FieldGroup> all = []() {
    // The first field of each group; the fields of vpProductPatternSpec are in this order.
    const std::map<std::string, std::pair<const char *, const char *>> first = {
        {"width", {"image", "Image"}},    {"pitchX", {"cells", "Cells"}},
        {"dark", {"camera", "Camera"}},   {"jitter", {"flexible", "Flexible product"}},
        {"dust", {"defects", "Defects"}}, {"seed", {"random", "Randomness"}}};
    std::vector<FieldGroup> groups;
    for (const auto &field : vpProductPatternSpec::fields()) {
      const auto starts = first.find(field.name);
      if (starts != first.end()) {
        groups.push_back({starts->second.first, starts->second.second, {}});
      }
      groups.back().fields.push_back(field);
    }
    return groups;
  }();
  return all;
}

std::string fileNameOf(const vpField<vpProductPatternSpec> &field) { return vpFieldFileName(field.name, ""); }

std::string optionNameOf(const vpField<vpProductPatternSpec> &field)
{
  std::string name = fileNameOf(field);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

vpProductShape shapeOf(const std::string &name)
{
  for (const vpProductShape shape : {vpProductShape::Rectangle, vpProductShape::Rounded, vpProductShape::Dot}) {
    if (vpToString(shape) == name) {
      return shape;
    }
  }
  throw std::runtime_error(name + ", must be rectangle, rounded or dot");
}
} // namespace generatePattern
