/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file photoScene.h
 * \brief A scene: what is known from the start, and what has to be seen, by the photographs that boxes carry or without.
 */
#ifndef avoidObstacle_photoScene_h
#define avoidObstacle_photoScene_h

#include "options.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/planar_target/vpPlanarTargetDatabase.h>
#include "lab/avoidance/vpMovingObstacle.h"
#include <visp3/rendering/vpSceneCamera.h>

#include <memory>

namespace avoidObstacle
{
//! \brief All that is there, checked against each other.
struct PhotoScene {
  std::shared_ptr<const vpArmModel> arm;
  std::string name;
  vpCollisionSceneSpec known;              //!< Objects that need not be seen, and the ground.
  std::vector<vpMovingObstacle> obstacles; //!< Those that have to be.
  std::vector<vpObjectPhoto> carriers;     //!< Which obstacle carries which target.
  vpSceneCameraSpec camera;                //!< With the photographs.
  std::string targets;                     //!< Folder of all photographs that are known.
  vpMotionTask task;                       //!< The first one of the file.
  std::vector<std::string> remarks;        //!< A sentence each.

  //! Name of the obstacle that carries a target; the target's own name when none does.
  [[nodiscard]] std::string carrierOf(const std::string &target) const;
};

/*!
 * Read what the options name.
 * \throw std::runtime_error or vpException naming the file and the element: no task, a task for another arm, nothing
 * to see with the sensor, a target that is not in the folder, a box that has not its target's size.
 */
[[nodiscard]] PhotoScene loadPhotoScene(const Options &options);
//! The database of photographs with settings for a control loop.
[[nodiscard]] vpPlanarTargetDatabase loadTargets(const PhotoScene &scene);
} // namespace avoidObstacle

#endif
