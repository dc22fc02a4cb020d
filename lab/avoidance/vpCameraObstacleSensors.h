/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCameraObstacleSensors.h
 * \brief Simulated cameras in the hand that render the true scene: obstacles detected in images, depth images mapped.
 */
#ifndef vpCameraObstacleSensors_h
#define vpCameraObstacleSensors_h

#include "lab/avoidance/vpObstacleSensor.h"

#include <visp3/avoidance/vpDepthOctomap.h>
#include <visp3/avoidance/vpObstacleDetector.h>
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

/*!
 * \brief Errors of depth images and of the known camera pose, and parameters of the map.
 */
struct vpDepthObstacleSensorSpec {
  std::string name = "depth";  //!< Name of the sighting; not empty.
  vpDepthFaults faults;        //!< Imperfections of each depth image.
  vpDepthOctomapSpec map;      //!< Parameters of the map.
  double positionSigma = 2e-4; //!< See vpImageObstacleSensorSpec::positionSigma, m, >= 0.
  double angleSigma = 5e-4;    //!< See vpImageObstacleSensorSpec::angleSigma, rad, >= 0.
  unsigned int seed = 1;       //!< Seed of all noise.

  //! \throw vpException (badValue) naming the field that is out of range, and its value; the map checks its own.
  void validate() const;
};

/*!
 * \class vpDepthObstacleSensor
 * \brief Map of all depth images so far, as one sighting: a static octree in the base.
 *
 * Each image gives a sighting, even if the map is empty. The map has no separate objects and thus no velocities: moving
 * objects leave cubes until they are carved. If images also feed the track table, vpDepthObstacles is the better
 * second source.
 */
class vpDepthObstacleSensor : public vpObstacleSensor
{
public:
  /*!
   * \param camera : Its photographs are not used.
   * \param spec : Parameters of map and images.
   * \throw vpException (badValue) naming the field and its value.
   */
  vpDepthObstacleSensor(vpSceneCamera camera, const vpDepthObstacleSensorSpec &spec = {});

  void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
            std::vector<vpObjectSighting> &result) VP_OVERRIDE;
  //! The last depth image, m; empty before the first.
  [[nodiscard]] const vpImage<float> &depth() const noexcept { return m_depth; }
  //! Pixel statistics of the last depth image.
  [[nodiscard]] const vpDepthReport &report() const noexcept { return m_report; }

private:
  vpSceneCamera m_camera;
  vpDepthObstacleSensorSpec m_spec;
  vpDepthOctomap m_map;
  unsigned int m_frame = 0;
  vpImage<float> m_depth;
  vpDepthReport m_report;
};

END_VISP_NAMESPACE
#endif
