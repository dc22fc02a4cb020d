/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fields.h
 * \brief Numerical parameters of a product, with their names on the command line and in files.
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
 * \brief A number of vpProductPatternSpec with its names in C++ ("pitchX"), on the command line ("--pitch-x") and in a
 * file ("pitch_x").
 */
struct Field {
  const char *group;    //!< Object in the file; heading in the help.
  const char *name;     //!< Name in C++.
  const char *unit;     //!< Unit, for the help.
  const char *sentence; //!< Description.
  std::variant<double vpProductPatternSpec::*, unsigned int vpProductPatternSpec::*> member;

  //! "pitch-x" with '-', "pitch_x" with '_'.
  [[nodiscard]] std::string nameWith(char separator) const;
};

//! All numbers of the product except the angle, which users give in degrees.
[[nodiscard]] const std::vector<Field> &fields();
//! The shape of that name. \throw std::runtime_error "NAME, must be rectangle, rounded or dot".
[[nodiscard]] vpProductShape shapeOf(const std::string &name);
//! Number as text, six digits.
[[nodiscard]] std::string shortNumber(double value);
} // namespace generatePattern

#endif
