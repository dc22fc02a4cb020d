/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSimulatedArm.h
 * \brief Simulated arm with an eye-in-hand camera, as a robot of ViSP.
 */
#ifndef vpSimulatedArm_h
#define vpSimulatedArm_h

#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpVelocityTwistMatrix.h>
#include <visp3/manipulator/vpClosedLoopKinematics.h>
#include <visp3/robot/vpRobotSimulator.h>
#include <visp3/simulation/vpArmDrives.h>

#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_simulation
//! \brief Clock of the simulation.
enum class vpArmClock {
  Stepped, //!< Each setVelocity() lets getSamplingTime() pass, setPosition() as long as it takes: fast and repeatable.
  RealTime //!< Wall clock, in a separate thread: for programs that wait between commands.
};

//! \ingroup group_simulation
//! \brief Status of the arm.
enum class vpSimulatedArmStatus {
  Stopped,     //!< At rest, no motion requested.
  Moving,      //!< Moves as requested.
  Limited,     //!< Slower than requested: velocity or acceleration limits, or a nearby singularity.
  Blocked,     //!< Blocked by position limits or a singularity.
  Stale,       //!< The last velocity command is too old; the arm brakes and holds until the next one.
  NotFollowing //!< The joints did not follow their commands; the arm holds until vpRobot::STATE_STOP.
};

//! \ingroup group_simulation
//! \brief Parameters of vpSimulatedArm.
struct VISP_EXPORT vpSimulatedArmSpec {
  vpJointVector start;                    //!< Configuration at the start, rad or m; empty: vpArmModel::home().
  vpRedundancySpec redundancy;            //!< Redundancy resolution; its period (5 ms) is that of control.
  vpClosedLoopSpec closedLoop;            //!< Closed-loop kinematics for setPosition() of a pose.
  vpArmDriveSpec drives;                  //!< Drives: ideal or with torques, friction and noise.
  std::vector<vpSelfMotionIndex> indices; //!< Indices that self-motion maximizes, at most 8.
  //! Free (uncontrolled) components of the camera (or end-effector) twist; {5}: rotation about the optical axis.
  std::array<bool, 6> free{};
  //! Age beyond its sampling time (vpArmClock::RealTime: age) at which a command is too old, s, > 0; infinity: never.
  double watchdog = 0.2;
  /*!
   * Largest joint following error, rad or m, > 0; beyond it the arm stops. With vpDriveReference::Measured there is
   * none during velocity commands: a joint that cannot follow is reported by vpSimulatedArmState::saturated only.
   */
  double followingError = 0.3;
  vpArmClock clock = vpArmClock::Stepped; //!< Clock of the simulation.

  //! \throw vpException (badValue) naming the field that is out of range for this arm, and its value.
  void validate(const vpArmModel &model) const;
};

//! \ingroup group_simulation
//! \brief State of the arm at one time.
struct VISP_EXPORT vpSimulatedArmState {
  double time = 0.;           //!< Time since the start, s.
  vpJointVector q;            //!< Configuration, rad or m.
  vpJointVector velocity;     //!< Joint velocities, rad/s or m/s.
  vpJointVector wanted;       //!< Commanded configuration, rad or m.
  vpJointVector command;      //!< Commanded joint velocities, rad/s or m/s.
  vpJointVector torque;       //!< Torques of the drives, Nm or N; zero for ideal drives.
  vpJointVector needed;       //!< Torques that the commands take, see vpArmDrives::needed().
  unsigned int saturated = 0; //!< Bit i: the drive of joint i was at its torque limit in the last control period.
  vpJointShortfall lost;      //!< The joint of vpSimulatedArmStatus::NotFollowing, when it was found.
  vpRedundancyOutput solver;  //!< Solver output of the last control period.
  vpSimulatedArmStatus status = vpSimulatedArmStatus::Stopped; //!< Status of the arm.
};

