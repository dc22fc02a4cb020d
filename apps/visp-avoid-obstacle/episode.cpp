/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "episode.h"

#include "appMain.h"
#include "loggingSensor.h"
#include "progress.h"

#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>

#include <cmath>

namespace avoidObstacle
{
namespace
{
//! Process noise of static obstacles out of view: inflation by 13 mm after 5 s (m/s^2).
constexpr double REST_ACCELERATION = 0.002;
//! Boxes do not start to rotate by themselves, rad/s^2.
constexpr double ANGULAR_ACCELERATION = 0.2;
//! Errors of consecutive images are correlated: their slow drift is no motion.
constexpr double REST_SIGMAS = 5.;
constexpr double TIME_ROUNDING = 1e-9;    // s
constexpr double DRIVEN_TOLERANCE = 0.01; // m: PD drives alone do not reach 1 mm

//! The two methods with tool trajectories keep the camera's direction, so that it keeps seeing the same objects.
void keepLooking(vpAvoidanceRunSpec &spec)
{
  if (spec.method != "dtg" && spec.method != "dtg-via") {
    return;
  }
  const vpDetourKind detour = spec.method == "dtg" ? vpDetourKind::PointToPoint : vpDetourKind::Via;
  spec.makeMethod = [detour](const vpCollisionScene &scene, const vpAvoidanceMethodSpec &common) {
    vpDirectTrajectoryAvoidanceSpec direct;
    direct.common = common;
    direct.detour = detour;
    direct.keepOrientation = true;
    return std::make_unique<vpDirectTrajectoryAvoidance>(scene, direct);
  };
}

//! True pose of the obstacle of that name; false if there is none now.
bool truePlace(const PhotoScene &scene, const std::string &name, double time, Eigen::Vector3d &place)
{
  for (const vpMovingObstacle &obstacle : scene.obstacles) {
    if (obstacle.object.name == name && obstacle.isThere(time)) {
      vpRigidTransform pose;
      vpTwist unused;
      obstacle.stateAt(time, pose, unused);
      place = pose.p;
      return true;
    }
  }
  return false;
}
} // namespace

vpAvoidanceRunSpec specOf(const PhotoScene &scene, const Options &options, SensorLog &sensorLog)
{
  vpAvoidanceRunSpec spec;
  spec.arm = scene.arm;
  spec.method = options.method;
  spec.methodSpec.seed = options.seed;
  spec.scene = scene.known;
  spec.obstacles = scene.obstacles;
  spec.start = scene.task.start;
  spec.goal = vpAvoidanceGoal::at(*scene.arm, scene.task.goal);
  spec.sight = vpObstacleSight::Custom;
  spec.makeSensor = [&scene, &options, &sensorLog](unsigned int seed) {
    return makeLoggingSensor(scene, options, seed, sensorLog);
  };
  spec.visionRate = options.visionRate;
  spec.latency = options.latency;
  spec.tracks.restAcceleration = REST_ACCELERATION;
  spec.tracks.angularAcceleration = ANGULAR_ACCELERATION;
  spec.tracks.restSigmas = REST_SIGMAS;
  spec.tracks.forget = options.forget > 0. ? options.forget : HUGE_VAL;
  spec.watchTracks = [&scene, &sensorLog](double time, const std::vector<vpObjectTrack> &tracks) {
    for (const vpObjectTrack &track : tracks) {
      Eigen::Vector3d place;
      const bool isThere = truePlace(scene, track.name, time, place);
      sensorLog.tracks.push_back({time, track, isThere ? (track.pose.p - place).norm() : NAN});
      if (track.shape.type() == vpShapeType::Octree) {
        sensorLog.tracks.back().track.shape =
            vpCollisionShape::sphere(0.001); // maps are too large to keep 200 per second
      }
    }
  };
  spec.drives.ideal = options.friction <= 0.;
  spec.drives.frictionScale = options.friction;
  spec.drives.compensateFriction = true;
  spec.goalTolerance = spec.drives.ideal ? spec.goalTolerance : DRIVEN_TOLERANCE;
  spec.maxDuration = options.duration;
  spec.seed = options.seed;
  keepLooking(spec);
  return spec;
}

std::vector<vpCollisionObject> believedAt(const Episode &episode, double time)
{
  std::vector<vpCollisionObject> objects;
  double latest = -1.; // s
  for (const TrackRow &row : episode.sensorLog.tracks) {
    if (row.time > time + TIME_ROUNDING) {
      break;
    }
    if (row.time > latest) {
      objects.clear();
      latest = row.time;
    }
    vpCollisionObject object;
    object.name = row.track.name;
    object.shape = row.track.shape;
    object.pose = row.track.pose;
    object.inflation = row.track.inflation;
    objects.push_back(object);
  }
  return latest < time - 2. * episode.run.spec.methodSpec.period ? std::vector<vpCollisionObject>() : objects;
}

Episode play(const PhotoScene &scene, const Options &options)
{
  Episode episode;
  vpApp::Progress progress("simulating " + scene.name, 1.);
  double done = 0.;
  episode.run = runAvoidanceExperiment(specOf(scene, options, episode.sensorLog), [&](double share) {
    progress.add(share - done);
    done = share;
    return !vpApp::interrupted();
  });
  vpApp::throwIfInterrupted();
  progress.add(1. - done);
  return episode;
}
} // namespace avoidObstacle
