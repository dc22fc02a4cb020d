/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "fileSource.h"

#include "greyPicture.h"
#include "quietLibraries.h"

#include <algorithm>
#include <stdexcept>

namespace fs = std::filesystem;

namespace trackPattern
{
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

FileSource::FileSource(std::vector<fs::path> files, std::string description, std::size_t frames,
                       std::unique_ptr<TruthFiles> truth)
  : m_files(std::move(files)), m_numbers(m_files), m_description(std::move(description)), m_frames(frames),
    m_truth(std::move(truth))
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
    const vpApp::QuietLibraries quiet;
    if (!m_open) {
      m_open = std::make_unique<vpPictures::File>(m_files[m_next.file].string());
    }
    vpApp::copyGrey(m_scale.toGrey(m_open->read(m_next.page), m_open->white(), m_open->nameOf(m_next.page)), image);
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
    all.push_back(
        std::to_string(m_gapCount) + (m_gapCount == 1 ? " gap: images are missing (" : " gaps: images are missing (") +
        listOf(m_gaps, m_gapCount) +
        "). How far the product moved meanwhile is not known: no displacement is given there, and a new epoch begins.");
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
} // namespace trackPattern
