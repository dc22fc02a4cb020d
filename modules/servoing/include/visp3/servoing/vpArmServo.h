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

#include <optional>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_servoing
 * \brief Parameters of a vpArmServo beside those of its controller.
 */
struct VISP_EXPORT vpArmServoSpec {
  vpRedundancySpec redundancy;            //!< Of the arm; its period is that of the steps.
  std::vector<vpSelfMotionIndex> indices; //!< What the spare joints climb; at most vpMaxArmIndices.
  double maxAge = 0.5;                    //!< A measurement older than this is not used any more, s, > 0.
  double maxLinear = 0.25;                //!< Of the camera, m/s, > 0.
  double maxAngular = 1.;                 //!< Of the camera, rad/s, > 0.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate(const vpArmModel &model) const;
};

/*!
 * \ingroup group_servoing
 * \brief What the arm does in the next period, and how it came about.
 */
struct VISP_EXPORT vpArmServoOutput {
  vpJointVector velocity;                               //!< To be commanded, rad/s or m/s.
  vpTwist twist;                                        //!< Of the camera as the law wants it, in its frame.
  vpServoStatus servo = vpServoStatus::Holding;         //!< Of the law, the view filter and the recovery.
  vpRedundancyStatus arm = vpRedundancyStatus::Exact;   //!< Whether the joints can do it.
  vpSupervision supervision = vpSupervision::Passed;    //!< Of the supervisor; Passed without one.
  double age = std::numeric_limits<double>::infinity(); //!< Of the measurement in use, s.
};

/*!
 * \class vpArmServo
 * \ingroup group_servoing
 * \brief From late and rare measurements of a camera in the hand to joint velocities within all limits, each period.
 *
 * A measurement counts at its time of exposure: the motion of the joints since then carries it to the present
 * (vpOdometryBridge), so that the law sees no latency. The object must stand still in the base. Then the law's twist is limited, and
 * vpArmMotion makes joint velocities of it; with a scene, vpStopSupervisor lets them pass only where the arm can still stop.
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
 * see() and step() are for one thread; step() does not allocate, throw, lock or print.
 */
class VISP_EXPORT vpArmServo
{
public:
  /*!
   * \param model : Is referred to. \param controller : Law, view filter, recovery.
   * \throw vpException (badValue) naming the field of \e spec that is out of range, or a joint without motion limits.
   */
  vpArmServo(const vpArmModel &model, vpServoController controller, const vpArmServoSpec &spec = {});

  //! From now on the arm keeps clear of a scene, which must outlive this. \throw vpException as vpStopSupervisor.
  void supervise(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec = {});
  //! Set or change the goal, see vpServoTarget::goal().
  void setGoal(const vpServoGoal &goal) { m_controller.setGoal(goal); }
  /*!
   * A result of the vision system, with its time of exposure on the clock of step().
   * \return False when it is not taken: from the future, or from before the remembered motion.
   */
  bool see(const vpServoMeasurement &result) noexcept;
  /*!
   * One period.
   * \param q : Configuration now, rad or m. \param time : Now, s; increases. What is not finite brakes the arm.
   * \return The answer, valid until the next step.
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
  vpServoMeasurement m_measurement; // as it would be seen now
  vpArmServoOutput m_output;
  vpArmData m_data;
  vpRigidTransform m_camera; // of the last step
  double m_time = 0.;        // of the last step
  bool m_started = false;
};

END_VISP_NAMESPACE
#endif
