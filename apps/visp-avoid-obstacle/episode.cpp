/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "episode.h"

#include "appMain.h"
#include "progress.h"

#include "lab/avoidance/vpCameraObstacleSensors.h"
#include <visp3/avoidance/vpDirectTrajectoryAvoidance.h>
#include <visp3/direct_core/vpSO3.h>

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>

namespace avoidObstacle
{
namespace
{
constexpr double TIME_ROUNDING = 1e-9; // s
constexpr int JPEG_QUALITY = 90;
constexpr float SHOWN_DEPTH = 1.5F; // m: black in depth images
constexpr unsigned char DARK = 3;   // grey value of a covered camera

std::string jpegOf(const vpImage<unsigned char> &image)
{
  const cv::Mat grey(static_cast<int>(image.getHeight()), static_cast<int>(image.getWidth()), CV_8UC1, image.bitmap);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", grey, bytes, {cv::IMWRITE_JPEG_QUALITY, JPEG_QUALITY});
  return std::string(bytes.begin(), bytes.end());
}

//! Depth image as grey values, near is bright.
vpImage<unsigned char> pictureOf(const vpImage<float> &depth)
{
  vpImage<unsigned char> picture(depth.getHeight(), depth.getWidth());
  for (unsigned int i = 0; i < depth.getSize(); ++i) {
    const float d = depth.bitmap[i];
    picture.bitmap[i] = d <= 0.F ? 0 : static_cast<unsigned char>(255.F * std::max(0.05F, 1.F - d / SHOWN_DEPTH));
  }
  return picture;
}

//! Objects known from the start are left out: they need no sensor, and mapped twice they would be in the way.
vpCollisionScene onlyObstacles(const PhotoScene &scene, const vpCollisionScene &truth)
{
  vpCollisionSceneSpec spec;
  spec.ignoredBodies = scene.known.ignoredBodies;
  for (const vpMovingObstacle &obstacle : scene.obstacles) {
    const int i = truth.find(obstacle.object.name);
    if (i >= 0) {
      spec.objects.push_back(truth.object(i));
    }
  }
  return vpCollisionScene(truth.arm(), spec);
}

//! \brief Common base of all sensors: covering, and the sensorLog.
class LoggingSensor : public vpObstacleSensor
{
public:
  LoggingSensor(const PhotoScene &scene, const Options &options, SensorLog &sensorLog)
    : m_scene(&scene), m_options(&options), m_log(&sensorLog)
  {}

  void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
            std::vector<vpObjectSighting> &result) final
  {
    Frame frame;
    frame.time = time;
    frame.covered = isHidden(time);
    for (const vpMovingObstacle &obstacle : m_scene->obstacles) {
      if (truth.find(obstacle.object.name) >= 0) {
        frame.sights.emplace_back();
        frame.sights.back().object = obstacle.object.name;
        frame.sights.back().message = frame.covered ? "the camera is covered" : "not in view or not recognised";
      }
    }
    result.clear();
    expose(truth, arm, frame, result);
    compare(truth, result, frame);
    m_log->frames.push_back(std::move(frame));
  }

protected:
  //! Take an image and detect its objects; frame.covered tells whether the camera is covered.
  virtual void expose(const vpCollisionScene &truth, const vpCollisionData &arm, Frame &frame,
                      std::vector<vpObjectSighting> &result) = 0;
  [[nodiscard]] const PhotoScene &scene() const noexcept { return *m_scene; }

  static Sight *find(Frame &frame, const std::string &object)
  {
    const auto found = std::find_if(frame.sights.begin(), frame.sights.end(),
                                    [&](const Sight &sight) { return sight.object == object; });
    return found == frame.sights.end() ? nullptr : &*found;
  }

private:
  [[nodiscard]] bool isHidden(double time) const
  {
    return std::any_of(m_options->hidden.begin(), m_options->hidden.end(), [time](const auto &interval) {
      return time >= interval.first - TIME_ROUNDING && time < interval.second - TIME_ROUNDING;
    });
  }

  static void compare(const vpCollisionScene &truth, const std::vector<vpObjectSighting> &result, Frame &frame)
  {
    for (const vpObjectSighting &sighting : result) {
      const int i = truth.find(sighting.name);
      Sight *sight = find(frame, sighting.name);
      if (i < 0 || sight == nullptr) {
        continue; // a map has no separate objects
      }
      const vpRigidTransform &pose = truth.object(i).pose;
      sight->seen = true;
      sight->error = (sighting.pose.p - pose.p).norm();
      sight->angleError = vpSO3::log(sighting.pose.R * pose.R.transpose()).norm();
      sight->sigma = sighting.positionSigma;
    }
  }

