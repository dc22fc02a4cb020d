/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outputFolder.h
 * \brief Result folder of a program.
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
 * \brief A result is written into the sub-folder `unfinished-run` of the result folder; commit() moves its files to
 * their final location, summary.json last.
 *
 * Files may grow there during the run. Until commit() an earlier result stays unchanged. Runs that end
 * differently:
 *
 * | end | result folder | `unfinished-run` |
 * |---|---|---|
 * | destructor without commit() | unchanged, removed if it is new | removed |
 * | keepUnfinished() | unchanged | holds the data so far, until the next run |
 * | killed | unchanged; while commit() moves files, summary.json has `"status": "unfinished"` | left to the next run |
 *
 * The result folder may be new, empty, a symbolic link to such a folder, a mount point, or hold the result of an
 * earlier run of the same program, identified by its summary.json. Only the files listed there are removed or replaced,
 * and only if they are plain files; everything else in the folder belongs to the user and is not touched. One run at a
 * time may write into a folder.
 */
class OutputFolder
{
public:
  /*!
   * \param program : Name of the program, compared with the field `program` of an existing summary.json.
   * \param folder : The result folder.
   * \throw std::runtime_error naming the folder when it holds other files, another run is writing into it, or it is not
   * writable: no permission, read-only or full disk. So construct it before the work.
   */
  OutputFolder(std::string program, const std::string &folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder &) = delete;
  OutputFolder &operator=(const OutputFolder &) = delete;

  /*!
   * Path for writing the result file \e name ("video/pbvs1.mp4") until commit(); sub-folders are created.
   * \throw std::runtime_error when a user file has this name in the result folder.
   */
  [[nodiscard]] std::string file(const std::string &name);
  //! Write \e content to file(name). \throw std::runtime_error naming the file when writing fails.
  void write(const std::string &name, const std::string &content);
  /*!
   * Write summary.json: \e summary with the fields `program` and `files` added, which identify our folder, and
   * `status`, "complete" by default.
   */
  void writeSummary(nlohmann::ordered_json summary);
  //! Move the result into place. Call writeSummary() before. \throw std::runtime_error naming the failed operation.
  void commit();
  /*!
   * Keep the data so far after a failure, when all files are closed: they stay in `unfinished-run`, with a
   * summary.json with `"status": "unfinished"` and the \e reason if it can still be written.
   * \return Part of a sentence for the user with their location.
   */
  [[nodiscard]] std::string keepUnfinished(const std::string &reason);
  //! The result folder.
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
  std::vector<std::string> m_formerFiles;    // written by the earlier run into m_folder
  std::unique_ptr<FolderLock> m_lock;
  bool m_stays = false; // keep m_unfinished after this run
};

//! The content of a file. \throw std::runtime_error naming the file when it cannot be read.
[[nodiscard]] std::string readFile(const std::filesystem::path &file);
} // namespace vpApp

#endif
