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
 * themselves or are repeated too often, skins, arrays that do not hold what is read from them, indices without inputs, and
 * what vpRequirePlyOutline() refuses. Materials, pictures, animations, skins, cameras and lights of a .dae file, which a
 * mesh does not need, are taken out of bytes. extension: in lower case, without the dot. Throws vpFileError.
 */
void vpRequireMeshOutline(std::string &bytes, const std::string &extension, const std::string &file);

#endif
