/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file outputFolder.h
 * \brief A result folder that appears whole or not at all.
 */
#ifndef vpApp_outputFolder_h
#define vpApp_outputFolder_h

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace vpApp
{
/*!
 * \brief Everything is written into a temporary folder beside the wanted one, which commit() renames into place.
 *
 * An existing folder is replaced only if it is empty or holds the result of an earlier run of the same program, which
 * its summary.json shows. Files that the earlier run did not write are carried over, so a user's notes are not lost.
 * Without commit() the destructor removes the temporary folder, and all is as before.
 */
class OutputFolder
{
public:
  /*!
   * \param program : Name of the program, compared with the field `program` of an existing summary.json.
   * \param folder : The wanted folder.
   * \throw std::runtime_error naming the folder when it is not ours to replace or cannot be written beside.
   */
  OutputFolder(std::string program, const std::string &folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder &) = delete;
  OutputFolder &operator=(const OutputFolder &) = delete;

  //! Path under the temporary folder for the result's file \e name ("video/pbvs1.mp4"); sub-folders are made.
  [[nodiscard]] std::string file(const std::string &name);
  //! Write \e content to file(name). \throw std::runtime_error naming the file when the disk refuses.
  void write(const std::string &name, const std::string &content);
  //! Write summary.json: \e summary with the fields `program` and `files` added, which make the folder ours.
  void writeSummary(nlohmann::ordered_json summary);
  //! Put the result in place. \throw std::runtime_error naming the folder when the system refuses.
  void commit();
  //! The wanted folder.
  [[nodiscard]] const std::filesystem::path &path() const { return m_folder; }

private:
  void keepForeignFiles() const;

  std::string m_program;
  std::filesystem::path m_folder;
  std::filesystem::path m_temporary;
  std::vector<std::filesystem::path> m_madeParents; // outermost last
  std::vector<std::string> m_formerFiles;           // that the earlier run wrote into m_folder
  bool m_committed = false;
};

//! The content of a file. \throw std::runtime_error naming the file when it cannot be read.
[[nodiscard]] std::string readFile(const std::filesystem::path &file);
} // namespace vpApp

#endif
