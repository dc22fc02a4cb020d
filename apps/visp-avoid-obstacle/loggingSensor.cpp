/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "loggingSensor.h"

#include <visp3/direct_core/vpSO3.h>
#include "lab/avoidance/vpDepthObstacleSensor.h"
#include "lab/avoidance/vpImageObstacleSensor.h"
#include "lab/avoidance/vpPoseSensor.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>

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
} // namespace avoidObstacle
