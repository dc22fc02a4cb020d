/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
// Checks a mesh file before assimp parses it.
#ifndef vpMeshFileOutline_h
#define vpMeshFileOutline_h

#include <string>

/*
 * Refuses what assimp would not survive: XML that is not well-formed or deeply nested, nodes of a .dae file that repeat
 * themselves or are repeated too often, skins, arrays that do not hold what is read from them, and a .ply file with
 * another head than the format has, or that promises more elements than it has bytes. Materials, pictures, animations,
 * skins, cameras and lights of a .dae file, which a mesh does not need, are taken out of bytes. Binary data of a .ply
 * file that begins with what assimp takes for the end of a line is changed by 1e-7 of the first number. extension: in
 * lower case, without the dot. Throws vpFileError.
 */
void vpRequireMeshOutline(std::string &bytes, const std::string &extension, const std::string &file);

#endif
