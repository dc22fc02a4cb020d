/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpFrictionCamera.h
 * \brief Free-flying camera with the lag, friction and limits of a real robot.
 */
#ifndef vpFrictionCamera_h
#define vpFrictionCamera_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/robot/vpSimulatorCamera.h>
#include <visp3/simulation/vpServoPlant.h>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpFrictionCamera
 * \ingroup group_simulation
 * \brief vpSimulatorCamera with the imperfections of a vpServoPlant; any program for a ViSP robot runs on it.
 *
 * Each call of setVelocity() is one cycle of getSamplingTime() seconds:
 * -# limits: the twist is scaled as a whole until its linear and angular norms are within getMaxTranslationVelocity()
 *    and getMaxRotationVelocity() (vpSimulatorCamera limits single axes and prints);
 * -# lag: y' = (v - y) / lag, solved exactly over the cycle;
 * -# Coulomb friction on the rotation axes, modelled as lost velocity: w_out = sign(w) max(|w| - deadband, 0) per axis;
 * -# motion: wMc <- wMc exp(twist * cycle), exact for a constant twist (vpExponentialMap).
 *
 * \code
 * vpFrictionCamera robot(vpServoPlant::byName("B"));
 * robot.setRobotState(vpRobot::STATE_VELOCITY_CONTROL);
 * for (int i = 0; i < 100; ++i) { // 1 s
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, vpTwist(0.1, 0., 0., 0., 0., 0.3).toColVector()); // m/s, rad/s
 * }
 * std::cout << robot.getPosition() << "\nturns with " << robot.actualTwist()[5] << " rad/s" << std::endl; // 0.2
 * \endcode
 */
class VISP_EXPORT vpFrictionCamera : public vpSimulatorCamera
{
public:
  /*!
   * \param plant : Limits, lag, deadband, and the loop rate, whose inverse becomes the sampling time.
   * \throw vpException (badValue) naming a field of the plant that is out of range.
   */
  explicit vpFrictionCamera(const vpServoPlant &plant = vpServoPlant());

  /*!
   * Moves for one sampling time.
   * \param frame : vpRobot::CAMERA_FRAME or vpRobot::ARTICULAR_FRAME, which are the same here.
   * \param v : Commanded twist, camera frame, 6 rows, m/s and rad/s.
   * \throw vpRobotException (wrongStateError) for another frame; vpException (dimensionError) unless there are 6 rows,
   * (badValue) naming a component that is not finite. The camera has not moved then.
   */
  void setVelocity(const vpRobot::vpControlFrameType frame, const vpColVector &v) VP_OVERRIDE;
  //! As in ViSP. vpRobot::STATE_STOP brings the camera to rest at once.
  vpRobot::vpRobotStateType setRobotState(const vpRobot::vpRobotStateType newState) VP_OVERRIDE;

  //! Actual camera twist in the last cycle, camera frame, as measured by joint encoders (odometry), m/s and rad/s.
  [[nodiscard]] const vpTwist &actualTwist() const { return m_actual; }

private:
  double m_lag;
  double m_deadband;
  vpTwist m_response; // state of the lag, before friction
  vpTwist m_actual;
};

END_VISP_NAMESPACE
#endif
