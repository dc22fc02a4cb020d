/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fileNames.h
 * \brief What the names of image files tell: their order, their numbers, and where images are missing.
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
 * The files that a pattern such as "img%04d.png" stands for, by number.
 * \throw std::runtime_error naming the pattern when it is none or no file is there.
 */
[[nodiscard]] std::vector<std::filesystem::path> filesOfPattern(const std::string &pattern);

/*!
 * The images of a folder, in the order of the numbers in their names ("2.png" before "10.png"). May be empty.
 * \param hidden : The names that begin with a dot, such as the companions "._2.png" of macOS; they are no images.
 */
[[nodiscard]] std::vector<std::filesystem::path> imagesOfFolder(const std::filesystem::path &folder,
                                                                std::vector<std::filesystem::path> &hidden);

/*!
 * \brief The numbers of a recording: the last run of digits in each name, and what stands before it.
 *
 * Files follow each other as long as the text before the number is the same and the number goes on by at most 1.5 times the
 * usual step (the median over the recording, so that every tenth image, or time stamps, are no gaps), the usual way round.
 */
class FileNumbers
{
public:
  explicit FileNumbers(const std::vector<std::filesystem::path> &files);
  //! The number in the name of file \e i; nothing when it has none, or more than 18 digits.
  [[nodiscard]] const std::optional<long long> &of(std::size_t i) const { return m_names[i].number; }
  //! True when images are missing between the files \e i < \e j, those between them could not be read.
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
