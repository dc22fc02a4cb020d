/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoSensor.h
 * \brief What a simulated vision system reports of the object at one exposure.
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
 * \brief One exposure: true pose of the object in, measurement out. The sensor owns the object's feature points, so it
 * also makes the goals that its measurements are compared with.
 */
class vpServoSensor
{
public:
  virtual ~vpServoSensor() = default;
  vpServoSensor(const vpServoSensor &) = delete;
  vpServoSensor &operator=(const vpServoSensor &) = delete;

  /*!
   * Points of the object, projected, with noise; the pose comes from the homography between object plane and image.
   *
   * The vpServoTask::pointCount points are random on the object, but the same in every experiment with the same task. A
   * point whose noisy image lies outside the picture is not visible. With 4 visible points or more the pose is that of
   * the homography (vpHomography::DLT), refined by vpPose's virtual visual servoing. With fewer, with points close to
   * one line, or when the refined pose leaves residuals beyond the noise, the measurement is not valid. Depths come
   * from the measured pose.
   * \param task : Camera, object. \param pixelNoise : Standard deviation of u and of v, px, >= 0.
   * \param seed : Of the noise.
   */
  [[nodiscard]] static std::unique_ptr<vpServoSensor> points(const vpServoTask &task, double pixelNoise,
                                                             unsigned int seed);
  /*!
   * Pictures of a photograph (vpPlaneRenderer) through vpPlanarTarget, as a program with a real camera would do it. The
   * points are a grid of vpServoTask::pointCount object points, projected through the measured pose; those outside the
   * picture are not visible.
   * \param task : Camera, object. \param photo : Image file of the object. \param faults : What the camera adds.
   * \param seed : Of the noise.
   * \throw vpException (ioError) if the file cannot be read; what vpPlanarTarget throws for an unfit photograph.
   */
  [[nodiscard]] static std::unique_ptr<vpServoSensor> image(const vpServoTask &task, const std::string &photo,
                                                            const vpCameraFaults &faults, unsigned int seed);

  /*!
   * Expose.
   * \param cMo : True pose of the object in the camera. \param time : Time of capture, s.
   * \param result : Points in the order of goal(); the outline is the object's corners through the measured pose: top
   *   left, top right, bottom right, bottom left.
   */
  void measure(const vpHomogeneousMatrix &cMo, double time, vpServoMeasurement &result);
  //! The goal at \e cdMo with the images of this sensor's points, free of noise; those outside the picture as well.
  [[nodiscard]] vpServoGoal goal(const vpHomogeneousMatrix &cdMo) const { return m_target.goal(cdMo); }

protected:
  //! \param task : Camera and object. \param points : The features, in the object's plane z = 0, m.
  vpServoSensor(const vpServoTask &task, std::vector<Eigen::Vector3d> points);
  //! Fill pose and points and say whether the object was found. Time, outline and validity are set by measure().
  virtual bool look(const vpHomogeneousMatrix &cMo, vpServoMeasurement &result) = 0;
  //! True if the normalised point lies between the centres of the border pixels.
  [[nodiscard]] bool inPicture(double x, double y) const;

  vpServoTask m_task;     //!< Camera and object.
  vpServoTarget m_target; //!< The features, and the corners as outline.
};

END_VISP_NAMESPACE
#endif
