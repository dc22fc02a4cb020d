/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "seenBox.h"

#include "photoScene.h"

#include "lab/avoidance/vpCameraObstacleSensors.h"

#include <cmath>

namespace avoidObstacle
{
namespace
{
constexpr double VISION_RATE = 10.; // Hz, section 8.3.2
constexpr double BLUR = 0.5;        // px
} // namespace

void addSeenBox(const Options &options, const Eigen::Vector3d &place, double appears, vpAvoidanceRunSpec &spec)
{
  Options withImages = options;
  withImages.scene.clear();
  withImages.sensor = SensorKind::Image;
  const auto scene = std::make_shared<const PhotoScene>(loadPhotoScene(withImages));
  vpMovingObstacle box = scene->obstacles.front();
  box.object.pose.p = place;
  box.appears = appears;
  spec.obstacles = {box};
  spec.sight = vpObstacleSight::Custom;
  spec.visionRate = VISION_RATE;
  spec.latency = options.latency;
  spec.tracks.forget = options.forget > 0. ? options.forget : HUGE_VAL; // what was seen stays there
  spec.makeSensor = [scene, noise = options.noise](unsigned int seed) {
    vpImageObstacleSensorSpec image;
    image.faults.noise = noise;
    image.faults.blur = BLUR;
    image.seed = seed;
    return std::make_unique<vpImageObstacleSensor>(
        vpSceneCamera(scene->camera), vpObstacleDetector(loadTargets(*scene), scene->camera.camera), image);
  };
}
} // namespace avoidObstacle
