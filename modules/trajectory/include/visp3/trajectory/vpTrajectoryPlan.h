/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryPlan.h
 * \brief A planned motion of several axes as a sequence of polynomials, and its queries.
 */
#ifndef vpTrajectoryPlan_h
#define vpTrajectoryPlan_h

#include <visp3/trajectory/vpMotionFamily.h>
#include <visp3/trajectory/vpVelocityRamp.h>

#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_trajectory
//! \brief Form of the motion of one axis.
enum class vpTrajectoryForm {
  Hold,      //!< Start and goal are the same.
  Direct,    //!< One polynomial (or one per via), the minimum-jerk motion.
  Cruise,    //!< Ramp, constant velocity, ramp.
  Ramped,    //!< Acceleration ramps around a polynomial: no single polynomial keeps the limits.
  StopAndGo, //!< Stop, move, accelerate to the final velocity: keeps position and group limits when no other form does.
  Vias,      //!< Via by via, because no single duration keeps the limits over all of them.
  Own        //!< A form that a user added: vpMotionForm.
};

//! \ingroup group_trajectory
//! \brief The form as a word ("Direct"), for files; static text.
[[nodiscard]] VISP_EXPORT const char *vpToString(vpTrajectoryForm form);

//! \ingroup group_trajectory
//! \brief A polynomial in its own normalised time: q(t) = p((t - begin)/duration).
struct VISP_EXPORT vpTrajectorySegment {
  double begin = 0.;    //!< Start, s from the start of the plan.
  double duration = 0.; //!< Duration, s, > 0.
  vpPolynomial p;       //!< Position in s = (t - begin)/duration; the constant term is the absolute position.
};

//! \ingroup group_trajectory
//! \brief Exact extremes of one axis over a plan.
struct VISP_EXPORT vpTrajectoryPeaks {
  double minPosition = 0.;  //!< Lowest position.
  double maxPosition = 0.;  //!< Highest position.
  double velocity = 0.;     //!< Largest |v|, unit/s.
  double acceleration = 0.; //!< Largest |a|, unit/s^2.
  double jerk = 0.;         //!< Largest |j|, unit/s^3.
  double squaredJerk = 0.;  //!< Integral of j^2, unit^2/s^5.
};

//! \ingroup group_trajectory
//! \brief An interval in which every axis is one polynomial in t - begin, for reports.
struct VISP_EXPORT vpTrajectoryPiece {
  double begin = 0.;                             //!< Start, s from the start of the plan.
  double end = 0.;                               //!< End, s from the start of the plan.
  double duration = 0.;                          //!< Duration, s: end - begin without the rounding of the two times.
  std::vector<std::vector<double>> coefficients; //!< Per axis, constant first, in t - begin (s).
};

/*!
 * \class vpTrajectoryPlan
 * \ingroup group_trajectory
 * \brief An immutable motion, as a value. Made by vpTrajectoryPlanner; queries never allocate except pieces().
 *
 * \code
 * vpTrajectoryInput<2> input;
 * input.goal.q << 0.5, -0.2; // m; limits are 1 m/s, 1 m/s^2 unless set
 * vpTrajectoryPlan plan(2);
 * const vpTrajectoryStatus status = vpDirectTrajectory<2>::calculate(input, plan);
 * if (status.isGood()) {
 *   std::cout << plan.duration() << " s, at most " << plan.peaks(0).velocity << " m/s" << std::endl;
 *   std::cout << "half-way at " << plan.at(0, plan.duration() / 2.)[0] << " m" << std::endl;
 * }
 * else {
 *   std::cerr << status.message() << std::endl;
 * }
 * \endcode
 */
class VISP_EXPORT vpTrajectoryPlan
{
public:
  /*!
   * An empty plan with capacity for its axes and vias.
   * \throw vpException (badValue) when \e axes < 1 or \e maxVias < 0.
   */
  explicit vpTrajectoryPlan(int axes, int maxVias = 0);

  [[nodiscard]] int axes() const { return m_axes; }            //!< Number of axes.
  [[nodiscard]] double duration() const { return m_duration; } //!< Arrival of the last axis, s.
  //! Arrival of this axis, s: below duration() with vpSynchronisation::None only.
  [[nodiscard]] double duration(int axis) const { return m_tracks[static_cast<std::size_t>(axis)].duration; }
  [[nodiscard]] double brakingEnd() const
  {
    return m_brakingEnd;
  } //!< Time until the start is back within the limits, s; 0: it was inside.
  [[nodiscard]] vpTrajectoryForm form(int axis) const
  {
    return m_tracks[static_cast<std::size_t>(axis)].form;
  } //!< Form of an axis.
  //! The worst form of all axes.
  [[nodiscard]] vpTrajectoryForm form() const;
  [[nodiscard]] int iterations() const { return m_iterations; } //!< Maximum iterations of one search of this plan.

