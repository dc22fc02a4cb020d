/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file folderLock.h
 * \brief A folder that one process at a time may write into.
 */
#ifndef vpApp_folderLock_h
#define vpApp_folderLock_h

#include <filesystem>
#include <string>

namespace vpApp
{
/*!
 * \brief Makes a folder and holds the lock on a mark in it. The system releases the lock when the process ends, however
 * it ends; the mark stays then, and tells that the folder and all in it are a leftover that the next owner may remove.
 */
class FolderLock
{
public:
  /*!
   * \param folder : Made if it does not exist; its parent does.
   * \param owner : Program that the mark names.
   * \throw std::runtime_error when another process holds the lock, when the folder is no leftover, or when the system
   * refuses: no permission, read-only or full disk.
   */
  FolderLock(const std::filesystem::path &folder, const std::string &owner);
  //! Releases the lock. The folder and the mark stay unless remove() was called.
  ~FolderLock();
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;

  //! Remove the folder with all in it, the mark last.
  void remove();
  //! True for the file that is the mark.
  [[nodiscard]] static bool isMark(const std::filesystem::path &file);
  //! True for a folder that \e owner marked, or that is empty.
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
