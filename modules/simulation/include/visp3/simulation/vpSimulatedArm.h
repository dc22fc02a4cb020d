/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpSimulatedArm.h
 * \brief A robot of ViSP that is a simulated arm with a camera in its hand.
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
//! \brief What makes the arm's time pass.
enum class vpArmClock {
  Stepped, //!< Each setVelocity() lets getSamplingTime() pass, setPosition() as long as it takes: fast and repeatable.
  RealTime //!< The clock on the wall, in a thread of its own: for programs that wait between commands.
};

//! \ingroup group_simulation
//! \brief How the arm is doing.
enum class vpSimulatedArmStatus {
  Stopped,     //!< At rest, nothing is asked of it.
  Moving,      //!< Does what it was asked to.
  Limited,     //!< Does less: velocity or acceleration limits, or a singularity near by.
  Blocked,     //!< Cannot go on: position limits or a singularity are in the way.
  Stale,       //!< The last velocity is too old; it brakes and holds until the next one.
  NotFollowing //!< The joints did not follow their commands; it holds until it is stopped (vpRobot::STATE_STOP).
};

//! \ingroup group_simulation
//! \brief Parameters of vpSimulatedArm.
struct VISP_EXPORT vpSimulatedArmSpec {
  vpJointVector start;                    //!< Configuration at the start, rad or m; empty: vpArmModel::home().
  vpRedundancySpec redundancy;            //!< From twist to joints; its period (5 ms) is that of the arm's control.
  vpClosedLoopSpec closedLoop;            //!< For setPosition() in space.
  vpArmDriveSpec drives;                  //!< Ideal or with torques, friction and noise.
  std::vector<vpSelfMotionIndex> indices; //!< What the spare joints climb, at most 8.
  //! Components of the camera's (or end effector's) twist that do not matter; {5} is the turn about the optical axis.
  std::array<bool, 6> free{};
  //! Age beyond its sampling time (vpArmClock::RealTime: age) at which a velocity is too old, s, > 0; infinity: never.
  double watchdog = 0.2;
  double followingError =
      0.3; //!< Largest difference of wanted and measured joint, rad or m, > 0; beyond it the arm stops.
  vpArmClock clock = vpArmClock::Stepped; //!< What makes its time pass.

  //! \throw vpException (badValue) naming the field that is out of range for this arm, and its value.
  void validate(const vpArmModel &model) const;
};

//! \ingroup group_simulation
//! \brief The arm at one time.
struct VISP_EXPORT vpSimulatedArmState {
  double time = 0.;                                            //!< Since the start, s.
  vpJointVector q;                                             //!< Configuration, rad or m.
  vpJointVector velocity;                                      //!< Joint velocities, rad/s or m/s.
  vpJointVector wanted;                                        //!< Commanded configuration, rad or m.
  vpJointVector command;                                       //!< Commanded joint velocities, rad/s or m/s.
  vpJointVector torque;                                        //!< Of the drives, Nm or N; zero for ideal ones.
  vpRedundancyOutput solver;                                   //!< Of the last control period.
  vpSimulatedArmStatus status = vpSimulatedArmStatus::Stopped; //!< How it is doing.
};

/*!
 * \class vpSimulatedArm
 * \ingroup group_simulation
 * \brief Any arm of vpArmModel as a vpRobot with the camera in its hand: programs for ViSP's robots run on it unchanged.
 *
 * Every 5 ms (vpRedundancySpec::period) the velocity asked for becomes joint velocities within all limits
 * (vpRedundancySolver, joints that are asked for directly: vpJointBounds), which the drives follow (vpArmDrives: ideal,
 * or torques on a plant with friction that sticks). Norms of twists are limited as a whole to
 * getMaxTranslationVelocity() and getMaxRotationVelocity(), ViSP's 0.2 m/s and 0.7 rad/s unless set.
 *
 * Frames: vpRobot::JOINT_STATE (n joints), vpRobot::CAMERA_FRAME, vpRobot::END_EFFECTOR_FRAME (origin and axes of that
 * frame), vpRobot::REFERENCE_FRAME (origin of the end effector, axes of the base), vpRobot::MIXT_FRAME (origin of the
 * camera, translation along the axes of the base, rotation about those of the camera).
 *
 * \code
 * vpSimulatedArm robot(vpLoadArmJson("data/robot/amor.json"));
 * robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
 * robot.setVelocity(vpRobot::CAMERA_FRAME, v);     // 40 ms pass (getSamplingTime())
 * vpHomogeneousMatrix fMc = robot.get_fMc();
 * \endcode
 *
 * With vpArmClock::RealTime all functions may be called while the arm moves; calls of the functions below from several
 * threads are safe. Those of vpRobot that cannot be overridden have no lock: set the largest velocities before other threads
 * command, and read the sampling time and the frame from the thread that sets them.
 */
class VISP_EXPORT vpSimulatedArm : public vpRobotSimulator
{
public:
  /*!
   * \param model : The arm; copied.
   * \param spec : Drives, control and start; copied.
   * \throw vpException (badValue) naming the joint, link or field that does not do: no velocity or acceleration limit,
   * no mass (unless the drives are ideal), a start outside the limits.
   */
  explicit vpSimulatedArm(const vpArmModel &model, const vpSimulatedArmSpec &spec = {});
  //! Ends the clock's thread.
  ~vpSimulatedArm() VP_OVERRIDE;
  vpSimulatedArm(const vpSimulatedArm &) = delete;
  vpSimulatedArm &operator=(const vpSimulatedArm &) = delete;

