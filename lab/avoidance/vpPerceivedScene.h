/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPerceivedScene.h
 * \brief Scene of an avoidance experiment as perceived by the method.
 */
#ifndef vpPerceivedScene_h
#define vpPerceivedScene_h

#include "lab/avoidance/vpTrueScene.h"

#include <deque>

BEGIN_VISP_NAMESPACE

//! \brief Sensor, latency and tracks: converts the true scene to the one read by the method.
class vpPerceivedScene
{
public:
  explicit vpPerceivedScene(const vpAvoidanceRunSpec &spec);

  /*!
   * One period: exposes when due, processes arrived results, and updates the scene to the time \e t, s.
   * \param q : True current configuration. \return True if a result arrived, even one without objects.
   */
  bool update(double t, const vpTrueScene &truth, const vpJointVector &q);
  //! Perceived scene for the method.
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
