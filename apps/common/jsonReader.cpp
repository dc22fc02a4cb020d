/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "jsonReader.h"
#include "outputFolder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace vpApp
{
namespace
{
using nlohmann::json;

std::string lineAndColumn(const std::string &text, std::size_t byte)
{
  std::size_t line = 1;
  std::size_t column = 1;
  for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
    if (text[i] == '\n') {
      ++line;
      column = 1;
    }
    else {
      ++column;
    }
  }
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

// nlohmann: "[json.exception.parse_error.101] parse error at line 1, column 5: syntax error while parsing value - ..."
std::string reasonOf(const json::exception &error)
{
  std::string reason = error.what();
  for (const char *mark : {"] ", "column ", ": "}) {
    const std::size_t at = reason.find(mark);
    if (at != std::string::npos) {
      reason.erase(0, at + std::char_traits<char>::length(mark));
    }
  }
  return reason;
}

// Keeps the parser from taking the last of two fields of the same name in silence.
class DuplicateCheck
{
public:
  explicit DuplicateCheck(const std::string &file) : m_file(file) {}
  bool operator()(json::parse_event_t event, json &value)
  {
    if (event == json::parse_event_t::object_start) {
      m_fields.emplace_back();
    }
    else if (event == json::parse_event_t::object_end) {
      m_fields.pop_back();
    }
    else if (event == json::parse_event_t::key && !m_fields.back().insert(value.get<std::string>()).second) {
      throw std::runtime_error(m_file + ": field " + value.dump() + " is given twice");
    }
    return true;
  }

private:
  std::string m_file;
  std::vector<std::set<std::string>> m_fields;
};

//! \param where : Says where the byte (from 1) of a syntax error is.
template <class Where> json parse(const std::string &text, const std::string &name, Where where)
{
  try {
    DuplicateCheck check(name);
    return json::parse(text, [&check](int, json::parse_event_t event, json &value) { return check(event, value); });
  }
  catch (const json::parse_error &error) {
    throw std::runtime_error(name + ": " + where(error.byte) + ": " + reasonOf(error));
  }
  catch (const json::exception &error) {
    throw std::runtime_error(name + ": " + reasonOf(error));
  }
}

std::string shortDump(const json &value)
{
  std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}
} // namespace

json readJsonFile(const std::string &file) { return parseJson(readFile(file), file); }

json parseJson(const std::string &text, const std::string &file)
{
  return parse(text, file, [&text](std::size_t byte) { return lineAndColumn(text, byte); });
}

json parseJsonLine(const std::string &line, const std::string &place)
{
  return parse(line, place,
               [](std::size_t byte) { return "column " + std::to_string(std::max<std::size_t>(byte, 1)); });
}

JsonObject::JsonObject(const json &value, std::string file, std::string path)
  : m_value(&value), m_file(std::move(file)), m_path(std::move(path))
{
  if (!value.is_object()) {
    throw std::runtime_error(m_file + ": " + (m_path.empty() ? "the content" : m_path) + " is " + shortDump(value) +
                             ", must be an object { }");
  }
}

bool JsonObject::has(const std::string &field)
{
  m_known.insert(field);
  return m_value->contains(field);
}

double JsonObject::number(const std::string &field)
{
  const json &value = this->value(field);
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw wrong(field, value, "a number");
  }
  return value.get<double>();
}

double JsonObject::number(const std::string &field, double fallback) { return has(field) ? number(field) : fallback; }

unsigned int JsonObject::count(const std::string &field, unsigned int fallback)
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

std::string JsonObject::text(const std::string &field, const std::string &fallback)
{
  if (!has(field)) {
    return fallback;
  }
  const json &value = this->value(field);
  if (!value.is_string()) {
    throw wrong(field, value, "a text");
  }
  return value.get<std::string>();
}

bool JsonObject::flag(const std::string &field, bool fallback)
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

std::vector<double> JsonObject::numbers(const std::string &field, std::size_t size)
{
  const json &value = this->value(field);
  bool good = value.is_array() && value.size() == size;
  for (std::size_t i = 0; good && i < size; ++i) {
    good = value[i].is_number() && std::isfinite(value[i].get<double>());
  }
  if (!good) {
    throw wrong(field, value, "a list of " + std::to_string(size) + " numbers");
  }
  return value.get<std::vector<double>>();
}

JsonObject JsonObject::object(const std::string &field) { return JsonObject(value(field), m_file, pathOf(field)); }

std::vector<JsonObject> JsonObject::objects(const std::string &field)
{
  const json &value = this->value(field);
  if (!value.is_array() || value.empty()) {
    throw wrong(field, value, "a list of at least one object");
  }
  std::vector<JsonObject> list;
  for (std::size_t i = 0; i < value.size(); ++i) {
    list.emplace_back(value[i], m_file, pathOf(field) + "[" + std::to_string(i) + "]");
  }
  return list;
}

void JsonObject::finish() const
{
  for (const auto &item : m_value->items()) {
    if (m_known.count(item.key()) == 0) {
      std::string known;
      for (const std::string &field : m_known) {
        known += (known.empty() ? "" : ", ") + field;
      }
      throw std::runtime_error(m_file + ": unknown field " + pathOf(item.key()) + "; known are " + known);
    }
  }
}

std::runtime_error JsonObject::error(const std::string &sentence) const
{
  return std::runtime_error(m_file + ": " + (m_path.empty() ? "" : m_path + ": ") + sentence);
}

const json &JsonObject::value(const std::string &field)
{
  if (!has(field)) {
    throw std::runtime_error(m_file + ": " + pathOf(field) + " is missing");
  }
  return (*m_value)[field];
}

std::string JsonObject::pathOf(const std::string &field) const { return m_path.empty() ? field : m_path + "." + field; }

std::runtime_error JsonObject::wrong(const std::string &field, const json &value, const std::string &expected) const
{
  return std::runtime_error(m_file + ": " + pathOf(field) + " is " + shortDump(value) + ", must be " + expected);
}
} // namespace vpApp
