/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpImageObstacleSensor.h
 * \brief The camera in the hand: from the true scene over a picture to sightings.
 */
#ifndef vpImageObstacleSensor_h
#define vpImageObstacleSensor_h

#include <visp3/avoidance/vpObstacleDetector.h>
#include "lab/avoidance/vpObstacleSensor.h"
#include <visp3/rendering/vpSceneCamera.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief What is wrong with pictures and with what is known of the camera.
 */
struct vpImageObstacleSensorSpec {
  vpCameraFaults faults;       //!< Of each picture.
  double positionSigma = 2e-4; //!< The camera is not quite where the arm says: each coordinate, m, >= 0; new each time.
  double angleSigma = 5e-4;    //!< The same of its rotation, rad, >= 0.
  unsigned int seed = 1;       //!< Of all noise.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpImageObstacleSensor
 * \brief Renders what the camera of the arm sees and finds the obstacles in it (thesis 8.3.2), picture by picture.
 */
class vpImageObstacleSensor : public vpObstacleSensor
{
public:
  /*!
   * \param camera : Draws the pictures. \param detector : Made for the same intrinsics.
   * \param spec : Of the pictures.
   * \throw vpException (badValue), see vpImageObstacleSensorSpec::validate().
   */
  vpImageObstacleSensor(vpSceneCamera camera, vpObstacleDetector detector, const vpImageObstacleSensorSpec &spec = {});

  //! Errors as of vpSceneCamera::picture().
  void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
            std::vector<vpObjectSighting> &result) VP_OVERRIDE;
  //! A covered camera takes dark pictures.
  void cover(bool covered) noexcept { m_covered = covered; }
  //! The last picture; empty before the first.
  [[nodiscard]] const vpImage<unsigned char> &picture() const noexcept { return m_picture; }
  //! What was found in it, and where.
  [[nodiscard]] const vpObstacleDetector &detector() const noexcept { return m_detector; }
  //! Where the camera was, as far as the arm knew.
  [[nodiscard]] const vpRigidTransform &fMc() const noexcept { return m_fMc; }

private:
  vpSceneCamera m_camera;
  vpObstacleDetector m_detector;
  vpImageObstacleSensorSpec m_spec;
  bool m_covered = false;
  unsigned int m_frame = 0;
  vpImage<unsigned char> m_picture;
  vpRigidTransform m_fMc;
};

END_VISP_NAMESPACE
#endif
