/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoController.h
 * \brief A servo law with the view filter behind it and the recovery of a lost target behind that.
 */
#ifndef vpServoController_h
#define vpServoController_h

#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/feedforward/vpTargetLossRecovery.h>
#include <visp3/feedforward/vpViewConstraintFilter.h>

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_feedforward
//! \brief Parameters of all parts of a vpServoController.
struct VISP_EXPORT vpServoControllerConfig {
  vpServoGains gains;          //!< Of the law.
  vpViewConstraintConfig view; //!< Of the view filter; used by the ids that end in `+cbf`.
  vpTargetLossConfig recovery; //!< Of the recovery of a lost target.

  //! \throw vpException (badValue) naming the field and its value when one is out of its range or not finite.
  void validate() const;
};

/*!
 * \class vpServoController
 * \ingroup group_feedforward
 * \brief The servo pipeline: law, optional view filter, recovery. One per camera; one call a cycle.
 *
 * \code
 * vpServoControllerConfig config;
 * config.view = vpViewConstraintConfig::fromCamera(camera, 640, 480);
 * vpServoController servo = vpServoController::create("ff-lookat-pi+cbf", config);
 * servo.setGoal(goal);
 * vpServoCommand command;
 * do {
 *   command = servo.update(measurement, dt); // measurement.valid = false when the target is not seen
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, command.v.toColVector());
 * } while (isWorking(command.status) && !closeEnough(measurement));
 * \endcode
 */
class VISP_EXPORT vpServoController
{
public:
  /*!
   * Make a controller by name.
   * \param id : An id of vpServoLaw::ids(), optionally followed by `+cbf` for the view filter.
   * \param config : Parameters; all of them are validated here.
   * \throw vpException (badValue) naming the unknown id and listing the known ones, or naming the bad field.
   */
  [[nodiscard]] static vpServoController create(const std::string &id, const vpServoControllerConfig &config = {});
  //! The ids of the laws; each can be followed by `+cbf`.
  [[nodiscard]] static const std::vector<std::string> &ids() { return vpServoLaw::ids(); }

  //! Set or change the goal; see vpServoLaw::setGoal().
  void setGoal(const vpServoGoal &goal) { m_law->setGoal(goal); }
  //! Forget the goal, the integrals, and the motion remembered for a retreat.
  void reset();

  //! The id the controller was made from, `+cbf` included.
  [[nodiscard]] const std::string &id() const { return m_id; }
  //! The parameters in force.
  [[nodiscard]] const vpServoControllerConfig &config() const { return m_config; }
  //! The gains in force.
  [[nodiscard]] const vpServoGains &gains() const { return m_config.gains; }
  //! The law in front.
  [[nodiscard]] const vpServoLaw &law() const { return *m_law; }

  /*!
   * One cycle. Allocates nothing, takes no lock, throws nothing.
   * \param measurement : What was seen; `valid = false` when the target was not found.
   * \param dt : Time since the last call and until the next one, s, > 0.
   * \return The twist to execute, safe in every case, and how it came about.
   */
  [[nodiscard]] vpServoCommand update(const vpServoMeasurement &measurement, double dt) noexcept;

  /*!
   * The orientation that a command aims at: where the camera would end if the rotation went on alone,
   * R exp(w / rotationGain). For `pbvs1` this is the goal (the identity); what `ff-*` adds to it is the reference of
   * the figures 5.6 and 5.8 of the thesis.
   * \param measurement : The valid measurement that the command answers. \param command : Answer of update().
   * \return Orientation in the desired camera frame. The identity when no goal is set, or the measurement is not finite.
   */
  [[nodiscard]] Eigen::Matrix3d referenceRotation(const vpServoMeasurement &measurement,
                                                  const vpServoCommand &command) const noexcept;

private:
  vpServoController(const std::string &id, std::unique_ptr<vpServoLaw> law, bool withFilter,
                    const vpServoControllerConfig &config);

  std::string m_id;
  vpServoControllerConfig m_config;
  std::unique_ptr<vpServoLaw> m_law;
  std::optional<vpViewConstraintFilter> m_filter;
  vpTargetLossRecovery m_recovery;
};

END_VISP_NAMESPACE
#endif
