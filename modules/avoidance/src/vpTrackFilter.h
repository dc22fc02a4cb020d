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

#include <visp3/avoidance/vpObjectTracks.h>

#include <array>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Tests whether a constant explains the last measurements of a vector.
 *
 * A Kalman filter that follows manoeuvres has a noisy velocity. A straight line through many measurements is more
 * accurate, so it decides on rest. Does not allocate.
 */
class vpRestTest
{
public:
  //! Criteria for rest.
  struct Limits {
    double sigmas; //!< Maximum slope in standard deviations; 0: never at rest.
    double speed;  //!< Only enough measurements to distinguish this speed from 0 decide.
  };

  //! Clears all measurements.
  void clear() { *this = vpRestTest(); }
  //! Adds a measurement. \param variance : Variance of each component.
  void add(double time, const Eigen::Vector3d &value, double variance, const Limits &limits);
  //! True if the last measurements are those of a resting object.
  [[nodiscard]] bool isResting() const { return m_resting > 0; }
  //! Rest position.
  [[nodiscard]] const Eigen::Vector3d &place() const { return m_line.mean; }
  //! Variance of each component of place() at \e time, including that of the slope.
  [[nodiscard]] double variance(double time) const;
  //! Variance of each component of the slope.
  [[nodiscard]] double slopeVariance() const { return 1. / m_line.spread; }

private:
  static constexpr int capacity = 32;
  struct Sample {
    double time = 0.;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    double weight = 0.;
  };
  struct Line {
    double weight = 0., time = 0., spread = 0.; // sum of weights, mean time, sum of weighted squares about it
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), slope = Eigen::Vector3d::Zero();
    double scatter = 0.; // sum of weighted squares about the mean: chi-square of 3 (count - 1) when at rest
  };
  [[nodiscard]] const Sample &newest(int k) const
  {
    return m_samples[static_cast<std::size_t>((m_next + capacity - 1 - k) % capacity)];
  }
  [[nodiscard]] Line fit(int count) const;
  [[nodiscard]] int enough(const Limits &limits) const;
  [[nodiscard]] static bool isConstant(const Line &line, int count, double slopeSigmas, double scatterSigmas);

  std::array<Sample, capacity> m_samples;
  int m_count = 0, m_next = 0;
  int m_resting = 0; // number of newest measurements at rest
  Line m_line;       // line through these
};

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
