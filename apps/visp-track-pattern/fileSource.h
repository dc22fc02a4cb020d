/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fileSource.h
 * \brief Images from files, with all their pages; unreadable ones are skipped and reported.
 */
#ifndef trackPattern_fileSource_h
#define trackPattern_fileSource_h

#include "fileNames.h"
#include "imageSource.h"

#include "vpPictureFile.h"

namespace trackPattern
{
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
   * \param truth : May be null.
   */
  FileSource(std::vector<std::filesystem::path> files, std::string description, std::size_t frames,
             std::unique_ptr<TruthFiles> truth);
  //! Count files that are not images as skipped, with the reason.
  void leaveOut(const std::vector<std::filesystem::path> &files, const std::string &reason);

  //! \throw std::runtime_error when no image could be read at all, with the reason of the first.
  [[nodiscard]] bool next(vpImage<unsigned char> &image) override;
  [[nodiscard]] std::string name() const override;
  [[nodiscard]] unsigned int number() const override { return m_number; }
  [[nodiscard]] bool isAfterGap() const override { return m_afterGap; }
  [[nodiscard]] std::optional<FrameTruth> truth() const override
  {
    return m_truth ? m_truth->at(m_number) : std::nullopt;
  }
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
  std::unique_ptr<TruthFiles> m_truth;
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
} // namespace trackPattern

#endif
