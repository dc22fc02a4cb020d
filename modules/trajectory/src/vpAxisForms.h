/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpAxisForms.h
 * \brief The shapes that the motion of one axis can take, each with one free duration.
 */
#ifndef vpAxisForms_h
#define vpAxisForms_h

#include <visp3/trajectory/vpMinimumDuration.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>
#include <visp3/trajectory/vpVelocityRamp.h>

#include <algorithm>
#include <cmath>

BEGIN_VISP_NAMESPACE

//! One axis on its way from a state to a state; places are relative to the start, so from[0] is 0.
struct vpAxisTask {
  vpAxisState from{};
  vpAxisState to{};
  vpAxisLimits limits;                       // positions: those that the forms have to keep
  double minPosition = 0., maxPosition = 0.; // as the user limits them
  int order = 3;                             // conditions at each end: 2 cubic, 3 quintic, 4 septic
  double timeUnit = 0.05;                    // s, where the limits define none

  //! Duration of an acceleration ramp over the full range when no jerk limit sets it: a tenth of v_max/a_max.
  [[nodiscard]] double rampUnit() const;
  //! Acceleration to brake with.
  [[nodiscard]] double brakeAcceleration() const;
  //! Jerk to brake with from a state: gentle, unless the velocity limit leaves no room for that, or times \e hardness.
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
  //! The longer of the ways that a stop from the start and a launch to the goal take, as hard as usual.
  [[nodiscard]] double brakingDistance() const;
  //! How far a stop takes it is defined.
  [[nodiscard]] bool hasBrakingDistance() const
  {
    return std::isfinite(limits.acceleration) || std::isfinite(limits.jerk);
  }
};

/*!
 * Duration of the ramp from acceleration a to zero that starts in this state (j matters for order 4): gentle if there
 * is room, never beyond the velocity limit. Zero when there is nothing to ramp, negative when no ramp keeps the limits.
 */
double rampDuration(const vpAxisState &x, const vpAxisTask &task) noexcept;

//! True when the state is outside the limits or cannot but leave them: braking comes first.
bool needsBraking(const vpAxisTask &task) noexcept;

struct vpHardStop;

/*!
 * Fixed pieces, one polynomial of free duration, fixed pieces. Everything except the cruise form is of this kind.
 */
class vpFramedMotion
{
public:
  //! Start over: nothing fixed yet.
  void open(const vpAxisTask &task) noexcept;
  //! Fixed pieces at the head: braking to the velocity \e target with zero acceleration, padded to \e duration if longer.
  void brake(const vpAxisTask &task, double target, double duration, double jerk) noexcept;
  //! Fixed pieces at the tail: as fast as the limits allow from rest to the velocity before the tail.
  void launch(const vpAxisTask &task, double jerk) noexcept;
  //! Fixed pieces at the head, and at the tail with time running backwards: this stop.
  void brake(const vpHardStop &stop) noexcept;
  void launch(const vpHardStop &stop) noexcept;
  //! Fixed piece at the head: from rest to rest at \e place.
  void go(double place, double duration) noexcept;
  //! Rest until the head, or the tail, lasts that long; both are at rest.
  void padHead(double duration) noexcept;
  void padTail(double duration) noexcept;
  //! Fixed pieces: the acceleration ramps, at the head from the present state, at the tail up to the goal.
  void rampHead(double r) noexcept;
  void rampTail(double r) noexcept;
  //! Fixed pieces: from the present velocity to rest, and from rest to the velocity before the tail.
  void stopHead(double T) noexcept;
  void stopTail(double T) noexcept;
  //! Everything fixed is in place: make the polynomial between.
  void close(const vpAxisTask &task) noexcept;

  [[nodiscard]] const vpAxisState &head() const { return m_head; } //!< State in which the free polynomial begins.
  [[nodiscard]] const vpAxisState &tail() const { return m_tail; } //!< State in which it ends.
  [[nodiscard]] double headDuration() const { return m_headTime; } //!< Of the fixed pieces at the head, s.
  [[nodiscard]] double tailDuration() const { return m_tailTime; } //!< Of those at the tail, s.
  [[nodiscard]] double fixedDuration() const { return m_headTime + m_tailTime; } //!< Of all fixed pieces, s.
  [[nodiscard]] const vpMotionFamily &middle() const { return m_middle; }        //!< The free polynomial.
  //! Lowest and highest place of the fixed pieces and of both ends.
  void hull(double &low, double &high) const noexcept;
  //! The longer of the ways that a stop takes from the start and a launch takes to the goal.
  [[nodiscard]] double brakingDistance(double goal) const noexcept
  {
    return std::max(std::abs(m_head[0]), std::abs(goal - m_tail[0]));
  }
  [[nodiscard]] bool hasFixedPieces() const { return m_heads + m_tails > 0; } //!< It is more than one polynomial.
  [[nodiscard]] bool isBlocked() const { return m_blocked; } //!< The fixed pieces leave the position limits.
  //! The fixed pieces stay between these places.
  [[nodiscard]] bool fixedStaysWithin(double low, double high) const noexcept;
  //! The motion of total duration \e T stays between these places.
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

  std::array<Piece, maxHead> m_headPieces{};
  std::array<Piece, maxTail> m_tailPieces{};
  int m_heads = 0, m_tails = 0, m_order = 3;
  double m_headTime = 0., m_tailTime = 0., m_lower = 0.;
  mutable double m_low = 0., m_high = 0.; // the hull, once it is asked for
  mutable bool m_hullKnown = false;
  bool m_blocked = false; // the fixed pieces leave the position limits
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
  //! Set up after the head of \e framed (which may have braked). Not available without both limits or on short moves.
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
