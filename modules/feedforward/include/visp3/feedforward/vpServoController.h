/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoController.h
 * \brief A servo law followed by the view filter and the recovery of a lost target.
 */
#ifndef vpServoController_h
#define vpServoController_h

#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/feedforward/vpServoMotionLimits.h>
#include <visp3/feedforward/vpTargetLossRecovery.h>
#include <visp3/feedforward/vpViewConstraintFilter.h>
#include <visp3/trajectory/vpTwistShaper.h>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_feedforward
//! \brief Parameters of all parts of a vpServoController.
struct VISP_EXPORT vpServoControllerSpec {
  vpServoGains gains;         //!< Gains of the law.
  vpServoMotionLimits motion; //!< Limits of laws that plan their motion; ignored by the others.
  vpViewConstraintSpec view;  //!< Parameters of the view filter; used by ids ending in `+cbf`.
  vpTargetLossSpec recovery;  //!< Parameters of the target loss recovery.

  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpServoController
 * \ingroup group_feedforward
 * \brief The servo pipeline: law, optional view filter, recovery. One per camera; one call per cycle.
 *
 * \code
 * vpServoControllerSpec spec;
 * spec.view = vpViewConstraintSpec::fromCamera(camera, 640, 480);
 * vpServoController servo = vpServoController::create("ff-lookat-pi+cbf", spec);
 * servo.setGoal(goal);
 * vpServoCommand command;
 * do {
 *   command = servo.step(measurement, dt); // measurement.valid = false when the target is not seen
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, command.v.toColVector());
 * } while (vpIsWorking(command.status) && !closeEnough(measurement));
 * if (!vpIsWorking(command.status)) {
 *   std::cerr << vpMessage(command.status) << std::endl;
 * }
 * robot.setRobotState(vpRobot::STATE_STOP);
 * \endcode
 */
class VISP_EXPORT vpServoController
{
public:
  /*!
   * Make a controller by name.
   * \param id : An id of vpServoLaw::ids(), optionally followed by `+cbf` for the view filter.
   * \param spec : Parameters; all of them are validated here.
   * \throw vpException (badValue) naming the unknown id and listing the known ones, or naming the bad field; for `+cbf` behind
   *   a law that plans, whose limits a filtered twist would leave.
   */
  [[nodiscard]] static vpServoController create(const std::string &id, const vpServoControllerSpec &spec = {});
  //! The ids of the laws; each that does not plan its motion can be followed by `+cbf`.
  [[nodiscard]] static std::vector<std::string> ids() { return vpServoLaw::ids(); }

  //! Set or change the goal; see vpServoLaw::setGoal().
  void setGoal(const vpServoGoal &goal) { m_law->setGoal(goal); }
  //! Forget the goal, the integrals, and the motion remembered for a retreat.
  void reset();

  //! The id of the controller, including `+cbf`.
  [[nodiscard]] const std::string &id() const { return m_id; }
  //! Current parameters.
  [[nodiscard]] const vpServoControllerSpec &spec() const { return m_spec; }
  //! Current gains.
  [[nodiscard]] const vpServoGains &gains() const { return m_spec.gains; }
  //! The servo law.
  [[nodiscard]] const vpServoLaw &law() const { return *m_law; }

  /*!
   * One cycle. Allocates nothing, takes no lock, throws nothing.
   * \param measurement : Current measurement; `valid = false` when the target was not found.
   * \param dt : Time since the last call and until the next one, s, > 0.
   * \return The twist to execute, safe in every case, and its status.
   */
  [[nodiscard]] vpServoCommand step(const vpServoMeasurement &measurement, double dt) noexcept;

  /*!
   * One cycle in which something else moves the robot, a supervisor that brakes, say: the law is not asked, but follows the
   * motion, and the next step() goes on from it. notifyExecuted() has to follow with what is commanded instead.
   * \param dt : Time since the last call and until the next one, s, > 0; otherwise nothing happens.
   */
  void pass(double dt) noexcept;

  //! Tells the law that its last twist was not executed as given: it was limited, say.
  void notifyInterrupted() noexcept { m_law->notifyInterrupted(); }
  //! Tells the law what came of its twist, see vpServoLaw::notifyExecuted(); only needed where it was not that of step().
  void notifyExecuted(const vpTwist &commanded, const vpTwist &moved) noexcept;
  //! The robot's own limits for laws that plan, see vpServoLaw::setMotionCheck(); referenced, nullptr: none.
  void setMotionCheck(vpServoMotionCheck *check) noexcept { m_law->setMotionCheck(check); }
  //! Speed limits of laws that plan, see vpServoLaw::setSpeedFactor().
  void setSpeedFactor(double factor) noexcept { m_law->setSpeedFactor(factor); }

  /*!
   * Orientation that a command aims at: where the camera would end if only the rotation continued, R
   * exp(w / rotationGain). For `pbvs1` this is the goal (the identity); with the term added by `ff-*` it is the
   * reference of figures 5.6 and 5.8 of the thesis.
   * \param measurement : The valid measurement of the command. \param command : Result of step().
   * \return Orientation in the desired camera frame. The identity without a goal or with a non-finite measurement.
   */
  [[nodiscard]] Eigen::Matrix3d referenceRotation(const vpServoMeasurement &measurement,
                                                  const vpServoCommand &command) const noexcept;

private:
  vpServoController(const std::string &id, std::unique_ptr<vpServoLaw> law, bool withFilter,
                    const vpServoControllerSpec &spec);

  vpServoCommand bounded(vpServoCommand command, double dt) noexcept;
  void remember(double dt) noexcept;

  std::string m_id;
  vpServoControllerSpec m_spec;
  std::unique_ptr<vpServoLaw> m_law;
  std::optional<vpViewConstraintFilter> m_filter;
  vpTargetLossRecovery m_recovery;
  std::optional<vpTwistShaper> m_shaper; // of laws that plan
  vpTwist m_sent, m_before;              // executed in the last cycle, and in the one before
  double m_period = 0.;                  // of the last cycle, s
  vpServoMeasurement m_unseen;           // not valid
};

END_VISP_NAMESPACE
#endif
