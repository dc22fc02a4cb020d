/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/avoidance/vpImageObstacleSensor.h"

#include "lab/avoidance/vpCameraPoseNoise.h"

#include <visp3/core/vpException.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
constexpr unsigned char dark = 3; // grey value of a covered camera
} // namespace

void vpImageObstacleSensorSpec::validate() const
{
  const auto require = [](const char *field, double value, const char *unit) {
    if (!std::isfinite(value) || value < 0.) {
      throw vpException(vpException::badValue, "%s of the obstacle sensor is %g, must be >= 0 %s", field, value, unit);
    }
  };
  faults.validate();
  require("positionSigma", positionSigma, "m");
  require("angleSigma", angleSigma, "rad");
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
  m_fMc = vpNoisyCamera(fMc, m_spec.positionSigma, m_spec.angleSigma, seed);
  for (const vpObstacleDetection &detection : m_detector.process(m_picture, m_fMc, time)) {
    if (detection.seen) {
      result.push_back(detection.sighting);
    }
  }
}

END_VISP_NAMESPACE
