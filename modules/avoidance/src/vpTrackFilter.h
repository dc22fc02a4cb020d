/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrackFilter.h
 * \brief Internal: where one object of vpObjectTracks is and how it moves.
 */
#ifndef vpTrackFilter_h
#define vpTrackFilter_h

#include "vpRestTest.h"

#include <visp3/avoidance/vpObjectTracks.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Covariance of (value, rate) of one axis of a motion whose rate is disturbed by white noise; all axes alike.
 */
struct vpMotionVariance {
  double value = 0., both = 0., rate = 0.;

  //! After \e dt seconds. \param density : Of the noise.
  [[nodiscard]] vpMotionVariance after(double dt, double density) const;
  //! What a measurement of the value takes away. \param gain : Of value and rate.
  void measure(double variance, Eigen::Vector2d &gain);
};

/*!
 * \brief Kalman filter of constant velocity for position and rotation, a rest test for each, a gate. Does not allocate.
 */
class vpTrackFilter
{
public:
  //! Starts with a sighting, velocity unknown.
  vpTrackFilter(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec);

  //! The next sighting, not older than time(). \return True when it was used, if only to start anew.
  bool add(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec);
  //! Fills in all of \e track but its name, shape and inflation, at \e now.
  void predict(double now, const vpObjectTrackSpec &spec, vpObjectTrack &track) const;
  //! Of the last sighting that was used.
  [[nodiscard]] double time() const { return m_time; }
  //! Distance of the shape's farthest point from its origin, m: kept here, since a mesh has many points.
  [[nodiscard]] double reach() const { return m_reach; }
  //! The shape has changed.
  void setReach(double reach) { m_reach = reach; }

private:
  struct Motion {
    Eigen::Vector3d position = Eigen::Vector3d::Zero(), linear = Eigen::Vector3d::Zero();
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d angular = Eigen::Vector3d::Zero();
    vpMotionVariance place, turn;
  };
  [[nodiscard]] Motion at(double time, const vpObjectTrackSpec &spec) const;
  [[nodiscard]] bool isPossible(const vpObjectSighting &sighting, const Motion &motion, double gate) const;
  void start(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec);
  void use(const vpObjectSighting &sighting, const Motion &motion, const vpObjectTrackSpec &spec);
  void testRest(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec);
  bool doubt(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec);

  double m_time = 0., m_reach = 0.;
  Motion m_motion; // at m_time
  vpRestTest m_placeTest, m_turnTest;
  Eigen::Matrix3d m_reference = Eigen::Matrix3d::Identity(); // rotation vectors of m_turnTest are from here
  int m_sightings = 0, m_restarts = 0;
  double m_trust = 0.; // 0..1
  // Doubted sightings in a row; those that agree with the last one; where that was.
  int m_doubted = 0, m_agreeing = 0;
  vpRigidTransform m_doubtedPose;
  double m_doubtedTime = 0., m_doubtedPlaceVariance = 0., m_doubtedTurnVariance = 0.;
};

END_VISP_NAMESPACE
#endif
