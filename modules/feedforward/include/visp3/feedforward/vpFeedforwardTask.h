/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFeedforwardTask.h
 * \brief The laws ff-sum and ff-lookat as a task of ViSP.
 */
#ifndef vpFeedforwardTask_h
#define vpFeedforwardTask_h

#include <visp3/feedforward/vpFeatureFeedforwardSum.h>
#include <visp3/feedforward/vpFeatureLookAt.h>
#include <visp3/feedforward/vpServoLaw.h>
#include <visp3/feedforward/vpServoMeasurement.h>
#include <visp3/visual_features/vpFeatureTranslation.h>
#include <visp3/vs/vpServo.h>

#include <string>
#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpFeedforwardTask
 * \ingroup group_feedforward
 * \brief A vpServo whose features are those of an FF-PBVS law: it commands the velocity of the law.
 *
 * \code
 * vpFeedforwardTask task("ff-lookat");
 * task.setGoal(goal);
 * while (measurement.valid && !closeEnough(measurement)) { // with an invalid one computeControlLaw() throws
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, task.computeControlLaw(measurement));
 * }
 * robot.setRobotState(vpRobot::STATE_STOP);
 * \endcode
 *
 * With an arm, vpServo turns the twist into joint velocities:
 * \code
 * vpFeedforwardTask task("ff-lookat", vpServoGains(), vpServo::EYEINHAND_L_cVe_eJe);
 * task.set_cVe(vpHomogeneousMatrix(0., 0., 0.1, 0., 0., 0.).inverse()); // cMe, m
 * task.setGoal(goal);
 * // each cycle:
 * task.set_eJe(eJe);
 * robot.setVelocity(vpRobot::JOINT_STATE, task.computeControlLaw(measurement)); // rad/s
 * \endcode
 *
 * For a camera that watches the object in the hand, the types EYETOHAND_*: the object then moves against the law's twist.
 * vpServo has all the rest: adaptive gains by setLambda(), secondary tasks, more features by addFeature(). With an adaptive
 * gain, its value at |L^+ e|, the largest component of the velocity for gain 1, is the lambda of the law. vpServoController
 * is the same law in a step that neither allocates nor throws, with view filter and recovery.
 */
class VISP_EXPORT vpFeedforwardTask : public vpServo
{
public:
  /*!
   * \param law : One of laws().
   * \param gains : Gains of the law.
   * \param type : As in vpServo::setServo(), which may be called later, too; not vpServo::NONE.
   * \throw vpException (badValue) naming the law without features and listing laws(), the bad gain, or the type.
   */
  explicit vpFeedforwardTask(const std::string &law, const vpServoGains &gains = {},
                             vpServoType type = vpServo::EYEINHAND_CAMERA);
  ~vpFeedforwardTask() VP_OVERRIDE;
  vpFeedforwardTask(const vpFeedforwardTask &) = delete;
  vpFeedforwardTask &operator=(const vpFeedforwardTask &) = delete;

  //! Ids of the laws that have features: `ff-sum` and `ff-lookat`.
  [[nodiscard]] static const std::vector<std::string> &laws();

  //! Set or change the goal, also every cycle. \throw vpException (badValue), see vpServoLaw::setGoal().
  void setGoal(const vpServoGoal &goal);
  /*!
   * Hands over the measurement of this cycle to the features.
   * \throw vpException (notInitialized) without a goal; (badValue) when the target was not found, or the measurement is one
   * that the law does not accept. The features are unchanged then: stop the robot.
   */
  void see(const vpServoMeasurement &measurement);
  //! see(), then vpServo::computeControlLaw(): camera twist, m/s and rad/s, or joint velocities, see vpServo.
  [[nodiscard]] vpColVector computeControlLaw(const vpServoMeasurement &measurement);
  using vpServo::computeControlLaw;

private:
  bool m_isLookAt;
  vpFeatureTranslation m_position;
  vpFeatureFeedforwardSum m_sum;
  vpFeatureLookAt m_gaze;
  vpServoGoal m_goal; // no points: not set
};

END_VISP_NAMESPACE
#endif
