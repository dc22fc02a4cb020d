/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpDepthObstacleSensor.h
 * \brief A depth camera in the hand: from the true scene over a depth image to a map.
 */
#ifndef vpDepthObstacleSensor_h
#define vpDepthObstacleSensor_h

#include <visp3/avoidance/vpDepthOctomap.h>
#include "lab/avoidance/vpObstacleSensor.h"
#include <visp3/rendering/vpSceneCamera.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief What is wrong with depth images and with what is known of the camera, and the map made of them.
 */
struct vpDepthObstacleSensorSpec {
  std::string name = "depth";  //!< Of the sighting; not empty.
  vpDepthFaults faults;        //!< Of each depth image.
  vpDepthOctomapSpec map;      //!< Of the map.
  double positionSigma = 2e-4; //!< As vpImageObstacleSensorSpec::positionSigma, m, >= 0.
  double angleSigma = 5e-4;    //!< As vpImageObstacleSensorSpec::angleSigma, rad, >= 0.
  unsigned int seed = 1;       //!< Of all noise.

  //! \throw vpException (badValue) naming the field that is out of range, and its value; the map checks its own.
  void validate() const;
};

/*!
 * \class vpDepthObstacleSensor
 * \brief Everything that depth images have shown so far, as one sighting: an octree at rest in the base.
 *
 * Each image gives a sighting, though the map may be empty. It knows no single objects, so it has no velocities: what
 * moves leaves cubes until they are carved. Where the track table is fed by pictures too, vpDepthObstacles is the better
 * second source.
 */
class vpDepthObstacleSensor : public vpObstacleSensor
{
public:
  /*!
   * \param camera : Its photographs are not used.
   * \param spec : Of map and images.
   * \throw vpException (badValue) naming the field and its value.
   */
  vpDepthObstacleSensor(vpSceneCamera camera, const vpDepthObstacleSensorSpec &spec = {});

  void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
            std::vector<vpObjectSighting> &result) VP_OVERRIDE;
  //! The last depth image, m; empty before the first.
  [[nodiscard]] const vpImage<float> &depth() const noexcept { return m_depth; }
  //! What became of its pixels.
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
