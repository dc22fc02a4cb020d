/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAxisForms.h
 * \brief Forms of the motion of one axis, each with one free duration.
 */
#ifndef vpAxisForms_h
#define vpAxisForms_h

#include <visp3/trajectory/vpMinimumDuration.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>
#include <visp3/trajectory/vpVelocityRamp.h>

#include <algorithm>
#include <cmath>
#include <utility>

BEGIN_VISP_NAMESPACE

//! Motion of one axis between two states; positions are relative to the start, so from[0] is 0.
struct vpAxisTask {
  vpAxisState from{};
  vpAxisState to{};
  vpAxisLimits limits;                       // positions: those that the forms have to keep
  double minPosition = 0., maxPosition = 0.; // position limits of the user
  int order = 3;                             // conditions at each end: 2 cubic, 3 quintic, 4 septic
  double timeUnit = 0.05;                    // s, used where the limits define no time

  //! Duration of an acceleration ramp over the full range when no jerk limit sets it: a tenth of v_max/a_max.
  [[nodiscard]] double rampUnit() const;
  //! Acceleration to brake with.
  [[nodiscard]] double brakeAcceleration() const;
  //! Jerk for braking from a state: gentle, unless the velocity limit leaves no margin for that, or times \e hardness.
  [[nodiscard]] double brakeJerk(const vpAxisState &x, double hardness = 1.) const;
  //! The task with the acceleration that it may brake with: its limit, or where there is none, \e hardness decides.
  [[nodiscard]] vpAxisTask harder(double hardness) const;
  //! The limits without those on the position.
  [[nodiscard]] vpAxisLimits withoutPosition() const;
  //! The position limits, as far as start and goal are within them.
  [[nodiscard]] double lowest() const { return std::min({minPosition, 0., to[0]}); }
  [[nodiscard]] double highest() const { return std::max({maxPosition, 0., to[0]}); }
  //! Start or goal has a velocity (or what of higher derivatives matters): the axis needs room to brake or to launch.
  [[nodiscard]] bool isMoving() const;
  //! The ways of a stop from the start, and of one from the goal with time running backwards, at usual hardness.
  [[nodiscard]] std::pair<double, double> brakingWays() const;
  //! True when the braking distance is defined.
  [[nodiscard]] bool hasBrakingDistance() const
  {
    return std::isfinite(limits.acceleration) || std::isfinite(limits.jerk);
  }
};

/*!
 * Duration of the ramp from acceleration a to zero starting in this state (j matters for order 4; \e order replaces that of the task): gentle if there is a
 * margin, never beyond the velocity limit. Zero when there is nothing to ramp, negative when no ramp keeps the limits.
 */
double rampDuration(const vpAxisState &x, const vpAxisTask &task, int order) noexcept;

//! True when the state is outside the limits or will inevitably leave them: braking comes first.
bool needsBraking(const vpAxisTask &task) noexcept;

/*!
 * From a state to rest, as hard as is needed to stay between two places. If none is hard enough, the place that cannot
 * be kept is exceeded as little as can be without leaving the other.
 *
 * With a jerk limit J, to lose the deceleration before the rest costs way. So the velocity may pass through zero while
 * the axis still decelerates by b: it turns back, and stops then. For a given b no motion turns earlier than the fastest
 * change of velocity from the present state to u = -b^2/(2 J) with zero acceleration, because it decelerates most at
 * every velocity on its way. The greater b, the earlier the turn, and the longer the way back: from the turn to rest it
 * takes (1/3 + 1/sqrt(8)) b^3/J^2 = 0.687 b^3/J^2. So b is the least that is enough, or else the greatest for which there
 * is room, up to the acceleration limit and sqrt(2 J v_max), with which the velocity limit is just kept on the way back.
 *
 * What could better that: no way back is shorter than 2/3 b^3/J^2, which is that of a motion that turns again with the
 * same b, and then runs into the first place once more. It would allow a b that is 1 % greater. A second turn is taken
 * only where a start that decelerates too much to come to rest without turning would leave the other place.
 */
