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
 * \brief One exposure of a sensor that sees obstacles: the true scene in, sightings out.
 */
class vpObstacleSensor
{
public:
  virtual ~vpObstacleSensor() = default;

  /*!
   * \param truth : Objects where they are at \e time. \param arm : True configuration then, after place().
   * \param time : Of the exposure, s; becomes vpObjectSighting::time. \param result : What is seen, replaced.
   */
  virtual void look(const vpCollisionScene &truth, const vpCollisionData &arm, double time,
                    std::vector<vpObjectSighting> &result) = 0;
};

END_VISP_NAMESPACE
#endif
