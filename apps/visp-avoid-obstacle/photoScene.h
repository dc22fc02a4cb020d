/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file photoScene.h
 * \brief A scene: objects known from the start, and objects to be seen, with photographs on boxes or without.
 */
#ifndef avoidObstacle_photoScene_h
#define avoidObstacle_photoScene_h

#include "options.h"

#include <visp3/avoidance/vpCollisionSceneJson.h>
#include <visp3/planar_target/vpPlanarTargetDatabase.h>
#include <visp3/rendering/vpSceneCamera.h>
#include "lab/avoidance/vpAvoidanceRunSpec.h"

#include <memory>

namespace avoidObstacle
{
//! \brief The whole scene, checked for consistency.
struct PhotoScene {
  std::shared_ptr<const vpArmModel> arm;
  std::string name;
  vpCollisionSceneSpec known;              //!< Objects known from the start, and the ground.
  std::vector<vpMovingObstacle> obstacles; //!< Objects to be seen.
  std::vector<vpObjectPhoto> carriers;     //!< Assignment of targets to obstacles.
  vpSceneCameraSpec camera;                //!< Camera, with the photographs.
  std::string targets;                     //!< Folder of all known photographs.
  vpMotionTask task;                       //!< First task of the file.
  bool moved = false;                      //!< By moveToArm().
  std::vector<std::string> remarks;        //!< One sentence each.
  std::vector<std::string> warnings;       //!< On the robot, one sentence each.

  //! Name of the obstacle that carries a target; the target's own name if none does.
  [[nodiscard]] std::string carrierOf(const std::string &target) const;
};

/*!
 * Read the scene named by the options.
 * \throw std::runtime_error or vpException naming the file and the element: no task, a task for another arm, nothing
 * to see with the sensor, a target missing in the folder, a box whose size differs from its target.
 */
[[nodiscard]] PhotoScene loadPhotoScene(const Options &options);
//! Database of the photographs, set up for a control loop.
[[nodiscard]] vpPlanarTargetDatabase loadTargets(const PhotoScene &scene);
} // namespace avoidObstacle

#endif
