/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "vpCatch.h"

#include "fileMutator.h"

#include "vpFileText.h"

#include <ctime>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
constexpr double LONGEST = 20.; // s, for one file; a reader that never ends is ended by ctest

using Random = std::mt19937_64;

std::size_t below(Random &random, std::size_t count)
{
  return count == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

template <class List> auto oneOf(Random &random, const List &list) { return list[below(random, list.size())]; }

std::string repeated(const std::string &piece, std::size_t count)
{
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += piece;
  }
  return text;
}

void flipBits(std::string &text, Random &random)
{
  for (std::size_t i = 0, count = 1 + below(random, 8); i < count && !text.empty(); ++i) {
    text[below(random, text.size())] ^= static_cast<char>(1U << below(random, 8));
  }
}

void cutOut(std::string &text, Random &random)
{
  text.erase(below(random, text.size() + 1), below(random, 2) == 0 ? std::string::npos : 1 + below(random, 200));
}

void copyPiece(std::string &text, Random &random)
{
  const std::string piece = text.substr(below(random, text.size() + 1), 1 + below(random, 300));
  text.insert(below(random, text.size() + 1), repeated(piece, 1 + below(random, 3)));
}

void splice(std::string &text, const std::string &other, Random &random)
{
  const std::size_t from = below(random, other.size() + 1);
  text = text.substr(0, below(random, text.size() + 1)) + other.substr(from);
}

// A run of characters of a kind that begins at or after a random place.
template <class Belongs>
std::pair<std::size_t, std::size_t> findToken(const std::string &text, Random &random, Belongs belongs)
{
  std::size_t start = below(random, text.size() + 1);
  while (start < text.size() && !belongs(text[start])) {
    ++start;
  }
  std::size_t end = start;
  while (end < text.size() && belongs(text[end])) {
    ++end;
  }
  return {start, end - start};
}

void replaceNumber(std::string &text, Random &random)
{
  static const std::vector<std::string> numbers = {"0",
                                                   "-0",
                                                   "-1",
                                                   "1",
                                                   "2",
                                                   "1e999",
                                                   "-1e999",
                                                   "1e308",
                                                   "-1e308",
                                                   "1e154",
                                                   "1e-320",
                                                   "2147483647",
                                                   "2147483648",
                                                   "-2147483649",
                                                   "4294967295",
                                                   "4294967296",
                                                   "18446744073709551616",
                                                   "99999999999999999999999",
                                                   "nan",
                                                   "inf",
                                                   "-inf",
                                                   "0x10",
                                                   "1e19",
                                                   "0.1.2",
                                                   "1,5",
                                                   "--1",
                                                   "%s%n",
                                                   "null",
                                                   "true",
                                                   "\"1\"",
                                                   "[]",
                                                   "{}",
                                                   ""};
  const auto [at, size] = findToken(
      text, random, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e'; });
  text.replace(at, size, oneOf(random, numbers));
}

void replaceWord(std::string &text, const std::string &other, Random &random)
{
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto [from, length] = findToken(other, random, isLetter);
  const auto [at, size] = findToken(text, random, isLetter);
  text.replace(at, size, other.substr(from, length));
}

void nest(std::string &text, Random &random)
{
  static const std::vector<std::string> pieces = {
      "[", "{\"a\":", "<a>",    "<link name=\"a\">", "]", "}", "</a>", "\x03", "f 1 1 1\n", "#", "\"",
      "(", "-",       "[[1,2],"};
  static const std::vector<std::size_t> counts = {10, 63, 64, 65, 1000, 100000};
  text.insert(below(random, text.size() + 1), repeated(oneOf(random, pieces), oneOf(random, counts)));
}

void putIn(std::string &text, Random &random)
{
  static const std::vector<std::string> pieces = {std::string(1, '\0'),
                                                  "\x1b[31m",
                                                  "\x7f",
                                                  "\xc2\x9b",
                                                  "\xe2\x80\xae",
                                                  "\xff",
                                                  "\xc3",
                                                  "\xed\xa0\x80",
                                                  "\r",
                                                  "\n",
                                                  "\t",
                                                  "%",
                                                  "%s%n",
                                                  "&#37;",
                                                  "\xef\xbb\xbf",
                                                  "\\u0000",
                                                  "\\ud800",
                                                  "\"",
                                                  "\\",
                                                  "<",
                                                  ">",
                                                  "/>",
                                                  "<!--",
                                                  "-->",
                                                  "<![CDATA[",
                                                  "<?xml ?>",
                                                  "//",
                                                  "/*",
                                                  ",",
                                                  ":"};
  text.insert(below(random, text.size() + 1), repeated(oneOf(random, pieces), 1 + below(random, 3)));
}

void setBytes(std::string &text, Random &random)
{
  static const std::vector<char> bytes = {'\0', '\x01', '\x7f', '\x80', '\xff'};
  const std::size_t at = below(random, text.size() + 1);
  const std::size_t size = std::min<std::size_t>(1 + below(random, 8), text.size() - at);
  text.replace(at, size, std::string(size, oneOf(random, bytes)));
}

bool isPrintableSentence(const std::string &text) { return !text.empty() && text == vpPrintable(text, text.size()); }
} // namespace

