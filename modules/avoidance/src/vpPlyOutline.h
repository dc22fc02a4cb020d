/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Checks a .ply file before assimp parses it.
#ifndef vpPlyOutline_h
#define vpPlyOutline_h

#include <string>

/*
 * Refuses another head than the format has, and one that promises more elements, or values of a list, than there are bytes. Binary
 * data that begin with what assimp takes for the end of a line are changed by 1e-7 of their first number. Throws vpFileError.
 */
void vpRequirePlyOutline(std::string &bytes, const std::string &file);

#endif
