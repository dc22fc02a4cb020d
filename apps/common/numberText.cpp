/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "numberText.h"

#include <cctype>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace vpApp
{
namespace
{
constexpr double LARGEST_PLAIN = 1e9;
}

std::string number(double value, int digits)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(digits) << value;
  // Write "1.5e+02" as 150.
  if (text.str().find("e+") == std::string::npos || std::fabs(value) >= LARGEST_PLAIN) {
    return text.str();
  }
  const double unit = std::pow(10., std::floor(std::log10(std::fabs(value))) - digits + 1.);
  return fixed(unit * std::round(value / unit), 0);
}

std::string fixed(double value, int decimals)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(decimals) << value;
  const std::string result = text.str();
  const bool minusZero = result.find_first_not_of("-0.") == std::string::npos && result.front() == '-';
  return minusZero ? result.substr(1) : result;
}

std::string enumerate(const std::vector<std::string> &items)
{
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
  }
  return text;
}

std::string fileName(const std::string &text)
{
  std::string name;
  for (const char c : text) {
    const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '+' || c == '.';
    name += safe ? c : '_';
  }
  return name;
}
} // namespace vpApp
