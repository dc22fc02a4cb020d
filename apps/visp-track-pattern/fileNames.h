/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fileNames.h
 * \brief Order, numbers and gaps of images from their file names.
 */
#ifndef trackPattern_fileNames_h
#define trackPattern_fileNames_h

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trackPattern
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
} // namespace trackPattern

#endif
