/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
/*!
 * \file vpCertifiedTrajectory.h
 * \brief Proof that a coming trajectory in joint space is free.
 */
#ifndef vpCertifiedTrajectory_h
#define vpCertifiedTrajectory_h

#include <visp3/avoidance/vpCertifiedMotion.h>
#include <visp3/trajectory/vpTrajectoryPlan.h>

BEGIN_VISP_NAMESPACE

/*!
 * \ingroup group_avoidance
 * \brief Verdict on a trajectory, and when.
 */
struct VISP_EXPORT vpTrajectoryClearance {
  vpMotionStatus status = vpMotionStatus::BadInput; //!< Only Free may be driven.
  double time = 0.; //!< Collision and Undecided: when, s from the start of the plan; all before is free.
  vpClearance pair; //!< Collision and Undecided: the pair then, not always the nearest one.
  double least =
      0.; //!< Least clearance that was looked at, m; infinite when none was near. The true least may be less.
  int evaluated = 0; //!< Configurations looked at.

  //! True when the trajectory is free.
  [[nodiscard]] bool isFree() const noexcept { return status == vpMotionStatus::Free; }
};

/*!
 * \class vpCertifiedTrajectory
 * \ingroup group_avoidance
 * \brief Free is a proof for every instant of a vpTrajectoryPlan of the arm's joints, with obstacles that move by their
 * velocities.
 *
 * In an interval of half-width h about t_m joint j is never farther from where it is then than d_j, the smaller of
 * (|v_j(t_m)| + w_j) h + a_j h^2 / 2 and V_j h, and x_j more: V_j and a_j are its largest velocity and acceleration over the
 * plan, w_j and x_j the sums of its jumps of velocity and place (rounding only in a plan of vpTrajectoryPlanner). Capsule i moves by no more than sum_j R_ij d_j
 * (vpReachBounds), an object by no more than its speed times h plus its turn times its extent. The interval is free when
 * at t_m every pair is farther apart than the margin, both motions together and 1e-9 m of rounding; otherwise it is split.
 * What is not finite, takes a joint beyond vpLargestCoordinate or a prismatic one to where the bounds do not hold
 * (vpReachBounds::holds()) is BadInput, and the number of looks is limited: then it is Undecided.
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
   * Checks the plan from a time on; no allocation, no exception.
   * \param plan : Of as many axes as the arm has joints, in rad or m.
   * \param from, to : Times on the plan, s; from <= to, beyond the plan's end the arm stands at its goal.
   * \param age : How long ago the objects were where the scene has them at time \e from, s: they are moved on by it.
   * All times within 1e6 s.
   */
  [[nodiscard]] vpTrajectoryClearance check(const vpTrajectoryPlan &plan, double from, double to,
                                            double age = 0.) noexcept;
  //! The whole plan, objects where the scene has them at its start.
  [[nodiscard]] vpTrajectoryClearance check(const vpTrajectoryPlan &plan) noexcept
  {
    return check(plan, 0., plan.duration());
  }

  /*!
   * As check() with its parameters, for whom only the verdict matters, in less time: the time of a collision is one when
   * something is too near, not the first one. No more than \e looks configurations are looked at; a motion that needs more
   * is Undecided.
   */
  [[nodiscard]] vpTrajectoryClearance verdict(const vpTrajectoryPlan &plan, double from, double to, double age = 0.,
                                              int looks = mostLooks) noexcept;

  static constexpr int mostLooks = 1000000; //!< Of one check.

  //! Changes the margin, m; values that are not >= 0 and finite count as 0. No exception.
  void setMargin(double margin) noexcept;
  //! R_ij of the scene's arm.
  [[nodiscard]] const vpReachBounds &reach() const noexcept { return m_reach; }

private:
  [[nodiscard]] vpTrajectoryClearance search(const vpTrajectoryPlan &plan, double from, double to, double age,
                                             bool first, int looks) noexcept;
  [[nodiscard]] bool study(const vpTrajectoryPlan &plan) noexcept;
  enum class Verdict { Free, Collision, Split, Bad };
  Verdict look(const vpTrajectoryPlan &plan, double middle, double half, double objectTime,
               vpTrajectoryClearance &result) noexcept;

  const vpCollisionScene *m_scene;
  vpCertifiedMotionSpec m_spec;
  vpReachBounds m_reach;
  vpCollisionData m_data;
  vpNearPairs m_near;
  vpJointVector m_speed, m_acceleration; // largest of each joint over the plan
  vpJointVector m_kink, m_jump;          // of each joint over the plan: sum of the jumps of its velocity, of its place
  std::array<double, vpArmMaxCapsules> m_motion{};
  double m_largest = 0.; // motion of a part in the interval that was looked at, m
};

END_VISP_NAMESPACE
#endif
