/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPerceivedScene.h
 * \brief The scene of an avoidance experiment as the method knows it.
 */
#ifndef vpPerceivedScene_h
#define vpPerceivedScene_h

#include "lab/avoidance/vpTrueScene.h"

#include <deque>

BEGIN_VISP_NAMESPACE

//! \brief Sensor, latency, tracks: from the true scene to the one that the method reads.
class vpPerceivedScene
{
public:
  explicit vpPerceivedScene(const vpAvoidanceRunSpec &spec);

  /*!
   * One period: exposes when that is due, takes in what has arrived, and brings the scene to the time \e t, s.
   * \param q : True configuration now. \return True when a result arrived, even one without objects.
   */
  bool update(double t, const vpTrueScene &truth, const vpJointVector &q);
  //! For the method.
  [[nodiscard]] const vpCollisionScene &scene() const noexcept { return m_scene; }

private:
  struct Result {
    double arrival = 0.;
    std::vector<vpObjectSighting> sightings;
  };
  [[nodiscard]] bool isExposed(double t);
  [[nodiscard]] bool isCovered(double t) const;
  void copyExactly(const vpTrueScene &truth);

  const vpAvoidanceRunSpec *m_spec;
  vpCollisionScene m_scene;
  std::unique_ptr<vpObstacleSensor> m_sensor;
  vpObjectTracks m_tracks;
  vpCollisionData m_data;
  std::deque<Result> m_pending;
  double m_nextFrame = 0.; // number of the next exposure
  double m_now = 0.;
};

END_VISP_NAMESPACE
#endif
