/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file dataFile.h
 * \brief Location of the files of data/ at run time.
 */
#ifndef vpApp_dataFile_h
#define vpApp_dataFile_h

#include <string>

namespace vpApp
{
/*!
 * Path of a file of visp-direct's data folder: in the folder named by the environment variable `VISP_DIRECT_DATA` if it
 * is set, else in the installation that the running program is a part of (found from the program, so a moved one works),
 * else in the source tree that it was built from.
 * \param name : Path inside data/, for example "target/klimt.jpg".
 * \throw std::runtime_error naming the searched folders.
 */
[[nodiscard]] std::string dataFile(const std::string &name);

/*!
 * A text for the user in which each data/NAME is replaced by the path of that file or folder, found as in dataFile():
 * relative to the current folder if it is inside it, else absolute; between quotes where a shell needs them. A name that is not
 * found stays as it is.
 */
[[nodiscard]] std::string withDataPaths(const std::string &text);
} // namespace vpApp

#endif
