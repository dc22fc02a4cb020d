/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "otherArm.h"

#include "lab/avoidance/vpSceneDraw.h"
#include "lab/avoidance/vpTrueScene.h"

#include <algorithm>
#include <stdexcept>

namespace avoidObstacle
{
namespace
{
constexpr unsigned int PHOTO = 9; // of the random streams; scenes have 1 to 7
constexpr int PLACES = 60;        // of the straight way
constexpr int DRAWS = 20000;

//! \brief The camera's pose and the tool's position in a configuration.
struct Views {
  vpRigidTransform camera;
  Eigen::Vector3d tool;
};

Views viewsOf(const vpArmModel &arm, const vpJointVector &q)
{
  vpArmData data;
  vpArmKinematics::forward(arm, q, data);
  return {vpArmKinematics::camera(arm, data), data.tool.p};
}

//! \brief What stays the same on all arms, in the frame of the camera at the start.
struct Meeting {
  vpRigidTransform object;
  Eigen::Vector3d beside; //!< From the straight way to the object.
  Eigen::Vector3d rest;   //!< From there to the goal.
};

Meeting meetingOf(const vpArmModel &amor, const vpCollisionObject &object, const vpMotionTask &task)
{
  const Views start = viewsOf(amor, task.start);
  const Eigen::Vector3d way = viewsOf(amor, task.goal).tool - start.tool, to = object.pose.p - start.tool;
  const Eigen::Matrix3d intoCamera = start.camera.R.transpose();
  const Eigen::Vector3d before = to.dot(way) / way.squaredNorm() * way;
  Meeting meeting;
  meeting.beside = intoCamera * (to - before);
  meeting.rest = intoCamera * (way - before);
  meeting.object.R = intoCamera * object.pose.R;
  meeting.object.p = intoCamera * (object.pose.p - start.camera.p);
  return meeting;
}

//! The object in front of the arm at the start of the task, and where the tool has to go past it.
Eigen::Vector3d placeObject(const Meeting &meeting, const Views &start, vpCollisionObject &object)
{
  object.pose.R = start.camera.R * meeting.object.R;
  object.pose.p = start.camera.R * meeting.object.p + start.camera.p;
  return object.pose.p + start.camera.R * (meeting.rest - meeting.beside);
}

//! Completes the task from its start; false if it is none. \param room : About the object, m.
bool complete(const Meeting &meeting, const vpArmModel &arm, double room, vpCollisionSceneSpec &spec,
              vpMotionTask &task)
{
  const Eigen::Vector3d goal = placeObject(meeting, viewsOf(arm, task.start), spec.objects.front());
  const vpCollisionScene scene(arm, spec);
  vpCollisionSceneSpec wider = spec;
  wider.objects.front().inflation += room;
  const vpCollisionScene wide(arm, wider);
  task.goal = task.start;
  if (!vpSceneDraw::isFree(wide, task.start, vpAvoidanceScenes::feasibleMargin) ||
      !vpReachPoint(arm, goal, task.goal) || !vpSceneDraw::isFree(wide, task.goal, vpAvoidanceScenes::feasibleMargin)) {
    return false;
  }
  const std::vector<vpJointVector> line = vpSceneDraw::toolLine(arm, task.start, task.goal, PLACES);
  return std::any_of(line.begin(), line.end(),
                     [&](const vpJointVector &q) { return !vpSceneDraw::isFree(scene, q, 0.); }) &&
         vpSceneDraw::hasPath(wide, task.start, task.goal, 1);
}
} // namespace

void moveToArm(const vpArmModel &amor, const vpArmModel &arm, vpCollisionSceneFile &file)
{
  file.spec = vpIgnoreUncovered(arm, file.spec);
  file.spec.ground = vpSceneFrame::of(arm).floor();
  vpMotionTask &task = file.tasks.front();
  const Meeting meeting = meetingOf(amor, file.spec.objects.front(), task);
  for (const double room : {0.06, 0.04}) { // for the uncertainty with which the object is seen
    for (int draw = -1; draw < DRAWS; ++draw) {
      vpHashRandom random = vpSceneDraw::random(PHOTO, 1, draw);
      task.start = draw < 0 ? arm.home() : vpSceneDraw::configuration(arm, random);
      if (complete(meeting, arm, room, file.spec, task)) {
        return;
      }
    }
  }
  throw std::runtime_error(arm.label() + ": from none of " + std::to_string(DRAWS) +
                           " starts the arm reaches a goal past the object of " + file.spec.source +
                           "; --scene gives it a scene of its own");
}
} // namespace avoidObstacle