/*!
 * \class vpSimulatedArm
 * \ingroup group_simulation
 * \brief Simulates any vpArmModel as a vpRobot with an eye-in-hand camera: programs for ViSP's robots run unchanged.
 *
 * Every 5 ms (vpRedundancySpec::period) the requested velocity is converted to joint velocities within all limits
 * (vpRedundancySolver; for joint velocities vpJointBounds), which the drives follow (vpArmDrives: ideal, or torques on
 * a plant with stiction). Norms of twists are limited as a whole to getMaxTranslationVelocity() and
 * getMaxRotationVelocity(), ViSP's 0.2 m/s and 0.7 rad/s unless set.
 *
 * Frames: vpRobot::JOINT_STATE (n joints), vpRobot::CAMERA_FRAME, vpRobot::END_EFFECTOR_FRAME (origin and axes of that
 * frame), vpRobot::REFERENCE_FRAME (origin of the end effector, axes of the base), vpRobot::MIXT_FRAME (origin of the
 * camera, translation along the axes of the base, rotation about those of the camera).
 *
 * \code
 * vpSimulatedArm robot(vpLoadArmJson("data/robot/amor.json"));
 * robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
 * robot.setVelocity(vpRobot::CAMERA_FRAME, vpTwist(0.1, 0., 0., 0., 0., 0.).toColVector()); // m/s; 40 ms pass
 * const vpHomogeneousMatrix fMc = robot.get_fMc();
 * std::cout << robot.getSentence() << "\n"; // moves, or what limits or blocks it
 * \endcode
 *
 * With vpArmClock::RealTime all functions may be called while the arm moves; the functions below are thread-safe. Those
 * of vpRobot that cannot be overridden have no lock: set the velocity limits before other threads command, and read the
 * sampling time and the frame from the thread that sets them.
 */
class VISP_EXPORT vpSimulatedArm : public vpRobotSimulator
{
public:
  /*!
   * \param model : The arm; copied.
   * \param spec : Drives, control and start; copied.
   * \throw vpException (badValue) naming the invalid joint, link or field: no velocity or acceleration limit, no mass
   * (unless the drives are ideal), a start outside the limits.
   */
  explicit vpSimulatedArm(const vpArmModel &model, const vpSimulatedArmSpec &spec = {});
  //! Stops the clock thread.
  ~vpSimulatedArm() VP_OVERRIDE;
  vpSimulatedArm(const vpSimulatedArm &) = delete;
  vpSimulatedArm &operator=(const vpSimulatedArm &) = delete;

