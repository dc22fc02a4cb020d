/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpOdometryBridge.h
 * \brief From the last vision result, which is late and rare, to where the object is now.
 */
#ifndef vpOdometryBridge_h
#define vpOdometryBridge_h

#include <visp3/direct_core/vpTwist.h>
#include <visp3/feedforward/vpServoMeasurement.h>

#include <deque>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpOdometryBridge
 * \ingroup group_simulation
 * \brief Carries a measurement over latency and between frames by the robot's own motion since its capture.
 *
 * The twists that the robot executed are integrated to cMn, the pose of the camera now in the camera at capture; then
 * the object is at cMn^-1 cMo, and each point, placed in space by its depth, is projected anew. The object itself must
 * stand still in the world.
 */
class VISP_EXPORT vpOdometryBridge
{
public:
  //! Starts at rest at time 0 s.
  vpOdometryBridge();

  //! The camera moved with \e twist (its own frame) from the time of the call before until \e time, s.
  void move(const vpTwist &twist, double time);
  /*!
   * A result arrived; it replaces the one before. Its vpServoMeasurement::time says when it was captured.
   * \throw vpException (badValue) if it was captured later than now.
   */
  void correct(const vpServoMeasurement &result);
  /*!
   * The last result as it would be seen now.
   * \param now : Valid if the last result was and the object is still in front of the camera. A point that was not
   *   seen then, or is behind the camera now, is not visible. The time of capture is kept.
   */
  void predict(vpServoMeasurement &now) const;

private:
  struct Instant {
    double time;
    vpHomogeneousMatrix pose; // of the camera in the frame of the odometry
  };
  std::deque<Instant> m_path; // from the capture of the last result to now
  vpServoMeasurement m_last;
};

END_VISP_NAMESPACE
#endif
