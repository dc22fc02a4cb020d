/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fields.h
 * \brief The numbers that describe a product, as the command line and a file call them.
 */
#ifndef generatePattern_fields_h
#define generatePattern_fields_h

#include <visp3/rendering/vpProductPatternSpec.h>

#include <string>
#include <variant>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace generatePattern
{
/*!
 * \brief A number of vpProductPatternSpec: how it is called in C++ ("pitchX"), on the command line ("--pitch-x") and in a
 * file ("pitch_x").
 */
struct Field {
  const char *group;    //!< Object of the file; heading of the help.
  const char *name;     //!< As in C++.
  const char *unit;     //!< In the help.
  const char *sentence; //!< What it does.
  std::variant<double vpProductPatternSpec::*, unsigned int vpProductPatternSpec::*> member;

  //! "pitch-x" with '-', "pitch_x" with '_'.
  [[nodiscard]] std::string nameWith(char separator) const;
  //! As a user reads it, six digits.
  [[nodiscard]] std::string valueOf(const vpProductPatternSpec &product) const;
};

//! All numbers of the product but the angle, which users give in degrees.
[[nodiscard]] const std::vector<Field> &fields();
//! The shape called so. \throw std::runtime_error "NAME, must be rectangle, rounded or dot".
[[nodiscard]] vpProductShape shapeOf(const std::string &name);
//! Six digits, as a user reads it.
[[nodiscard]] std::string shortNumber(double value);
} // namespace generatePattern

#endif
