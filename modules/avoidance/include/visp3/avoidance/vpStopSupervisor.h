/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpStopSupervisor.h
 * \brief Passes only joint velocities from which the arm can still stop in time.
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
  double period = 0.005;    //!< Control period, s, > 0, at most 1.
  double margin = 0.01;     //!< Clearance to keep, m, >= 0.
  double latency = 0.;      //!< Age of the scene's object poses, s, >= 0: objects are extrapolated by it.
  double resolution = 1e-4; //!< See vpCertifiedMotionSpec, m, > 0.
  int attempts = 4;         //!< Number of velocities tried between request and braking, 1..16: each halves the request.
  int looks = 300;          //!< Maximum number of configurations evaluated per step; >= 60. Beyond it: not free.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

//! \ingroup group_avoidance
//! \brief Result of supervising a requested velocity.
enum class vpSupervision {
  Passed,      //!< As requested.
  Limited,     //!< As requested, within the joint velocity, acceleration and position limits.
  Slowed,      //!< Slower, so that the arm can still stop.
  Stopping,    //!< Executing the stop that was proven free before.
  Standing,    //!< At rest: no motion tried towards the request can be stopped in time.
  Unsafe,      //!< Brakes, but an obstacle came in the way after the stop was proven: it may not end in time.
  InvalidInput //!< An input was not finite, out of range or of the wrong size; brakes.
};

/*!
 * \ingroup group_avoidance
 * \brief Velocity to command, and its status.
 */
struct VISP_EXPORT vpSupervisedVelocity {
  vpJointVector velocity;                             //!< Joint velocities, rad/s or m/s.
  vpSupervision status = vpSupervision::InvalidInput; //!< Result of the supervision.
  double share = 0.;                                  //!< Fraction of the request within the joint limits, 0..1.
  vpClearance pair;                                   //!< The obstructing pair, unless Passed or Limited.
  int looks = 0;                                      //!< Number of configurations evaluated.

  //! Status as a readable sentence.
  [[nodiscard]] const char *message() const noexcept;
};

/*!
 * \class vpStopSupervisor
 * \ingroup group_avoidance
 * \brief Collision supervisor for any source of joint velocities: servo law, joystick, planner.
 *
 * The request is first limited to the arm's velocity limits, acceleration limits (from the last command) and position
 * limits (with braking). It passes if one period of it, followed by braking to rest within the limits, is proven free
 * for the whole arm (vpCertifiedTrajectory), with objects moving at their velocities. Otherwise velocities between it
 * and braking are tried; if none passes, the stop proven in the last period continues. Proximity alone does not slow
 * the arm: motion along an obstacle or away from it is free at full speed, and an arm within the margin may move
 * wherever it gets no nearer.
 *
 * Proof. Let the arm be where its commands took it, and the objects keep their velocities. By induction over the
 * periods every command is the first period, or the next one, of a plan q(t) that was proven: constant velocity for a
 * period T, then constant deceleration, then rest. A command holds one velocity for T, the mean of the plan's over that
 * period, so at the ends of periods the arm is where the plan is. In between it moves along the chord: |q''_j| <= d_j
 * almost everywhere, with d_j the deceleration of joint j, so it is never farther from q_j(t) than min(d_j T / 8,
 * |v_j|) T, and a point of link l by no more than e_l = sum_j R_lj of that (vpReachBounds). A clearance is off by no
 * more than e, the largest e_l: this includes two capsules of the arm, as their clearance changes only with the joints
 * between them, by the motion of the outer one relative to the inner one. That holds to the end of the last period, in
 * which the plan comes to rest before the arm does. So the plan is proven from its start to the end of the period in
 * which it ends, with the margin enlarged by e and the resolution, and the arm keeps the margin at every instant until
 * it stands. Two means that follow each other differ by no more than d_j T, which keeps the limit of acceleration. An
 * arm within the margin, at a clearance c, may go where it is no nearer at the end of any period, and keeps
 * c - 0.1 mm - e in between, so the loss does not accumulate; an arm that is nearer to its margin than e and the
 * resolution counts as within it.
 *
 * The proof does not cover an object that appears or is faster than stated (the status is Unsafe), an object that runs
 * into a standing arm, and drives that do not follow. An arm that is nearer to something than the sum of 0.1 mm, e and
 * the resolution has no motion that could be proven, and stands. Capsules alone decide, also where the scene has exact
 * shapes: capsules larger than the arm stop it early, and those that touch where the arm does not never let it move.
 *
 * \code
 * vpStopSupervisor supervisor(scene); // every 5 ms; margin 1 cm
 * vpSupervisedVelocity command;
 * for (int i = 0; i < 400; ++i) {
 *   scene.advance(0.005); // or vpObjectTracks::applyTo()
 *   supervisor.step(q, wish, command);
 *   q += 0.005 * command.velocity; // to the drives
 *   if (command.status != vpSupervision::Passed && command.status != vpSupervision::Limited) {
 *     std::cerr << command.message() << " " << scene.describe(command.pair) << std::endl;
 *   }
 * }
 * \endcode
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
   * One period; no allocation, no exception, and at most vpStopSupervisorSpec::looks evaluations for any input.
   * \param q : Current commanded configuration, rad or m. If it deviates from the last command, its stop is proven
   * again; Unsafe if that fails.
   * \param wish : Requested velocities for the next period, rad/s or m/s; any finite numbers.
   * \param output : Receives the velocity to command.
   */
  void step(const vpJointVector &q, const vpJointVector &wish, vpSupervisedVelocity &output) noexcept;
  //! Resets to a standing arm, discarding the last stop.
  void reset() noexcept;

private:
  [[nodiscard]] vpJointVector braking() const noexcept;
  [[nodiscard]] vpJointVector limited(const vpJointVector &q, const vpJointVector &wish) const noexcept;
  [[nodiscard]] bool tryWish(const vpJointVector &q, const vpJointVector &wish, const vpJointVector &braking,
                             vpSupervisedVelocity &output) noexcept;
  [[nodiscard]] bool admit(const vpJointVector &q, const vpJointVector &velocity, vpClearance &pair) noexcept;
  [[nodiscard]] bool isRetreat(const vpJointVector &q, double offPlan) noexcept;
  void startStopAt(const vpJointVector &q) noexcept;
  [[nodiscard]] double offPlan(const vpTrajectoryPlan &plan) const noexcept;
  [[nodiscard]] double standing(const vpTrajectoryPlan &plan) const noexcept;
  [[nodiscard]] vpClearance clearanceAt(const vpTrajectoryPlan &plan, double time, double cutoff) noexcept;
  [[nodiscard]] vpTrajectoryClearance prove(const vpTrajectoryPlan &plan, double from, double margin,
                                            int looks) noexcept;
  [[nodiscard]] int looksOfProof() const noexcept;

  const vpCollisionScene *m_scene;
  vpStopSupervisorSpec m_spec;
  vpCertifiedTrajectory m_certificate;
  vpTrajectoryPlan m_candidate, m_stop; // in force: m_stop from m_time on
  double m_time = 0.;
  bool m_moving = false;
  int m_looks = 0;         // left in this step
  vpJointVector m_command; // of the last period
  vpCollisionData m_data;
};

END_VISP_NAMESPACE
#endif
