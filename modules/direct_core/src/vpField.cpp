/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/direct_core/vpField.h>

#include <visp3/core/vpException.h>

#include <cctype>
#include <cmath>
#include <cstdio>

BEGIN_VISP_NAMESPACE

namespace
{
std::string textOf(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.7g", value);
  return text;
}
} // namespace

vpFieldRange vpFieldRange::positive(double high) { return {0., high, true, false}; }

vpFieldRange vpFieldRange::notNegative(double high) { return {0., high, false, false}; }

bool vpFieldRange::contains(double value) const noexcept
{
  if (std::isinf(value)) {
    return infinite && value > 0.;
  }
  return (open ? value > low : value >= low) && value <= high;
}

std::string vpFieldRange::text() const
{
  std::string range = "finite";
  if (std::isfinite(low)) {
    const bool bounded = std::isfinite(high);
    range = bounded && !open ? textOf(low) + ".." + textOf(high)
                             : (open ? "> " : ">= ") + textOf(low) + (bounded ? ", <= " + textOf(high) : "");
  }
  else if (std::isfinite(high)) {
    range = "<= " + textOf(high);
  }
  return range + (infinite ? " or infinite" : "");
}

std::string vpFieldFileName(const std::string &name, const std::string &unit)
{
  std::string text;
  const auto add = [&text](char c) { text += static_cast<char>(std::tolower(static_cast<unsigned char>(c))); };
  for (const char c : name) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0) {
      text += '_';
    }
    add(c);
  }
  if (!unit.empty() && unit[0] != '1') {
    text += '_';
    for (const char c : unit) {
      if (c == '/') {
        text += 'p';
      }
      else if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        add(c);
      }
    }
  }
  return text;
}

void vpCheckField(const char *name, const char *owner, double value, const char *unit, const vpFieldRange &range)
{
  if (range.contains(value)) {
    return;
  }
  const std::string whose = *owner == '\0' ? "" : std::string(" of ") + owner;
  const bool oneSided = std::isfinite(range.low) != std::isfinite(range.high);
  const char *finite = !std::isfinite(value) && oneSided && !range.infinite ? " and finite" : "";
  throw vpException(vpException::badValue, "%s%s is %.7g%s%s, must be %s%s", name, whose.c_str(), value,
                    *unit == '\0' ? "" : " ", unit, range.text().c_str(), finite);
}

END_VISP_NAMESPACE
