/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpPlyOutline.h"

#include "vpFileText.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>
#include <vector>

namespace
{
[[noreturn]] void fail(const std::string &file, const std::string &what) { throw vpFileError(file + ": " + what); }

struct PlyProperty {
  std::string count, type; // types of the number of values, "" for one value, and of the values
};
struct PlyElement {
  std::string name;
  unsigned long long number = 0;
  std::vector<PlyProperty> properties;
};
struct PlyHead {
  std::string format;
  std::vector<PlyElement> elements;
  std::size_t data = 0; // where it ends
};

const std::map<std::string, std::size_t> &plySizes()
{
  static const std::map<std::string, std::size_t> bytes{{"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2},
                                                        {"int", 4},   {"uint", 4},   {"float", 4},   {"double", 8},
                                                        {"int8", 1},  {"uint8", 1},  {"int16", 2},   {"uint16", 2},
                                                        {"int32", 4}, {"uint32", 4}, {"float32", 4}, {"float64", 8}};
  return bytes;
}

bool isPlyFloat(const std::string &type) { return type[0] == 'f' || type[0] == 'd'; }

// Adds one line of the head; "" if it is right.
std::string plyFault(const std::string &line, std::size_t size, PlyHead &head)
{
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  const std::string kind = words.empty() ? "" : words[0];
  if (kind == "comment" || kind == "obj_info") {
    return "";
  }
  if (kind == "format" && words.size() == 3 && head.format.empty() && words[2] == "1.0" &&
      (words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian")) {
    head.format = words[1];
    return "";
  }
  if (kind == "property" && !head.elements.empty()) {
    std::vector<PlyProperty> &properties = head.elements.back().properties;
    if (words.size() == 3 && plySizes().count(words[1]) > 0) {
      properties.push_back({"", words[1]});
      return "";
    }
    if (words.size() == 5 && words[1] == "list" && plySizes().count(words[2]) + plySizes().count(words[3]) == 2 &&
        !isPlyFloat(words[2])) {
      properties.push_back({words[2], words[3]});
      return "";
    }
  }
  if (kind == "element" && words.size() == 3 && words[2].size() < 12 &&
      words[2].find_first_not_of("0123456789") == std::string::npos) {
    head.elements.push_back({words[1], std::stoull(words[2]), {}});
    return head.elements.back().number <= size
               ? ""
               : "says " + words[2] + " of the element " + vpPrintable(words[1], 60) + ", more than it has bytes";
  }
  return "\"" + vpPrintable(line, 60) + "\" is no line of a .ply head";
}

PlyHead readPlyHead(const std::string &bytes, const std::string &file)
{
  PlyHead head;
  for (std::size_t at = 0, number = 1; at < bytes.size(); ++number) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    std::string line = bytes.substr(at, std::min<std::size_t>(end - at, 1000));
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    at = end + 1;
    if (number > 1 && line == "end_header" && !head.format.empty()) {
      head.data = std::min(at, bytes.size());
      return head;
    }
    const std::string fault = number == 1 && line == "ply" ? "" : plyFault(line, bytes.size(), head);
    if (!fault.empty()) {
      fail(file, "line " + std::to_string(number) + ": " + fault);
    }
  }
  fail(file, "ends within its head");
}

// A list in text has as many values as it says. One line for each element; assimp passes over empty ones.
void requireTextLists(const std::string &bytes, const PlyHead &head, const std::string &file)
{
  constexpr const char *blanks = " \t\r";
  std::size_t at = head.data;
  for (const PlyElement &element : head.elements) {
    for (unsigned long long i = 0; i < element.number; ++i) {
      at = std::min(bytes.find_first_not_of(" \t\r\n", at), bytes.size());
      const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
      const auto next = [&] { // of the line
        const std::size_t word = std::min(bytes.find_first_not_of(blanks, at), end);
        at = std::min(bytes.find_first_of(blanks, word), end);
        return word;
      };
      for (const PlyProperty &property : element.properties) {
        const std::size_t word = next();
        if (property.count.empty()) {
          continue;
        }
        unsigned long long count = 0;
        const std::from_chars_result read = std::from_chars(bytes.data() + word, bytes.data() + at, count);
        if (read.ec != std::errc() || count > end - at) {
          fail(file, "a list of the element " + vpPrintable(element.name, 60) + " has " +
                         vpPrintable(bytes.substr(word, at - word), 20) + " values, more than its line");
        }
        for (; count > 0; --count) {
          next();
        }
      }
      at = end;
    }
  }
}

// Binary data are as long as the head and the lists in it say.
void requireBinaryLists(const std::string &bytes, const PlyHead &head, const std::string &file)
{
  std::size_t at = head.data;
  const auto take = [&](unsigned long long count, std::size_t size) {
    if (count > (bytes.size() - at) / size) {
      fail(file, "ends within its data");
    }
    at += static_cast<std::size_t>(count) * size;
  };
  for (const PlyElement &element : head.elements) {
    for (unsigned long long i = 0; i < element.number; ++i) {
      for (const PlyProperty &property : element.properties) {
        unsigned long long count = 1;
        if (!property.count.empty()) {
          const std::size_t size = plySizes().at(property.count);
          take(1, size);
          count = 0;
          for (std::size_t k = 0; k < size; ++k) {
            const std::size_t from = head.format == "binary_big_endian" ? at - size + k : at - 1 - k;
            count = count << 8 | static_cast<unsigned char>(bytes[from]);
          }
        }
        take(count, plySizes().at(property.type));
      }
    }
  }
}

// Assimp takes line ends at the beginning of binary data for a part of the head, and reads on one byte late. As the first byte of a
// floating-point number, in either byte order, such a byte loses its last bit: 1e-7 of the number, or all of one below 1e-30.
void hideLineEnd(std::string &bytes, const PlyHead &head, const std::string &file)
{
  if (head.data >= bytes.size() || (bytes[head.data] != '\n' && bytes[head.data] != '\r')) {
    return;
  }
  char &first = bytes[head.data];
  for (const PlyElement &element : head.elements) {
    if (element.number == 0 || element.properties.empty()) {
      continue;
    }
    if (element.properties[0].count.empty() && isPlyFloat(element.properties[0].type)) {
      first = static_cast<char>(first ^ 1);
      return;
    }
    fail(file, "its binary data begins with a byte " + std::to_string(static_cast<int>(first)) +
                   ", which is mistaken for the end of a line; save it as text");
  }
}

} // namespace

void vpRequirePlyOutline(std::string &bytes, const std::string &file)
{
  const PlyHead head = readPlyHead(bytes, file);
  if (head.format == "ascii") {
    requireTextLists(bytes, head, file);
    return;
  }
  requireBinaryLists(bytes, head, file);
  hideLineEnd(bytes, head, file);
}
