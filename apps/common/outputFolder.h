/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outputFolder.h
 * \brief The folder of a program's result.
 */
#ifndef vpApp_outputFolder_h
#define vpApp_outputFolder_h

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace vpApp
{
class FolderLock;

/*!
 * \brief A result is written into the sub-folder `unfinished-run` of the wanted folder; commit() moves its files into
 * their places, summary.json last.
 *
 * Files may grow there while the run goes on. Until commit() an earlier result stays as it was. What becomes of a run
 * that ends otherwise:
 *
 * | end | wanted folder | `unfinished-run` |
 * |---|---|---|
 * | destructor without commit() | as it was before, removed if it is new | removed |
 * | keepUnfinished() | as it was before | holds the data so far, until the next run |
 * | killed | as it was before; while commit() moves files, summary.json says `"status": "unfinished"` | left to the next run |
 *
 * The wanted folder may be new, empty, a symbolic link to such a folder, a mount point, or hold the result of an earlier
 * run of the same program, which its summary.json shows. Of an earlier result exactly the files that it names are removed
 * or replaced, as long as they are plain files; everything else in the folder is the user's and stays as it is. One run at
 * a time may write into a folder.
 */
class OutputFolder
{
public:
  /*!
   * \param program : Name of the program, compared with the field `program` of an existing summary.json.
   * \param folder : The wanted folder.
   * \throw std::runtime_error naming the folder when it is not ours to use, another run is writing into it, or the system
   * refuses to write: no permission, read-only or full disk. So construct it before the work.
   */
  OutputFolder(std::string program, const std::string &folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder &) = delete;
  OutputFolder &operator=(const OutputFolder &) = delete;

  /*!
   * Where to write the result's file \e name ("video/pbvs1.mp4") until commit(); sub-folders are made.
   * \throw std::runtime_error when something of the user's has this name in the wanted folder.
   */
  [[nodiscard]] std::string file(const std::string &name);
  //! Write \e content to file(name). \throw std::runtime_error naming the file when the disk refuses.
  void write(const std::string &name, const std::string &content);
  /*!
   * Write summary.json: \e summary with the fields `program` and `files` added, which make the folder ours, and `status`,
   * which is "complete" unless it is given.
   */
  void writeSummary(nlohmann::ordered_json summary);
  //! Put the result in place. Call writeSummary() before. \throw std::runtime_error naming what the system refuses.
  void commit();
  /*!
   * After a failure whose data so far are worth keeping, when all files are closed: they stay in `unfinished-run`, with a
   * summary.json of `"status": "unfinished"` and the \e reason if the disk still takes it.
   * \return A piece of sentence for the user that says where they are.
   */
  [[nodiscard]] std::string keepUnfinished(const std::string &reason);
  //! The wanted folder.
  [[nodiscard]] const std::filesystem::path &path() const { return m_folder; }

private:
  void readFormerResult();
  void makeFolder();
  void undo();
  [[nodiscard]] std::vector<std::string> newFiles() const;
  void requireFreePlace(const std::string &name) const;
  void removeFormer(const std::vector<std::string> &except) const;

  std::string m_program;
  std::filesystem::path m_folder;
  std::filesystem::path m_unfinished;
  std::vector<std::filesystem::path> m_made; // folders that did not exist, outermost last
  std::vector<std::string> m_formerFiles;    // that the earlier run wrote into m_folder
  std::unique_ptr<FolderLock> m_lock;
  bool m_stays = false; // m_unfinished, after this run
};

//! The content of a file. \throw std::runtime_error naming the file when it cannot be read.
[[nodiscard]] std::string readFile(const std::filesystem::path &file);
} // namespace vpApp

#endif