struct vpHardStop {
  //! The mildest stop that stays within \e low <= 0 <= \e high (places from the start), or leaves it least.
  vpHardStop(const vpAxisState &x, const vpAxisTask &task, double low, double high) noexcept;

  double acceleration = 0.;           //!< Largest acceleration.
  double jerk = 0.;                   //!< Largest jerk.
  int count = 1;                      //!< Number of velocities.
  std::array<double, 3> velocities{}; //!< One after the other reached with zero acceleration; the last is zero.

private:
  [[nodiscard]] double excess(const vpAxisState &x, double low, double high, double side) const noexcept;
  void turnBack(const vpAxisState &x, const vpAxisTask &task, double low, double high) noexcept;
};

/*!
 * Fixed pieces, one polynomial of free duration, fixed pieces. Everything except the cruise form is of this kind.
 */
class vpFramedMotion
{
public:
  //! Remove all fixed pieces.
  void open(const vpAxisTask &task) noexcept;
  //! Fixed pieces at the head: braking to the velocity \e target with zero acceleration, extended to \e duration if
  //! longer.
  void brake(const vpAxisTask &task, double target, double duration, double jerk) noexcept;
  //! Fixed pieces at the tail: as fast as the limits allow from rest to the velocity before the tail.
  void launch(const vpAxisTask &task, double jerk) noexcept;
  //! Fixed pieces at the head, and at the tail with time running backwards: this stop.
  void brake(const vpHardStop &stop) noexcept;
  void launch(const vpHardStop &stop) noexcept;
  //! Fixed piece at the head: from rest to rest at \e place.
  void go(double place, double duration) noexcept;
  //! Hold at rest until the head, or the tail, lasts this long; both are at rest.
  void padHead(double duration) noexcept;
  void padTail(double duration) noexcept;
  //! Fixed pieces: the acceleration ramps, at the head from the initial state, at the tail up to the goal.
  void rampHead(double r) noexcept;
  void rampTail(double r) noexcept;
  //! Fixed pieces: from the initial velocity to rest, and from rest to the velocity before the tail.
  void stopHead(double T) noexcept;
  void stopTail(double T) noexcept;
  //! Make the free polynomial between the fixed pieces, once these are complete.
  void close(const vpAxisTask &task) noexcept;

  [[nodiscard]] const vpAxisState &head() const { return m_head; } //!< State in which the free polynomial begins.
  [[nodiscard]] const vpAxisState &tail() const { return m_tail; } //!< State in which the free polynomial ends.
  [[nodiscard]] double headDuration() const { return m_headTime; } //!< Duration of the fixed pieces at the head, s.
  [[nodiscard]] double tailDuration() const { return m_tailTime; } //!< Duration of the fixed pieces at the tail, s.
  [[nodiscard]] double fixedDuration() const { return m_headTime + m_tailTime; } //!< Duration of all fixed pieces, s.
  [[nodiscard]] const vpMotionFamily &middle() const { return m_middle; }        //!< The free polynomial.
  //! Lowest and highest position of the fixed pieces and of both ends.
  void hull(double &low, double &high) const noexcept;
  //! The longer of the distances of a stop from the start and a launch to the goal.
  [[nodiscard]] double brakingDistance(double goal) const noexcept
  {
    return std::max(std::abs(m_head[0]), std::abs(goal - m_tail[0]));
  }
  [[nodiscard]] bool hasFixedPieces() const { return m_heads + m_tails > 0; } //!< There is more than one polynomial.
  [[nodiscard]] bool isBlocked() const { return m_blocked; } //!< The fixed pieces leave the position limits.
  //! True when the fixed pieces stay between these positions.
  [[nodiscard]] bool fixedStaysWithin(double low, double high) const noexcept;
  //! True when the motion of total duration \e T stays between these positions.
  [[nodiscard]] bool staysWithin(double low, double high, double T) const noexcept;
  //! No duration that next() finds is shorter.
  [[nodiscard]] double least() const { return m_blocked ? 0. : fixedDuration() + m_lower; }
  //! One look: the total duration \e T itself if the limits are kept, else the next candidate; see vpMinimumDuration.
  [[nodiscard]] double next(double T) const noexcept;
  //! Append the motion of total duration \e T to a plan, times \e factor.
  void emit(vpTrajectoryPlan &plan, int axis, double factor, double T) const noexcept;
  //! Append the pieces at the head only.
  void emitHead(vpTrajectoryPlan &plan, int axis, double factor) const noexcept;

private:
  struct Piece {
    vpPolynomial p;
    double duration = 0.;
  };
  static constexpr int maxHead = 10; // braking 4, padding, ramp, stop, or a stop of 8; the way back inside
  static constexpr int maxTail = 8;  // ramp, stop or a launch of 8, padding; the last one first