  /*!
   * As on ViSP's robots: STATE_VELOCITY_CONTROL comes before setVelocity(). STATE_STOP brakes within the acceleration
   * limits (stepped: until it stands) and forgives vpSimulatedArmStatus::NotFollowing.
   * \throw vpRobotException (wrongStateError) for states that the arm does not know (acceleration, force).
   */
  vpRobot::vpRobotStateType setRobotState(const vpRobot::vpRobotStateType newState) VP_OVERRIDE;
  //! State of the control.
  [[nodiscard]] vpRobot::vpRobotStateType getRobotState() const VP_OVERRIDE;
  /*!
   * How long a velocity acts in vpArmClock::Stepped.
   * \param delta_t : s, > 0 and at most 1e6.
   * \throw vpException (badValue) with the value.
   */
  void setSamplingTime(const double &delta_t) VP_OVERRIDE;
  /*!
   * Move with a velocity.
   * \param frame : See above. \param v : 6 rows (n for JOINT_STATE), m/s and rad/s.
   * \throw vpRobotException (wrongStateError) unless in STATE_VELOCITY_CONTROL; vpException (dimensionError) or
   * (badValue) naming a component that is not finite. The arm goes on as before then.
   */
  void setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &v) VP_OVERRIDE;
  /*!
   * Go there and come back when the arm is there. Joints move together on minimum-jerk polynomials within the limits
   * (vpDirectTrajectory); poses are approached by vpClosedLoopKinematics.
   * \param frame : JOINT_STATE; END_EFFECTOR_FRAME, CAMERA_FRAME: pose of that frame in the base as (m, theta u);
   *   REFERENCE_FRAME: pose of the camera in the base as (m, Rxyz), as on ViSP's Viper robots.
   * \param q : n rows for JOINT_STATE, rad or m; else 6, m and rad.
   * \throw vpException (dimensionError), (badValue); vpRobotException (positionOutOfRangeError) naming the joint that
   * would leave its limits, (wrongStateError) for MIXT_FRAME, (lowLevelError) with a sentence when the arm cannot reach
   * the pose, or when another thread gives it another position, a stop or another state: it does not wait any longer then.
   */
  void setPosition(const vpRobot::vpControlFrameType frame, const vpColVector &q) VP_OVERRIDE;
  using vpRobot::getPosition;
  //! Where it is by its encoders, in the forms of setPosition().
  void getPosition(const vpRobot::vpControlFrameType frame, vpColVector &q) VP_OVERRIDE;
  //! Velocity in the forms of setVelocity(), from the joint velocities.
  void getVelocity(const vpRobot::vpControlFrameType frame, vpColVector &v);
  /*!
   * Change since the call before (at first: since the start): joints; or CAMERA_FRAME, END_EFFECTOR_FRAME: pose of that
   * frame now in that frame then, (m, theta u); REFERENCE_FRAME: translation of the camera along the axes of the base
   * and theta u of fRc now times its inverse then.
   * \throw vpRobotException (wrongStateError) for MIXT_FRAME.
   */
  void getDisplacement(const vpRobot::vpControlFrameType frame, vpColVector &q) VP_OVERRIDE;
  //! Jacobian of the end effector in its own frame, 6 x n.
  void get_eJe(vpMatrix &eJe) VP_OVERRIDE;
  //! Jacobian of the end effector along the axes of the base, 6 x n.
  void get_fJe(vpMatrix &fJe) VP_OVERRIDE;
  //! Pose of the end effector in the camera's frame.
  [[nodiscard]] vpHomogeneousMatrix get_cMe() const;
  //! Twists of the end effector to those of the camera.
  [[nodiscard]] vpVelocityTwistMatrix get_cVe() const;
  //! True pose of the camera in the base.
  [[nodiscard]] vpHomogeneousMatrix get_fMc() const;
  //! True pose of the end effector in the base.
  [[nodiscard]] vpHomogeneousMatrix get_fMe() const;

  /*!
   * What the spare joints do from now on.
   * \param indices : At most 8, climbed together. \param free : See vpSimulatedArmSpec::free.
   * \throw vpException (badValue) naming what does not fit the arm.
   */
  void setSelfMotion(const std::vector<vpSelfMotionIndex> &indices, const std::array<bool, 6> &free = {});
  /*!
   * Part of the joints' velocity limits that setPosition() uses, (0, 100], percent; ViSP's 15 unless set.
   * \throw vpException (badValue) with the value.
   */
  void setPositioningVelocity(double percent);
  /*!
   * Let time pass without a command; stepped: at once, real time: waits.
   * \param duration : s, 0 to 1e6.
   * \throw vpException (badValue) with the value.
   */
  void wait(double duration);

  //! The arm now.
  [[nodiscard]] vpSimulatedArmState getState() const;
  //! How it is doing, as a sentence for a person.
  [[nodiscard]] std::string getSentence() const;
  //! The arm's model.
  [[nodiscard]] const vpArmModel &getModel() const;

private:
  void init() VP_OVERRIDE {}

  class Impl;
  std::unique_ptr<Impl> m_impl;
};

//! \ingroup group_simulation
//! \brief The status in a word, for tables.
[[nodiscard]] VISP_EXPORT const char *toString(vpSimulatedArmStatus status);

END_VISP_NAMESPACE
#endif
