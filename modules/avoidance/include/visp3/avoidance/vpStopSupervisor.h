/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpStopSupervisor.h
 * \brief Lets only such joint velocities pass from which the arm can still stop in time.
 */
#ifndef vpStopSupervisor_h
#define vpStopSupervisor_h

#include <visp3/avoidance/vpCertifiedTrajectory.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpStopSupervisor.
 */
struct VISP_EXPORT vpStopSupervisorSpec {
  double period = 0.005;    //!< Of the calls, s, > 0.
  double margin = 0.01;     //!< Clearance kept, m, >= 0.
  double latency = 0.;      //!< Age of what the scene says of its objects, s, >= 0: they count as moved on by it.
  double resolution = 1e-4; //!< See vpCertifiedMotionSpec, m, > 0.
  int attempts = 4;         //!< Velocities between the wish and braking that are tried, 1..16: each halves the wish.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_avoidance
//! \brief What became of a wish.
enum class vpSupervision {
  Passed,      //!< As wished.
  Slowed,      //!< Slower, so that the arm can still stop.
  Stopping,    //!< On the stop that was proven free before.
  Standing,    //!< At rest: any motion that was tried towards the wish cannot be stopped in time.
  Unsafe,      //!< Brakes, but something came in the way since that stop was proven: it may not end in time.
  InvalidInput //!< Something was not finite or of a wrong size; brakes.
};

/*!
 * \ingroup group_avoidance
 * \brief Velocity to command, and why.
 */
struct VISP_EXPORT vpSupervisedVelocity {
  vpJointVector velocity;                             //!< rad/s or m/s.
  vpSupervision status = vpSupervision::InvalidInput; //!< What became of the wish.
  double share = 0.;                                  //!< Of the wish, 0..1.
  vpClearance pair;                                   //!< What is in the way, unless Passed.

  //! The status as a sentence for a person.
  [[nodiscard]] const char *sentence() const noexcept;
};

/*!
 * \class vpStopSupervisor
 * \ingroup group_avoidance
 * \brief Behind whatever makes joint velocities: a servo law, a joystick, a planner.
 *
 * A velocity passes when one period of it, and then braking to rest within the acceleration limits, is proven free for the
 * whole arm (vpCertifiedTrajectory), with objects moving on at their velocities until it stands. Otherwise velocities
 * between the wish and braking are tried; if none does, the stop of the last period, which was proven then, goes on. So,
 * while objects keep their velocities, the arm never touches anything while it moves; what runs into it when it stands is
 * beyond its power. Nearness alone slows nothing: a way along an obstacle or away from it is free at full speed, and an arm
 * within the margin may go wherever it ends no nearer.
 */
class VISP_EXPORT vpStopSupervisor
{
public:
  /*!
   * \param scene : Must outlive this; objects may be moved between the steps.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpStopSupervisorSpec::validate(); naming a joint without acceleration limit.
   */
  explicit vpStopSupervisor(const vpCollisionScene &scene, const vpStopSupervisorSpec &spec = {});

  /*!
   * One period; no allocation, no exception.
   * \param q : Commanded configuration now, rad or m. \param wish : Velocities wished for the next period, within the
   * acceleration limits seen from the last command.
   * \param output : Receives the velocity to command.
   */
  void step(const vpJointVector &q, const vpJointVector &wish, vpSupervisedVelocity &output) noexcept;
  //! Forgets the last stop: the arm stands.
  void reset() noexcept;

private:
  bool admit(const vpJointVector &q, const vpJointVector &velocity, vpClearance &pair) noexcept;
  [[nodiscard]] bool isRetreat(const vpClearance &now, double there) noexcept;

  const vpCollisionScene *m_scene;
  vpStopSupervisorSpec m_spec;
  vpCertifiedTrajectory m_certificate;
  vpTrajectoryPlan m_candidate, m_stop; // in force: m_stop from m_time on
  double m_time = 0.;
  bool m_moving = false;
  vpCollisionData m_data;
};

END_VISP_NAMESPACE
#endif
