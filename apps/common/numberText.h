/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file numberText.h
 * \brief Numbers as text, independent of the locale.
 */
#ifndef vpApp_numberText_h
#define vpApp_numberText_h

#include <string>
#include <vector>

namespace vpApp
{
//! \e value with \e digits significant digits: "0.2", "57", "150"; with an exponent from 1e9 on and below 1e-4.
[[nodiscard]] std::string number(double value, int digits);
//! \e value with \e decimals digits after the point, "0.20".
[[nodiscard]] std::string fixed(double value, int decimals);
//! "a", "a and b", "a, b and c".
[[nodiscard]] std::string enumerate(const std::vector<std::string> &items);
//! File name from any text: letters, digits, `-`, `+` and `.` are kept, all else becomes `_`.
[[nodiscard]] std::string fileName(const std::string &text);
} // namespace vpApp

#endif
