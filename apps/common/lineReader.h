/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file lineReader.h
 * \brief Lines of a file, a pipe or standard input; Ctrl-C also interrupts waiting.
 */
#ifndef vpApp_lineReader_h
#define vpApp_lineReader_h

#include <string>

namespace vpApp
{
//! \brief Reads line by line, each as soon as it is available.
class LineReader
{
public:
  static constexpr std::size_t LONGEST = 64U << 20U; //!< Longest line, bytes.

  //! \param file : Path, or "-" for standard input. \throw std::runtime_error naming the file when it cannot be read.
  explicit LineReader(const std::string &file);
  ~LineReader();
  LineReader(const LineReader &) = delete;
  LineReader &operator=(const LineReader &) = delete;

  /*!
   * Read the next line without its line end; false at the end of the file.
   * \throw Interrupted after Ctrl-C. \throw std::runtime_error naming the file when it cannot be read, or the line when
   * it is longer than LONGEST.
   */
  [[nodiscard]] bool next(std::string &line);
  //! The file, or "standard input".
  [[nodiscard]] const std::string &name() const { return m_name; }

private:
  bool readMore();

  std::string m_name;
  int m_descriptor = 0;
  std::size_t m_line = 0;
  std::string m_buffer;
  std::size_t m_start = 0;    // data before it was returned
  std::size_t m_searched = 0; // no line ends before it
};
} // namespace vpApp

#endif
