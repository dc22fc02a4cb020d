/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpMeshPath.h
 * \brief Finds the mesh files that a URDF names. Not installed.
 */
#ifndef vpMeshPath_h
#define vpMeshPath_h

#include <string>
#include <vector>

/*!
 * \brief Paths of files from the names in a URDF.
 *
 * - `package://NAME/REST` and `model://NAME/REST`: REST in the package NAME. A folder is the package if it has this
 *   name or a package.xml with it. Searched: each given folder and the folder NAME in it, then likewise the folders
 *   above the URDF.
 * - `file://PATH` and any other: absolute, or relative to the folder of the URDF.
 *
 * The suffix of the file may differ in its letter case (`arm.STL` for `arm.stl`).
 */
class vpMeshPath
{
public:
  //! \param urdf : The URDF file. \param packagePaths : Folders of packages, or packages.
  vpMeshPath(const std::string &urdf, const std::vector<std::string> &packagePaths);
  //! Path of an existing regular file; empty if there is none.
  [[nodiscard]] std::string find(const std::string &name) const;
  //! Where packages are searched, for messages.
  [[nodiscard]] std::string searched() const;

private:
  std::string m_folder;               // of the URDF
  std::vector<std::string> m_folders; // where packages are searched, in this order
  std::size_t m_given = 0;            // the first of them were given by the caller
};

#endif
