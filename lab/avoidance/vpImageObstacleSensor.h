/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpImageObstacleSensor.h
 * \brief Simulated camera in the hand: renders the true scene and detects obstacles.
 */
#ifndef vpImageObstacleSensor_h
#define vpImageObstacleSensor_h

#include <visp3/avoidance/vpObstacleDetector.h>
#include "lab/avoidance/vpObstacleSensor.h"
#include <visp3/rendering/vpSceneCamera.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Errors of images and of the known camera pose.
 */
struct vpImageObstacleSensorSpec {
  vpCameraFaults faults;       //!< Imperfections of each image.
  double positionSigma = 2e-4; //!< Position error sigma of the known camera pose per coordinate and image, m, >= 0.
  double angleSigma = 5e-4;    //!< Rotation error sigma per component and image, rad, >= 0.
  unsigned int seed = 1;       //!< Seed of all noise.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpImageObstacleSensor
 * \brief Renders the view of the arm's camera and detects the obstacles in each image (thesis 8.3.2).
 */
class vpImageObstacleSensor : public vpObstacleSensor
{
public:
  /*!
   * \param camera : Renders the images. \param detector : Detector for the same intrinsics.
   * \param spec : Parameters of the images.
   * \throw vpException (badValue), see vpImageObstacleSensorSpec::validate().
   */
  vpImageObstacleSensor(vpSceneCamera camera, vpObstacleDetector detector, const vpImageObstacleSensorSpec &spec = {});

  //! Throws as vpSceneCamera::picture().
  void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
            std::vector<vpObjectSighting> &result) VP_OVERRIDE;
  //! A covered camera gives dark images.
  void cover(bool covered) noexcept { m_covered = covered; }
  //! The last image; empty before the first.
  [[nodiscard]] const vpImage<unsigned char> &picture() const noexcept { return m_picture; }
  //! Detector with the last result.
  [[nodiscard]] const vpObstacleDetector &detector() const noexcept { return m_detector; }
  //! Camera pose at the last image, as known by the arm.
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
