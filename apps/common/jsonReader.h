/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file jsonReader.h
 * \brief Strict reading of JSON files, the same as in the modules (support/vpJsonObject.h).
 */
#ifndef vpApp_jsonReader_h
#define vpApp_jsonReader_h

#include "vpJsonObject.h"

#include <visp3/direct_core/vpField.h>

VISP_DIRECT_USING_NAMESPACE

namespace vpApp
{
using JsonObject = vpJsonObject;

//! Parse a JSON file. \throw vpFileError naming the file, and the line and column of a syntax error.
[[nodiscard]] inline nlohmann::json readJsonFile(const std::string &file) { return vpReadJson(file); }
//! Parse the content of the JSON file \e file, already read.
[[nodiscard]] inline nlohmann::json parseJson(const std::string &text, const std::string &file)
{
  return vpParseJson(text, file);
}
//! Parse one line of a JSON Lines file; every message begins with \e place ("problems.jsonl:3").
[[nodiscard]] inline nlohmann::json parseJsonLine(const std::string &line, const std::string &place)
{
  return vpParseJson(line, place, true);
}

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
