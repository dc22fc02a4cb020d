/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outputFile.h
 * \brief Files that are written completely or not at all, and folders that only one process at a time may write into.
 */
#ifndef vpApp_outputFile_h
#define vpApp_outputFile_h

#include <filesystem>
#include <string>

namespace vpApp
{
/*!
 * Check a file name before the work, not after it.
 * \throw std::runtime_error naming the file when its folder does not exist or it is a folder itself.
 */
void requireWritable(const std::filesystem::path &file);

/*!
 * Write \e content to \e file, replacing an earlier file atomically. After an error the earlier file is kept.
 * \throw std::runtime_error naming the file when writing fails.
 */
void writeWholeFile(const std::filesystem::path &file, const std::string &content);

/*!
 * \brief Creates a folder and holds the lock on a mark file in it. The system releases the lock when the process ends
 * in any way; a remaining mark shows that the folder and its content are a leftover that the next owner may remove.
 */
class FolderLock
{
public:
  /*!
   * \param folder : Created if missing; its parent must exist.
   * \param owner : Name of the program, written into the mark.
   * \throw std::runtime_error when another process holds the lock, when the folder is no leftover, or when the system
   * refuses: no permission, read-only or full disk.
   */
  FolderLock(const std::filesystem::path &folder, const std::string &owner);
  //! Releases the lock. The folder and the mark stay unless remove() was called.
  ~FolderLock();
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;

  //! Remove the folder and its content, the mark last.
  void remove();
  //! True if the file is a mark.
  [[nodiscard]] static bool isMark(const std::filesystem::path &file);
  //! True for a folder marked by \e owner, or an empty one.
  [[nodiscard]] static bool isLeftoverOf(const std::string &owner, const std::filesystem::path &folder);

private:
  void lock(const std::string &owner);
  void clear() const;
  void writeMark(const std::string &owner) const;

  std::filesystem::path m_folder;
  int m_mark = -1; // file descriptor
};
} // namespace vpApp

#endif