  /*!
   * State of an axis at time \e t (s from the start of the plan), any finite t. Before the start: the start state. At
   * the end: exactly the goal. Afterwards a goal acceleration is ramped down and a goal velocity is kept, until the
   * axis has to brake for a position limit.
   */
  [[nodiscard]] vpAxisState at(int axis, double t) const noexcept;
  //! Number of segments of an axis.
  [[nodiscard]] int segments(int axis) const { return m_tracks[static_cast<std::size_t>(axis)].count; }
  //! Number of segments after the arrival, until the velocity is constant; 0 when the goal is at rest.
  [[nodiscard]] int coasting(int axis) const { return m_tracks[static_cast<std::size_t>(axis)].coasting; }
  //! Segment \e i of an axis, 0 <= i < segments(axis) + coasting(axis).
  [[nodiscard]] const vpTrajectorySegment &segment(int axis, int i) const { return m_segments[index(axis, i)]; }
  //! Number of vias that the plan goes through.
  [[nodiscard]] int vias() const { return m_vias; }
  //! Time at which via \e k is passed, s from the start of the plan.
  [[nodiscard]] double viaTime(int k) const { return m_viaTimes[static_cast<std::size_t>(k)]; }
  //! Exact extremes of an axis until its arrival, from the roots of the derivatives.
  [[nodiscard]] vpTrajectoryPeaks peaks(int axis) const noexcept;
  /*!
   * Exact peak of the Euclidean norm of the velocities (order 1) or accelerations (order 2) over the axes whose bit is
   * set in \e axes, from the time \e from on, including the motion after arrival.
   */
  [[nodiscard]] double peakNorm(unsigned long long axes, int order, double from = 0.) const noexcept;
  //! The plan split at every change of polynomial of any axis. Allocates.
  [[nodiscard]] std::vector<vpTrajectoryPiece> pieces() const { return pieces(m_duration); }
  //! The plan split as in pieces(), until the time \e until, s, finite and > 0 (otherwise there is none), instead of the arrival. Allocates.
  [[nodiscard]] std::vector<vpTrajectoryPiece> pieces(double until) const;

  /*! \name For planners */
  //! @{
  void clear() noexcept;                                          //!< Forget the motion, keep the capacity.
  void begin(int axis, double q, vpTrajectoryForm form) noexcept; //!< Start the track of an axis at position \e q.
  //! Append a motion relative to the end of the track. Ignored when \e duration is not > 0 or the capacity is used up.
  void append(int axis, const vpPolynomial &relative, double duration) noexcept;
  //! Append a change of velocity from the state \e x.
  void appendRamp(int axis, const vpVelocityRamp &ramp, const vpAxisState &x) noexcept;
  //! Set the exact end time of the leg, s from the start of the plan, free of the rounding of its segment durations.
  void endLeg(int axis, double t) noexcept;
  //! Close a track with the exact goal; everything appended later follows the arrival.
  void finish(int axis, const vpAxisState &goal) noexcept;
  void rest(int axis) noexcept { m_tracks[static_cast<std::size_t>(axis)].coast = 0.; } //!< The track ends at rest.
  //! True when all numbers of the plan are finite.
  [[nodiscard]] bool isFinite() const noexcept;
  void setBrakingEnd(double t) { m_brakingEnd = t; } //!< See brakingEnd().
  void setIterations(int n) { m_iterations = n; }    //!< See iterations().
  void addVia(double t) noexcept; //!< Add the time \e t of the next via. Ignored when the capacity is used up.
  //! @}

private:
  struct Track {
    int count = 0;    // segments until the arrival
    int coasting = 0; // segments after the arrival
    bool finished = false;
    double duration = 0.; // until the arrival
    double end = 0.;      // end of the last segment
    double place = 0.;    // position at end
    double coast = 0.;    // velocity after end
    vpAxisState goal{};
    vpTrajectoryForm form = vpTrajectoryForm::Hold;
  };
  [[nodiscard]] std::size_t index(int axis, int i) const
  {
    return static_cast<std::size_t>(axis) * static_cast<std::size_t>(m_capacity) + static_cast<std::size_t>(i);
  }
  [[nodiscard]] double endOf(int axis, int i) const noexcept;
  [[nodiscard]] double nextBreak(double t, double until) const noexcept;
  [[nodiscard]] vpPolynomial between(int axis, double from, double to, double &duration) const noexcept;

  int m_axes;
  int m_capacity; // segments per axis
  int m_vias = 0;
  double m_duration = 0.;
  double m_brakingEnd = 0.;
  int m_iterations = 0;
  std::vector<Track> m_tracks;
  std::vector<vpTrajectorySegment> m_segments; // axes x capacity: sized at construction, so copies keep the capacity
  std::vector<double> m_viaTimes;
};

END_VISP_NAMESPACE
#endif
