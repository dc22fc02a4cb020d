/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include <visp3/simulation/vpServoSensor.h>

#include <visp3/core/vpMeterPixelConversion.h>

#include <utility>

BEGIN_VISP_NAMESPACE

vpServoSensor::vpServoSensor(const vpServoTask &task, std::vector<ObjectPoint> points)
  : m_task(task), m_points(std::move(points))
{
  const double x = 0.5 * task.objectWidth, y = 0.5 * task.objectHeight;
  m_corners = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

void vpServoSensor::measure(const vpHomogeneousMatrix &cMo, double time, vpServoMeasurement &result)
{
  result.time = time;
  result.covariance = vpPoseCovariance();
  result.valid = look(cMo, result);
  if (result.valid) {
    project(m_corners, result.cMo, result.outline);
  }
}

vpServoGoal vpServoSensor::goal(const vpHomogeneousMatrix &cdMo) const
{
  vpServoGoal goal;
  goal.cdMo = cdMo;
  project(m_points, cdMo, goal.points);
  return goal;
}

void vpServoSensor::project(const std::vector<ObjectPoint> &points, const vpHomogeneousMatrix &cMo,
                            std::vector<vpServoPoint> &images)
{
  images.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ObjectPoint &p = points[i];
    const double Z = cMo[2][0] * p.x + cMo[2][1] * p.y + cMo[2][3];
    images[i].visible = Z > 0.;
    if (images[i].visible) {
      images[i].x = (cMo[0][0] * p.x + cMo[0][1] * p.y + cMo[0][3]) / Z;
      images[i].y = (cMo[1][0] * p.x + cMo[1][1] * p.y + cMo[1][3]) / Z;
      images[i].Z = Z;
    }
  }
}

bool vpServoSensor::inPicture(double x, double y) const
{
  double u = 0., v = 0.;
  vpMeterPixelConversion::convertPoint(m_task.camera, x, y, u, v);
  return u >= 0. && v >= 0. && u <= m_task.width - 1. && v <= m_task.height - 1.;
}

END_VISP_NAMESPACE
