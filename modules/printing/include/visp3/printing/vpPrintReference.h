/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpPrintReference.h
 * \brief Reference motion from cell to cell.
 */
#ifndef vpPrintReference_h
#define vpPrintReference_h

#include <visp3/printing/vpMotionForecast.h>

#include <cstddef>
#include <limits>

BEGIN_VISP_NAMESPACE

//! \ingroup group_printing
//! \brief How the time from cell to cell is determined.
enum class vpPrintReferenceMode {
  CellVelocity,    //!< Velocity v and acceleration 0 at the centres, a given mean velocity in between.
  FixedArrival,    //!< The time from centre to centre is given, (7.18).
  LimitedVelocity, //!< As fast as a velocity limit allows.
  ConstantVelocity //!< The velocity at the centres throughout: the baseline.
};

/*!
 * \ingroup group_printing
 * \brief Parameters of a vpPrintReference, px and frame. The sign of the motion comes from the targets.
 */
struct VISP_EXPORT vpPrintReferenceSpec {
  vpPrintReferenceMode mode = vpPrintReferenceMode::CellVelocity; //!< How the time is determined.
  double meanVelocity = 5.;          //!< CellVelocity: mean between cells with their own velocity, px/frame, > 0.
  double dropTime = 220. / 4.5 / 5.; //!< FixedArrival: time from target to target, frame, > 0.
  double maxVelocity = 6.;           //!< LimitedVelocity: velocity limit, px/frame, > 0.
  //! LimitedVelocity: acceleration limit, px/frame^2, > 0, may be infinite.
  double maxAcceleration = std::numeric_limits<double>::infinity();
  double freeze = 4.; //!< With less remaining time the polynomial is kept, frame, >= 0; see the note to (7.20).

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_printing
//! \brief A position to pass or to stop at.
struct VISP_EXPORT vpPrintTarget {
  long key = 0;         //!< Ascending in the order of arrival; constant for a target.
  double position = 0.; //!< Displacement at the target, px. May be refined from step to step.
  double velocity = 4.; //!< Signed velocity at the target, px/frame; 0: a turning point.
  double duration = 0.; //!< Time from the previous target, frame; 0: determined by the mode.
};

/*!
 * \class vpPrintReference
 * \ingroup group_printing
 * \brief DTG, direct trajectory generation, for printing, thesis (7.18)-(7.20): quintics from target to target with
 * given velocity and zero acceleration there, C2 throughout.
 *
 * As the measured position of the current target changes, its polynomial is recomputed from the commanded state for the
 * remaining time, until that is less than the freeze time: a correction in a short time would need large accelerations.
 * The rest is corrected on the way to the next target.
 *
 * step() and at() do not allocate, throw, lock or print.
 *
 * \code
 * const vpPrintTarget cells[] = {{1, 48.9}, {2, 97.8}, {3, 146.7}}; // px, passed with 4 px/frame
 * vpPrintReference reference;                                       // 5 px/frame on average
 * for (double frame = 0.; frame < 40.; ++frame) {
 *   const vpPrintReference::Output &out = reference.step(frame, cells, 3);
 *   if (out.valid && out.hasTarget) {
 *     std::cout << out.state[0] << " px, " << out.state[1] << " px/frame; cell " << out.target << " at "
 *               << out.arrival << (out.frozen ? ", frozen" : "") << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpPrintReference
{
public:
  static constexpr double longestGap = 1e5; //!< Maximum time between steps, and range of at(), frame.

  //! \brief Output of a step.
  struct Output {
    vpAxisState state{};    //!< Current position, velocity, acceleration, jerk.
    long target = 0;        //!< Key of the current target.
    double arrival = 0.;    //!< Arrival time at the target, frame.
    bool hasTarget = false; //!< There is a target; otherwise the motion continues at its velocity.
    bool newTarget = false; //!< The current target became current in this step.
    bool frozen = false;    //!< Too late to follow the target.
    bool exceeded = false;  //!< LimitedVelocity: the limit is exceeded (a target moved, or starts beyond it).
    //! False: the time of the step was before the last one, more than #longestGap after it or not finite; nothing has
    //! changed, the state is that of the last valid step.
    bool valid = true;
  };

  //! \throw vpException (badValue) naming the field of \e spec that is out of range, and its value.
  explicit vpPrintReference(const vpPrintReferenceSpec &spec = vpPrintReferenceSpec());

  /*!
   * \param now : Time, frame; must not decrease or jump, see Output::valid. First call: time since 0, or since the time
   *   of reset().
   * \param targets, count : Known targets, by ascending key; passed ones may be omitted. Targets with a number that is
   *   not finite or beyond vpPrintingLargest are ignored.
   */
  const Output &step(double now, const vpPrintTarget *targets, std::size_t count) noexcept;
  //! Reference at a time from the last step on, as far as targets were known; then at constant velocity. Farther than
  //! #longestGap from the last step: the state there; for NaN: that of the last step.
  [[nodiscard]] vpAxisState at(double time) const noexcept;
  //! Output of the last step.
  [[nodiscard]] const Output &output() const { return m_output; }
  //! Pieces of the plan, for a vpMotionForecast.
  [[nodiscard]] const std::array<vpTrajectorySegment, vpMotionForecast::maxPieces> &pieces() const { return m_pieces; }
  //! Number of pieces in use.
  [[nodiscard]] int pieceCount() const { return m_count; }
  //! Restart at a time and position, at rest; targets with keys up to \e passed are passed. Ignored for numbers that
  //! are not finite or beyond vpPrintingLargest.
  void reset(double now, double position, long passed) noexcept;
  //! Specification as given.
  [[nodiscard]] const vpPrintReferenceSpec &spec() const { return m_spec; }

private:
  [[nodiscard]] double durationTo(const vpAxisState &from, const vpPrintTarget &target) const noexcept;
  static void plan(vpTrajectorySegment &piece, const vpAxisState &from, const vpPrintTarget &target, double begin,
                   double duration) noexcept;

  vpPrintReferenceSpec m_spec;
  std::array<vpTrajectorySegment, vpMotionForecast::maxPieces> m_pieces; // the current one, then the following ones
  int m_count = 0;
  vpPrintTarget m_target; // target of the current piece
  bool m_hasTarget = false;
  long m_passed = 0;     // key of the last passed target
  double m_now = 0.;     // time of the last valid step
  double m_since = 0.;   // time at which the last target was reached
  vpAxisState m_start{}; // state at m_since
  Output m_output;
};

END_VISP_NAMESPACE
#endif
