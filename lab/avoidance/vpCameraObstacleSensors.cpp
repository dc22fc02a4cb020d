/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpCameraObstacleSensors.h"
#include "vpFieldCheck.h"

#include "vpHashRandom.h"

#include <visp3/core/vpException.h>
#include <visp3/direct_core/vpSO3.h>
#include <visp3/manipulator/vpArmTypes.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr unsigned char dark = 3; // grey value of a covered camera
// Cubes contain the observed points; the remaining error is that of the camera pose, which must not be 0 for a track.
constexpr double leastPositionSigma = 1e-4; // m
constexpr double leastAngleSigma = 1e-4;    // rad

//! fMc with Gaussian errors of position (m) and rotation (rad) per component. \param seed : Seed for this image.
vpRigidTransform noisyCamera(const vpRigidTransform &fMc, double positionSigma, double angleSigma, unsigned int seed)
{
  vpHashRandom random(seed, vpHashRandom::Purpose::CameraPose, 0, 0);
  const auto normal = [&random] {
    const double value = vpNormalQuantiles::get()[static_cast<std::uint16_t>(random.bits())];
    return value;
  };
  Eigen::Vector3d place, turn;
  for (int i = 0; i < 3; ++i) {
    place(i) = positionSigma * normal();
    turn(i) = angleSigma * normal();
  }
  return {vpSO3::exp(turn) * fMc.R, fMc.p + place};
}

constexpr vpFieldCheck fields("the obstacle sensor");
} // namespace

void vpImageObstacleSensorSpec::validate() const
{
  faults.validate();
  fields.notNegative("positionSigma", positionSigma, "m");
  fields.notNegative("angleSigma", angleSigma, "rad");
}

vpImageObstacleSensor::vpImageObstacleSensor(vpSceneCamera camera, vpObstacleDetector detector,
                                             const vpImageObstacleSensorSpec &spec)
  : m_camera(std::move(camera)), m_detector(std::move(detector)), m_spec(spec)
{
  m_spec.validate();
}

void vpImageObstacleSensor::look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
                                 std::vector<vpObjectSighting> &result)
{
  result.clear();
  const unsigned int seed = m_spec.seed + m_frame++;
  const vpRigidTransform fMc = vpArmKinematics::camera(truth.arm(), arm.arm);
  if (m_covered) {
    m_picture.resize(m_camera.spec().height, m_camera.spec().width, dark);
  }
  else {
    m_camera.picture(truth, fMc, m_spec.faults, seed, m_picture);
  }
  m_fMc = noisyCamera(fMc, m_spec.positionSigma, m_spec.angleSigma, seed);
  for (const vpObstacleDetection &detection : m_detector.process(m_picture, m_fMc, time)) {
    if (detection.seen) {
      result.push_back(detection.sighting);
    }
  }
}

void vpDepthObstacleSensorSpec::validate() const
{
  if (name.empty()) {
    throw vpException(vpException::badValue, "name of the depth sensor's sighting is empty");
  }
  faults.validate();
  vpFieldCheck("the depth sensor").notNegative("positionSigma", positionSigma, "m");
  vpFieldCheck("the depth sensor").notNegative("angleSigma", angleSigma, "rad");
}

vpDepthObstacleSensor::vpDepthObstacleSensor(vpSceneCamera camera, const vpDepthObstacleSensorSpec &spec)
  : m_camera(std::move(camera)), m_spec(spec), m_map(spec.map)
{
  m_spec.validate();
}

void vpDepthObstacleSensor::look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
                                 std::vector<vpObjectSighting> &result)
{
  const unsigned int seed = m_spec.seed + m_frame++;
  const vpRigidTransform fMc = vpArmKinematics::camera(truth.arm(), arm.arm);
  m_camera.depth(truth, fMc, m_spec.faults, seed, m_depth);
  const vpRigidTransform believed = noisyCamera(fMc, m_spec.positionSigma, m_spec.angleSigma, seed);
  m_report = m_map.insert(m_depth, m_camera.spec().camera, believed, truth, arm);
  vpObjectSighting sighting;
  sighting.name = m_spec.name;
  sighting.shape = vpCollisionShape::octree(m_map.snapshot());
  sighting.time = time;
  sighting.positionSigma = std::max(m_spec.positionSigma, leastPositionSigma);
  sighting.angleSigma = std::max(m_spec.angleSigma, leastAngleSigma);
  result.assign(1, sighting);
}

END_VISP_NAMESPACE
