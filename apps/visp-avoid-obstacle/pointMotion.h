/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file pointMotion.h
 * \brief A point in the plane on direct trajectories whose goal changes during the motion: figures 8.7, 8.9, 8.13.
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
//! \brief A change of goal.
struct PointEvent {
  double time = 0.;                               //!< s.
  Eigen::Vector2d goal = Eigen::Vector2d::Zero(); //!< m.
  std::optional<Eigen::Vector2d> via;             //!< Via position, m.
};

//! \brief Task of a point, starting at rest.
struct PointTask {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();                  //!< m.
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();                   //!< m.
  double maxSpeed = std::numeric_limits<double>::infinity();        //!< Norm, m/s.
  double maxAcceleration = std::numeric_limits<double>::infinity(); //!< Norm, m/s^2.
  double viaShare = 0.5;          //!< Time of a via as a fraction of the move from its event on.
  std::vector<PointEvent> events; //!< In time order.
  //! Goal as a function of time, s to m; empty: none. If set, the arrival time is kept.
  std::function<Eigen::Vector2d(double)> told;
  double toldEvery = 0.02; //!< Period of the goals, s.
  double floor = 0.;       //!< Minimum duration of a plan, s.
  double duration = 3.;    //!< Minimum duration, s; extended until the point is at rest.
};

//! \brief State at one millisecond.
struct PointSample {
  double time = 0.;                                    //!< s.
  Eigen::Vector2d place, velocity, acceleration, goal; //!< m; goal as commanded.
};

//! \brief A finished motion.
struct PointMotion {
  std::vector<PointSample> samples;
  bool arrived = false;
  double arrival = 0.;          //!< s.
  double peakSpeed = 0.;        //!< Norm, m/s, sampled ten times as densely.
  double peakAcceleration = 0.; //!< Norm, m/s^2, sampled ten times as densely.
  double jump = 0.;             //!< Largest change of the acceleration from one sample to the next, m/s^2.
  int plans = 0;                //!< Number of plans.
};

constexpr double pointPeriod = 1e-3; //!< s, thesis 8.3.1: local control at 1 kHz.

//! \throw std::runtime_error with the trajectory's sentence when it rejects the task.
[[nodiscard]] PointMotion follow(const PointTask &task);
} // namespace avoidObstacle

#endif
