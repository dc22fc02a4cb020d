/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file jsonReader.h
 * \brief Strict reading of JSON files: every complaint names the file, the field and the value.
 */
#ifndef vpApp_jsonReader_h
#define vpApp_jsonReader_h

#include <nlohmann/json.hpp>

#include <set>
#include <string>
#include <vector>

namespace vpApp
{
/*!
 * Parse a JSON file. A field that is given twice in one object is an error.
 * \throw std::runtime_error naming the file, and the line and column of a syntax error.
 */
[[nodiscard]] nlohmann::json readJsonFile(const std::string &file);
/*!
 * Parse the content of a JSON file that was read already, as strictly as readJsonFile().
 * \param text : The content. \param file : Begins every message.
 * \throw std::runtime_error naming the file, and the line and column of a syntax error.
 */
[[nodiscard]] nlohmann::json parseJson(const std::string &text, const std::string &file);
/*!
 * Parse one line of a file of JSON lines, as strictly as readJsonFile().
 * \param line : The text. \param place : Begins every message ("problems.jsonl:3").
 * \throw std::runtime_error naming the place, and the column of a syntax error.
 */
[[nodiscard]] nlohmann::json parseJsonLine(const std::string &line, const std::string &place);

/*!
 * \brief One JSON object that is read field by field.
 *
 * Ask for every field that the object may have, then call finish(), which complains about all others.
 * All errors are std::runtime_error: `task.json: camera.px is "wide", must be a number`.
 */
class JsonObject
{
public:
  /*!
   * \param value : The JSON value; must be an object. \param file : Begins every message.
   * \param path : Where the object is in the file ("plants[0]"), empty for the whole file.
   */
  JsonObject(const nlohmann::json &value, std::string file, std::string path = "");

  //! True if the field is there; it then counts as known.
  [[nodiscard]] bool has(const std::string &field);
  //! A finite number. \throw std::runtime_error when missing.
  [[nodiscard]] double number(const std::string &field);
  //! A finite number, \e fallback when missing.
  [[nodiscard]] double number(const std::string &field, double fallback);
  //! A whole number >= 0, \e fallback when missing.
  [[nodiscard]] unsigned int count(const std::string &field, unsigned int fallback);
  //! A text, \e fallback when missing.
  [[nodiscard]] std::string text(const std::string &field, const std::string &fallback);
  //! True or false, \e fallback when missing.
  [[nodiscard]] bool flag(const std::string &field, bool fallback);
  //! Exactly \e size finite numbers.
  [[nodiscard]] std::vector<double> numbers(const std::string &field, std::size_t size);
  //! An object. \throw std::runtime_error when missing.
  [[nodiscard]] JsonObject object(const std::string &field);
  //! A list of objects, at least one. \throw std::runtime_error when missing or empty.
  [[nodiscard]] std::vector<JsonObject> objects(const std::string &field);

  //! Whatever stands there, for what the other readers do not cover. \throw std::runtime_error when missing.
  [[nodiscard]] const nlohmann::json &value(const std::string &field);

  //! \throw std::runtime_error naming the first field that was not asked for, and those that were.
  void finish() const;
  //! An error about this object: "file: path: sentence".
  [[nodiscard]] std::runtime_error error(const std::string &sentence) const;
  //! An error about a value in it: "file: path.field is VALUE, must be EXPECTED".
  [[nodiscard]] std::runtime_error wrong(const std::string &field, const nlohmann::json &value,
                                         const std::string &expected) const;

private:
  [[nodiscard]] std::string pathOf(const std::string &field) const;

  const nlohmann::json *m_value; // owned by the caller
  std::string m_file;
  std::string m_path;
  std::set<std::string> m_known;
};
} // namespace vpApp

#endif
