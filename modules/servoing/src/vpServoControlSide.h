/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpServoControlSide.h
 * \brief The part of a vpVisualServo that the control thread uses.
 */
#ifndef vpServoControlSide_h
#define vpServoControlSide_h

#include "vpFollowWatchdog.h"
#include "vpServoExchange.h"
#include "vpToolView.h"

#include <visp3/feedforward/vpOdometryBridge.h>
#include <visp3/manipulator/vpArmMotion.h>
#include <visp3/servoing/vpArmMotionCheck.h>
#include <visp3/trajectory/vpTwistShaper.h>

#include <optional>

BEGIN_VISP_NAMESPACE

//! One cycle after the other: clock and state, measurement, law, limits, arm, supervisor.
class vpServoControlSide
{
public:
  enum Request { None, Start, Stop };

  vpServoControlSide(vpServoController controller, const vpVisualServoSpec &spec, const vpArmModel *arm);

  void supervise(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec);
  void setController(vpServoController controller);
  const vpVisualServoOutput &step(const vpServoRobotState &state, double now, vpServoExchange &exchange) noexcept;

  const vpVisualServoSpec &spec() const noexcept { return m_spec; }
  const vpVisualServoOutput &output() const noexcept { return m_output; }
  const vpServoMeasurement &measurement() const noexcept { return m_measurement; }
  const vpServoController &controller() const noexcept { return m_controller; }

private:
  bool isInHand() const noexcept { return m_spec.place == vpServoCameraPlace::EyeInHand; }
  void follow(Request request, vpServoExchange &exchange) noexcept;
  bool checkClock(double now, vpServoExchange &exchange) noexcept;
  bool readPose(const vpServoRobotState &state, vpRigidTransform &camera) noexcept;
  bool updatePose(const vpServoRobotState &state, bool isClockRight, vpServoExchange &exchange) noexcept;
  void fail(vpVisualServoStatus fault) noexcept;
  void watchMotion(const vpTwist &observed, bool isComplete) noexcept;
  vpTwist expectedMotion() const noexcept;
  vpTwist objectInCamera() const noexcept;
  void setGoal(const vpServoGoal &goal) noexcept;
  void followObject(const vpObjectMotion &object) noexcept;
  void takeSight(vpServoExchange &exchange) noexcept;
  vpVisualServoStatus judgeImages(const vpServoExchange &exchange) const noexcept;
  void judgeError() noexcept;
  vpTwist lawTwist() noexcept;
  vpTwist planned(const vpTwist &wish) noexcept;
  vpTwist bounded(const vpTwist &wish, const vpTwist &along) noexcept;
  vpTwist braked() noexcept;
  void report() noexcept;
  double approachShare(const vpTwist &wish) const noexcept;
  void moveArm(bool isAllowed) noexcept;
  void measureJointJerk() noexcept;
  void conclude(vpVisualServoStatus images) noexcept;
  const char *message() const noexcept;

  vpVisualServoSpec m_spec;
  vpServoController m_controller;
  const vpArmModel *m_arm;
  std::optional<vpArmMotion> m_motion;
  std::optional<vpStopSupervisor> m_supervisor;
  vpOdometryBridge m_odometry;
  vpTwistShaper m_shaper;
  vpVisualServoOutput m_output;
  vpSupervisedVelocity m_supervised;
  vpServoMeasurement m_measurement; // predicted to now
  vpArmData m_data;
  vpJointVector m_q;
  vpJointVector m_jointRate, m_lastVelocity; // acceleration and velocity of the joints in the last cycle
  std::optional<vpArmMotionCheck> m_check;   // for laws that plan
  std::optional<vpToolView> m_tool;          // for laws that plan, before a fixed camera
  vpTwist m_ofLaw;                           // twist of the law in this step
  vpTwist m_executed;                        // motion of the camera relative to the object since the last step
  vpFollowWatchdog m_watchdog;
  vpObjectMotion m_object;
  vpRigidTransform m_camera; // in the frame in which the object is at rest
  vpServoGoal m_goal;
  const std::vector<vpSelfMotionIndex> m_noIndices;
  vpVisualServoStatus m_fault = vpVisualServoStatus::Servoing;   // Servoing: none
  double m_time = 0.;                                            // of this step
  double m_step = 0.;                                            // time since the last one, s
  double m_poseTime = 0.;                                        // of the last pose
  double m_rising = 0.;                                          // time since the last start, s
  double m_imageTime = 0.;                                       // capture of the newest image in use
  double m_notBefore = -std::numeric_limits<double>::infinity(); // images captured earlier are not acted on
  double m_within = 0.;                                          // time within the tolerances, s
  double m_sightFactor = 1.;
  double m_startFactor = 1.;    // on the speeds of plans, see m_rising
  unsigned int m_badStamps = 0; // when the newest image came
  bool m_hasClock = false, m_hasPose = false, m_hasGoal = false, m_isRunning = false;
  bool m_plans = false; // the law keeps the bounds itself
  bool m_hasImage = false, m_isFrozen = false, m_isFuture = false;
};

END_VISP_NAMESPACE
#endif
