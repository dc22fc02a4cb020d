/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCertifiedTrajectory.h
 * \brief Certified collision check of a joint-space trajectory.
 */
#ifndef vpCertifiedTrajectory_h
#define vpCertifiedTrajectory_h

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Result of checking a trajectory.
 */
struct VISP_EXPORT vpTrajectoryClearance {
  vpMotionStatus status = vpMotionStatus::BadInput; //!< Only Free may be executed.
  double time = 0.;  //!< Collision and Undecided: time of it, s from the start of the plan; free before.
  vpClearance pair;  //!< Collision and Undecided: the pair at that time, not always the nearest one.
  double least = 0.; //!< Least clearance evaluated, m; infinite if none was near. The true minimum may be less.
  int evaluated = 0; //!< Number of configurations evaluated.

  //! True if the trajectory is free.
  [[nodiscard]] bool isFree() const noexcept { return status == vpMotionStatus::Free; }
};

/*!
 * \class vpCertifiedTrajectory
 * \ingroup group_avoidance
 * \brief Continuous collision check of a joint trajectory: Free is a proof for every instant of a vpTrajectoryPlan,
 * with obstacles moving at their velocities.
 *
 * In an interval of half-width h about t_m joint j moves from its position at t_m by at most d_j + x_j, with d_j the
 * smaller of (|v_j(t_m)| + w_j) h + a_j h^2 / 2 and V_j h: V_j and a_j are its largest velocity and acceleration over
 * the plan, w_j and x_j the sums of its velocity and position jumps (only rounding in a plan of vpTrajectoryPlanner).
 * A capsule of link l moves by at most the sum over j of R_lj times that (vpReachBounds), an object by at most its
 * speed times h plus its rotation times its extent. The interval is free if at t_m the distance of every pair exceeds
 * the sum of the margin, both motions and 1e-9 m for rounding; otherwise it is split. Values that are not finite,
 * joints beyond vpLargestCoordinate and prismatic joints where the bounds do not hold (vpReachBounds::holds()) give
 * BadInput; reaching the limit on evaluations gives Undecided. Capsules alone decide, also where the scene has exact
 * shapes: a motion that vpCertifiedMotion calls free by these is a Collision here.
 *
 * \code
 * vpTrajectoryInput<Eigen::Dynamic> input(arm.size());
 * input.start.q = q;
 * input.goal.q = goal;
 * input.maxVelocity = arm.velocity();
 * input.maxAcceleration = arm.acceleration();
 * vpTrajectoryPlan plan(arm.size());
 * vpCertifiedTrajectory certificate(scene, {0.01}); // margin, m
 * if (vpDirectTrajectory<Eigen::Dynamic>::calculate(input, plan).isGood()) {
 *   const vpTrajectoryClearance result = certificate.check(plan);
 *   if (!result.isFree()) {
 *     std::cerr << "free until " << result.time << " s: " << scene.describe(result.pair) << std::endl;
 *   }
 * }
 * \endcode
 */
class VISP_EXPORT vpCertifiedTrajectory
{
public:
  /*!
   * \param scene : Must outlive this; see vpCertifiedMotion.
   * \param spec : Margin, and the motion below which intervals are not split further.
   * \throw vpException (badValue) naming margin or resolution and its value.
   */
  explicit vpCertifiedTrajectory(const vpCollisionScene &scene, const vpCertifiedMotionSpec &spec = {});

  /*!
   * Checks the plan over a time interval; no allocation, no exception.
   * \param plan : Plan with one axis per joint of the arm, rad or m.
   * \param from, to : Times on the plan, s; from <= to, beyond the plan's end the arm stands at its goal.
   * \param age : Age of the scene's object poses at time \e from, s: objects are extrapolated by it.
   * All times within 1e6 s.
   */
  [[nodiscard]] vpTrajectoryClearance check(const vpTrajectoryPlan &plan, double from, double to,
                                            double age = 0.) noexcept;
  //! Checks the whole plan, with the scene's object poses at its start.
  [[nodiscard]] vpTrajectoryClearance check(const vpTrajectoryPlan &plan) noexcept
  {
    return check(plan, 0., plan.duration());
  }

  /*!
   * Like check(), but faster: the time of a collision is not necessarily the first one. At most \e looks configurations
   * are evaluated; a motion that needs more is Undecided.
   */
  [[nodiscard]] vpTrajectoryClearance verdict(const vpTrajectoryPlan &plan, double from, double to, double age = 0.,
                                              int looks = mostLooks) noexcept;

  static constexpr int mostLooks = 1000000; //!< Maximum number of evaluations of one check.

  //! Sets the margin, m; negative and non-finite values count as 0. No exception.
  void setMargin(double margin) noexcept;
  //! Reach bounds of the scene's arm.
  [[nodiscard]] const vpReachBounds &reach() const noexcept { return *m_reach; }

private:
  [[nodiscard]] vpTrajectoryClearance search(const vpTrajectoryPlan &plan, double from, double to, double age,
                                             bool first, int looks) noexcept;
  [[nodiscard]] bool study(const vpTrajectoryPlan &plan) noexcept;
  enum class Verdict { Free, Collision, Split, Bad };
  Verdict look(const vpTrajectoryPlan &plan, double middle, double half, double objectTime,
               vpTrajectoryClearance &result) noexcept;

  const vpCollisionScene *m_scene;
  vpCertifiedMotionSpec m_spec;
  std::shared_ptr<const vpReachBounds> m_reach;
  vpCollisionData m_data;
  vpNearPairs m_near;
  vpJointVector m_speed, m_acceleration; // maximum of each joint over the plan
  vpJointVector m_kink, m_jump; // sums of the velocity jumps and of the position jumps of each joint over the plan
  double m_largest = 0.;        // motion of any pair in the last interval, m
};

END_VISP_NAMESPACE
#endif