  /*!
   * As on ViSP's robots: STATE_VELOCITY_CONTROL comes before setVelocity(). STATE_STOP brakes within the acceleration
   * limits (stepped: until at rest, 10 s at most; see getState()) and clears vpSimulatedArmStatus::NotFollowing.
   * \throw vpRobotException (wrongStateError) for unsupported states (acceleration, force).
   */
  vpRobot::vpRobotStateType setRobotState(const vpRobot::vpRobotStateType newState) VP_OVERRIDE;
  //! State of the control.
  [[nodiscard]] vpRobot::vpRobotStateType getRobotState() const VP_OVERRIDE;
  /*!
   * Sets how long a velocity command acts in vpArmClock::Stepped.
   * \param delta_t : s, > 0 and at most 1e6.
   * \throw vpException (badValue) with the value.
   */
  void setSamplingTime(const double &delta_t) VP_OVERRIDE;
  /*!
   * Moves with a velocity.
   * \param frame : See above. \param v : 6 rows (n for JOINT_STATE), m/s and rad/s.
   * \throw vpRobotException (wrongStateError) unless in STATE_VELOCITY_CONTROL; vpException (dimensionError) or
   * (badValue) naming a component that is not finite. The arm then continues as before.
   */
  void setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &v) VP_OVERRIDE;
  /*!
   * Moves to a position and returns when it is reached. Joints move together on minimum-jerk polynomials within the
   * limits (vpDirectTrajectory); poses are approached by vpClosedLoopKinematics.
   * \param frame : JOINT_STATE; END_EFFECTOR_FRAME, CAMERA_FRAME: pose of that frame in the base as (m, theta u);
   *   REFERENCE_FRAME: pose of the camera in the base as (m, Rxyz), as on ViSP's Viper robots.
   * \param q : n rows for JOINT_STATE, rad or m; else 6, m and rad.
   * \throw vpException (dimensionError), (badValue); vpRobotException (positionOutOfRangeError) naming the joint that
   * would leave its limits, (wrongStateError) for MIXT_FRAME and for poses of a camera that is not fixed to the end
   * effector, (lowLevelError) with a sentence if the arm cannot reach the pose, or if another thread interrupts with another position, a stop or another state.
   */
  void setPosition(const vpRobot::vpControlFrameType frame, const vpColVector &q) VP_OVERRIDE;
  using vpRobot::getPosition;
  //! Position from the encoders, in the representations of setPosition().
  void getPosition(const vpRobot::vpControlFrameType frame, vpColVector &q) VP_OVERRIDE;
  //! Velocity in the representations of setVelocity(), from the joint velocities.
  void getVelocity(const vpRobot::vpControlFrameType frame, vpColVector &v);
  /*!
   * Displacement since the previous call (first: since the start): joints; or CAMERA_FRAME, END_EFFECTOR_FRAME: current
   * pose of that frame in its previous one, (m, theta u); REFERENCE_FRAME: translation of the camera along the axes of
   * the base and theta u of the current fRc times the inverse of the previous one.
   * \throw vpRobotException (wrongStateError) for MIXT_FRAME.
   */
  void getDisplacement(const vpRobot::vpControlFrameType frame, vpColVector &q) VP_OVERRIDE;
  //! Jacobian of the end effector in its own frame, 6 x n.
  void get_eJe(vpMatrix &eJe) VP_OVERRIDE;
  //! Jacobian of the end effector along the axes of the base, 6 x n.
  void get_fJe(vpMatrix &fJe) VP_OVERRIDE;
  //! Pose of the end effector in the camera's frame. \throw vpRobotException (wrongStateError) if the camera is not
  //! fixed to the end effector (vpArmSpec::cameraLink).
  [[nodiscard]] vpHomogeneousMatrix get_cMe() const;
  //! Transforms twists of the end effector to the camera. \throw vpRobotException as get_cMe().
  [[nodiscard]] vpVelocityTwistMatrix get_cVe() const;
  //! True pose of the camera in the base.
  [[nodiscard]] vpHomogeneousMatrix get_fMc() const;
  //! True pose of the end effector in the base.
  [[nodiscard]] vpHomogeneousMatrix get_fMe() const;

  /*!
   * Sets the self-motion.
   * \param indices : At most 8, maximized together. \param free : See vpSimulatedArmSpec::free.
   * \throw vpException (badValue) naming the argument that does not fit the arm.
   */
  void setSelfMotion(const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free = {});
  /*!
   * Sets the fraction of the joint velocity limits that setPosition() uses, (0, 100], percent; ViSP's 15 unless set.
   * \throw vpException (badValue) with the value.
   */
  void setPositioningVelocity(double percent);
  /*!
   * Lets time pass without a command; stepped: at once, real time: waits.
   * \param duration : s, 0 to 1e6.
   * \throw vpException (badValue) with the value.
   */
  void wait(double duration);

  //! Current state of the arm.
  [[nodiscard]] vpSimulatedArmState getState() const;
  //! Status as a readable sentence.
  [[nodiscard]] std::string getSentence() const;
  //! Model of the arm.
  [[nodiscard]] const vpArmModel &getModel() const;

private:
  void init() VP_OVERRIDE {}

  class Impl;
  std::unique_ptr<Impl> m_impl;
};

//! \ingroup group_simulation
//! \brief Status as a word, for tables.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpSimulatedArmStatus status);

END_VISP_NAMESPACE
#endif
