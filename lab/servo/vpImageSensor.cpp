/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#include "lab/servo/vpServoSensor.h"

#include <visp3/core/vpImage.h>
#include <visp3/io/vpImageIo.h>
#include <visp3/planar_target/vpPlanarTarget.h>

#include <cmath>

BEGIN_VISP_NAMESPACE

namespace
{
vpImage<unsigned char> readPhoto(const std::string &file)
{
  vpImage<unsigned char> photo;
  vpImageIo::read(photo, file);
  return photo;
}

class vpImageSensor : public vpServoSensor
{
public:
  vpImageSensor(const vpServoTask &task, const vpImage<unsigned char> &photo, const vpCameraFaults &faults,
                unsigned int seed)
    : vpServoSensor(task, gridPoints(task)),
      m_renderer(photo, task.objectWidth, task.objectHeight, task.camera, task.width, task.height),
      m_tracker(photo, task.objectWidth, task.objectHeight, task.camera), m_faults(faults), m_seed(seed)
  {}

protected:
  bool look(const vpHomogeneousMatrix &cMo, vpServoMeasurement &result) VP_OVERRIDE
  {
    m_renderer.render(cMo, m_faults, m_seed++, m_image);
    m_target.measure(m_tracker.process(m_image), result.time, result);
    for (vpServoPoint &p : result.points) {
      p.visible = p.visible && inPicture(p.x, p.y);
    }
    return result.valid;
  }

private:
  // The most nearly square grid with at least pointCount nodes; its last row may be incomplete.
  static std::vector<Eigen::Vector3d> gridPoints(const vpServoTask &task)
  {
    const unsigned int columns = static_cast<unsigned int>(std::ceil(std::sqrt(task.pointCount)));
    const unsigned int rows = (task.pointCount + columns - 1) / columns;
    std::vector<Eigen::Vector3d> points;
    for (unsigned int i = 0; i < task.pointCount; ++i) {
      const unsigned int row = i / columns;
      const unsigned int column = i % columns;
      points.emplace_back(((column + 0.5) / columns - 0.5) * task.objectWidth,
                          ((row + 0.5) / rows - 0.5) * task.objectHeight, 0.);
    }
    return points;
  }

  vpPlaneRenderer m_renderer;
  vpPlanarTarget m_tracker;
  vpCameraFaults m_faults;
  unsigned int m_seed; // changes with every frame
  vpImage<unsigned char> m_image;
};
} // namespace

std::unique_ptr<vpServoSensor> vpServoSensor::image(const vpServoTask &task, const std::string &photo,
                                                    const vpCameraFaults &faults, unsigned int seed)
{
  return std::make_unique<vpImageSensor>(task, readPhoto(photo), faults, seed);
}

END_VISP_NAMESPACE
