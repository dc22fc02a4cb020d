/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pointMotion.h
 * \brief A point in the plane that goes by direct trajectories whose goal changes on the way: figures 8.7, 8.9, 8.13.
 */
#ifndef avoidObstacle_pointMotion_h
#define avoidObstacle_pointMotion_h

#include <visp3/trajectory/vpDirectTrajectory.h>

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace avoidObstacle
{
//! \brief At some time the point is told to go elsewhere.
struct PointEvent {
  double time = 0.;                               //!< s.
  Eigen::Vector2d goal = Eigen::Vector2d::Zero(); //!< m.
  std::optional<Eigen::Vector2d> via;             //!< On the way there, m.
};

//! \brief What a point is to do, from rest.
struct PointTask {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();                  //!< m.
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();                   //!< m.
  double maxSpeed = std::numeric_limits<double>::infinity();        //!< Norm, m/s.
  double maxAcceleration = std::numeric_limits<double>::infinity(); //!< Norm, m/s^2.
  double viaShare = 0.5;          //!< Time of a via as a part of the move from its event on.
  std::vector<PointEvent> events; //!< In the order of time.
  //! Goals that are told again and again, s to m; empty: none. Then the time of arrival is kept.
  std::function<Eigen::Vector2d(double)> told;
  double toldEvery = 0.02; //!< s.
  double floor = 0.;       //!< No plan is shorter, s.
  double duration = 3.;    //!< At least, s; it goes on until the point is at rest.
};

//! \brief One millisecond of it.
struct PointSample {
  double time = 0.;                                    //!< s.
  Eigen::Vector2d place, velocity, acceleration, goal; //!< m; goal as it was told.
};

//! \brief A finished motion.
struct PointMotion {
  std::vector<PointSample> samples;
  bool arrived = false;
  double arrival = 0.;          //!< s.
  double peakSpeed = 0.;        //!< Norm, between the samples, too: ten times as dense.
  double peakAcceleration = 0.; //!< The same.
  double jump = 0.;             //!< Largest change of the acceleration from one sample to the next, m/s^2.
  int plans = 0;                //!< That were made.
};

constexpr double pointPeriod = 1e-3; //!< s, thesis 8.3.1: local control at 1 kHz.

//! \throw std::runtime_error with the trajectory's sentence when it refuses the task.
[[nodiscard]] PointMotion follow(const PointTask &task);
} // namespace avoidObstacle

#endif
