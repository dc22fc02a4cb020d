/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPictureFile.h
 * \brief Reading of image files in all modules and programs: all pages, oriented as the file specifies, as grey values
 * of 8 bits. Not installed: only .cpp files include it, and their targets compile vpPictureFile.cpp.
 */
#ifndef vpPictureFile_h
#define vpPictureFile_h

#include <opencv2/core.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace vpPictures
{
//! True for names with the extension of a readable image format.
[[nodiscard]] bool isImageName(const std::string &file);

/*!
 * \brief An image file with one page or, for TIFF, several. Thumbnails and masks in a TIFF do not count as pages.
 */
class File
{
public:
  //! \throw std::runtime_error "NAME: cannot be read" or "NAME: is not an image ..."; a page may still be unreadable.
  explicit File(std::string name);
  [[nodiscard]] const std::string &name() const { return m_name; }
  //! Number of pages, at least 1.
  [[nodiscard]] std::size_t pages() const { return m_pages.empty() ? 1 : m_pages.size(); }
  //! True if the page list is incomplete: the file is truncated, and pages are missing.
  [[nodiscard]] bool isCut() const { return m_cut; }
  //! "NAME", or "page 3 of NAME" (counted from 1) if there are several.
  [[nodiscard]] std::string nameOf(std::size_t page) const;
  /*!
   * A page as stored, but rotated and mirrored according to its orientation (EXIF in JPEG and PNG, the tag of TIFF), as
   * in an image viewer.
   * \throw std::runtime_error naming the page if it cannot be read or is truncated.
   */
  [[nodiscard]] cv::Mat read(std::size_t page);
  //! Largest possible value if stated by the file (PGM, PPM), else 0.
  [[nodiscard]] unsigned int white() const { return m_white; }

private:
  void load();

  std::string m_name;
  std::vector<std::uint64_t> m_pages; // offsets of the directories of a TIFF file; empty: not a TIFF
  bool m_bigTiff = false, m_littleEndian = true, m_cut = false;
  unsigned int m_white = 0;
  std::string m_content; // loaded at the first read()
};

/*!
 * \brief Converts images to 8-bit grey, all images of a recording with the same scale.
 *
 * Colour by OpenCV's weights (0.299, 0.587, 0.114). 8-bit values are unchanged. With more bits, the largest possible
 * value is mapped to 255 if the format states it (PGM); otherwise the largest value of the smallest bit depth, at least
 * 8, that holds all values so far: for a 12-bit camera with 16-bit files, 4095 becomes 255. A later image with larger
 * values widens that range from there on.
 */
class GreyScale
{
public:
  /*!
   * \param picture : 8 or 16 bits, 1, 3 or 4 channels. \param white : Largest possible value; 0: not stated.
   * \param name : Prefix of the error message.
   * \return CV_8UC1; may share the pixels of \e picture.
   * \throw std::runtime_error if the image has another type or number of channels.
   */
  [[nodiscard]] cv::Mat toGrey(const cv::Mat &picture, unsigned int white, const std::string &name);
  //! Conversions of colours and values, in sentences; empty: none.
  [[nodiscard]] std::string remark() const;
  //! Conversions of the values alone.
  [[nodiscard]] std::string depthRemark() const;

private:
  bool m_colour = false;
  unsigned int m_bits = 0;       // of the files, if not 8
  unsigned int m_white = 0;      // becomes 255
  unsigned int m_firstWhite = 0; // before it was widened
  std::string m_widenedAt;
};

/*!
 * Reads the single image of a file as 8-bit grey.
 * \param scale : Shared by all files of one recording; also gives the remark.
 * \throw std::runtime_error naming the file, also if it has several pages.
 */
[[nodiscard]] cv::Mat readGreyPicture(const std::string &file, GreyScale &scale);
} // namespace vpPictures

#endif
