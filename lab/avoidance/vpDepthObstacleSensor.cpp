/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpDepthObstacleSensor.h"

#include "lab/avoidance/vpCameraPoseNoise.h"

#include <visp3/core/vpException.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
// Cubes contain the observed points; the remaining error is that of the camera pose, which must not be 0 for a track.
constexpr double leastPositionSigma = 1e-4; // m
constexpr double leastAngleSigma = 1e-4;    // rad
} // namespace

void vpDepthObstacleSensorSpec::validate() const
{
  const auto require = [](const char *field, double value, const char *unit) {
    if (!std::isfinite(value) || value < 0.) {
      throw vpException(vpException::badValue, "%s of the depth sensor is %g, must be >= 0 %s", field, value, unit);
    }
  };
  if (name.empty()) {
    throw vpException(vpException::badValue, "name of the depth sensor's sighting is empty");
  }
  faults.validate();
  require("positionSigma", positionSigma, "m");
  require("angleSigma", angleSigma, "rad");
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
  const vpRigidTransform believed = vpNoisyCamera(fMc, m_spec.positionSigma, m_spec.angleSigma, seed);
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
