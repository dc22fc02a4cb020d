/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpObstacleSensor_h
#define vpObstacleSensor_h

#include <visp3/avoidance/vpObjectTracks.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpObstacleSensor
 * \brief Simulated obstacle sensor: gives the sightings of the true scene at one exposure.
 */
class vpObstacleSensor
{
public:
  virtual ~vpObstacleSensor() = default;

  /*!
   * \param truth : True scene at \e time. \param arm : True configuration at \e time, after place().
   * \param time : Time of exposure, s; becomes vpObjectSighting::time. \param result : Replaced by the sightings.
   */
  virtual void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
                    std::vector<vpObjectSighting> &result) = 0;
};

END_VISP_NAMESPACE
#endif
