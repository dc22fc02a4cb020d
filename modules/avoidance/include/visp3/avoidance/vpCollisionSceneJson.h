/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionSceneJson.h
 * \brief Scenes and tasks from a JSON file. Needs nlohmann_json when the module is built.
 */
#ifndef vpCollisionSceneJson_h
#define vpCollisionSceneJson_h

#include <visp3/avoidance/vpCollisionScene.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief A motion to plan in a scene.
 */
struct VISP_EXPORT vpMotionTask {
  std::string name;    //!< For reports.
  vpJointVector start; //!< rad or m.
  vpJointVector goal;  //!< rad or m, of the same size.
};

/*!
 * \ingroup group_avoidance
 * \brief A photograph on the front of a box, so that a camera can recognise it.
 */
struct VISP_EXPORT vpObjectPhoto {
  std::string object; //!< Name of the box; the photograph is on its face z = -size.z / 2, x right, y down.
  std::string target; //!< Name in a database of photographs, see vpPlanarTargetDatabase.
};

/*!
 * \ingroup group_avoidance
 * \brief What a scene's file holds.
 */
struct VISP_EXPORT vpCollisionSceneFile {
  std::string name;                  //!< For reports.
  vpCollisionSceneSpec spec;         //!< For vpCollisionScene; its source is the file.
  std::vector<vpObjectPhoto> photos; //!< May be empty; each target and each object once.
  std::vector<vpMotionTask> tasks;   //!< May be empty.
  std::vector<std::string> warnings; //!< One sentence each: meshes with holes that are taken as surfaces.
};

/*!
 * \ingroup group_avoidance
 * \brief Reads a scene; data/scene/README.md has the fields. Unknown fields are errors, so that a misspelt one does not
 * go unseen. Meshes and octrees are looked for beside the file.
 * \throw vpException (ioError) when it or a file that it names cannot be read, (badValue) when it is no JSON or a field
 * is missing or out of range; one sentence with the file and the element, as "shelf.json: objects[2].size_m is missing".
 */
[[nodiscard]] VISP_EXPORT vpCollisionSceneFile vpLoadCollisionScene(const std::string &file);

END_VISP_NAMESPACE
#endif
