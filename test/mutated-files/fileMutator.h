/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file fileMutator.h
 * \brief Damages files at random, and sees what a reader makes of them.
 */
#ifndef fileMutator_h
#define fileMutator_h

#include <functional>
#include <random>
#include <string>
#include <vector>

/*!
 * \brief Makes a damaged copy of a text: bits turned, pieces cut out, doubled or taken from another file, numbers replaced
 * by extreme ones, words exchanged, brackets and elements nested, bytes put in that are no text.
 */
class FileMutator
{
public:
  //! \param files : Good files of one format, to begin with and to take pieces from.
  explicit FileMutator(std::vector<std::string> files) : m_files(std::move(files)) {}
  [[nodiscard]] std::string mutate(std::mt19937_64 &random) const;

private:
  std::vector<std::string> m_files;
};

//! \brief What became of the damaged files.
struct MutationCount {
  unsigned int accepted = 0, refused = 0;
};

/*!
 * Damage files and let \e read read them. Accepted is success, and an exception with one printable sentence that names the
 * file; anything else fails the present test and names the file, which is then kept.
 * \param files : Paths of good files. \param extension : Of the damaged ones (".json"). \param count : How many.
 * \param read : Reads the file of this path.
 */
MutationCount readMutated(const std::vector<std::string> &files, const std::string &extension, unsigned int count,
                          const std::function<void(const std::string &)> &read);

//! Damaged files of each format: \e ctest, times the environment variable VISP_DIRECT_LONG_TESTS.
unsigned int mutationCount(unsigned int ctest);

#endif
