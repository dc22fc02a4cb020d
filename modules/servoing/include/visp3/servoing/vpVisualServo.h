/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpVisualServo.h
 * \brief Visual servoing in two threads: images in one, robot commands within limits in the other.
 */
#ifndef vpVisualServo_h
#define vpVisualServo_h

#include <visp3/avoidance/vpStopSupervisor.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/manipulator/vpRedundancySolver.h>
#include <visp3/servoing/vpServoTiming.h>
#include <visp3/servoing/vpServoVision.h>

#include <array>
#include <limits>
#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_servoing
//! \brief Place of the camera.
enum class vpServoCameraPlace {
  EyeInHand, //!< On the end effector; the object stands in the base frame.
  EyeToHand  //!< Fixed in the base frame; the object is fixed to the end effector.
};

/*!
 * \ingroup group_servoing
 * \brief Parameters of a vpVisualServo besides those of its controller, whose vpServoControllerSpec::motion are the
 * limits of velocity, acceleration and jerk of what moves: the camera, or the end effector in front of a fixed camera.
 */
struct VISP_EXPORT vpVisualServoSpec {
  double period = 0.005;            //!< Period of step(), s, > 0, <= 1.
  double startTime = 1.;            //!< Time in which the limits of speed rise from 0 at each start, s, >= 0. A law
                                    //!< that plans accelerates so much less that it stays below them.
  double imageTimeout = 0.5;        //!< Oldest image that may be acted on, s, > 0. Without a newer one the robot stops.
  double stateTimeout = 0.1;        //!< Longest time without a robot state, s, > 0.
  double longestStep = 0.1;         //!< Longest time between two steps, s, > 0. Longer: the clock has jumped.
  double positionTolerance = 0.001; //!< Position error that counts as converged, m, > 0.
  double rotationTolerance = 0.005; //!< Rotation error that counts as converged, rad, > 0.
  double convergedTime = 0.5;       //!< Time within both tolerances after which the task is converged, s, >= 0.
  double followLength = 0.01; //!< Missing motion that counts as not following, m, > 0 or infinite. More than half of
                              //!< the motion commanded in the last second must be missing, too.
  double followAngle = 0.1;   //!< Missing rotation that counts as not following, rad, > 0 or infinite. Likewise.
  double objectChange = 0.01; //!< Change of a moving object's velocity in one second, m/s, > 0. Standard deviation.
  double objectTurnChange = 0.02; //!< Change of its angular velocity in one second, rad/s, > 0. Standard deviation.
  unsigned int maxPoints = 512;   //!< Largest number of points of a measurement, 1..100000. Memory is allocated once.

  vpServoCameraPlace place = vpServoCameraPlace::EyeInHand; //!< Place of the camera.
  vpRigidTransform fMc;                                     //!< Pose of a fixed camera in the base (EyeToHand), m.
  //! Without an arm's model: there is no robot state, and the commanded motion counts as executed. EyeInHand only.
  bool assumeExecuted = false;
  //! The object moves in the base frame with a velocity that changes little: it is estimated and followed. EyeInHand
  //! only.
  bool objectMoves = false;
  //! Axes of the commanded twist that stay 0, see vpFreeAxes(), for arms with fewer than six joints.
  std::array<bool, 6> free{};
  vpRedundancySpec redundancy; //!< Parameters of an arm; its period is replaced by #period.
  //! Indices that self-motion of an arm maximizes; at most vpMaxArmIndices. Self-motion keeps the joints' limits of
  //! position, velocity and acceleration; its jerk is not bounded, but vpVisualServoOutput::jointJerk reports it.
  std::vector<vpSelfMotionIndex> indices;

