/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoSensor.h"

#include <visp3/core/vpMeterPixelConversion.h>

#include <utility>

BEGIN_VISP_NAMESPACE

vpServoSensor::vpServoSensor(const vpServoTask &task, std::vector<Eigen::Vector3d> points)
  : m_task(task), m_target(std::move(points), vpServoTarget::rectangle(task.objectWidth, task.objectHeight).points())
{}

void vpServoSensor::measure(const vpHomogeneousMatrix &cMo, double time, vpServoMeasurement &result)
{
  result.time = time;
  result.covariance = vpPoseCovariance();
  result.valid = look(cMo, result);
  if (result.valid) {
    vpServoTarget::project(m_target.outline(), result.cMo, result.outline);
  }
}

bool vpServoSensor::inPicture(double x, double y) const
{
  double u = 0., v = 0.;
  vpMeterPixelConversion::convertPoint(m_task.camera, x, y, u, v);
  return u >= 0. && v >= 0. && u <= m_task.width - 1. && v <= m_task.height - 1.;
}

END_VISP_NAMESPACE
