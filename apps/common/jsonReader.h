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
} // namespace vpApp

#endif