  const PhotoScene *m_scene;
  const Options *m_options;
  SensorLog *m_log;
};

class ImageLogger : public LoggingSensor
{
public:
  ImageLogger(const PhotoScene &scene, const Options &options, unsigned int seed, SensorLog &sensorLog)
    : LoggingSensor(scene, options, sensorLog),
      m_sensor(vpSceneCamera(scene.camera), vpObstacleDetector(loadTargets(scene), scene.camera.camera),
               spec(options, seed))
  {}

protected:
  void expose(const vpCollisionScene &truth, const vpCollisionData &arm, Frame &frame,
              std::vector<vpObjectSighting> &result) override
  {
    m_sensor.cover(frame.covered);
    m_sensor.look(truth, arm, frame.time, result);
    frame.jpeg = jpegOf(m_sensor.picture());
    for (vpObjectSighting &sighting : result) {
      sighting.name = scene().carrierOf(sighting.name);
    }
    const auto &detections = m_sensor.detector().detections();
    const auto &targets = m_sensor.detector().targets();
    for (std::size_t i = 0; i < detections.size(); ++i) {
      Sight *sight = find(frame, scene().carrierOf(detections[i].sighting.name));
      if (sight == nullptr) {
        continue;
      }
      sight->message = detections[i].message;
      sight->outlined = detections[i].seen;
      for (std::size_t k = 0; k < 4 && sight->outlined; ++k) {
        const vpImagePoint &corner = targets[i].result.corners[k];
        sight->corners[k] = {corner.get_u(), corner.get_v()};
      }
    }
  }

private:
  static vpImageObstacleSensorSpec spec(const Options &options, unsigned int seed)
  {
    vpImageObstacleSensorSpec result;
    result.faults.noise = options.noise;
    result.faults.blur = 0.5;
    result.seed = seed;
    return result;
  }
  vpImageObstacleSensor m_sensor;
};

class DepthLogger : public LoggingSensor
{
public:
  DepthLogger(const PhotoScene &scene, const Options &options, unsigned int seed, SensorLog &sensorLog)
    : LoggingSensor(scene, options, sensorLog), m_sensor(vpSceneCamera(scene.camera), spec(seed))
  {}

protected:
  void expose(const vpCollisionScene &truth, const vpCollisionData &arm, Frame &frame,
              std::vector<vpObjectSighting> &result) override
  {
    if (frame.covered) {
      frame.jpeg = jpegOf(vpImage<unsigned char>(scene().camera.height, scene().camera.width, DARK));
      return;
    }
    m_sensor.look(onlyObstacles(scene(), truth), arm, frame.time, result);
    frame.jpeg = jpegOf(pictureOf(m_sensor.depth()));
    for (Sight &sight : frame.sights) {
      sight.message = "depths go into the map, objects are not distinguished";
    }
    result.erase(
        std::remove_if(result.begin(), result.end(), [](const auto &s) { return s.shape.octree().cells().empty(); }),
        result.end());
  }

private:
  static vpDepthObstacleSensorSpec spec(unsigned int seed)
  {
    vpDepthObstacleSensorSpec result;
    result.faults.noise = 0.003;
    result.map.stride = 4;
    result.seed = seed;
    return result;
  }
  vpDepthObstacleSensor m_sensor;
};

class PoseLogger : public LoggingSensor
{
public:
  PoseLogger(const PhotoScene &scene, const Options &options, unsigned int seed, SensorLog &sensorLog)
    : LoggingSensor(scene, options, sensorLog), m_sensor(namesOf(scene), vpPoseSensorSpec(), seed),
      m_camera(scene.camera)
  {}

protected:
  void expose(const vpCollisionScene &truth, const vpCollisionData &arm, Frame &frame,
              std::vector<vpObjectSighting> &result) override
  {
    vpImage<unsigned char> picture(scene().camera.height, scene().camera.width, DARK);
    if (!frame.covered) {
      m_sensor.look(truth, arm, frame.time, result);
      m_camera.picture(truth, vpArmKinematics::camera(truth.arm(), arm.arm), vpCameraFaults(), 1, picture);
    }
    frame.jpeg = jpegOf(picture);
    for (const vpObjectSighting &sighting : result) {
      if (Sight *sight = find(frame, sighting.name)) {
        sight->message = "in range";
      }
    }
  }

private:
  static std::vector<std::string> namesOf(const PhotoScene &scene)
  {
    std::vector<std::string> names;
    for (const vpMovingObstacle &obstacle : scene.obstacles) {
      names.push_back(obstacle.object.name);
    }
    return names;
  }
  vpPoseSensor m_sensor;
  vpSceneCamera m_camera; // for images only
};
} // namespace

std::unique_ptr<vpObstacleSensor> makeLoggingSensor(const PhotoScene &scene, const Options &options, unsigned int seed,
                                                    SensorLog &sensorLog)
{
  switch (options.sensor) {
  case SensorKind::Depth:
    return std::make_unique<DepthLogger>(scene, options, seed, sensorLog);
  case SensorKind::Poses:
    return std::make_unique<PoseLogger>(scene, options, seed, sensorLog);
  case SensorKind::Image:
    break;
  }
  return std::make_unique<ImageLogger>(scene, options, seed, sensorLog);
}

namespace
{
//! Process noise of static obstacles out of view: inflation by 13 mm after 5 s (m/s^2).
constexpr double REST_ACCELERATION = 0.002;
//! Boxes do not start to rotate by themselves, rad/s^2.
constexpr double ANGULAR_ACCELERATION = 0.2;
//! Errors of consecutive images are correlated: their slow drift is no motion.
constexpr double REST_SIGMAS = 5.;
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
  spec.goalTolerance = spec.drives.ideal ? spec.goalTolerance : DRIVEN_TOLERANCE;
  spec.maxDuration = options.duration;
  spec.seed = options.seed;
  if (!scene.moved) { // the task of another arm is for its tool's position alone
    keepLooking(spec);
  }
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
