/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpTrajectoryProblem.h
 * \brief Start, goal, limits, vias and options of a trajectory for any number of axes, in flat storage.
 */
#ifndef vpTrajectoryProblem_h
#define vpTrajectoryProblem_h

#include <visp3/trajectory/vpMinimumDuration.h>
#include <visp3/trajectory/vpTrajectorySpec.h>
#include <visp3/trajectory/vpTrajectoryResult.h>

#include <vector>

BEGIN_VISP_NAMESPACE

/*!
 * \class vpTrajectoryProblem
 * \ingroup group_trajectory
 * \brief Input of vpTrajectoryPlanner, with the number of axes known at run time only.
 *
 * vpTrajectoryInput is its typed form for users. Allocates at construction only.
 *
 * \code
 * vpTrajectoryProblem problem(1, 1); // axes, vias
 * problem.setStart(0, {0., 0.1});    // m, m/s
 * problem.field(vpTrajectoryProblem::GoalQ)[0] = 0.5;
 * problem.field(vpTrajectoryProblem::MaxAcceleration)[0] = 2.; // m/s^2
 * const double via = 0.4;                                      // m
 * problem.setViaCount(1);
 * problem.setVia(0, vpAutomaticTau, &via, nullptr, nullptr);
 * const vpTrajectoryStatus status = problem.validate(true);
 * if (!status.isGood()) {
 *   std::cerr << status.message() << std::endl; // "velocity limit of axis 1 is -1, must be > 0"
 * }
 * \endcode
 */
class VISP_EXPORT vpTrajectoryProblem
{
public:
  //! Fields with one number per axis.
  enum Field {
    StartQ,
    StartV,
    StartA,
    StartJ, //!< Start state; an event may change the other fields.
    GoalQ,
    GoalV,
    GoalA,
    GoalJ,
    MaxVelocity,
    MaxAcceleration,
    MaxJerk,
    MinPosition,
    MaxPosition,
    FieldCount
  };

  /*!
   * At rest at zero, without limits.
   * \param axes : Number of axes, >= 1.
   * \param maxVias : Maximum number of vias, >= 0.
   * \throw vpException (badValue) naming the number that is out of range.
   */
  explicit vpTrajectoryProblem(int axes, int maxVias = 0);

  [[nodiscard]] int axes() const { return m_axes; }       //!< Number of axes.
  [[nodiscard]] int maxVias() const { return m_maxVias; } //!< Maximum number of vias.
  [[nodiscard]] int vias() const { return m_vias; }       //!< Number of vias in use.

  //! Values of a field, axes() of them.
  [[nodiscard]] double *field(Field f) { return m_values.data() + index(f, 0); }
  [[nodiscard]] const double *field(Field f) const { return m_values.data() + index(f, 0); } //!< \overload

  //! Use \e count vias; above maxVias() the problem becomes invalid (TooManyVias).
  void setViaCount(int count) { m_vias = count; }
  /*!
   * Sets a via.
   * \param k : Index of the via, 0 <= k < maxVias().
   * \param tau : Time as a fraction of the whole move, or vpAutomaticTau in all vias.
   * \param q, v, a : axes() numbers each; \e v, \e a may be null: left free.
   */
  void setVia(int k, double tau, const double *q, const double *v, const double *a);
  [[nodiscard]] double viaTime(int k) const { return m_viaTimes[static_cast<std::size_t>(k)]; } //!< tau of via \e k.
  [[nodiscard]] int viaOrder(int k) const
  {
    return m_viaOrders[static_cast<std::size_t>(k)];
  } //!< Given values, 1: q; 2: q, v; 3: q, v, a.
  //! Set tau and the number of given values (1 to 3) of via \e k.
  void setViaTime(int k, double tau, int order);
  //! Set position, velocity and acceleration of via \e k on \e axis; viaOrder() tells which of them count.
  void setViaState(int k, int axis, const vpAxisState &x);
  //! The planner chooses the times of the vias.
  [[nodiscard]] bool hasAutomaticVias() const { return m_vias > 0 && m_maxVias > 0 && viaTime(0) == vpAutomaticTau; }
  //! Position, velocity and acceleration of via \e k on \e axis.
  [[nodiscard]] vpAxisState viaState(int k, int axis) const;
  //! Forget the first \e count vias; rescale the others to the part of the move left after the fraction \e done < 1,
  //! unless they are automatic.
  void dropVias(int count, double done);

  //! Take goal, limits and options of \e other, which has the same number of axes, and keep the vias.
  void takeTask(const vpTrajectoryProblem &other);

  void setStart(int axis, const vpAxisState &x);   //!< Set the start state of an axis.
  [[nodiscard]] vpAxisState start(int axis) const; //!< Start state of an axis.
  [[nodiscard]] vpAxisState goal(int axis) const;  //!< Goal state of an axis.
  /*!
   * Limits of an axis, positions as given. A state of start, goal or vias beyond a limit by no more than
   * vpLimit::tolerance counts as on it: the limit is moved to the state.
   */
  [[nodiscard]] vpAxisLimits limits(int axis) const;
  //! Limits on the norms of group \e g, moved to the norms of start and goal in the same way.
  [[nodiscard]] vpNormLimits groupLimits(int g) const;

  //! True when goal, limits, vias and options are the same (the start is not compared).
  [[nodiscard]] bool sameTask(const vpTrajectoryProblem &other) const;
  //! True when the vias are the same.
  [[nodiscard]] bool sameVias(const vpTrajectoryProblem &other) const;
  /*!
   * Check every number.
   * \param startToo : Check the start state, too.
   * \return InvalidInput with the first fault found, or Working.
   */
  [[nodiscard]] vpTrajectoryStatus validate(bool startToo) const noexcept;

  vpTrajectorySpec spec; //!< Everything that is not one number per axis.

private:
  [[nodiscard]] double at(Field f, int axis) const { return m_values[index(f, axis)]; }
  [[nodiscard]] std::size_t index(Field f, int axis) const
  {
    return static_cast<std::size_t>(f) * static_cast<std::size_t>(m_axes) + static_cast<std::size_t>(axis);
  }
  [[nodiscard]] vpTrajectoryStatus validateAxis(int i) const noexcept;
  [[nodiscard]] vpTrajectoryStatus validateGroups() const noexcept;
  [[nodiscard]] vpTrajectoryStatus validateVias() const noexcept;
  [[nodiscard]] vpTrajectoryStatus validateOptions() const noexcept;

  int m_axes;
  int m_maxVias;
  int m_vias = 0;
  std::vector<double> m_values;    // FieldCount x axes
  std::vector<double> m_viaValues; // maxVias x 3 x axes
  std::vector<double> m_viaTimes;
  std::vector<int> m_viaOrders;
};

END_VISP_NAMESPACE
#endif
