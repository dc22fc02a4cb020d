/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fileSource.h
 * \brief Images from files, with all their pages, where unreadable ones are skipped and reported.
 */
#ifndef vpApp_fileSource_h
#define vpApp_fileSource_h

#include "imageSource.h"

#include "vpPictureFile.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vpApp
{
/*!
 * The files matching a pattern such as "img%04d.png", by number.
 * \throw std::runtime_error naming the pattern when it is invalid or no file matches.
 */
[[nodiscard]] std::vector<std::filesystem::path> filesOfPattern(const std::string &pattern);

/*!
 * The images of a folder, in the order of the numbers in their names ("2.png" before "10.png"). May be empty.
 * \param hidden : Names that begin with a dot, such as "._2.png" of macOS; they are not images.
 */
[[nodiscard]] std::vector<std::filesystem::path> imagesOfFolder(const std::filesystem::path &folder,
                                                                std::vector<std::filesystem::path> &hidden);

/*!
 * \brief The numbers of a recording: the last run of digits in each name, and the text before it.
 *
 * Files are consecutive if the text before the number is the same and the number changes by at most 1.5 times the usual
 * step (the median over the recording, so that every tenth image, or time stamps, are no gaps), in the usual direction.
 */
class FileNumbers
{
public:
  explicit FileNumbers(const std::vector<std::filesystem::path> &files);
  //! The number in the name of file \e i; nullopt if it has none, or more than 18 digits.
  [[nodiscard]] const std::optional<long long> &of(std::size_t i) const { return m_names[i].number; }
  //! True if images are missing between files \e i < \e j, where those between them could not be read.
  [[nodiscard]] bool isGap(std::size_t i, std::size_t j) const;

private:
  struct Name {
    std::string before;
    std::optional<long long> number;
  };
  std::vector<Name> m_names;
  double m_usualStep = 0.;
};

/*!
 * \brief One image after the other from a list of files.
 *
 * An unreadable page or file is counted and skipped. Gaps are detected from the numbers in the names (see FileNumbers),
 * and within a file of several pages at unreadable pages.
 */
class FileSource : public ImageSource
{
public:
  /*!
   * \param files : At least one. \param description : For messages. \param frames : Maximum number of images; 0: all.
   */
  FileSource(std::vector<std::filesystem::path> files, std::string description, std::size_t frames = 0);
  //! Count files that are not images as skipped, with the reason.
  void leaveOut(const std::vector<std::filesystem::path> &files, const std::string &reason);

  //! \throw std::runtime_error when no image could be read at all, with the reason of the first.
  [[nodiscard]] bool next(vpImage<unsigned char> &image) override;
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] unsigned int number() const override { return m_number; }
  [[nodiscard]] bool isAfterGap() const override { return m_afterGap; }
  [[nodiscard]] std::size_t count() const override { return m_count; }
  [[nodiscard]] std::string description() const override { return m_description; }
  [[nodiscard]] std::vector<std::string> remarks() const override;

private:
  struct Place {
    std::size_t file = 0, page = 0;
  };

  bool readNext(vpImage<unsigned char> &image);
  void leaveOut(const std::string &sentence);
  void advance();
  void finishRead();

  std::vector<std::filesystem::path> m_files;
  FileNumbers m_numbers;
  std::string m_description;
  std::size_t m_frames;
  std::size_t m_count = 0;                  // expected number of images, at most m_frames
  bool m_several = false;                   // a file has several pages: images are numbered by their position
  std::unique_ptr<vpPictures::File> m_open; // m_next.file
  vpPictures::GreyScale m_scale;
  Place m_next, m_last;       // m_last: read by the last next()
  std::size_t m_position = 0; // of m_next among all images
  std::size_t m_read = 0;
  unsigned int m_number = 0;
  bool m_afterGap = false, m_pageMissing = false;
  std::size_t m_leftOut = 0, m_cut = 0;
  std::vector<std::string> m_reasons; // first few reasons for skipped files
  std::vector<std::string> m_gaps;    // first few gaps
  std::size_t m_gapCount = 0;
};
} // namespace vpApp

#endif
