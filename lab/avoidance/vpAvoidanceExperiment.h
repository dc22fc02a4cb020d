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
 * \brief One row of the log, a period each: what is true at #time, and what is commanded from then until the next row.
 */
struct vpAvoidanceSample {
  double time = 0.;        //!< s since the start.
  vpJointVector q;         //!< True configuration, rad or m.
  vpJointVector commanded; //!< Commanded configuration: the integral of the commands so far, rad or m.
  vpJointVector command;   //!< Joint velocities from now on, rad/s or m/s.
  Eigen::Vector3d tool = Eigen::Vector3d::Zero();             //!< True place of the end effector's origin, m.
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();           //!< vpAvoidanceOutput::wanted, m.
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();             //!< True place of the goal, m.
  vpAvoidanceStatus status = vpAvoidanceStatus::InvalidInput; //!< Of the method.
  bool stopping = false;                                      //!< vpAvoidanceOutput::stopping.
  bool newImage = false;    //!< A result of the sensor arrived, or the goal was told anew.
  double lookTime = 0.;     //!< Wall time that vpAvoidanceMethod::look() took then, s; plays no part in the run.
  double goalDistance = 0.; //!< Of the true tool, m.
  vpClearance clearance;    //!< True nearest pair now, within 1 m; other is an index of \e objects.
  //! Names of the true objects of #clearance when its kind is Object, else empty.
  std::string nearest;
};

/*!
 * \brief The figures of a run; the same names as in summary.json.
 *
 * v, a and jerk are those of the commanded tool: differences of its place at the commanded configurations, one period
 * apart, from rest at the start; a jump of the velocity shows as a large a that grows with 1 / period, one of the
 * acceleration as a large jerk. The clearance is that of the true arm and the true obstacles at every instant: between
 * two knots of the true motion (1 ms apart at most with drives that are not ideal, else a period, where the joints move
 * at constant velocity) it is searched until it is known to 0.1 mm, by bounds on how far arm and obstacles move.
 */
struct vpAvoidanceMetrics {
  //! At the goal (vpAvoidanceRunSpec::goalTolerance) at rest in the end, and nothing touched while the arm moved.
  bool success = false;
  double min_clearance_m = 0.; //!< Least true clearance of the whole arm, negative: depth; at most 1 m.
  double goal_error_m = 0.;    //!< Distance of the true tool from the true goal in the end.
  double duration_s = 0.;      //!< Until it is at the goal at rest for good; until the end of the run if it is not.
  double peak_v = 0.;          //!< m/s.
  double peak_a = 0.;          //!< m/s^2.
  double peak_jerk = 0.;       //!< m/s^3.
  double jerk_integral = 0.;   //!< Of the squared jerk over time, m^2/s^5.
  double path_length = 0.;     //!< Of the true tool, m.
  double replan_ms_p50 = 0.;   //!< Wall time of vpAvoidanceMethod::look(), ms, see vpQuantile(); 0: none.
  double replan_ms_p95 = 0.;   //!< The same.
  double replan_ms_p99 = 0.;   //!< The same.
  //! Times that the moving arm was stopped: vpAvoidanceOutput::stopping, Waiting or Unsafe after something else.
  int stops = 0;
  /*!
   * Stops without a reason: nothing would have come nearer than the margin and 20 mm while the obstacles do what they
   * truly do, neither had the joints kept the velocities of the period before for another second, within their position
   * limits, nor had the joints, nor had the tool gone straight to the goal, at the tool's largest speed. What a method
   * had planned is not known here; a way round that is blocked for good reason on no straight way counts as false.
   */
  int false_stops = 0;
  int collisions_moving = 0;   //!< Times that something was touched while a joint moved faster than 0.01 rad/s or m/s.
  int collisions_standing = 0; //!< Times that something ran into the arm at rest.
  int joint_v_violations = 0;  //!< Periods with a joint velocity above its limit by more than 1e-6 of it.
  int joint_a_violations = 0;  //!< Periods with a change of a joint velocity above its limit by more than 1e-6 of it.
  int tool_v_violations = 0;   //!< Periods without a protective stop and v above the bound by more than 1 %.
  int tool_a_violations = 0;   //!< The same of a.
  std::string status;          //!< How it ended, as a sentence.
};

/*!
 * \brief A finished run.
 */
struct vpAvoidanceRun {
  vpAvoidanceRunSpec spec;                             //!< What was run.
  std::vector<vpAvoidanceSample> samples;              //!< The last one is the end: nothing is commanded any more.
  std::vector<double> lookTimes;                       //!< Of all calls of vpAvoidanceMethod::look(), s.
  vpAvoidanceStatus start = vpAvoidanceStatus::Moving; //!< What vpAvoidanceMethod::start() said.
  double startTime = 0.;                               //!< Wall time that it took, s.
  std::string sentence;                                //!< What the method said in the end, with pair and margin.
  vpAvoidanceMetrics metrics;                          //!< The figures.
};

/*!
 * Runs one experiment. It ends when the arm is at the goal, at rest (joints commanded no faster than 0.01 rad/s or m/s)
 * for 0.2 s, or the method has called itself arrived for 1 s, and the goal does not move any more; when nothing has moved
 * for 3 s, neither arm nor obstacle nor goal, and nothing is to come; or with vpAvoidanceRunSpec::maxDuration.
 * \param spec : What to run; validated first.
 * \param progress : If given, called now and then with the share of maxDuration that is done, 0..1; return false to stop
 * early.
 * \throw vpException naming what is wrong with the spec.
 */
[[nodiscard]] vpAvoidanceRun runAvoidanceExperiment(const vpAvoidanceRunSpec &spec,
                                                                const std::function<bool(double)> &progress = {});

END_VISP_NAMESPACE
#endif
