/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrackFilter.h
 * \brief Internal: state estimate of one object of vpObjectTracks.
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

  //! Predicts by \e dt seconds. \param density : Density of the noise.
  [[nodiscard]] vpMotionVariance after(double dt, double density) const;
  //! Updates with a measurement of the value. \param gain : Gains of value and rate.
  void measure(double variance, Eigen::Vector2d &gain);
};

/*!
 * \brief Constant-velocity Kalman filters for position and rotation, a rest test for each, a gate. Does not allocate.
 */
class vpTrackFilter
{
public:
  //! Starts with a sighting, velocity unknown.
  vpTrackFilter(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec);

  //! Adds a sighting, not older than time(). \return True if it was used, even if only to restart.
  bool add(const vpObjectSighting &sighting, const vpObjectTrackSpec &spec);
  //! Sets all fields of \e track except name, shape and inflation, at \e now.
  void predict(double now, const vpObjectTrackSpec &spec, vpObjectTrack &track) const;
  //! Time of the last sighting used.
  [[nodiscard]] double time() const { return m_time; }
  //! Distance of the shape's farthest point from its origin, m: cached, since a mesh has many points.
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
  Eigen::Matrix3d m_reference = Eigen::Matrix3d::Identity(); // origin of the rotation vectors of m_turnTest
  int m_sightings = 0, m_restarts = 0;
  double m_trust = 0.; // 0..1
  // Number of consecutive doubted sightings; of those that agree with the last one; its position.
  int m_doubted = 0, m_agreeing = 0;
  vpRigidTransform m_doubtedPose;
  double m_doubtedTime = 0., m_doubtedPlaceVariance = 0., m_doubtedTurnVariance = 0.;
};

END_VISP_NAMESPACE
#endif
