/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpArmServo.h
 * \brief Visual servoing of an arm: measurement, law, self-motion, limits and supervisor in one step.
 */
#ifndef vpArmServo_h
#define vpArmServo_h

#include <visp3/avoidance/vpStopSupervisor.h>
#include <visp3/feedforward/vpOdometryBridge.h>
#include <visp3/feedforward/vpServoController.h>
#include <visp3/manipulator/vpArmMotion.h>

#include <array>
#include <limits>
#include <optional>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_servoing
 * \brief Parameters of a vpArmServo besides those of its controller.
 */
struct VISP_EXPORT vpArmServoSpec {
  vpRedundancySpec redundancy;            //!< Parameters of the arm; its period is that of step().
  std::vector<vpSelfMotionIndex> indices; //!< Indices that self-motion maximizes; at most vpMaxArmIndices.
  //! Free axes of the camera, see vpFreeAxes(): not commanded, for arms with fewer than six joints.
  std::array<bool, 6> free{};
  double maxAge = 0.5;     //!< Measurements older than this are not used, s, > 0.
  double maxLinear = 0.25; //!< Limit of the camera's linear speed, m/s, > 0.
  double maxAngular = 1.;  //!< Limit of the camera's angular speed, rad/s, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate(const vpArmModel &model) const;
};

/*!
 * \ingroup group_servoing
 * \brief Velocities for the next period, and how they were obtained.
 */
struct VISP_EXPORT vpArmServoOutput {
  vpJointVector velocity; //!< Joint velocities to command, rad/s or m/s.
  vpTwist twist;          //!< Camera twist of the law, camera frame, m/s and rad/s; 0 in free axes.
  vpServoStatus servo = vpServoStatus::Holding;         //!< Status of law, view filter and recovery.
  vpRedundancyStatus arm = vpRedundancyStatus::Exact;   //!< Status of the redundancy solver.
  vpSupervision supervision = vpSupervision::Passed;    //!< Status of the supervisor; Passed without one.
  double age = std::numeric_limits<double>::infinity(); //!< Age of the measurement in use, s.
};

/*!
 * \class vpArmServo
 * \ingroup group_servoing
 * \brief Converts delayed, low-rate measurements of an eye-in-hand camera to joint velocities within limits, each
 * period.
 *
 * A measurement is valid at its time of exposure: the joint motion since then propagates it to the present
 * (vpOdometryBridge), so that the law sees no latency. The object must be at rest in the base frame. The law's twist is
 * limited and vpArmMotion converts it to joint velocities; with a scene, vpStopSupervisor passes them only if the arm
 * can still stop.
 * \code
 * vpArmServo servo(model, vpServoController::create("ff-lookat-pi"));
 * servo.setGoal(target.goal(cdMo));
 * while (...) { // every vpRedundancySpec::period
 *   if (camera.hasResult()) {
 *     target.measure(camera.result(), exposureTime, measurement);
 *     servo.see(measurement);
 *   }
 *   robot.command(servo.step(robot.q(), now).velocity);
 * }
 * \endcode
 * Call see() and step() from one thread; step() does not allocate, throw, lock or print.
 */
class VISP_EXPORT vpArmServo
{
public:
  /*!
   * \param model : The arm; referenced, must outlive this. \param controller : Law, view filter, recovery.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue) naming the field of \e spec that is out of range, or a joint without motion limits.
   */
  vpArmServo(const vpArmModel &model, vpServoController controller, const vpArmServoSpec &spec = {});

  //! Enables collision avoidance in a scene, which must outlive this. \throw vpException as vpStopSupervisor.
  void supervise(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec = {});
  //! Sets the goal, see vpServoTarget::goal().
  void setGoal(const vpServoGoal &goal) { m_controller.setGoal(goal); }
  /*!
   * Adds a result of the vision system, with its time of exposure on the clock of step().
   * \return False if rejected: from the future, or older than the stored motion.
   */
  bool see(const vpServoMeasurement &result) noexcept;
  /*!
   * One period.
   * \param q : Current configuration, rad or m. \param time : Current time, s; increasing. Not finite: the arm brakes.
   * \return The output, valid until the next step.
   */
  const vpArmServoOutput &step(const vpJointVector &q, double time) noexcept;
  //! Law, view filter and recovery.
  [[nodiscard]] const vpServoController &controller() const { return m_controller; }

private:
  [[nodiscard]] vpTwist executed(const vpRigidTransform &fMc, double time) const noexcept;

  const vpArmModel *m_model;
  vpArmServoSpec m_spec;
  vpServoController m_controller;
  vpArmMotion m_motion;
  vpOdometryBridge m_odometry;
  std::optional<vpStopSupervisor> m_supervisor;
  vpSupervisedVelocity m_supervised;
  vpServoMeasurement m_measurement; // predicted to now
  vpArmServoOutput m_output;
  vpArmData m_data;
  vpRigidTransform m_camera; // of the last step
  double m_time = 0.;        // of the last step
  bool m_started = false;
};

END_VISP_NAMESPACE
#endif
