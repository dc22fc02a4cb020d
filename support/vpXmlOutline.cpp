/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpXmlOutline.h"

#include "vpFileText.h"

#include <array>

namespace
{
constexpr std::size_t mostElements = 1000000; // a description of a robot has some thousands

// With the five entities that XML defines as their characters.
std::string decoded(const std::string &value)
{
  static const std::array<std::pair<const char *, char>, 5> entities = {
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  std::string text;
  for (std::size_t i = 0; i < value.size();) {
    std::size_t length = 1;
    char character = value[i];
    for (const auto &[name, meaning] : entities) {
      const std::size_t size = std::char_traits<char>::length(name);
      if (value.compare(i, size, name) == 0) {
        length = size;
        character = meaning;
      }
    }
    text += character;
    i += length;
  }
  return text;
}

class Outline
{
public:
  Outline(const std::string &text, const std::string &file, bool forPrintf)
    : m_text(text), m_file(file), m_forPrintf(forPrintf)
  {
    if (text.compare(0, 3, "\xef\xbb\xbf") == 0) {
      m_at = 3;
    }
  }

  std::vector<vpXmlElement> read()
  {
    const std::size_t zero = m_text.find('\0');
    if (zero != std::string::npos) {
      fail(zero, "has a zero byte");
    }
    bool hasRoot = false;
    for (skipText(hasRoot); m_at < m_text.size(); skipText(hasRoot)) {
      const std::size_t start = m_at;
      if (!skipAside("<!--", "-->") && !skipDeclaration(hasRoot) && !skipDoctype(hasRoot)) {
        if (m_open.empty() && hasRoot) {
          fail(start, "goes on after the end of its only element");
        }
        if (!(begins("<![CDATA[") && !m_open.empty() && skipAside("<![CDATA[", "]]>"))) {
          begins("</") ? endTag() : startTag();
          hasRoot = true;
        }
      }
    }
    if (!m_open.empty()) {
      fail(m_text.size(), "ends within the element " + around());
    }
    if (!hasRoot) {
      fail(m_text.size(), "has no element");
    }
    return std::move(m_elements);
  }

private:
  [[noreturn]] void fail(std::size_t at, const std::string &what) const
  {
    throw vpFileError(m_file + ": " + vpLineAndColumn(m_text, at) + ": " + what);
  }
  [[nodiscard]] bool begins(const char *mark) const
  {
    return m_text.compare(m_at, std::char_traits<char>::length(mark), mark) == 0;
  }
  [[nodiscard]] char here() const { return m_at < m_text.size() ? m_text[m_at] : '\0'; }
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  bool skipBlanks()
  {
    const std::size_t start = m_at;
    while (isBlank(here())) {
      ++m_at;
    }
    return m_at > start;
  }

  // Up to the next '<'. Outside the root there are only blanks.
  void skipText(bool hasRoot)
  {
    if (m_open.empty()) {
      skipBlanks();
      if (m_at < m_text.size() && here() != '<') {
        fail(m_at, hasRoot ? "goes on after the end of its only element" : "is no XML, which begins with <");
      }
      return;
    }
    const std::size_t mark = m_text.find('<', m_at);
    m_at = mark == std::string::npos ? m_text.size() : mark;
  }
  bool skipAside(const char *first, const char *last)
  {
    if (!begins(first)) {
      return false;
    }
    const std::size_t end = m_text.find(last, m_at + std::char_traits<char>::length(first));
    if (end == std::string::npos) {
      fail(m_at, std::string(first) + " has no " + last);
    }
    m_at = end + std::char_traits<char>::length(last);
    return true;
  }
  // <?xml version="1.0"?>, or an instruction in the same form, before the root.
  bool skipDeclaration(bool hasRoot)
  {
    if (!begins("<?")) {
      return false;
    }
    if (hasRoot) {
      fail(m_at, "has a declaration <? that is not at its beginning");
    }
    m_at += 2;
    static_cast<void>(name());
    static_cast<void>(attributes());
    if (!begins("?>")) {
      fail(m_at, "the declaration does not end in ?>");
    }
    m_at += 2;
    return true;
  }
  bool skipDoctype(bool hasRoot)
  {
    if (!begins("<!DOCTYPE")) {
      return false;
    }
    const std::size_t end = m_text.find('>', m_at);
    if (hasRoot || end == std::string::npos || m_text.find_first_of("[\"'", m_at) < end) {
      fail(m_at, "has a DOCTYPE with more than a name");
    }
    m_at = end + 1;
    return true;
  }

  std::string name()
  {
    const auto starts = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (static_cast<unsigned char>(c) >= 0x80);
    };
    const std::size_t start = m_at;
    while (starts(here()) ||
           (m_at > start && ((here() >= '0' && here() <= '9') || here() == '-' || here() == '.' || here() == ':'))) {
      ++m_at;
    }
    if (m_at == start) {
      fail(m_at, "there is no name where one must be");
    }
    return m_text.substr(start, m_at - start);
  }
  std::map<std::string, std::string> attributes()
  {
    std::map<std::string, std::string> all;
    while (skipBlanks() && here() != '>' && here() != '/' && here() != '?') {
      const std::size_t start = m_at;
      const std::string field = name();
      if (all.count(field) > 0) {
        fail(start, "attribute " + field + " is given twice");
      }
      skipBlanks();
      if (here() != '=') {
        fail(m_at, "attribute " + field + " has no value");
      }
      ++m_at;
      skipBlanks();
      const char quote = here();
      const std::size_t end = quote == '"' || quote == '\'' ? m_text.find(quote, m_at + 1) : std::string::npos;
      if (end == std::string::npos) {
        fail(m_at, "the value of attribute " + field + " is not in quotes");
      }
      const std::string value = m_text.substr(m_at + 1, end - m_at - 1);
      requireHarmless(field, value);
      all[field] = decoded(value);
      m_at = end + 1;
    }
    return all;
  }
  void requireHarmless(const std::string &field, const std::string &value) const
  {
    if (value.find('<') != std::string::npos) {
      fail(m_at, "attribute " + field + " has a < in its value");
    }
    if (m_forPrintf && value.find('%') != std::string::npos && field != "filename") {
      fail(m_at, "attribute " + field + " is " + vpPrintable(value, 60) + ", must be without %");
    }
    if (value.find("&#") != std::string::npos) { // character reference: could encode any of them
      fail(m_at, "attribute " + field + " is " + vpPrintable(value, 60) + ", must be without &#");
    }
  }
  void startTag()
  {
    const std::size_t start = m_at++;
    const std::string element = name();
    const std::size_t afterName = m_at;
    std::map<std::string, std::string> fields = attributes();
    const bool ends = here() == '/';
    m_at += ends ? 1 : 0;
    if (here() != '>') {
      fail(m_at, "the tag of element " + element + " does not end in >");
    }
    ++m_at;
    if (m_open.size() >= static_cast<std::size_t>(vpDeepestNesting)) {
      fail(start, "is nested more than " + std::to_string(vpDeepestNesting) + " deep");
    }
    if (m_elements.size() >= mostElements) {
      fail(start, "has more than " + std::to_string(mostElements) + " elements");
    }
    m_elements.push_back({element, m_open.empty() ? -1 : m_open.back(), start, afterName, std::move(fields)});
    if (!ends) {
      m_open.push_back(static_cast<int>(m_elements.size()) - 1);
    }
  }
  void endTag()
  {
    const std::size_t start = m_at;
    m_at += 2;
    const std::string element = name();
    skipBlanks();
    if (here() != '>' || m_open.empty() || around() != element) {
      fail(start, "</" + element + " does not end " + (m_open.empty() ? "an element" : "element " + around()));
    }
    ++m_at;
    m_open.pop_back();
  }

  [[nodiscard]] const std::string &around() const { return m_elements[static_cast<std::size_t>(m_open.back())].name; }

  const std::string &m_text;
  const std::string &m_file;
  bool m_forPrintf;
  std::size_t m_at = 0;
  std::vector<vpXmlElement> m_elements;
  std::vector<int> m_open; // the elements around the current position, by index
};
} // namespace

std::vector<vpXmlElement> vpReadXmlOutline(const std::string &text, const std::string &file, bool forPrintf)
{
  return Outline(text, file, forPrintf).read();
}
