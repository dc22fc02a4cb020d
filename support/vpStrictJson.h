/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpStrictJson.h
 * \brief Strict JSON parser for modules and programs. Not installed.
 */
#ifndef vpStrictJson_h
#define vpStrictJson_h

#include "vpFileText.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/*!
 * \brief Builds the value during parsing, and rejects what the parser would accept: a duplicate field (the last would
 * win silently) and nesting deeper than vpDeepestNesting.
 */
class vpStrictJsonBuilder : public nlohmann::json_sax<nlohmann::json>
{
public:
  using json = nlohmann::json;

  /*!
   * \param text : Text to parse. \param name : Prefix of every message. \param isLine : True if the text is one line,
   * whose position is part of the name.
   */
  vpStrictJsonBuilder(const std::string &text, std::string name, bool isLine)
    : m_text(text), m_name(std::move(name)), m_isLine(isLine)
  {}
  [[nodiscard]] json take() { return std::move(m_root); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t &) override { return add(value); }
  bool string(string_t &value) override { return add(std::move(value)); }
  bool binary(binary_t &) override { return false; } // not in text
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t &value) override
  {
    m_field = std::move(value);
    if (m_open.back()->contains(m_field)) {
      throw vpFileError(m_name + ": field " + json(vpPrintable(m_field, 60)).dump() + " is given twice");
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string &, const nlohmann::detail::exception &error) override
  {
    // "[json.exception.parse_error.101] parse error at line 1, column 5: syntax error while parsing value - ..."
    std::string reason = error.what();
    for (const char *mark : {"] ", "column ", ": "}) {
      const std::size_t at = reason.find(mark);
      if (at != std::string::npos) {
        reason.erase(0, at + std::char_traits<char>::length(mark));
      }
    }
    const std::size_t byte = position > 0 ? position - 1 : 0; // the parser counts from 1
    throw vpFileError(m_name + ": " +
                      (m_isLine ? "column " + std::to_string(byte + 1) : vpLineAndColumn(m_text, byte)) + ": " +
                      reason);
  }

private:
  json *place(json &&value)
  {
    if (m_open.empty()) {
      m_root = std::move(value);
      return &m_root;
    }
    json &parent = *m_open.back();
    if (parent.is_object()) {
      return &(parent[m_field] = std::move(value));
    }
    parent.push_back(std::move(value));
    return &parent.back();
  }
  bool add(json &&value)
  {
    place(std::move(value));
    return true;
  }
  bool open(json &&value)
  {
    if (m_open.size() >= static_cast<std::size_t>(vpDeepestNesting)) {
      throw vpFileError(m_name + ": is nested more than " + std::to_string(vpDeepestNesting) + " deep");
    }
    m_open.push_back(place(std::move(value)));
    return true;
  }
  bool close()
  {
    m_open.pop_back();
    return true;
  }

  const std::string &m_text;
  std::string m_name;
  bool m_isLine;
  json m_root;
  std::vector<json *> m_open; // arrays and objects around the current value
  std::string m_field;
};

/*!
 * Parses a text. A byte order mark and CR LF line ends are accepted.
 * \param text : The content of a file, or a line of it. \param name : The file ("task.json"), or the line
 * ("problems.jsonl:3"). \param isLine : True for a line.
 * \throw vpFileError with the position of a syntax error, the duplicate field, or the number that is too large.
 */
inline nlohmann::json vpParseJson(const std::string &text, const std::string &name, bool isLine = false)
{
  vpStrictJsonBuilder builder(text, name, isLine);
  static_cast<void>(nlohmann::json::sax_parse(text, &builder));
  return builder.take();
}

//! Reads and parses a file. \throw vpFileError as vpReadFileText() and vpParseJson().
inline nlohmann::json vpReadJson(const std::string &file) { return vpParseJson(vpReadFileText(file), file); }

#endif
