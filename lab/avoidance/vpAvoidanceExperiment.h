/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAvoidanceExperiment.h
 * \brief The closed loop of avoidance: exposure -> tracks -> scene -> method -> drives -> truth, and the log of it.
 */
#ifndef vpAvoidanceExperiment_h
#define vpAvoidanceExperiment_h

#include "lab/avoidance/vpAvoidanceRunSpec.h"

BEGIN_VISP_NAMESPACE

/*!
 * \brief One row of the log per period: the true state at #time, and the command from then until the next row.
 */
struct vpAvoidanceSample {
  double time = 0.;        //!< Time since the start, s.
  vpJointVector q;         //!< True configuration, rad or m.
  vpJointVector commanded; //!< Commanded configuration: the integral of the commands so far, rad or m.
  vpJointVector command;   //!< Joint velocities from #time on, rad/s or m/s.
  Eigen::Vector3d tool = Eigen::Vector3d::Zero();             //!< True position of the end effector's origin, m.
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();           //!< vpAvoidanceOutput::wanted, m.
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();             //!< True position of the goal, m.
  vpAvoidanceStatus status = vpAvoidanceStatus::InvalidInput; //!< Status of the method.
  bool stopping = false;                                      //!< vpAvoidanceOutput::stopping.
  bool newImage = false;                                      //!< A sensor result arrived, or the goal was updated.
  double lookTime = 0.;     //!< Wall time of vpAvoidanceMethod::look(), s; does not affect the run.
  double goalDistance = 0.; //!< Distance of the true tool from the true goal, m.
  vpClearance clearance;    //!< True nearest pair, within 1 m; other is an index of \e objects.
  //! Name of the true object of #clearance if its kind is Object, else empty.
  std::string nearest;
};

/*!
 * \brief Metrics of a run, named as in summary.json.
 *
 * v, a and jerk are those of the commanded tool: differences of its position at the commanded configurations, one
 * period apart, from rest at the start; a velocity jump appears as a large a that grows with 1 / period, an
 * acceleration jump as a large jerk. The clearance is that of the true arm and the true obstacles at every instant:
 * between two knots of the true motion (at most 1 ms apart with non-ideal drives, else one period of constant joint
 * velocity) it is searched to 0.1 mm, by bounds on the motion of arm and obstacles.
 */
struct vpAvoidanceMetrics {
  //! At rest at the goal (vpAvoidanceRunSpec::goalTolerance) at the end, and no contact while the arm moved.
  bool success = false;
  double min_clearance_m = 0.; //!< Least true clearance of the whole arm, negative: depth; at most 1 m.
  double goal_error_m = 0.;    //!< Distance of the true tool from the true goal at the end.
  double duration_s = 0.;      //!< Time until finally at rest at the goal; else until the end of the run.
  double peak_v = 0.;          //!< Peak velocity, m/s.
  double peak_a = 0.;          //!< Peak acceleration, m/s^2.
  double peak_jerk = 0.;       //!< Peak jerk, m/s^3.
  double jerk_integral = 0.;   //!< Integral of the squared jerk over time, m^2/s^5.
  double path_length = 0.;     //!< Path length of the true tool, m.
  double replan_ms_p50 = 0.;   //!< Median wall time of vpAvoidanceMethod::look(), ms, see vpQuantile(); 0: none.
  double replan_ms_p95 = 0.;   //!< 95 % quantile of the same.
  double replan_ms_p99 = 0.;   //!< 99 % quantile of the same.
  //! Number of stops of the moving arm: vpAvoidanceOutput::stopping, Waiting or Unsafe after another status.
  int stops = 0;
  /*!
   * Number of unjustified stops: with the true obstacle motion nothing would have come nearer than the margin and 20
   * mm, neither if the joints had kept their previous velocities for another second, within the position limits, nor if
   * the joints or the tool had gone straight to the goal, at the tool's largest speed. The method's plan is not known
   * here; a justified stop on a detour, with all straight motions free, counts as false.
   */
  int false_stops = 0;
  int collisions_moving = 0;   //!< Number of contacts while a joint moved faster than 0.01 rad/s or m/s.
  int collisions_standing = 0; //!< Number of contacts with the arm at rest.
  int joint_v_violations = 0;  //!< Periods with a joint velocity above its limit by more than a relative 1e-6.
  int joint_a_violations = 0;  //!< Periods with a joint acceleration above its limit by more than a relative 1e-6.
  int tool_v_violations = 0;   //!< Periods without a protective stop and v above the bound by more than 1 %.
  int tool_a_violations = 0;   //!< Periods without a protective stop and a above the bound by more than 1 %.
  std::string status;          //!< Final status, as a sentence.
};

/*!
 * \brief A finished run.
 */
struct vpAvoidanceRun {
  vpAvoidanceRunSpec spec;                             //!< Specification of the run.
  std::vector<vpAvoidanceSample> samples;              //!< Log; the last sample is the end, without a command.
  std::vector<double> lookTimes;                       //!< Wall times of all calls of vpAvoidanceMethod::look(), s.
  vpAvoidanceStatus start = vpAvoidanceStatus::Moving; //!< Result of vpAvoidanceMethod::start().
  double startTime = 0.;                               //!< Wall time of start(), s.
  std::string message;                                 //!< Final sentence of the method, with pair and margin.
  std::string ended;                                   //!< Why the run ended: "the arm stood still for 3 s".
  vpAvoidanceMetrics metrics;                          //!< Metrics.
};

/*!
 * Runs one experiment. It ends when the goal no longer moves and the arm is at the goal, at rest (joint commands at
 * most 0.01 rad/s or m/s) for 0.2 s, or the method reports Arrived for 1 s; when arm, obstacles and goal have not moved
 * for 3 s and no motion is pending; or after vpAvoidanceRunSpec::maxDuration.
 * \param spec : Specification; validated first.
 * \param progress : If given, called periodically with the completed fraction of maxDuration, 0..1; return false to
 * stop early.
 * \throw vpException naming the error in the spec.
 */
[[nodiscard]] vpAvoidanceRun runAvoidanceExperiment(const vpAvoidanceRunSpec &spec,
                                                    const std::function<bool(double)> &progress = {});

END_VISP_NAMESPACE
#endif
