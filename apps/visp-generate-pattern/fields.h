/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fields.h
 * \brief The numbers of a product in groups, with their names on the command line and in files.
 */
#ifndef generatePattern_fields_h
#define generatePattern_fields_h

#include <visp3/rendering/vpProductPatternSpec.h>

#include <string>
#include <vector>

VISP_DIRECT_USING_NAMESPACE

namespace generatePattern
{
//! \brief Fields that belong together: an object of the file, a heading of the help.
struct FieldGroup {
  std::string name;                                  //!< Name of the object in the file.
  std::string heading;                               //!< In the help.
  std::vector<vpField<vpProductPatternSpec>> fields; //!< Of vpProductPatternSpec::fields(), all but the angle.
};

//! All groups, in the order of the help.
[[nodiscard]] const std::vector<FieldGroup> &fieldGroups();
//! Name of a field in the file, "pitch_x".
[[nodiscard]] std::string fileNameOf(const vpField<vpProductPatternSpec> &field);
//! Name of a field on the command line, "pitch-x".
[[nodiscard]] std::string optionNameOf(const vpField<vpProductPatternSpec> &field);
//! The shape of that name. \throw std::runtime_error "NAME, must be rectangle, rounded or dot".
[[nodiscard]] vpProductShape shapeOf(const std::string &name);
//! Number as text, six digits.
[[nodiscard]] std::string shortNumber(double value);
} // namespace generatePattern

#endif