  //! The numbers with their ranges and units.
  [[nodiscard]] static const vpFields<vpVisualServoSpec> &fields();
  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \ingroup group_servoing
 * \brief State of the robot at a step.
 */
struct VISP_EXPORT vpServoRobotState {
  bool valid = true; //!< False: the robot reported nothing.
  vpJointVector q;   //!< Joint positions, rad or m, where the servo has an arm's model.
  //! Without a model: pose in the base, m, of the camera (EyeInHand) or of the end effector (EyeToHand).
  vpRigidTransform pose;
  double time = std::numeric_limits<double>::quiet_NaN(); //!< Time of this state, s; NaN: that of the step.
};

//! \ingroup group_servoing
//! \brief What a vpVisualServo does, or why it stops. The robot brakes within its limits in all but the first two.
enum class vpVisualServoStatus {
  Servoing,     //!< The law moves the robot, or recovers the target: vpVisualServoOutput::servo.
  Converged,    //!< Within the tolerances for vpVisualServoSpec::convergedTime; the law goes on.
  Idle,         //!< Before start() or after stop().
  LawStopped,   //!< The law gives no motion; vpVisualServoOutput::servo says why.
  Obstructed,   //!< The supervisor does not let the arm move on: vpVisualServoOutput::supervision.
  NoImages,     //!< No new image for vpVisualServoSpec::imageTimeout. Continues with the next image.
  FrozenImages, //!< The image does not change although the camera moves. Continues when it changes.
  ImageClock,   //!< Images are not newer than the last, or from the future. Continues with a correct time stamp.
  LateStep, //!< The clock advanced by more than vpVisualServoSpec::longestStep. Continues with an image taken after it.
  ClockFault,  //!< The clock went back, stood, or is not finite. Stays until start().
  StateFault,  //!< No valid robot state for vpVisualServoSpec::stateTimeout. Stays until start().
  NotFollowing //!< The robot does not move as commanded. Stays until start().
};
//! \ingroup group_servoing
//! \brief Status as a word ("Servoing"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpVisualServoStatus status);

/*!
 * \ingroup group_servoing
 * \brief Motion for the next period, and how it was obtained.
 */
struct VISP_EXPORT vpVisualServoOutput {
  vpVisualServoStatus status = vpVisualServoStatus::Idle; //!< What the servo does.
  const char *message = ""; //!< The most important of all statuses in a sentence, static text.
  //! Twist of the camera in the camera frame (EyeInHand), or of the end effector in its frame (EyeToHand), m/s, rad/s.
  vpTwist twist;
  vpJointVector velocity; //!< Joint velocities, rad/s or m/s; empty without an arm's model.
  //! Largest jerk of a joint, rad/s^3 or m/s^3: second difference of #velocity over the nominal period. It is measured,
  //! not bounded: self-motion may exceed what the limits of the twist ask for. 0 without an arm's model.
  double jointJerk = 0.;
  vpServoStatus servo = vpServoStatus::Holding;       //!< Status of law, view filter and recovery.
  vpRedundancyStatus arm = vpRedundancyStatus::Exact; //!< Status of the redundancy solver.
  vpSupervision supervision = vpSupervision::Passed;  //!< Status of the supervisor; Passed without one.
  vpClearance
      obstacle; //!< The pair in the way, see vpCollisionScene::describe(); None where #supervision is Passed or Limited.
  double age = std::numeric_limits<double>::infinity(); //!< Time since the capture of the image in use, s.
  //! Distance of the camera from its goal predicted to the present, m; NaN without a measurement.
  double positionError = std::numeric_limits<double>::quiet_NaN();
  double rotationError = std::numeric_limits<double>::quiet_NaN(); //!< Angle to the goal, rad; NaN likewise.
  double distance = 0.;                                            //!< See vpServoSight, m.
  double distanceSigma = 0.;                                       //!< See vpServoSight, m.
  double speedFactor = 1.; //!< Factor on the limits of speed: vpServoSight's and that of the start, 0..1.
  //! Velocity of the object's origin, and angular velocity, in the base frame, m/s and rad/s, as followed; 0 unless
  //! vpVisualServoSpec::objectMoves.
  vpTwist objectVelocity;
  double objectSigma = 0.;     //!< Standard deviation of the estimated linear velocity, m/s.
  double objectTurnSigma = 0.; //!< Standard deviation of the estimated angular velocity, rad/s.
};

/*!
 * \class vpVisualServo
 * \ingroup group_servoing
 * \brief Visual servoing of a camera or an arm: see() in the vision thread, step() in the control thread. Neither waits
 * for the other.
 *
 * step() takes the newest result of the vision thread, predicts it to the present by the robot's own motion since the capture
 * (vpOdometryBridge), steps the law with view filter and recovery, bounds velocity, acceleration and jerk
 * (vpLimitTwist, vpTwistShaper), and for an arm converts the twist to joint velocities (vpArmMotion), which a
 * vpStopSupervisor passes only if the arm can still stop.
 *
 * A fixed camera that looks at an object on the arm is the same problem: seen from the object it is the camera that
 * moves. Pose history, bridge and law use the camera's pose in the end effector; the law's twist v gives the end
 * effector the opposite one, -eVc v. A law that plans moves the end effector itself, to its goal eMc cdMo eMo^-1 with
 * eMo averaged over the images, in a straight line and turning the shortest way.
 *
 * Approach: a law may slow down faster than the bounds allow, v' = -lambda v. Where lambda v exceeds 0.7 of the bound
 * of acceleration, or lambda^2 v half of that of jerk, the twist is scaled to v = sqrt(2 a (d - d0)) of constant
 * deceleration, where d = v / lambda is the distance to the goal: it does not overshoot at any gain.
 *
 * Moving objects: a Kalman filter in the base frame estimates their velocity with its standard deviation. The estimate
 * is added to the law's twist while the law moves: not at all below two of its standard deviations, fully from four on.
 *
 * Threads: see() and setGoal() in one thread; step() and the accessors in another; start() and stop() in any.
 * Construction, setVision(), supervise() and setController() before both. step() does not allocate, throw, lock or
 * print.
 * \code
 * vpVisualServo servo(vpServoController::create("ff-lookat-pi"), {}, &arm); // without &arm: camera twists
 * servo.setVision(vpServoVision::photograph(photo, 0.16, 0.11, camera));
 * servo.setGoal(servo.vision().goal(cdMo));
 * std::thread vision([&]() {
 *   while (isRunning) {
 *     grabber.acquire(image);
 *     servo.see(image, now()); // better: the time stamp of the camera, on the clock of step()
 *   }
 * });
 * servo.start();
 * while (servo.step(encoders(), now()).status != vpVisualServoStatus::Converged) { // every spec.period
 *   send(servo.output().velocity);                                                  // rad/s, to the drives
 *   if (servo.output().status != vpVisualServoStatus::Servoing) {
 *     std::cerr << servo.output().message << std::endl; // why the robot brakes or stands
 *   }
 *   if (servo.output().status >= vpVisualServoStatus::ClockFault) {
 *     break; // stays so until start(): the robot must be stopped
 *   }
 * }
 * servo.stop();
 * isRunning = false;
 * vision.join();
 * \endcode
 */
class VISP_EXPORT vpVisualServo
{
public:
  /*!
   * \param controller : Law, view filter, recovery, limits of motion. \param spec : Parameters; copied.
   * \param arm : The arm, which must outlive this; null: the output is a twist.
   * \throw vpException (badValue) naming the field that is out of range, or a joint without motion limits.
   */
  explicit vpVisualServo(vpServoController controller, const vpVisualServoSpec &spec = {},
                         const vpArmModel *arm = nullptr);
  ~vpVisualServo();
  vpVisualServo(vpVisualServo &&) noexcept;            //!< Moves; no thread may use it meanwhile.
  vpVisualServo &operator=(vpVisualServo &&) noexcept; //!< Moves; no thread may use either meanwhile.

