/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpJsonObject.h
 * \brief Strict reading of JSON objects, for modules and programs. Not installed: only .cpp files include it.
 */
#ifndef vpJsonObject_h
#define vpJsonObject_h

#include "vpStrictJson.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <vector>

/*!
 * \brief Reads one JSON object field by field.
 *
 * Read every field that the object may have, then call finish(), which reports all others as errors, so that misspelt
 * names are noticed. All errors are vpFileError: `task.json: camera.px is "wide", must be a number`.
 */
class vpJsonObject
{
public:
  using json = nlohmann::json;

  /*!
   * \param value : The JSON value, which must be an object and outlive this one. \param file : Prefix of every message.
   * \param path : Path of the object in the file ("plants[0]"), empty for the whole file.
   */
  vpJsonObject(const json &value, std::string file, std::string path = "")
    : m_value(&value), m_file(std::move(file)), m_path(std::move(path))
  {
    if (!value.is_object()) {
      throw vpFileError(m_file + ": " + (m_path.empty() ? "the content" : m_path) + " is " + shortDump(value) +
                        ", must be an object { }");
    }
  }

  //! True if the field exists; it then counts as known.
  [[nodiscard]] bool has(const std::string &field)
  {
    m_known.insert(field);
    return m_value->contains(field);
  }
  //! Marks a field that is not read here as known.
  void ignore(const std::string &field) { m_known.insert(field); }

