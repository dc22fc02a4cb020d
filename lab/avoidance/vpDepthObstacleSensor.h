/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDepthObstacleSensor.h
 * \brief Simulated depth camera in the hand: renders the true scene and maps it.
 */
#ifndef vpDepthObstacleSensor_h
#define vpDepthObstacleSensor_h

#include <visp3/avoidance/vpDepthOctomap.h>
#include "lab/avoidance/vpObstacleSensor.h"
#include <visp3/rendering/vpSceneCamera.h>

BEGIN_VISP_NAMESPACE

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
