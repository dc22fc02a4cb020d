/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "fileSource.h"

#include "greyPicture.h"
#include "quietLibraries.h"

#include <visp3/direct_core/vpQuantile.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

namespace fs = std::filesystem;

namespace vpApp
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
  sortNaturally(files);
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

namespace
{
constexpr std::size_t NAMED = 3; // number of gaps and skipped files that are named
constexpr long long LARGEST_NUMBER = 999999999;

std::string listOf(const std::vector<std::string> &named, std::size_t all)
{
  std::string text;
  for (const std::string &one : named) {
    text += (text.empty() ? "" : "; ") + one;
  }
  return text + (all > named.size() ? "; and so on" : "");
}

// 1 for an unreadable file: it counts as one missing image.
std::size_t pagesOf(const fs::path &file)
{
  try {
    return vpPictures::File(file.string()).pages();
  }
  catch (const std::runtime_error &) {
    return 1;
  }
}
} // namespace

FileSource::FileSource(std::vector<fs::path> files, std::string description, std::size_t frames)
  : m_files(std::move(files)), m_numbers(m_files), m_description(std::move(description)), m_frames(frames)
{
  for (const fs::path &file : m_files) {
    const std::size_t pages = pagesOf(file);
    m_several = m_several || pages > 1;
    m_count += pages;
  }
  m_count = m_frames == 0 ? m_count : std::min(m_count, m_frames);
}

void FileSource::leaveOut(const std::vector<fs::path> &files, const std::string &reason)
{
  for (const fs::path &file : files) {
    leaveOut(file.string() + ": " + reason);
  }
}

void FileSource::leaveOut(const std::string &sentence)
{
  ++m_leftOut;
  if (m_reasons.size() < NAMED) {
    m_reasons.push_back(sentence);
  }
}

bool FileSource::next(vpImage<unsigned char> &image)
{
  while (m_next.file < m_files.size() && (m_frames == 0 || m_read < m_frames)) {
    if (readNext(image)) {
      return true;
    }
  }
  if (m_read == 0 && !m_reasons.empty()) {
    throw std::runtime_error(m_leftOut == 1 ? m_reasons[0]
                                            : "none of the images can be read; the first: " + m_reasons[0]);
  }
  return false;
}

// Reads the image at m_next and advances; false if it is unreadable.
bool FileSource::readNext(vpImage<unsigned char> &image)
{
  try {
    const QuietLibraries quiet;
    if (!m_open) {
      m_open = std::make_unique<vpPictures::File>(m_files[m_next.file].string());
    }
    copyGrey(m_scale.toGrey(m_open->read(m_next.page), m_open->white(), m_open->nameOf(m_next.page)), image);
  }
  catch (const std::runtime_error &error) {
    leaveOut(error.what());
    m_pageMissing = m_pageMissing || (m_open && m_open->pages() > 1);
    advance();
    return false;
  }
  finishRead();
  advance();
  return true;
}

void FileSource::finishRead()
{
  const std::string before = m_read > 0 ? name() : "";
  const bool sameFile = m_next.file == m_last.file;
  m_afterGap = m_read > 0 && (m_pageMissing || (!sameFile && m_numbers.isGap(m_last.file, m_next.file)));
  m_pageMissing = false;
  m_last = m_next;
  const std::optional<long long> &number = m_numbers.of(m_last.file);
  const bool byName = !m_several && number && *number <= LARGEST_NUMBER;
  m_number = static_cast<unsigned int>(byName ? *number : static_cast<long long>(m_position));
  ++m_read;
  if (m_afterGap) {
    ++m_gapCount;
    if (m_gaps.size() < NAMED) {
      m_gaps.push_back("after " + fs::path(before).filename().string() + " comes " +
                       fs::path(name()).filename().string());
    }
  }
}

void FileSource::advance()
{
  ++m_position;
  ++m_next.page;
  if (!m_open || m_next.page >= m_open->pages()) {
    if (m_open && m_open->isCut()) {
      ++m_cut;
      m_pageMissing = true;
    }
    m_open.reset();
    m_next = {m_next.file + 1, 0};
  }
}

std::string FileSource::name() const
{
  const std::string file = m_files[m_last.file].string();
  return m_several ? "page " + std::to_string(m_last.page + 1) + " of " + file : file;
}

std::vector<std::string> FileSource::remarks() const
{
  std::vector<std::string> all;
  if (m_gapCount > 0) {
    all.push_back(std::to_string(m_gapCount) +
                  (m_gapCount == 1 ? " gap: images are missing (" : " gaps: images are missing (") +
                  listOf(m_gaps, m_gapCount) + ").");
  }
  if (m_leftOut > 0) {
    all.push_back(std::to_string(m_leftOut) + (m_leftOut == 1 ? " image was" : " images were") + " left out (" +
                  listOf(m_reasons, m_leftOut) + ").");
  }
  if (m_cut > 0) {
    all.push_back(std::to_string(m_cut) + (m_cut == 1 ? " file is" : " files are") +
                  " cut short; the pages before the cut were read.");
  }
  if (!m_scale.remark().empty()) {
    all.push_back(m_scale.remark());
  }
  return all;
}
} // namespace vpApp