  //! A number. \throw vpFileError if missing.
  [[nodiscard]] double number(const std::string &field)
  {
    const json &value = this->value(field);
    if (!value.is_number()) {
      throw wrong(field, value, "a number");
    }
    return value.get<double>();
  }
  //! A number, \e fallback if missing.
  [[nodiscard]] double number(const std::string &field, double fallback)
  {
    return has(field) ? number(field) : fallback;
  }
  //! An integer >= 0, \e fallback if missing.
  [[nodiscard]] unsigned int count(const std::string &field, unsigned int fallback)
  {
    if (!has(field)) {
      return fallback;
    }
    const json &value = this->value(field);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<unsigned int>::max()) {
      throw wrong(field, value, "a whole number >= 0");
    }
    return value.get<unsigned int>();
  }
  //! A string. \throw vpFileError if missing.
  [[nodiscard]] std::string text(const std::string &field)
  {
    const json &value = this->value(field);
    if (!value.is_string()) {
      throw wrong(field, value, "a text");
    }
    return value.get<std::string>();
  }
  //! A string, \e fallback if missing.
  [[nodiscard]] std::string text(const std::string &field, const std::string &fallback)
  {
    return has(field) ? text(field) : fallback;
  }
  //! A boolean, \e fallback if missing.
  [[nodiscard]] bool flag(const std::string &field, bool fallback)
  {
    if (!has(field)) {
      return fallback;
    }
    const json &value = this->value(field);
    if (!value.is_boolean()) {
      throw wrong(field, value, "true or false");
    }
    return value.get<bool>();
  }
  //! A list of strings.
  [[nodiscard]] std::vector<std::string> texts(const std::string &field)
  {
    const json &value = list(field);
    if (!std::all_of(value.begin(), value.end(), [](const json &item) { return item.is_string(); })) {
      throw wrong(field, value, "a list of texts");
    }
    return value.get<std::vector<std::string>>();
  }
  //! A list of numbers of any size.
  [[nodiscard]] std::vector<double> numbers(const std::string &field)
  {
    const json &value = this->value(field);
    if (!areNumbers(value)) {
      throw wrong(field, value, "a list of numbers");
    }
    return value.get<std::vector<double>>();
  }
  //! A list of exactly \e size numbers.
  [[nodiscard]] std::vector<double> numbers(const std::string &field, std::size_t size)
  {
    const json &value = this->value(field);
    if (!areNumbers(value) || value.size() != size) {
      throw wrong(field, value, "a list of " + std::to_string(size) + " numbers");
    }
    return value.get<std::vector<double>>();
  }
  //! A list of lists of \e size numbers each.
  [[nodiscard]] std::vector<std::vector<double>> rows(const std::string &field, std::size_t size)
  {
    const json &value = list(field);
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!areNumbers(value[i]) || value[i].size() != size) {
        throw wrong(field + "[" + std::to_string(i) + "]", value[i], "a list of " + std::to_string(size) + " numbers");
      }
      all.push_back(value[i].get<std::vector<double>>());
    }
    return all;
  }
  //! An object. \throw vpFileError if missing.
  [[nodiscard]] vpJsonObject object(const std::string &field)
  {
    return vpJsonObject(value(field), m_file, pathOf(field));
  }
  //! A list of objects, at least one. \throw vpFileError if missing or empty.
  [[nodiscard]] std::vector<vpJsonObject> objects(const std::string &field)
  {
    const json &value = this->value(field);
    if (!value.is_array() || value.empty()) {
      throw wrong(field, value, "a list of at least one object");
    }
    std::vector<vpJsonObject> all;
    for (std::size_t i = 0; i < value.size(); ++i) {
      all.emplace_back(value[i], m_file, pathOf(field) + "[" + std::to_string(i) + "]");
    }
    return all;
  }
  //! Calls \e take with every object of a list, which may be empty, and finishes it. \throw vpFileError if missing.
  template <class Take> void each(const std::string &field, Take take)
  {
    if (list(field).empty()) {
      return;
    }
    for (vpJsonObject &item : objects(field)) {
      take(item);
      item.finish();
    }
  }
  //! Calls \e take with the object \e field if it exists, and finishes it.
  template <class Take> void optional(const std::string &field, Take take)
  {
    if (has(field)) {
      vpJsonObject item = object(field);
      take(item);
      item.finish();
    }
  }

  //! Raw value of a field, for types not covered above. \throw vpFileError if missing.
  [[nodiscard]] const json &value(const std::string &field)
  {
    if (!has(field)) {
      throw vpFileError(m_file + ": " + pathOf(field) + " is missing");
    }
    return (*m_value)[field];
  }

  //! \throw vpFileError naming the first unknown field, and the known ones.
  void finish() const
  {
    for (const auto &item : m_value->items()) {
      if (m_known.count(item.key()) == 0) {
        std::string known;
        for (const std::string &field : m_known) {
          known += (known.empty() ? "" : ", ") + field;
        }
        throw vpFileError(m_file + ": unknown field " + pathOf(vpPrintable(item.key(), 60)) + "; known are " + known);
      }
    }
  }

  //! An error about this object: "file: path: sentence".
  [[nodiscard]] vpFileError error(const std::string &sentence) const
  {
    return vpFileError(m_file + ": " + (m_path.empty() ? "" : m_path + ": ") + sentence);
  }
  //! An error about a value in it: "file: path.field is VALUE, must be EXPECTED".
  [[nodiscard]] vpFileError wrong(const std::string &field, const json &value, const std::string &expected) const
  {
    return vpFileError(m_file + ": " + pathOf(field) + " is " + shortDump(value) + ", must be " + expected);
  }
  [[nodiscard]] const std::string &file() const { return m_file; }
  [[nodiscard]] const std::string &path() const { return m_path; }
  //! Path of a field of this object ("camera.px").
  [[nodiscard]] std::string pathOf(const std::string &field) const
  {
    return m_path.empty() ? field : m_path + "." + field;
  }

private:
  static bool areNumbers(const json &value)
  {
    bool good = value.is_array();
    for (std::size_t i = 0; good && i < value.size(); ++i) {
      good = value[i].is_number();
    }
    return good;
  }
  static std::string shortDump(const json &value)
  {
    return vpPrintable(value.dump(-1, ' ', false, json::error_handler_t::replace), 60);
  }
  const json &list(const std::string &field)
  {
    const json &value = this->value(field);
    if (!value.is_array()) {
      throw wrong(field, value, "a list");
    }
    return value;
  }

  const json *m_value;
  std::string m_file;
  std::string m_path;
  std::set<std::string> m_known;
};

#endif
