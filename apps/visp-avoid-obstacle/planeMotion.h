/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file planeMotion.h
 * \brief Motions of a point in the plane: through a potential field, and on direct trajectories.
 */
#ifndef avoidObstacle_planeMotion_h
#define avoidObstacle_planeMotion_h

#include <visp3/avoidance/vpPotentialField.h>
#include <visp3/trajectory/vpDirectTrajectory.h>

#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace avoidObstacle
{
// A point that visits positions in a potential field as printed: figure 8.6.

/*!
 * \brief Positions in time order, and an obstacle beside the path that acts only on x, as in section 8.3.3. The
 * thesis gives no numbers for figure 8.6: these are our choice.
 */
struct FieldTask {
  std::vector<Eigen::Vector2d> places = {{0.05, 0.15}, {0.05, 0.3}, {0., 0.45}}; //!< Starting at (0, 0), m.
  double slot = 2.5;                       //!< Time per position, s, twice as long for the last one.
  Eigen::Vector2d obstacle = {-0.12, 0.4}; //!< m.
  double sight = 0.2;                      //!< Beyond this along y the camera does not see it, m.
  double gain = 2.;                        //!< x'_t = gain (place - x), 1/s.
  double avoidSpeed = 0.25;                //!< x'_oa, m/s.
  double period = 0.005;                   //!< s.
};

//! \brief The resulting motion.
struct FieldMotion {
  vpFieldWeightSpec weight;
  std::vector<double> times;        //!< s.
  std::vector<Eigen::Vector2d> way; //!< m.
  std::vector<double> weights;      //!< w_u.
  std::vector<double> missed;       //!< Distance from each position at the end of its slot, m.
  double peakSpeed = 0.;            //!< m/s.
};

//! If \e withObstacle is false, the obstacle has no weight.
[[nodiscard]] FieldMotion followField(const FieldTask &task, const vpFieldWeightSpec &weight, bool withObstacle = true);
//! Parameters of the upper (strict) and the lower plot, m.
[[nodiscard]] vpFieldWeightSpec strictField();
[[nodiscard]] vpFieldWeightSpec mildField();

// A point on direct trajectories whose goal changes during the motion: figures 8.7, 8.9, 8.13.

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
