/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoArm.h
 * \brief The arm that carries the camera of a servo experiment, and what is logged of it.
 */
#ifndef vpServoArm_h
#define vpServoArm_h

#include <visp3/simulation/vpServoPlant.h>
#include <visp3/simulation/vpSimulatedArm.h>

BEGIN_VISP_NAMESPACE

/*!
 * \brief An arm for vpServoRunSpec::arm.
 *
 * A vpServoPlant tells how good it is. Without lag and deadband the drives are ideal. With either the arm is driven by
 * torques (PD with gravity, (3.19), no friction compensation) against friction that is deadband / 0.10 rad/s times that
 * of the arm's file: once on plant B, twice on plant D. Vision, latency, noise and the limits of the twist are those of
 * the plant; lag and deadband of the twist come from the arm itself.
 */
struct vpServoArm {
  vpArmModel model;        //!< Joints, limits, masses, camera.
  vpSimulatedArmSpec spec; //!< Start, self-motion, limits policy; drives and control period are set by forPlant().

  /*!
   * Parameters of the arm on a plant: drives as above, a control period of at most 5 ms that divides the plant's cycle.
   */
  [[nodiscard]] vpSimulatedArmSpec forPlant(const vpServoPlant &plant) const;
};

//! \ingroup group_simulation
//! \brief The arm at the time of a vpServoSample.
struct vpArmSample {
  vpJointVector q;                //!< True configuration, rad or m.
  vpJointVector velocity;         //!< True joint velocities, rad/s or m/s.
  vpJointVector wanted;           //!< Commanded configuration, rad or m.
  vpJointVector command;          //!< Commanded joint velocities, rad/s or m/s.
  vpJointVector torque;           //!< Nm or N; zero for ideal drives.
  double limitMargin = 0.;        //!< From the nearest position limit, rad or m; infinite when no joint has one.
  double manipulability = 0.;     //!< sqrt(det(J J^T)).
  double selfMotion = 0.;         //!< Length of the joint velocity that the indices wanted, rad/s.
  unsigned int stoppedJoints = 0; //!< Bit i: joint i is held at a position limit.
  vpSimulatedArmStatus status = vpSimulatedArmStatus::Stopped; //!< How the arm is doing.
  vpRedundancyStatus solver = vpRedundancyStatus::Exact;       //!< What the twist meets.
};

//! \ingroup group_simulation
//! \brief The figures of the arm over a run; the same names as in summary.json.
struct vpArmMetrics {
  vpJointVector joint_rms;         //!< Root mean square of commanded minus true position, rad or m, a number a joint.
  double least_limit_margin = 0.;  //!< rad or m; infinite when no joint has limits.
  int least_margin_joint = -1;     //!< Joint that it belongs to, from 0; -1: none.
  double peak_velocity_share = 0.; //!< Largest commanded joint velocity over its limit, 0..1.
  double peak_acceleration_share = 0.; //!< Largest change of a commanded velocity in a cycle over its limit, 0..1.
  double least_manipulability = 0.;    //!< Least sqrt(det(J J^T)).
  double self_motion_rad = 0.; //!< Way that the joints made for the indices: integral of vpArmSample::selfMotion.
  double limited_s = 0.;       //!< Time with vpSimulatedArmStatus::Limited.
  double blocked_s = 0.;       //!< Time with vpSimulatedArmStatus::Blocked.
  std::string status;          //!< "ok", or a sentence on what hindered the arm.
};

//! \ingroup group_simulation
//! \brief The figures of a log. \param model : The arm. \param samples : The log. \param cycle : Between the samples, s.
[[nodiscard]] vpArmMetrics evaluateArmRun(const vpArmModel &model, const std::vector<vpArmSample> &samples,
                                          double cycle);

END_VISP_NAMESPACE
#endif
