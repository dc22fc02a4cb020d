/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPictureFile.h
 * \brief How every module and program of visp-direct reads image files: all pages, turned as the file says, as grey values of
 * 8 bits. Not installed: only .cpp files include it, and their targets compile vpPictureFile.cpp.
 */
#ifndef vpPictureFile_h
#define vpPictureFile_h

#include <opencv2/core.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace vpPictures
{
//! True for names that end like an image file that can be read.
[[nodiscard]] bool isImageName(const std::string &file);

/*!
 * \brief An image file, of one page or, TIFF, of many. Reduced copies and masks among the pages of a TIFF do not count.
 */
class File
{
public:
  //! \throw std::runtime_error "NAME: cannot be read" or "NAME: is not an image ..."; a page may still be unreadable.
  explicit File(std::string name);
  [[nodiscard]] const std::string &name() const { return m_name; }
  //! At least 1.
  [[nodiscard]] std::size_t pages() const { return m_pages.empty() ? 1 : m_pages.size(); }
  //! True when the list of the pages ends in the open: the file was cut, and pages are missing.
  [[nodiscard]] bool isCut() const { return m_cut; }
  //! "NAME", or "page 3 of NAME" (counted from 1) when there are more.
  [[nodiscard]] std::string nameOf(std::size_t page) const;
  /*!
   * A page as it is stored, but turned and mirrored as its orientation says (EXIF in JPEG and PNG, the tag of TIFF), so
   * that it stands as an image viewer shows it.
   * \throw std::runtime_error naming the page when it cannot be read or is cut short.
   */
  [[nodiscard]] cv::Mat read(std::size_t page);
  //! Largest possible value where the file says so (PGM, PPM); 0: it does not.
  [[nodiscard]] unsigned int white() const { return m_white; }

private:
  void load();

  std::string m_name;
  std::vector<std::uint64_t> m_pages; // offsets of the directories of a TIFF file; empty: no TIFF
  bool m_bigTiff = false, m_littleEndian = true, m_cut = false;
  unsigned int m_white = 0;
  std::string m_content; // loaded at the first read()
};

/*!
 * \brief Makes pictures grey with 8 bits, all of a recording by one scale.
 *
 * Colour by OpenCV's weights (0.299, 0.587, 0.114). Values of 8 bits stay as they are. Of more bits, the largest possible
 * value becomes 255 where the format states it (PGM); otherwise the largest value of the least number of bits, at least 8,
 * that holds all values so far: of a camera with 12 bits in files of 16, 4095 becomes 255. A later picture with larger
 * values widens that range from there on.
 */
class GreyScale
{
public:
  /*!
   * \param picture : 8 or 16 bits, 1, 3 or 4 values a pixel. \param white : Largest possible value; 0: not stated.
   * \param name : Begins the complaint.
   * \return CV_8UC1; may share the pixels of \e picture.
   * \throw std::runtime_error when the picture has other values or another number of them.
   */
  [[nodiscard]] cv::Mat toGrey(const cv::Mat &picture, unsigned int white, const std::string &name);
  //! What was done to colours and values, in sentences; empty: nothing.
  [[nodiscard]] std::string remark() const;
  //! What was done to the values alone.
  [[nodiscard]] std::string depthRemark() const;

private:
  bool m_colour = false;
  unsigned int m_bits = 0;       // of the files, where they were not 8
  unsigned int m_white = 0;      // becomes 255
  unsigned int m_firstWhite = 0; // before it was widened
  std::string m_widenedAt;
};

/*!
 * The single picture of a file, grey with 8 bits.
 * \param scale : As it is needed for several files of one recording, or for its remark.
 * \throw std::runtime_error naming the file, when it holds several pages too.
 */
[[nodiscard]] cv::Mat readGreyPicture(const std::string &file, GreyScale &scale);
} // namespace vpPictures

#endif