  void rampTo(double target, double acceleration, double jerk) noexcept;
  void takeTail(const vpFramedMotion &backwards) noexcept;
  void addHead(const vpPolynomial &p, double duration) noexcept;
  void addTail(const vpPolynomial &p, double duration) noexcept;
  [[nodiscard]] double restToRestDuration() const noexcept;
  [[nodiscard]] bool isTailAtRest() const { return m_tail[1] == 0. && (m_order == 2 || m_tail[2] == 0.); }

  std::array<Piece, maxHead> m_headPieces{};
  std::array<Piece, maxTail> m_tailPieces{};
  int m_heads = 0, m_tails = 0, m_order = 3;
  double m_headTime = 0., m_tailTime = 0., m_lower = 0.;
  mutable double m_low = 0., m_high = 0.; // the hull, once it is asked for
  mutable bool m_hullKnown = false;
  bool m_blocked = false;    // the fixed pieces leave the position limits
  bool m_restToRest = false; // the middle is monotone and keeps its limits from m_lower on
  vpAxisState m_head{}, m_tail{};
  vpMotionFamily m_middle;
  vpAxisLimits m_middleLimits;
};

/*!
 * Ramp, constant velocity, ramp: for long moves. The ramps are quartic; their durations are those of full speed, or what
 * a group has in common.
 */
class vpCruiseMotion
{
public:
  //! Set up after the head of \e framed (which may brake). Not available without both limits or for short moves.
  void open(const vpAxisTask &task, const vpFramedMotion &framed) noexcept;
  //! The same with durations of the ramps, no shorter than the total duration \e shortest; infinite: not available.
  void open(const vpAxisTask &task, const vpFramedMotion &framed, double up, double down, double shortest) noexcept;
  //! No motion of this form is shorter: constant accelerations \e a at both ends; infinite where it is not available.
  [[nodiscard]] static double least(double fixed, double h, double v0, double v1, double v, double a) noexcept;
  //! Smallest feasible duration >= T of this form, or infinity.
  [[nodiscard]] double next(double T) const noexcept;
  //! The ramps from and to the constant velocity of the total duration \e T.
  void ramps(double T, vpMotionFamily &up, vpMotionFamily &down) const noexcept;
  [[nodiscard]] double up() const { return m_up; }     //!< Duration of the first ramp, s.
  [[nodiscard]] double down() const { return m_down; } //!< Duration of the last, s.
  //! The motion of total duration \e T stays between these places.
  [[nodiscard]] bool staysWithin(double low, double high, double T) const noexcept;
  //! Append the motion of total duration \e T to a plan, times \e factor, without the head of \e framed.
  void emit(vpTrajectoryPlan &plan, int axis, double factor, double T) const noexcept;

  //! What ramps of these durations, from and to \e framed's states, leave for the mean of their ends and the constant part.
  [[nodiscard]] static double rest(const vpFramedMotion &framed, double up, double down) noexcept;

private:
  [[nodiscard]] double cruiseAt(double T) const noexcept;

  bool m_available = false;
  double m_braked = 0., m_up = 0., m_down = 0., m_shortest = 0., m_rest = 0.;
  vpAxisState m_from{}, m_to{};
  vpAxisLimits m_limits;
};

END_VISP_NAMESPACE
#endif
