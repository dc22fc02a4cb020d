/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoSensor.h
 * \brief Simulated vision system: measurement of the object at one exposure.
 */
#ifndef vpServoSensor_h
#define vpServoSensor_h

#include <visp3/servoing/vpServoTarget.h>
#include <visp3/rendering/vpPlaneRenderer.h>
#include "lab/servo/vpServoTask.h"

#include <memory>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpServoSensor
 * \brief Gives a measurement from the true object pose at one exposure. The sensor owns the object's feature points and
 * thus also creates the matching goals.
 */
class vpServoSensor
{
public:
  virtual ~vpServoSensor() = default;
  vpServoSensor(const vpServoSensor &) = delete;
  vpServoSensor &operator=(const vpServoSensor &) = delete;

  /*!
   * Sensor of projected object points with noise; the pose follows from the homography between object plane and image.
   *
   * The vpServoTask::pointCount points are random on the object, but the same in every experiment with the same task. A
   * point whose noisy image lies outside the image is not visible. With 4 visible points or more the pose is that of
   * the homography (vpHomography::DLT), refined by vpPose's virtual visual servoing. With fewer, with nearly collinear
   * points, or if the refined pose has residuals beyond the noise, the measurement is invalid. Depths come
   * from the measured pose.
   * \param task : Camera, object. \param pixelNoise : Standard deviation of u and of v, px, >= 0.
   * \param seed : Seed of the noise.
   */
  [[nodiscard]] static std::unique_ptr<vpServoSensor> points(const vpServoTask &task, double pixelNoise,
                                                             unsigned int seed);
  /*!
   * Sensor of rendered images of a photograph (vpPlaneRenderer) by vpPlanarTarget, as with a real camera. The
   * points are a grid of vpServoTask::pointCount object points, projected through the measured pose; those outside the
   * image are not visible.
   * \param task : Camera, object. \param photo : Image file of the object. \param faults : Camera imperfections.
   * \param seed : Seed of the noise.
   * \throw vpException (ioError) if the file cannot be read; as vpPlanarTarget for an unsuitable photograph.
   */
  [[nodiscard]] static std::unique_ptr<vpServoSensor> image(const vpServoTask &task, const std::string &photo,
                                                            const vpCameraFaults &faults, unsigned int seed);

  /*!
   * Takes an exposure.
   * \param cMo : True pose of the object in the camera. \param time : Time of capture, s.
   * \param result : Points in the order of goal(); the outline is the object's corners through the measured pose: top
   *   left, top right, bottom right, bottom left.
   */
  void measure(const vpHomogeneousMatrix &cMo, double time, vpServoMeasurement &result);
  //! Goal at \e cdMo with noise-free images of this sensor's points, including those outside the image.
  [[nodiscard]] vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const { return m_target.goal(cdMo); }

protected:
  //! \param task : Camera and object. \param points : The features, in the object's plane z = 0, m.
  vpServoSensor(const vpServoTask &task, std::vector<Eigen::Vector3d> points);
  //! Sets pose and points; true if the object was found. Time, outline and validity are set by measure().
  virtual bool look(const vpHomogeneousMatrix &cMo, vpServoMeasurement &result) = 0;
  //! True if the normalised point lies between the centres of the border pixels.
  [[nodiscard]] bool inPicture(double x, double y) const;

  vpServoTask m_task;     //!< Camera and object.
  vpServoTarget m_target; //!< The features, and the corners as outline.
};

END_VISP_NAMESPACE
#endif
