/*
 * visp-direct: direct methods for vision-based robot control, for ViSP.
 * SPDX-License-Identifier: GPL-2.0-or-later
 */
#ifndef vpDirectTrajectoryAvoidance_h
#define vpDirectTrajectoryAvoidance_h

#include <visp3/avoidance/vpAvoidanceMethod.h>

#include <memory>
#include <vector>

BEGIN_VISP_NAMESPACE

//! \ingroup group_avoidance
//! \brief What the trajectory is changed by.
enum class vpDetourKind {
  PointToPoint, //!< Point to point, (8.3)-(8.5): another final position beside the obstacle until the way to the goal is free.
  Via           //!< Multi-point, (8.6)-(8.9): up to four via positions, the goal stays.
};

/*!
 * \ingroup group_avoidance
 * \brief Parameters of vpDirectTrajectoryAvoidance.
 */
struct VISP_EXPORT vpDirectTrajectoryAvoidanceSpec {
  vpAvoidanceMethodSpec common;            //!< What all methods have.
  vpDetourKind detour = vpDetourKind::Via; //!< See there.
  double clearance = 0.015;                //!< That a new motion keeps beyond the margin, m, >= 0.
  double toolClearance = 0.08;  //!< Of the end effector's origin from an obstacle's extent at a detour, m, >= 0.
  int sides = 8;                //!< Of an obstacle that are tried, 2..32.
  int forecasts = 40;           //!< At most in a look(), >= 1: each takes some 0.3 to 1.5 ms.
  bool keepOrientation = false; //!< Of the end effector: a camera goes on looking where it looks.
  bool usePosture = true;       //!< Lean to vpAvoidanceGoal::q, when it is given.

  //! \throw vpException (badValue) naming the field that is out of range, and its value.
  void validate() const;
};

/*!
 * \class vpDirectTrajectoryAvoidance
 * \ingroup group_avoidance
 * \brief Avoidance on trajectory level, thesis 8.2.2: every period the next state of a minimum-jerk motion of the tool
 * from the present state, whose final or via position is chosen from the obstacle's extent and the free side.
 *
 * look() foresees the coming motion of the whole arm, obstacles moving on by their velocities. When something comes
 * nearer than the margin it tries places beside it, the shortest ways first, and each again for what comes in the way
 * there, until a motion is foreseen to be free; that one is taken up from the present state, velocity and acceleration.
 * When there is none the tool brakes within its bounds, and every look() tries again.
 *
 * step() follows by the redundancy solver, with self-motion away from obstacles ((8.10)-(8.12), corrected), and under
 * vpStopSupervisor: the arm always can stop in time, slows for what comes, may always go away. When the joints or the
 * supervisor do not allow the planned motion, the next one starts from what was allowed.
 *
 * Norms of the tool's planned velocity and acceleration keep the bounds; joint limits always hold. Only while the
 * supervisor acts (vpAvoidanceOutput::stopping) the tool may brake harder than its bound.
 */
class VISP_EXPORT vpDirectTrajectoryAvoidance : public vpAvoidanceMethod
{
public:
  /*!
   * \param scene : Must outlive this.
   * \param spec : Parameters; copied.
   * \throw vpException (badValue), see vpDirectTrajectoryAvoidanceSpec::validate(); naming a joint without motion limits.
   */
  explicit vpDirectTrajectoryAvoidance(const vpCollisionScene &scene, const vpDirectTrajectoryAvoidanceSpec &spec = {});
  ~vpDirectTrajectoryAvoidance() override;

  vpAvoidanceStatus start(const vpJointVector &q, const vpAvoidanceGoal &goal) override;
  void setGoal(const vpAvoidanceGoal &goal) noexcept override;
  void look() override;
  void step(const vpJointVector &q, vpAvoidanceOutput &output) noexcept override;

  //! Via or, for vpDetourKind::PointToPoint, the present final position, m; for pictures. Empty on the direct way.
  [[nodiscard]] std::vector<Eigen::Vector3d> detour() const;

private:
  class Impl;
  std::unique_ptr<Impl> m_impl;
};

END_VISP_NAMESPACE
#endif
