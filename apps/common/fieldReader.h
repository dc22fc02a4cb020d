/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fieldReader.h
 * \brief Reads the fields of a specification from a file, by its table.
 */
#ifndef vpApp_fieldReader_h
#define vpApp_fieldReader_h

#include "jsonReader.h"

#include <visp3/direct_core/vpField.h>

VISP_DIRECT_USING_NAMESPACE

namespace vpApp
{
//! \brief Whether the names of a file's fields carry units ("lag_s") or not ("pitch_x").
enum class Units { Named, Omitted };

/*!
 * Reads those fields of a specification that \e object has; the others keep their values.
 * \throw vpFileError: "task.json: gains.lambda is -1, must be > 0, <= 1000000 1/s".
 */
template <class Spec>
void readFields(JsonObject &object, const vpFields<Spec> &fields, Spec &spec, Units units = Units::Named)
{
  for (const vpField<Spec> &field : fields) {
    const std::string name = vpFieldFileName(field.name, units == Units::Named ? field.unit : "");
    if (!object.has(name)) {
      continue;
    }
    const bool whole = std::holds_alternative<unsigned int Spec::*>(field.member);
    const double value = whole ? object.count(name, 0) : object.number(name);
    if (!field.range.contains(value)) {
      throw object.wrong(name, object.value(name), field.range.text() + (*field.unit == '\0' ? "" : " ") + field.unit);
    }
    field.set(spec, value);
  }
}
} // namespace vpApp

#endif
