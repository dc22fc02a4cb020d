/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoArm.h
 * \brief What carries the camera of a servo experiment: an arm, with its log, or a free-flying robot.
 */
#ifndef vpServoArm_h
#define vpServoArm_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/simulation/vpServoPlant.h>
#include <visp3/simulation/vpSimulatedArm.h>

#include <memory>

BEGIN_VISP_NAMESPACE

/*!
 * \brief Arm for vpServoRunSpec::arm.
 *
 * Its imperfections follow from a vpServoPlant. Without lag and deadband the drives are ideal. With either the arm is
 * torque-driven (PD with gravity compensation, (3.19), no friction compensation; reference and gains as in the spec)
 * with the friction of the arm model times deadband / 0.10 rad/s: once on plant B, twice on plant D. Vision, latency,
 * noise and twist limits are those of the plant; lag and deadband of the twist result from the arm itself. Axes of the
 * camera in vpSimulatedArmSpec::free are not commanded and not counted in vpServoSample::rotationError and other errors.
 */
struct vpServoArm {
  vpArmModel model;        //!< Joints, limits, masses, camera.
  vpSimulatedArmSpec spec; //!< Start, self-motion, limit policy; drives and control period are set by forPlant().
  vpJointVector jerk{};    //!< Limits for laws that plan, see vpArmMotionCheck; empty: none.

  /*!
   * Parameters of the arm on a plant: drives as above, a control period of at most 5 ms that divides the plant's cycle.
   */
  [[nodiscard]] vpSimulatedArmSpec forPlant(const vpServoPlant &plant) const;
};

//! \brief State of the arm at the time of a vpServoSample.
struct vpArmSample {
  vpJointVector q;                  //!< True configuration, rad or m.
  vpJointVector velocity;           //!< True joint velocities, rad/s or m/s.
  vpJointVector wanted;             //!< Commanded configuration, rad or m.
  vpJointVector command;            //!< Commanded joint velocities, rad/s or m/s.
  vpJointVector torque;             //!< Torques, Nm or N; zero for ideal drives.
  vpJointVector needed;             //!< Torques that the commands take, see vpArmDrives::needed().
  unsigned int saturated = 0;       //!< Bit i: the drive of joint i is at its torque limit.
  vpJointShortfall lost;            //!< The joint of vpSimulatedArmStatus::NotFollowing.
  double limitMargin = 0.;          //!< Distance from the nearest position limit, rad or m; infinite without limits.
  double manipulability = 0.;       //!< sqrt(det(J J^T)).
  double selfMotion = 0.;           //!< Norm of the self-motion velocity due to the indices, rad/s.
  unsigned int stoppedJoints = 0;   //!< Bit i: joint i is held at a position limit.
  unsigned int unreachableAxes = 0; //!< See vpRedundancyOutput::unreachableAxes.
  vpSimulatedArmStatus status = vpSimulatedArmStatus::Stopped; //!< Status of the arm.
  vpRedundancyStatus solver = vpRedundancyStatus::Exact;       //!< Status of the redundancy solver.
};

//! \brief Metrics of the arm over a run, named as in summary.json.
struct vpArmMetrics {
  vpJointVector joint_rms;             //!< Rms of commanded minus true position, rad or m, one number per joint.
  double least_limit_margin = 0.;      //!< Least limitMargin, rad or m; infinite without limits.
  int least_margin_joint = -1;         //!< Joint with the least margin, from 0; -1: none.
  double peak_velocity_share = 0.;     //!< Largest ratio of commanded joint velocity to its limit, 0..1.
  double peak_acceleration_share = 0.; //!< Largest ratio of commanded joint acceleration to its limit, 0..1.
  double least_manipulability = 0.;    //!< Least sqrt(det(J J^T)).
  double self_motion_rad = 0.;         //!< Joint travel due to the indices: integral of vpArmSample::selfMotion.
  double limited_s = 0.;               //!< Time with vpSimulatedArmStatus::Limited.
  double blocked_s = 0.;               //!< Time with vpSimulatedArmStatus::Blocked.
  double saturated_s = 0.;             //!< Time with a drive at its torque limit.
  vpJointShortfall shortfall;          //!< The joint that did not follow, or the drive at its limit that missed most.
  std::string status;                  //!< "ok", or a sentence on the limitation of the arm.
};

//! \brief Metrics of a log. \param model : The arm. \param samples : The log. \param cycle : Sample period, s.
[[nodiscard]] vpArmMetrics evaluateArmRun(const vpArmModel &model, const std::vector<vpArmSample> &samples,
                                          double cycle);

struct vpServoRunSpec;

//! \brief Robot that carries the camera of a servo experiment: free-flying with friction, or an arm.
class vpServoRobot
{
public:
  //! Creates a free-flying camera, or the arm of the spec. \throw vpException naming the invalid parameter.
  [[nodiscard]] static std::unique_ptr<vpServoRobot> create(const vpServoRunSpec &spec);
  virtual ~vpServoRobot() = default;

  //! Moves for one cycle of the plant with a twist in the camera frame.
  virtual void move(const vpTwist &twist) = 0;
  //! True pose of the camera in its frame at the start.
  [[nodiscard]] virtual vpHomogeneousMatrix wMc() = 0;
  //! Twist executed in the last cycle, as measured by encoders, camera frame.
  [[nodiscard]] virtual vpTwist actual() const = 0;
  //! Current state of the arm, with the command of the last cycle; false for a free-flying camera.
  virtual bool sample(vpArmSample &) const { return false; }
};

END_VISP_NAMESPACE
#endif
