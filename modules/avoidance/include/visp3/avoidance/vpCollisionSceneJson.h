/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCollisionSceneJson.h
 * \brief Loads scenes and tasks from a JSON file. Requires a build with nlohmann_json.
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
  std::string name;    //!< Name for reports.
  vpJointVector start; //!< Start configuration, rad or m.
  vpJointVector goal;  //!< Goal configuration, rad or m, of the same size.
};

/*!
 * \ingroup group_avoidance
 * \brief A photograph on the front of a box, by which a camera can recognise it.
 */
struct VISP_EXPORT vpObjectPhoto {
  std::string object; //!< Name of the box; the photograph is on its face z = -size.z / 2, x right, y down.
  std::string target; //!< Name in a database of photographs, see vpPlanarTargetDatabase.
};

/*!
 * \ingroup group_avoidance
 * \brief Contents of a scene file.
 */
struct VISP_EXPORT vpCollisionSceneFile {
  std::string name;                  //!< Name for reports.
  vpCollisionSceneSpec spec;         //!< Specification for vpCollisionScene; its source is the file.
  std::vector<vpObjectPhoto> photos; //!< Photographs, each target and object at most once; may be empty.
  std::vector<vpMotionTask> tasks;   //!< Motions to plan; may be empty.
  std::vector<std::string> warnings; //!< One sentence each: meshes with holes, which are treated as surfaces.
};

/*!
 * \ingroup group_avoidance
 * \brief Reads a scene; data/scene/README.md lists the fields. Unknown fields are errors, so that misspelt names are
 * noticed. Paths of meshes and octrees are relative to the file.
 *
 * \code
 * const vpCollisionSceneFile file = vpLoadCollisionScene("data/scene/s4b-shelf.json");
 * for (const std::string &warning : file.warnings) {
 *   std::cerr << warning << std::endl;
 * }
 * const vpCollisionScene shelf(arm, file.spec);
 * std::cout << shelf.objectCount() << " objects, " << file.tasks.size() << " motions to plan" << std::endl;
 * \endcode
 * \throw vpException (ioError) if it or a referenced file cannot be read, (badValue) if it is not valid JSON or a field
 * is missing or out of range; one sentence with the file and the element: "shelf.json: objects[2].size_m is missing".
 */
[[nodiscard]] VISP_EXPORT vpCollisionSceneFile vpLoadCollisionScene(const std::string &file);

END_VISP_NAMESPACE
#endif