std::string FileMutator::mutate(Random &random) const
{
  std::string text = oneOf(random, m_files);
  const std::string other = oneOf(random, m_files);
  // Mostly one damage, and mostly one that leaves the form: else hardly a file gets to its meaning.
  static const std::vector<std::size_t> counts = {1, 1, 1, 1, 2, 2, 3, 5};
  for (std::size_t i = 0, count = oneOf(random, counts); i < count; ++i) {
    switch (below(random, 16)) {
    case 0:
      flipBits(text, random);
      break;
    case 1:
      cutOut(text, random);
      break;
    case 2:
      copyPiece(text, random);
      break;
    case 3:
      splice(text, other, random);
      break;
    case 4:
      nest(text, random);
      break;
    case 5:
      putIn(text, random);
      break;
    case 6:
      setBytes(text, random);
      break;
    case 7:
    case 8:
    case 9:
      replaceWord(text, other, random);
      break;
    default:
      replaceNumber(text, random);
    }
  }
  return text;
}

MutationCount readMutated(const std::vector<std::string> &files, const std::string &extension, unsigned int count,
                          const std::function<void(const std::string &)> &read)
{
  std::vector<std::string> contents;
  for (const std::string &file : files) {
    contents.push_back(vpReadFileText(file));
  }
  const FileMutator mutator(contents);
  // In the working folder, so that what kills the program is found.
  const std::string path = "mutated-" + std::to_string(getpid()) + extension;
  MutationCount result;
  for (unsigned int i = 0; i < count; ++i) {
    Random random = vpTestSupport::generator(i);
    std::ofstream(path, std::ios::binary) << mutator.mutate(random);
    std::string sentence = "accepted";
    const std::clock_t start = std::clock(); // of the processor: a busy disk may hold up any file
    try {
      read(path);
      ++result.accepted;
    }
    catch (const std::bad_alloc &) {
      sentence = ""; // a small file shall not need more memory than there is
    }
    catch (const std::exception &error) {
      sentence = error.what();
      ++result.refused;
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    CAPTURE(path, i, vpTestSupport::seed(), sentence, seconds);
    REQUIRE(isPrintableSentence(sentence));
    REQUIRE((sentence == "accepted" || sentence.find(path) != std::string::npos));
    REQUIRE(seconds < LONGEST);
  }
  fs::remove(path);
  return result;
}

unsigned int mutationCount(unsigned int ctest)
{
  const char *factor = std::getenv("VISP_DIRECT_LONG_TESTS");
  return factor == nullptr ? ctest : static_cast<unsigned int>(ctest * std::max(1., std::atof(factor)));
}
