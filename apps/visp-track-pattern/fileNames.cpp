/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "fileNames.h"

#include "vpPictureFile.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace fs = std::filesystem;

VISP_DIRECT_USING_NAMESPACE

namespace trackPattern
{
namespace
{
// Compares runs of digits as numbers.
bool naturalLess(const std::string &a, const std::string &b)
{
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      std::size_t endA = i, endB = j;
      while (endA < a.size() && digit(a[endA])) {
        ++endA;
      }
      while (endB < b.size() && digit(b[endB])) {
        ++endB;
      }
      std::string numberA = a.substr(i, endA - i), numberB = b.substr(j, endB - j);
      numberA.erase(0, std::min(numberA.find_first_not_of('0'), numberA.size()));
      numberB.erase(0, std::min(numberB.find_first_not_of('0'), numberB.size()));
      if (numberA != numberB) {
        return numberA.size() != numberB.size() ? numberA.size() < numberB.size() : numberA < numberB;
      }
      i = endA;
      j = endB;
    }
    else if (a[i] != b[j]) {
      return a[i] < b[j];
    }
    else {
      ++i;
      ++j;
    }
  }
  return a.size() - i < b.size() - j;
}

void sortNaturally(std::vector<fs::path> &files)
{
  std::sort(files.begin(), files.end(),
            [](const fs::path &a, const fs::path &b) { return naturalLess(a.string(), b.string()); });
}
} // namespace

std::vector<fs::path> imagesOfFolder(const fs::path &folder, std::vector<fs::path> &hidden)
{
  std::vector<fs::path> files;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && vpPictures::isImageName(name)) {
      (name[0] == '.' ? hidden : files).push_back(entry.path());
    }
  }
  sortNaturally(files);
  sortNaturally(hidden);
  return files;
}

std::vector<fs::path> filesOfPattern(const std::string &pattern)
{
  const fs::path path(pattern);
  const std::string name = path.filename().string();
  const std::size_t percent = name.find('%');
  const std::size_t end = name.find_first_not_of("0123456789", percent + 1);
  if (percent == std::string::npos || end == std::string::npos || name[end] != 'd' ||
      name.find('%', end) != std::string::npos || path.parent_path().string().find('%') != std::string::npos) {
    throw std::runtime_error(pattern + ": is no pattern; it must have one %d or %04d in the file's name");
  }
  const std::string digits = name.substr(percent + 1, end - percent - 1);
  const std::size_t width = digits.empty() || digits.size() > 4 ? 0 : std::stoul(digits);
  const std::string start = name.substr(0, percent), rest = name.substr(end + 1);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  std::vector<fs::path> files;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, error)) {
    const std::string file = entry.path().filename().string();
    if (file.size() <= start.size() + rest.size() || file.compare(0, start.size(), start) != 0 ||
        file.compare(file.size() - rest.size(), rest.size(), rest) != 0) {
      continue;
    }
    const std::string number = file.substr(start.size(), file.size() - start.size() - rest.size());
    if (number.find_first_not_of("0123456789") == std::string::npos && number.size() >= width) {
      files.push_back(path.has_parent_path() ? entry.path() : entry.path().filename());
    }
  }
  if (error || files.empty()) {
    throw std::runtime_error(pattern + ": no file has such a name");
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path &a, const fs::path &b) { return naturalLess(a.string(), b.string()); });
  return files;
}

FileNumbers::FileNumbers(const std::vector<fs::path> &files)
{
  constexpr std::size_t mostDigits = 18;
  for (const fs::path &file : files) {
    const std::string stem = file.stem().string();
    const std::size_t end = stem.find_last_of("0123456789");
    Name name{stem, std::nullopt};
    if (end != std::string::npos) {
      const std::size_t before = stem.find_last_not_of("0123456789", end);
      const std::string digits = stem.substr(before + 1, end - before);
      if (digits.size() <= mostDigits) {
        name = {stem.substr(0, before + 1), std::stoll(digits)};
      }
    }
    m_names.push_back(std::move(name));
  }
  std::vector<double> steps;
  for (std::size_t i = 0; i + 1 < m_names.size(); ++i) {
    const Name &a = m_names[i], &b = m_names[i + 1];
    if (a.number && b.number && a.before == b.before) {
      steps.push_back(static_cast<double>(*b.number - *a.number));
    }
  }
  m_usualStep = steps.empty() ? 0. : vpMedian(std::move(steps));
}

bool FileNumbers::isGap(std::size_t i, std::size_t j) const
{
  const Name &a = m_names[i], &b = m_names[j];
  if (!a.number || !b.number) {
    return j != i + 1;
  }
  if (a.before != b.before) {
    return true;
  }
  const double step = static_cast<double>(*b.number - *a.number);
  return step * m_usualStep < 0. || std::abs(step) > 1.5 * std::abs(m_usualStep);
}
} // namespace trackPattern
