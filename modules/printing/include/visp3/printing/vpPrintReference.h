/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintReference.h
 * \brief The motion from cell to cell.
 */
#ifndef vpPrintReference_h
#define vpPrintReference_h

#include <visp3/printing/vpMotionForecast.h>

#include <cstddef>
#include <limits>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief What fixes the time from cell to cell.
enum class vpPrintReferenceMode {
  CellVelocity,    //!< Velocity v and acceleration 0 at the centres, a given mean velocity in between.
  FixedArrival,    //!< The time from centre to centre is given, (7.18).
  LimitedVelocity, //!< As fast as a velocity limit allows in between.
  ConstantVelocity //!< The velocity at the centres all the way: the baseline.
};

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpPrintReference, px and frame. The sign of the motion comes from the targets.
 */
struct VISP_EXPORT vpPrintReferenceSpec {
  vpPrintReferenceMode mode = vpPrintReferenceMode::CellVelocity; //!< What fixes the time.
  double meanVelocity = 5.; //!< CellVelocity: mean between cells printed at their own velocity, px/frame, > 0.
  double dropTime = 10.8;   //!< FixedArrival: from target to target, frame, > 0.
  double maxVelocity = 6.;  //!< LimitedVelocity: px/frame, > 0.
  //! LimitedVelocity: px/frame^2, > 0, may be infinite.
  double maxAcceleration = std::numeric_limits<double>::infinity();
  double freeze = 4.; //!< With less time to go the polynomial stays as it is, frame, >= 0; see the note to (7.20).

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief A place to pass or to stop at.
struct VISP_EXPORT vpPrintTarget {
  long key = 0;         //!< Ascending in the order of arrival; stays with the target.
  double position = 0.; //!< Displacement at which it is reached, px. May be refined from step to step.
  double velocity = 4.; //!< Signed velocity there, px/frame; 0: a turning point.
  double duration = 0.; //!< Time from the target before, frame; 0: as the mode says.
};

/*!
 * \class vpPrintReference
 * \ingroup group_printing
 * \brief Direct trajectory generation for printing, thesis (7.18)-(7.20): quintics from target to target with given velocity
 * and zero acceleration there, C2 throughout.
 *
 * As the measured place of the present target changes, its polynomial is made anew from the commanded state with the
 * time that is left, until that is less than the freeze time: a correction in a short rest would ask for large
 * accelerations. What is left over is made good on the way to the next target.
 *
 * step() and at() do not allocate, throw, lock or print.
 */
class VISP_EXPORT vpPrintReference
{
public:
  static constexpr double longestGap = 1e5; //!< Between steps, and as far as at() looks, frame.

  //! \brief Answer of a step.
  struct Output {
    vpAxisState state{};    //!< Position, velocity, acceleration, jerk now.
    long target = 0;        //!< Key of the present target.
    double arrival = 0.;    //!< When it is reached, frame.
    bool hasTarget = false; //!< There is a target; otherwise the motion goes on at its velocity.
    bool newTarget = false; //!< The present target was taken up in this step.
    bool frozen = false;    //!< Too late to follow the target.
    bool exceeded = false;  //!< LimitedVelocity: the polynomial breaks the limit (a target moved, or starts beyond it).
    //! False: the time of the step was before that of the last one, more than #longestGap behind it or not finite; nothing
    //! has changed, the state is that of the last good step.
    bool valid = true;
  };

  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPrintReference(const vpPrintReferenceSpec &spec = vpPrintReferenceSpec());

  /*!
   * \param now : Time, frame; must not decrease nor jump, see Output::valid. At first: since 0, or the time of reset().
   * \param targets, count : Targets that are known, by ascending key; those behind may be left out. One with a number that is
   * not finite or beyond vpPrintingLargest is left out.
   */
  const Output &step(double now, const vpPrintTarget *targets, std::size_t count) noexcept;
  //! The reference at a time from the last step on, as far as targets were known; then at constant velocity. Farther than
  //! #longestGap from the last step: the state there; of NaN: that of the last step.
  [[nodiscard]] vpAxisState at(double time) const noexcept;
  //! Of the last step.
  [[nodiscard]] const Output &output() const { return m_output; }
  //! The plan, for a vpMotionForecast.
  [[nodiscard]] const std::array<vpTrajectorySegment, vpMotionForecast::maxPieces> &pieces() const { return m_pieces; }
  //! Number of pieces in use.
  [[nodiscard]] int pieceCount() const { return m_count; }
  //! Start at a time and place, at rest; targets with keys up to \e passed are behind. Numbers that are not finite or beyond
  //! vpPrintingLargest change nothing.
  void reset(double now, double position, long passed) noexcept;
  //! As given.
  [[nodiscard]] const vpPrintReferenceSpec &spec() const { return m_spec; }

private:
  [[nodiscard]] double durationTo(const vpAxisState &from, const vpPrintTarget &target) const noexcept;
  static void plan(vpTrajectorySegment &piece, const vpAxisState &from, const vpPrintTarget &target, double begin,
                   double duration) noexcept;

  vpPrintReferenceSpec m_spec;
  std::array<vpTrajectorySegment, vpMotionForecast::maxPieces> m_pieces; // the present one, then those to come
  int m_count = 0;
  vpPrintTarget m_target; // of the present piece
  bool m_hasTarget = false;
  long m_passed = 0;     // key of the last target behind
  double m_now = 0.;     // of the last good step
  double m_since = 0.;   // when the last target was reached
  vpAxisState m_start{}; // state there
  Output m_output;
};

END_VISP_NAMESPACE
#endif
