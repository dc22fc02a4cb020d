/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpNumberText.h
 * \brief Numbers in a text, whatever the locale. Not installed.
 */
#ifndef vpNumberText_h
#define vpNumberText_h

#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

//! The finite numbers of a text, separated by blanks; none if it contains anything else.
inline std::optional<std::vector<double>> vpNumbersOf(const std::string &text)
{
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    std::istringstream stream(word);
    stream.imbue(std::locale::classic());
    double number = 0.;
    if (!(stream >> number) || stream.peek() != std::istringstream::traits_type::eof() || !std::isfinite(number)) {
      return std::nullopt;
    }
    numbers.push_back(number);
  }
  return numbers;
}

#endif