  //! Sets the vision. \throw vpException (badValue) if it is null.
  void setVision(std::unique_ptr<vpServoVision> vision);
  //! Enables collision avoidance in a scene, which must outlive this. \throw vpException as vpStopSupervisor, and where
  //! there is no arm.
  void supervise(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec = {});
  //! Replaces law, view filter, recovery and limits; the goal stays. \throw vpException (badValue) as the constructor.
  void setController(vpServoController controller);

  //! Sets or changes the goal, see vpServoVision::goal(). Vision thread.
  //! \throw vpException (badValue) as vpServoLaw::setGoal(); (dimensionError) if there are too many points.
  void setGoal(const vpServoGoal &goal);
  /*!
   * Processes one image. Vision thread.
   * \param image : The image. \param captureTime : Time of its capture, s, on the clock of step().
   * \return What was found, valid until the next call; not valid for an image that is not newer than the last.
   * \throw vpException of the vision; (dimensionError) if it gives too many points; (notInitialized) without
   *   setVision().
   */
  const vpServoSight &see(const vpImage<unsigned char> &image, double captureTime);
  //! The result of another vision system, instead of an image. Vision thread. \throw vpException if it has too many
  //! points.
  void see(const vpServoSight &sight);
  //! The vision. Vision thread. \throw vpException (notInitialized) without setVision().
  [[nodiscard]] vpServoVision &vision() const;
  /*!
   * Pose of the camera at a time, in the frame in which the object is at rest, see vpServoVision::see(). Vision thread.
   * \return False if it is not known: before the first step, too long ago, or more than two steps after the last one.
   */
  [[nodiscard]] bool cameraAt(double time, vpRigidTransform &pose) const noexcept;

  void start() noexcept; //!< Lets the robot move, from the next step on, and clears faults. Any thread.
  void stop() noexcept;  //!< Brakes within the limits from the next step on. Any thread.

  /*!
   * Executes one period. Control thread.
   * \param state : State of the robot. \param now : Current time, s; increasing.
   * \return The output, valid until the next step. The motion is safe to command with any input.
   */
  const vpVisualServoOutput &step(const vpServoRobotState &state, double now) noexcept;
  //! As step() with a state of these joint positions.
  const vpVisualServoOutput &step(const vpJointVector &q, double now) noexcept;
  //! The output of the last step. Control thread.
  [[nodiscard]] const vpVisualServoOutput &output() const noexcept;
  //! True if the error has been within the tolerances for the time of the spec. Control thread.
  [[nodiscard]] bool isConverged() const noexcept;
  //! The measurement predicted for the last step, the law's input. Control thread.
  [[nodiscard]] const vpServoMeasurement &measurement() const noexcept;
  //! Law, view filter and recovery. Control thread.
  [[nodiscard]] const vpServoController &controller() const noexcept;
  //! Measured periods, latencies and times. Any thread.
  [[nodiscard]] const vpServoTiming &timing() const noexcept;
  //! The parameters.
  [[nodiscard]] const vpVisualServoSpec &spec() const noexcept;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
