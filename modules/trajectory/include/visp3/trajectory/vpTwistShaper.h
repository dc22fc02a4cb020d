/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTwistShaper.h
 * \brief Makes any commanded twist start from the current one, with bounded acceleration and jerk.
 */
#ifndef vpTwistShaper_h
#define vpTwistShaper_h

#include <visp3/direct_core/vpField.h>
#include <visp3/direct_core/vpTwist.h>

BEGIN_VISP_NAMESPACE

//! \ingroup group_trajectory
//! \brief Limits of vpTwistShaper, for the linear and the angular part.
struct VISP_EXPORT vpTwistShaperLimits {
  double linearAcceleration = 1.;  //!< Limit of the linear acceleration, m/s^2, 1e-06..1e+09.
  double linearJerk = 10.;         //!< Limit of the linear jerk, m/s^3, 1e-06..1e+12 or infinite.
  double angularAcceleration = 1.; //!< Limit of the angular acceleration, rad/s^2, 1e-06..1e+09.
  double angularJerk = 10.;        //!< Limit of the angular jerk, rad/s^3, 1e-06..1e+12 or infinite.
  /*!
   * True: the limits bound the Euclidean norm of the linear and of the angular part, and a change from rest keeps its
   * direction. False: they bound each of the six components.
   */
  bool norm = true;

  //! The limits with their ranges and units.
  [[nodiscard]] static const vpFields<vpTwistShaperLimits> &fields();
  //! \throw vpException (badValue) naming the limit and its value when one is out of its range.
  void validate() const;
};

/*!
 * \class vpTwistShaper
 * \ingroup group_trajectory
 * \brief Filter for the output of any vpServo or servo law: bounds the acceleration (and jerk) of a raw twist.
 *
 * Classical visual servoing commands v = -lambda L^+ e, whose first value is a step: infinite acceleration at t = 0
 * (thesis, 6.1.1, figure 6.1). The shaper follows the raw twist along the time-optimal ramps of vpVelocityRamp,
 * replanned each cycle from its own commanded twist and acceleration. A constant input is reached exactly, in finite
 * time.
 *
 * **Speed.** The output is never faster than the fastest input so far (norms of the linear and of the angular part
 * separately; the twist given to reset() counts as an input), however the input turns: inputs limited by vpLimitTwist()
 * give outputs within its limits. Ramps per component alone do not guarantee that: combined, they overshoot when the
 * input turns. Proof: from velocity v and acceleration a, braking with the full jerk J against a leads straight to
 * p = v + a |a| / (2 J). While |v| and |p| are at most V, a ball being convex, braking never leaves the ball of radius
 * V, and neither v nor p of the next cycle does. Where the ramps would leave V = max(|input|, |v|, |p|), the cycle
 * mixes ramps and braking, with as much of the ramps as V allows; velocity, acceleration and jerk of a mixture are
 * within the bounds of its parts.
 *
 * \code
 * vpServo task; // with its features, see ViSP
 * vpTwistShaper shaper({1., 10., 2., 20.}); // linear m/s^2, m/s^3; angular rad/s^2, rad/s^3
 * do {
 *   const vpTwist v = shaper.step(vpTwist::fromColVector(task.computeControlLaw()), dt);
 *   robot.setVelocity(vpRobot::CAMERA_FRAME, v.toColVector());
 * } while (task.getError().sumSquare() > 1e-6);
 * \endcode
 */
class VISP_EXPORT vpTwistShaper
{
public:
  /*!
   * Starts at rest.
   * \throw vpException (badValue) naming a limit that is out of its range.
   */
  explicit vpTwistShaper(const vpTwistShaperLimits &limits = {});

  static constexpr double implausible = 1e6; //!< Larger velocities (m/s, rad/s) and accelerations are invalid.
  static constexpr double longestStep = 1.;  //!< Maximum time step, s.

  /*!
   * Restart from this twist and this rate of change (m/s^2, rad/s^2), for example those of a moving robot; from rest
   * when a number is not finite or above #implausible.
   */
  void reset(const vpTwist &twist = {}, const vpTwist &acceleration = {});
  /*!
   * Change the limits from the next cycle on. An acceleration above a lowered limit decreases at full jerk.
   * \throw vpException (badValue) naming a limit that is out of its range.
   */
  void setLimits(const vpTwistShaperLimits &limits);

  /*!
   * One cycle. Never throws, never allocates.
   * \param raw : Desired twist; components in any fixed frame (usually the camera frame). When a number is not finite
   *   or above #implausible the shaper brakes to zero instead.
   * \param dt : Time since the last call, s. When it is not finite and > 0 the twist is unchanged; more than
   *   #longestStep counts as #longestStep, so that the twist does not step after a pause or with a wrong clock.
   * \return The twist to command.
   */
  [[nodiscard]] vpTwist step(const vpTwist &raw, double dt) noexcept;

  //! The commanded twist.
  [[nodiscard]] const vpTwist &twist() const { return m_twist; }
  //! Current rate of change of the twist, m/s^2 and rad/s^2.
  [[nodiscard]] const vpTwist &acceleration() const { return m_acceleration; }

private:
  void updatePart(std::size_t first, const vpTwist &raw, double maxAcceleration, double maxJerk, double dt) noexcept;

  vpTwistShaperLimits m_limits;
  vpTwist m_twist;
  vpTwist m_acceleration;
};

END_VISP_NAMESPACE
#endif
