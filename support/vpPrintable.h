/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintable.h
 * \brief Makes text from files safe for a terminal. Not installed.
 */
#ifndef vpPrintable_h
#define vpPrintable_h

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

//! One character of a UTF-8 text.
struct vpUtf8Character {
  std::uint32_t code = 0;
  std::size_t size = 0; //!< Bytes; 0 if the text is not UTF-8.
};

//! Decodes the character at \e at strictly: no overlong form, no surrogate, no truncation.
inline vpUtf8Character vpDecodeUtf8(const std::string &text, std::size_t at)
{
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(at);
  if (first < 0x80) {
    return {first, 1};
  }
  const std::size_t size = first >= 0xf0 && first < 0xf5   ? 4
                           : first >= 0xe0 && first < 0xf0 ? 3
                           : first >= 0xc2                 ? 2
                                                           : 0;
  if (size == 0 || first >= 0xf5 || at + size > text.size()) {
    return {};
  }
  std::uint32_t code = first & (0xffU >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) {
      return {};
    }
    code = (code << 6U) | (byte(at + i) & 0x3fU);
  }
  const bool overlong = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool wrong = overlong || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff;
  return wrong ? vpUtf8Character{} : vpUtf8Character{code, size};
}

//! True for characters that control a terminal, are invisible, or change the writing direction.
inline bool vpIsUnprintable(std::uint32_t code)
{
  const auto in = [code](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
  return code < 0x20 || in(0x7f, 0x9f) || code == 0xad || in(0x200b, 0x200f) || in(0x2028, 0x202e) ||
         in(0x2060, 0x206f) || code == 0xfeff || in(0xfff9, 0xfffb) || in(0xe0000, 0xe0fff);
}

/*!
 * Escapes every unprintable character as `\u001b` and every byte that is not UTF-8 as `\xff`. A JSON string thus keeps
 * its meaning.
 * \param text : Any bytes.
 * \param keep : Control characters to keep ("\n").
 */
inline std::string vpEscapeUnprintable(const std::string &text, const std::string &keep = "")
{
  std::string result;
  char buffer[16];
  for (std::size_t at = 0; at < text.size();) {
    const vpUtf8Character c = vpDecodeUtf8(text, at);
    if (c.size == 0) {
      std::snprintf(buffer, sizeof buffer, "\\x%02x", static_cast<unsigned int>(static_cast<unsigned char>(text[at])));
      result += buffer;
    }
    else if (!vpIsUnprintable(c.code) || (c.size == 1 && keep.find(text[at]) != std::string::npos)) {
      result.append(text, at, c.size);
    }
    else if (c.code <= 0xffff) {
      std::snprintf(buffer, sizeof buffer, "\\u%04x", c.code);
      result += buffer;
    }
    else { // surrogate pair, as in JSON
      std::snprintf(buffer, sizeof buffer, "\\u%04x\\u%04x", 0xd7c0 + (c.code >> 10U), 0xdc00 + (c.code & 0x3ffU));
      result += buffer;
    }
    at += c.size == 0 ? 1 : c.size;
  }
  return result;
}

/*!
 * Converts any text to one readable line: white space becomes single blanks, unprintable characters are escaped, and
 * long text ends in "...".
 */
inline std::string vpPrintable(const std::string &text, std::size_t longest = 1000)
{
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!blank) {
      line += c;
    }
    else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
    if (line.size() > longest + 4) { // perhaps with a partial character
      break;
    }
  }
  if (!line.empty() && line.back() == ' ') {
    line.pop_back();
  }
  if (line.size() > longest) {
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80) {
      --end;
    }
    line = line.substr(0, end) + "...";
  }
  return vpEscapeUnprintable(line);
}

#endif
